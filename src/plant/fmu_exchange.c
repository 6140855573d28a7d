/* SPDX-License-Identifier: BSD-2-Clause
 *
 * In FMI 2.0 the state vector is in the order of <Derivatives>; each entry is the index
 * of a variable whose attribute `derivative` is the index of its state. Indices count the
 * elements of <ModelVariables> from 1.
 */
#include "plant/fmu_exchange.h"

#include "base/alloc.h"

#include <libxml/tree.h>
#include <stdlib.h>
#include <string.h>

/* The variables by index. */
typedef struct index_list {
    unsigned long n;
    xmlNode **node; /* [n] */
} index_list;

static gm_status broken(const char *archive, const xmlNode *node, const char *what,
                        gm_error *error)
{
    return gm_fail(error, GM_ERR_FORMAT, "%s: modelDescription.xml, line %ld: %s",
                   archive, xmlGetLineNo(node), what);
}

static gm_status no_memory(const char *archive, gm_error *error)
{
    return gm_fail(error, GM_ERR_MEMORY, "no memory to read %s", archive);
}

static gm_status list_variables(xmlNode *root, const char *archive, index_list *list,
                                gm_error *error)
{
    xmlNode *variables = gm_fmu_child(root, "ModelVariables");
    list->n = 0;
    list->node = gm_calloc(xmlChildElementCount(variables) + 1, sizeof *list->node);
    if (!list->node)
        return no_memory(archive, error);
    for (xmlNode *node = variables->children; node; node = node->next)
        if (node->type == XML_ELEMENT_NODE)
            list->node[list->n++] = node;
    return GM_OK;
}

/* The variable that an attribute of node points to; NULL: it does not. */
static xmlNode *pointed_at(const index_list *list, xmlNode *node, const char *name)
{
    unsigned index = 0;
    char *text = gm_fmu_attribute(node, name);
    bool good = gm_fmu_read_reference(text, &index) && index >= 1 && index <= list->n;
    gm_free(text);
    return good ? list->node[index - 1] : NULL;
}

static bool reference_of(xmlNode *variable, unsigned *reference)
{
    char *text = gm_fmu_attribute(variable, "valueReference");
    bool good = gm_fmu_read_reference(text, reference);
    gm_free(text);
    return good;
}

static gm_status read_state(const index_list *list, xmlNode *unknown, const char *archive,
                            fmu_state *state, gm_error *error)
{
    xmlNode *rate = pointed_at(list, unknown, "index");
    xmlNode *real = rate ? gm_fmu_child(rate, "Real") : NULL;
    xmlNode *variable = real ? pointed_at(list, real, "derivative") : NULL;
    if (!variable || !reference_of(rate, &state->rate_reference) ||
        !reference_of(variable, &state->reference))
        return broken(archive, unknown, "a derivative that belongs to no state", error);
    state->name = gm_fmu_attribute(variable, "name");
    return state->name ? GM_OK : no_memory(archive, error);
}

static int state_at(const fmu_description *d, xmlNode *variable)
{
    unsigned reference = 0;
    if (!reference_of(variable, &reference))
        return -1;
    for (int i = 0; i < d->n_states; i++)
        if (d->states[i].reference == reference)
            return i;
    return -1;
}

/* Indices in the attribute that are states; inputs and parameters are passed over. */
static gm_status read_dependencies(const index_list *list, const fmu_description *d,
                                   xmlNode *unknown, const char *archive,
                                   fmu_state *state, gm_error *error)
{
    char *text = gm_fmu_attribute(unknown, "dependencies");
    state->n_dependencies = -1;
    if (!text)
        return GM_OK;
    state->dependencies = gm_calloc((size_t)d->n_states + 1, sizeof *state->dependencies);
    state->n_dependencies = 0;
    char *rest = text;
    for (char *word = strtok_r(text, " \t\r\n", &rest); word && state->dependencies;
         word = strtok_r(NULL, " \t\r\n", &rest)) {
        unsigned index = 0;
        int i = gm_fmu_read_reference(word, &index) && index >= 1 && index <= list->n
                    ? state_at(d, list->node[index - 1])
                    : -1;
        if (i >= 0 && state->n_dependencies < d->n_states)
            state->dependencies[state->n_dependencies++] = i;
    }
    gm_free(text);
    return state->dependencies ? GM_OK : no_memory(archive, error);
}

static gm_status read_states(const index_list *list, xmlNode *root, const char *archive,
                             fmu_description *d, gm_error *error)
{
    xmlNode *structure = gm_fmu_child(root, "ModelStructure");
    xmlNode *rates = structure ? gm_fmu_child(structure, "Derivatives") : NULL;
    if (!rates)
        return GM_OK;
    gm_status status = GM_OK;
    d->states = gm_calloc(xmlChildElementCount(rates) + 1, sizeof *d->states);
    if (!d->states)
        return no_memory(archive, error);
    for (xmlNode *u = rates->children; u && status == GM_OK; u = u->next)
        if (u->type == XML_ELEMENT_NODE)
            status = read_state(list, u, archive, &d->states[d->n_states++], error);
    int i = 0;
    for (xmlNode *u = rates->children; u && status == GM_OK; u = u->next)
        if (u->type == XML_ELEMENT_NODE)
            status = read_dependencies(list, d, u, archive, &d->states[i++], error);
    return status;
}

static bool is_true(xmlNode *node, const char *name)
{
    char *text = gm_fmu_attribute(node, name);
    bool yes = text && strcmp(text, "true") == 0;
    gm_free(text);
    return yes;
}

/* ---- FMI 3.0: by value references ---- */

static xmlNode *with_reference(const index_list *list, unsigned reference)
{
    unsigned found = 0;
    for (unsigned long i = 0; i < list->n; i++)
        if (reference_of(list->node[i], &found) && found == reference)
            return list->node[i];
    return NULL;
}

static xmlNode *referred_to(const index_list *list, xmlNode *node, const char *name)
{
    unsigned reference = 0;
    char *text = gm_fmu_attribute(node, name);
    bool good = gm_fmu_read_reference(text, &reference);
    gm_free(text);
    return good ? with_reference(list, reference) : NULL;
}

static bool is_named(const xmlNode *node, const char *name)
{
    return node->type == XML_ELEMENT_NODE && !xmlStrcmp(node->name, BAD_CAST name);
}

/* Dependencies are left open: on everything. */
static gm_status read_states_3(const index_list *list, xmlNode *root, const char *archive,
                               fmu_description *d, gm_error *error)
{
    xmlNode *structure = gm_fmu_child(root, "ModelStructure");
    if (!structure)
        return GM_OK;
    d->states = gm_calloc(xmlChildElementCount(structure) + 1, sizeof *d->states);
    if (!d->states)
        return no_memory(archive, error);
    for (xmlNode *u = structure->children; u; u = u->next) {
        d->n_indicators += is_named(u, "EventIndicator");
        if (!is_named(u, "ContinuousStateDerivative"))
            continue;
        fmu_state *state = &d->states[d->n_states++];
        xmlNode *rate = referred_to(list, u, "valueReference");
        xmlNode *variable = rate ? referred_to(list, rate, "derivative") : NULL;
        if (!variable || !reference_of(rate, &state->rate_reference) ||
            !reference_of(variable, &state->reference))
            return broken(archive, u, "a derivative that belongs to no state", error);
        state->n_dependencies = -1;
        state->name = gm_fmu_attribute(variable, "name");
        if (!state->name)
            return no_memory(archive, error);
    }
    return GM_OK;
}

gm_status gm_fmu_exchange_read(xmlNode *root, const char *archive, fmu_description *d,
                               gm_error *error)
{
    xmlNode *mode = gm_fmu_child(root, "ModelExchange");
    index_list list;
    unsigned n_indicators = 0;
    if (!mode)
        return GM_OK;
    d->exchange_identifier = gm_fmu_attribute(mode, "modelIdentifier");
    if (!gm_fmu_is_identifier(d->exchange_identifier))
        return broken(archive, mode, "Model Exchange without an identifier", error);
    d->directional = is_true(mode, "providesDirectionalDerivative");
    char *text = gm_fmu_attribute(root, "numberOfEventIndicators");
    if (text && (!gm_fmu_read_reference(text, &n_indicators) || n_indicators > 10000)) {
        gm_free(text);
        return broken(archive, root, "the number of event indicators is not one", error);
    }
    gm_free(text);
    d->n_indicators = (int)n_indicators;
    gm_status status = list_variables(root, archive, &list, error);
    if (status == GM_OK)
        status = d->version == 3 ? read_states_3(&list, root, archive, d, error)
                                 : read_states(&list, root, archive, d, error);
    gm_free(list.node);
    return status;
}
