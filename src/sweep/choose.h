/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The fewest nodes: out of samples of several curves over one axis, those from which
 * interpolation gives all other samples to within a tolerance.
 *
 * For linear interpolation an interval's error depends on its two ends alone, so the
 * shortest chain of intervals that are good enough is found exactly (dynamic programming,
 * R. Bellman, Comm. ACM 4 (1961) 284); of chains of equal length the one with the
 * smallest errors. For monotone cubics such a chain for a looser tolerance is the start,
 * and samples with the largest error are added until all are inside.
 */
#ifndef CHOOSE_H
#define CHOOSE_H

#include "base/gm_status.h"

typedef struct gm_curves {
    int n;           /* samples, >= 2 */
    const double *x; /* [n], strictly increasing */
    int n_curves;
    const double *value; /* [n_curves][n], in units of the tolerance */
    const char *fixed;   /* [n] 1: must be a node; the ends always are */
    int alone;    /* 1: the table has this axis only; in others cubics are less steep */
    int monotone; /* 0: linear interpolation, 1: monotone cubics */
} gm_curves;

/** chosen[n] receives 1 for every node, *n_chosen how many there are, at most n_max >= 2
 *  and all fixed ones; *error the largest error, in tolerances: more than 1 where n_max
 *  nodes are not enough. GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_choose_nodes(const gm_curves *curves, int n_max, char *chosen,
                                       int *n_chosen, double *largest, gm_error *error);

#endif
