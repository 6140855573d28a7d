/* SPDX-License-Identifier: BSD-2-Clause
 *
 * FMI 2.0 Model Exchange (FMI 2.0.3, section 3.2). The number of states and of event
 * indicators never changes: every lock has one indicator, which falls through zero when
 * its cones have brought the speeds together. One fmi2NewDiscreteStates settles any
 * event, there are no time events.
 */
#include "fmi2_detailed.h"

#include <string.h>

/* Discard: a solver may try again from nearer by. */
static fmi2Status overflow(const detailed_instance *f, const char *function)
{
    return detailed_log(f, fmi2Discard, LOG_DISCARD,
                        "%s: numbers overflowed at %g s; states or inputs are too large",
                        function, f->time);
}

static int n_states(fmi2Component c)
{
    const detailed_instance *f = c;
    return f ? f->gearset->n_states : 0;
}

/* ---- modes ---- */

fmi2Status fmi2EnterEventMode(fmi2Component c)
{
    detailed_instance *f = detailed_enter(c, "fmi2EnterEventMode", PHASES_EXCHANGE);
    if (!f)
        return fmi2Error;
    f->phase = PHASE_EVENT;
    f->update_due = true;
    return fmi2OK;
}

static void log_shifts(detailed_instance *f, const double *before)
{
    static const char *const words[] = {"neutral", "synchronising", "engaged"};
    const gm_detailed *g = f->gearset;
    for (int p = 0; p < g->n_paths; p++) {
        double now = 0.0;
        (void)gm_detailed_get(f->gearset, (gm_reference){GM_PATH_STATE, p}, &now);
        if (now != before[p])
            (void)detailed_log(f, fmi2OK, LOG_EVENTS, "%g s: %s: gear %d, %s", f->time,
                               g->description->paths[p].id.name, g->input.gear[p],
                               now >= 0.0 && now <= 2.0 ? words[(int)now] : "");
    }
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *eventInfo)
{
    static const char function[] = "fmi2NewDiscreteStates";
    detailed_instance *f = detailed_enter(c, function, PHASE_EVENT);
    double before[GM_DETAILED_PATHS] = {0.0};
    bool jumped = false;
    gm_error error;
    if (!f)
        return fmi2Error;
    if (!eventInfo)
        return detailed_fail(f, function,
                             "there is no place for the event's information");
    for (int p = 0; p < f->gearset->n_paths; p++)
        (void)gm_detailed_get(f->gearset, (gm_reference){GM_PATH_STATE, p}, &before[p]);
    if (gm_detailed_update(f->gearset, &jumped, &error) != GM_OK)
        return detailed_fail(f, function, "at %g s: %s", f->time, error.message);
    f->update_due = false;
    *eventInfo = (fmi2EventInfo){
        .newDiscreteStatesNeeded = fmi2False,
        .terminateSimulation = fmi2False,
        .nominalsOfContinuousStatesChanged = fmi2False,
        .valuesOfContinuousStatesChanged = jumped ? fmi2True : fmi2False,
        .nextEventTimeDefined = fmi2False,
    };
    log_shifts(f, before);
    return detailed_report_gears(f, function);
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c)
{
    static const char function[] = "fmi2EnterContinuousTimeMode";
    detailed_instance *f = detailed_enter(c, function, PHASE_EVENT);
    if (!f)
        return fmi2Error;
    if (f->update_due)
        return detailed_fail(
            f, function, "fmi2NewDiscreteStates has to be called after the last change");
    f->phase = PHASE_CONTINUOUS;
    return fmi2OK;
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c,
                                       fmi2Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi2Boolean *enterEventMode,
                                       fmi2Boolean *terminateSimulation)
{
    static const char function[] = "fmi2CompletedIntegratorStep";
    detailed_instance *f = detailed_enter(c, function, PHASE_CONTINUOUS);
    (void)noSetFMUStatePriorToCurrentPoint; /* no history is kept that it could free */
    if (!f)
        return fmi2Error;
    if (!enterEventMode || !terminateSimulation)
        return detailed_fail(f, function, "there is no place for the answers");
    *enterEventMode = gm_detailed_is_due(f->gearset) ? fmi2True : fmi2False;
    *terminateSimulation = fmi2False;
    return fmi2OK;
}

/* ---- time and states ---- */

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time)
{
    detailed_instance *f = detailed_enter(c, "fmi2SetTime", PHASES_EXCHANGE);
    if (!f)
        return fmi2Error;
    if (time - time != 0.0)
        return detailed_fail(f, "fmi2SetTime", "the time %g is not finite", time);
    f->time = time;
    return fmi2OK;
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t nx)
{
    static const char function[] = "fmi2SetContinuousStates";
    detailed_instance *f =
        detailed_enter_array(c, function, PHASE_CONTINUOUS, x, nx, n_states(c));
    if (!f)
        return fmi2Error;
    for (size_t i = 0; i < nx; i++)
        if (x[i] - x[i] != 0.0)
            return detailed_fail(f, function, "state %zu = %g is not a finite number", i,
                                 x[i]);
    gm_detailed_set_states(f->gearset, x);
    return fmi2OK;
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t nx)
{
    static const char function[] = "fmi2GetContinuousStates";
    detailed_instance *f =
        detailed_enter_array(c, function, PHASES_GET, x, nx, n_states(c));
    if (!f || (f->phase == PHASE_INITIALISATION && detailed_start(f, function)))
        return fmi2Error;
    memcpy(x, f->gearset->x, nx * sizeof *x);
    return fmi2OK;
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real x_nominal[],
                                             size_t nx)
{
    detailed_instance *f = detailed_enter_array(c, "fmi2GetNominalsOfContinuousStates",
                                                PHASES_ANY, x_nominal, nx, n_states(c));
    if (!f)
        return fmi2Error;
    memcpy(x_nominal, f->gearset->nominal, nx * sizeof *x_nominal);
    return fmi2OK;
}

/* ---- rates and indicators ---- */

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t nx)
{
    static const char function[] = "fmi2GetDerivatives";
    detailed_instance *f =
        detailed_enter_array(c, function, PHASES_GET, derivatives, nx, n_states(c));
    if (!f || (f->phase == PHASE_INITIALISATION && detailed_start(f, function)))
        return fmi2Error;
    if (!gm_detailed_evaluate(f->gearset))
        return overflow(f, function);
    memcpy(derivatives, f->gearset->rates, nx * sizeof *derivatives);
    return fmi2OK;
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real eventIndicators[], size_t ni)
{
    static const char function[] = "fmi2GetEventIndicators";
    const detailed_instance *known = c;
    detailed_instance *f = detailed_enter_array(c, function, PHASES_GET, eventIndicators,
                                                ni, known ? known->gearset->n_events : 0);
    if (!f || (f->phase == PHASE_INITIALISATION && detailed_start(f, function)))
        return fmi2Error;
    gm_detailed_events(f->gearset, eventIndicators);
    return fmi2OK;
}
