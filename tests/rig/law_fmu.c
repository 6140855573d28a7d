/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A gearset of law.h as an FMU of somebody else: LAW_FMI 2 or 3, both interfaces (the
 * modelDescription offers one or both), LAW_VARIANT, units and signs of its own with
 * LAW_ODD_UNITS (rpm, kN.m out of the flange, degC). LAW_TROUBLE adds what models do
 * when they fail: above 400 rad/s of the input, in gear 2, with negative torque
 *   1 crash, 2 hang, 3 not a number, 4 Error, 5 Discard.
 *
 * Value references: input of flange f 0 + f, its answer 10 + f, gear of path p 20 + p,
 * temperature 30, state i 40 + i, its rate 60 + i.
 */
#include "law.h"

#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#if LAW_FMI == 3
#include "fmi3Functions.h"
#define OK fmi3OK
typedef fmi3Status status;
typedef fmi3Float64 real;
#else
#include "fmi2Functions.h"
#define OK fmi2OK
typedef fmi2Status status;
typedef fmi2Real real;
#endif

#ifndef LAW_TROUBLE
#define LAW_TROUBLE 0
#endif

#ifdef LAW_ODD_UNITS
static const double speed_unit = 3.14159265358979323846 / 30.0, torque_unit = -1e3;
static const double zero_temperature = 273.15;
#else
static const double speed_unit = 1.0, torque_unit = 1.0, zero_temperature = 0.0;
#endif

typedef struct instance {
    law_run run;
    double time;
} instance;

static void *made(const char *token)
{
    instance *it = calloc(1, sizeof *it);
    if (!it || strcmp(token, LAW_TOKEN) != 0) {
        free(it);
        return NULL;
    }
    law_start(&it->run, LAW_VARIANT);
    return it;
}

static int in_trouble(const instance *it)
{
    return LAW_TROUBLE && it->run.gear[0] == 2 && it->run.input[1] < 0.0 &&
           fabs(it->run.x[1]) > 400.0;
}

static status trouble(instance *it)
{
    if (LAW_TROUBLE == 1)
        raise(SIGSEGV);
    for (volatile int forever = LAW_TROUBLE == 2; forever;)
        continue;
    if (LAW_TROUBLE == 3)
        it->run.x[0] = (double)NAN;
    return LAW_TROUBLE == 3 ? OK : (status)(LAW_TROUBLE == 4 ? 3 : 2);
}

static double unit_of(const instance *it, int flange, int answer)
{
    return it->run.of.speed_in[flange] != answer ? speed_unit : torque_unit;
}

static int set(instance *it, unsigned reference, double value)
{
    if (reference < 3)
        it->run.input[reference] = value * unit_of(it, (int)reference, 0);
    else if (reference == 30)
        it->run.temperature = value + zero_temperature;
    else
        return 0;
    return 1;
}

static double get(instance *it, unsigned reference)
{
    double rate[LAW_STATES];
    int flange = (int)reference - 10;
    if (reference >= 60) {
        law_rates(&it->run, it->run.x, rate);
        return rate[reference - 60];
    }
    if (reference >= 40)
        return it->run.x[reference - 40];
    double answer = it->run.of.speed_in[flange] ? law_torque(&it->run, it->run.x, flange)
                                                : law_speed(&it->run, it->run.x, flange);
    return answer / unit_of(it, flange, 1);
}

#if LAW_FMI == 3
typedef fmi3Instance component;
#define REFERENCES const fmi3ValueReference r[], size_t n
#define VALUES(type) const fmi3##type v[], size_t m
#define ANSWERS(type) fmi3##type v[], size_t m
#define API FMI3_Export
#else
typedef fmi2Component component;
#define REFERENCES const fmi2ValueReference r[], size_t n
#define VALUES(type) const fmi2##type v[]
#define ANSWERS(type) fmi2##type v[]
#define API FMI2_Export
#endif

static status set_reals(component c, const unsigned *r, size_t n, const double *v)
{
    for (size_t i = 0; i < n; i++)
        if (!set(c, r[i], v[i]))
            return (status)3;
    return OK;
}

static status get_reals(component c, const unsigned *r, size_t n, double *v)
{
    for (size_t i = 0; i < n; i++)
        v[i] = get(c, r[i]);
    return OK;
}

static status set_gears(component c, const unsigned *r, size_t n, const int *v)
{
    instance *it = c;
    for (size_t i = 0; i < n; i++)
        it->run.gear[r[i] - 20] = v[i];
    return OK;
}

static status do_step(component c, double h)
{
    instance *it = c;
    law_step(&it->run, h);
    it->time += h;
    return in_trouble(it) ? trouble(it) : OK;
}

static status rates(component c, double *dx, size_t n)
{
    instance *it = c;
    double all[LAW_STATES];
    law_rates(&it->run, it->run.x, all);
    memcpy(dx, all, n * sizeof *dx);
    return in_trouble(it) ? trouble(it) : OK;
}

static status states(double *to, const double *from, size_t n)
{
    memcpy(to, from, n * sizeof *to);
    return OK;
}

static status ones(double *nominal, size_t n)
{
    for (size_t i = 0; i < n; i++)
        nominal[i] = i < 3 ? 100.0 : 0.01;
    return OK;
}

#define X(c) (((instance *)(c))->run.x)

#if LAW_FMI == 3
API fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name, fmi3String token, fmi3String path, fmi3Boolean visible,
    fmi3Boolean logging, fmi3Boolean events, fmi3Boolean early,
    const fmi3ValueReference needed[], size_t n, fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update)
{
    (void)name, (void)path, (void)visible, (void)logging, (void)events, (void)early;
    (void)needed, (void)n, (void)environment, (void)log, (void)update;
    return made(token);
}
API fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token,
                                              fmi3String path, fmi3Boolean visible,
                                              fmi3Boolean logging,
                                              fmi3InstanceEnvironment environment,
                                              fmi3LogMessageCallback log)
{
    (void)name, (void)path, (void)visible, (void)logging, (void)environment, (void)log;
    return made(token);
}
API fmi3Status fmi3EnterInitializationMode(component c, fmi3Boolean a, fmi3Float64 b,
                                           fmi3Float64 t, fmi3Boolean d, fmi3Float64 e)
{
    (void)c, (void)a, (void)b, (void)t, (void)d, (void)e;
    return OK;
}
API fmi3Status fmi3DoStep(component c, fmi3Float64 t, fmi3Float64 h, fmi3Boolean a,
                          fmi3Boolean *event, fmi3Boolean *end, fmi3Boolean *early,
                          fmi3Float64 *last)
{
    (void)a;
    *event = *end = *early = fmi3False;
    *last = t + h;
    return do_step(c, h);
}
API fmi3Status fmi3UpdateDiscreteStates(component c, fmi3Boolean *more, fmi3Boolean *end,
                                        fmi3Boolean *nominals, fmi3Boolean *values,
                                        fmi3Boolean *next, fmi3Float64 *time)
{
    (void)c, (void)time;
    *more = *end = *nominals = *values = *next = fmi3False;
    return OK;
}
API fmi3Status fmi3CompletedIntegratorStep(component c, fmi3Boolean a, fmi3Boolean *event,
                                           fmi3Boolean *end)
{
    (void)c, (void)a;
    *event = *end = fmi3False;
    return OK;
}
API fmi3Status fmi3GetContinuousStateDerivatives(component c, fmi3Float64 dx[], size_t n)
{
    return rates(c, dx, n);
}
#define INTEGERS(type)                                                                   \
    API fmi3Status fmi3Set##type(component c, REFERENCES, VALUES(type))                  \
    {                                                                                    \
        (void)m;                                                                         \
        int value[2] = {0, 0};                                                           \
        for (size_t i = 0; i < n && i < 2; i++)                                          \
            value[i] = (int)v[i];                                                        \
        return set_gears(c, r, n, value);                                                \
    }                                                                                    \
    API fmi3Status fmi3Get##type(component c, REFERENCES, ANSWERS(type))                 \
    {                                                                                    \
        (void)m;                                                                         \
        for (size_t i = 0; i < n; i++)                                                   \
            v[i] = (fmi3##type)((instance *)c)->run.gear[r[i] - 20];                     \
        return OK;                                                                       \
    }
INTEGERS(Float32)
INTEGERS(Int8)
INTEGERS(UInt8)
INTEGERS(Int16)
INTEGERS(UInt16)
INTEGERS(Int32)
INTEGERS(UInt32)
INTEGERS(Int64)
INTEGERS(UInt64)
INTEGERS(Boolean)
#else
API component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String token,
                              fmi2String path, const fmi2CallbackFunctions *callbacks,
                              fmi2Boolean visible, fmi2Boolean logging)
{
    (void)name, (void)type, (void)path, (void)visible, (void)logging;
    void *c = made(token);
    if (!c)
        callbacks->logger(callbacks->componentEnvironment, name, fmi2Error, "error",
                          "the GUID is %s here", LAW_TOKEN);
    return c;
}
API fmi2Status fmi2SetupExperiment(component c, fmi2Boolean a, fmi2Real b, fmi2Real t,
                                   fmi2Boolean d, fmi2Real e)
{
    (void)c, (void)a, (void)b, (void)t, (void)d, (void)e;
    return OK;
}
API fmi2Status fmi2EnterInitializationMode(component c)
{
    (void)c;
    return OK;
}
API fmi2Status fmi2DoStep(component c, fmi2Real t, fmi2Real h, fmi2Boolean a)
{
    (void)t, (void)a;
    return do_step(c, h);
}
API fmi2Status fmi2NewDiscreteStates(component c, fmi2EventInfo *info)
{
    (void)c;
    memset(info, 0, sizeof *info);
    return OK;
}
API fmi2Status fmi2CompletedIntegratorStep(component c, fmi2Boolean a, fmi2Boolean *event,
                                           fmi2Boolean *end)
{
    (void)c, (void)a;
    *event = *end = fmi2False;
    return OK;
}
API fmi2Status fmi2GetDerivatives(component c, fmi2Real dx[], size_t n)
{
    return rates(c, dx, n);
}
API fmi2Status fmi2SetInteger(component c, REFERENCES, VALUES(Integer))
{
    return set_gears(c, r, n, v);
}
API fmi2Status fmi2GetInteger(component c, REFERENCES, ANSWERS(Integer))
{
    for (size_t i = 0; i < n; i++)
        v[i] = ((instance *)c)->run.gear[r[i] - 20];
    return OK;
}
API fmi2Status fmi2SetBoolean(component c, REFERENCES, VALUES(Boolean))
{
    return set_gears(c, r, n, v);
}
API fmi2Status fmi2GetBoolean(component c, REFERENCES, ANSWERS(Boolean))
{
    return fmi2GetInteger(c, r, n, v);
}
#endif

#define JOINED(a, b) a##b
#define CALL(prefix, name) JOINED(prefix, name)
#if LAW_FMI == 3
#define F(name) CALL(fmi3, name)
API status fmi3SetFloat64(component c, REFERENCES, VALUES(Float64))
{
    (void)m;
    return set_reals(c, r, n, v);
}
API status fmi3GetFloat64(component c, REFERENCES, ANSWERS(Float64))
{
    (void)m;
    return get_reals(c, r, n, v);
}
#else
#define F(name) CALL(fmi2, name)
API status fmi2SetReal(component c, REFERENCES, VALUES(Real))
{
    return set_reals(c, r, n, v);
}
API status fmi2GetReal(component c, REFERENCES, ANSWERS(Real))
{
    return get_reals(c, r, n, v);
}
#endif

API void F(FreeInstance)(component c)
{
    free(c);
}
API status F(ExitInitializationMode)(component c)
{
    (void)c;
    return OK;
}
API status F(EnterEventMode)(component c)
{
    (void)c;
    return OK;
}
API status F(EnterContinuousTimeMode)(component c)
{
    (void)c;
    return OK;
}
API status F(SetTime)(component c, real t)
{
    ((instance *)c)->time = t;
    return OK;
}
API status F(SetContinuousStates)(component c, const real x[], size_t n)
{
    return states(X(c), x, n);
}
API status F(GetContinuousStates)(component c, real x[], size_t n)
{
    return states(x, X(c), n);
}
API status F(GetNominalsOfContinuousStates)(component c, real x[], size_t n)
{
    (void)c;
    return ones(x, n);
}
API status F(GetEventIndicators)(component c, real g[], size_t n)
{
    (void)c, (void)g, (void)n;
    return OK;
}
