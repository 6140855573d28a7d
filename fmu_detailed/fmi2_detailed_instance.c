/* SPDX-License-Identifier: BSD-2-Clause */
#include "fmi2_detailed.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    unsigned bit;
} categories[] = {
    {"logStatusWarning", LOG_WARNING},
    {"logStatusDiscard", LOG_DISCARD},
    {"logStatusError", LOG_ERROR},
    {"logEvents", LOG_EVENTS},
    {"logAll", LOG_ALL},
};
enum { N_CATEGORIES = sizeof categories / sizeof *categories, MESSAGE_SIZE = 1024 };

unsigned detailed_category_of(const char *name)
{
    for (int i = 0; name && i < N_CATEGORIES; i++)
        if (!strcmp(name, categories[i].name))
            return categories[i].bit;
    return 0;
}

/* '%' and '#' in a message have a meaning to loggers (FMI 2.0.3, section 2.1.5). */
static void send(const detailed_instance *f, fmi2Status status, unsigned category,
                 char *text)
{
    int i = 0;
    if (!f->host.logger || !(f->logged & (category | LOG_ALL)))
        return;
    for (char *c = text; *c; c++)
        if (*c == '%' || *c == '#')
            *c = '?';
    while (categories[i].bit != category)
        i++;
    f->host.logger(f->host.componentEnvironment, f->name, status, categories[i].name,
                   text);
}

fmi2Status detailed_log(const detailed_instance *f, fmi2Status status,
                        detailed_category category, const char *format, ...)
{
    char text[MESSAGE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    send(f, status, category, text);
    return status;
}

fmi2Status detailed_fail(detailed_instance *f, const char *function, const char *format,
                         ...)
{
    char text[MESSAGE_SIZE];
    va_list arguments;
    int n = snprintf(text, sizeof text, "%s: ", function);
    va_start(arguments, format);
    (void)vsnprintf(text + n, sizeof text - (size_t)n, format, arguments);
    va_end(arguments);
    send(f, fmi2Error, LOG_ERROR, text);
    f->phase = PHASE_ERROR;
    return fmi2Error;
}

static const char *phase_text(detailed_phase phase)
{
    switch (phase) {
    case PHASE_INSTANTIATED:
        return "the instance is not initialised yet";
    case PHASE_INITIALISATION:
        return "the instance is in initialisation mode";
    case PHASE_EVENT:
        return "the instance is in event mode";
    case PHASE_CONTINUOUS:
        return "the instance is in continuous-time mode";
    case PHASE_TERMINATED:
        return "the simulation was terminated";
    default:
        return "an earlier call failed";
    }
}

detailed_instance *detailed_enter(fmi2Component c, const char *function, unsigned phases)
{
    detailed_instance *f = c;
    if (!f || f->phase & phases)
        return f;
    (void)detailed_fail(f, function, "not allowed now: %s", phase_text(f->phase));
    return NULL;
}

detailed_instance *detailed_enter_array(fmi2Component c, const char *function,
                                        unsigned phases, const void *array, size_t n,
                                        int needed)
{
    detailed_instance *f = detailed_enter(c, function, phases);
    if (f && ((!array && needed > 0) || n != (size_t)needed)) {
        (void)detailed_fail(f, function, "an array of %d numbers is needed, not of %zu",
                            needed, array ? n : 0);
        return NULL;
    }
    return f;
}

fmi2Status detailed_report_gears(detailed_instance *f, const char *function)
{
    const gm_detailed *g = f->gearset;
    fmi2Status status = fmi2OK;
    for (int p = 0; p < g->n_paths; p++) {
        int command = (int)g->value[GM_PATH_GEAR][p];
        bool again = f->reported[p] && f->reported_gear[p] == command;
        f->reported[p] = g->refused[p];
        f->reported_gear[p] = command;
        if (!g->refused[p] || again)
            continue;
        status = detailed_log(f, fmi2Warning, LOG_WARNING,
                              "%s: %s.gear = %d: there is no such gear; the path keeps "
                              "the gear that was",
                              function, g->description->paths[p].id.name, command);
    }
    return status;
}

const char *detailed_name(const detailed_instance *f, gm_detailed_variable variable,
                          char text[DETAILED_NAME_SIZE])
{
    const gm_detailed *g = f->gearset;
    const gm_variable *v = &gm_variables[variable.reference.id];
    if (variable.inner >= 0)
        (void)snprintf(text, DETAILED_NAME_SIZE, "%s",
                       g->variables.all[variable.inner].name);
    else if (v->scope == GM_SCOPE_PATH)
        (void)snprintf(text, DETAILED_NAME_SIZE, "%s.%s",
                       g->description->paths[variable.reference.path].id.name, v->name);
    else
        (void)snprintf(text, DETAILED_NAME_SIZE, "%s", v->name);
    return text;
}

static const char *type_text(gm_type carrier)
{
    return carrier == GM_TYPE_REAL      ? "a Real"
           : carrier == GM_TYPE_INTEGER ? "an Integer"
                                        : "a Boolean";
}

fmi2Status detailed_find(detailed_instance *f, const char *function, unsigned vr,
                         gm_type carrier, gm_detailed_variable *variable)
{
    const gm_detailed *g = f->gearset;
    gm_type type = GM_TYPE_REAL;
    char name[DETAILED_NAME_SIZE];
    *variable = (gm_detailed_variable){.inner = -1};
    if (vr >= GM_MOTION_REFERENCES &&
        vr - GM_MOTION_REFERENCES < (unsigned)g->variables.n)
        variable->inner = (int)(vr - GM_MOTION_REFERENCES);
    else if (gm_variable_find(vr, g->n_paths, &variable->reference))
        type = gm_variable_carrier(gm_variables[variable->reference.id].type);
    else
        return detailed_fail(f, function, "there is no variable with value reference %u",
                             vr);
    if (type == carrier)
        return fmi2OK;
    return detailed_fail(f, function, "%s (value reference %u) is not %s variable",
                         detailed_name(f, *variable, name), vr, type_text(carrier));
}

fmi2Status detailed_start(detailed_instance *f, const char *function)
{
    gm_error error;
    if (gm_detailed_start(f->gearset, &error) == GM_OK)
        return fmi2OK;
    return detailed_fail(f, function, "no start: %s", error.message);
}
