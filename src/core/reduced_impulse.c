/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What happens to speeds at once, and what it costs: paths that engage or let go, shafts
 * that come to rest, speeds that are prescribed anew.
 *
 * An impulse between shafts conserves their momentum, and the kinetic energy that goes is
 * lost. A prescribed shaft bears any impulse: its speed stays, and the work that its
 * flange does is what the others gain and lose (the limit of an infinite inertia).
 */
#include "reduced_parts.h"

/* Engaged paths that have no speed of their own. */
static void turn_with_output(const gm_reduced_map *map, const gm_reduced_params *params,
                             gm_motion *s)
{
    for (int p = 0; p < map->n_paths; p++) {
        if (!gm_has_own_speed(map, params, s, p)) {
            s->path[p].w = gm_motion_gear(map, s, p)->ratio * s->w_o;
        }
    }
}

static gm_real energy(gm_real inertia, gm_real w)
{
    return inertia * w * w / 2;
}

/* Inertia j_new joins j, which turns with the output, from rest; fixed: a prescribed
 * shaft is among them. */
static void take_along(int fixed, gm_real j, gm_real j_new, gm_motion *s)
{
    const gm_real share = fixed ? 1 : j / (j + j_new), whole = energy(j_new, s->w_o);
    s->loss_energy += share * whole;
    s->work += fixed ? 2 * whole : 0;
    s->w_o *= share;
}

/* Part j_part of what turns with the output is left behind at rest. */
static void leave_behind(gm_real j_part, gm_motion *s)
{
    s->loss_energy += energy(j_part, s->w_o);
}

void gm_release(const gm_reduced_map *map, const gm_reduced_params *params, int p,
                gm_motion *s)
{
    gm_path_state *path = &s->path[p];
    const gm_gear *gear = gm_motion_gear(map, s, p);
    const gm_real extra = gear->inertia_extra;
    s->loss_energy +=
        gm_is_elastic(params, gear) ? gm_spring_energy(gear, path->twist) : 0;
    path->twist = 0;
    path->mode = GM_PATH_NEUTRAL;
    if (extra > 0) {
        leave_behind(extra, s);
    } else if (extra < 0) {
        take_along(map->prescribed[GM_OUT], gm_motion_inertia(map, params, s) + extra,
                   -extra, s);
        turn_with_output(map, params, s);
    }
}

/* Speeds of path p and of what turns with the output, j_o, once they have met; the path's
 * is r times the output's unless both are prescribed. */
static void meet(const gm_reduced_map *map, int p, gm_real r, gm_real j_o, gm_motion *s)
{
    const int fixed_p = map->prescribed[p], fixed_o = map->prescribed[GM_OUT];
    const gm_real j_p = map->path[p].inertia, w_p = s->path[p].w, w_o = s->w_o;
    const gm_real slip = w_p - r * w_o;
    if (slip == 0 || (fixed_p && fixed_o)) {
        return;
    }
    if (fixed_p) {
        s->w_o = w_p / r;
        s->loss_energy += energy(j_o, s->w_o - w_o);
        s->work += j_o * (s->w_o - w_o) * s->w_o;
    } else if (fixed_o) {
        s->path[p].w = r * w_o;
        s->loss_energy += energy(j_p, slip);
        s->work -= j_p * slip * r * w_o;
    } else {
        const gm_real j_sum = j_o + r * r * j_p;
        s->loss_energy += j_o / j_sum * energy(j_p, slip);
        s->w_o += r * j_p * slip / j_sum;
        s->path[p].w = r * s->w_o;
    }
}

void gm_engage(const gm_reduced_map *map, const gm_reduced_params *params, int p,
               gm_motion *s)
{
    gm_path_state *path = &s->path[p];
    const gm_gear *gear = gm_motion_gear(map, s, p);
    const gm_real r = gear->ratio, extra = gear->inertia_extra;
    gm_real j_o = gm_motion_inertia(map, params, s);
    if (extra < 0) {
        leave_behind(-extra, s);
        j_o += extra;
    }
    meet(map, p, r, j_o, s);
    if (extra > 0) {
        take_along(map->prescribed[p] || map->prescribed[GM_OUT],
                   j_o + r * r * map->path[p].inertia, extra, s);
    }
    path->mode = GM_PATH_ENGAGED;
    path->twist = 0;
    if (!map->prescribed[p]) {
        path->w = r * s->w_o;
    }
    turn_with_output(map, params, s);
}

void gm_bring_to_rest(const gm_reduced_map *map, const gm_reduced_params *params, int k,
                      gm_motion *s)
{
    if (k == GM_OUT) {
        s->loss_energy += energy(gm_motion_inertia(map, params, s), s->w_o);
        s->w_o = 0;
        turn_with_output(map, params, s);
        return;
    }
    s->loss_energy += energy(map->path[k].inertia, s->path[k].w);
    s->path[k].w = 0;
}

void gm_take_prescribed(const gm_reduced_map *map, const gm_reduced_params *params,
                        const gm_reduced_inputs *in, gm_motion *s)
{
    for (int p = 0; p < map->n_paths; p++) {
        if (map->prescribed[p] && gm_has_own_speed(map, params, s, p)) {
            const gm_real j = map->path[p].inertia;
            s->work += energy(j, in->w[p]) - energy(j, s->path[p].w);
            s->path[p].w = in->w[p];
        }
    }
    if (map->prescribed[GM_OUT]) {
        const gm_real j = gm_motion_inertia(map, params, s);
        s->work += energy(j, in->w[GM_OUT]) - energy(j, s->w_o);
        s->w_o = in->w[GM_OUT];
        turn_with_output(map, params, s);
    }
}
