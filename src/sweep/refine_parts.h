/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Inside of a refinement (refine.h): its lines (refine_lines.c), and its grid with the
 * points held out (refine_grid.c).
 */
#ifndef REFINE_PARTS_H
#define REFINE_PARTS_H

#include "sweep/memo.h"
#include "sweep/refine.h"

#define GM_REFINE_SAMPLES 512 /* of an axis */

/** Samples of an axis, taken on all lines. */
typedef struct gm_refine_samples {
    int n;
    double x[GM_REFINE_SAMPLES];
    char open[GM_REFINE_SAMPLES]; /* [i]: the interval from i on is to be halved */
    int halving;                  /* 1: the middles of the open intervals are wanted */
} gm_refine_samples;

typedef enum gm_refine_stage {
    GM_REFINE_LINES,
    GM_REFINE_FILL,
    GM_REFINE_CHECK,
    GM_REFINE_DONE
} gm_refine_stage;

struct gm_refine {
    gm_refine_spec spec;
    gm_refine_stage stage;
    gm_memo *memo;    /* coordinates -> values [n_values], sizes [n_values] */
    long known;       /* entries of the memo that were told; those after are wanted */
    long first_check; /* the first entry of the points held out now */
    uint64_t random;
    int rounds;
    double largest[GM_REFINE_VALUES]; /* size so far */
    gm_refine_samples samples[GM_MAX_AXES];
    gm_nodes nodes[GM_MAX_AXES];
    double *grid[GM_REFINE_VALUES]; /* values at the nodes */
    double *rest; /* of sums: [n_values / 2][GM_NODES_MAX] over axis 0 */
    gm_refine_state state;
};

/** Want the sample at x unless it is known or wanted already. */
GM_NODISCARD gm_status gm_refine_want(gm_refine *refine, const double *x,
                                      gm_error *error);

/** Values of a known sample. */
const double *gm_refine_sample(const gm_refine *refine, const double *x);

/** Number of lines along an axis, and the coordinates of line `number` (that of the axis
 *  is left alone). */
int gm_refine_line_count(const gm_refine *refine, int axis);
void gm_refine_line(const gm_refine *refine, int axis, int number, double *x);

/** Begin sampling; look at what was told and want more until nothing is; and choose the
 *  nodes of every axis. */
GM_NODISCARD gm_status gm_refine_lines_begin(gm_refine *refine, gm_error *error);
GM_NODISCARD gm_status gm_refine_lines_advance(gm_refine *refine, gm_error *error);
GM_NODISCARD gm_status gm_refine_lines_choose(gm_refine *refine, gm_error *error);

/** Want the grid; want points off it; compare them and halve intervals: *clean is 1 when
 *  all were inside or nothing more can be done. */
GM_NODISCARD gm_status gm_refine_grid_fill(gm_refine *refine, gm_error *error);
GM_NODISCARD gm_status gm_refine_grid_hold_out(gm_refine *refine, gm_error *error);
GM_NODISCARD gm_status gm_refine_grid_compare(gm_refine *refine, int *clean,
                                              gm_error *error);

#endif
