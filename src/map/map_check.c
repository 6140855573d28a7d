/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Checks of a whole map. Everything that reads a map (the reduced gearset, the
 * generators, the file) relies on them, so each wrong value has its sentence here.
 */
#include "map/map_rules.h"

#include <math.h>
#include <string.h>

static gm_status check_path_frame(const gm_map *map, int p, gm_error *error)
{
    const gm_map_path *path = &map->paths[p];
    if (path->name[0] == '\0')
        return gm_fail(error, GM_ERR_FORMAT, "path %d of the map has no name", p);
    if (path->n_gears > 0 && !path->gears)
        return gm_fail(error, GM_ERR_FORMAT, "path %s has no gears", path->name);
    for (int g = 0; g < path->n_gears; g++) {
        int number = path->gears[g].number;
        if (number == GM_NEUTRAL || number == GM_MAP_ANY || number < -1)
            return gm_fail(error, GM_ERR_FORMAT,
                           "path %s: %d is not the number of a gear (-1, 1, 2, ...)",
                           path->name, number);
        if (g > 0 && number <= path->gears[g - 1].number)
            return gm_fail(error, GM_ERR_FORMAT,
                           "path %s: gear %d must come before gear %d", path->name,
                           number, path->gears[g - 1].number);
    }
    return GM_OK;
}

static bool has_gear(const gm_map_path *path, int number)
{
    for (int g = 0; g < path->n_gears; g++)
        if (path->gears[g].number == number)
            return true;
    return number == GM_NEUTRAL || number == GM_MAP_ANY;
}

static gm_status check_table_frame(const gm_map *map, const gm_map_table *table,
                                   gm_error *error)
{
    char words[GM_KEY_TEXT];
    bool gears = true;
    for (int p = 0; p < GM_MAX_PATHS; p++)
        gears = gears && has_gear(&map->paths[p], table->key.gear[p]);
    bool key = gm_map_key_fits(&table->key, map->n_paths);
    const double *const x[GM_MAX_AXES] = {table->x[0], table->x[1], table->x[2]};
    if (key && gears && gm_map_axes_fit(table->key.symbol, table->n_axes, table->n, x))
        return GM_OK;
    gm_map_key_text(map, &table->key, words);
    return gm_fail(error, GM_ERR_FORMAT, "the map's table %s has the wrong %s", words,
                   !key     ? "key for its symbol"
                   : !gears ? "gear: its path has no such gear"
                            : "axes: their number, order or range does not fit");
}

static gm_status check_oil(const gm_map *map, gm_error *error)
{
    bool fits = map->n_oil >= 0 && map->n_oil != 1 && map->n_oil <= GM_MAP_MAX_OIL;
    fits = fits && (map->n_oil == 0 || gm_map_oil_fits(map->n_oil, map->oil));
    for (int k = 0; fits && k < map->n_oil; k++)
        fits = map->oil_bend[k] > -1.0 && isfinite(map->oil_bend[k]);
    for (int t = 0; fits && t < map->n_tables; t++)
        fits = map->tables[t].slices == gm_map_slices(map);
    return fits ? GM_OK
                : gm_fail(error, GM_ERR_FORMAT,
                          "the map's oil temperatures are not two or more that increase, "
                          "with bends above -1 and a slice of every table for each");
}

gm_status gm_map_check_frame(const gm_map *map, gm_error *error)
{
    gm_status status = GM_OK;
    if (map->n_paths < 1 || map->n_paths > GM_MAX_PATHS)
        return gm_fail(error, GM_ERR_FORMAT, "the map has %d paths; 1 or 2 are possible",
                       map->n_paths);
    for (int p = 0; status == GM_OK && p < map->n_paths; p++)
        status = check_path_frame(map, p, error);
    if (status == GM_OK && map->n_paths == 2 &&
        strcmp(map->paths[0].name, map->paths[1].name) == 0)
        status = gm_fail(error, GM_ERR_FORMAT, "both paths of the map are named %s",
                         map->paths[0].name);
    if (status == GM_OK)
        status = check_oil(map, error);
    for (int t = 0; status == GM_OK && t < map->n_tables; t++)
        status = check_table_frame(map, &map->tables[t], error);
    return status;
}

static gm_status check_compliance(const gm_map_path *path, const gm_map_gear *gear,
                                  gm_error *error)
{
    if (gear->stiffness >= 0.0 && isfinite(gear->stiffness) && gear->damping >= 0.0 &&
        isfinite(gear->damping) && gear->loose_damping >= 0.0 &&
        isfinite(gear->loose_damping) && gear->lash >= 0.0 && isfinite(gear->lash) &&
        gear->film >= 0.0 && isfinite(gear->film))
        return GM_OK;
    return gm_fail(
        error, GM_ERR_FORMAT,
        "path %s: gear %d has the stiffness %g N.m/rad, the damping %g and "
        "%g N.m.s/rad, the lash %g rad and the film %g rad; none may be negative",
        path->name, gear->number, gear->stiffness, gear->damping, gear->loose_damping,
        gear->lash, gear->film);
}

static gm_status check_path(const gm_map *map, const gm_map_path *path, gm_error *error)
{
    if (!(path->inertia > 0.0) || !isfinite(path->inertia))
        return gm_fail(error, GM_ERR_FORMAT,
                       "path %s: inertia %g kg.m2 is not a positive number", path->name,
                       path->inertia);
    if (!(path->sync_torque > 0.0))
        return gm_fail(error, GM_ERR_FORMAT,
                       "path %s: synchroniser capacity %g N.m is not positive",
                       path->name, path->sync_torque);
    for (int g = 0; g < path->n_gears; g++) {
        const gm_map_gear *gear = &path->gears[g];
        if (gear->ratio == 0.0 || !isfinite(gear->ratio))
            return gm_fail(error, GM_ERR_FORMAT,
                           "path %s: gear %d has the ratio %g; it must be a number that "
                           "is not zero",
                           path->name, gear->number, gear->ratio);
        if (!isfinite(gear->inertia_extra) ||
            !(map->inertia_output + gear->inertia_extra > 0.0))
            return gm_fail(error, GM_ERR_FORMAT,
                           "path %s: gear %d adds the inertia %g kg.m2; with that of the "
                           "output the sum must be positive",
                           path->name, gear->number, gear->inertia_extra);
        if (isinf(gear->ratio_given))
            return gm_fail(error, GM_ERR_FORMAT, "path %s: gear %d: given ratio %g",
                           path->name, gear->number, gear->ratio_given);
        gm_status status = check_compliance(path, gear, error);
        if (status != GM_OK)
            return status;
    }
    return GM_OK;
}

static gm_status check_values(const gm_map *map, const gm_map_table *table,
                              gm_error *error)
{
    int size = gm_map_value_count(table);
    for (int i = 0; i < size; i++) {
        char words[GM_KEY_TEXT];
        if (isfinite(table->value[i]))
            continue;
        gm_map_key_text(map, &table->key, words);
        return gm_fail(error, GM_ERR_FORMAT, "the map's table %s: value %d is %g", words,
                       i, table->value[i]);
    }
    return GM_OK;
}

gm_status gm_map_check(const gm_map *map, gm_error *error)
{
    gm_status status = gm_map_check_frame(map, error);
    if (status == GM_OK &&
        (!(map->inertia_output > 0.0) || !isfinite(map->inertia_output)))
        return gm_fail(error, GM_ERR_FORMAT,
                       "inertia %g kg.m2 of the output is not a positive number",
                       map->inertia_output);
    if (status == GM_OK && (!isfinite(map->speed_max) || !isfinite(map->torque_max) ||
                            !isfinite(map->oil_temperature)))
        return gm_fail(error, GM_ERR_FORMAT,
                       "largest speed, torque or oil temperature is not a number");
    for (int p = 0; status == GM_OK && p < map->n_paths; p++)
        status = check_path(map, &map->paths[p], error);
    for (int t = 0; status == GM_OK && t < map->n_tables; t++)
        status = check_values(map, &map->tables[t], error);
    return status;
}
