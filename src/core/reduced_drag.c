/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Drag of a free path n and its reaction on the output:
 *
 *   N = N_table + sum_lines jump/2 sat(w_n - r w_o)
 *   R = R_table - sum_lines r jump/2 [sat(w_n - r w_o) + sat(r w_o)]
 *
 * with sat(x) = x/GM_LINE_WIDTH limited to -1 .. +1, so that R(0, w_o) = 0 is kept.
 *
 * Where every sat is constant or on its ramp, and within one cell of all the tables, both
 * sums are polynomials c + cx u + cy v + cxy u v + cyy v^2 of u = |w_n| - x_low and
 * v = |w_o| - y_low. They are summed up once and serve as long as the point stays there,
 * so drag lines cost nothing while none is crossed. A patch is bounded by the ends of the
 * ramps, w_n = r w_o +- GM_LINE_WIDTH: the nearest below and above the point, of either
 * end.
 */
#include "reduced_parts.h"

/* Bounds of a patch by ends of ramps: w_n >= r w_o + W, w_n > r w_o - W and
 * w_n < r w_o + W, w_n <= r w_o - W, as bits of sides and indices of ratio. */
enum { ABOVE_RAMP, ABOVE_START, BELOW_END, BELOW_RAMP };

/* Where N and R are read. */
typedef struct place {
    int i, j;               /* directions of the path, of the output */
    gm_real x, y;           /* |w_n|, |w_o| */
    gm_real w, w_o;         /* signed */
    gm_real sign_n, sign_o; /* +1, -1 */
} place;

/* A prescribed shaft at rest, sign 0, is read as one that is about to turn forward: a
 * patch serves both. */
static place place_of(int p, gm_real sign_n, gm_real sign_o, const gm_point *at)
{
    const int i = gm_direction(sign_n), j = gm_direction(sign_o);
    const gm_real ahead = (gm_real)(1 - 2 * i), turn = (gm_real)(1 - 2 * j);
    const gm_real x = gm_not_below_zero(ahead * at->m[p]);
    const gm_real y = gm_not_below_zero(turn * at->m[GM_OUT]);
    const place q = {i, j, x, y, ahead * x, turn * y, ahead, turn};
    return q;
}

/* Number of the tables of a quadrant, 1 to 4: load losses have those from 8 on. At
 * standstill, by direction of the output: */
enum { REST = 5 };

static int quadrant(const place *q)
{
    return 1 + 2 * q->i + q->j;
}

static int has(const gm_patch *c, int bound)
{
    return c->sides >> bound & 1;
}

static int is_here(const gm_patch *c, const place *q)
{
    const gm_real *r = c->ratio;
    if (c->key != quadrant(q) || !gm_in_patch(c, q->x, q->y)) {
        return 0;
    }
    return (!has(c, ABOVE_RAMP) || q->w - r[ABOVE_RAMP] * q->w_o >= GM_LINE_WIDTH) &&
           (!has(c, ABOVE_START) || q->w - r[ABOVE_START] * q->w_o > -GM_LINE_WIDTH) &&
           (!has(c, BELOW_END) || q->w - r[BELOW_END] * q->w_o < GM_LINE_WIDTH) &&
           (!has(c, BELOW_RAMP) || q->w - r[BELOW_RAMP] * q->w_o <= -GM_LINE_WIDTH);
}

/* ---- filling a patch ---- */

/* The nearest bound of its kind is kept. Above a bound the steeper line is nearer (for
 * w_o > 0), below it the flatter one. */
static void add_bound(int bound, gm_real r, gm_real sign_o, gm_patch *c)
{
    const int below = bound == BELOW_END || bound == BELOW_RAMP;
    const gm_real nearer = sign_o * (below ? c->ratio[bound] - r : r - c->ratio[bound]);
    if (!has(c, bound) || nearer > 0) {
        c->sides = (short)(c->sides | 1 << bound);
        c->ratio[bound] = r;
    }
}

/* sat(x) where it is constant, 0 on the ramp. */
static int side_of(gm_real x)
{
    return x >= GM_LINE_WIDTH ? 1 : x <= -GM_LINE_WIDTH ? -1 : 0;
}

static void add_bounds(gm_real r, const place *q, gm_patch *c)
{
    const gm_real rest = GM_LINE_WIDTH / gm_abs(r);
    const int side = side_of(q->w - r * q->w_o);
    if (side > 0) {
        add_bound(ABOVE_RAMP, r, q->sign_o, c);
    } else if (side < 0) {
        add_bound(BELOW_RAMP, r, q->sign_o, c);
    } else {
        add_bound(ABOVE_START, r, q->sign_o, c);
        add_bound(BELOW_END, r, q->sign_o, c);
    }
    if (q->y >= rest) { /* the other ramp, sat(r w_o) */
        c->y_low = rest > c->y_low ? rest : c->y_low;
    } else {
        c->y_high = rest < c->y_high ? rest : c->y_high;
    }
}

/* Narrow the patch to the spots of a table; speeds are not below zero. */
static void narrow(const gm_spot *s, gm_real *low, gm_real *high, gm_patch *c)
{
    *low = s->low > *low ? s->low : *low;
    *high = s->high < *high ? s->high : *high;
    c->outside = (short)(c->outside | s->outside);
}

static void narrow_both(const gm_spot *x, const gm_spot *y, gm_patch *c)
{
    narrow(x, &c->x_low, &c->x_high, c);
    narrow(y, &c->y_low, &c->y_high, c);
}

/* Where the sums have their zero of u and v while lines are added: a corner of a cell. */
typedef struct origin {
    gm_real x, y;
} origin;

static origin origin_of(const gm_spot *x, const gm_spot *y)
{
    const origin o = {x->next ? x->low : 0, y->next ? y->low : 0};
    return o;
}

static void move(gm_real u, gm_real v, gm_surface *s)
{
    s->c += s->cx * u + s->cy * v + s->cxy * u * v + s->cyy * v * v;
    s->cx += s->cxy * v;
    s->cy += s->cxy * u + 2 * s->cyy * v;
}

/* Add the surface of a table in its spots. */
static void add_table(const gm_table2 *t, const gm_slices *of, gm_cell2 *curved,
                      const place *q, const gm_spot *x, const gm_spot *y, const origin *o,
                      gm_surface *s)
{
    gm_surface more = GM_CURVED && t->monotone
                          ? gm_tangent_at(t, of, quadrant(q), curved, q->x, q->y, x, y)
                          : gm_surface_at(t, of, x, y);
    const origin own = origin_of(x, y);
    if (own.x != o->x || own.y != o->y) {
        move(o->x - own.x, o->y - own.y, &more);
    }
    s->c += more.c;
    s->cx += more.cx;
    s->cy += more.cy;
    s->cxy += more.cxy;
}

/* k (half + slope v) (c + cx u + cy v) */
static void add_product(gm_real k, const gm_strip *half, const gm_real ramp[3],
                        gm_surface *s)
{
    s->c += k * half->c * ramp[0];
    s->cx += k * half->c * ramp[1];
    s->cy += k * (half->c * ramp[2] + half->cx * ramp[0]);
    s->cxy += k * half->cx * ramp[1];
    s->cyy += k * half->cx * ramp[2];
}

/* A line on one of its ramps: sat(w_n - r w_o) and sat(r w_o) as c + cx u + cy v. */
static void add_ramps(gm_real r, const place *q, const origin *o, const gm_strip *half,
                      int slips, int rests, gm_patch *c)
{
    const gm_real turn = r * q->sign_o / GM_LINE_WIDTH;
    const gm_real ahead = q->sign_n / GM_LINE_WIDTH;
    gm_real slip[3] = {(gm_real)slips, 0, 0}, both[3];
    if (slips == 0) {
        slip[0] = ahead * o->x - turn * o->y;
        slip[1] = ahead;
        slip[2] = -turn;
    }
    both[0] = slip[0] + (rests ? (gm_real)rests : turn * o->y);
    both[1] = slip[1];
    both[2] = slip[2] + (rests ? 0 : turn);
    add_product(1, half, slip, &c->a);
    add_product(-r, half, both, &c->b);
}

static void add_line(const gm_drag_line *line, const gm_slices *of, const place *q,
                     const gm_spot *y, const origin *o, gm_patch *c)
{
    const gm_real r = line->ratio;
    const int slips = side_of(q->w - r * q->w_o);
    const int rests = q->y < GM_LINE_WIDTH / gm_abs(r) ? 0 : r * q->sign_o > 0 ? 1 : -1;
    gm_strip half = gm_line_at(&line->jump[q->j], of, q->y, y);
    half.cx /= 2;
    half.c = half.c / 2 + half.cx * (y->next ? o->y - y->low : 0);
    if (slips == 0 || rests == 0) {
        add_ramps(r, q, o, &half, slips, rests, c);
        return;
    }
    const gm_real k = -r * (gm_real)(slips + rests);
    c->a.c += (gm_real)slips * half.c;
    c->a.cy += (gm_real)slips * half.cx;
    c->b.c += k * half.c;
    c->b.cy += k * half.cx;
}

static gm_spot spot_of(const gm_table2 *t, const gm_axis *axis, gm_real q)
{
    return GM_CURVED && t->monotone ? gm_spot_near(axis, q) : gm_spot_on(axis, q);
}

/* The spot on another axis: the same one if the axis is. */
static gm_spot spot_again(const gm_table2 *t, const gm_axis *axis, const gm_axis *first,
                          const gm_spot *s, gm_real q)
{
    return axis->x == first->x && axis->n == first->n ? *s : spot_of(t, axis, q);
}

static void empty_patch(int key, gm_patch *c)
{
    static const gm_surface nothing = {0, 0, 0, 0, 0};
    c->key = (short)key;
    c->outside = c->sides = 0;
    c->x_low = c->y_low = 0;
    c->x_high = c->y_high = GM_UNBOUNDED;
    c->a = c->b = nothing;
}

/* Lines; n and its spot y as a first guess of theirs. */
static void add_lines(const gm_path *path, const gm_slices *of, const place *q,
                      const gm_table2 *n, const gm_spot *y, const origin *o, gm_patch *c)
{
    for (int i = 0; i < path->n_lines; i++) {
        const gm_drag_line *line = &path->lines[i];
        const gm_axis *axis = &line->jump[q->j].x;
        const gm_spot at = spot_again(n, axis, &n->y, y, q->y);
        narrow(&at, &c->y_low, &c->y_high, c);
        add_bounds(line->ratio, q, c);
        add_line(line, of, q, &at, o, c);
    }
}

/* Sums from the corner of the patch on. */
static void move_to_corner(const origin *o, gm_patch *c)
{
    const gm_real u = c->x_low - o->x, v = c->y_low - o->y;
    if (u != 0 || v != 0) {
        move(u, v, &c->a);
        move(u, v, &c->b);
    }
}

static void fill(const gm_drive *d, int p, const place *q, gm_patch *c)
{
    const gm_path *path = &d->map->path[p];
    const gm_slices *of = &d->cache->oil.slices;
    const gm_table2 *n = &path->drag[q->i][q->j], *r = &path->reaction[q->i][q->j];
    gm_spot x = spot_of(n, &n->x, q->x), y = spot_of(n, &n->y, q->y);
    const origin o = origin_of(&x, &y);
    empty_patch(quadrant(q), c);
    narrow_both(&x, &y, c);
    add_table(n, of, gm_curved_cell(d->cache, p, 0), q, &x, &y, &o, &c->a);
    add_lines(path, of, q, n, &y, &o, c);
    x = spot_again(n, &r->x, &n->x, &x, q->x);
    y = spot_again(n, &r->y, &n->y, &y, q->y);
    narrow_both(&x, &y, c);
    add_table(r, of, gm_curved_cell(d->cache, p, 1), q, &x, &y, &o, &c->b);
    move_to_corner(&o, c);
}

/* N at standstill over |w_o|: surface a forward, b backward. */
static void fill_rest(const gm_drive *d, int p, place *q, gm_patch *c)
{
    const gm_path *path = &d->map->path[p];
    const gm_slices *of = &d->cache->oil.slices;
    const gm_table2 *n = &path->drag[GM_FORWARD][q->j];
    gm_spot x = spot_of(n, &n->x, 0), y = spot_of(n, &n->y, q->y);
    const origin o = {0, y.next ? y.low : 0};
    empty_patch(REST + q->j, c);
    add_lines(path, of, q, n, &y, &o, c);
    c->b = c->a;
    narrow_both(&x, &y, c);
    add_table(n, of, gm_curved_cell(d->cache, p, 0), q, &x, &y, &o, &c->a);
    n = &path->drag[GM_BACKWARD][q->j];
    q->i = GM_BACKWARD;
    x = spot_of(n, &n->x, 0);
    y = spot_of(n, &n->y, q->y);
    narrow_both(&x, &y, c);
    add_table(n, of, gm_curved_cell(d->cache, p, 0), q, &x, &y, &o, &c->b);
    c->x_low = 0;
    move_to_corner(&o, c);
}

/* ---- reading it ---- */

void gm_drag_terms(const gm_drive *d, int p, gm_real sign_n, gm_real sign_o,
                   const gm_point *at, gm_terms *t)
{
    const place q = place_of(p, sign_n, sign_o, at);
    const gm_path *path = &d->map->path[p];
    gm_patch *c = &d->cache->path[p];
    gm_path_terms *terms = &t->path[p];
    if (!is_here(c, &q) || (GM_CURVED && path->drag[0][0].monotone)) {
        fill(d, p, &q, c);
    }
    const gm_surface *n = &c->a, *r = &c->b;
    const gm_real u = q.x - c->x_low, v = q.y - c->y_low;
    const gm_real n_x = n->cx + n->cxy * v, r_x = r->cx + r->cxy * v;
    const gm_real per_n = sign_n * at->m[p] < 0 ? 0 : d->scale * sign_n;
    const gm_real per_o = sign_o * at->m[GM_OUT] < 0 ? 0 : d->scale * sign_o;
    terms->drag = d->scale * (n->c + (n->cy + n->cyy * v) * v + n_x * u);
    terms->drag_n = per_n * n_x;
    terms->drag_o = per_o * (n->cy + n->cxy * u + 2 * n->cyy * v);
    terms->reaction = d->scale * (r->c + (r->cy + r->cyy * v) * v + r_x * u);
    terms->reaction_n = per_n * r_x;
    terms->reaction_o = per_o * (r->cy + r->cxy * u + 2 * r->cyy * v);
    t->outside |= c->outside;
}

gm_real gm_drag_at_rest(const gm_drive *d, int p, gm_real sign_n, gm_real sign_o,
                        const gm_point *at, int *outside)
{
    const int j = gm_direction(sign_o);
    const gm_real y = gm_not_below_zero(sign_o * at->m[GM_OUT]);
    gm_patch *c = &d->cache->path[p];
    if (c->key != REST + j || !gm_in_patch(c, 0, y) ||
        (GM_CURVED && d->map->path[p].drag[0][0].monotone)) {
        place q = {GM_FORWARD, j, 0, y, 0, sign_o * y, 1, sign_o};
        fill_rest(d, p, &q, c);
    }
    const gm_surface *n = sign_n < 0 ? &c->b : &c->a;
    const gm_real v = y - c->y_low;
    *outside |= c->outside;
    return d->scale * (n->c + (n->cy + n->cyy * v) * v);
}

/* ---- do they hold at another point? ---- */

/* Beyond rest the terms are constants, before it a surface. */
static int same_side_of_rest(gm_real sign, gm_real m, gm_real to)
{
    return (sign * m < 0) == (sign * to < 0);
}

int gm_drag_holds(const gm_drive *d, const gm_solution *s, int p, const gm_point *from,
                  const gm_point *next)
{
    const gm_path_terms *t = &s->terms.path[p];
    const gm_patch *c = &d->cache->path[p];
    const place to = place_of(p, s->sign[p], s->sign[GM_OUT], next);
    const gm_real du = next->m[p] - from->m[p], dv = next->m[GM_OUT] - from->m[GM_OUT];
    return same_side_of_rest(s->sign[p], from->m[p], next->m[p]) &&
           same_side_of_rest(s->sign[GM_OUT], from->m[GM_OUT], next->m[GM_OUT]) &&
           is_here(c, &to) &&
           gm_is_small((gm_abs(c->a.cxy * du) + gm_abs(c->a.cyy * dv)) * dv, t->drag) &&
           gm_is_small((gm_abs(c->b.cxy * du) + gm_abs(c->b.cyy * dv)) * dv, t->reaction);
}
