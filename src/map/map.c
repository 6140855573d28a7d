/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The map in memory: paths with their gears, and tables by key.
 */
#include "map/gm_map.h"

#include "base/alloc.h"
#include "map/map_rules.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

gm_map *gm_map_create(void)
{
    return gm_calloc(1, sizeof(gm_map));
}

static void clear_table(gm_map_table *table)
{
    for (int a = 0; a < GM_MAX_AXES; a++)
        gm_free(table->x[a]);
    gm_free(table->value);
    *table = (gm_map_table){0};
}

void gm_map_destroy(gm_map *map)
{
    if (!map)
        return;
    for (int p = 0; p < GM_MAX_PATHS; p++)
        gm_free(map->paths[p].gears);
    for (int t = 0; t < map->n_tables; t++)
        clear_table(&map->tables[t]);
    gm_free(map->tables);
    gm_free(map);
}

gm_status gm_map_set_path(gm_map *map, int p, const char *name, int n_gears,
                          gm_error *error)
{
    size_t length = strlen(name);
    if (p < 0 || p >= GM_MAX_PATHS || p > map->n_paths || n_gears < 0 ||
        n_gears > GM_MAP_MAX_GEARS)
        return gm_fail(error, GM_ERR_ARGUMENT, "a map cannot have path %d with %d gears",
                       p, n_gears);
    if (length == 0 || length >= sizeof map->paths[p].name)
        return gm_fail(
            error, GM_ERR_ARGUMENT,
            "'%.40s' cannot be the name of a path: it needs 1 to %d characters", name,
            (int)sizeof map->paths[p].name - 1);
    gm_map_gear *gears = gm_calloc((size_t)n_gears, sizeof *gears);
    if (!gears)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for the gears of path %s", name);
    gm_free(map->paths[p].gears);
    map->paths[p] = (gm_map_path){.n_gears = n_gears, .gears = gears};
    memcpy(map->paths[p].name, name, length + 1);
    if (p == map->n_paths)
        map->n_paths = p + 1;
    return GM_OK;
}

/* Space for one more table; the array has room for the next power of two. */
static bool grow(gm_map *map)
{
    int n = map->n_tables;
    if (n > 0 && (n & (n - 1)) != 0)
        return true;
    gm_map_table *tables =
        gm_resize(map->tables, n > 0 ? 2 * (size_t)n : 1, sizeof *tables);
    if (tables)
        map->tables = tables;
    return tables != NULL;
}

static bool fill_table(gm_map_table *table, const gm_table_key *key, int slices,
                       int n_axes, const int *n, const double *const *x)
{
    *table = (gm_map_table){.key = *key, .slices = slices, .n_axes = n_axes};
    for (int a = 0; a < GM_MAX_AXES; a++) {
        table->n[a] = a < n_axes ? n[a] : 1;
        if (a >= n_axes)
            continue;
        table->x[a] = gm_calloc((size_t)n[a], sizeof *table->x[a]);
        if (!table->x[a])
            return false;
        memcpy(table->x[a], x[a], (size_t)n[a] * sizeof *x[a]);
    }
    table->value = gm_calloc((size_t)gm_map_value_count(table), sizeof *table->value);
    return table->value != NULL;
}

static gm_status check_new(const gm_map *map, const gm_table_key *key, int n_axes,
                           const int *n, const double *const *x, gm_error *error)
{
    char words[GM_KEY_TEXT];
    const char *wrong = NULL;
    if (map->n_tables >= GM_MAP_MAX_TABLES)
        wrong = "one table too many";
    else if (!gm_map_key_fits(key, map->n_paths))
        wrong = "its key does not fit its symbol";
    else if (!gm_map_axes_fit(key->symbol, n_axes, n, x))
        wrong = "the number, order or range of its axes does not fit";
    else if (gm_map_find(map, key))
        wrong = "the map has this table already";
    if (!wrong)
        return GM_OK;
    gm_map_key_text(map, key, words);
    return gm_fail(error, GM_ERR_ARGUMENT, "table %s: %s", words, wrong);
}

gm_status gm_map_add_table(gm_map *map, const gm_table_key *key, int n_axes, const int *n,
                           const double *const *x, int *index, gm_error *error)
{
    gm_status status = check_new(map, key, n_axes, n, x, error);
    gm_map_table table;
    if (status != GM_OK)
        return status;
    if (!fill_table(&table, key, gm_map_slices(map), n_axes, n, x) || !grow(map)) {
        clear_table(&table);
        return gm_fail(error, GM_ERR_MEMORY, "no memory for a table of the map");
    }
    *index = map->n_tables;
    map->tables[map->n_tables++] = table;
    return GM_OK;
}

gm_status gm_map_set_axes(gm_map *map, int index, const int *n, const double *const *x,
                          gm_error *error)
{
    char words[GM_KEY_TEXT];
    gm_map_table *table = &map->tables[index], made;
    if (!gm_map_axes_fit(table->key.symbol, table->n_axes, n, x)) {
        gm_map_key_text(map, &table->key, words);
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "table %s: the order or range of its new axes does not fit",
                       words);
    }
    if (!fill_table(&made, &table->key, table->slices, table->n_axes, n, x)) {
        clear_table(&made);
        return gm_fail(error, GM_ERR_MEMORY, "no memory for a table of the map");
    }
    clear_table(table);
    *table = made;
    return GM_OK;
}

static bool same_key(const gm_table_key *a, const gm_table_key *b)
{
    bool same = a->symbol == b->symbol && a->path == b->path && a->line == b->line;
    for (int p = 0; p < GM_MAX_PATHS; p++)
        same = same && a->gear[p] == b->gear[p];
    return same && a->direction[0] == b->direction[0] &&
           a->direction[1] == b->direction[1];
}

const gm_map_table *gm_map_find(const gm_map *map, const gm_table_key *key)
{
    for (int t = 0; t < map->n_tables; t++)
        if (same_key(&map->tables[t].key, key))
            return &map->tables[t];
    return NULL;
}

int gm_map_row_size(const gm_map_table *table)
{
    return table->n[1] * table->n[2];
}

int gm_map_has_neutral(const gm_map *map, int p)
{
    int found = map->paths[p].n_gears != 1;
    for (int t = 0; t < map->n_tables; t++) {
        const gm_table_key *key = &map->tables[t].key;
        found |= (key->symbol == GM_DRAG || key->symbol == GM_REACTION) && key->path == p;
    }
    return found;
}

int gm_map_table_size(const gm_map_table *table)
{
    return table->n[0] * gm_map_row_size(table);
}

int gm_map_value_count(const gm_map_table *table)
{
    return table->slices * gm_map_table_size(table);
}

gm_status gm_map_set_oil(gm_map *map, int n, const double *temperature, gm_error *error)
{
    if (n < 2 || n > GM_MAP_MAX_OIL || map->n_tables > 0)
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "a map with %d tables cannot have an oil axis of %d temperatures",
                       map->n_tables, n);
    if (!gm_map_oil_fits(n, temperature))
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "the oil temperatures of a map must increase from above 0 K");
    map->n_oil = n;
    memcpy(map->oil, temperature, (size_t)n * sizeof *temperature);
    memset(map->oil_bend, 0, sizeof map->oil_bend);
    return GM_OK;
}

int gm_map_slices(const gm_map *map)
{
    return map->n_oil > 1 ? map->n_oil : 1;
}

int gm_map_usual_slice(const gm_map *map)
{
    int nearest = 0;
    for (int k = 1; k < map->n_oil; k++)
        if (fabs(map->oil[k] - map->oil_temperature) <
            fabs(map->oil[nearest] - map->oil_temperature))
            nearest = k;
    return nearest;
}
