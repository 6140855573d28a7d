/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Read with libxml2: no network, no external entities, messages caught.
 */
#include "plant/fmu_description.h"

#include "base/alloc.h"
#include "base/text.h"
#include "plant/fmu_exchange.h"
#include "plant/fmu_origin.h"

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

double gm_fmu_number(xmlNode *node, const char *name, double otherwise)
{
    xmlChar *text = node ? xmlGetProp(node, BAD_CAST name) : NULL;
    double value = otherwise;
    if (text)
        (void)gm_text_to_double((const char *)text, &value);
    xmlFree(text);
    return value;
}

bool gm_fmu_read_reference(const char *text, unsigned *reference)
{
    char *rest;
    unsigned long value = text && *text >= '0' && *text <= '9' ? strtoul(text, &rest, 10)
                                                               : (rest = NULL, 0UL);
    *reference = (unsigned)value;
    return rest && *rest == '\0' && value <= 0xffffffffUL;
}

/* Elements of both versions. */
static fmu_kind kind_of(const char *name, int version)
{
    static const struct {
        const char *name;
        fmu_kind kind;
    } kinds[] = {
        {"Real", FMU_REAL},      {"Float64", FMU_REAL},    {"Float32", FMU_FLOAT32},
        {"Int8", FMU_INT8},      {"UInt8", FMU_UINT8},     {"Int16", FMU_INT16},
        {"UInt16", FMU_UINT16},  {"Integer", FMU_INTEGER}, {"Int32", FMU_INTEGER},
        {"UInt32", FMU_UINT32},  {"Int64", FMU_INT64},     {"UInt64", FMU_UINT64},
        {"Boolean", FMU_BOOLEAN}};
    if (strcmp(name, "Enumeration") == 0)
        return version == 3 ? FMU_INT64 : FMU_INTEGER;
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        if (strcmp(name, kinds[i].name) == 0)
            return kinds[i].kind;
    return FMU_OTHER;
}

static bool says(xmlNode *node, const char *name, const char *value)
{
    xmlChar *text = xmlGetProp(node, BAD_CAST name);
    bool same = text && !xmlStrcmp(text, BAD_CAST value);
    xmlFree(text);
    return same;
}

static fmu_causality causality_of(xmlNode *node)
{
    if (says(node, "causality", "input"))
        return FMU_INPUT;
    if (says(node, "causality", "output"))
        return FMU_OUTPUT;
    return says(node, "causality", "parameter") ? FMU_PARAMETER : FMU_LOCAL;
}

/* The element that says of which type a variable is: inside it in 2.0, itself in 3.0. */
static xmlNode *type_node(xmlNode *node, int version)
{
    if (version == 3)
        return node;
    for (xmlNode *child = node->children; child; child = child->next)
        if (child->type == XML_ELEMENT_NODE &&
            kind_of((const char *)child->name, version) != FMU_OTHER)
            return child;
    return NULL;
}

/* An attribute that may be missing; no memory is told apart from that. */
gm_status gm_fmu_optional(xmlNode *node, const char *name, const char *archive,
                          char **value, gm_error *error)
{
    *value = gm_fmu_attribute(node, name);
    if (*value || !xmlHasProp(node, BAD_CAST name))
        return GM_OK;
    return gm_fail(error, GM_ERR_MEMORY, "no memory to read %s", archive);
}

/* The element of the type that a variable declares, or NULL. */
static xmlNode *declared_type(xmlNode *root, xmlNode *type)
{
    xmlNode *list = gm_fmu_child(root, "TypeDefinitions"), *found = NULL;
    xmlChar *declared = xmlGetProp(type, BAD_CAST "declaredType");
    for (xmlNode *node = list && declared ? list->children : NULL; node && !found;
         node = node->next)
        if (node->type == XML_ELEMENT_NODE && says(node, "name", (const char *)declared))
            found = node;
    xmlFree(declared);
    for (xmlNode *inner = found ? found->children : NULL; inner; inner = inner->next)
        if (inner->type == XML_ELEMENT_NODE &&
            kind_of((const char *)inner->name, 2) != FMU_OTHER)
            return inner; /* of 2.0: SimpleType around it */
    return found;
}

/* An enumeration goes from its least to its greatest item. */
static void read_items(xmlNode *type, fmu_variable *variable)
{
    for (xmlNode *item = type->children; item; item = item->next) {
        if (item->type != XML_ELEMENT_NODE || xmlStrcmp(item->name, BAD_CAST "Item"))
            continue;
        double value = gm_fmu_number(item, "value", (double)NAN);
        variable->least = fmin(variable->least, value);
        variable->greatest = fmax(variable->greatest, value);
    }
}

static void read_range(xmlNode *type, xmlNode *declared, fmu_variable *variable)
{
    double least = declared ? gm_fmu_number(declared, "min", (double)NAN) : (double)NAN;
    double most = declared ? gm_fmu_number(declared, "max", (double)NAN) : (double)NAN;
    variable->least = gm_fmu_number(type, "min", least);
    variable->greatest = gm_fmu_number(type, "max", most);
    if (declared && isnan(variable->least) && isnan(variable->greatest))
        read_items(declared, variable);
}

/* Unit, range and description of a variable. */
static gm_status read_details(xmlNode *root, xmlNode *node, xmlNode *type,
                              const char *archive, fmu_variable *variable,
                              gm_error *error)
{
    gm_status status =
        gm_fmu_optional(node, "description", archive, &variable->description, error);
    variable->least = variable->greatest = (double)NAN;
    if (!type || status != GM_OK)
        return status;
    xmlNode *declared = declared_type(root, type);
    bool own = xmlHasProp(type, BAD_CAST "unit") || !declared;
    read_range(type, declared, variable);
    return gm_fmu_optional(own ? type : declared, "unit", archive, &variable->unit,
                           error);
}

static gm_status read_variable(xmlNode *root, xmlNode *node, const char *archive,
                               int version, fmu_variable *variable, gm_error *error)
{
    char *reference = gm_fmu_attribute(node, "valueReference");
    xmlNode *type = type_node(node, version);
    variable->name = gm_fmu_attribute(node, "name");
    variable->kind = type ? kind_of((const char *)type->name, version) : FMU_OTHER;
    variable->causality = causality_of(node);
    variable->settable = variable->causality == FMU_PARAMETER ||
                         (type && xmlHasProp(type, BAD_CAST "start") != NULL);
    gm_status status = read_details(root, node, type, archive, variable, error);
    bool good = variable->name && gm_fmu_read_reference(reference, &variable->reference);
    gm_free(reference);
    if (good)
        return status;
    return gm_fail(error, GM_ERR_FORMAT,
                   "%s: modelDescription.xml, line %ld: a variable without a name or a "
                   "value reference",
                   archive, xmlGetLineNo(node));
}

static int compare(const void *a, const void *b)
{
    return strcmp(((const fmu_variable *)a)->name, ((const fmu_variable *)b)->name);
}

static gm_status read_variables(xmlNode *root, xmlNode *list, const char *archive,
                                fmu_description *d, gm_error *error)
{
    unsigned long n = xmlChildElementCount(list);
    gm_status status = GM_OK;
    d->variables = gm_calloc(n, sizeof *d->variables);
    if (!d->variables)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for the variables of %s",
                       archive);
    for (xmlNode *node = list->children; node && status == GM_OK; node = node->next)
        if (node->type == XML_ELEMENT_NODE)
            status = read_variable(root, node, archive, d->version,
                                   &d->variables[d->n_variables++], error);
    if (status == GM_OK && d->n_variables > 1)
        qsort(d->variables, (size_t)d->n_variables, sizeof *d->variables, compare);
    return status;
}

static void read_base(xmlNode *base, fmu_unit *unit)
{
    unit->factor = gm_fmu_number(base, "factor", 1.0);
    unit->offset = gm_fmu_number(base, "offset", 0.0);
    unit->kg = (int)gm_fmu_number(base, "kg", 0.0);
    unit->m = (int)gm_fmu_number(base, "m", 0.0);
    unit->s = (int)gm_fmu_number(base, "s", 0.0);
    unit->kelvin = (int)gm_fmu_number(base, "K", 0.0);
    unit->rad = (int)gm_fmu_number(base, "rad", 0.0);
    unit->others = xmlHasProp(base, BAD_CAST "A") || xmlHasProp(base, BAD_CAST "mol") ||
                   xmlHasProp(base, BAD_CAST "cd");
}

static gm_status read_units(xmlNode *root, const char *archive, fmu_description *d,
                            gm_error *error)
{
    xmlNode *list = gm_fmu_child(root, "UnitDefinitions");
    d->step =
        gm_fmu_number(gm_fmu_child(root, "DefaultExperiment"), "stepSize", (double)NAN);
    if (!list)
        return GM_OK;
    d->units = gm_calloc(xmlChildElementCount(list) + 1, sizeof *d->units);
    if (!d->units)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for the units of %s", archive);
    for (xmlNode *node = list->children; node; node = node->next) {
        xmlNode *base = gm_fmu_child(node, "BaseUnit");
        if (!base || !xmlHasProp(node, BAD_CAST "name"))
            continue;
        fmu_unit *unit = &d->units[d->n_units++];
        gm_status status = gm_fmu_optional(node, "name", archive, &unit->name, error);
        if (status != GM_OK)
            return status;
        read_base(base, unit);
    }
    return GM_OK;
}

const fmu_unit *gm_fmu_description_unit(const fmu_description *description,
                                        const char *name)
{
    for (int i = 0; i < description->n_units; i++)
        if (strcmp(description->units[i].name, name) == 0)
            return &description->units[i];
    return NULL;
}

bool gm_fmu_is_identifier(const char *text)
{
    return text && *text &&
           strspn(text,
                  "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") ==
               strlen(text);
}

static int version_of(xmlNode *root)
{
    if (root && says(root, "fmiVersion", "2.0"))
        return 2;
    xmlChar *text = root ? xmlGetProp(root, BAD_CAST "fmiVersion") : NULL;
    int is_3 = text && !xmlStrncmp(text, BAD_CAST "3.0", 3);
    xmlFree(text);
    return is_3 ? 3 : 0;
}

static gm_status read_root(xmlNode *root, const char *archive, fmu_description *d,
                           gm_error *error)
{
    d->version = version_of(root);
    if (d->version == 0)
        return gm_fail(error, GM_ERR_FORMAT, "%s: is not an FMU of FMI 2.0 or 3.0",
                       archive);
    xmlNode *mode = gm_fmu_child(root, "CoSimulation");
    xmlNode *list = gm_fmu_child(root, "ModelVariables");
    if (!list || (!mode && !gm_fmu_child(root, "ModelExchange")))
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s: the FMU offers neither Co-Simulation nor Model Exchange",
                       archive);
    d->guid = gm_fmu_attribute(root, d->version == 3 ? "instantiationToken" : "guid");
    d->identifier = mode ? gm_fmu_attribute(mode, "modelIdentifier") : NULL;
    if (!d->guid || (mode && !gm_fmu_is_identifier(d->identifier)))
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s: modelDescription.xml has no GUID or no model identifier",
                       archive);
    gm_status status = gm_fmu_origin_read(root, archive, d, error);
    if (status == GM_OK)
        status = read_units(root, archive, d, error);
    if (status == GM_OK)
        status = read_variables(root, list, archive, d, error);
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
    for (int i = 0; i < description->n_variables; i++) {
        gm_free(description->variables[i].name);
        gm_free(description->variables[i].unit);
        gm_free(description->variables[i].description);
    }
    for (int i = 0; i < description->n_units; i++)
        gm_free(description->units[i].name);
    gm_free(description->units);
    gm_free(description->variables);
    for (int i = 0; i < description->n_states; i++) {
        gm_free(description->states[i].name);
        gm_free(description->states[i].dependencies);
    }
    gm_free(description->states);
    for (int i = 0; i < description->n_gears; i++)
        gm_free(description->gears[i].path);
    gm_free(description->gears);
    gm_free(description->exchange_identifier);
    gm_free(description->guid);
    gm_free(description->identifier);
    gm_free(description->source_sha256);
    gm_free(description->map_hash);
    *description = (fmu_description){0};
}
