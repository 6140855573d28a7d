/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/checks.h"

#include "sweep/plan.h"

#include <math.h>

static gm_status check_ratio(const gm_map_path *path, const gm_map_gear *gear,
                             double *deviation, gm_error *error)
{
    double given = gear->ratio_given;
    if (gear->ratio == 0.0 || !isfinite(gear->ratio))
        return gm_fail(error, GM_ERR_MODEL,
                       "path '%s', gear %d: the ratio of the model is %g: the path does "
                       "not turn with the output",
                       path->name, gear->number, gear->ratio);
    if (isnan(given))
        return GM_OK;
    double relative = fabs(gear->ratio - given) / fabs(given);
    if (gear->ratio * given < 0)
        return gm_fail(error, GM_ERR_MODEL,
                       "path '%s', gear %d: given ratio %.6g, the model makes %.6g; the "
                       "sign must be the same",
                       path->name, gear->number, given, gear->ratio);
    if (!(relative <= GM_RATIO_TOLERANCE))
        return gm_fail(
            error, GM_ERR_MODEL,
            "path '%s', gear %d: given ratio %.6g, the model makes %.6g; they may "
            "differ by %g of it",
            path->name, gear->number, given, gear->ratio, GM_RATIO_TOLERANCE);
    *deviation = fmax(*deviation, relative);
    return GM_OK;
}

static gm_status identify_compliance(const gm_plant *plant, int p, gm_map_gear *gear,
                                     gm_error *error)
{
    gm_compliance c = {.stiffness = 0.0};
    gm_status status = GM_OK;
    if (plant->is->compliance)
        status = plant->is->compliance(plant->self, p, gear->number, &c, error);
    if (status != GM_OK)
        return status;
    gear->stiffness = c.stiffness;
    gear->damping = c.damping;
    gear->loose_damping = c.loose_damping;
    gear->lash = c.lash;
    gear->film = c.film;
    return GM_OK;
}

static gm_status identify_gear(const gm_plant *plant, gm_map *map, int p, int g,
                               double *deviation, gm_error *error)
{
    const gm_plant_gear *from = &plant->info.path[p].gears[g];
    gm_map_gear *to = &map->paths[p].gears[g];
    int gear[GM_MAX_INPUT_PATHS];
    gm_kinematics kinematics;
    for (int q = 0; q < GM_MAX_INPUT_PATHS; q++)
        gear[q] = q == p ? from->number : gm_sweep_rest_gear(plant, q);
    gm_status status = plant->is->kinematics(plant->self, gear, &kinematics, error);
    if (status != GM_OK)
        return status;
    to->number = from->number;
    to->ratio = kinematics.ratio[p];
    to->ratio_given = from->ratio_given;
    to->inertia_extra = gm_extra_inertia(&kinematics);
    status = identify_compliance(plant, p, to, error);
    return status == GM_OK ? check_ratio(&map->paths[p], to, deviation, error) : status;
}

static gm_status identify_inertias(const gm_plant *plant, gm_map *map, gm_error *error)
{
    int rest[GM_MAX_INPUT_PATHS];
    gm_kinematics kinematics;
    for (int p = 0; p < GM_MAX_INPUT_PATHS; p++)
        rest[p] = gm_sweep_rest_gear(plant, p);
    gm_status status = plant->is->kinematics(plant->self, rest, &kinematics, error);
    if (status != GM_OK)
        return status;
    map->inertia_output = kinematics.inertia_output;
    for (int p = 0; p < map->n_paths; p++)
        map->paths[p].inertia = kinematics.inertia[p];
    return GM_OK;
}

gm_status gm_sweep_identify(const gm_plant *plant, gm_map *map, double *deviation,
                            gm_error *error)
{
    const gm_plant_info *info = &plant->info;
    double largest = 0.0;
    gm_status status = GM_OK;
    for (int p = 0; p < info->n_paths && status == GM_OK; p++) {
        const gm_plant_path *path = &info->path[p];
        status = gm_map_set_path(map, p, path->name, path->n_gears, error);
        if (status == GM_OK)
            map->paths[p].sync_torque = path->sync_torque;
        for (int g = 0; g < path->n_gears && status == GM_OK; g++)
            status = identify_gear(plant, map, p, g, &largest, error);
    }
    if (status == GM_OK)
        status = identify_inertias(plant, map, error);
    if (status == GM_OK)
        *deviation = largest;
    return status;
}

/* Largest |slope| of a D table along the torque, and the torque where it is. */
static double load_slope(const gm_map_table *t, double *torque)
{
    double largest = 0.0;
    for (int i = 0; i < t->slices * t->n[0]; i++)
        for (int j = 0; j + 1 < t->n[1]; j++) {
            const double *value = t->value + (long)i * t->n[1] + j;
            double slope = fabs((value[1] - value[0]) / (t->x[1][j + 1] - t->x[1][j]));
            if (slope > largest) {
                largest = slope;
                *torque = t->x[1][j];
            }
        }
    return largest;
}

static gm_status check_load(const gm_map *map, const gm_map_table *t, gm_error *error)
{
    double torque = 0.0, slope = load_slope(t, &torque);
    if (slope < 1.0)
        return GM_OK;
    int p = t->key.path;
    return gm_fail(error, GM_ERR_MODEL,
                   "path '%s', gear %d: near %g N.m the loss grows by %.3g times the "
                   "torque that causes it; from 1 on there is no unique motion",
                   map->paths[p].name, t->key.gear[p], torque, slope);
}

/* Largest |slope| of an X table along the torque of path p. */
static double both_slope(const gm_map_table *t, int p)
{
    const double *torque = t->x[1 + p];
    long stride = p == 0 ? t->n[2] : 1;
    double largest = 0.0;
    for (long k = 0; k < gm_map_value_count(t); k++) {
        long j = p == 0 ? (k / t->n[2]) % t->n[1] : k % t->n[2];
        if (j + 1 < t->n[1 + p])
            largest = fmax(largest, fabs((t->value[k + stride] - t->value[k]) /
                                         (torque[j + 1] - torque[j])));
    }
    return largest;
}

static gm_status check_both(const gm_map *map, const gm_map_table *t, gm_error *error)
{
    for (int p = 0; p < 2; p++) {
        double ratio = gm_sweep_ratio(map, p, t->key.gear[p]), torque = 0.0;
        int backward = (ratio < 0) != (t->key.direction[0] == GM_BACKWARD);
        gm_table_key key = gm_sweep_load_key(p, t->key.gear[p], backward);
        double load = load_slope(gm_map_find(map, &key), &torque);
        double both = both_slope(t, p) / fabs(ratio);
        if (!(load + both < 1.0))
            return gm_fail(error, GM_ERR_MODEL,
                           "gears %d and %d under load together: the loss grows by %.3g "
                           "times the torque of path '%s'; from 1 on there is no unique "
                           "motion",
                           t->key.gear[0], t->key.gear[1], load + both,
                           map->paths[p].name);
    }
    return GM_OK;
}

gm_status gm_sweep_check_unique(const gm_map *map, gm_error *error)
{
    gm_status status = GM_OK;
    for (int i = 0; i < map->n_tables && status == GM_OK; i++) {
        const gm_map_table *t = &map->tables[i];
        if (t->key.symbol == GM_LOAD_LOSS)
            status = check_load(map, t, error);
        else if (t->key.symbol == GM_BOTH_LOADED)
            status = check_both(map, t, error);
    }
    return status;
}
