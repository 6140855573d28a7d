/* SPDX-License-Identifier: BSD-2-Clause */
#include "gm_detailed_gradient.h"

#include <math.h>
#include <string.h>

#define STEP 1e-5 /* of usual values, for differences */

static bool is_finite(double x)
{
    return x - x == 0.0;
}

bool gm_detailed_value_of(gm_detailed *d, gm_detailed_variable v, double *value)
{
    return v.inner >= 0 ? gm_detailed_get_inner(d, v.inner, value)
                        : gm_detailed_get(d, v.reference, value);
}

/* ---- knowns ---- */

static int state_of(const gm_detailed *d, gm_detailed_variable v)
{
    if (v.inner < 0)
        return gm_detailed_state_of(d, v.reference);
    const gm_motion_variable *inner = &d->variables.all[v.inner];
    return inner->kind == GM_MOTION_STATE ? inner->index : -1;
}

static bool is_start_value(gm_reference reference)
{
    const gm_variable *v = &gm_variables[reference.id];
    return v->type == GM_TYPE_REAL && v->initial == GM_INITIAL_EXACT &&
           reference.id != GM_PATH_TWIST;
}

static bool is_input(gm_reference reference)
{
    const gm_variable *v = &gm_variables[reference.id];
    return v->type == GM_TYPE_REAL && v->causality == GM_CAUSALITY_INPUT;
}

bool gm_detailed_add_known(const gm_detailed *d, gm_detailed_variable known, double rate,
                           gm_detailed_direction *direction)
{
    int state = state_of(d, known);
    if (!direction->initial && state >= 0) {
        direction->x[state] += rate;
        return true;
    }
    if (known.inner >= 0 || !(is_input(known.reference) ||
                              (direction->initial && is_start_value(known.reference))))
        return false;
    direction->value[known.reference.id][known.reference.path] += rate;
    return true;
}

/* ---- exact ---- */

static double torque_rate(const gm_detailed_direction *direction, int flange)
{
    return flange == 0 ? direction->value[GM_OUTPUT_TAU][0]
                       : direction->value[GM_PATH_TAU][flange - 1];
}

/* d->changed: how the rates of all states change. */
static bool follow_rates(gm_detailed *d, const gm_detailed_direction *direction)
{
    double *change = d->changed;
    memset(change, 0, (size_t)d->n_states * sizeof *change);
    if (gm_motion_jacobian(d->motion, &d->input, d->x, d->entry))
        return false;
    for (int j = 0; j < d->n_motion; j++)
        for (int k = d->column_start[j]; k < d->column_start[j + 1]; k++)
            change[d->row[k]] += d->entry[k] * direction->x[j];
    for (int f = 0; f <= d->n_paths; f++) {
        double rate = torque_rate(direction, f);
        int speed = gm_motion_speed_state(d->motion, f);
        if (gm_motion_torque_column(d->motion, &d->input, d->x, f, d->column))
            return false;
        for (int i = 0; i < d->n_motion; i++)
            change[i] += d->column[i] * rate;
        change[d->n_motion + f] = direction->x[speed];
        change[d->n_states - 2] +=
            rate * d->x[speed] + d->input.torque[f] * direction->x[speed];
    }
    return true;
}

/* State whose rate, among those that are followed exactly, the variable is; -1: none. */
static int exact_rate_of(const gm_detailed *d, gm_detailed_variable v)
{
    if (v.inner < 0) {
        int rate = gm_detailed_rate_of(d, v.reference);
        return rate == d->n_states - 1 ? -1 : rate;
    }
    const gm_motion_variable *inner = &d->variables.all[v.inner];
    return inner->kind == GM_MOTION_RATE ? inner->index : -1;
}

/* ---- differences ---- */

typedef double values[GM_VARIABLES][GM_DETAILED_PATHS];

/* The step along the direction that changes something by STEP of its usual value. */
static double step_along(const gm_detailed *d, const gm_detailed_direction *direction)
{
    double most = 0.0;
    for (int i = 0; i < d->n_states; i++)
        most = fmax(most, fabs(direction->x[i]) / d->nominal[i]);
    for (int id = 0; id < GM_VARIABLES; id++)
        for (int p = 0; p < d->n_paths; p++)
            most = fmax(most, fabs(direction->value[id][p]) / gm_variables[id].nominal);
    return most > 0.0 ? STEP / most : 0.0;
}

static bool move(gm_detailed *d, values from, const double *x,
                 const gm_detailed_direction *direction, double step)
{
    gm_error error;
    for (int i = 0; i < d->n_states; i++)
        d->x[i] = x[i] + step * direction->x[i];
    for (int id = 0; id < GM_VARIABLES; id++)
        for (int p = 0; p < (gm_variables[id].scope == GM_SCOPE_PATH ? d->n_paths : 1);
             p++)
            gm_detailed_set(d, (gm_reference){(gm_variable_id)id, p},
                            from[id][p] + step * direction->value[id][p]);
    return !direction->initial || gm_detailed_start(d, &error) == GM_OK;
}

static bool add_values(gm_detailed *d, double factor, int n,
                       const gm_detailed_variable *unknown, double *sum)
{
    for (int i = 0; i < n; i++) {
        double value;
        if (!gm_detailed_value_of(d, unknown[i], &value))
            return false;
        sum[i] += factor * value;
    }
    return true;
}

static bool follow_values(gm_detailed *d, const gm_detailed_direction *direction, int n,
                          const gm_detailed_variable *unknown, double *derivative)
{
    values here;
    double step = step_along(d, direction);
    bool pending = d->start_pending;
    if (step == 0.0)
        return true;
    memcpy(here, d->value, sizeof here);
    memcpy(d->column, d->x, (size_t)d->n_states * sizeof *d->x);
    bool known = move(d, here, d->column, direction, step) &&
                 add_values(d, 0.5 / step, n, unknown, derivative) &&
                 move(d, here, d->column, direction, -step) &&
                 add_values(d, -0.5 / step, n, unknown, derivative);
    (void)move(d, here, d->column, direction, 0.0); /* it was there before */
    d->start_pending = pending;
    return known;
}

/* ---- all ---- */

static bool all_exact(const gm_detailed *d, const gm_detailed_direction *direction, int n,
                      const gm_detailed_variable *unknown)
{
    bool exact = !direction->initial;
    for (int i = 0; i < n; i++)
        exact =
            exact && (exact_rate_of(d, unknown[i]) >= 0 || state_of(d, unknown[i]) >= 0);
    return exact;
}

bool gm_detailed_follow(gm_detailed *d, const gm_detailed_direction *direction, int n,
                        const gm_detailed_variable *unknown, double *derivative)
{
    memset(derivative, 0, (size_t)n * sizeof *derivative);
    if (!all_exact(d, direction, n, unknown) &&
        !follow_values(d, direction, n, unknown, derivative))
        return false;
    if (direction->initial)
        return true;
    if (!follow_rates(d, direction))
        return false;
    bool finite = true;
    for (int i = 0; i < n; i++) {
        int rate = exact_rate_of(d, unknown[i]), state = state_of(d, unknown[i]);
        if (rate >= 0)
            derivative[i] = d->changed[rate];
        else if (state >= 0)
            derivative[i] = direction->x[state];
        finite = finite && is_finite(derivative[i]);
    }
    return finite;
}
