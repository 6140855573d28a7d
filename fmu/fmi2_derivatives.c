/* SPDX-License-Identifier: BSD-2-Clause
 *
 * FMI 2.0: directional derivatives (FMI 2.0.3, section 2.1.9). Knowns are continuous
 * inputs and states, in initialisation mode inputs and start values; unknowns are
 * outputs, among them all derivatives of states.
 */
#include "fmi2_instance.h"
#include "gm_gradient.h"

static const char function[] = "fmi2GetDirectionalDerivative";

/* Real variable of a value reference. */
static fmi2Status find(fmi2_instance *f, unsigned vr, gm_reference *reference)
{
    switch (gm_run_find(gm_model_map(), vr, GM_TYPE_REAL, reference)) {
    case GM_VERDICT_OK:
        return fmi2OK;
    case GM_VERDICT_UNKNOWN:
        return fmi2_fail(f, function, "there is no variable with value reference %u", vr);
    default:
        return fmi2_fail(f, function, "value reference %u is not a Real variable", vr);
    }
}

static fmi2Status take_known(fmi2_instance *f, unsigned vr, double rate, bool initial,
                             gm_rates *known)
{
    gm_reference r;
    char name[FMI2_NAME_SIZE];
    if (find(f, vr, &r))
        return fmi2Error;
    if (!gm_gradient_is_known(gm_model_map(), r, initial))
        return fmi2_fail(f, function, "%s is neither an input nor a %s",
                         fmi2_variable_name(r, name), initial ? "start value" : "state");
    if (!gm_number_is_finite(rate))
        return fmi2_fail(f, function, "the rate %g of %s is not a finite number", rate,
                         fmi2_variable_name(r, name));
    known->of[r.id][r.path] += rate;
    return fmi2OK;
}

static fmi2Status check_unknowns(fmi2_instance *f, const fmi2ValueReference vr[],
                                 size_t n)
{
    gm_reference r;
    char name[FMI2_NAME_SIZE];
    for (size_t i = 0; i < n; i++) {
        if (find(f, vr[i], &r))
            return fmi2Error;
        if (gm_interface_causality(gm_model_map(), r) != GM_CAUSALITY_OUTPUT)
            return fmi2_fail(f, function, "%s is not an output",
                             fmi2_variable_name(r, name));
    }
    return fmi2OK;
}

static void give_unknowns(const gm_rates *outputs, const fmi2ValueReference vr[],
                          size_t n, fmi2Real value[])
{
    gm_reference r;
    for (size_t i = 0; i < n; i++)
        if (gm_run_find(gm_model_map(), vr[i], GM_TYPE_REAL, &r) == GM_VERDICT_OK)
            value[i] = outputs->of[r.id][r.path];
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c,
                                        const fmi2ValueReference vUnknown_ref[],
                                        size_t nUnknown,
                                        const fmi2ValueReference vKnown_ref[],
                                        size_t nKnown, const fmi2Real dvKnown[],
                                        fmi2Real dvUnknown[])
{
    gm_rates known = {{{0}}}, outputs;
    fmi2_instance *f = fmi2_enter(c, function, FMI2_PHASES_GET);
    if (!f)
        return fmi2Error;
    if ((nUnknown > 0 && (!vUnknown_ref || !dvUnknown)) ||
        (nKnown > 0 && (!vKnown_ref || !dvKnown)))
        return fmi2_fail(f, function, "an array is missing");
    bool initial = f->run.phase == GM_PHASE_INITIALISATION;
    for (size_t i = 0; i < nKnown; i++)
        if (take_known(f, vKnown_ref[i], dvKnown[i], initial, &known))
            return fmi2Error;
    if (check_unknowns(f, vUnknown_ref, nUnknown))
        return fmi2Error;
    if ((initial && gm_run_start(gm_model_map(), &f->run)) ||
        !gm_gradient_follow(gm_model_map(), &f->run.component, initial, &known,
                            &outputs)) {
        fmi2_log(f, fmi2Discard, FMI2_LOG_DISCARD, "%s: numbers overflowed at %g s",
                 function, f->run.time);
        return fmi2Discard;
    }
    give_unknowns(&outputs, vUnknown_ref, nUnknown, dvUnknown);
    return fmi2OK;
}
