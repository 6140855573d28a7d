/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What a sweep has to do: the tables of the map with their axes, and one job for every
 * row of them (first axis fixed). A job's result depends on its row and on jobs of
 * earlier phases only, so neither the order within a phase nor the number of threads
 * matters:
 *
 *   1  coupling C, jumps on the lines, reference torque of the output, P of
 *      configurations with all or no path in neutral
 *   2  D (with the P of its configuration: the same points at zero torque), N with R
 *   3  X, which is what P and the D tables leave
 */
#ifndef PLAN_H
#define PLAN_H

#include "map/gm_map.h"
#include "plant/gm_plant.h"
#include "sweep/gm_sweep.h"

#define GM_SWEEP_PHASES 3
#define GM_SWEEP_MAX_LINES 32 /* drag lines of one path */

typedef enum gm_job_kind {
    GM_JOB_COUPLING,
    GM_JOB_LINE,
    GM_JOB_REFERENCE, /* of no table: kept in the plan, solved in every run */
    GM_JOB_PARASITIC,
    GM_JOB_LOAD,
    GM_JOB_DRAG,
    GM_JOB_BOTH,
    GM_JOB_KINDS
} gm_job_kind;

typedef struct gm_job {
    gm_job_kind kind;
    int phase;
    int table; /* index into the map's tables; GM_JOB_REFERENCE: direction of output */
    int companion; /* table whose same row comes out of the same points, or -1 */
    int row;
    int points; /* operating points to solve */
} gm_job;

typedef struct gm_sweep_plan {
    const gm_plant *plant;
    gm_map *map;
    gm_table1 coupling; /* view of the map's table; value NULL: none */
    int n_lines[GM_MAX_PATHS];
    double line[GM_MAX_PATHS][GM_SWEEP_MAX_LINES]; /* ratios of the drag lines */
    int n_reference;
    double *reference_speed; /* [n_reference] |w_o|, the output axis of N and R */
    double *reference[2];    /* by direction: torque of the output, all else at rest */
    int n_jobs, jobs_size;
    gm_job *jobs;
} gm_sweep_plan;

/** Add all tables to the map, whose paths, ratios and maxima are set, and list the jobs.
 *  The plan refers to plant and map, which must outlive it. GM_ERR_ARGUMENT when the
 *  steps give too many nodes. */
GM_NODISCARD gm_status gm_sweep_plan_create(const gm_plant *plant,
                                            const gm_sweep_options *options, gm_map *map,
                                            gm_sweep_plan **plan, gm_error *error);
void gm_sweep_plan_destroy(gm_sweep_plan *plan);

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
