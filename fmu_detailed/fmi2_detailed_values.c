/* SPDX-License-Identifier: BSD-2-Clause
 *
 * FMI 2.0: values of variables and directional derivatives (FMI 2.0.3, sections 2.1.7 and
 * 2.1.9).
 */
#include "fmi2_detailed.h"

#include <string.h>

static bool is_finite(double x)
{
    return x - x == 0.0;
}

/* Instance with its arrays, or NULL after a message. */
static detailed_instance *enter(fmi2Component c, const char *function, unsigned phases,
                                size_t n, const void *vr, const void *value)
{
    detailed_instance *f = detailed_enter(c, function, phases);
    if (f && n > 0 && (!vr || !value)) {
        (void)detailed_fail(f, function, "an array of %zu items is missing", n);
        return NULL;
    }
    return f;
}

/* ---- get ---- */

static fmi2Status get_one(detailed_instance *f, const char *function, gm_type carrier,
                          unsigned vr, double *value)
{
    gm_detailed_variable v;
    char name[DETAILED_NAME_SIZE];
    fmi2Status status = detailed_find(f, function, vr, carrier, &v);
    if (status == fmi2OK && f->phase == PHASE_INITIALISATION)
        status = detailed_start(f, function);
    if (status == fmi2OK && !gm_detailed_value_of(f->gearset, v, value))
        return detailed_fail(f, function,
                             "%s is not finite: inputs or states are too large",
                             detailed_name(f, v, name));
    return status;
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                       fmi2Real value[])
{
    detailed_instance *f = enter(c, "fmi2GetReal", PHASES_GET, nvr, vr, value);
    fmi2Status status = f ? fmi2OK : fmi2Error;
    for (size_t i = 0; i < nvr && status == fmi2OK; i++)
        status = get_one(f, "fmi2GetReal", GM_TYPE_REAL, vr[i], &value[i]);
    return status;
}

static fmi2Status get_integers(fmi2Component c, const char *function, gm_type carrier,
                               const fmi2ValueReference vr[], size_t nvr, int value[])
{
    detailed_instance *f = enter(c, function, PHASES_GET, nvr, vr, value);
    fmi2Status status = f ? fmi2OK : fmi2Error;
    for (size_t i = 0; i < nvr && status == fmi2OK; i++) {
        double got = 0.0;
        status = get_one(f, function, carrier, vr[i], &got);
        if (status == fmi2OK)
            value[i] = (int)got;
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

/* ---- set ---- */

/* Before the run everything with a start value, during it inputs and, at events, tunable
 * parameters. Gears are let pass between events: a command that the next event reads. */
static bool is_settable(const gm_variable *v, gm_variable_id id, detailed_phase phase)
{
    if (v->causality == GM_CAUSALITY_INPUT)
        return true;
    if (v->initial != GM_INITIAL_EXACT || id == GM_PATH_TWIST)
        return false;
    return phase & (PHASE_INSTANTIATED | PHASE_INITIALISATION) ||
           (v->variability == GM_VARIABILITY_TUNABLE && phase == PHASE_EVENT);
}

static fmi2Status set_one(detailed_instance *f, const char *function, gm_type carrier,
                          unsigned vr, double value)
{
    gm_detailed_variable at;
    char name[DETAILED_NAME_SIZE];
    if (detailed_find(f, function, vr, carrier, &at))
        return fmi2Error;
    const gm_variable *v = &gm_variables[at.reference.id];
    (void)detailed_name(f, at, name);
    if (at.inner >= 0 || !is_settable(v, at.reference.id, f->phase))
        return detailed_fail(f, function, "%s cannot be set (to %g) now", name, value);
    if (!is_finite(value))
        return detailed_fail(f, function, "%s = %g is not a finite number", name, value);
    if ((v->min > -GM_FREE && value < v->min) || (v->max < GM_FREE && value > v->max))
        return detailed_fail(f, function, "%s = %g is out of its range", name, value);
    gm_detailed_set(f->gearset, at.reference, value);
    f->update_due = true;
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                       const fmi2Real value[])
{
    detailed_instance *f = enter(c, "fmi2SetReal", PHASES_SET, nvr, vr, value);
    fmi2Status status = f ? fmi2OK : fmi2Error;
    for (size_t i = 0; i < nvr && status == fmi2OK; i++)
        status = set_one(f, "fmi2SetReal", GM_TYPE_REAL, vr[i], value[i]);
    return status;
}

static fmi2Status set_integers(fmi2Component c, const char *function, gm_type carrier,
                               const fmi2ValueReference vr[], size_t nvr,
                               const int value[])
{
    detailed_instance *f = enter(c, function, PHASES_SET, nvr, vr, value);
    fmi2Status status = f ? fmi2OK : fmi2Error;
    for (size_t i = 0; i < nvr && status == fmi2OK; i++)
        status = set_one(f, function, carrier, vr[i], value[i]);
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

/* ---- strings: there are none ---- */

static fmi2Status no_strings(detailed_instance *f, const char *function,
                             const fmi2ValueReference vr[], size_t nvr)
{
    if (!f)
        return fmi2Error;
    if (nvr > 0)
        return detailed_fail(f, function, "value reference %u is not a String variable",
                             vr[0]);
    return fmi2OK;
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                         fmi2String value[])
{
    static const char function[] = "fmi2GetString";
    return no_strings(enter(c, function, PHASES_GET, nvr, vr, value), function, vr, nvr);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                         const fmi2String value[])
{
    static const char function[] = "fmi2SetString";
    return no_strings(enter(c, function, PHASES_SET, nvr, vr, value), function, vr, nvr);
}

/* ---- derivatives ---- */

static fmi2Status take_known(detailed_instance *f, const char *function, unsigned vr,
                             double rate, gm_detailed_direction *direction)
{
    gm_detailed_variable v;
    char name[DETAILED_NAME_SIZE];
    if (detailed_find(f, function, vr, GM_TYPE_REAL, &v))
        return fmi2Error;
    if (!is_finite(rate))
        return detailed_fail(f, function, "the rate %g of %s is not a finite number",
                             rate, detailed_name(f, v, name));
    if (gm_detailed_add_known(f->gearset, v, rate, direction))
        return fmi2OK;
    return detailed_fail(f, function, "%s is neither an input nor a %s",
                         detailed_name(f, v, name),
                         direction->initial ? "start value" : "state");
}

static fmi2Status take_unknown(detailed_instance *f, const char *function, unsigned vr,
                               gm_detailed_variable *v)
{
    char name[DETAILED_NAME_SIZE];
    if (detailed_find(f, function, vr, GM_TYPE_REAL, v))
        return fmi2Error;
    if (v->inner >= 0 || gm_variables[v->reference.id].causality == GM_CAUSALITY_OUTPUT)
        return fmi2OK;
    return detailed_fail(f, function, "%s is not an output", detailed_name(f, *v, name));
}

static fmi2Status directional(detailed_instance *f, const fmi2ValueReference unknown[],
                              int n, const gm_detailed_direction *direction,
                              double derivative[])
{
    static const char function[] = "fmi2GetDirectionalDerivative";
    for (int i = 0; i < n; i++)
        if (take_unknown(f, function, unknown[i], &f->unknown[i]))
            return fmi2Error;
    if (direction->initial && detailed_start(f, function))
        return fmi2Error;
    if (gm_detailed_follow(f->gearset, direction, n, f->unknown, derivative))
        return fmi2OK;
    return detailed_log(f, fmi2Discard, LOG_DISCARD, "%s: numbers overflowed at %g s",
                        function, f->time);
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c,
                                        const fmi2ValueReference vUnknown_ref[],
                                        size_t nUnknown,
                                        const fmi2ValueReference vKnown_ref[],
                                        size_t nKnown, const fmi2Real dvKnown[],
                                        fmi2Real dvUnknown[])
{
    static const char function[] = "fmi2GetDirectionalDerivative";
    detailed_instance *f =
        enter(c, function, PHASES_GET, nUnknown, vUnknown_ref, dvUnknown);
    gm_detailed_direction direction = {.initial = false};
    if (!f)
        return fmi2Error;
    if (nKnown > 0 && (!vKnown_ref || !dvKnown))
        return detailed_fail(f, function, "an array is missing");
    direction.initial = f->phase == PHASE_INITIALISATION;
    direction.x = f->along;
    memset(f->along, 0, (size_t)f->gearset->n_states * sizeof *f->along);
    for (size_t i = 0; i < nKnown; i++)
        if (take_known(f, function, vKnown_ref[i], dvKnown[i], &direction))
            return fmi2Error;
    for (size_t done = 0; done < nUnknown;) { /* the scratch array holds each once */
        size_t room = (size_t)(GM_VARIABLES + f->gearset->variables.n);
        size_t n = nUnknown - done < room ? nUnknown - done : room;
        fmi2Status status =
            directional(f, vUnknown_ref + done, (int)n, &direction, dvUnknown + done);
        if (status != fmi2OK)
            return status;
        done += n;
    }
    return fmi2OK;
}
