/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What drives the shafts of the reduced gearset over one sub-step: configuration, ratios,
 * inertias (J_s = J_out + sum_E r^2 J_p), flange and cone torques; and the power of the
 * loss torques that the solution found.
 */
#include "reduced_parts.h"

#include <stddef.h>

int gm_configuration_index(const gm_reduced_map *map, const gm_path_state *paths)
{
    int index = 0;
    for (int p = 0; p < map->n_paths; p++) {
        const int gear = paths[p].mode == GM_PATH_ENGAGED ? paths[p].gear : -1;
        index = index * (map->path[p].n_gears + 1) + gear + 1;
    }
    return index;
}

const gm_gear *gm_motion_gear(const gm_reduced_map *map, const gm_motion *s, int p)
{
    const gm_path_state *path = &s->path[p];
    return path->mode == GM_PATH_NEUTRAL ? NULL : &map->path[p].gears[path->gear];
}

gm_real gm_motion_inertia(const gm_reduced_map *map, const gm_motion *s)
{
    gm_real sum = map->inertia_output;
    for (int p = 0; p < map->n_paths; p++) {
        if (s->path[p].mode == GM_PATH_ENGAGED) {
            const gm_real r = gm_motion_gear(map, s, p)->ratio;
            sum += r * r * map->path[p].inertia;
        }
    }
    return sum;
}

static void drive_path(const gm_reduced_map *map, const gm_reduced_params *params,
                       const gm_motion *s, int p, gm_drive *d)
{
    const gm_path_state *path = &s->path[p];
    const gm_gear *gear = gm_motion_gear(map, s, p);
    d->engaged[p] = path->mode == GM_PATH_ENGAGED;
    d->free[p] = !d->engaged[p];
    d->gear[p] = gear;
    d->ratio[p] = gear ? gear->ratio : 0;
    d->inertia[p] = map->path[p].inertia;
    d->w[p] = path->w;
    d->cone[p] = 0;
    if (path->mode == GM_PATH_SYNCHRONISING) {
        const gm_real slip = path->w - d->ratio[p] * s->w_o;
        const gm_real most = params->sync_torque[p];
        const gm_real capacity = most < GM_SYNC_AT_ONCE ? most : GM_SYNC_AT_ONCE;
        d->cone[p] = slip > 0 ? capacity : slip < 0 ? -capacity : 0;
    }
}

void gm_make_drive(const gm_reduced_map *map, const gm_reduced_params *params,
                   const gm_motion *s, gm_reduced_cache *cache, gm_drive *d)
{
    static const gm_drive empty = {0};
    *d = empty;
    d->map = map;
    d->cache = cache;
    d->index = gm_configuration_index(map, s->path);
    d->configuration = &map->configurations[d->index];
    d->n_paths = map->n_paths;
    d->scale = params->loss_scale;
    for (int p = 0; p < map->n_paths; p++) {
        drive_path(map, params, s, p, d);
    }
    d->coupled = map->n_paths == 2 && map->coupling.value != NULL &&
                 !(d->engaged[0] && d->engaged[1]);
    d->inertia[GM_OUT] = gm_motion_inertia(map, s);
    d->w[GM_OUT] = s->w_o;
}

/* Mean torques over h seconds that begin t seconds into the step. */
void gm_set_span(const gm_reduced_inputs *in, gm_real t, gm_real h, gm_drive *d)
{
    const gm_real middle = t + h / 2;
    d->h = h;
    d->tau[GM_OUT] = in->output_tau + in->output_tau_rate * middle;
    for (int p = 0; p < d->n_paths; p++) {
        d->tau[p] = in->path_tau[p] + in->path_tau_rate[p] * middle;
    }
}

/* Power of all loss torques at the mean speeds. */
gm_real gm_loss_power(const gm_drive *d, const gm_solution *s)
{
    const gm_real *m = s->point.m;
    const gm_real m_o = m[GM_OUT];
    gm_real sum = s->terms.out * m_o + s->terms.coupling * (m[0] - m[1]);
    for (int p = 0; p < d->n_paths; p++) {
        const gm_path_terms *t = &s->terms.path[p];
        if (d->engaged[p]) {
            sum += t->load * m[p];
        } else {
            sum += t->drag * m[p] + t->reaction * m_o;
            sum += d->cone[p] * (m[p] - d->ratio[p] * m_o);
        }
    }
    return sum;
}
