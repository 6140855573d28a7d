/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Axes chosen by error: for quantities over one to three axes the nodes are found with
 * which their interpolation is within a tolerance, from as few samples as may be.
 *
 *   lines   Each axis is sampled along a few lines (the other axes at their cuts) by
 *           halving intervals until what interpolation between samples leaves is a small
 *           part of the tolerance: densely where the curves bend, near zero and at kinks.
 *   choose  From the samples the fewest nodes are taken, see choose.h. Each of the d axes
 *           may use 1/d of the tolerance: errors along axes add.
 *   fill    The grid of these nodes is sampled.
 *   check   Random points that no node was chosen from are held out. Where the
 *           interpolation misses the tolerance, the interval is halved along the axis on
 *           which the quantity bends more, and fresh points are drawn, until a round of
 *           them is clean.
 *
 * A caller asks for the points wanted, samples them in any order and on any number of
 * threads, tells the values and advances. What is wanted follows from values told before
 * and from nothing else, so the result is the same however it was computed, and a
 * repeated refinement wants the same points again.
 */
#ifndef REFINE_H
#define REFINE_H

#include "map/gm_map.h"
#include "sweep/axes.h"

#include <stdint.h>

#define GM_REFINE_VALUES (2 * GM_MAP_MAX_OIL) /* most quantities over the same axes */
#define GM_REFINE_CUTS 16

typedef struct gm_refine_axis {
    gm_nodes
        start; /* the first samples; the ends of the axis are the first and the last */
    int n_fixed;
    double fixed[GM_REFINE_CUTS]; /* of them: nodes whatever the error, as are the ends */
    int n_cuts;
    double cut
        [GM_REFINE_CUTS]; /* of the fixed ones and the ends: where others are sampled */
    int n_max;            /* most nodes */
    gm_nodes
        otherwise;   /* nodes to take where n_max are not enough; n 0: the best found */
    double shortest; /* interval that is not halved any more */
    double blind;    /* intervals up to this length are not held out; or 0 */
} gm_refine_axis;

typedef struct gm_refine_spec {
    int n_axes;
    gm_refine_axis axis[GM_MAX_AXES];
    int n_values;
    int is_sum;   /* 1: values 0, 2, ... are read as the one after them, of two axes, and
                   the rest, which depends on axis 0 alone and has a table of its own */
    double share; /* tolerance, of the largest size; or 0 */
    double absolute[GM_REFINE_VALUES]; /* tolerance; or 0. The larger of both counts */
    double noise[GM_REFINE_VALUES];    /* no tolerance is below this, > 0 */
    int monotone;                      /* interpolation: 0 linear, 1 monotone cubics */
    uint64_t seed;                     /* of the points held out */
} gm_refine_spec;

/** What is found at a point: the quantities to be interpolated, and what their errors are
 *  compared with (>= 0). */
typedef struct gm_sample {
    double value[GM_REFINE_VALUES], size[GM_REFINE_VALUES];
} gm_sample;

typedef struct gm_refine gm_refine;

/** The specification is copied. GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_refine_create(const gm_refine_spec *spec, gm_refine **refine,
                                        gm_error *error);
void gm_refine_destroy(gm_refine *refine);

/** How many points are wanted now, and the coordinates [GM_MAX_AXES] of one; 0: it is
 *  done. */
int gm_refine_wanted(const gm_refine *refine);
const double *gm_refine_point(const gm_refine *refine, int i);

/** The sample at wanted point i. Different points may be told by different threads. */
void gm_refine_tell(gm_refine *refine, int i, const gm_sample *sample);

/** Every wanted point was told: find out which are wanted next. GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_refine_advance(gm_refine *refine, gm_error *error);

/** When it is done: the nodes of an axis. */
const gm_nodes *gm_refine_nodes(const gm_refine *refine, int axis);

/** How it stands with the last points that were held out. */
typedef struct gm_refine_state {
    int reached;                        /* 1: all are inside */
    double error;                       /* the largest one, in tolerances */
    double relative;                    /* the same, of the largest size */
    double worst[GM_MAX_AXES];          /* where that is */
    double tolerance[GM_REFINE_VALUES]; /* in the unit of the value */
} gm_refine_state;
gm_refine_state gm_refine_state_of(const gm_refine *refine);

#endif
