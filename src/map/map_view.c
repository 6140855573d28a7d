/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The map as the reduced gearset reads it: the same numbers, arranged by gear,
 * configuration and direction, and the drag of the input side of each gear, which follows
 * from N. Optional tables that the map does not have (both paths
 * loaded, coupling, drag jumps) are zero; all others must be there.
 */
#include "base/alloc.h"
#include "map/map_rules.h"

#include <math.h>

struct gm_map_view {
    gm_reduced_map reduced;
    gm_gear *gears[GM_MAX_PATHS];
    gm_drag_line *lines[GM_MAX_PATHS];
    gm_real *pins[GM_MAX_PATHS]; /* [n_gears][2][slices][n], n of the drag's speed axes */
    gm_configuration *configurations;
};

#define SAME_RATIO 1e-9 /* relative: a drag line belongs to the gear */

/* What the steps below share. */
typedef struct builder {
    const gm_map *map;
    gm_map_view *view;
    gm_error *error;
} builder;

/* A table that is zero everywhere: one node, so there is no range to leave. */
static const gm_real zero_node[GM_MAP_MAX_OIL] = {0.0};
static const gm_table1 zero_table = {{1, zero_node}, zero_node, 0};

/* A slice of a table as a table of its own. */
static gm_table1 slice1(const gm_table1 *t, int k)
{
    gm_table1 slice = *t;
    slice.value = t->value ? t->value + (size_t)k * (size_t)t->x.n : NULL;
    return slice;
}

static gm_table2 slice2(const gm_table2 *t, int k)
{
    gm_table2 slice = *t;
    slice.value = t->value + (size_t)k * (size_t)t->x.n * (size_t)t->y.n;
    return slice;
}

static gm_axis axis_of(const gm_map_table *table, int a)
{
    return (gm_axis){table->n[a], table->x[a]};
}

static gm_table1 table1_of(const gm_map_table *t)
{
    return (gm_table1){axis_of(t, 0), t->value, 0};
}

static gm_table2 table2_of(const gm_map_table *t)
{
    return (gm_table2){axis_of(t, 0), axis_of(t, 1), t->value, 0};
}

static gm_table3 table3_of(const gm_map_table *t)
{
    return (gm_table3){axis_of(t, 0), axis_of(t, 1), axis_of(t, 2), t->value};
}

static gm_status find_required(const builder *b, const gm_table_key *key,
                               const gm_map_table **table)
{
    char words[GM_KEY_TEXT];
    *table = gm_map_find(b->map, key);
    if (*table)
        return GM_OK;
    gm_map_key_text(b->map, key, words);
    return gm_fail(b->error, GM_ERR_FORMAT, "the map has no table %s", words);
}

static gm_status build_gear(const builder *b, int p, int g)
{
    const gm_map_gear *from = &b->map->paths[p].gears[g];
    gm_gear *gear = &b->view->gears[p][g];
    gm_table_key key = gm_table_key_of(GM_LOAD_LOSS);
    gear->number = from->number;
    gear->ratio = from->ratio;
    gear->stiffness = from->stiffness;
    gear->damping = from->damping;
    gear->loose_damping = from->loose_damping;
    gear->lash = from->lash;
    gear->film = from->film;
    gear->inertia_extra = from->inertia_extra;
    key.path = p;
    key.gear[p] = from->number;
    for (int d = 0; d < 2; d++) {
        const gm_map_table *table;
        key.direction[0] = d;
        gm_status status = find_required(b, &key, &table);
        if (status != GM_OK)
            return status;
        gear->load_loss[d] = table2_of(table);
    }
    return GM_OK;
}

static gm_drag_line *line_of(const builder *b, int p, int *n, double ratio)
{
    gm_drag_line *lines = b->view->lines[p];
    for (int i = 0; i < *n; i++)
        if (lines[i].ratio == ratio)
            return &lines[i];
    lines[*n] = (gm_drag_line){ratio, {zero_table, zero_table}};
    return &lines[(*n)++];
}

/* One line for each ratio at which the path's drag jumps in at least one direction. */
static gm_status build_lines(const builder *b, int p)
{
    int n = 0;
    b->view->lines[p] = gm_calloc((size_t)b->map->n_tables, sizeof *b->view->lines[p]);
    if (!b->view->lines[p])
        return gm_fail(b->error, GM_ERR_MEMORY, "no memory to view the map");
    for (int t = 0; t < b->map->n_tables; t++) {
        const gm_map_table *table = &b->map->tables[t];
        if (table->key.symbol == GM_LINE_JUMP && table->key.path == p)
            line_of(b, p, &n, table->key.line)->jump[table->key.direction[0]] =
                table1_of(table);
    }
    b->view->reduced.path[p].n_lines = n;
    b->view->reduced.path[p].lines = b->view->lines[p];
    return GM_OK;
}

static gm_status build_drag(const builder *b, int p, gm_symbol symbol,
                            gm_table2 tables[2][2])
{
    gm_table_key key = gm_table_key_of(symbol);
    key.path = p;
    for (int i = 0; i < 4; i++) {
        const gm_map_table *table;
        key.direction[0] = i / 2;
        key.direction[1] = i % 2;
        gm_status status = find_required(b, &key, &table);
        if (status != GM_OK)
            return status;
        tables[i / 2][i % 2] = table2_of(table);
    }
    return GM_OK;
}

/* N of path p where it turns with its gear: the table and every line's jump, of its own
 * line the mean of both sides. dir: of the path; w: |w_p|, at 0 the limit; k: slice. */
static double drag_in_gear(const gm_path *path, const gm_gear *gear, int dir, int k,
                           double w)
{
    const double sign = dir == GM_BACKWARD ? -1.0 : 1.0, w_o = w / fabs(gear->ratio);
    const int dir_o = gear->ratio < 0.0 ? 1 - dir : dir;
    const gm_table2 drag = slice2(&path->drag[dir][dir_o], k);
    gm_cell2 cell = {0};
    double sum = gm_table2_at(&drag, 1, &cell, w, w_o).value;
    for (int l = 0; l < path->n_lines; l++) {
        const gm_drag_line *line = &path->lines[l];
        const double ahead = 1.0 - line->ratio / gear->ratio;
        const gm_table1 of = slice1(&line->jump[dir_o], k);
        gm_cell1 cell_1 = {0};
        double jump = gm_table1_at(&of, 1, &cell_1, w_o).value;
        if (fabs(ahead) > SAME_RATIO)
            sum += ahead > 0.0 ? sign * jump / 2.0 : -sign * jump / 2.0;
    }
    return sign * sum;
}

/* What brakes the input side in each gear, on the speed axes of N. */
static gm_status build_pins(const builder *b, int p)
{
    const gm_path *path = &b->view->reduced.path[p];
    gm_gear *gears = b->view->gears[p];
    const int slices = gm_map_slices(b->map);
    size_t n = (size_t)path->drag[0][0].x.n + (size_t)path->drag[1][1].x.n;
    gm_real *value = gm_calloc((size_t)path->n_gears * (size_t)slices * n, sizeof *value);
    b->view->pins[p] = value;
    if (!value)
        return gm_fail(b->error, GM_ERR_MEMORY, "no memory to view the map");
    for (int g = 0; g < path->n_gears; g++)
        for (int d = 0; d < 2; d++) {
            const gm_axis *x = &path->drag[d][d].x;
            gears[g].pin[d] = (gm_table1){*x, value, 0};
            for (int i = 0; i < slices * x->n; i++)
                *value++ =
                    fmax(0.0, drag_in_gear(path, &gears[g], d, i / x->n, x->x[i % x->n]));
        }
    return GM_OK;
}

static gm_status build_path(const builder *b, int p)
{
    const gm_map_path *from = &b->map->paths[p];
    gm_path *path = &b->view->reduced.path[p];
    gm_status status = GM_OK;
    b->view->gears[p] = gm_calloc((size_t)from->n_gears, sizeof *b->view->gears[p]);
    if (!b->view->gears[p])
        return gm_fail(b->error, GM_ERR_MEMORY, "no memory to view the map");
    path->inertia = from->inertia;
    path->sync_torque = from->sync_torque;
    path->n_gears = from->n_gears;
    path->gears = b->view->gears[p];
    for (int g = 0; status == GM_OK && g < from->n_gears; g++)
        status = build_gear(b, p, g);
    if (status != GM_OK || !gm_map_has_neutral(b->map, p))
        return status;
    status = build_drag(b, p, GM_DRAG, path->drag);
    if (status == GM_OK)
        status = build_drag(b, p, GM_REACTION, path->reaction);
    if (status == GM_OK)
        status = build_lines(b, p);
    return status == GM_OK ? build_pins(b, p) : status;
}

static int gear_number(const gm_map_path *path, int g)
{
    return g < 0 ? GM_NEUTRAL : path->gears[g].number;
}

/* Key of a table of configuration c and direction d. */
static gm_table_key configuration_key(const gm_map *map, const gm_configuration *c,
                                      gm_symbol symbol, int d)
{
    gm_table_key key = gm_table_key_of(symbol);
    key.direction[0] = d;
    for (int p = 0; p < map->n_paths; p++)
        key.gear[p] = gear_number(&map->paths[p], c->gear[p]);
    return key;
}

/* One path at least would be in a neutral that it does not have. */
static int is_impossible(const gm_map *map, const gm_configuration *c)
{
    int impossible = 0;
    for (int p = 0; p < map->n_paths; p++)
        impossible |= c->gear[p] < 0 && !gm_map_has_neutral(map, p);
    return impossible;
}

static gm_status build_configuration(const builder *b, gm_configuration *c)
{
    for (int d = 0; d < 2; d++) {
        const gm_map_table *table;
        gm_table_key key = configuration_key(b->map, c, GM_PARASITIC, d);
        gm_status status = find_required(b, &key, &table);
        if (status != GM_OK)
            return status;
        c->parasitic[d] = table1_of(table);
        key.symbol = GM_BOTH_LOADED;
        table = gm_map_find(b->map, &key);
        if (table)
            c->both_loaded[d] = table3_of(table);
    }
    return GM_OK;
}

static gm_status build_configurations(const builder *b)
{
    const gm_map *map = b->map;
    int n1 = map->n_paths > 1 ? map->paths[1].n_gears + 1 : 1;
    int n = (map->paths[0].n_gears + 1) * n1;
    gm_status status = GM_OK;
    b->view->configurations = gm_calloc((size_t)n, sizeof *b->view->configurations);
    if (!b->view->configurations)
        return gm_fail(b->error, GM_ERR_MEMORY, "no memory to view the map");
    for (int i = 0; status == GM_OK && i < n; i++) {
        gm_configuration *c = &b->view->configurations[i];
        c->gear[0] = i / n1 - 1;
        c->gear[1] = i % n1 - 1;
        if (!is_impossible(map, c))
            status = build_configuration(b, c);
    }
    b->view->reduced.n_configurations = n;
    b->view->reduced.configurations = b->view->configurations;
    return status;
}

/* In slice k. */
static double value_at(const gm_table1 *t, int k, double x)
{
    const gm_table1 slice = slice1(t, k);
    gm_cell1 cell = {0};
    if (!t->value)
        return 0.0;
    return gm_table1_at(&slice, 1, &cell, x).value;
}

/* What the pins of a configuration take from the output at w_o in direction d. */
static double pins_of(const gm_reduced_map *reduced, const gm_configuration *c, int d,
                      int k, double w_o)
{
    double sum = 0.0;
    for (int p = 0; p < reduced->n_paths; p++) {
        if (c->gear[p] < 0)
            continue;
        const gm_gear *gear = &reduced->path[p].gears[c->gear[p]];
        double r = fabs(gear->ratio);
        sum += r * value_at(&gear->pin[gear->ratio < 0.0 ? 1 - d : d], k, r * w_o);
    }
    return sum;
}

/* A gear's pin must leave the output a loss in every configuration, P - sum |r| pin >= 0:
 * a gearset's does by itself, but a map may hold anything. */
static void limit_pin(const builder *b, int p, int g, int d)
{
    const gm_reduced_map *reduced = &b->view->reduced;
    const gm_gear *gear = &reduced->path[p].gears[g];
    const gm_axis *x = &gear->pin[d].x;
    gm_real *value = b->view->pins[p] + (gear->pin[d].value - b->view->pins[p]);
    const int d_o = gear->ratio < 0.0 ? 1 - d : d;
    for (int i = 0; i < gm_map_slices(b->map) * x->n; i++)
        for (int c = 0; c < reduced->n_configurations; c++) {
            const gm_configuration *at = &reduced->configurations[c];
            const int k = i / x->n;
            double w_o = x->x[i % x->n] / fabs(gear->ratio);
            if (at->gear[p] != g || !at->parasitic[d_o].value)
                continue;
            double most = value_at(&at->parasitic[d_o], k, w_o);
            double sum = pins_of(reduced, at, d_o, k, w_o);
            if (sum > most)
                value[i] *= fmax(0.0, most) / sum;
        }
}

static void limit_pins(const builder *b)
{
    for (int p = 0; p < b->view->reduced.n_paths; p++)
        for (int g = 0; g < b->view->reduced.path[p].n_gears; g++)
            for (int d = 0; d < 2; d++)
                if (b->view->gears[p][g].pin[d].value)
                    limit_pin(b, p, g, d);
}

static gm_status build(const builder *b)
{
    gm_reduced_map *reduced = &b->view->reduced;
    gm_status status = gm_map_check(b->map, b->error);
    gm_table_key key = gm_table_key_of(GM_COUPLING);
    const gm_map_table *coupling = gm_map_find(b->map, &key);
    reduced->n_paths = b->map->n_paths;
    reduced->inertia_output = b->map->inertia_output;
    reduced->oil_temperature = b->map->oil_temperature;
    reduced->oil = (gm_oil_axis){b->map->n_oil, b->map->oil, b->map->oil_bend};
    if (coupling)
        reduced->coupling = table1_of(coupling);
    for (int p = 0; status == GM_OK && p < reduced->n_paths; p++)
        status = build_path(b, p);
    if (status == GM_OK)
        status = build_configurations(b);
    if (status == GM_OK)
        limit_pins(b);
    return status;
}

gm_status gm_map_view_create(const gm_map *map, gm_map_view **view, gm_error *error)
{
    gm_map_view *made = gm_calloc(1, sizeof *made);
    if (!made)
        return gm_fail(error, GM_ERR_MEMORY, "no memory to view the map");
    gm_status status = build(&(builder){map, made, error});
    if (status == GM_OK)
        *view = made;
    else
        gm_map_view_destroy(made);
    return status;
}

static void make_path_monotone(gm_map_view *view, int p)
{
    gm_path *path = &view->reduced.path[p];
    for (int d = 0; d < 2; d++) {
        for (int g = 0; g < path->n_gears; g++)
            view->gears[p][g].load_loss[d].monotone = view->gears[p][g].pin[d].monotone =
                1;
        for (int l = 0; l < path->n_lines; l++)
            view->lines[p][l].jump[d].monotone = 1;
        for (int o = 0; o < 2; o++)
            path->drag[d][o].monotone = path->reaction[d][o].monotone = 1;
    }
}

void gm_map_view_make_monotone(gm_map_view *view)
{
    for (int p = 0; p < view->reduced.n_paths; p++)
        make_path_monotone(view, p);
    for (int i = 0; i < view->reduced.n_configurations; i++)
        for (int d = 0; d < 2; d++)
            view->configurations[i].parasitic[d].monotone = 1;
    view->reduced.coupling.monotone = 1;
}

void gm_map_view_destroy(gm_map_view *view)
{
    if (!view)
        return;
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        gm_free(view->gears[p]);
        gm_free(view->lines[p]);
        gm_free(view->pins[p]);
    }
    gm_free(view->configurations);
    gm_free(view);
}

const gm_reduced_map *gm_map_view_reduced(const gm_map_view *view)
{
    return &view->reduced;
}
