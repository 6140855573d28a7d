/* SPDX-License-Identifier: BSD-2-Clause */
#include "plant/fmu_origin.h"

#include "base/alloc.h"
#include "base/text.h"
#include "plant/fmu_exchange.h"

#include <libxml/tree.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* The annotation of the program that made the component; NULL when another did. */
static xmlNode *find_origin(xmlNode *root)
{
    xmlNode *list = gm_fmu_child(root, "VendorAnnotations");
    for (xmlNode *tool = list ? list->children : NULL; tool; tool = tool->next) {
        xmlChar *name =
            tool->type == XML_ELEMENT_NODE ? xmlGetProp(tool, BAD_CAST "name") : NULL;
        bool ours = name && !xmlStrcmp(name, BAD_CAST "gearmap");
        xmlFree(name);
        if (ours)
            return gm_fmu_child(tool, "Gearset");
    }
    return NULL;
}

static gm_status read_gears(xmlNode *origin, const char *archive, fmu_description *d,
                            gm_error *error)
{
    d->gears = gm_calloc(xmlChildElementCount(origin) + 1, sizeof *d->gears);
    if (!d->gears)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for the gears of %s", archive);
    for (xmlNode *node = origin->children; node; node = node->next) {
        if (node->type != XML_ELEMENT_NODE || xmlStrcmp(node->name, BAD_CAST "Gear") ||
            !xmlHasProp(node, BAD_CAST "path"))
            continue;
        fmu_gear *gear = &d->gears[d->n_gears++];
        gear->number = (int)gm_fmu_number(node, "number", 0.0);
        gear->ratio = gm_fmu_number(node, "ratio", (double)NAN);
        gear->inertia = gm_fmu_number(node, "inputInertia", (double)NAN);
        gm_status status = gm_fmu_optional(node, "path", archive, &gear->path, error);
        if (status != GM_OK)
            return status;
    }
    return GM_OK;
}

/* Numbers with a space between them, ascending; what is anything else is no axis. */
static void read_oil_axis(const char *text, fmu_description *d)
{
    int n = 0;
    for (const char *from = text; n < FMU_MAX_OIL && *from; n++) {
        char number[40];
        size_t length = strcspn(from, " ");
        (void)snprintf(number, sizeof number, "%.*s", (int)(length < 39 ? length : 39),
                       from);
        if (!gm_text_to_double(number, &d->oil[n]) ||
            (n > 0 && !(d->oil[n] > d->oil[n - 1])))
            return;
        from += length + (from[length] == ' ');
    }
    d->n_oil = n > 1 ? n : 0;
}

static gm_status find_oil_axis(xmlNode *origin, const char *archive, fmu_description *d,
                               gm_error *error)
{
    char *axis = NULL;
    gm_status status = gm_fmu_optional(origin, "oilTemperatures", archive, &axis, error);
    if (axis)
        read_oil_axis(axis, d);
    gm_free(axis);
    return status;
}

gm_status gm_fmu_origin_read(xmlNode *root, const char *archive, fmu_description *d,
                             gm_error *error)
{
    xmlNode *origin = find_origin(root);
    d->oil_temperature = d->speed_max = d->torque_max = (double)NAN;
    if (!origin)
        return GM_OK;
    d->oil_temperature = gm_fmu_number(origin, "oilTemperature", (double)NAN);
    d->speed_max = gm_fmu_number(origin, "speedMax", (double)NAN);
    d->torque_max = gm_fmu_number(origin, "torqueMax", (double)NAN);
    gm_status status = find_oil_axis(origin, archive, d, error);
    if (status == GM_OK)
        status = gm_fmu_optional(origin, "descriptionSha256", archive, &d->source_sha256,
                                 error);
    if (status == GM_OK)
        status = gm_fmu_optional(origin, "mapContentHash", archive, &d->map_hash, error);
    return status == GM_OK ? read_gears(origin, archive, d, error) : status;
}
