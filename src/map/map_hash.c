/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The content hash: SHA-256 over everything a map says except which version of the tool
 * wrote it. Tables are taken in the order of their keys, so the order in which a sweep
 * made them, and the layout of a file, do not matter. Every text ends with its zero and
 * every list begins with its length, so no two contents give the same bytes.
 */
#include "base/alloc.h"
#include "base/sha256.h"
#include "map/map_rules.h"

#include <stdlib.h>

#define FIRST_WORDS "gearmap map"

static int compare_tables(const void *a, const void *b)
{
    const gm_map_table *const *left = a, *const *right = b;
    return gm_map_key_compare(&(*left)->key, &(*right)->key);
}

/* The tables in the order of their keys; NULL when there is no memory. */
static const gm_map_table **sorted_tables(const gm_map *map)
{
    const gm_map_table **sorted = gm_calloc((size_t)map->n_tables, sizeof *sorted);
    if (!sorted)
        return NULL;
    for (int t = 0; t < map->n_tables; t++)
        sorted[t] = &map->tables[t];
    qsort(sorted, (size_t)map->n_tables, sizeof *sorted, compare_tables);
    return sorted;
}

static void add_head(gm_sha256 *sum, const gm_map *map)
{
    gm_sha256_text(sum, FIRST_WORDS);
    gm_sha256_int(sum, gm_map_format(map));
    gm_sha256_text(sum, map->name);
    gm_sha256_text(sum, map->title);
    gm_sha256_text(sum, map->input_sha256);
    gm_sha256_text(sum, map->options);
    gm_sha256_double(sum, map->speed_max);
    gm_sha256_double(sum, map->torque_max);
    gm_sha256_double(sum, map->oil_temperature);
    gm_sha256_double(sum, map->inertia_output);
    gm_sha256_int(sum, map->n_paths);
}

/* A ratio that was not given counts as zero, which no ratio can be: NAN has many bits. */
static double given_or_zero(double ratio)
{
    return ratio == ratio ? ratio : 0.0;
}

static void add_path(gm_sha256 *sum, const gm_map_path *path)
{
    gm_sha256_text(sum, path->name);
    gm_sha256_double(sum, path->inertia);
    gm_sha256_double(sum, path->sync_torque);
    gm_sha256_int(sum, path->n_gears);
    for (int g = 0; g < path->n_gears; g++) {
        gm_sha256_int(sum, path->gears[g].number);
        gm_sha256_double(sum, path->gears[g].ratio);
        gm_sha256_double(sum, path->gears[g].inertia_extra);
        gm_sha256_double(sum, given_or_zero(path->gears[g].ratio_given));
        gm_sha256_double(sum, path->gears[g].stiffness);
        gm_sha256_double(sum, path->gears[g].damping);
        gm_sha256_double(sum, path->gears[g].loose_damping);
        gm_sha256_double(sum, path->gears[g].lash);
        gm_sha256_double(sum, path->gears[g].film);
    }
}

static void add_doubles(gm_sha256 *sum, int n, const double *x)
{
    gm_sha256_int(sum, n);
    for (int i = 0; i < n; i++)
        gm_sha256_double(sum, x[i]);
}

/* A map without the axis has the hash that it had before there were axes. */
static void add_oil(gm_sha256 *sum, const gm_map *map)
{
    if (map->n_oil == 0)
        return;
    add_doubles(sum, map->n_oil, map->oil);
    add_doubles(sum, map->n_oil - 1, map->oil_bend);
}

static void add_table(gm_sha256 *sum, const gm_map_table *table)
{
    gm_sha256_text(sum, gm_symbol_name(table->key.symbol));
    gm_sha256_int(sum, table->key.path);
    for (int p = 0; p < GM_MAX_PATHS; p++)
        gm_sha256_int(sum, table->key.gear[p]);
    for (int d = 0; d < 2; d++)
        gm_sha256_int(sum, table->key.direction[d]);
    gm_sha256_double(sum, table->key.line);
    gm_sha256_int(sum, table->n_axes);
    for (int a = 0; a < table->n_axes; a++)
        add_doubles(sum, table->n[a], table->x[a]);
    add_doubles(sum, gm_map_value_count(table), table->value);
}

gm_status gm_map_hash(const gm_map *map, char text[65], gm_error *error)
{
    const gm_map_table **sorted = sorted_tables(map);
    gm_sha256 *sum = sorted ? gm_sha256_create() : NULL;
    if (!sum) {
        gm_free(sorted);
        return gm_fail(error, GM_ERR_MEMORY, "no memory to hash the map");
    }
    add_head(sum, map);
    for (int p = 0; p < map->n_paths; p++)
        add_path(sum, &map->paths[p]);
    add_oil(sum, map);
    gm_sha256_int(sum, map->n_tables);
    for (int t = 0; t < map->n_tables; t++)
        add_table(sum, sorted[t]);
    gm_sha256_finish(sum, text);
    gm_sha256_destroy(sum);
    gm_free(sorted);
    return GM_OK;
}
