/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Where the refinements begin. First samples lie as the quantities are known to bend (see
 * axes.h), few of them, with the kinks that the plant knows of; cuts lie where curves
 * differ in kind: at rest and at both ends, near zero, between.
 */
#include "sweep/control.h"

#include <math.h>
#include <string.h>

/* Of the tolerance: of what is compared with it, and of what comes on top. */
#define MAIN 0.85
#define ADDED 0.25
#define JUMP 0.02 /* of the drag; the output feels it through the gear */

#define NOISE 1e-7    /* of the largest torque: far above what a solver leaves */
#define SHORTEST 1e-5 /* interval, of the axis */
#define MAX_KINKS 8

#define SPEED_START 13
#define SPEED_SHARE 0.006
#define TORQUE_START 7
#define TORQUE_POWER 1.8
#define TORQUE_FLANK 0.0012
#define FREE_START 9
#define FREE_POWER 2.0
#define BOTH_START 5
#define BOTH_POWER 1.3

/* Most nodes. X has three axes and an edge across them, where the torques of both paths
   cancel in a mesh that they share, and which no grid follows: it is sampled coarsely,
   and where its nodes are not enough they are those of the automatic axes. */
#define SPEED_MOST 160
#define TORQUE_MOST 100
#define FREE_MOST 48
#define BOTH_SPEED_MOST 4
#define BOTH_TORQUE_MOST 13
#define BOTH_SPEED_PARTS 12.0 /* an axis over its shortest interval */
#define BOTH_TORQUE_PARTS 24.0

typedef struct builder {
    const gm_sweep_plan *plan;
    const gm_unit *unit;
    const gm_map_table *table;
    const gm_control_tolerance *tolerance;
    gm_refine_spec *spec;
} builder;

/* ---- axes ---- */

static void add_start(double x, gm_nodes *nodes)
{
    gm_nodes_add(x, GM_NODES_MAX, nodes);
}

/* The nearest start sample becomes a cut, which is a node too. */
static void add_cut(double x, gm_refine_axis *axis)
{
    const gm_nodes *s = &axis->start;
    int nearest = 0;
    for (int i = 1; i < s->n; i++)
        if (fabs(s->x[i] - x) < fabs(s->x[nearest] - x))
            nearest = i;
    for (int i = 0; i < axis->n_cuts; i++)
        if (axis->cut[i] == s->x[nearest])
            return;
    axis->cut[axis->n_cuts++] = axis->fixed[axis->n_fixed++] = s->x[nearest];
}

static void add_cuts(const double *part, int n, gm_refine_axis *axis)
{
    double end = axis->start.x[axis->start.n - 1];
    for (int i = 0; i < n; i++)
        add_cut(part[i] * end, axis);
}

static void end_axis(int n_max, gm_refine_axis *axis)
{
    const gm_nodes *s = &axis->start;
    axis->n_max = n_max;
    axis->shortest = SHORTEST * (s->x[s->n - 1] - s->x[0]);
}

static void speed_axis(const builder *b, gm_refine_axis *axis)
{
    static const double cuts[] = {0.0, 0.02, 0.15, 0.5, 1.0};
    const gm_plant *plant = b->plan->plant;
    const gm_table_key *key = &b->table->key;
    double kink[MAX_KINKS];
    int n = plant->is->kink_speeds(plant->self, key->path, key->gear[key->path],
                                   MAX_KINKS, kink);
    gm_nodes_growth(SPEED_START, b->plan->map->speed_max, SPEED_SHARE, &axis->start);
    for (int i = 0; i < n; i++)
        add_start(kink[i], &axis->start);
    add_cuts(cuts, 5, axis);
    end_axis(SPEED_MOST, axis);
}

static void torque_axis(const builder *b, gm_refine_axis *axis)
{
    static const double cuts[] = {-1.0, -0.35, -TORQUE_FLANK, 0.0, TORQUE_FLANK,
                                  0.35, 1.0};
    const gm_plant *plant = b->plan->plant;
    const gm_table_key *key = &b->table->key;
    double max = b->plan->map->torque_max, kink[MAX_KINKS];
    int n = plant->is->kink_torques(plant->self, key->path, key->gear[key->path],
                                    MAX_KINKS, kink);
    gm_nodes_power(TORQUE_START, max, TORQUE_POWER, &axis->start);
    add_start(TORQUE_FLANK * max, &axis->start);
    for (int i = 0; i < n; i++)
        add_start(kink[i], &axis->start);
    gm_nodes_mirror(&axis->start, &axis->start);
    add_cuts(cuts, 7, axis);
    end_axis(TORQUE_MOST, axis);
}

/* From the axis that the plan made: it has the right end. */
static double end_of(const builder *b, int axis)
{
    return b->table->x[axis][b->table->n[axis] - 1];
}

static void free_axis(const builder *b, int a, gm_refine_axis *axis)
{
    static const double cuts[] = {0.0, 0.06, 0.3, 1.0};
    gm_nodes_power(FREE_START, end_of(b, a), FREE_POWER, &axis->start);
    add_cuts(cuts, 4, axis);
    end_axis(FREE_MOST, axis);
}

static void line_axis(const builder *b, gm_refine_axis *axis)
{
    double leaves = b->plan->map->speed_max / fabs(b->table->key.line);
    gm_nodes_power(FREE_START, end_of(b, 0), FREE_POWER, &axis->start);
    add_start(leaves, &axis->start);
    if (leaves < end_of(b, 0))
        axis->fixed[axis->n_fixed++] = leaves;
    end_axis(FREE_MOST, axis);
}

/* P: as fine as a path's speed up to where the fastest path reaches its maximum. */
static void output_axis(const builder *b, gm_refine_axis *axis)
{
    gm_nodes_growth(SPEED_START, end_of(b, 0), SPEED_SHARE, &axis->start);
    end_axis(SPEED_MOST, axis);
}

/* A friction that jumps at zero rises over the first interval, which is about that of P
   and D at rest: it is not halved. */
static void coupling_axis(const builder *b, gm_refine_axis *axis)
{
    gm_nodes_power(FREE_START, end_of(b, 0), FREE_POWER, &axis->start);
    gm_nodes_mirror(&axis->start, &axis->start);
    double first = 0.001 * b->plan->map->speed_max;
    add_start(first, &axis->start);
    add_start(-first, &axis->start);
    axis->fixed[axis->n_fixed++] = 0.0;
    axis->fixed[axis->n_fixed++] = first;
    axis->fixed[axis->n_fixed++] = -first;
    end_axis(2 * FREE_MOST, axis);
    axis->shortest = axis->blind = first * (1.0 + 1e-9);
}

/* The axis as the plan made it. */
static void take_planned(const builder *b, int a, gm_nodes *nodes)
{
    nodes->n = b->table->n[a];
    memcpy(nodes->x, b->table->x[a], (size_t)nodes->n * sizeof nodes->x[0]);
}

static void both_torque_axis(const builder *b, int a, gm_refine_axis *axis)
{
    static const double cuts[] = {-1.0, -0.4, 0.4, 1.0};
    gm_nodes_power(BOTH_START, end_of(b, a), BOTH_POWER, &axis->start);
    gm_nodes_mirror(&axis->start, &axis->start);
    add_cuts(cuts, 4, axis);
    axis->fixed[axis->n_fixed++] = 0.0;
    end_axis(BOTH_TORQUE_MOST, axis);
    axis->shortest = 2.0 * end_of(b, a) / BOTH_TORQUE_PARTS;
    take_planned(b, a, &axis->otherwise);
}

static void both_axes(const builder *b, gm_refine_axis *axis)
{
    static const double cuts[] = {0.25, 1.0};
    gm_nodes_power(BOTH_SPEED_MOST, end_of(b, 0), FREE_POWER, &axis[0].start);
    add_cuts(cuts, 2, &axis[0]);
    end_axis(BOTH_SPEED_MOST, &axis[0]);
    axis[0].shortest = end_of(b, 0) / BOTH_SPEED_PARTS;
    take_planned(b, 0, &axis[0].otherwise);
    both_torque_axis(b, 1, &axis[1]);
    both_torque_axis(b, 2, &axis[2]);
}

static void axes_of(const builder *b)
{
    gm_refine_axis *axis = b->spec->axis;
    switch (b->unit->kind) {
    case GM_UNIT_COUPLING:
        coupling_axis(b, &axis[0]);
        break;
    case GM_UNIT_LINE:
        line_axis(b, &axis[0]);
        break;
    case GM_UNIT_PARASITIC:
        output_axis(b, &axis[0]);
        break;
    case GM_UNIT_LOAD:
        speed_axis(b, &axis[0]);
        torque_axis(b, &axis[1]);
        break;
    case GM_UNIT_DRAG:
        free_axis(b, 0, &axis[0]);
        free_axis(b, 1, &axis[1]);
        break;
    case GM_UNIT_BOTH:
        both_axes(b, axis);
        break;
    case GM_UNIT_KINDS:
        break;
    }
}

/* ---- tolerances ---- */

/* What a torque at a path's flange makes at the output, with the path that turns faster:
   there the loss with both under load is compared. */
static double lever(const builder *b)
{
    const gm_map *map = b->plan->map;
    double largest = 0.0;
    for (int p = 0; p < map->n_paths; p++)
        largest = fmax(largest, fabs(gm_sweep_ratio(map, p, b->table->key.gear[p])));
    return largest > 0.0 ? largest : 1.0;
}

static void tolerances(const builder *b, const double *output)
{
    gm_unit_kind kind = b->unit->kind;
    gm_refine_spec *spec = b->spec;
    double part = kind == GM_UNIT_COUPLING ? ADDED : kind == GM_UNIT_LINE ? JUMP : MAIN;
    double arm = kind == GM_UNIT_BOTH || kind == GM_UNIT_PARASITIC ? lever(b) : 1.0;
    spec->share = part * b->tolerance->share;
    for (int k = 0; k < spec->n_values; k++) {
        spec->absolute[k] = part * b->tolerance->torque * arm;
        spec->noise[k] = NOISE * b->plan->map->torque_max * arm;
    }
    if (!output)
        return;
    spec->share = 0.0;
    for (int k = 0; k < spec->n_values; k++)
        spec->absolute[k] = ADDED / MAIN * output[k];
}

void gm_control_spec(const gm_sweep_plan *plan, const gm_unit *unit,
                     const gm_control_tolerance *tolerance, const double *output,
                     gm_refine_spec *spec)
{
    const gm_map_table *table = &plan->map->tables[unit->table];
    builder b = {plan, unit, table, tolerance, spec};
    memset(spec, 0, sizeof *spec);
    spec->n_axes = table->n_axes;
    spec->n_values = gm_unit_values(unit) * table->slices;
    spec->is_sum = unit->kind == GM_UNIT_LOAD;
    spec->monotone = plan->monotone;
    axes_of(&b);
    tolerances(&b, output);
}
