/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/plan.h"

#include "base/alloc.h"
#include "sweep/axes.h"

#include <math.h>

/* Nodes of the automatic axes, chosen for the smallest error of the example at random
   points between them; see axes.h. Kinks may add a few.

   A driving torque that rises from zero turns the flanks of one mesh after the other: one
   that was driven by the drag behind it now carries. The loss dips below that of zero
   torque and is back on its line when the last mesh has turned, at some 0.5 N.m of 250, a
   little elsewhere at every speed. Two torques share this: the bottom of the dip and its
   end. Below zero there is no dip, but the loss bends most there as well. X steps by what
   a preselected path loses more or less while the meshes that both share lie on the other
   flank: from the end of that step on it hardly changes. */
#define SPEED_NODES 35
#define SPEED_NODES_MAX 40
#define SPEED_SHARE 0.006 /* even steps below 40 rpm of 6500 */
#define OVERSPEED_NODES 4 /* of a preselected path that turns faster than its maximum */
#define TORQUE_NODES 14   /* of each sign, with zero */
#define TORQUE_POWER 1.8
#define TORQUE_DIP 0.00048  /* of the largest torque: 0.12 of 250 N.m */
#define TORQUE_FLANK 0.0036 /* 0.9 of 250 N.m */
#define FREE_NODES 21       /* N and R: path speed */
#define FREE_OUTPUT_NODES 20
#define FREE_POWER 2.0
#define COUPLING_NODES 11
#define COUPLING_POWER 3.0
#define BOTH_SPEED_NODES 4
#define BOTH_SPEED_POWER 2.0
#define BOTH_TORQUE_NODES 7 /* below zero; above, the flank takes the place of one */
#define BOTH_TORQUE_POWER 1.3
#define BOTH_TORQUE_FLANK 0.012 /* 3 of 250 N.m */
#define MAX_KINKS 8

typedef struct builder {
    const gm_plant *plant;
    const gm_sweep_options *options;
    gm_map *map;
    gm_sweep_plan *plan;
    gm_error *error;
    gm_nodes axis[GM_MAX_AXES]; /* of the table being added */
    gm_nodes free_speed, free_output;
    double first_speed; /* first node above zero of the path speed axes */
} builder;

int gm_sweep_rest_gear(const gm_plant *plant, int p)
{
    const gm_plant_path *path = &plant->info.path[p];
    return p < plant->info.n_paths && path->always_engaged ? path->gears[0].number
                                                           : GM_NEUTRAL;
}

/* Paths that have no neutral. */
static int always_engaged(const gm_plant *plant)
{
    int n = 0;
    for (int p = 0; p < plant->info.n_paths; p++)
        n += plant->info.path[p].always_engaged;
    return n;
}

gm_table_key gm_sweep_load_key(int path, int gear, int direction)
{
    gm_table_key key = gm_table_key_of(GM_LOAD_LOSS);
    key.path = path;
    key.gear[path] = gear;
    key.direction[0] = direction;
    return key;
}

gm_table_key gm_sweep_line_key(int path, double line, int direction)
{
    gm_table_key key = gm_table_key_of(GM_LINE_JUMP);
    key.path = path;
    key.line = line;
    key.direction[0] = direction;
    return key;
}

gm_table_key gm_sweep_configuration_key(gm_symbol symbol, const gm_map *map,
                                        const int *gear, int direction)
{
    gm_table_key key = gm_table_key_of(symbol);
    for (int p = 0; p < map->n_paths; p++)
        key.gear[p] = gear[p];
    key.direction[0] = direction;
    return key;
}

double gm_sweep_ratio(const gm_map *map, int p, int number)
{
    const gm_map_path *path = &map->paths[p];
    for (int g = 0; g < path->n_gears; g++)
        if (path->gears[g].number == number)
            return path->gears[g].ratio;
    return 0.0;
}

/* Smallest or largest |ratio| over the gears of a configuration; over all gears when it
   is neutral. */
static void ratio_range(const gm_map *map, const int *gear, double *low, double *high)
{
    *low = HUGE_VAL;
    *high = 0.0;
    int neutral = 1;
    for (int p = 0; p < map->n_paths; p++)
        neutral = neutral && gear[p] == GM_NEUTRAL;
    for (int p = 0; p < map->n_paths; p++)
        for (int g = 0; g < map->paths[p].n_gears; g++) {
            const gm_map_gear *of = &map->paths[p].gears[g];
            if (!neutral && of->number != gear[p])
                continue;
            *low = fmin(*low, fabs(of->ratio));
            *high = fmax(*high, fabs(of->ratio));
        }
}

static gm_status add_table(builder *b, const gm_table_key *key, int n_axes, int *index)
{
    int n[GM_MAX_AXES] = {1, 1, 1};
    const double *x[GM_MAX_AXES] = {NULL, NULL, NULL};
    for (int k = 0; k < n_axes; k++) {
        n[k] = b->axis[k].n;
        x[k] = b->axis[k].x;
    }
    return gm_map_add_table(b->map, key, n_axes, n, x, index, b->error);
}

static gm_status add_unit(builder *b, gm_unit unit)
{
    gm_sweep_plan *plan = b->plan;
    if (plan->n_units == plan->units_size) {
        int size = 2 * plan->n_units + 16;
        gm_unit *units = gm_resize(plan->units, (size_t)size, sizeof *units);
        if (!units)
            return gm_fail(b->error, GM_ERR_MEMORY, "no memory for the sweep's plan");
        plan->units = units;
        plan->units_size = size;
    }
    plan->units[plan->n_units++] = unit;
    return GM_OK;
}

/* --- axes ------------------------------------------------------------------------- */

static int by_steps(const builder *b)
{
    return b->options->speed_step > 0;
}

/* Speeds of a path in a gear, also where nothing special happens (number 0). */
static gm_status speed_axis(builder *b, int p, int number, gm_nodes *nodes)
{
    double max = b->map->speed_max;
    if (by_steps(b))
        return gm_nodes_uniform(max, b->options->speed_step, "speed", nodes, b->error);
    gm_nodes_growth(SPEED_NODES, max, SPEED_SHARE, nodes);
    double kinks[MAX_KINKS];
    int n = number == GM_NEUTRAL
                ? 0
                : b->plant->is->kink_speeds(b->plant->self, p, number, MAX_KINKS, kinks);
    for (int k = 0; k < n; k++)
        gm_nodes_include(kinks[k], SPEED_NODES_MAX, nodes);
    return GM_OK;
}

/* Two kinks may move their neighbours; more would tear the axis open. */
static void include_kinks(const double *kinks, int n, gm_nodes *nodes)
{
    int most = TORQUE_NODES + (n > 2 ? n - 2 : 0);
    for (int k = 0; k < n; k++)
        gm_nodes_include(kinks[k], most, nodes);
}

/* Torques of a path in a gear, both signs. */
static gm_status torque_axis(builder *b, int p, int number, gm_nodes *nodes)
{
    double max = b->map->torque_max, kinks[MAX_KINKS];
    if (b->options->torque_step > 0) {
        gm_status status =
            gm_nodes_uniform(max, b->options->torque_step, "torque", nodes, b->error);
        if (status == GM_OK)
            gm_nodes_mirror(nodes, nodes);
        return status;
    }
    gm_nodes driven;
    int n = b->plant->is->kink_torques(b->plant->self, p, number, MAX_KINKS, kinks);
    gm_nodes_power(TORQUE_NODES - 1, max, TORQUE_POWER, &driven);
    gm_nodes_power(TORQUE_NODES - 2, max, TORQUE_POWER, nodes);
    gm_nodes_add(TORQUE_FLANK * max, TORQUE_NODES, &driven);
    gm_nodes_add(TORQUE_FLANK * max, TORQUE_NODES, nodes);
    gm_nodes_add(TORQUE_DIP * max, TORQUE_NODES, nodes);
    include_kinks(kinks, n, &driven);
    include_kinks(kinks, n, nodes);
    gm_nodes_mirror(&driven, nodes);
    return GM_OK;
}

/* Output speeds of a configuration with no or all paths engaged: as fine as a path's axis
   up to where the fastest path reaches its maximum, coarser to where the slowest does. */
static gm_status output_axis(builder *b, const int *gear, gm_nodes *nodes)
{
    double low, high;
    ratio_range(b->map, gear, &low, &high);
    gm_status status = speed_axis(b, 0, GM_NEUTRAL, nodes);
    if (status != GM_OK)
        return status;
    double end = nodes->x[nodes->n - 1] / low;
    int neutral = gear[0] == GM_NEUTRAL;
    gm_nodes_scale(neutral ? 1.0 / low : 1.0 / high, nodes);
    if (!neutral && high > low * (1.0 + 1e-9))
        gm_nodes_extend(end, OVERSPEED_NODES, nodes);
    return GM_OK;
}

static void free_axes(builder *b)
{
    double low, high;
    int neutral[GM_MAX_PATHS] = {GM_NEUTRAL, GM_NEUTRAL};
    ratio_range(b->map, neutral, &low, &high);
    gm_nodes_power(FREE_NODES, b->map->speed_max, FREE_POWER, &b->free_speed);
    gm_nodes_power(FREE_OUTPUT_NODES, b->map->speed_max / low, FREE_POWER,
                   &b->free_output);
}

/* --- tables and their units ------------------------------------------------------- */

static gm_status plan_coupling(builder *b)
{
    gm_table_key key = gm_table_key_of(GM_COUPLING);
    gm_unit unit = {GM_UNIT_COUPLING, 1, 0, -1};
    /* Two shafts may turn against each other at full speed. A friction that jumps at zero
       rises over the first cell, which is that of P and D: P(0) holds the jump. */
    gm_nodes_power(COUPLING_NODES, 2.0 * b->map->speed_max, COUPLING_POWER, &b->axis[0]);
    gm_nodes_include(b->first_speed, COUPLING_NODES + 1, &b->axis[0]);
    gm_nodes_mirror(&b->axis[0], &b->axis[0]);
    gm_status status = add_table(b, &key, 1, &unit.table);
    return status != GM_OK ? status : add_unit(b, unit);
}

static gm_status find_lines(builder *b, int p)
{
    gm_sweep_plan *plan = b->plan;
    plan->n_lines[p] =
        b->plant->is->drag_lines(b->plant->self, p, GM_SWEEP_MAX_LINES, plan->line[p]);
    if (plan->n_lines[p] < GM_SWEEP_MAX_LINES)
        return GM_OK;
    return gm_fail(
        b->error, GM_ERR_ARGUMENT,
        "%s: the drag of path %s jumps on %d lines or more, fewer are possible",
        b->plant->info.name, b->map->paths[p].name, GM_SWEEP_MAX_LINES);
}

static gm_status plan_lines(builder *b, int p)
{
    gm_status status = find_lines(b, p);
    for (int i = 0; i < 2 * b->plan->n_lines[p] && status == GM_OK; i++) {
        gm_table_key key = gm_sweep_line_key(p, b->plan->line[p][i / 2], i % 2);
        gm_unit unit = {GM_UNIT_LINE, 1, 0, -1};
        b->axis[0] = b->free_output;
        status = add_table(b, &key, 1, &unit.table);
        if (status == GM_OK)
            status = add_unit(b, unit);
    }
    return status;
}

static gm_status plan_parasitic(builder *b, const int *gear, int phase)
{
    gm_status status = output_axis(b, gear, &b->axis[0]);
    for (int d = 0; d < 2 && status == GM_OK; d++) {
        gm_table_key key = gm_sweep_configuration_key(GM_PARASITIC, b->map, gear, d);
        gm_unit unit = {GM_UNIT_PARASITIC, phase, 0, -1};
        status = add_table(b, &key, 1, &unit.table);
        if (status == GM_OK)
            status = add_unit(b, unit);
    }
    return status;
}

/* One path in gear, the other at rest: D, and P at the same speeds. Two paths that are
   always engaged have one P. */
static gm_status plan_load(builder *b, int p, const gm_map_gear *of, int direction)
{
    int gear[GM_MAX_PATHS];
    for (int q = 0; q < GM_MAX_PATHS; q++)
        gear[q] = q == p ? of->number : gm_sweep_rest_gear(b->plant, q);
    int output_direction = of->ratio < 0 ? !direction : direction;
    gm_table_key load = gm_sweep_load_key(p, of->number, direction);
    gm_table_key parasitic =
        gm_sweep_configuration_key(GM_PARASITIC, b->map, gear, output_direction);
    gm_unit unit = {GM_UNIT_LOAD, 2, 0, -1};
    gm_status status = speed_axis(b, p, of->number, &b->axis[0]);
    if (status == GM_OK)
        status = torque_axis(b, p, of->number, &b->axis[1]);
    if (status == GM_OK)
        status = add_table(b, &load, 2, &unit.table);
    gm_nodes_scale(1.0 / fabs(of->ratio), &b->axis[0]);
    if (status == GM_OK && !gm_map_find(b->map, &parasitic))
        status = add_table(b, &parasitic, 1, &unit.companion);
    return status != GM_OK ? status : add_unit(b, unit);
}

static gm_status plan_drag(builder *b, int p, int direction, int output_direction)
{
    gm_table_key key = gm_table_key_of(GM_DRAG);
    key.path = p;
    key.direction[0] = direction;
    key.direction[1] = output_direction;
    gm_unit unit = {GM_UNIT_DRAG, 2, 0, 0};
    b->axis[0] = b->free_speed;
    b->axis[1] = b->free_output;
    gm_status status = add_table(b, &key, 2, &unit.table);
    key.symbol = GM_REACTION;
    if (status == GM_OK)
        status = add_table(b, &key, 2, &unit.companion);
    return status != GM_OK ? status : add_unit(b, unit);
}

static void both_torque_axis(double max, gm_nodes *nodes)
{
    gm_nodes driven;
    gm_nodes_power(BOTH_TORQUE_NODES, max, BOTH_TORQUE_POWER, &driven);
    gm_nodes_power(BOTH_TORQUE_NODES - 1, max, BOTH_TORQUE_POWER, nodes);
    gm_nodes_add(BOTH_TORQUE_FLANK * max, BOTH_TORQUE_NODES, nodes);
    gm_nodes_mirror(&driven, nodes);
}

static gm_status plan_both(builder *b, const int *gear, int direction)
{
    double low, high;
    ratio_range(b->map, gear, &low, &high);
    gm_table_key key =
        gm_sweep_configuration_key(GM_BOTH_LOADED, b->map, gear, direction);
    gm_nodes_power(BOTH_SPEED_NODES, b->map->speed_max / high, BOTH_SPEED_POWER,
                   &b->axis[0]);
    both_torque_axis(b->map->torque_max, &b->axis[1]);
    b->axis[2] = b->axis[1];
    gm_unit unit = {GM_UNIT_BOTH, 3, 0, -1};
    gm_status status = add_table(b, &key, 3, &unit.table);
    return status != GM_OK ? status : add_unit(b, unit);
}

static gm_status plan_path(builder *b, int p)
{
    const gm_map_path *path = &b->map->paths[p];
    int free = !b->plant->info.path[p].always_engaged;
    gm_status status = free ? plan_lines(b, p) : GM_OK;
    for (int i = 0; i < 2 * path->n_gears && status == GM_OK; i++)
        status = plan_load(b, p, &path->gears[i / 2], i % 2);
    for (int i = 0; free && i < 4 && status == GM_OK; i++)
        status = plan_drag(b, p, i / 2, i % 2);
    return status;
}

static gm_status plan_doubles(builder *b)
{
    gm_status status = GM_OK;
    int n_0 = b->map->paths[0].n_gears, n_1 = b->map->paths[1].n_gears;
    for (int i = 0; i < n_0 * n_1 && status == GM_OK; i++) {
        int gear[GM_MAX_PATHS] = {b->map->paths[0].gears[i / n_1].number,
                                  b->map->paths[1].gears[i % n_1].number};
        status = always_engaged(b->plant) ? GM_OK : plan_parasitic(b, gear, 3);
        for (int d = 0; d < 2 && status == GM_OK; d++)
            status = plan_both(b, gear, d);
    }
    return status;
}

static gm_status plan_all(builder *b)
{
    int neutral[GM_MAX_PATHS] = {GM_NEUTRAL, GM_NEUTRAL};
    int two = b->map->n_paths == 2;
    gm_status status = speed_axis(b, 0, GM_NEUTRAL, &b->axis[0]);
    if (status != GM_OK)
        return status;
    b->first_speed = b->axis[0].x[1];
    free_axes(b);
    int fixed = always_engaged(b->plant);
    if (two && b->plant->info.coupled && fixed == 0)
        status = plan_coupling(b);
    if (status == GM_OK && fixed == 0)
        status = plan_parasitic(b, neutral, 1);
    for (int p = 0; p < b->map->n_paths && status == GM_OK; p++)
        status = plan_path(b, p);
    return status == GM_OK && two ? plan_doubles(b) : status;
}

int gm_unit_values(const gm_unit *unit)
{
    return unit->kind == GM_UNIT_LOAD || unit->kind == GM_UNIT_DRAG ? 2 : 1;
}

int gm_unit_rows(const gm_sweep_plan *plan, const gm_unit *unit)
{
    return plan->map->tables[unit->table].n[0];
}

int gm_unit_row_points(const gm_sweep_plan *plan, const gm_unit *unit)
{
    int sides = unit->kind == GM_UNIT_COUPLING || unit->kind == GM_UNIT_LINE;
    const gm_map_table *table = &plan->map->tables[unit->table];
    return gm_map_row_size(table) * table->slices * (1 + sides);
}

gm_status gm_unit_set_axes(gm_sweep_plan *plan, const gm_unit *unit, const gm_nodes *axes,
                           gm_error *error)
{
    gm_map *map = plan->map;
    const gm_table_key *key = &map->tables[unit->table].key;
    int n_axes = map->tables[unit->table].n_axes, n[GM_MAX_AXES] = {1, 1, 1};
    const double *x[GM_MAX_AXES] = {NULL, NULL, NULL};
    for (int a = 0; a < n_axes; a++) {
        n[a] = axes[a].n;
        x[a] = axes[a].x;
    }
    gm_status status = gm_map_set_axes(map, unit->table, n, x, error);
    if (status != GM_OK || unit->companion < 0)
        return status;
    if (unit->kind != GM_UNIT_LOAD)
        return gm_map_set_axes(map, unit->companion, n, x, error);
    gm_nodes output = axes[0]; /* P over the output's speed */
    gm_nodes_scale(1.0 / fabs(gm_sweep_ratio(map, key->path, key->gear[key->path])),
                   &output);
    x[0] = output.x;
    return gm_map_set_axes(map, unit->companion, n, x, error);
}

static void set_plants(const gm_plant *plant, const gm_sweep_options *options,
                       gm_sweep_plan *plan)
{
    int n = options->n_oil, between = options->between_oil && n > 0 ? n - 1 : 0;
    plan->plants[0] = plant;
    for (int k = 0; k < n; k++)
        plan->plants[k] = options->at_oil[k];
    for (int k = 0; k < between; k++)
        plan->plants[n + k] = options->between_oil[k];
    plan->plant = plan->plants[0];
    plan->n_plants = n > 0 ? n + between : 1;
}

gm_status gm_sweep_plan_create(const gm_plant *plant, const gm_sweep_options *options,
                               gm_map *map, gm_sweep_plan **plan, gm_error *error)
{
    builder *b = gm_calloc(1, sizeof *b);
    gm_sweep_plan *made = gm_calloc(1, sizeof *made);
    gm_status status = GM_ERR_MEMORY;
    if (!b || !made) {
        gm_fail(error, status, "no memory for the sweep's plan");
        goto done;
    }
    made->map = map;
    set_plants(plant, options, made);
    made->monotone = options->monotone;
    b->plant = plant;
    b->options = options;
    b->map = map;
    b->plan = made;
    b->error = error;
    status = plan_all(b);
    if (status == GM_OK) {
        *plan = made;
        made = NULL;
    }
done:
    gm_free(b);
    gm_sweep_plan_destroy(made);
    return status;
}

void gm_sweep_plan_destroy(gm_sweep_plan *plan)
{
    if (!plan)
        return;
    gm_free(plan->units);
    gm_free(plan);
}
