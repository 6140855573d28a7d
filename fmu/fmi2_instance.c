/* SPDX-License-Identifier: BSD-2-Clause */
#include "fmi2_instance.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    unsigned bit;
} categories[] = {
    {"logStatusWarning", FMI2_LOG_WARNING},
    {"logStatusDiscard", FMI2_LOG_DISCARD},
    {"logStatusError", FMI2_LOG_ERROR},
    {"logEvents", FMI2_LOG_EVENTS},
    {"logAll", FMI2_LOG_ALL},
};
enum { N_CATEGORIES = sizeof categories / sizeof *categories };

unsigned fmi2_category_of(const char *name)
{
    for (int i = 0; name && i < N_CATEGORIES; i++)
        if (!strcmp(name, categories[i].name))
            return categories[i].bit;
    return 0;
}

static const char *category_name(unsigned bit)
{
    int i = 0;
    while (categories[i].bit != bit)
        i++;
    return categories[i].name;
}

/* '%' and '#' in a message have a meaning to loggers (FMI 2.0.3, section 2.1.5). */
static void defuse(char *text)
{
    for (; *text; text++)
        if (*text == '%' || *text == '#')
            *text = '?';
}

enum { MESSAGE_SIZE = 320 };

static void send(const fmi2_instance *instance, fmi2Status status, unsigned category,
                 char *text)
{
    if (!instance->host.logger || !(instance->logged & (category | FMI2_LOG_ALL)))
        return;
    defuse(text);
    instance->host.logger(instance->host.componentEnvironment, instance->name, status,
                          category_name(category), text);
}

void fmi2_log(const fmi2_instance *instance, fmi2Status status, fmi2_category category,
              const char *format, ...)
{
    char text[MESSAGE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    send(instance, status, category, text);
}

fmi2Status fmi2_fail(fmi2_instance *instance, const char *function, const char *format,
                     ...)
{
    char text[MESSAGE_SIZE];
    va_list arguments;
    int n = snprintf(text, sizeof text, "%s: ", function);
    va_start(arguments, format);
    vsnprintf(text + n, sizeof text - (size_t)n, format, arguments);
    va_end(arguments);
    send(instance, fmi2Error, FMI2_LOG_ERROR, text);
    instance->run.phase = GM_PHASE_ERROR;
    return fmi2Error;
}

static const char *phase_text(gm_phase phase)
{
    switch (phase) {
    case GM_PHASE_INSTANTIATED:
        return "the instance is not initialised yet";
    case GM_PHASE_INITIALISATION:
        return "the instance is in initialisation mode";
    case GM_PHASE_STEP:
        return "the instance is running";
    case GM_PHASE_STEP_FAILED:
        return "the last step was discarded";
    case GM_PHASE_EVENT:
        return "the instance is in event mode";
    case GM_PHASE_CONTINUOUS:
        return "the instance is in continuous-time mode";
    case GM_PHASE_TERMINATED:
        return "the simulation was terminated";
    case GM_PHASE_ERROR:
        break;
    }
    return "an earlier call failed";
}

fmi2_instance *fmi2_enter(fmi2Component c, const char *function, unsigned phases)
{
    fmi2_instance *instance = c;
    if (!instance)
        return NULL;
    if (instance->run.phase & phases)
        return instance;
    fmi2_fail(instance, function, "not allowed now: %s", phase_text(instance->run.phase));
    return NULL;
}

static fmi2_instance *enter_kind(fmi2Component c, const char *function, unsigned phases,
                                 bool exchange)
{
    fmi2_instance *instance = fmi2_enter(c, function, phases);
    if (!instance || instance->run.component.exchange == exchange)
        return instance;
    fmi2_fail(instance, function, "the instance is for %s",
              exchange ? "Co-Simulation" : "Model Exchange");
    return NULL;
}

fmi2_instance *fmi2_enter_exchange(fmi2Component c, const char *function, unsigned phases)
{
    return enter_kind(c, function, phases, true);
}

fmi2_instance *fmi2_enter_slave(fmi2Component c, const char *function, unsigned phases)
{
    return enter_kind(c, function, phases, false);
}

const char *fmi2_variable_name(gm_reference reference, char text[FMI2_NAME_SIZE])
{
    const gm_variable *v = &gm_variables[reference.id];
    if (v->scope == GM_SCOPE_PATH)
        snprintf(text, FMI2_NAME_SIZE, "%s.%s", gm_model_path_name(reference.path),
                 v->name);
    else
        snprintf(text, FMI2_NAME_SIZE, "%s", v->name);
    return text;
}
