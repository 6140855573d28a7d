/* SPDX-License-Identifier: BSD-2-Clause
 *
 * FMI 2.0 behind the calls of fmi_instance.h.
 */
#include "plant/fmi_instance.h"

#include "base/alloc.h"
#include "fmi2FunctionTypes.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#define COMMON(X)                                                                        \
    X(Instantiate)                                                                       \
    X(FreeInstance)                                                                      \
    X(SetupExperiment)                                                                   \
    X(EnterInitializationMode)                                                           \
    X(ExitInitializationMode)                                                            \
    X(SetReal)                                                                           \
    X(SetInteger)                                                                        \
    X(SetBoolean)                                                                        \
    X(GetReal)                                                                           \
    X(GetInteger)                                                                        \
    X(GetBoolean)
#define EXCHANGE(X)                                                                      \
    X(EnterEventMode)                                                                    \
    X(NewDiscreteStates)                                                                 \
    X(EnterContinuousTimeMode)                                                           \
    X(CompletedIntegratorStep)                                                           \
    X(SetTime)                                                                           \
    X(SetContinuousStates)                                                               \
    X(GetContinuousStates)                                                               \
    X(GetNominalsOfContinuousStates)                                                     \
    X(GetDerivatives)                                                                    \
    X(GetEventIndicators)

typedef struct functions {
#define FIELD(name) fmi2##name##TYPE *name;
    COMMON(FIELD)
    EXCHANGE(FIELD)
    FIELD(DoStep)
#undef FIELD
    fmi2CallbackFunctions callbacks;
} functions;

static functions *of(const fmi_instance *it)
{
    return it->functions;
}

static const char *load(fmi_instance *it)
{
    functions *f = it->functions = gm_calloc(1, sizeof *f);
    if (!f)
        return "Instantiate: out of memory";
#define FIND(name)                                                                       \
    if (!gm_fmi_find(it->library, "fmi2", #name, &f->name, sizeof f->name))              \
        return #name;
    COMMON(FIND)
    if (it->mode == FMI_STEPS) {
        FIND(DoStep)
        return NULL;
    }
    EXCHANGE(FIND)
#undef FIND
    return NULL;
}

static void keep(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status,
                 fmi2String category, fmi2String message, ...)
{
    fmi_instance *it = environment;
    va_list arguments;
    (void)name;
    (void)status;
    (void)category;
    va_start(arguments, message);
    (void)vsnprintf(it->message, sizeof it->message, message, arguments);
    va_end(arguments);
}

static void *instantiate(fmi_instance *it, const char *folder)
{
    char place[320];
    functions *f = of(it);
    (void)snprintf(place, sizeof place, "file://%s/resources", folder);
    f->callbacks = (fmi2CallbackFunctions){keep, calloc, free, NULL, it};
    return f->Instantiate(
        "gearmap", it->mode == FMI_STEPS ? fmi2CoSimulation : fmi2ModelExchange,
        it->description->guid, place, &f->callbacks, fmi2False, fmi2False);
}

static void release(fmi_instance *it)
{
    of(it)->FreeInstance(it->component);
    it->component = NULL;
}

static fmi_answer set(fmi_instance *it, fmu_kind kind, unsigned reference, double value)
{
    fmi2Integer whole = (fmi2Integer)value;
    fmi2Boolean yes = value != 0.0;
    if (kind == FMU_REAL)
        return (fmi_answer)of(it)->SetReal(it->component, &reference, 1, &value);
    if (kind == FMU_BOOLEAN)
        return (fmi_answer)of(it)->SetBoolean(it->component, &reference, 1, &yes);
    return (fmi_answer)of(it)->SetInteger(it->component, &reference, 1, &whole);
}

static fmi_answer get(fmi_instance *it, fmu_kind kind, unsigned reference, double *value)
{
    fmi2Integer whole = 0;
    fmi2Boolean yes = 0;
    fmi_answer answer;
    if (kind == FMU_REAL)
        return (fmi_answer)of(it)->GetReal(it->component, &reference, 1, value);
    if (kind == FMU_BOOLEAN) {
        answer = (fmi_answer)of(it)->GetBoolean(it->component, &reference, 1, &yes);
        *value = yes;
    } else {
        answer = (fmi_answer)of(it)->GetInteger(it->component, &reference, 1, &whole);
        *value = whole;
    }
    return answer;
}

static fmi_answer initialise(fmi_instance *it)
{
    fmi2Status status =
        of(it)->SetupExperiment(it->component, fmi2False, 0.0, 0.0, fmi2False, 0.0);
    if (status > fmi2Warning)
        return (fmi_answer)status;
    return (fmi_answer)of(it)->EnterInitializationMode(it->component);
}

static fmi_answer begin(fmi_instance *it)
{
    return (fmi_answer)of(it)->ExitInitializationMode(it->component);
}

static fmi_answer step(fmi_instance *it, double t, double h)
{
    return (fmi_answer)of(it)->DoStep(it->component, t, h, fmi2True);
}

static fmi_answer to_events(fmi_instance *it)
{
    return (fmi_answer)of(it)->EnterEventMode(it->component);
}

static fmi_answer update(fmi_instance *it, int *again)
{
    fmi2EventInfo info = {0};
    fmi_answer answer = (fmi_answer)of(it)->NewDiscreteStates(it->component, &info);
    *again = info.newDiscreteStatesNeeded != fmi2False;
    return answer;
}

static fmi_answer to_continuous(fmi_instance *it)
{
    return (fmi_answer)of(it)->EnterContinuousTimeMode(it->component);
}

static fmi_answer set_time(fmi_instance *it, double t)
{
    return (fmi_answer)of(it)->SetTime(it->component, t);
}

static fmi_answer set_states(fmi_instance *it, const double *x, int n)
{
    return (fmi_answer)of(it)->SetContinuousStates(it->component, x, (size_t)n);
}

static fmi_answer get_states(fmi_instance *it, double *x, int n)
{
    return (fmi_answer)of(it)->GetContinuousStates(it->component, x, (size_t)n);
}

static fmi_answer nominals(fmi_instance *it, double *nominal, int n)
{
    return (fmi_answer)of(it)->GetNominalsOfContinuousStates(it->component, nominal,
                                                             (size_t)n);
}

static fmi_answer rates(fmi_instance *it, double *dx, int n)
{
    return (fmi_answer)of(it)->GetDerivatives(it->component, dx, (size_t)n);
}

static fmi_answer indicators(fmi_instance *it, double *g, int n)
{
    return (fmi_answer)of(it)->GetEventIndicators(it->component, g, (size_t)n);
}

static fmi_answer completed(fmi_instance *it, int *event)
{
    fmi2Boolean enter = fmi2False, ended = fmi2False;
    fmi_answer answer = (fmi_answer)of(it)->CompletedIntegratorStep(
        it->component, fmi2True, &enter, &ended);
    *event = enter != fmi2False;
    return answer;
}

const fmi_version gm_fmi_version_2 = {
    GM_FMI2_PLATFORM, load,       instantiate, release,   set,    get,
    initialise,       begin,      step,        to_events, update, to_continuous,
    set_time,         set_states, get_states,  nominals,  rates,  indicators,
    completed};
