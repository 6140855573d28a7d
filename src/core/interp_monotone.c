/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Monotone cubic interpolation with continuous gradient in one and two dimensions: value
 * and gradient come from one polynomial a cell.
 *
 * Nodes have slopes from the parabola through them and their neighbours, limited to
 * three times the smaller of the two adjacent secants and to zero at an extremum
 * (F. N. Fritsch, R. E. Carlson, SIAM J. Numer. Anal. 17 (1980) 238; J. M. Hyman, SIAM J.
 * Sci. Stat. Comput. 4 (1983) 645). In one dimension the curve is monotone wherever the
 * nodes are.
 *
 * In two dimensions the cell is the bicubic Hermite surface of values, slopes along both
 * axes and twists at its corners. With 1.5 instead of 3 the Bezier points beside a corner
 * stay within the values of the cell's corners when its twist is zero (the point diagonal
 * of it goes at most half way to either neighbour); twists are limited so that this
 * remains, and that slopes across a grid line keep their sign along it (R. E. Carlson,
 * F. N. Fritsch, SIAM J. Numer. Anal. 22 (1985) 386, necessary conditions). So on every
 * grid line the surface is monotone where the nodes are, across it too, and in a cell the
 * value stays between those of its corners: no overshoot.
 *
 * Slopes are not stored: a cell needs the 16 nodes around it when it is filled. Outside
 * of the table the value is that of the edge. Only + - * /.
 */
#include "cell.h"

#include <stddef.h>

/* Of a slope, in adjacent secants: in one dimension, in two. */
#define LIMIT_1 3
#define LIMIT_2 GM_NUM(1.5)

static gm_real magnitude(gm_real x)
{
    return x < 0 ? -x : x;
}

static gm_real smaller(gm_real a, gm_real b)
{
    return a < b ? a : b;
}

/* m towards zero until |m| <= limit; 0 when its sign is not that of `sign`. */
static gm_real limited(gm_real m, gm_real sign, gm_real limit)
{
    if ((m > 0) != (sign > 0) || (m < 0) != (sign < 0)) {
        return 0;
    }
    return m > limit ? limit : m < -limit ? -limit : m;
}

/* A node with its neighbours along a line of a table: up to three nodes of which it is
 * number i, at an end the last three. */
typedef struct line {
    int n, i, first; /* first: number in the whole line of what is number 0 here */
    gm_real x[3], f[3];
} line;

/* The node i of an axis and its neighbours, still without values. */
static line line_on(const gm_axis *axis, int i)
{
    const int n = axis->n < 3 ? axis->n : 3, most = axis->n - n;
    const int first = i - 1 < 0 ? 0 : i - 1 > most ? most : i - 1;
    line l = {n, i - first, first, {0, 0, 0}, {0, 0, 0}};
    for (int k = 0; k < n; k++) {
        l.x[k] = axis->x[first + k];
    }
    return l;
}

static gm_real secant(const line *l, int i)
{
    return (l->f[i + 1] - l->f[i]) / (l->x[i + 1] - l->x[i]);
}

/* Derivative at the node of the parabola through it and its neighbours, at an end
 * through the three last nodes. */
static gm_real parabola(const line *l)
{
    const gm_real *x = l->x;
    if (l->n < 3) {
        return l->n < 2 ? 0 : secant(l, 0);
    }
    const gm_real h_0 = x[1] - x[0], h_1 = x[2] - x[1];
    const gm_real a = secant(l, 0), b = secant(l, 1), bend = (b - a) / (h_0 + h_1);
    return a + bend * (l->i < 1 ? -h_0 : l->i > 1 ? h_0 + 2 * h_1 : h_0);
}

static gm_real slope(const line *l, gm_real factor)
{
    const gm_real m = parabola(l);
    if (l->n < 3) {
        return m;
    }
    const gm_real a = secant(l, l->i > 1), b = secant(l, l->i > 0);
    const gm_real limit = factor * smaller(magnitude(a), magnitude(b));
    return (a > 0) == (b > 0) && (a < 0) == (b < 0) ? limited(m, a, limit) : 0;
}

static gm_real slope_1(const gm_table1 *t, ptrdiff_t from, int i)
{
    line l = line_on(&t->x, i);
    for (int k = 0; k < l.n; k++) {
        l.f[k] = GM_NODE(t, from + l.first + k);
    }
    return slope(&l, LIMIT_1);
}

/* The lines of a table in two dimensions through node (i, j) of the slice that begins at
 * node `from`. */
static line along_x(const gm_table2 *t, ptrdiff_t from, int i, int j)
{
    line l = line_on(&t->x, i);
    for (int k = 0; k < l.n; k++) {
        l.f[k] = GM_NODE(t, from + (ptrdiff_t)(l.first + k) * t->y.n + j);
    }
    return l;
}

static line along_y(const gm_table2 *t, ptrdiff_t from, int i, int j)
{
    line l = line_on(&t->y, j);
    for (int k = 0; k < l.n; k++) {
        l.f[k] = GM_NODE(t, from + (ptrdiff_t)i * t->y.n + l.first + k);
    }
    return l;
}

/* ---- one dimension ---- */

/* value = c[0] + c[1] u + c[2] u2 + c[3] u3 from values and slopes at both ends;
 * inverse: 1 / width, 0 for a constant. */
static void cubic(gm_real f_0, gm_real f_1, gm_real m_0, gm_real m_1, gm_real inverse,
                  gm_real c[4])
{
    const gm_real rise = (f_1 - f_0) * inverse;
    c[0] = f_0;
    c[1] = m_0;
    c[2] = (3 * rise - 2 * m_0 - m_1) * inverse;
    c[3] = (m_0 + m_1 - 2 * rise) * inverse * inverse;
}

static gm_real at(const gm_real c[4], gm_real u)
{
    return c[0] + u * (c[1] + u * (c[2] + u * c[3]));
}

static gm_real slope_at(const gm_real c[4], gm_real u)
{
    return c[1] + u * (2 * c[2] + u * 3 * c[3]);
}

/* Values and slopes at the ends of cell i: f_0, f_1, m_0, m_1. */
static void ends_1(const gm_table1 *t, ptrdiff_t from, int i, gm_real e[4])
{
    const int next = t->x.n > 1;
    e[0] = GM_NODE(t, from + i);
    e[1] = GM_NODE(t, from + i + next);
    e[2] = slope_1(t, from, i);
    e[3] = slope_1(t, from, i + next);
}

gm_value1 gm_monotone1(const gm_table1 *t, const gm_slices *of, int table, gm_cell1 *cell,
                       gm_real x)
{
    const gm_place p = gm_place_on(&t->x, x);
    gm_real c[4], e[4], other[4];
    ends_1(t, (ptrdiff_t)of->at * t->x.n, p.i, e);
    if (gm_is_blend(of)) {
        ends_1(t, (ptrdiff_t)(of->at + 1) * t->x.n, p.i, other);
        for (int k = 0; k < 4; k++) {
            e[k] = gm_blend(of, e[k], other[k]);
        }
    }
    cubic(e[0], e[1], e[2], e[3], p.slope, c);
    cell->table = -table;
    cell->x_low = p.low;
    cell->x_high = p.high;
    gm_value1 v;
    v.value = p.far ? e[1] : at(c, p.q - p.low);
    v.dx = p.outside ? 0 : p.far ? e[3] : slope_at(c, p.q - p.low);
    v.outside = p.outside;
    return v;
}

/* ---- two dimensions ---- */

/* What Hermite's surface needs of a corner. */
typedef struct corner {
    gm_real f, x, y, xy; /* value, slopes, twist */
} corner;

/* Narrow low .. high so that with a twist in it the Bezier point diagonal of node (i, j)
 * in the cell towards (a, b), each +1 or -1, stays between the values of that cell's
 * corners, and that slopes keep their sign along its edges. Zero stays in. */
static void narrow(const gm_table2 *t, ptrdiff_t from, int i, int j, int a, int b,
                   const corner *c, gm_real *low, gm_real *high)
{
    const ptrdiff_t row = t->y.n, at = from + i * row + j;
    const gm_real h_x = t->x.x[i + a] - t->x.x[i], h_y = t->y.x[j + b] - t->y.x[j];
    const gm_real f[3] = {GM_NODE(t, at + a * row), GM_NODE(t, at + b),
                          GM_NODE(t, at + a * row + b)};
    const gm_real start = c->f + (h_x * c->x + h_y * c->y) / 3;
    gm_real least = c->f, most = c->f;
    for (int k = 0; k < 3; k++) {
        least = smaller(f[k], least);
        most = f[k] > most ? f[k] : most;
    }
    const gm_real ninth = h_x * h_y / 9; /* signed, like the widths */
    const gm_real one = (least - start) / ninth, other = (most - start) / ninth;
    const gm_real below = smaller(one, other), above = one > other ? one : other;
    const gm_real sign = 3 * smaller(magnitude(c->x / h_y), magnitude(c->y / h_x));
    *low = below > *low ? below : *low;
    *low = -sign > *low ? -sign : *low;
    *high = smaller(smaller(above, sign), *high);
}

/* Mixed derivative of the parabolas through the nodes around (i, j), limited by all
 * cells around it. */
static gm_real twist(const gm_table2 *t, ptrdiff_t from, int i, int j, const corner *c)
{
    const int n_x = t->x.n, n_y = t->y.n;
    gm_real low = -GM_UNBOUNDED, high = GM_UNBOUNDED;
    if (n_x < 2 || n_y < 2) {
        return 0;
    }
    line slopes = line_on(&t->x, i); /* d/dy at the nodes of the parabola in x */
    for (int k = 0; k < slopes.n; k++) {
        const line l = along_y(t, from, slopes.first + k, j);
        slopes.f[k] = parabola(&l);
    }
    const gm_real raw = parabola(&slopes);
    for (int k = 0; k < 4; k++) {
        const int a = k & 1 ? 1 : -1, b = k & 2 ? 1 : -1;
        if (i + a >= 0 && i + a < n_x && j + b >= 0 && j + b < n_y) {
            narrow(t, from, i, j, a, b, c, &low, &high);
        }
    }
    low = smaller(low, 0);
    high = high > 0 ? high : 0;
    return raw < low ? low : raw > high ? high : raw;
}

static corner corner_at(const gm_table2 *t, ptrdiff_t from, int i, int j)
{
    const line x = along_x(t, from, i, j), y = along_y(t, from, i, j);
    corner c = {GM_NODE(t, from + (ptrdiff_t)i * t->y.n + j), slope(&x, LIMIT_2),
                slope(&y, LIMIT_2), 0};
    c.xy = twist(t, from, i, j, &c);
    return c;
}

/* Slices are surfaces of their own; between two of them everything is linear. */
static corner blended_corner(const gm_table2 *t, const gm_slices *of, int i, int j)
{
    const ptrdiff_t size = (ptrdiff_t)t->x.n * t->y.n, from = of->at * size;
    corner c = corner_at(t, from, i, j);
    if (gm_is_blend(of)) {
        const corner next = corner_at(t, from + size, i, j);
        c.f = gm_blend(of, c.f, next.f);
        c.x = gm_blend(of, c.x, next.x);
        c.y = gm_blend(of, c.y, next.y);
        c.xy = gm_blend(of, c.xy, next.xy);
    }
    return c;
}

/* Coefficient of u^i v^j. */
static gm_real *coefficient(gm_cell2 *c, int i, int j)
{
    if (i < 2 && j < 2) {
        gm_real *const low[2][2] = {{&c->c0, &c->cy}, {&c->cx, &c->cxy}};
        return low[i][j];
    }
    return &c->more[i < 2 ? 2 * i + j - 2 : 4 * (i - 1) + j];
}

static void fill(const gm_place *x, const gm_place *y, corner f[2][2], gm_cell2 *c)
{
    gm_real value[2][4], rate[2][4], column[4]; /* along x at both y: f and f_y */
    for (int b = 0; b < 2; b++) {
        cubic(f[0][b].f, f[1][b].f, f[0][b].x, f[1][b].x, x->slope, value[b]);
        cubic(f[0][b].y, f[1][b].y, f[0][b].xy, f[1][b].xy, x->slope, rate[b]);
    }
    for (int i = 0; i < 4; i++) {
        cubic(value[0][i], value[1][i], rate[0][i], rate[1][i], y->slope, column);
        for (int j = 0; j < 4; j++) {
            *coefficient(c, i, j) = column[j];
        }
    }
}

static gm_value2 inside(const gm_cell2 *c, gm_real x, gm_real y)
{
    const gm_real u = x - c->x_low, w = y - c->y_low, *m = c->more;
    const gm_real row[4][4] = {{c->c0, c->cy, m[0], m[1]},
                               {c->cx, c->cxy, m[2], m[3]},
                               {m[4], m[5], m[6], m[7]},
                               {m[8], m[9], m[10], m[11]}};
    gm_real value[4], rate[4];
    for (int i = 0; i < 4; i++) {
        value[i] = at(row[i], w);
        rate[i] = slope_at(row[i], w);
    }
    gm_value2 v;
    v.value = at(value, u);
    v.dx = slope_at(value, u);
    v.dy = at(rate, u);
    v.outside = 0;
    return v;
}

/* On the last line of one axis or both: from the far corners, so that nodes are exact. */
static gm_value2 on_far_edge(const gm_place *x, const gm_place *y, corner f[2][2])
{
    const corner *end = &f[x->far][y->far];
    gm_real value[4], across[4];
    gm_value2 v = {end->f, end->x, end->y, 0};
    if (!y->far) {
        cubic(f[1][0].f, f[1][1].f, f[1][0].y, f[1][1].y, y->slope, value);
        cubic(f[1][0].x, f[1][1].x, f[1][0].xy, f[1][1].xy, y->slope, across);
        v.value = at(value, y->q - y->low);
        v.dy = slope_at(value, y->q - y->low);
        v.dx = at(across, y->q - y->low);
    } else if (!x->far) {
        cubic(f[0][1].f, f[1][1].f, f[0][1].x, f[1][1].x, x->slope, value);
        cubic(f[0][1].y, f[1][1].y, f[0][1].xy, f[1][1].xy, x->slope, across);
        v.value = at(value, x->q - x->low);
        v.dx = slope_at(value, x->q - x->low);
        v.dy = at(across, x->q - x->low);
    }
    return v;
}

static int is_inside(const gm_cell2 *c, int table, gm_real x, gm_real y)
{
    return c->table == -table && x >= c->x_low && x < c->x_high && y >= c->y_low &&
           y < c->y_high;
}

gm_value2 gm_monotone2(const gm_table2 *t, const gm_slices *of, int table, gm_cell2 *c,
                       gm_real x, gm_real y)
{
    corner f[2][2];
    if (is_inside(c, table, x, y)) {
        return inside(c, x, y);
    }
    const gm_place p = gm_place_on(&t->x, x), q = gm_place_on(&t->y, y);
    for (int k = 0; k < 4; k++) {
        const int a = k & 1, b = k >> 1;
        f[a][b] =
            blended_corner(t, of, p.i + (t->x.n > 1 ? a : 0), q.i + (t->y.n > 1 ? b : 0));
    }
    c->table = -table;
    c->x_low = p.low;
    c->x_high = p.high;
    c->y_low = q.low;
    c->y_high = q.high;
    fill(&p, &q, f, c);
    gm_value2 v = p.far || q.far ? on_far_edge(&p, &q, f) : inside(c, p.q, q.q);
    v.dx = p.outside ? 0 : v.dx;
    v.dy = q.outside ? 0 : v.dy;
    v.outside = p.outside || q.outside;
    return v;
}
