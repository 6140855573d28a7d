/* SPDX-License-Identifier: BSD-2-Clause
 *
 * FMI 2.0 Model Exchange: a solver outside moves the states, events change the modes
 * (FMI 2.0.3, section 3.2). Number and meaning of states and event indicators never
 * change; one fmi2NewDiscreteStates is enough for any event, there are no time events.
 */
#include "fmi2_instance.h"

#include <string.h>

/* For calls with an array of n numbers; NULL after a message. */
static fmi2_instance *enter(fmi2Component c, const char *function, unsigned phases,
                            const void *array, size_t n, int needed)
{
    fmi2_instance *f = fmi2_enter_exchange(c, function, phases);
    if (f && (!array || n != (size_t)needed)) {
        fmi2_fail(f, function, "an array of %d numbers is needed, not of %lu", needed,
                  array ? (unsigned long)n : 0ul);
        return NULL;
    }
    return f;
}

static int n_states(void)
{
    return gm_states_count(gm_model_map());
}

static int n_indicators(void)
{
    return gm_reduced_indicators(gm_model_map());
}

/* Discard: a solver may try again from nearer by. */
static fmi2Status overflow(fmi2_instance *f, const char *function)
{
    fmi2_log(f, fmi2Discard, FMI2_LOG_DISCARD,
             "%s: numbers overflowed at %g s; states or inputs are too large", function,
             f->run.time);
    return fmi2Discard;
}

/* ---- modes ---- */

fmi2Status fmi2EnterEventMode(fmi2Component c)
{
    fmi2_instance *f = fmi2_enter_exchange(c, "fmi2EnterEventMode", FMI2_PHASES_EXCHANGE);
    if (!f)
        return fmi2Error;
    f->run.phase = GM_PHASE_EVENT;
    f->run.update_due = true;
    return fmi2OK;
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *eventInfo)
{
    static const char function[] = "fmi2NewDiscreteStates";
    fmi2_instance *f = fmi2_enter_exchange(c, function, GM_PHASE_EVENT);
    gm_path_state before[GM_MAX_PATHS];
    bool jumped = false;
    if (!f)
        return fmi2Error;
    if (!eventInfo)
        return fmi2_fail(f, function, "there is no place for the event's information");
    memcpy(before, f->run.component.state.path, sizeof before);
    if (gm_run_update(gm_model_map(), &f->run, &jumped))
        return fmi2_fail(f, function, "numbers overflowed: the inputs are too large");
    *eventInfo = (fmi2EventInfo){
        .newDiscreteStatesNeeded = fmi2False,
        .terminateSimulation = fmi2False,
        .nominalsOfContinuousStatesChanged = fmi2False,
        .valuesOfContinuousStatesChanged = jumped ? fmi2True : fmi2False,
        .nextEventTimeDefined = fmi2False,
        .nextEventTime = 0.0,
    };
    if (f->logged & (FMI2_LOG_EVENTS | FMI2_LOG_ALL))
        fmi2_log_shifts(f, before);
    return fmi2_report(f, function);
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c)
{
    static const char function[] = "fmi2EnterContinuousTimeMode";
    fmi2_instance *f = fmi2_enter_exchange(c, function, GM_PHASE_EVENT);
    if (!f)
        return fmi2Error;
    if (f->run.update_due)
        return fmi2_fail(f, function,
                         "fmi2NewDiscreteStates has to be called after the last change");
    f->run.phase = GM_PHASE_CONTINUOUS;
    return fmi2OK;
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component c,
                                       fmi2Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi2Boolean *enterEventMode,
                                       fmi2Boolean *terminateSimulation)
{
    static const char function[] = "fmi2CompletedIntegratorStep";
    fmi2_instance *f = fmi2_enter_exchange(c, function, GM_PHASE_CONTINUOUS);
    (void)noSetFMUStatePriorToCurrentPoint; /* no history is kept that it could free */
    if (!f)
        return fmi2Error;
    if (!enterEventMode || !terminateSimulation)
        return fmi2_fail(f, function, "there is no place for the answers");
    *enterEventMode = *terminateSimulation = fmi2False;
    return fmi2OK;
}

/* ---- time and states ---- */

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time)
{
    fmi2_instance *f = fmi2_enter_exchange(c, "fmi2SetTime", FMI2_PHASES_EXCHANGE);
    if (!f)
        return fmi2Error;
    if (!gm_number_is_finite(time))
        return fmi2_fail(f, "fmi2SetTime", "the time %g is not finite", time);
    f->run.time = time;
    return fmi2OK;
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t nx)
{
    static const char function[] = "fmi2SetContinuousStates";
    fmi2_instance *f = enter(c, function, GM_PHASE_CONTINUOUS, x, nx, n_states());
    if (!f)
        return fmi2Error;
    if (gm_run_set_states(gm_model_map(), &f->run, x))
        return fmi2_fail(f, function, "a state is not a finite number");
    return fmi2OK;
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t nx)
{
    static const char function[] = "fmi2GetContinuousStates";
    fmi2_instance *f = enter(
        c, function, GM_PHASE_INITIALISATION | FMI2_PHASES_EXCHANGE | FMI2_PHASES_OVER, x,
        nx, n_states());
    if (!f)
        return fmi2Error;
    if (f->run.phase == GM_PHASE_INITIALISATION && gm_run_start(gm_model_map(), &f->run))
        return overflow(f, function);
    gm_states_get(gm_model_map(), &f->run.component, x);
    return fmi2OK;
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real x_nominal[],
                                             size_t nx)
{
    fmi2_instance *f =
        enter(c, "fmi2GetNominalsOfContinuousStates",
              GM_PHASE_INSTANTIATED | FMI2_PHASES_EXCHANGE | FMI2_PHASES_OVER, x_nominal,
              nx, n_states());
    if (!f)
        return fmi2Error;
    gm_states_nominals(gm_model_map(), x_nominal);
    return fmi2OK;
}

/* ---- rates and indicators ---- */

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t nx)
{
    static const char function[] = "fmi2GetDerivatives";
    fmi2_instance *f = enter(c, function, FMI2_PHASES_EXCHANGE | FMI2_PHASES_OVER,
                             derivatives, nx, n_states());
    gm_real rates[GM_MAX_STATES];
    if (!f)
        return fmi2Error;
    if (!gm_states_rates(gm_model_map(), &f->run.component, rates))
        return overflow(f, function);
    memcpy(derivatives, rates, nx * sizeof *rates);
    return fmi2OK;
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real eventIndicators[], size_t ni)
{
    static const char function[] = "fmi2GetEventIndicators";
    fmi2_instance *f = enter(
        c, function, GM_PHASE_INITIALISATION | FMI2_PHASES_EXCHANGE | FMI2_PHASES_OVER,
        eventIndicators, ni, n_indicators());
    gm_real z[GM_MAX_INDICATORS];
    if (!f)
        return fmi2Error;
    if (f->run.phase == GM_PHASE_INITIALISATION && gm_run_start(gm_model_map(), &f->run))
        return overflow(f, function);
    if (!gm_component_indicators(gm_model_map(), &f->run.component, z))
        return overflow(f, function);
    memcpy(eventIndicators, z, ni * sizeof *z);
    return fmi2OK;
}
