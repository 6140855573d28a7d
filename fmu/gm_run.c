/* SPDX-License-Identifier: BSD-2-Clause */
#include "gm_run.h"

#include <float.h>

bool gm_number_is_finite(gm_real x)
{
    return x >= -DBL_MAX && x <= DBL_MAX;
}

static gm_real magnitude(gm_real x)
{
    return x < 0.0 ? -x : x;
}

void gm_run_reset(const gm_reduced_map *map, gm_run *run)
{
    bool map_left = run->map_left;
    bool exchange = run->component.exchange;
    *run = (gm_run){.phase = GM_PHASE_INSTANTIATED, .map_left = map_left};
    run->component.exchange = exchange;
    gm_component_reset(map, &run->component);
}

gm_verdict gm_run_find(const gm_reduced_map *map, unsigned vr, gm_type carrier,
                       gm_reference *reference)
{
    if (!gm_interface_find(map, vr, reference))
        return GM_VERDICT_UNKNOWN;
    if (gm_variable_carrier(gm_variables[reference->id].type) != carrier)
        return GM_VERDICT_TYPE;
    return GM_VERDICT_OK;
}

/* Before the run everything with a start value may be set, during it inputs and tunable
 * parameters, but no parameters between events (FMI 2.0.3, sections 3.2.3 and 4.2.4,
 * notes of the tables of calls). Discrete inputs are not meant to be set between events
 * either, but FMPy (0.3.x) does when it looks for events, also with values from beyond
 * the event. A gear is no more than a command that the next event reads, so that is
 * harmless and let pass. */
static gm_verdict settable(const gm_reduced_map *map, const gm_run *run, gm_reference r)
{
    const gm_variable *v = &gm_variables[r.id];
    if (gm_interface_causality(map, r) == GM_CAUSALITY_INPUT)
        return GM_VERDICT_OK;
    if (gm_interface_initial(map, r) != GM_INITIAL_EXACT)
        return GM_VERDICT_READ_ONLY;
    if (run->phase & (GM_PHASE_INSTANTIATED | GM_PHASE_INITIALISATION))
        return GM_VERDICT_OK;
    return v->variability == GM_VARIABILITY_TUNABLE && run->phase != GM_PHASE_CONTINUOUS
               ? GM_VERDICT_OK
               : GM_VERDICT_PHASE;
}

gm_verdict gm_run_set(const gm_reduced_map *map, gm_run *run, gm_reference reference,
                      gm_value value)
{
    const gm_variable *v = &gm_variables[reference.id];
    gm_verdict verdict = settable(map, run, reference);
    if (verdict)
        return verdict;
    gm_real x = v->type == GM_TYPE_REAL ? value.real : (gm_real)value.integer;
    if (!gm_number_is_finite(x))
        return GM_VERDICT_NOT_FINITE;
    gm_real min = gm_interface_min(map, reference);
    if ((min > -GM_FREE && x < min) || (v->max < GM_FREE && x > v->max))
        return GM_VERDICT_RANGE;
    gm_component_set(&run->component, reference, value);
    run->update_due = true;
    return GM_VERDICT_OK;
}

gm_verdict gm_run_start(const gm_reduced_map *map, gm_run *run)
{
    if (!run->component.start_pending)
        return GM_VERDICT_OK;
    int flags = gm_component_start(map, &run->component);
    run->update_due = true;
    return flags & GM_FLAG_NOT_FINITE ? GM_VERDICT_OVERFLOW : GM_VERDICT_OK;
}

gm_verdict gm_run_get(const gm_reduced_map *map, gm_run *run, gm_reference reference,
                      gm_value *value)
{
    if (run->phase == GM_PHASE_INITIALISATION && gm_run_start(map, run))
        return GM_VERDICT_OVERFLOW;
    return gm_component_get(map, &run->component, reference, value) ? GM_VERDICT_OK
                                                                    : GM_VERDICT_OVERFLOW;
}

gm_verdict gm_run_rate(const gm_reduced_map *map, gm_run *run, gm_reference reference,
                       gm_real *rate)
{
    gm_value value;
    if (!gm_states_derivative_of(map, reference, &reference))
        return GM_VERDICT_UNKNOWN;
    gm_verdict verdict = gm_run_get(map, run, reference, &value);
    if (verdict == GM_VERDICT_OK)
        *rate = value.real;
    return verdict;
}

gm_verdict gm_run_update(const gm_reduced_map *map, gm_run *run, bool *jumped)
{
    if (gm_component_update(map, &run->component, jumped) & GM_FLAG_NOT_FINITE)
        return GM_VERDICT_OVERFLOW;
    run->update_due = false;
    return GM_VERDICT_OK;
}

gm_verdict gm_run_set_states(const gm_reduced_map *map, gm_run *run, const gm_real *x)
{
    for (int i = 0, n = gm_states_count(map); i < n; i++)
        if (!gm_number_is_finite(x[i]))
            return GM_VERDICT_NOT_FINITE;
    gm_states_set(map, &run->component, x);
    return GM_VERDICT_OK;
}

/* How far two times may be apart and still be the same communication point: callers add
 * up steps or multiply, and some keep time in single steps of their own clock. The clock
 * follows the caller, so that rounding never adds up. */
static gm_real time_tolerance(const gm_run *run, gm_real t)
{
    return 1e-3 * run->last_step + 64.0 * DBL_EPSILON * magnitude(t);
}

static gm_verdict check_step(const gm_run *run, gm_real t, gm_real h)
{
    if (!(h > 0.0) || !gm_number_is_finite(h))
        return GM_VERDICT_STEP_SIZE;
    if (!gm_number_is_finite(t) || magnitude(t - run->time) > time_tolerance(run, t))
        return GM_VERDICT_TIME;
    gm_real slack = 1e-3 * h + 64.0 * DBL_EPSILON * magnitude(run->stop_time);
    if (run->stop_defined && t + h > run->stop_time + slack)
        return GM_VERDICT_STOP;
    return GM_VERDICT_OK;
}

gm_verdict gm_run_step(const gm_reduced_map *map, gm_run *run, gm_real t, gm_real h)
{
    gm_verdict verdict = check_step(run, t, h);
    if (verdict)
        return verdict;
    if (gm_component_step(map, &run->component, h) & GM_FLAG_NOT_FINITE)
        return GM_VERDICT_OVERFLOW;
    run->time = t + h;
    run->last_step = h;
    return GM_VERDICT_OK;
}

bool gm_run_is_quiet(const gm_run *run)
{
    bool reported = false;
    for (int p = 0; p < GM_MAX_PATHS; p++)
        reported = reported || run->gear_reported[p];
    return run->component.flags == 0 && !reported;
}

bool gm_run_gear_refused(gm_run *run, int p)
{
    int command = run->component.value[GM_PATH_GEAR][p].integer;
    bool refused = run->component.value[GM_PATH_GEAR_REFUSED][p].integer != 0;
    bool again = run->gear_reported[p] && run->reported_gear[p] == command;
    run->gear_reported[p] = refused;
    run->reported_gear[p] = command;
    return refused && !again;
}

bool gm_run_map_left(gm_run *run)
{
    if (run->map_left || !(run->component.flags & GM_FLAG_OUT_OF_MAP))
        return false;
    run->map_left = true;
    return true;
}
