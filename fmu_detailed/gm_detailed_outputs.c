/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What the component shows. Every quantity is computed when it is asked for, once for
 * each state and input.
 */
#include "gm_detailed.h"

#include <float.h>
#include <math.h>

/* ---- states and rates ---- */

/* Position of phi of the output among the states; those of the paths follow. */
static int phi(const gm_detailed *d, int flange)
{
    return d->n_motion + flange;
}

int gm_detailed_state_of(const gm_detailed *d, gm_reference reference)
{
    switch (reference.id) {
    case GM_OUTPUT_PHI:
        return phi(d, 0);
    case GM_PATH_PHI:
        return phi(d, 1 + reference.path);
    case GM_OUTPUT_W:
        return gm_motion_speed_state(d->motion, 0);
    case GM_PATH_W:
        return gm_motion_speed_state(d->motion, 1 + reference.path);
    case GM_WORK:
        return d->n_states - 2;
    case GM_LOSS_ENERGY:
        return d->n_states - 1;
    default:
        return -1;
    }
}

int gm_detailed_rate_of(const gm_detailed *d, gm_reference reference)
{
    switch (reference.id) {
    case GM_OUTPUT_A:
        return gm_motion_speed_state(d->motion, 0);
    case GM_PATH_A:
        return gm_motion_speed_state(d->motion, 1 + reference.path);
    case GM_POWER:
        return d->n_states - 2;
    case GM_LOSS_POWER:
        return d->n_states - 1;
    default:
        return -1;
    }
}

static bool is_finite(double x)
{
    return x >= -DBL_MAX && x <= DBL_MAX;
}

bool gm_detailed_evaluate(gm_detailed *d)
{
    if (d->rates_known)
        return true;
    double power = 0.0;
    if (gm_motion_rates(d->motion, &d->input, d->x, d->rates))
        return false;
    gm_motion_view_at(d->motion, &d->input, d->x, &d->view);
    for (int f = 0; f <= d->n_paths; f++) {
        d->rates[phi(d, f)] = d->view.speed[f];
        power += d->input.torque[f] * d->view.speed[f];
    }
    d->rates[d->n_states - 2] = power;
    d->rates[d->n_states - 1] = d->view.loss_power;
    for (int i = 0; i < d->n_states; i++)
        if (!is_finite(d->rates[i]))
            return false;
    d->rates_known = true;
    return true;
}

void gm_detailed_events(gm_detailed *d, double *z)
{
    (void)gm_motion_events(d->motion, &d->input, d->x, z); /* it cannot fail */
}

/* ---- other outputs ---- */

/* The longest step of 10 ms, 5 ms, 2 ms ... 10 ns in which the fastest row turns by at
 * most 1 rad of its vibration. */
static double recommended_step(const gm_detailed *d)
{
    static const double next[] = {0.5, 0.4, 0.5};
    double longest = 1.0 / gm_motion_flanges_frequency(d->flanges), step = 1e-2;
    for (int i = 0; step > longest && i < 18; i++)
        step *= next[i % 3];
    return step;
}

static bool loss_torque(gm_detailed *d, int flange, double *value)
{
    if (!gm_detailed_evaluate(d))
        return false;
    if (!d->losses_known)
        gm_motion_flanges_losses(d->flanges, &d->input, d->x, d->loss_torque);
    d->losses_known = true;
    *value = d->loss_torque[flange];
    return is_finite(*value);
}

/* Of the motion as it is seen from outside. */
static bool viewed(gm_detailed *d, gm_reference reference, double *value)
{
    if (!gm_detailed_evaluate(d))
        return false;
    if (reference.id == GM_PATH_STATE) {
        *value = d->view.state[reference.path];
        return true;
    }
    *value = gm_motion_flanges_kinetic_energy(d->flanges, d->x);
    if (reference.id == GM_ELASTIC_ENERGY)
        *value = fmax(d->view.stored_energy - *value, 0.0);
    return is_finite(*value);
}

static double twist_rate(const gm_detailed *d, int p)
{
    double ratio = gm_motion_flanges_ratio(d->flanges, p);
    double w_p = d->x[gm_motion_speed_state(d->motion, 1 + p)];
    return ratio != 0.0 ? w_p - ratio * d->x[gm_motion_speed_state(d->motion, 0)] : 0.0;
}

static bool other(gm_detailed *d, gm_reference reference, double *value)
{
    int p = reference.path;
    switch (reference.id) {
    case GM_PATH_TWIST:
        *value = gm_motion_flanges_twist(d->flanges, p, d->x);
        return true;
    case GM_PATH_TWIST_RATE:
        *value = twist_rate(d, p);
        return true;
    case GM_PATH_LOSS_TORQUE:
        return loss_torque(d, 1 + p, value);
    case GM_OUTPUT_LOSS_TORQUE:
        return loss_torque(d, 0, value);
    case GM_KINETIC_ENERGY:
    case GM_ELASTIC_ENERGY:
    case GM_PATH_STATE:
        return viewed(d, reference, value);
    case GM_PATH_INERTIA:
        *value = gm_motion_flanges_inertia(d->flanges, 1 + p);
        return true;
    case GM_OUTPUT_INERTIA:
        *value = gm_motion_flanges_inertia(d->flanges, 0);
        return true;
    case GM_RECOMMENDED_STEP:
        *value = recommended_step(d);
        return true;
    case GM_PATH_GEAR_REFUSED:
        *value = d->refused[p];
        return true;
    default: /* inputs, parameters, and what a detailed gearset never leaves: a map */
        *value = d->value[reference.id][p];
        return true;
    }
}

bool gm_detailed_get(gm_detailed *d, gm_reference reference, double *value)
{
    int state = gm_detailed_state_of(d, reference);
    int rate = gm_detailed_rate_of(d, reference);
    if (state >= 0) {
        *value = d->x[state];
        return true;
    }
    if (rate < 0)
        return other(d, reference, value);
    bool known = gm_detailed_evaluate(d);
    if (known)
        *value = d->rates[rate];
    return known;
}

bool gm_detailed_get_inner(gm_detailed *d, int i, double *value)
{
    const gm_motion_variable *v = &d->variables.all[i];
    if (v->kind == GM_MOTION_STATE) {
        *value = d->x[v->index];
        return true;
    }
    if (!gm_detailed_evaluate(d))
        return false;
    if (v->kind == GM_MOTION_SIGNAL && !d->signals_known) {
        gm_motion_observe(d->motion, &d->input, d->x, d->signals);
        d->signals_known = true;
    }
    *value = v->kind == GM_MOTION_RATE ? d->rates[v->index] : d->signals[v->index];
    return is_finite(*value);
}
