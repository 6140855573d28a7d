/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Multilinear interpolation. In a cell with lower corner (x_i, y_j) and u = x - x_i,
 * v = y - y_j the surface is c0 + cx u + cy v + cxy u v; its gradient is exact and agrees
 * with the difference quotient of the value inside the cell.
 *
 * The last node and the clamped edge are read from the far corner and not extrapolated
 * from the near one, so that every node returns its value to the last bit.
 */
#include "gm_interp.h"
#include "cell.h"

#include <stddef.h>

static const gm_slices first_slice = {0, 1, 0};

int gm_axis_find(const gm_axis *axis, gm_real q)
{
    int low = 0, high = axis->n - 1;
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        if (q >= axis->x[middle]) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

gm_place gm_place_on(const gm_axis *axis, gm_real q)
{
    gm_place p = {0, 0, 0, q, -GM_UNBOUNDED, GM_UNBOUNDED, 0};
    if (axis->n == 1) {
        p.q = p.low; /* any point: the slope is zero */
        return p;
    }
    p.i = gm_axis_find(axis, q);
    p.low = axis->x[p.i];
    p.high = axis->x[p.i + 1];
    p.slope = 1 / (p.high - p.low);
    if (q < p.low) {
        p.q = p.low;
        p.outside = 1;
    } else if (q >= p.high) {
        p.outside = q > p.high;
        p.q = p.high;
        p.far = 1;
    }
    return p;
}

gm_value1 gm_cell1_refill(const gm_table1 *t, int table, gm_cell1 *c, gm_real x)
{
    if (GM_CURVED && t->monotone) {
        return gm_monotone1(t, &first_slice, table, c, x);
    }
    const gm_place p = gm_place_on(&t->x, x);
    const gm_real near = GM_NODE(t, p.i), far = GM_NODE(t, p.i + (t->x.n > 1));
    c->table = table;
    c->x_low = p.low;
    c->x_high = p.high;
    c->c0 = near;
    c->cx = (far - near) * p.slope;
    gm_value1 v = gm_cell1_inside(c, p.q);
    if (p.far) {
        v.value = far;
    }
    if (p.outside) {
        v.dx = 0;
    }
    v.outside = p.outside;
    return v;
}

/* Value on the edge of a cell where x, y or both are at the last node; f[near/far x][y].
 */
static gm_real far_edge(const gm_cell2 *c, const gm_place *x, const gm_place *y,
                        const gm_real f[2][2])
{
    if (x->far && y->far) {
        return f[1][1];
    }
    if (x->far) {
        return f[1][0] + (f[1][1] - f[1][0]) * y->slope * (y->q - c->y_low);
    }
    return f[0][1] + (f[1][1] - f[0][1]) * x->slope * (x->q - c->x_low);
}

gm_value2 gm_cell2_refill(const gm_table2 *t, int table, gm_cell2 *c, gm_real x,
                          gm_real y)
{
    if (GM_CURVED && t->monotone) {
        return gm_monotone2(t, &first_slice, table, c, x, y);
    }
    const gm_place px = gm_place_on(&t->x, x), py = gm_place_on(&t->y, y);
    const ptrdiff_t row = t->y.n, next = t->x.n > 1 ? row : 0, step = row > 1;
    const ptrdiff_t corner = px.i * row + py.i;
    const gm_real f[2][2] = {
        {GM_NODE(t, corner), GM_NODE(t, corner + step)},
        {GM_NODE(t, corner + next), GM_NODE(t, corner + next + step)}};
    c->table = table;
    c->x_low = px.low;
    c->x_high = px.high;
    c->y_low = py.low;
    c->y_high = py.high;
    c->c0 = f[0][0];
    c->cx = (f[1][0] - f[0][0]) * px.slope;
    c->cy = (f[0][1] - f[0][0]) * py.slope;
    c->cxy = ((f[1][1] - f[1][0]) * py.slope - c->cy) * px.slope;
    gm_value2 v = gm_cell2_inside(c, px.q, py.q);
    if (px.far || py.far) {
        v.value = far_edge(c, &px, &py, f);
    }
    v.dx = px.outside ? 0 : v.dx;
    v.dy = py.outside ? 0 : v.dy;
    v.outside = px.outside || py.outside;
    return v;
}

gm_value1 gm_table1_at(const gm_table1 *t, int table, gm_cell1 *cell, gm_real x)
{
    return gm_cell1_at(t, table, cell, x);
}

gm_value2 gm_table2_at(const gm_table2 *t, int table, gm_cell2 *cell, gm_real x,
                       gm_real y)
{
    return gm_cell2_at(t, table, cell, x, y);
}

/* Between two values, exact at both ends; *slope receives the derivative. */
static gm_real between(const gm_place *p, gm_real near, gm_real far, gm_real *slope)
{
    *slope = (far - near) * p->slope;
    return p->far ? far : near + *slope * (p->q - p->low);
}

/* One layer z: the bilinear surface of x and y, d[] its derivatives. */
static gm_real layer(const gm_place *x, const gm_place *y, gm_real f[2][2][2], int z,
                     gm_real d[2])
{
    gm_real y_near, y_far, unused;
    const gm_real near = between(y, f[0][0][z], f[0][1][z], &y_near);
    const gm_real far = between(y, f[1][0][z], f[1][1][z], &y_far);
    const gm_real value = between(x, near, far, &d[0]);
    d[1] = between(x, y_near, y_far, &unused);
    return value;
}

/* Value and gradient by nested interpolation: for far corners, where the value must be
 * the node's own. */
static gm_value3 at_far_corner(const gm_place p[3], gm_real f[2][2][2])
{
    gm_real near[2], far[2], unused;
    const gm_real low = layer(&p[0], &p[1], f, 0, near);
    const gm_real high = layer(&p[0], &p[1], f, 1, far);
    gm_value3 v;
    v.value = between(&p[2], low, high, &v.dz);
    v.dx = between(&p[2], near[0], far[0], &unused);
    v.dy = between(&p[2], near[1], far[1], &unused);
    v.outside = 0;
    return v;
}

/* Corner values to coefficients: differences along one axis after the other. */
static void fill_cell3(const gm_place p[3], gm_real f[2][2][2], gm_cell3 *c)
{
    for (int i = 0; i < 8; i++) {
        c->c[i >> 2][i >> 1 & 1][i & 1] = f[i >> 2][i >> 1 & 1][i & 1];
    }
    for (int i = 0; i < 4; i++) {
        const int a = i >> 1, b = i & 1;
        c->c[1][a][b] = (c->c[1][a][b] - c->c[0][a][b]) * p[0].slope;
    }
    for (int i = 0; i < 4; i++) {
        const int a = i >> 1, b = i & 1;
        c->c[a][1][b] = (c->c[a][1][b] - c->c[a][0][b]) * p[1].slope;
    }
    for (int i = 0; i < 4; i++) {
        const int a = i >> 1, b = i & 1;
        c->c[a][b][1] = (c->c[a][b][1] - c->c[a][b][0]) * p[2].slope;
    }
}

gm_value3 gm_cell3_refill(const gm_table3 *t, int table, gm_cell3 *c, gm_real x,
                          gm_real y, gm_real z)
{
    const gm_place p[3] = {gm_place_on(&t->x, x), gm_place_on(&t->y, y),
                           gm_place_on(&t->z, z)};
    const ptrdiff_t n_y = t->y.n, n_z = t->z.n;
    const ptrdiff_t corner = (p[0].i * n_y + p[1].i) * n_z + p[2].i;
    const ptrdiff_t next_x = t->x.n > 1 ? n_y * n_z : 0, next_y = n_y > 1 ? n_z : 0;
    const ptrdiff_t next_z = n_z > 1;
    gm_real f[2][2][2];
    for (int i = 0; i < 8; i++) {
        f[i >> 2][i >> 1 & 1][i & 1] = GM_NODE(
            t, corner + (i >> 2) * next_x + (i >> 1 & 1) * next_y + (i & 1) * next_z);
    }
    c->table = table;
    c->x_low = p[0].low;
    c->x_high = p[0].high;
    c->y_low = p[1].low;
    c->y_high = p[1].high;
    c->z_low = p[2].low;
    c->z_high = p[2].high;
    fill_cell3(p, f, c);
    gm_value3 v = p[0].far || p[1].far || p[2].far
                      ? at_far_corner(p, f)
                      : gm_cell3_inside(c, p[0].q, p[1].q, p[2].q);
    v.dx = p[0].outside ? 0 : v.dx;
    v.dy = p[1].outside ? 0 : v.dy;
    v.dz = p[2].outside ? 0 : v.dz;
    v.outside = p[0].outside || p[1].outside || p[2].outside;
    return v;
}

gm_value3 gm_table3_cached(const gm_table3 *t, int table, gm_cell3 *cell, gm_real x,
                           gm_real y, gm_real z)
{
    return gm_cell3_at(t, table, cell, x, y, z);
}

gm_value3 gm_table3_at(const gm_table3 *t, gm_real x, gm_real y, gm_real z)
{
    gm_cell3 cell = {0};
    return gm_cell3_refill(t, 1, &cell, x, y, z);
}
