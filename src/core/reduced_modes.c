/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Modes, rates and event indicators of the reduced gearset: gm_reduced_modes.h. The
 * balance, the tables and the limits of friction are those of the time stepping, taken
 * at an instant (a step of length zero).
 */
#include "gm_reduced_modes.h"
#include "reduced_parts.h"

#define GM_NOMINAL_SPEED GM_NUM(100.0)       /* rad/s */
#define GM_NOMINAL_PATH_TORQUE GM_NUM(100.0) /* N.m */
#define GM_NOMINAL_OUT_TORQUE GM_NUM(1000.0) /* N.m */

static int sign_of(gm_real x)
{
    return x > 0 ? 1 : x < 0 ? -1 : 0;
}

static gm_real slip_of(const gm_reduced_map *map, const gm_motion *s, int p)
{
    return s->path[p].w - gm_motion_gear(map, s, p)->ratio * s->w_o;
}

/* The state with the speeds that are prescribed at this instant. */
static gm_motion present_motion(const gm_reduced_map *map,
                                const gm_reduced_params *params,
                                const gm_reduced_inputs *in,
                                const gm_reduced_state *state)
{
    gm_motion s = gm_load_motion(state);
    gm_take_prescribed(map, params, in, &s);
    return s;
}

/* ---- motion in given modes ---- */

static int is_shaft(const gm_drive *d, int k)
{
    return k == GM_OUT || d->own[k];
}

/* What drives the shafts at this instant. Cones act by their mode. */
static void make_drive(const gm_reduced_map *map, const gm_reduced_params *params,
                       const gm_reduced_inputs *in, const gm_reduced_modes *modes,
                       const gm_motion *s, gm_reduced_cache *cache, gm_drive *d)
{
    gm_make_drive(map, params, s, cache, d);
    gm_set_span(in, 0, 0, d);
    for (int p = 0; p < map->n_paths; p++) {
        if (s->path[p].mode == GM_PATH_SYNCHRONISING) {
            d->cone[p] = gm_cone_torque(params, p, (gm_real)modes->slip[p]);
        }
    }
}

/* Held shafts stand, and rigid paths turn with the output, whatever a solver has made of
 * their states. */
static void solve_in_modes(const gm_reduced_modes *modes, gm_drive *d, gm_solution *s)
{
    for (int k = 0; k < GM_SHAFTS; k++) {
        const int direction = modes->direction[k];
        s->held[k] = is_shaft(d, k) && direction == 0 && !d->prescribed[k];
        s->sign[k] = direction < 0 ? -1 : direction > 0 || !d->prescribed[k] ? 1 : 0;
        s->barred[k] = 0;
        d->w[k] = s->held[k] ? 0 : d->w[k];
    }
    for (int p = 0; p < d->n_paths; p++) {
        d->w[p] = d->own[p] ? d->w[p] : d->ratio[p] * d->w[GM_OUT];
    }
    gm_solve_given(d, s);
}

void gm_solve_at(const gm_reduced_map *map, const gm_reduced_params *params,
                 const gm_reduced_inputs *in, const gm_reduced_modes *modes,
                 gm_reduced_state *state, gm_drive *d, gm_solution *s)
{
    const gm_motion motion = present_motion(map, params, in, state);
    s->passes = GM_PASSES;
    s->warm = 0;
    if (modes) {
        make_drive(map, params, in, modes, &motion, &state->cache, d);
        solve_in_modes(modes, d, s);
    } else {
        gm_make_drive(map, params, &motion, &state->cache, d);
        gm_set_span(in, 0, 0, d);
        gm_solve(d, s);
    }
    gm_complete_torques(d, s);
}

int gm_reduced_modes_outputs(const gm_reduced_map *map, const gm_reduced_params *params,
                             const gm_reduced_inputs *inputs,
                             const gm_reduced_modes *modes, gm_reduced_state *state,
                             gm_reduced_outputs *outputs)
{
    gm_drive d;
    gm_solution solution;
    if (!gm_inputs_are_finite(map, inputs)) {
        return GM_FLAG_NOT_FINITE;
    }
    gm_solve_at(map, params, inputs, modes, state, &d, &solution);
    return gm_observe(&d, &solution, outputs);
}

/* ---- indicators ---- */

int gm_reduced_indicators(const gm_reduced_map *map)
{
    return 2 * map->n_paths + 2;
}

/* How much more torque held shaft k bears, in the nearer direction; negative: none. */
static gm_real reserve(const gm_drive *d, const gm_solution *s, int k)
{
    gm_terms t;
    const gm_real forward = -gm_excess(d, s, k, 1, &t);
    const gm_real backward = gm_excess(d, s, k, -1, &t);
    return forward < backward ? forward : backward;
}

static gm_real shaft_indicator(const gm_drive *d, const gm_solution *s, int k)
{
    if (!is_shaft(d, k)) {
        return 1;
    }
    if (d->prescribed[k] && s->sign[k] == 0) {
        return GM_INDICATOR_MARGIN - gm_abs(d->w[k]) / GM_NOMINAL_SPEED;
    }
    if (s->held[k]) {
        const gm_real unit = k == GM_OUT ? GM_NOMINAL_OUT_TORQUE : GM_NOMINAL_PATH_TORQUE;
        return reserve(d, s, k) / unit + GM_INDICATOR_MARGIN;
    }
    return s->sign[k] * d->w[k] / GM_NOMINAL_SPEED + GM_INDICATOR_MARGIN;
}

int gm_reduced_modes_indicators(const gm_reduced_map *map,
                                const gm_reduced_params *params,
                                const gm_reduced_inputs *inputs,
                                const gm_reduced_modes *modes, gm_reduced_state *state,
                                gm_real *z)
{
    gm_drive d;
    gm_solution solution;
    const int n = map->n_paths;
    gm_real sum = 0;
    if (!gm_inputs_are_finite(map, inputs)) {
        return GM_FLAG_NOT_FINITE;
    }
    const gm_motion s = present_motion(map, params, inputs, state);
    gm_solve_at(map, params, inputs, modes, state, &d, &solution);
    for (int p = 0; p < n; p++) {
        z[p] = shaft_indicator(&d, &solution, p);
        z[n + p] =
            s.path[p].mode == GM_PATH_SYNCHRONISING
                ? (gm_real)modes->slip[p] * slip_of(map, &s, p) / GM_NOMINAL_SPEED +
                      GM_INDICATOR_MARGIN
                : 1;
        sum += z[p] + z[n + p];
    }
    z[2 * n] = shaft_indicator(&d, &solution, GM_OUT);
    z[2 * n + 1] = solution.terms.outside ? -1 : 1;
    if (!gm_is_finite(sum + z[2 * n])) {
        return GM_FLAG_NOT_FINITE;
    }
    return solution.terms.outside ? GM_FLAG_OUT_OF_MAP : 0;
}

/* ---- events ---- */

/* Shafts that have reached zero, or gone past it, stand: friction does not turn them
 * round. */
static void rest(const gm_reduced_map *map, const gm_reduced_params *params,
                 const gm_reduced_modes *modes, gm_motion *s)
{
    if (!map->prescribed[GM_OUT] && (gm_real)modes->direction[GM_OUT] * s->w_o < 0) {
        gm_bring_to_rest(map, params, GM_OUT, s);
    }
    for (int p = 0; p < map->n_paths; p++) {
        if (!map->prescribed[p] && gm_has_own_speed(map, params, s, p) &&
            (gm_real)modes->direction[p] * s->path[p].w < 0) {
            gm_bring_to_rest(map, params, p, s);
        }
    }
}

static int command_gears(const gm_reduced_map *map, const gm_reduced_params *params,
                         const gm_reduced_inputs *in, gm_reduced_modes *modes,
                         gm_motion *s)
{
    int flags = 0;
    for (int p = 0; p < map->n_paths; p++) {
        const gm_path_state before = s->path[p];
        flags |= gm_command_gear(map, params, p, in->gear[p], s);
        if (s->path[p].mode != before.mode || s->path[p].gear != before.gear) {
            modes->slip[p] = 0;
        }
    }
    return flags;
}

/* Cones whose slip is gone, and those that lock at once. Which ones is decided on the
 * speeds before any of them engages: the impulse of one may turn the slip of the other
 * round, and that is no synchronism. */
static void close_cones(const gm_reduced_map *map, const gm_reduced_params *params,
                        gm_reduced_modes *modes, gm_motion *s)
{
    int closes[GM_MAX_PATHS] = {0, 0};
    for (int p = 0; p < map->n_paths; p++) {
        if (s->path[p].mode == GM_PATH_SYNCHRONISING) {
            const gm_real slip = slip_of(map, s, p);
            closes[p] = params->sync_torque[p] >= GM_SYNC_AT_ONCE || slip == 0 ||
                        (gm_real)modes->slip[p] * slip < 0;
        }
    }
    for (int p = 0; p < map->n_paths; p++) {
        if (closes[p]) {
            gm_engage(map, params, p, s);
        }
        modes->slip[p] = 0;
    }
}

static void find_modes(const gm_reduced_map *map, const gm_reduced_params *params,
                       const gm_reduced_inputs *in, const gm_motion *s,
                       gm_reduced_cache *cache, gm_reduced_modes *modes)
{
    gm_drive d;
    gm_solution solution;
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        modes->slip[p] = p < map->n_paths && s->path[p].mode == GM_PATH_SYNCHRONISING
                             ? sign_of(slip_of(map, s, p))
                             : 0;
    }
    make_drive(map, params, in, modes, s, cache, &d);
    solution.passes = GM_PASSES;
    solution.warm = 0;
    gm_solve(&d, &solution);
    for (int k = 0; k < GM_SHAFTS; k++) {
        const int turns = is_shaft(&d, k) && !solution.held[k];
        modes->direction[k] = turns ? sign_of(solution.sign[k]) : 0;
    }
    modes->outside = solution.terms.outside;
}

static int has_jumped(const gm_reduced_map *map, const gm_reduced_state *before,
                      const gm_motion *s)
{
    int jumped = (!map->prescribed[GM_OUT] && s->w_o != before->w_o) ||
                 s->work != before->work || s->loss_energy != before->loss_energy;
    for (int p = 0; p < map->n_paths; p++) {
        jumped |= (!map->prescribed[p] && s->path[p].w != before->path[p].w) ||
                  s->path[p].twist != before->path[p].twist;
    }
    return jumped;
}

int gm_reduced_modes_update(const gm_reduced_map *map, const gm_reduced_params *params,
                            const gm_reduced_inputs *inputs, gm_reduced_state *state,
                            gm_reduced_modes *modes, int *jumped)
{
    gm_reduced_modes m = *modes;
    if (!gm_inputs_are_finite(map, inputs)) {
        return GM_FLAG_NOT_FINITE;
    }
    gm_motion s = present_motion(map, params, inputs, state);
    s.work = state->work; /* the solver outside has followed the motion */
    rest(map, params, &m, &s);
    const int flags = command_gears(map, params, inputs, &m, &s);
    close_cones(map, params, &m, &s);
    close_cones(map, params, &m, &s); /* one that an impulse has brought to no slip */
    if (!gm_motion_is_finite(map, &s)) {
        return GM_FLAG_NOT_FINITE;
    }
    find_modes(map, params, inputs, &s, &state->cache, &m);
    *jumped = has_jumped(map, state, &s);
    gm_store_motion(&s, state);
    *modes = m;
    return flags | (m.outside ? GM_FLAG_OUT_OF_MAP : 0);
}
