/* SPDX-License-Identifier: BSD-2-Clause
 *
 * How the reduced gearset reads its tables: in ranges in which they are lines or
 * (multi)linear surfaces. A range is filled for one table, which its key tells, and
 * serves as long as the point stays in it; it depends on the map and the point only, so
 * what was read before cannot change a result. Beyond an edge of a table the range has no
 * end, and there is no gradient along that axis.
 *
 * Monotone tables are curved everywhere: their range is a surrounding of the point in
 * which the tangent is near enough, and is filled anew at every point. A pass that leads
 * farther is repeated from there, and converges like Newton's method.
 *
 * Between two slices of a table, its polynomials are blended (gm_slices); a change of the
 * oil temperature empties the caches.
 *
 * Speeds are magnitudes in the direction of rotation. Private to the core.
 */
#ifndef REDUCED_CELLS_H
#define REDUCED_CELLS_H

#include "cell.h"
#include "gm_reduced.h"

/* A place on an axis. */
typedef struct gm_spot {
    gm_real low, high; /* the cell; what lies beyond the edge; all of a one-node axis */
    gm_real slope;     /* 1 / width of the cell */
    int i, next;       /* the node before; 1, or 0 where nothing changes along the axis */
    int outside;       /* 1: beyond an edge */
} gm_spot;

gm_spot gm_spot_on(const gm_axis *axis, gm_real q);

/** The same for a monotone table: where its tangent at q may be used. */
gm_spot gm_spot_near(const gm_axis *axis, gm_real q);

/** Fill a range of a table around (x, y). gm_fill_patch: surface a alone; curved: cell
 *  for a monotone table. */
void gm_fill_strip(const gm_table1 *t, const gm_slices *of, int key, gm_real x,
                   gm_strip *s);
void gm_fill_patch(const gm_table2 *t, const gm_slices *of, int key, gm_cell2 *curved,
                   gm_real x, gm_real y, gm_patch *c);
void gm_fill_block(const gm_table3 *t, const gm_slices *of, int key, const gm_real q[3],
                   gm_block *b);

/** Surface of a table from low ends within the cells of its spots; of a monotone one the
 *  tangent at (x, y), from the low ends of the spots; key and cell as in gm_interp.h. */
gm_surface gm_surface_at(const gm_table2 *t, const gm_slices *of, const gm_spot *x,
                         const gm_spot *y);
gm_surface gm_tangent_at(const gm_table2 *t, const gm_slices *of, int key, gm_cell2 *cell,
                         gm_real x, gm_real y, const gm_spot *p, const gm_spot *q);

/** Cell of a path for monotone tables; NULL where there are none. */
static inline gm_cell2 *gm_curved_cell(gm_reduced_cache *cache, int p, int i)
{
#if GM_CURVED
    return &cache->curved[p][i];
#else
    (void)cache;
    (void)p;
    (void)i;
    return 0;
#endif
}

/** The line of a table from the low end of the spot of x; low and high are the spot's. */
gm_strip gm_line_at(const gm_table1 *t, const gm_slices *of, gm_real x, const gm_spot *p);

/** Values at standstill, x = 0. */
gm_real gm_value1_at_rest(const gm_table1 *t, const gm_slices *of);
gm_real gm_value_at_rest(const gm_table2 *t, const gm_slices *of, gm_real y);
gm_real gm_value3_at_rest(const gm_table3 *t, const gm_slices *of, gm_real y, gm_real z);

/** Put the caches on another oil temperature: they are empty but for it. */
void gm_move_oil(const gm_oil_axis *axis, gm_real temperature, gm_reduced_cache *cache);

/** How fast a blend changes with the temperature: its own slices, [1/K]. Zero outside. */
gm_slices gm_oil_slope(const gm_oil_axis *axis, const gm_oil_place *at);

/** Whether the map has an oil axis. */
static inline int gm_has_oil_axis(const gm_reduced_map *map)
{
    return GM_OIL_AXIS && map->oil.n > 1;
}

static inline int gm_in_strip(const gm_strip *s, gm_real x)
{
    return x >= s->low && x < s->high;
}

static inline const gm_strip *gm_strip_at(const gm_table1 *t, const gm_slices *of,
                                          int key, gm_strip *s, gm_real x)
{
    if (s->key != key || !gm_in_strip(s, x) || (GM_CURVED && t->monotone)) {
        gm_fill_strip(t, of, key, x, s);
    }
    return s;
}

static inline gm_real gm_on_strip(const gm_strip *s, gm_real x)
{
    return s->c + s->cx * (x - s->low);
}

static inline int gm_in_patch(const gm_patch *c, gm_real x, gm_real y)
{
    return x >= c->x_low && x < c->x_high && y >= c->y_low && y < c->y_high;
}

static inline int gm_in_block(const gm_block *b, const gm_real q[3])
{
    return q[0] >= b->low[0] && q[0] < b->high[0] && q[1] >= b->low[1] &&
           q[1] < b->high[1] && q[2] >= b->low[2] && q[2] < b->high[2];
}

#endif
