/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The reduced gearset: gear commands, start, one step, what can be observed. Equations in
 * gm_reduced.h; tables in reduced_terms.c, the motion in reduced_solve.c, sub-steps and
 * events in reduced_step.c.
 */
#include "gm_reduced.h"
#include "reduced_parts.h"

#include <stddef.h>

/* In one step: sub-steps, of which events and the parts that a vibration asks for begin
 * new ones; passes before solutions become shorter. */
enum { GM_SUBSTEPS = 1 + GM_PARTS, GM_STEP_PASSES = 80 };

/* ---- lookups ---- */

void gm_reduced_default_params(const gm_reduced_map *map, gm_reduced_params *params)
{
    params->fidelity = GM_RIGID;
    params->loss_scale = 1;
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        params->sync_torque[p] = map->path[p < map->n_paths ? p : 0].sync_torque;
    }
}

int gm_reduced_find_gear(const gm_reduced_map *map, int p, int number)
{
    if (number == GM_NEUTRAL) {
        return gm_reduced_has_neutral(map, p) ? -1 : -2;
    }
    for (int i = 0; i < map->path[p].n_gears; i++) {
        if (map->path[p].gears[i].number == number) {
            return i;
        }
    }
    return -2;
}

int gm_reduced_has_neutral(const gm_reduced_map *map, int p)
{
    return map->path[p].drag[0][0].value != NULL;
}

int gm_reduced_configuration(const gm_reduced_map *map, const gm_reduced_state *state)
{
    return gm_configuration_index(map, state->path);
}

/* Inputs are multiplied with inertias, ratios and speeds: with this much room (to 1e108
 * as a double, 1e18 as a float) nothing overflows on the way, where inf - inf would pass
 * for a torque. */
#define GM_HEADROOM GM_BY_TYPE(1e200, 1e20)

/* 0 for a number that can be computed with, else NaN. */
static gm_real nothing_of(gm_real x)
{
    const gm_real y = x * GM_HEADROOM;
    return y - y;
}

int gm_inputs_are_finite(const gm_reduced_map *map, const gm_reduced_inputs *in)
{
    gm_real sum = nothing_of(in->output_tau) + nothing_of(in->output_tau_rate) +
                  nothing_of(in->oil_temperature);
    for (int p = 0; p < map->n_paths; p++) {
        sum += nothing_of(in->path_tau[p]) + nothing_of(in->path_tau_rate[p]);
    }
    for (int k = 0; k < GM_SHAFTS; k++) {
        sum += map->prescribed[k] ? nothing_of(in->w[k]) + nothing_of(in->a[k]) : 0;
    }
    return sum == 0;
}

int gm_motion_is_finite(const gm_reduced_map *map, const gm_motion *s)
{
    gm_real sum = (s->phi_o - s->phi_o) + (s->w_o - s->w_o) + (s->brake - s->brake) +
                  (s->work - s->work) + (s->loss_energy - s->loss_energy);
    for (int p = 0; p < map->n_paths; p++) {
        sum += (s->path[p].phi - s->path[p].phi) + (s->path[p].w - s->path[p].w) +
               (s->path[p].twist - s->path[p].twist);
    }
    return sum == 0;
}

gm_motion gm_load_motion(const gm_reduced_state *state)
{
    gm_motion s;
    s.phi_o = state->phi_o;
    s.w_o = state->w_o;
    s.brake = state->brake;
    s.rest_o = state->rest_o;
    s.path[0] = state->path[0];
    s.path[1] = state->path[1];
    s.work = state->work;
    s.loss_energy = state->loss_energy;
    return s;
}

void gm_store_motion(const gm_motion *s, gm_reduced_state *state)
{
    state->phi_o = s->phi_o;
    state->w_o = s->w_o;
    state->brake = s->brake;
    state->rest_o = s->rest_o;
    state->path[0] = s->path[0];
    state->path[1] = s->path[1];
    state->work = s->work;
    state->loss_energy = s->loss_energy;
}

/* ---- gears ---- */

static int refusal(int p)
{
    return p == 0 ? GM_FLAG_GEAR_REFUSED_0 : GM_FLAG_GEAR_REFUSED_1;
}

int gm_command_gear(const gm_reduced_map *map, const gm_reduced_params *params, int p,
                    int number, gm_motion *s)
{
    gm_path_state *path = &s->path[p];
    if (path->mode != GM_PATH_NEUTRAL &&
        map->path[p].gears[path->gear].number == number) {
        return 0;
    }
    const int gear = gm_reduced_find_gear(map, p, number);
    if (gear == -2) {
        return refusal(p);
    }
    if (path->mode == GM_PATH_ENGAGED) {
        gm_release(map, params, p, s);
    }
    path->gear = gear;
    path->mode = gear < 0 ? GM_PATH_NEUTRAL : GM_PATH_SYNCHRONISING;
    return 0;
}

/* Synchronisers that have nothing to do, or unlimited capacity, lock now. */
static void lock_synchronised(const gm_reduced_map *map, const gm_reduced_params *params,
                              gm_motion *s)
{
    for (int p = 0; p < map->n_paths; p++) {
        if (s->path[p].mode == GM_PATH_SYNCHRONISING &&
            (params->sync_torque[p] >= GM_SYNC_AT_ONCE ||
             s->path[p].w == gm_motion_gear(map, s, p)->ratio * s->w_o)) {
            gm_engage(map, params, p, s);
        }
    }
}

/* ---- public ---- */

/* The output's: prescribed, or that of an engaged path that is, or as wanted. */
static gm_real start_speed(const gm_reduced_map *map, const gm_reduced_inputs *in,
                           gm_real wanted)
{
    if (map->prescribed[GM_OUT]) {
        return in->w[GM_OUT];
    }
    for (int p = 0; p < map->n_paths; p++) {
        const int gear = gm_reduced_find_gear(map, p, in->gear[p]);
        if (map->prescribed[p] && gear >= 0) {
            return in->w[p] / map->path[p].gears[gear].ratio;
        }
    }
    return wanted;
}

int gm_reduced_start(const gm_reduced_map *map, const gm_reduced_inputs *inputs,
                     gm_real w_o, const gm_real *w, gm_reduced_state *state)
{
    static const gm_reduced_state zero = {0};
    gm_motion s = {0, 0, 0, 0, {{0, 0, 0, 0, -1, 0}, {0, 0, 0, 0, -1, 0}}, 0, 0};
    int flags = 0;
    s.w_o = start_speed(map, inputs, w_o);
    for (int p = 0; p < map->n_paths; p++) {
        gm_path_state *path = &s.path[p];
        const int gear = gm_reduced_find_gear(map, p, inputs->gear[p]);
        path->w = w[p];
        if (gear == -2) {
            flags |= refusal(p);
        }
        path->gear = gear >= 0 ? gear : gm_reduced_has_neutral(map, p) ? -1 : 0;
        if (path->gear >= 0) {
            path->mode = GM_PATH_ENGAGED;
            path->w = gm_motion_gear(map, &s, p)->ratio * s.w_o;
        }
        path->w = map->prescribed[p] ? inputs->w[p] : path->w;
    }
    if (!gm_inputs_are_finite(map, inputs) || !gm_motion_is_finite(map, &s)) {
        return GM_FLAG_NOT_FINITE;
    }
    *state = zero;
    gm_store_motion(&s, state);
    return flags;
}

int gm_reduced_step(const gm_reduced_map *map, const gm_reduced_params *params,
                    const gm_reduced_inputs *inputs, gm_real h, gm_reduced_state *state)
{
    if (!gm_inputs_are_finite(map, inputs) || !gm_is_finite(h)) {
        return GM_FLAG_NOT_FINITE;
    }
    gm_motion s = gm_load_motion(state);
    gm_solution solution;
    int flags = 0, outside = 0;
    gm_take_prescribed(map, params, inputs, &s);
    for (int p = 0; p < map->n_paths; p++) {
        flags |= gm_command_gear(map, params, p, inputs->gear[p], &s);
    }
    gm_span span = {0, h, h, 0};
    solution.passes = GM_STEP_PASSES;
    solution.warm = 0;
    for (int i = 1; i <= GM_SUBSTEPS && span.rest > 0; i++) {
        span.last = i == GM_SUBSTEPS || solution.passes <= 0;
        span.start = h - span.rest;
        lock_synchronised(map, params, &s);
        span.rest -= gm_substep(map, params, inputs, &span, &state->cache, &s, &solution);
        outside |= solution.terms.outside;
    }
    if (!gm_motion_is_finite(map, &s)) {
        return GM_FLAG_NOT_FINITE;
    }
    gm_store_motion(&s, state);
    return flags | (outside ? GM_FLAG_OUT_OF_MAP : 0);
}

/* ---- outputs ---- */

int gm_holding(const gm_drive *d, const gm_solution *solution, gm_terms *t,
               gm_real *share)
{
    gm_real limit = 0, applied = 0;
    int sign = 1;
    for (;; sign = -1) {
        const gm_real excess = gm_excess(d, solution, GM_OUT, (gm_real)sign, t);
        limit = t->out;
        for (int p = 0; p < d->n_paths; p++) {
            limit += d->engaged[p] ? d->ratio[p] * t->path[p].load : t->path[p].reaction;
        }
        applied = excess + limit;
        if (applied * (gm_real)sign >= 0 || sign < 0) {
            break;
        }
    }
    *share = limit != 0 ? applied / limit : 0;
    return sign;
}

/* While friction holds the output, each loss torque carries the same share of its
 * break-away value: what the account of torques needs, and continuous when it lets go. */
static void share_holding(const gm_drive *d, gm_solution *solution)
{
    gm_terms t;
    gm_real share;
    gm_holding(d, solution, &t, &share);
    solution->terms.out = share * t.out;
    for (int p = 0; p < d->n_paths; p++) {
        solution->terms.path[p].load = share * t.path[p].load;
        solution->terms.path[p].reaction = share * t.path[p].reaction;
    }
}

static void path_outputs(const gm_drive *d, const gm_solution *s, int p,
                         gm_reduced_outputs *o)
{
    const gm_path_terms *t = &s->terms.path[p];
    const gm_real c = p == 0 ? s->terms.coupling : -s->terms.coupling;
    o->tau[p] = d->tau[p];
    if (d->elastic[p]) {
        o->inertia[p] = d->inertia[p];
        o->twist_rate[p] = gm_slip(d, &s->point, p);
        o->a[p] = s->point.a[p];
        o->transmitted[p] = s->point.tau_m[p];
        o->path_loss_torque[p] =
            t->load + (s->held[p] ? d->tau[p] - c - s->point.spring[p] : t->drag);
        o->elastic_energy += gm_spring_energy(d->gear[p], d->twist[p]);
        o->kinetic_energy += d->inertia[p] * d->w[p] * d->w[p] / 2;
        return;
    }
    if (d->engaged[p]) {
        o->inertia[p] = d->inertia[GM_OUT] / (d->ratio[p] * d->ratio[p]);
        o->a[p] = d->ratio[p] * o->a_o;
        o->transmitted[p] = s->point.tau_m[p];
        o->path_loss_torque[p] = t->load;
        return;
    }
    o->inertia[p] = d->inertia[p];
    o->a[p] = s->point.a[p];
    o->path_loss_torque[p] = s->held[p] ? d->tau[p] - d->cone[p] : t->drag + c;
    o->output_loss_torque += t->reaction;
    o->kinetic_energy += d->inertia[p] * d->w[p] * d->w[p] / 2;
}

int gm_outputs_are_finite(const gm_reduced_outputs *o)
{
    int finite = gm_is_finite(o->a_o) && gm_is_finite(o->output_loss_torque) &&
                 gm_is_finite(o->kinetic_energy) && gm_is_finite(o->loss_power);
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        finite = finite && gm_is_finite(o->a[p]) && gm_is_finite(o->transmitted[p]) &&
                 gm_is_finite(o->path_loss_torque[p]);
    }
    return finite;
}

/* The longest step of 10 ms, 5 ms, 2 ms ... 10 us in which the vibrations of the
 * elastic paths are followed, not taken out. */
static gm_real recommended_step(const gm_drive *d)
{
    static const gm_real steps[] = {
        GM_NUM(1e-2), GM_NUM(5e-3), GM_NUM(2e-3), GM_NUM(1e-3), GM_NUM(5e-4),
        GM_NUM(2e-4), GM_NUM(1e-4), GM_NUM(5e-5), GM_NUM(2e-5), GM_NUM(1e-5)};
    int i = 0;
    while (i < 9 && !gm_is_followed(d, steps[i], GM_PARTS)) {
        i++;
    }
    return steps[i];
}

int gm_observe(const gm_drive *d, gm_solution *solution, gm_reduced_outputs *outputs)
{
    static const gm_reduced_outputs zero = {0};
    gm_reduced_outputs o = zero;
    const gm_real w_o = d->w[GM_OUT];
    o.loss_power = gm_loss_power(d, solution);
    if (solution->held[GM_OUT]) {
        share_holding(d, solution);
    }
    o.a_o = solution->point.a[GM_OUT];
    o.inertia_o = d->inertia[GM_OUT];
    o.step = recommended_step(d);
    o.output_loss_torque = solution->terms.out;
    o.tau[GM_OUT] = d->tau[GM_OUT];
    o.kinetic_energy = d->inertia[GM_OUT] * w_o * w_o / 2;
    for (int p = 0; p < d->n_paths; p++) {
        path_outputs(d, solution, p, &o);
    }
    if (!gm_outputs_are_finite(&o)) {
        return GM_FLAG_NOT_FINITE;
    }
    *outputs = o;
    return solution->terms.outside ? GM_FLAG_OUT_OF_MAP : 0;
}

int gm_reduced_outputs_at(const gm_reduced_map *map, const gm_reduced_params *params,
                          const gm_reduced_inputs *inputs, gm_reduced_state *state,
                          gm_reduced_outputs *outputs)
{
    gm_drive d;
    gm_solution solution;
    if (!gm_inputs_are_finite(map, inputs)) {
        return GM_FLAG_NOT_FINITE;
    }
    gm_solve_at(map, params, inputs, NULL, state, &d, &solution);
    return gm_observe(&d, &solution, outputs);
}
