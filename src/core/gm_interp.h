/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Interpolation in one, two and three dimensions over strictly increasing axes: linear,
 * in one and two dimensions also by monotone cubics with continuous gradient
 * (interp_monotone.c).
 *
 * A query remembers its cell: while the operating point stays inside, neither a search
 * nor a read of the table is needed, only the cell's multilinear coefficients. Value and
 * gradient come from the same coefficients, so they agree everywhere. At an inner node
 * the cell above is used; the last node belongs to the last cell. Outside the axes the
 * query is clamped to the edge, the gradient in that direction is zero, and the call
 * tells so. An axis of one node is a constant in that direction, without bounds.
 *
 * Only + - * / and comparisons: the same bits on every platform (-ffp-contract=off).
 * NaN queries are the caller's error and are refused before they come here.
 */
#ifndef GM_INTERP_H
#define GM_INTERP_H

#include "gm_real.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct gm_axis {
    int n;            /* number of nodes, >= 1 */
    const gm_real *x; /* [n], strictly increasing */
} gm_axis;

/* How tables keep the values of their nodes: as they are, or scale times an integer. */
#if GM_NODES_ARE_INT16
typedef int16_t gm_node;
#define GM_NODE_SCALE gm_real scale; /* of one unit of value */
#define GM_NODE(table, i) ((table)->scale * (gm_real)(table)->value[i])
#else
typedef gm_real gm_node;
#define GM_NODE_SCALE
#define GM_NODE(table, i) ((table)->value[i])
#endif

typedef struct gm_table1 {
    gm_axis x;
    const gm_node *value; /* [n_x], read with GM_NODE */
    GM_NODE_SCALE
    int monotone; /* 0: linear, 1: monotone cubic */
} gm_table1;

typedef struct gm_table2 {
    gm_axis x, y;
    const gm_node *value; /* [n_x][n_y], row-major */
    GM_NODE_SCALE
    int monotone; /* 0: bilinear, 1: monotone bicubic */
} gm_table2;

typedef struct gm_table3 {
    gm_axis x, y, z;
    const gm_node *value; /* [n_x][n_y][n_z], row-major */
    GM_NODE_SCALE
} gm_table3;

/** A table may hold several slices of values, one after the other, each with all its
 *  nodes. What is read is rest * slice[at] + share * slice[at + 1]; with share 0
 *  slice[at] as it is, so zeroed memory is the first slice, and so is what is read
 *  without. */
typedef struct gm_slices {
    int at;
    gm_real rest, share;
} gm_slices;

/* Cells hold no pointer: a saved state stays valid in another process. A cell is filled
 * for one table; .table is a small number that the caller gives each table, and a cell of
 * another table is refilled. Zero-initialised cells are empty (table 0 is "none"). A cell
 * of a monotone table has the negative number. */
typedef struct gm_cell1 {
    int table;
    gm_real x_low, x_high; /* the cell's bounds */
    gm_real c0, cx;        /* value = c0 + cx (x - x_low); not used if monotone */
} gm_cell1;

typedef struct gm_cell2 {
    int table;
    gm_real x_low, x_high, y_low, y_high;
    gm_real c0, cx, cy,
        cxy;          /* c0 + cx u + cy v + cxy u v, u = x - x_low, v = y - y_low */
    gm_real more[12]; /* monotone: factors of v2 v3, u v2, u v3, u2 1 v v2 v3, u3 ... */
} gm_cell2;

typedef struct gm_cell3 {
    int table;
    gm_real x_low, x_high, y_low, y_high, z_low, z_high;
    gm_real c[2][2][2]; /* sum of c[i][j][k] u^i v^j w^k */
} gm_cell3;

typedef struct gm_value1 {
    gm_real value, dx;
    int outside; /* 1: x was clamped */
} gm_value1;

typedef struct gm_value2 {
    gm_real value, dx, dy;
    int outside; /* 1: x or y was clamped */
} gm_value2;

typedef struct gm_value3 {
    gm_real value, dx, dy, dz;
    int outside;
} gm_value3;

/** Index i of the cell with axis.x[i] <= q < axis.x[i+1], 0 below, n - 2 above (0 for a
 *  one-node axis). Binary search. */
int gm_axis_find(const gm_axis *axis, gm_real q);

/** Value and gradient at x; *cell is refilled when x leaves it or it belongs to another
 *  table number (table >= 1). */
gm_value1 gm_table1_at(const gm_table1 *t, int table, gm_cell1 *cell, gm_real x);

/** Value and gradient at (x, y); cell as above. */
gm_value2 gm_table2_at(const gm_table2 *t, int table, gm_cell2 *cell, gm_real x,
                       gm_real y);

/** Value and gradient at (x, y, z); cell as above. */
gm_value3 gm_table3_cached(const gm_table3 *t, int table, gm_cell3 *cell, gm_real x,
                           gm_real y, gm_real z);

/** The same value and gradient without a cache. */
gm_value3 gm_table3_at(const gm_table3 *t, gm_real x, gm_real y, gm_real z);

#ifdef __cplusplus
}
#endif
#endif
