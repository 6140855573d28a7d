/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The fast path of a cached-cell query: while the point stays inside the cell, neither a
 * search nor a read of the table. Everything else (another cell, another table, the last
 * node, outside) is the slow path in gm_interp.c. Both use the same formula, so the cache
 * cannot change a bit of a result.
 */
#ifndef CELL_H
#define CELL_H

#include "gm_interp.h"

/* A one-node axis has a cell without bounds. Beyond this width only the slow path, which
 * knows the number of nodes, answers. */
#define GM_UNBOUNDED GM_NUM(1e30)

/* Where a query lies on one axis. */
typedef struct gm_place {
    int i;       /* cell */
    int far;     /* 1: at the last node or clamped to it */
    int outside; /* 1: clamped */
    gm_real q;   /* the query, clamped */
    gm_real low, high;
    gm_real slope; /* 1 / width; 0 on a one-node axis */
} gm_place;

gm_place gm_place_on(const gm_axis *axis, gm_real q);

/* Monotone tables, also when the cell is the last one's: interp_monotone.c. */
gm_value1 gm_monotone1(const gm_table1 *t, const gm_slices *of, int table, gm_cell1 *cell,
                       gm_real x);
gm_value2 gm_monotone2(const gm_table2 *t, const gm_slices *of, int table, gm_cell2 *cell,
                       gm_real x, gm_real y);

/* Of two slices what *of says; the first alone is left as it is. */
static inline int gm_is_blend(const gm_slices *of)
{
    return GM_OIL_AXIS && of->share != 0;
}

static inline gm_real gm_blend(const gm_slices *of, gm_real near, gm_real far)
{
    return of->rest * near + of->share * far;
}

gm_value1 gm_cell1_refill(const gm_table1 *t, int table, gm_cell1 *cell, gm_real x);
gm_value2 gm_cell2_refill(const gm_table2 *t, int table, gm_cell2 *cell, gm_real x,
                          gm_real y);

gm_value3 gm_cell3_refill(const gm_table3 *t, int table, gm_cell3 *cell, gm_real x,
                          gm_real y, gm_real z);

static inline gm_value1 gm_cell1_inside(const gm_cell1 *c, gm_real x)
{
    gm_value1 v;
    v.value = c->c0 + c->cx * (x - c->x_low);
    v.dx = c->cx;
    v.outside = 0;
    return v;
}

static inline gm_value2 gm_cell2_inside(const gm_cell2 *c, gm_real x, gm_real y)
{
    const gm_real u = x - c->x_low, w = y - c->y_low;
    gm_value2 v;
    v.dx = c->cx + c->cxy * w;
    v.dy = c->cy + c->cxy * u;
    v.value = c->c0 + c->cy * w + v.dx * u;
    v.outside = 0;
    return v;
}

static inline gm_value1 gm_cell1_at(const gm_table1 *t, int table, gm_cell1 *c, gm_real x)
{
    if (c->table == table && x >= c->x_low && x < c->x_high) {
        return gm_cell1_inside(c, x);
    }
    return gm_cell1_refill(t, table, c, x);
}

static inline gm_value2 gm_cell2_at(const gm_table2 *t, int table, gm_cell2 *c, gm_real x,
                                    gm_real y)
{
    if (c->table == table && x >= c->x_low && x < c->x_high && y >= c->y_low &&
        y < c->y_high) {
        return gm_cell2_inside(c, x, y);
    }
    return gm_cell2_refill(t, table, c, x, y);
}

static inline gm_value3 gm_cell3_inside(const gm_cell3 *c, gm_real x, gm_real y,
                                        gm_real z)
{
    const gm_real u = x - c->x_low, v = y - c->y_low, w = z - c->z_low;
    const gm_real near = c->c[0][0][0] + c->c[0][0][1] * w;
    const gm_real near_v = c->c[0][1][0] + c->c[0][1][1] * w;
    const gm_real far = c->c[1][0][0] + c->c[1][0][1] * w;
    const gm_real far_v = c->c[1][1][0] + c->c[1][1][1] * w;
    gm_value3 value;
    value.dx = far + far_v * v;
    value.dy = near_v + far_v * u;
    value.dz =
        c->c[0][0][1] + c->c[0][1][1] * v + (c->c[1][0][1] + c->c[1][1][1] * v) * u;
    value.value = near + near_v * v + value.dx * u;
    value.outside = 0;
    return value;
}

static inline gm_value3 gm_cell3_at(const gm_table3 *t, int table, gm_cell3 *c, gm_real x,
                                    gm_real y, gm_real z)
{
    if (c->table == table && x >= c->x_low && x < c->x_high && y >= c->y_low &&
        y < c->y_high && z >= c->z_low && z < c->z_high) {
        return gm_cell3_inside(c, x, y, z);
    }
    return gm_cell3_refill(t, table, c, x, y, z);
}

#endif
