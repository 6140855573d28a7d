/* SPDX-License-Identifier: BSD-2-Clause */
#include "map_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#define MAX_FRAME_TABLES 200

const fixture_options fixture_full = {2, true, false, GM_SYMBOLS};

double fixture_random(uint64_t *state)
{
    /* Knuth's MMIX generator; the upper 53 bits */
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

static const double speed[] = {0.0, 1.0, 41.25, 210.0, 430.5, 675.4424205218055};
static const double output_speed[] = {0.0, 0.1, 33.3, 120.0};
static const double torque[] = {-250.0, -100.0, -0.3, 0.0, 0.1, 40.0, 250.0};
static const double relative[] = {-300.0, -1.0, 0.0, 1.0, 300.0};

/* Drag lines of the fixture, by path and gear. */
const double fixture_line[2][2] = {{3.25, 7.5}, {-6.0, 4.125}};

typedef struct frame {
    const fixture_options *options;
    int n;
    gm_table_key keys[MAX_FRAME_TABLES];
} frame;

static void want(frame *f, gm_table_key key)
{
    if (key.symbol == f->options->leave_out)
        return;
    assert_true(f->n < MAX_FRAME_TABLES);
    f->keys[f->n++] = key;
}

static void want_path(frame *f, const gm_map *map, int p)
{
    for (int i = 0; i < 4; i++) {
        gm_table_key key = gm_table_key_of(GM_DRAG);
        key.path = p;
        key.direction[0] = i / 2;
        key.direction[1] = i % 2;
        want(f, key);
        key.symbol = GM_REACTION;
        want(f, key);
    }
    for (int i = 0; i < 2 * map->paths[p].n_gears; i++) {
        gm_table_key key = gm_table_key_of(GM_LOAD_LOSS);
        key.path = p;
        key.gear[p] = map->paths[p].gears[i / 2].number;
        key.direction[0] = i % 2;
        want(f, key);
        int number = key.gear[p];
        key.symbol = GM_LINE_JUMP;
        key.gear[p] = GM_MAP_ANY;
        key.line = fixture_line[p][i / 2];
        /* gear 2 does not drag; gear 3 only forward */
        if (f->options->optional && number != 2 && (number != 3 || i % 2 == 0))
            want(f, key);
    }
}

static void want_configurations(frame *f, const gm_map *map)
{
    int n1 = map->n_paths > 1 ? map->paths[1].n_gears + 1 : 1;
    for (int i = 0; i < 2 * n1 * (map->paths[0].n_gears + 1); i++) {
        gm_table_key key = gm_table_key_of(GM_PARASITIC);
        int g0 = i / 2 / n1 - 1, g1 = i / 2 % n1 - 1;
        key.gear[0] = g0 < 0 ? 0 : map->paths[0].gears[g0].number;
        if (map->n_paths > 1)
            key.gear[1] = g1 < 0 ? 0 : map->paths[1].gears[g1].number;
        key.direction[0] = i % 2;
        want(f, key);
        key.symbol = GM_BOTH_LOADED;
        if (f->options->optional && map->n_paths > 1 && g0 >= 0 && g1 >= 0)
            want(f, key);
    }
}

/* The fixture's axis of a quantity: its first n nodes. */
static void add(gm_map *map, const gm_table_key *key)
{
    const double *x[GM_MAX_AXES] = {output_speed, NULL, NULL};
    int n[GM_MAX_AXES] = {4, 0, 0}, n_axes = 1, index;
    gm_error error;
    if (key->symbol == GM_LOAD_LOSS || key->symbol == GM_DRAG ||
        key->symbol == GM_REACTION) {
        bool load = key->symbol == GM_LOAD_LOSS;
        x[0] = speed, n[0] = load ? 6 : 5;
        x[1] = load ? torque : output_speed, n[1] = load ? 7 : 4;
        n_axes = 2;
    } else if (key->symbol == GM_BOTH_LOADED) {
        x[1] = x[2] = torque + 1;
        n[0] = 2, n[1] = 3, n[2] = 5, n_axes = 3;
    } else if (key->symbol == GM_COUPLING) {
        x[0] = relative, n[0] = 5;
    }
    if (gm_map_add_table(map, key, n_axes, n, x, &index, &error) != GM_OK)
        fail_msg("%s", error.message);
    assert_int_equal(index, map->n_tables - 1);
}

static void set_paths(gm_map *map, int n_paths)
{
    static const char *const names[2][2] = {{"input", ""}, {"odd", "even"}};
    static const int numbers[2][2] = {{1, 3}, {-1, 2}};
    for (int p = 0; p < n_paths; p++) {
        gm_error error;
        if (gm_map_set_path(map, p, names[n_paths - 1][p], 2, &error) != GM_OK)
            fail_msg("%s", error.message);
        map->paths[p].sync_torque = 0.0;
        for (int g = 0; g < 2; g++) {
            map->paths[p].gears[g].number = numbers[p][g];
            map->paths[p].gears[g].ratio_given = (double)NAN;
        }
    }
}

gm_map *fixture_frame(const fixture_options *options)
{
    gm_map *map = gm_map_create();
    frame f = {.options = options};
    assert_non_null(map);
    strcpy(map->name, "pair");
    strcpy(map->title, "Two paths \"odd\" & <even>, Stra\xc3\x9f"
                       "e");
    strcpy(map->tool_version, "0.1.0");
    memset(map->input_sha256, 'a', 64);
    strcpy(map->options, "speed_step=auto torque_step=auto");
    map->speed_max = 675.4424205218055;
    map->torque_max = 250.0;
    map->oil_temperature = 353.15;
    set_paths(map, options->n_paths);
    want_configurations(&f, map);
    for (int p = 0; p < options->n_paths; p++)
        want_path(&f, map, p);
    if (options->optional && options->n_paths > 1)
        want(&f, gm_table_key_of(GM_COUPLING));
    for (int t = 0; t < f.n; t++)
        add(map, &f.keys[options->reversed ? f.n - 1 - t : t]);
    return map;
}

/* Values depend on the key, not on the order of the tables. */
static void fill_values(gm_map_table *t)
{
    uint64_t state = (uint64_t)t->key.symbol * 1000003u + (uint64_t)(t->key.path + 7);
    for (int p = 0; p < GM_MAX_PATHS; p++)
        state = state * 1009u + (uint64_t)(t->key.gear[p] + 5);
    state = state * 1013u + (uint64_t)(t->key.direction[0] * 3 + t->key.direction[1]);
    state = state * 1019u + (uint64_t)(8.0 * t->key.line + 100.0);
    (void)fixture_random(&state);
    for (int i = 0; i < gm_map_table_size(t); i++)
        t->value[i] = i == 0 ? 0.0 : 8.0 * fixture_random(&state) - 0.05;
}

gm_map *fixture_map(const fixture_options *options)
{
    gm_map *map = fixture_frame(options);
    uint64_t state = 42;
    map->inertia_output = 0.0875;
    for (int p = 0; p < map->n_paths; p++) {
        map->paths[p].inertia = 0.0031 + 0.001 * p;
        map->paths[p].sync_torque = 35.5 + p;
        for (int g = 0; g < map->paths[p].n_gears; g++) {
            gm_map_gear *gear = &map->paths[p].gears[g];
            double size = 3.0 + 10.0 * fixture_random(&state);
            gear->inertia_extra = 0.002 * g - 0.003;
            gear->ratio = gear->number < 0 ? -size : size;
            gear->ratio_given = gear->number == 3 ? (double)NAN : gear->ratio * 1.0001;
            gear->stiffness = 1e4 * (1.0 + fixture_random(&state));
            gear->damping = 3.0 * fixture_random(&state);
            gear->loose_damping = 9.0 * fixture_random(&state);
            gear->lash = 0.01 * fixture_random(&state);
            gear->film = 1e-4 * fixture_random(&state);
        }
    }
    for (int t = 0; t < map->n_tables; t++)
        fill_values(&map->tables[t]);
    return map;
}

void fixture_fill(gm_map *map, const gm_map *from)
{
    map->inertia_output = from->inertia_output;
    for (int p = 0; p < map->n_paths; p++) {
        map->paths[p].inertia = from->paths[p].inertia;
        map->paths[p].sync_torque = from->paths[p].sync_torque;
        memcpy(map->paths[p].gears, from->paths[p].gears,
               (size_t)map->paths[p].n_gears * sizeof *map->paths[p].gears);
    }
    for (int t = 0; t < map->n_tables; t++) {
        const gm_map_table *source = gm_map_find(from, &map->tables[t].key);
        assert_non_null(source);
        memcpy(map->tables[t].value, source->value,
               (size_t)gm_map_table_size(source) * sizeof *source->value);
    }
}

static bool same_bits(const double *a, const double *b, int n)
{
    return memcmp(a, b, (size_t)n * sizeof *a) == 0;
}

static bool same_number(double a, double b)
{
    return same_bits(&a, &b, 1) || (isnan(a) && isnan(b));
}

static bool same_path(const gm_map_path *a, const gm_map_path *b)
{
    bool same = strcmp(a->name, b->name) == 0 && same_number(a->inertia, b->inertia) &&
                same_number(a->sync_torque, b->sync_torque) && a->n_gears == b->n_gears;
    for (int g = 0; same && g < a->n_gears; g++)
        same = a->gears[g].number == b->gears[g].number &&
               same_number(a->gears[g].ratio, b->gears[g].ratio) &&
               same_number(a->gears[g].ratio_given, b->gears[g].ratio_given) &&
               same_number(a->gears[g].stiffness, b->gears[g].stiffness) &&
               same_number(a->gears[g].damping, b->gears[g].damping) &&
               same_number(a->gears[g].loose_damping, b->gears[g].loose_damping) &&
               same_number(a->gears[g].lash, b->gears[g].lash) &&
               same_number(a->gears[g].film, b->gears[g].film) &&
               same_number(a->gears[g].inertia_extra, b->gears[g].inertia_extra);
    return same;
}

static bool same_table(const gm_map_table *a, const gm_map_table *b)
{
    bool same = a && b && a->n_axes == b->n_axes;
    for (int k = 0; same && k < GM_MAX_AXES; k++)
        same = a->n[k] == b->n[k] &&
               (k >= a->n_axes || same_bits(a->x[k], b->x[k], a->n[k]));
    return same && same_bits(a->value, b->value, gm_map_table_size(a));
}

bool fixture_equal(const gm_map *a, const gm_map *b)
{
    bool same = strcmp(a->name, b->name) == 0 && strcmp(a->title, b->title) == 0 &&
                strcmp(a->input_sha256, b->input_sha256) == 0 &&
                strcmp(a->options, b->options) == 0 &&
                same_number(a->speed_max, b->speed_max) &&
                same_number(a->torque_max, b->torque_max) &&
                same_number(a->oil_temperature, b->oil_temperature) &&
                same_number(a->inertia_output, b->inertia_output) &&
                a->n_paths == b->n_paths && a->n_tables == b->n_tables;
    for (int p = 0; same && p < a->n_paths; p++)
        same = same_path(&a->paths[p], &b->paths[p]);
    for (int t = 0; same && t < a->n_tables; t++)
        same = same_table(&a->tables[t], gm_map_find(b, &a->tables[t].key));
    return same;
}
