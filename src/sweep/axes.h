/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Nodes of the axes.
 *
 * A loss that grows like x^q has the same interpolation error in every cell when the
 * density of nodes goes with |f''|^(1/2), that is for x = max (i/n)^k with k = 2/q: the
 * power axes. Friction over the speed is harder: constant near zero, then kinks where the
 * sliding speed of a mesh leaves its lower limit, then v^-0.2, which has the same
 * relative curvature at every speed and wants steps in equal ratios: the growth axes,
 * even near zero and geometric beyond.
 */
#ifndef AXES_H
#define AXES_H

#include "base/gm_status.h"

#define GM_NODES_MAX 1024

typedef struct gm_nodes {
    int n;
    double x[GM_NODES_MAX]; /* strictly increasing */
} gm_nodes;

/** n >= 2 nodes from 0 to max > 0, x_i = max (i/(n-1))^k. */
void gm_nodes_power(int n, double max, double k, gm_nodes *nodes);

/** n >= 2 nodes from 0 to max > 0, x_i = a ((1 + max/a)^(i/(n-1)) - 1): even below
 *  a = share * max, in equal ratios far above it. share > 0. */
void gm_nodes_growth(int n, double max, double share, gm_nodes *nodes);

/** 0, step, 2 step … and max. GM_ERR_ARGUMENT when these are more than fit, also after
 *  mirroring; what: the axis, for the sentence. */
GM_NODISCARD gm_status gm_nodes_uniform(double max, double step, const char *what,
                                        gm_nodes *nodes, gm_error *error);

/** Make x (inside the axis) a node: while there are fewer than n_max it is added, else
 *  its nearest inner neighbour moves there. Nothing happens outside, or when a node is
 *  within 1e-9 of it. */
void gm_nodes_include(double x, int n_max, gm_nodes *nodes);

/** Add x as a node while there are fewer than n_max; nothing happens outside or on a
 *  node. */
void gm_nodes_add(double x, int n_max, gm_nodes *nodes);

/** Continue to the end with n more nodes in equal ratios. end > last node > 0. */
void gm_nodes_extend(double end, int n, gm_nodes *nodes);

/** Multiply by factor > 0. */
void gm_nodes_scale(double factor, gm_nodes *nodes);

/** Nodes 0 … max become -max … 0 … max, below zero those of `below` (0 … max as well, may
 *  be the same nodes). Together no more than GM_NODES_MAX + 1. */
void gm_nodes_mirror(const gm_nodes *below, gm_nodes *nodes);

#endif
