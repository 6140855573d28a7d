/* SPDX-License-Identifier: BSD-2-Clause */
#include "example_map.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double output_speed[] = {0, 5, 20, 60, 120, 200};
static const double path_speed[] = {0, 10, 50, 150, 400, 800, 1500};
static const double torque[] = {-400, -200, -50, -10, 0, 10, 50, 200, 400};
static const double relative_speed[] = {-2000, 0, 2000};

#define COUNT(array) (int)(sizeof(array) / sizeof *(array))

static void must(gm_status status, const gm_error *error)
{
    if (status == GM_OK)
        return;
    fprintf(stderr, "%s\n", error->message);
    abort();
}

static double value_of(const gm_table_key *key, double x, double y, double z)
{
    double sign = key->direction[0] == GM_BACKWARD ? -1.0 : 1.0;
    switch (key->symbol) {
    case GM_PARASITIC:
        return 6.0 + 0.012 * x + 1e-5 * x * x; /* more than its part at the inputs */
    case GM_LOAD_LOSS:
        return 0.02 * fabs(y) * (1.0 + x / 2000.0);
    case GM_BOTH_LOADED:
        return 1e-5 * fabs(y) * fabs(z);
    case GM_DRAG:
        return sign * (0.2 + 0.001 * x);
    case GM_REACTION: /* less than the drag's power: passive */
        return 0.0 - sign * 1e-4 * x;
    case GM_LINE_JUMP:
        return key->path == 0 ? 0.05 : 0.03;
    case GM_COUPLING:
        return 0.0005 * x;
    default:
        return 0.0;
    }
}

static void add(gm_map *map, gm_table_key key, int n_axes, const int *n,
                const double *const *x)
{
    gm_error error;
    int index, i = 0;
    must(gm_map_add_table(map, &key, n_axes, n, x, &index, &error), &error);
    int n1 = n_axes > 1 ? n[1] : 1, n2 = n_axes > 2 ? n[2] : 1;
    for (int a = 0; a < n[0]; a++)
        for (int b = 0; b < n1; b++)
            for (int c = 0; c < n2; c++)
                map->tables[index].value[i++] =
                    value_of(&key, x[0][a], n_axes > 1 ? x[1][b] : 0.0,
                             n_axes > 2 ? x[2][c] : 0.0);
}

static void add_path(gm_map *map, int p)
{
    const double *load[] = {path_speed, torque}, *free[] = {path_speed, output_speed};
    const double *line[] = {output_speed};
    int n_load[] = {COUNT(path_speed), COUNT(torque)};
    int n_free[] = {COUNT(path_speed), COUNT(output_speed)};
    for (int g = 0; g < map->paths[p].n_gears; g++)
        for (int d = 0; d < 2; d++) {
            gm_table_key key = gm_table_key_of(GM_LOAD_LOSS);
            key.path = p;
            key.gear[p] = map->paths[p].gears[g].number;
            key.direction[0] = d;
            add(map, key, 2, n_load, load);
            bool jumps = key.gear[p] > 1;
            key.symbol = GM_LINE_JUMP;
            key.gear[p] = GM_MAP_ANY;
            key.line = map->paths[p].gears[g].ratio;
            if (jumps)
                add(map, key, 1, &n_free[1], line);
        }
    for (int i = 0; i < 4; i++) {
        gm_table_key key = gm_table_key_of(GM_DRAG);
        key.path = p;
        key.direction[0] = i / 2;
        key.direction[1] = i % 2;
        add(map, key, 2, n_free, free);
        key.symbol = GM_REACTION;
        add(map, key, 2, n_free, free);
    }
}

static void add_configuration(gm_map *map, int number0, int number1, int d)
{
    const double *x[] = {output_speed, torque, torque};
    int n[] = {COUNT(output_speed), COUNT(torque), COUNT(torque)};
    gm_table_key key = gm_table_key_of(GM_PARASITIC);
    key.gear[0] = number0;
    key.gear[1] = number1;
    key.direction[0] = d;
    add(map, key, 1, n, x);
    key.symbol = GM_BOTH_LOADED;
    if (map->n_paths > 1 && number0 != 0 && number1 != 0)
        add(map, key, 3, n, x);
}

static void add_configurations(gm_map *map)
{
    int n1 = map->n_paths > 1 ? map->paths[1].n_gears + 1 : 1;
    for (int i = 0; i < (map->paths[0].n_gears + 1) * n1; i++) {
        int g0 = i / n1 - 1, g1 = i % n1 - 1;
        int number0 = g0 < 0 ? 0 : map->paths[0].gears[g0].number;
        int number1 = map->n_paths < 2 ? GM_MAP_ANY
                      : g1 < 0         ? 0
                                       : map->paths[1].gears[g1].number;
        add_configuration(map, number0, number1, GM_FORWARD);
        add_configuration(map, number0, number1, GM_BACKWARD);
    }
}

static void set_gear(gm_map_path *path, int g, int number, double ratio)
{
    path->gears[g] = (gm_map_gear){.number = number,
                                   .ratio = ratio,
                                   .ratio_given = (double)NAN,
                                   .stiffness = 2e4,
                                   .damping = 2.0,
                                   .loose_damping = 4.0,
                                   .lash = 5e-3,
                                   .film = 1e-4};
}

static void set_paths(gm_map *map)
{
    static const char *const names[2] = {"odd", "even"};
    gm_error error;
    for (int p = 0; p < map->n_paths; p++) {
        bool one = map->n_paths == 1;
        must(gm_map_set_path(map, p, one ? "input" : names[p], one ? 1 : 2, &error),
             &error);
        map->paths[p].inertia = 0.01 + 0.002 * p;
        map->paths[p].sync_torque = one ? HUGE_VAL : 30.0 + 10.0 * p;
    }
    if (map->n_paths == 1) {
        set_gear(&map->paths[0], 0, 1, -9.0);
        return;
    }
    set_gear(&map->paths[0], 0, 1, 15.0);
    set_gear(&map->paths[0], 1, 3, 6.0);
    set_gear(&map->paths[1], 0, -1, -14.0);
    set_gear(&map->paths[1], 1, 2, 9.0 + 1.0 / 3.0);
}

gm_map *example_map(int n_paths)
{
    const double *relative[] = {relative_speed};
    int n_relative = COUNT(relative_speed);
    gm_error error;
    gm_map *map = gm_map_create();
    if (!map)
        abort();
    strcpy(map->name, n_paths == 1 ? "reducer" : "example-2");
    strcpy(map->title, "An example <gearset> & its \"title\"");
    strcpy(map->tool_version, "0");
    memset(map->input_sha256, 'a', 64);
    strcpy(map->options, "made by hand");
    map->n_paths = n_paths;
    map->speed_max = 1500.0;
    map->torque_max = 400.0;
    map->oil_temperature = 313.15;
    map->inertia_output = 20.0;
    set_paths(map);
    for (int p = 0; p < n_paths; p++)
        add_path(map, p);
    add_configurations(map);
    if (n_paths > 1)
        add(map, gm_table_key_of(GM_COUPLING), 1, &n_relative, relative);
    must(gm_map_hash(map, map->content_hash, &error), &error);
    return map;
}
