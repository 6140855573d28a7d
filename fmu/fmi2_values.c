/* SPDX-License-Identifier: BSD-2-Clause
 *
 * FMI 2.0: values of variables and their derivatives, all as loops over the table of
 * variables (FMI 2.0.3, sections 2.1.7 and 4.2.1).
 */
#include "fmi2_instance.h"

static const char *type_text(gm_type carrier)
{
    return carrier == GM_TYPE_REAL      ? "a Real"
           : carrier == GM_TYPE_INTEGER ? "an Integer"
                                        : "a Boolean";
}

static fmi2Status refuse_reference(fmi2_instance *f, const char *function,
                                   gm_verdict verdict, unsigned vr, gm_type carrier,
                                   gm_reference reference)
{
    char name[FMI2_NAME_SIZE];
    if (verdict == GM_VERDICT_UNKNOWN)
        return fmi2_fail(f, function, "there is no variable with value reference %u", vr);
    return fmi2_fail(f, function, "%s (value reference %u) is not %s variable",
                     fmi2_variable_name(reference, name), vr, type_text(carrier));
}

static fmi2Status refuse_value(fmi2_instance *f, const char *function, gm_verdict verdict,
                               gm_reference reference, gm_value value)
{
    const gm_variable *v = &gm_variables[reference.id];
    char name[FMI2_NAME_SIZE];
    double x = v->type == GM_TYPE_REAL ? value.real : value.integer;
    double min = gm_interface_min(gm_model_map(), reference);
    fmi2_variable_name(reference, name);
    switch (verdict) {
    case GM_VERDICT_READ_ONLY:
        return fmi2_fail(f, function, "%s is an output and cannot be set (to %g)", name,
                         x);
    case GM_VERDICT_PHASE:
        return fmi2_fail(f, function, "%s cannot be set (to %g) %s", name, x,
                         f->run.phase == GM_PHASE_CONTINUOUS &&
                                 v->variability != GM_VARIABILITY_FIXED
                             ? "between events"
                             : "after initialisation");
    case GM_VERDICT_RANGE:
        if (v->max < GM_FREE)
            return fmi2_fail(f, function, "%s = %g is not within %g to %g", name, x, min,
                             v->max);
        return fmi2_fail(f, function, "%s = %g is smaller than %g", name, x, min);
    default:
        return fmi2_fail(f, function, "%s = %g is not a finite number", name, x);
    }
}

static fmi2Status set_one(fmi2_instance *f, const char *function, gm_type carrier,
                          unsigned vr, gm_value value)
{
    gm_reference reference;
    gm_verdict verdict = gm_run_find(gm_model_map(), vr, carrier, &reference);
    if (verdict)
        return refuse_reference(f, function, verdict, vr, carrier, reference);
    verdict = gm_run_set(gm_model_map(), &f->run, reference, value);
    return verdict ? refuse_value(f, function, verdict, reference, value) : fmi2OK;
}

static fmi2Status get_one(fmi2_instance *f, const char *function, gm_type carrier,
                          unsigned vr, gm_value *value)
{
    gm_reference reference;
    char name[FMI2_NAME_SIZE];
    gm_verdict verdict = gm_run_find(gm_model_map(), vr, carrier, &reference);
    if (verdict)
        return refuse_reference(f, function, verdict, vr, carrier, reference);
    if (gm_run_get(gm_model_map(), &f->run, reference, value))
        return fmi2_fail(f, function, "%s overflowed: the inputs are too large",
                         fmi2_variable_name(reference, name));
    return fmi2OK;
}

/* f if it and its arrays are there; NULL after a message. */
static fmi2_instance *with_arrays(fmi2_instance *f, const char *function, size_t n,
                                  const void *vr, const void *value)
{
    if (f && n > 0 && (!vr || !value)) {
        fmi2_fail(f, function, "an array of %lu items is missing", (unsigned long)n);
        return NULL;
    }
    return f;
}

static fmi2_instance *enter(fmi2Component c, const char *function, unsigned phases,
                            size_t n, const void *vr, const void *value)
{
    return with_arrays(fmi2_enter(c, function, phases), function, n, vr, value);
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                       fmi2Real value[])
{
    fmi2_instance *f = enter(c, "fmi2GetReal", FMI2_PHASES_GET, nvr, vr, value);
    fmi2Status status = f ? fmi2OK : fmi2Error;
    for (size_t i = 0; i < nvr && status == fmi2OK; i++) {
        gm_value x;
        status = get_one(f, "fmi2GetReal", GM_TYPE_REAL, vr[i], &x);
        if (status == fmi2OK)
            value[i] = x.real;
    }
    return status;
}

static fmi2Status get_integers(fmi2Component c, const char *function, gm_type carrier,
                               const fmi2ValueReference vr[], size_t nvr, int value[])
{
    fmi2_instance *f = enter(c, function, FMI2_PHASES_GET, nvr, vr, value);
    fmi2Status status = f ? fmi2OK : fmi2Error;
    for (size_t i = 0; i < nvr && status == fmi2OK; i++) {
        gm_value x;
        status = get_one(f, function, carrier, vr[i], &x);
        if (status == fmi2OK)
            value[i] = x.integer;
    }
    return status;
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                          fmi2Integer value[])
{
    return get_integers(c, "fmi2GetInteger", GM_TYPE_INTEGER, vr, nvr, value);
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                          fmi2Boolean value[])
{
    return get_integers(c, "fmi2GetBoolean", GM_TYPE_BOOLEAN, vr, nvr, value);
}

/* There are no String variables: any reference is of another type, or none. */
static fmi2Status no_strings(fmi2Component c, const char *function, unsigned phases,
                             const fmi2ValueReference vr[], size_t nvr, const void *value)
{
    fmi2_instance *f = enter(c, function, phases, nvr, vr, value);
    if (!f)
        return fmi2Error;
    if (nvr > 0)
        return fmi2_fail(f, function, "value reference %u is not a String variable",
                         vr[0]);
    return fmi2OK;
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                         fmi2String value[])
{
    return no_strings(c, "fmi2GetString", FMI2_PHASES_GET, vr, nvr, value);
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                       const fmi2Real value[])
{
    fmi2_instance *f = enter(c, "fmi2SetReal", FMI2_PHASES_SET, nvr, vr, value);
    fmi2Status status = f ? fmi2OK : fmi2Error;
    for (size_t i = 0; i < nvr && status == fmi2OK; i++)
        status =
            set_one(f, "fmi2SetReal", GM_TYPE_REAL, vr[i], (gm_value){.real = value[i]});
    return status;
}

static fmi2Status set_integers(fmi2Component c, const char *function, gm_type carrier,
                               const fmi2ValueReference vr[], size_t nvr,
                               const int value[])
{
    fmi2_instance *f = enter(c, function, FMI2_PHASES_SET, nvr, vr, value);
    fmi2Status status = f ? fmi2OK : fmi2Error;
    for (size_t i = 0; i < nvr && status == fmi2OK; i++)
        status = set_one(f, function, carrier, vr[i], (gm_value){.integer = value[i]});
    return status;
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                          const fmi2Integer value[])
{
    return set_integers(c, "fmi2SetInteger", GM_TYPE_INTEGER, vr, nvr, value);
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                          const fmi2Boolean value[])
{
    return set_integers(c, "fmi2SetBoolean", GM_TYPE_BOOLEAN, vr, nvr, value);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                         const fmi2String value[])
{
    return no_strings(c, "fmi2SetString", FMI2_PHASES_SET, vr, nvr, value);
}

static fmi2Status set_rate(fmi2_instance *f, unsigned vr, int order, double rate)
{
    static const char function[] = "fmi2SetRealInputDerivatives";
    gm_reference reference;
    char name[FMI2_NAME_SIZE];
    gm_verdict verdict = gm_run_find(gm_model_map(), vr, GM_TYPE_REAL, &reference);
    if (verdict)
        return refuse_reference(f, function, verdict, vr, GM_TYPE_REAL, reference);
    fmi2_variable_name(reference, name);
    if (order != 1)
        return fmi2_fail(f, function, "%s: derivatives of order %d are not used, only 1",
                         name, order);
    if (!gm_number_is_finite(rate))
        return fmi2_fail(f, function, "derivative %g of %s is not a finite number", rate,
                         name);
    if (gm_interface_causality(gm_model_map(), reference) != GM_CAUSALITY_INPUT)
        return fmi2_fail(f, function, "%s is not an input", name);
    gm_component_set_rate(&f->run.component, reference, rate);
    return fmi2OK;
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[],
                                       size_t nvr, const fmi2Integer order[],
                                       const fmi2Real value[])
{
    static const char function[] = "fmi2SetRealInputDerivatives";
    fmi2_instance *f = with_arrays(fmi2_enter_slave(c, function, FMI2_PHASES_SET_RATE),
                                   function, nvr, vr, value);
    if (f && nvr > 0 && !order)
        return fmi2_fail(f, function, "the array of orders is missing");
    fmi2Status status = f ? fmi2OK : fmi2Error;
    for (size_t i = 0; i < nvr && status == fmi2OK; i++)
        status = set_rate(f, vr[i], order[i], value[i]);
    return status;
}

/* Discard, not Error: the simulation can go on without this derivative. */
static fmi2Status get_rate(fmi2_instance *f, unsigned vr, int order, double *rate)
{
    static const char function[] = "fmi2GetRealOutputDerivatives";
    gm_reference reference;
    char name[FMI2_NAME_SIZE];
    gm_verdict verdict = gm_run_find(gm_model_map(), vr, GM_TYPE_REAL, &reference);
    if (verdict)
        return refuse_reference(f, function, verdict, vr, GM_TYPE_REAL, reference);
    fmi2_variable_name(reference, name);
    if (gm_interface_causality(gm_model_map(), reference) != GM_CAUSALITY_OUTPUT)
        return fmi2_fail(f, function, "%s is not an output", name);
    if (order == 1 && gm_run_rate(gm_model_map(), &f->run, reference, rate) == 0)
        return fmi2OK;
    fmi2_log(f, fmi2Discard, FMI2_LOG_DISCARD,
             "%s: the derivative of order %d of %s is "
             "not available",
             function, order, name);
    return fmi2Discard;
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[],
                                        size_t nvr, const fmi2Integer order[],
                                        fmi2Real value[])
{
    static const char function[] = "fmi2GetRealOutputDerivatives";
    fmi2_instance *f = with_arrays(fmi2_enter_slave(c, function, FMI2_PHASES_AFTER),
                                   function, nvr, vr, value);
    if (f && nvr > 0 && !order)
        return fmi2_fail(f, function, "the array of orders is missing");
    fmi2Status status = f ? fmi2OK : fmi2Error;
    for (size_t i = 0; i < nvr && status == fmi2OK; i++)
        status = get_rate(f, vr[i], order[i], &value[i]);
    return status;
}
