/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Filling the ranges of reduced_cells.h from the tables: differences of corner values
 * along one axis after the other.
 */
#include "reduced_cells.h"

/* Of the width of a cell: beside its tangent a cubic is then off by some 1e-8 of its
 * rise over the cell. */
#define NEAR GM_NUM(1e-4)

gm_spot gm_spot_on(const gm_axis *axis, gm_real q)
{
    const gm_real *x = axis->x;
    const int last = axis->n - 1;
    gm_spot s = {-GM_UNBOUNDED, GM_UNBOUNDED, 0, 0, 0, 0};
    if (last == 0) {
        return s;
    }
    if (q < x[0]) {
        s.high = x[0];
        s.outside = 1;
        return s;
    }
    if (q >= x[last]) {
        s.low = x[last];
        s.i = last;
        s.outside = q > x[last];
        return s;
    }
    s.i = gm_axis_find(axis, q);
    s.next = 1;
    s.low = x[s.i];
    s.high = x[s.i + 1];
    s.slope = 1 / (s.high - s.low);
    return s;
}

gm_spot gm_spot_near(const gm_axis *axis, gm_real q)
{
    gm_spot s = gm_spot_on(axis, q);
    if (s.next) {
        const gm_real close = NEAR * (s.high - s.low);
        s.low = q - close;
        s.high = q + close;
    }
    return s;
}

/* ---- the oil ---- */

/* Share of the next slice at u of the way to it. */
static gm_real share_at(gm_real bend, gm_real u)
{
    return u * (1 + bend) / (1 + bend * u);
}

static gm_oil_place place_oil(const gm_oil_axis *axis, gm_real temperature)
{
    const gm_axis nodes = {axis->n, axis->temperature};
    const gm_spot s = gm_spot_on(&nodes, temperature);
    gm_oil_place p = {temperature, !s.outside, {s.i, 1, 0}};
    if (s.next) {
        p.slices.share = share_at(axis->bend[s.i], (temperature - s.low) * s.slope);
        p.slices.rest = 1 - p.slices.share;
    }
    return p;
}

void gm_move_oil(const gm_oil_axis *axis, gm_real temperature, gm_reduced_cache *cache)
{
    cache->oil = place_oil(axis, temperature);
    cache->parasitic.key = cache->coupling.key = cache->both_loaded.key = 0;
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        cache->pin[p].key = cache->path[p].key = 0;
#if GM_CURVED
        cache->curved[p][0].table = cache->curved[p][1].table = 0;
#endif
    }
}

gm_slices gm_oil_slope(const gm_oil_axis *axis, const gm_oil_place *at)
{
    const gm_axis nodes = {axis->n, axis->temperature};
    const gm_spot s = gm_spot_on(&nodes, at->temperature);
    gm_slices slope = {s.i, 0, 0};
    if (s.next) {
        const gm_real bend = axis->bend[s.i];
        const gm_real below = 1 + bend * ((at->temperature - s.low) * s.slope);
        slope.share = (1 + bend) / (below * below) * s.slope;
        slope.rest = -slope.share;
    }
    return slope;
}

/* ---- one variable ---- */

/* Of the slice that begins at node `from`. */
static gm_strip line_of(const gm_table1 *t, int from, const gm_spot *p)
{
    const int i = from + p->i;
    gm_strip s = {0, (short)p->outside, p->low, p->high, GM_NODE(t, i), 0};
    s.cx = (GM_NODE(t, i + p->next) - s.c) * p->slope;
    return s;
}

gm_strip gm_line_at(const gm_table1 *t, const gm_slices *of, gm_real x, const gm_spot *p)
{
    const int from = GM_OIL_AXIS ? of->at * t->x.n : 0;
    gm_strip s = line_of(t, from, p);
    if (gm_is_blend(of)) {
        const gm_strip next = line_of(t, from + t->x.n, p);
        s.c = gm_blend(of, s.c, next.c);
        s.cx = gm_blend(of, s.cx, next.cx);
    }
    if (GM_CURVED && t->monotone && p->next) {
        gm_cell1 cell = {0, 0, 0, 0, 0};
        const gm_value1 v = gm_monotone1(t, of, 1, &cell, x);
        s.c = v.value + v.dx * (p->low - x);
        s.cx = v.dx;
    }
    return s;
}

void gm_fill_strip(const gm_table1 *t, const gm_slices *of, int key, gm_real x,
                   gm_strip *s)
{
    const gm_spot p =
        GM_CURVED && t->monotone ? gm_spot_near(&t->x, x) : gm_spot_on(&t->x, x);
    *s = gm_line_at(t, of, x, &p);
    s->key = (short)key;
}

/* ---- two ---- */

static gm_surface surface_of(const gm_table2 *t, int from, const gm_spot *x,
                             const gm_spot *y)
{
    const int near = from + x->i * t->y.n + y->i, far = near + x->next * t->y.n;
    const gm_real f = GM_NODE(t, near), g = GM_NODE(t, far);
    gm_surface s;
    s.c = f;
    s.cx = (g - f) * x->slope;
    s.cy = (GM_NODE(t, near + y->next) - f) * y->slope;
    s.cxy = ((GM_NODE(t, far + y->next) - g) * y->slope - s.cy) * x->slope;
    s.cyy = 0;
    return s;
}

gm_surface gm_surface_at(const gm_table2 *t, const gm_slices *of, const gm_spot *x,
                         const gm_spot *y)
{
    const int size = t->x.n * t->y.n, from = GM_OIL_AXIS ? of->at * size : 0;
    gm_surface s = surface_of(t, from, x, y);
    if (gm_is_blend(of)) {
        const gm_surface next = surface_of(t, from + size, x, y);
        s.c = gm_blend(of, s.c, next.c);
        s.cx = gm_blend(of, s.cx, next.cx);
        s.cy = gm_blend(of, s.cy, next.cy);
        s.cxy = gm_blend(of, s.cxy, next.cxy);
    }
    return s;
}

gm_surface gm_tangent_at(const gm_table2 *t, const gm_slices *of, int key, gm_cell2 *cell,
                         gm_real x, gm_real y, const gm_spot *p, const gm_spot *q)
{
    const gm_value2 v = gm_monotone2(t, of, key, cell, x, y);
    const gm_real dx = p->next ? v.dx : 0, dy = q->next ? v.dy : 0;
    const gm_surface s = {v.value + dx * (p->low - x) + dy * (q->low - y), dx, dy, 0, 0};
    return s;
}

void gm_fill_patch(const gm_table2 *t, const gm_slices *of, int key, gm_cell2 *curved,
                   gm_real x, gm_real y, gm_patch *c)
{
    const gm_spot p =
        GM_CURVED && t->monotone ? gm_spot_near(&t->x, x) : gm_spot_on(&t->x, x);
    const gm_spot q =
        GM_CURVED && t->monotone ? gm_spot_near(&t->y, y) : gm_spot_on(&t->y, y);
    c->key = (short)key;
    c->outside = (short)(p.outside | q.outside);
    c->x_low = p.low;
    c->x_high = p.high;
    c->y_low = q.low;
    c->y_high = q.high;
    c->a = GM_CURVED && t->monotone ? gm_tangent_at(t, of, key, curved, x, y, &p, &q)
                                    : gm_surface_at(t, of, &p, &q);
}

/* ---- three ---- */

static void block_of(const gm_table3 *t, int from, const gm_spot p[3], gm_real c[2][2][2])
{
    const int n_y = t->y.n, n_z = t->z.n;
    const int corner = from + (p[0].i * n_y + p[1].i) * n_z + p[2].i;
    const int x = p[0].next * n_y * n_z, y = p[1].next * n_z, z = p[2].next;
    for (int i = 0; i < 2; i++) { /* along z, then y, then x */
        const int near = corner + i * x, far = near + y;
        const gm_real f = GM_NODE(t, near), g = GM_NODE(t, far);
        const gm_real d_0 = (GM_NODE(t, near + z) - f) * p[2].slope;
        const gm_real d_1 = (GM_NODE(t, far + z) - g) * p[2].slope;
        c[i][0][0] = f;
        c[i][0][1] = d_0;
        c[i][1][0] = (g - f) * p[1].slope;
        c[i][1][1] = (d_1 - d_0) * p[1].slope;
    }
    for (int i = 0; i < 4; i++) {
        const int j = i >> 1, k = i & 1;
        c[1][j][k] = (c[1][j][k] - c[0][j][k]) * p[0].slope;
    }
}

void gm_fill_block(const gm_table3 *t, const gm_slices *of, int key, const gm_real q[3],
                   gm_block *b)
{
    const gm_spot p[3] = {gm_spot_on(&t->x, q[0]), gm_spot_on(&t->y, q[1]),
                          gm_spot_on(&t->z, q[2])};
    const int size = t->x.n * t->y.n * t->z.n, from = GM_OIL_AXIS ? of->at * size : 0;
    b->key = (short)key;
    b->outside = (short)(p[0].outside | p[1].outside | p[2].outside);
    for (int i = 0; i < 3; i++) {
        b->low[i] = p[i].low;
        b->high[i] = p[i].high;
    }
    block_of(t, from, p, b->c);
    if (gm_is_blend(of)) {
        gm_real next[2][2][2];
        block_of(t, from + size, p, next);
        for (int i = 0; i < 8; i++) {
            gm_real *c = &b->c[i >> 2][i >> 1 & 1][i & 1];
            *c = gm_blend(of, *c, next[i >> 2][i >> 1 & 1][i & 1]);
        }
    }
}

/* ---- at rest ---- */

gm_real gm_value1_at_rest(const gm_table1 *t, const gm_slices *of)
{
    const int from = GM_OIL_AXIS ? of->at * t->x.n : 0;
    const gm_real value = GM_NODE(t, from);
    return gm_is_blend(of) ? gm_blend(of, value, GM_NODE(t, from + t->x.n)) : value;
}

static gm_real value_of(const gm_table2 *t, int from, const gm_spot *q, gm_real y)
{
    const gm_real f = GM_NODE(t, from + q->i);
    return f + (GM_NODE(t, from + q->i + q->next) - f) * q->slope * (y - q->low);
}

gm_real gm_value_at_rest(const gm_table2 *t, const gm_slices *of, gm_real y)
{
    if (GM_CURVED && t->monotone) {
        gm_cell2 cell = {0};
        return gm_monotone2(t, of, 1, &cell, 0, y).value;
    }
    const gm_spot q = gm_spot_on(&t->y, y);
    const int size = t->x.n * t->y.n, from = GM_OIL_AXIS ? of->at * size : 0;
    const gm_real value = value_of(t, from, &q, y);
    return gm_is_blend(of) ? gm_blend(of, value, value_of(t, from + size, &q, y)) : value;
}

static gm_real value3_of(const gm_table3 *t, int from, const gm_spot *p, const gm_spot *q,
                         gm_real v, gm_real w)
{
    const int i = from + p->i * t->z.n + q->i, j = i + p->next * t->z.n;
    const gm_real f = GM_NODE(t, i), g = GM_NODE(t, j);
    const gm_real near = f + (GM_NODE(t, i + q->next) - f) * w;
    return near + (g + (GM_NODE(t, j + q->next) - g) * w - near) * v;
}

gm_real gm_value3_at_rest(const gm_table3 *t, const gm_slices *of, gm_real y, gm_real z)
{
    const gm_spot p = gm_spot_on(&t->y, y), q = gm_spot_on(&t->z, z);
    const gm_real v = (y - p.low) * p.slope, w = (z - q.low) * q.slope;
    const int size = t->x.n * t->y.n * t->z.n, from = GM_OIL_AXIS ? of->at * size : 0;
    const gm_real value = value3_of(t, from, &p, &q, v, w);
    return gm_is_blend(of) ? gm_blend(of, value, value3_of(t, from + size, &p, &q, v, w))
                           : value;
}
