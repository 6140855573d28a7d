/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What drives the shafts of the reduced gearset over one sub-step: configuration, ratios,
 * inertias (J_s = J_out + sum_E (r^2 J_p + J_g); elastic paths keep their J_p), flange
 * and cone torques; and the power of the loss torques that the solution found.
 *
 * Mean speeds are those of the middle of a sub-step, h/2 into it, unless it is longer
 * than 2/omega, with omega^2 >= that of the fastest vibration: then they are read at h
 * z/(4 + z) with z = (omega h)^2, so that vibrations too fast for the sub-step die in it
 * instead of ringing on, and slow ones are followed.
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

int gm_has_own_speed(const gm_reduced_map *map, const gm_reduced_params *params,
                     const gm_motion *s, int p)
{
    return s->path[p].mode != GM_PATH_ENGAGED ||
           gm_is_elastic(params, gm_motion_gear(map, s, p));
}

gm_real gm_motion_inertia(const gm_reduced_map *map, const gm_reduced_params *params,
                          const gm_motion *s)
{
    gm_real sum = map->inertia_output;
    for (int p = 0; p < map->n_paths; p++) {
        if (s->path[p].mode != GM_PATH_ENGAGED) {
            continue;
        }
        const gm_gear *gear = gm_motion_gear(map, s, p);
        sum += gear->inertia_extra;
        if (!gm_is_elastic(params, gear)) {
            sum += gear->ratio * gear->ratio * map->path[p].inertia;
        }
    }
    return sum;
}

gm_real gm_cone_torque(const gm_reduced_params *params, int p, gm_real slip)
{
    const gm_real most = params->sync_torque[p];
    const gm_real capacity = most < GM_SYNC_AT_ONCE ? most : GM_SYNC_AT_ONCE;
    return slip > 0 ? capacity : slip < 0 ? -capacity : 0;
}

static void drive_engaged(const gm_reduced_params *params, const gm_motion *s,
                          const gm_gear *gear, int p, gm_drive *d)
{
    const gm_real r = gear->ratio;
    d->elastic[p] = d->own[p] = gm_is_elastic(params, gear);
    d->inertia_own += gear->inertia_extra;
    d->inertia[GM_OUT] += gear->inertia_extra;
    if (d->elastic[p]) {
        d->damping[p] =
            gm_spring_damping(gear, s->path[p].twist, s->path[p].w - r * s->w_o);
    } else {
        d->inertia[GM_OUT] += r * r * d->inertia[p];
    }
}

static void drive_path(const gm_reduced_map *map, const gm_reduced_params *params,
                       const gm_motion *s, int p, gm_drive *d)
{
    const gm_path_state *path = &s->path[p];
    const gm_path *part = &map->path[p];
    const gm_gear *gear = path->mode == GM_PATH_NEUTRAL ? NULL : &part->gears[path->gear];
    d->engaged[p] = path->mode == GM_PATH_ENGAGED;
    d->free[p] = d->own[p] = !d->engaged[p];
    d->elastic[p] = 0;
    d->twist[p] = path->twist;
    d->damping[p] = 0;
    d->gear[p] = gear;
    d->gear_index[p] = path->gear;
    d->ratio[p] = gear ? gear->ratio : 0;
    d->inertia[p] = part->inertia;
    d->w[p] = path->w;
    d->cone[p] = 0;
    if (d->engaged[p]) {
        drive_engaged(params, s, gear, p, d);
    } else if (gear) {
        d->cone[p] = gm_cone_torque(params, p, path->w - gear->ratio * s->w_o);
    }
    d->index = d->index * (part->n_gears + 1) + (d->engaged[p] ? path->gear + 1 : 0);
}

static void drive_no_path(int p, gm_drive *d)
{
    d->engaged[p] = d->free[p] = d->elastic[p] = d->own[p] = 0;
    d->gear[p] = NULL;
    d->ratio[p] = d->inertia[p] = d->w[p] = d->tau[p] = d->cone[p] = d->twist[p] = 0;
    d->damping[p] = 0;
}

void gm_make_drive(const gm_reduced_map *map, const gm_reduced_params *params,
                   const gm_motion *s, gm_reduced_cache *cache, gm_drive *d)
{
    d->map = map;
    d->cache = cache;
    d->n_paths = map->n_paths;
    d->scale = params->loss_scale;
    d->brake = s->brake;
    d->index = 0;
    d->inertia[GM_OUT] = d->inertia_own = map->inertia_output;
    drive_path(map, params, s, 0, d);
    if (map->n_paths == 2) {
        drive_path(map, params, s, 1, d);
    } else {
        drive_no_path(1, d);
    }
    d->configuration = &map->configurations[d->index];
    d->coupled = map->n_paths == 2 && map->coupling.value != NULL &&
                 !(d->engaged[0] && d->engaged[1]);
    d->w[GM_OUT] = s->w_o;
    for (int k = 0; k < GM_SHAFTS; k++) {
        d->prescribed[k] = map->prescribed[k] && (k == GM_OUT || d->own[k]);
        d->given[k] = 0;
    }
    d->stiff = 0;
    for (int p = 0; p < d->n_paths; p++) {
        if (d->elastic[p]) {
            const gm_real r = d->ratio[p];
            d->stiff +=
                d->gear[p]->stiffness * (1 / d->inertia[p] + r * r / d->inertia[GM_OUT]);
        }
    }
}

void gm_set_span(const gm_reduced_inputs *in, gm_real t, gm_real h, gm_drive *d)
{
    const gm_real middle = t + h / 2, z = d->stiff * h * h;
    if (gm_has_oil_axis(d->map) && d->cache->oil.temperature != in->oil_temperature) {
        gm_move_oil(&d->map->oil, in->oil_temperature, d->cache);
    }
    d->h = h;
    d->mean = z <= 4 ? h / 2 : h * (z / (4 + z));
    d->late = z <= 4 ? 0 : (z - 4) / (z + 4);
    d->tau[GM_OUT] = in->output_tau + in->output_tau_rate * middle;
    for (int p = 0; p < d->n_paths; p++) {
        d->tau[p] = in->path_tau[p] + in->path_tau_rate[p] * middle;
    }
    for (int k = 0; k < GM_SHAFTS; k++) {
        if (d->prescribed[k]) {
            d->given[k] = in->a[k];
            d->tau[k] = 0;
        }
    }
}

void gm_complete_torques(gm_drive *d, const gm_solution *s)
{
    if (d->prescribed[GM_OUT]) {
        d->tau[GM_OUT] = -gm_output_balance(d, &s->terms, &s->point);
    }
    for (int p = 0; p < d->n_paths; p++) {
        if (d->prescribed[p]) {
            d->tau[p] = -gm_path_balance(d, &s->terms, &s->point, p);
        }
    }
}

/* What mean speeds that are late take from the kinetic energy: late J dw^2/2 / h of each
 * shaft. */
static gm_real late_power(const gm_drive *d, const gm_solution *s)
{
    const gm_real *a = s->point.a;
    gm_real sum = d->inertia[GM_OUT] * a[GM_OUT] * a[GM_OUT];
    for (int p = 0; p < d->n_paths; p++) {
        sum += d->own[p] ? d->inertia[p] * a[p] * a[p] : 0;
    }
    return d->late * d->h / 2 * sum;
}

/* Power of all loss torques at the mean speeds. */
gm_real gm_loss_power(const gm_drive *d, const gm_solution *s)
{
    const gm_real *m = s->point.m;
    const gm_real m_o = m[GM_OUT];
    gm_real sum = s->terms.out * m_o + s->terms.coupling * (m[0] - m[1]);
    if (d->late > 0) {
        sum += late_power(d, s);
    }
    for (int p = 0; p < d->n_paths; p++) {
        const gm_path_terms *t = &s->terms.path[p];
        if (d->elastic[p]) {
            sum += t->load * d->ratio[p] * m_o + t->drag * m[p];
            sum += s->spring[p].power;
        } else if (d->engaged[p]) {
            sum += t->load * m[p];
        } else {
            sum += t->drag * m[p] + t->reaction * m_o;
            sum += d->cone[p] * (m[p] - d->ratio[p] * m_o);
        }
    }
    return sum;
}
