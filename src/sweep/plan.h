/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What a sweep has to do: the tables of the map with their axes, and one unit for every
 * table (or pair of tables that come out of the same points). A unit's rows (first axis
 * fixed) depend on units of earlier phases only, so neither the order within a phase nor
 * the number of threads matters:
 *
 *   1  coupling C, jumps on the lines, P with all paths in neutral
 *   2  D (with the P of its configuration: the same points at zero torque), N with R
 *   3  P with all paths engaged; X, which is what P and the D tables leave
 */
#ifndef PLAN_H
#define PLAN_H

#include "map/gm_map.h"
#include "plant/gm_plant.h"
#include "sweep/axes.h"
#include "sweep/gm_sweep.h"

#define GM_SWEEP_PHASES 3
#define GM_SWEEP_MAX_LINES 32 /* drag lines of one path */

typedef enum gm_unit_kind {
    GM_UNIT_COUPLING,
    GM_UNIT_LINE,
    GM_UNIT_PARASITIC,
    GM_UNIT_LOAD,
    GM_UNIT_DRAG,
    GM_UNIT_BOTH,
    GM_UNIT_KINDS
} gm_unit_kind;

typedef struct gm_unit {
    gm_unit_kind kind;
    int phase;
    int table;     /* index into the map's tables */
    int companion; /* table that comes out of the same points, or -1 */
} gm_unit;

/** The same gearset at several oil temperatures: those of the map's slices, then those
 *  between them. */
#define GM_SWEEP_PLANTS (2 * GM_MAP_MAX_OIL)

typedef struct gm_sweep_plan {
    const gm_plant *plant; /* the first of: */
    int n_plants;          /* as many as the map has slices, and those between */
    const gm_plant *plants[GM_SWEEP_PLANTS];
    gm_map *map;
    int monotone; /* how the tables will be read: 0 linearly, 1 by monotone cubics */
    int n_lines[GM_MAX_PATHS];
    double line[GM_MAX_PATHS][GM_SWEEP_MAX_LINES]; /* ratios of the drag lines */
    int n_units, units_size;
    gm_unit *units;
} gm_sweep_plan;

/** Add all tables to the map, whose paths, ratios and maxima are set, and list the units.
 *  The plan refers to plant and map, which must outlive it. GM_ERR_ARGUMENT when the
 *  steps give too many nodes. */
GM_NODISCARD gm_status gm_sweep_plan_create(const gm_plant *plant,
                                            const gm_sweep_options *options, gm_map *map,
                                            gm_sweep_plan **plan, gm_error *error);
void gm_sweep_plan_destroy(gm_sweep_plan *plan);

/** Quantities that one sample of a unit finds, in each slice: see experiments.h. */
int gm_unit_values(const gm_unit *unit);

/** Rows of a unit, and about how many points each one takes. */
int gm_unit_rows(const gm_sweep_plan *plan, const gm_unit *unit);
int gm_unit_row_points(const gm_sweep_plan *plan, const gm_unit *unit);

/** Give the tables of a unit other axes; their values become zero. GM_ERR_ARGUMENT,
 *  GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_unit_set_axes(gm_sweep_plan *plan, const gm_unit *unit,
                                        const gm_nodes *axes, gm_error *error);

/** Gear of a path while another one is measured alone: neutral, or its only gear. */
int gm_sweep_rest_gear(const gm_plant *plant, int p);

/** Key of D. direction: of the path. */
gm_table_key gm_sweep_load_key(int path, int gear, int direction);
/** Key of P or X: gears are numbers (gear[1] unused with one path). */
gm_table_key gm_sweep_configuration_key(gm_symbol symbol, const gm_map *map,
                                        const int *gear, int direction);

/** Key of the jump on a drag line of path p. direction: of the output. */
gm_table_key gm_sweep_line_key(int path, double line, int direction);

/** Ratio of a gear number of path p; 0 for neutral. */
double gm_sweep_ratio(const gm_map *map, int p, int number);

#endif
