/* SPDX-License-Identifier: BSD-2-Clause
 *
 * FMI 3.0 behind the calls of fmi_instance.h.
 */
#include "plant/fmi_instance.h"

#include "base/alloc.h"
#include "fmi3FunctionTypes.h"

#include <stdio.h>
#include <string.h>

#define COMMON(X)                                                                        \
    X(FreeInstance)                                                                      \
    X(EnterInitializationMode)                                                           \
    X(ExitInitializationMode)                                                            \
    X(SetFloat64)                                                                        \
    X(GetFloat64)                                                                        \
    X(SetFloat32)                                                                        \
    X(GetFloat32)                                                                        \
    X(SetInt8)                                                                           \
    X(GetInt8)                                                                           \
    X(SetUInt8)                                                                          \
    X(GetUInt8)                                                                          \
    X(SetInt16)                                                                          \
    X(GetInt16)                                                                          \
    X(SetUInt16)                                                                         \
    X(GetUInt16)                                                                         \
    X(SetInt32)                                                                          \
    X(GetInt32)                                                                          \
    X(SetUInt32)                                                                         \
    X(GetUInt32)                                                                         \
    X(SetInt64)                                                                          \
    X(GetInt64)                                                                          \
    X(SetUInt64)                                                                         \
    X(GetUInt64)                                                                         \
    X(SetBoolean)                                                                        \
    X(GetBoolean)
#define STEPS(X)                                                                         \
    X(InstantiateCoSimulation)                                                           \
    X(DoStep)
#define EXCHANGE(X)                                                                      \
    X(InstantiateModelExchange)                                                          \
    X(EnterEventMode)                                                                    \
    X(UpdateDiscreteStates)                                                              \
    X(EnterContinuousTimeMode)                                                           \
    X(CompletedIntegratorStep)                                                           \
    X(SetTime)                                                                           \
    X(SetContinuousStates)                                                               \
    X(GetContinuousStates)                                                               \
    X(GetNominalsOfContinuousStates)                                                     \
    X(GetContinuousStateDerivatives)                                                     \
    X(GetEventIndicators)

typedef struct functions {
#define FIELD(name) fmi3##name##TYPE *name;
    COMMON(FIELD) STEPS(FIELD) EXCHANGE(FIELD)
#undef FIELD
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
    if (!gm_fmi_find(it->library, "fmi3", #name, &f->name, sizeof f->name))              \
        return #name;
    COMMON(FIND)
    if (it->mode == FMI_STEPS) {
        STEPS(FIND)
        return NULL;
    }
    EXCHANGE(FIND)
#undef FIND
    return NULL;
}

static void keep(fmi3InstanceEnvironment environment, fmi3Status status,
                 fmi3String category, fmi3String message)
{
    fmi_instance *it = environment;
    (void)status;
    (void)category;
    (void)snprintf(it->message, sizeof it->message, "%s", message ? message : "");
}

static void *instantiate(fmi_instance *it, const char *folder)
{
    char place[320];
    const char *token = it->description->guid;
    (void)snprintf(place, sizeof place, "%s/resources/", folder);
    if (it->mode == FMI_EXCHANGE)
        return of(it)->InstantiateModelExchange("gearmap", token, place, fmi3False,
                                                fmi3False, it, keep);
    return of(it)->InstantiateCoSimulation("gearmap", token, place, fmi3False, fmi3False,
                                           fmi3False, fmi3False, NULL, 0, it, keep, NULL);
}

static void release(fmi_instance *it)
{
    of(it)->FreeInstance(it->component);
    it->component = NULL;
}

/* One case for each type of number. */
#define NUMBERS(X)                                                                       \
    X(FMU_REAL, Float64)                                                                 \
    X(FMU_FLOAT32, Float32)                                                              \
    X(FMU_INT8, Int8)                                                                    \
    X(FMU_UINT8, UInt8)                                                                  \
    X(FMU_INT16, Int16)                                                                  \
    X(FMU_UINT16, UInt16)                                                                \
    X(FMU_INTEGER, Int32)                                                                \
    X(FMU_UINT32, UInt32)                                                                \
    X(FMU_INT64, Int64)                                                                  \
    X(FMU_UINT64, UInt64)

static fmi_answer set(fmi_instance *it, fmu_kind kind, unsigned reference, double value)
{
    fmi3Boolean yes = value != 0.0;
#define CASE(which, type)                                                                \
    if (kind == which) {                                                                 \
        fmi3##type number = (fmi3##type)value;                                           \
        return (fmi_answer)of(it)->Set##type(it->component, &reference, 1, &number, 1);  \
    }
    NUMBERS(CASE)
#undef CASE
    return (fmi_answer)of(it)->SetBoolean(it->component, &reference, 1, &yes, 1);
}

static fmi_answer get(fmi_instance *it, fmu_kind kind, unsigned reference, double *value)
{
    fmi3Boolean yes = fmi3False;
#define CASE(which, type)                                                                \
    if (kind == which) {                                                                 \
        fmi3##type number = 0;                                                           \
        fmi_answer answer =                                                              \
            (fmi_answer)of(it)->Get##type(it->component, &reference, 1, &number, 1);     \
        *value = (double)number;                                                         \
        return answer;                                                                   \
    }
    NUMBERS(CASE)
#undef CASE
    fmi_answer answer =
        (fmi_answer)of(it)->GetBoolean(it->component, &reference, 1, &yes, 1);
    *value = yes;
    return answer;
}

static fmi_answer initialise(fmi_instance *it)
{
    return (fmi_answer)of(it)->EnterInitializationMode(it->component, fmi3False, 0.0, 0.0,
                                                       fmi3False, 0.0);
}

static fmi_answer begin(fmi_instance *it)
{
    return (fmi_answer)of(it)->ExitInitializationMode(it->component);
}

static fmi_answer step(fmi_instance *it, double t, double h)
{
    fmi3Boolean event = fmi3False, ended = fmi3False, early = fmi3False;
    fmi3Float64 last = t;
    fmi_answer answer = (fmi_answer)of(it)->DoStep(it->component, t, h, fmi3True, &event,
                                                   &ended, &early, &last);
    return answer <= FMI_WARNING && (ended || early) ? FMI_DISCARD : answer;
}

static fmi_answer to_events(fmi_instance *it)
{
    return (fmi_answer)of(it)->EnterEventMode(it->component);
}

static fmi_answer update(fmi_instance *it, int *again)
{
    fmi3Boolean more = fmi3False, ended = fmi3False, nominal = fmi3False;
    fmi3Boolean values = fmi3False, next = fmi3False;
    fmi3Float64 time = 0.0;
    fmi_answer answer = (fmi_answer)of(it)->UpdateDiscreteStates(
        it->component, &more, &ended, &nominal, &values, &next, &time);
    *again = more;
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
    return (fmi_answer)of(it)->GetContinuousStateDerivatives(it->component, dx,
                                                             (size_t)n);
}

static fmi_answer indicators(fmi_instance *it, double *g, int n)
{
    return (fmi_answer)of(it)->GetEventIndicators(it->component, g, (size_t)n);
}

static fmi_answer completed(fmi_instance *it, int *event)
{
    fmi3Boolean enter = fmi3False, ended = fmi3False;
    fmi_answer answer = (fmi_answer)of(it)->CompletedIntegratorStep(
        it->component, fmi3True, &enter, &ended);
    *event = enter;
    return answer;
}

const fmi_version gm_fmi_version_3 = {
    GM_FMI3_PLATFORM, load,       instantiate, release,   set,    get,
    initialise,       begin,      step,        to_events, update, to_continuous,
    set_time,         set_states, get_states,  nominals,  rates,  indicators,
    completed};
