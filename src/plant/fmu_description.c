/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Read with libxml2: no network, no external entities, messages caught.
 */
#include "plant/fmu_description.h"

#include "base/alloc.h"
#include "base/text.h"
#include "plant/fmu_exchange.h"

#include <libxml/parser.h>
#include <libxml/tree.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

xmlNode *gm_fmu_child(const xmlNode *parent, const char *name)
{
    for (xmlNode *node = parent->children; node; node = node->next)
        if (node->type == XML_ELEMENT_NODE && !xmlStrcmp(node->name, BAD_CAST name))
            return node;
    return NULL;
}

char *gm_fmu_attribute(xmlNode *node, const char *name)
{
    xmlChar *value = xmlGetProp(node, BAD_CAST name);
    char *copy = value ? gm_strdup((const char *)value) : NULL;
    xmlFree(value);
    return copy;
}

bool gm_fmu_read_reference(const char *text, unsigned *reference)
{
    char *rest;
    unsigned long value = text && *text >= '0' && *text <= '9' ? strtoul(text, &rest, 10)
                                                               : (rest = NULL, 0UL);
    *reference = (unsigned)value;
    return rest && *rest == '\0' && value <= 0xffffffffUL;
}

static gm_status read_variable(xmlNode *node, const char *archive, fmu_variable *variable,
                               gm_error *error)
{
    char *reference = gm_fmu_attribute(node, "valueReference");
    variable->name = gm_fmu_attribute(node, "name");
    bool good = variable->name && gm_fmu_read_reference(reference, &variable->reference);
    gm_free(reference);
    if (good)
        return GM_OK;
    return gm_fail(error, GM_ERR_FORMAT,
                   "%s: modelDescription.xml, line %ld: a variable without a name or a "
                   "value reference",
                   archive, xmlGetLineNo(node));
}

static int compare(const void *a, const void *b)
{
    return strcmp(((const fmu_variable *)a)->name, ((const fmu_variable *)b)->name);
}

static gm_status read_variables(xmlNode *list, const char *archive, fmu_description *d,
                                gm_error *error)
{
    unsigned long n = xmlChildElementCount(list);
    gm_status status = GM_OK;
    d->variables = gm_calloc(n, sizeof *d->variables);
    if (!d->variables)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for the variables of %s",
                       archive);
    for (xmlNode *node = list->children; node && status == GM_OK; node = node->next)
        if (node->type == XML_ELEMENT_NODE)
            status = read_variable(node, archive, &d->variables[d->n_variables++], error);
    if (status == GM_OK && d->n_variables > 1)
        qsort(d->variables, (size_t)d->n_variables, sizeof *d->variables, compare);
    return status;
}

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

/* An attribute that may be missing; no memory is told apart from that. */
static gm_status read_optional(xmlNode *node, const char *name, const char *archive,
                               char **value, gm_error *error)
{
    *value = gm_fmu_attribute(node, name);
    if (*value || !xmlHasProp(node, BAD_CAST name))
        return GM_OK;
    return gm_fail(error, GM_ERR_MEMORY, "no memory to read %s", archive);
}

static gm_status read_origin(xmlNode *root, const char *archive, fmu_description *d,
                             gm_error *error)
{
    xmlNode *origin = find_origin(root);
    char *temperature = NULL;
    d->oil_temperature = (double)NAN;
    if (!origin)
        return GM_OK;
    gm_status status =
        read_optional(origin, "oilTemperature", archive, &temperature, error);
    if (temperature)
        (void)gm_text_to_double(temperature, &d->oil_temperature);
    gm_free(temperature);
    if (status == GM_OK)
        status =
            read_optional(origin, "descriptionSha256", archive, &d->source_sha256, error);
    if (status == GM_OK)
        status = read_optional(origin, "mapContentHash", archive, &d->map_hash, error);
    return status;
}

bool gm_fmu_is_identifier(const char *text)
{
    return text && *text &&
           strspn(text,
                  "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") ==
               strlen(text);
}

static gm_status read_root(xmlNode *root, const char *archive, fmu_description *d,
                           gm_error *error)
{
    char *version = root ? gm_fmu_attribute(root, "fmiVersion") : NULL;
    bool is_fmi2 = version && !strcmp(version, "2.0");
    xmlNode *mode = is_fmi2 ? gm_fmu_child(root, "CoSimulation") : NULL;
    xmlNode *list = is_fmi2 ? gm_fmu_child(root, "ModelVariables") : NULL;
    gm_free(version);
    if (!is_fmi2)
        return gm_fail(error, GM_ERR_FORMAT, "%s: is not an FMU of FMI 2.0", archive);
    if (!mode || !list)
        return gm_fail(error, GM_ERR_FORMAT, "%s: the FMU does not offer Co-Simulation",
                       archive);
    d->guid = gm_fmu_attribute(root, "guid");
    d->identifier = gm_fmu_attribute(mode, "modelIdentifier");
    if (!d->guid || !gm_fmu_is_identifier(d->identifier))
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s: modelDescription.xml has no GUID or no model identifier",
                       archive);
    gm_status status = read_origin(root, archive, d, error);
    if (status == GM_OK)
        status = read_variables(list, archive, d, error);
    return status == GM_OK ? gm_fmu_exchange_read(root, archive, d, error) : status;
}

static void keep_quiet(void *context, xmlErrorPtr message)
{
    (void)context;
    (void)message;
}

gm_status gm_fmu_description_read(const char *path, const char *archive,
                                  fmu_description *description, gm_error *error)
{
    fmu_description d = {0};
    gm_status status;
    xmlParserCtxt *parser = xmlNewParserCtxt();
    if (!parser)
        return gm_fail(error, GM_ERR_MEMORY, "no memory to read %s", archive);
    parser->sax->serror = keep_quiet;
    xmlDoc *document = xmlCtxtReadFile(
        parser, path, NULL, XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING);
    if (document)
        status = read_root(xmlDocGetRootElement(document), archive, &d, error);
    else
        status =
            gm_fail(error, GM_ERR_FORMAT,
                    "%s: modelDescription.xml is missing or not well-formed (line %d)",
                    archive, parser->lastError.line);
    xmlFreeDoc(document);
    xmlFreeParserCtxt(parser);
    if (status == GM_OK)
        *description = d;
    else
        gm_fmu_description_clear(&d);
    return status;
}

const fmu_variable *gm_fmu_description_find(const fmu_description *description,
                                            const char *name)
{
    char key_name[256];
    if (snprintf(key_name, sizeof key_name, "%s", name) >= (int)sizeof key_name)
        return NULL;
    fmu_variable key = {.name = key_name};
    return bsearch(&key, description->variables, (size_t)description->n_variables,
                   sizeof key, compare);
}

void gm_fmu_description_clear(fmu_description *description)
{
    for (int i = 0; i < description->n_variables; i++)
        gm_free(description->variables[i].name);
    gm_free(description->variables);
    for (int i = 0; i < description->n_states; i++) {
        gm_free(description->states[i].name);
        gm_free(description->states[i].dependencies);
    }
    gm_free(description->states);
    gm_free(description->exchange_identifier);
    gm_free(description->guid);
    gm_free(description->identifier);
    gm_free(description->source_sha256);
    gm_free(description->map_hash);
    *description = (fmu_description){0};
}
