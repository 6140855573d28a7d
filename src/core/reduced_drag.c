/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Drag of a free path n and its reaction on the output:
 *
 *   N = N_table + sum_lines jump/2 sat(w_n - r w_o)
 *   R = R_table - sum_lines r jump/2 [sat(w_n - r w_o) + sat(r w_o)]
 *
 * with sat(x) = x/GM_LINE_WIDTH limited to -1 .. +1, so that R(0, w_o) = 0 is kept.
 *
 * Away from the ramps every sat is +1 or -1 and the sums are bilinear like the tables. A
 * patch holds the coefficients of both sums over the common cell of all the tables, so
 * that idling gears cost nothing while the point stays there; one line may be on its
 * ramp, as a shaft that nothing drives settles next to a line. With more of them, at the
 * edges of the tables and near w_o = 0 the lines are summed one by one, and always over
 * monotone tables, whose sums are not bilinear. Which way is taken depends on the map and
 * the point only, never on what the cache holds.
 */
#include "cell.h"
#include "reduced_parts.h"

#include <stddef.h>

/* Where N and R are read. */
typedef struct place {
    int i, j;       /* directions of the path, of the output */
    gm_real x, y;   /* |w_n|, |w_o| */
    gm_real w, w_o; /* signed */
} place;

static place place_of(int p, gm_real sign_n, gm_real sign_o, const gm_point *at)
{
    const place q = {gm_direction(sign_n),
                     gm_direction(sign_o),
                     gm_not_below_zero(sign_n * at->m[p]),
                     gm_not_below_zero(sign_o * at->m[GM_OUT]),
                     at->m[p],
                     at->m[GM_OUT]};
    return q;
}

/* Number of the tables of a quadrant: their cells are shared by the four. */
static int quadrant(const place *q)
{
    return 1 + 2 * q->i + q->j;
}

static gm_value1 line_jump(const gm_drive *d, int p, int line, const place *q,
                           gm_cell1 *copy)
{
    const gm_table1 *jump = &d->map->path[p].lines[line].jump[q->j];
    gm_cell1 local = {0, 0, 0, 0, 0};
    gm_cell1 *cell = line < GM_CACHED_LINES ? &d->cache->line[p][line] : &local;
    const gm_value1 v = gm_cell1_at(jump, 1 + q->j, cell, q->y);
    *copy = *cell;
    return v;
}

/* ---- the patch ---- */

static int on_ramp(gm_real slip)
{
    return slip < GM_LINE_WIDTH && slip > -GM_LINE_WIDTH;
}

static int in_patch(const gm_drag_patch *c, const place *q)
{
    return c->key == quadrant(q) && q->x >= c->x_low && q->x < c->x_high &&
           q->y >= c->y_low && q->y < c->y_high &&
           (!c->any_above || q->w - c->ratio_above * q->w_o >= GM_LINE_WIDTH) &&
           (!c->any_below || q->w - c->ratio_below * q->w_o <= -GM_LINE_WIDTH) &&
           (!c->any_ramp || on_ramp(q->w - c->ratio_ramp * q->w_o));
}

/* Note the side of a line; 0: a second line on its ramp. */
static int sort_line(gm_real r, gm_real sign, const place *q, gm_drag_patch *c)
{
    const gm_real slip = q->w - r * q->w_o;
    if (on_ramp(slip)) {
        c->ratio_ramp = r;
        return ++c->any_ramp == 1;
    }
    if (slip > 0 && (!c->any_above || sign * r > sign * c->ratio_above)) {
        c->any_above = 1;
        c->ratio_above = r;
    }
    if (slip < 0 && (!c->any_below || sign * r < sign * c->ratio_below)) {
        c->any_below = 1;
        c->ratio_below = r;
    }
    return 1;
}

/* Sides of all lines: the nearest of those the point is above and below of, and the one
 * it is on. 0: no patch here. */
static int sort_lines(const gm_path *path, const place *q, gm_drag_patch *c)
{
    const gm_real sign = q->j == GM_BACKWARD ? -1 : 1;
    for (int i = 0; i < path->n_lines; i++) {
        const gm_real r = path->lines[i].ratio, least = GM_LINE_WIDTH / gm_abs(r);
        c->y_low = least > c->y_low ? least : c->y_low;
        if (q->y < least || !sort_line(r, sign, q, c)) {
            return 0;
        }
    }
    return 1;
}

/* Narrow the patch to a table's cell; 0 when the point is not inside of it. */
static int narrow_y(gm_real low, gm_real high, gm_real y, gm_drag_patch *c)
{
    c->y_low = low > c->y_low ? low : c->y_low;
    c->y_high = high < c->y_high ? high : c->y_high;
    return y >= low && y < high;
}

static int narrow(const gm_cell2 *cell, const place *q, gm_drag_patch *c)
{
    c->x_low = cell->x_low > c->x_low ? cell->x_low : c->x_low;
    c->x_high = cell->x_high < c->x_high ? cell->x_high : c->x_high;
    return narrow_y(cell->y_low, cell->y_high, q->y, c) && q->x >= cell->x_low &&
           q->x < cell->x_high;
}

/* A cell's surface about the corner of the patch. */
static gm_surface surface_of(const gm_cell2 *cell, const gm_drag_patch *c)
{
    const gm_value2 corner = gm_cell2_inside(cell, c->x_low, c->y_low);
    const gm_surface s = {corner.value, corner.dx, corner.dy, cell->cxy};
    return s;
}

static void add_line_to_patch(const gm_cell1 *jump, gm_real r, const place *q,
                              gm_drag_patch *c)
{
    const gm_real half = gm_cell1_inside(jump, c->y_low).value / 2, half_y = jump->cx / 2;
    const gm_real slip = q->w - r * q->w_o, rest = r * q->w_o > 0 ? 1 : -1;
    gm_real side = slip > 0 ? 1 : -1;
    if (on_ramp(slip)) {
        c->half = half;
        c->half_y = half_y;
        side = 0;
    }
    c->drag.c0 += side * half;
    c->drag.cy += side * half_y;
    c->reaction.c0 -= r * (side + rest) * half;
    c->reaction.cy -= r * (side + rest) * half_y;
}

/* The patch around q in *c; 0 when there is none: on a ramp, at or beyond an edge,
 * over monotone tables. */
static int fill_patch(const gm_drive *d, int p, const place *q, gm_drag_patch *c)
{
    const gm_path *path = &d->map->path[p];
    static const gm_drag_patch empty = {0};
    gm_drag_patch made = empty;
    gm_cell2 *n = &d->cache->drag[p], *r = &d->cache->reaction[p];
    gm_cell1 jump;
    made.x_high = made.y_high = GM_UNBOUNDED;
    if (path->drag[q->i][q->j].monotone || !sort_lines(path, q, &made)) {
        return 0;
    }
    gm_cell2_at(&path->drag[q->i][q->j], quadrant(q), n, q->x, q->y);
    gm_cell2_at(&path->reaction[q->i][q->j], quadrant(q), r, q->x, q->y);
    if (!narrow(n, q, &made) || !narrow(r, q, &made)) {
        return 0;
    }
    for (int i = 0; i < path->n_lines; i++) {
        line_jump(d, p, i, q, &jump);
        if (!narrow_y(jump.x_low, jump.x_high, q->y, &made)) {
            return 0;
        }
    }
    made.drag = surface_of(n, &made);
    made.reaction = surface_of(r, &made);
    for (int i = 0; i < path->n_lines; i++) {
        line_jump(d, p, i, q, &jump);
        add_line_to_patch(&jump, path->lines[i].ratio, q, &made);
    }
    made.key = quadrant(q);
    *c = made;
    return 1;
}

/* The line that the patch lies on. */
static void add_ramp(const gm_drag_patch *c, const place *q, gm_real sign_o,
                     gm_real scale, gm_path_terms *t)
{
    const gm_real r = c->ratio_ramp, s = (q->w - r * q->w_o) / GM_LINE_WIDTH;
    const gm_real half = scale * (c->half + c->half_y * (q->y - c->y_low));
    const gm_real slope = half / GM_LINE_WIDTH;
    const gm_real slope_o = scale * sign_o * c->half_y * s - r * slope;
    t->drag += half * s;
    t->drag_n += slope;
    t->drag_o += slope_o;
    t->reaction -= r * half * s;
    t->reaction_n -= r * slope;
    t->reaction_o -= r * slope_o;
}

static void set_from_patch(const gm_drag_patch *c, const place *q, gm_real sign_n,
                           gm_real sign_o, gm_real scale, gm_path_terms *t)
{
    const gm_surface *n = &c->drag, *r = &c->reaction;
    const gm_real u = q->x - c->x_low, v = q->y - c->y_low;
    const gm_real n_x = n->cx + n->cxy * v, r_x = r->cx + r->cxy * v;
    t->drag = scale * (n->c0 + n->cy * v + n_x * u);
    t->drag_n = scale * sign_n * n_x;
    t->drag_o = scale * sign_o * (n->cy + n->cxy * u);
    t->reaction = scale * (r->c0 + r->cy * v + r_x * u);
    t->reaction_n = scale * sign_n * r_x;
    t->reaction_o = scale * sign_o * (r->cy + r->cxy * u);
    if (c->any_ramp) {
        add_ramp(c, q, sign_o, scale, t);
    }
}

/* ---- the sum over the lines ---- */

/* Side of a ramp that x lies on: 1 below, 2 on it, 3 above. */
static unsigned side_of(gm_real x)
{
    return x >= GM_LINE_WIDTH ? 3 : x <= -GM_LINE_WIDTH ? 1 : 2;
}

/* sat and its slope */
static gm_real ramp(gm_real x, unsigned side, gm_real *slope)
{
    *slope = side == 2 ? 1 / GM_LINE_WIDTH : 0;
    return side == 2 ? x / GM_LINE_WIDTH : (gm_real)side - 2;
}

static void add_line(const gm_drive *d, int p, int line, const place *q, gm_terms *t)
{
    const gm_real r = d->map->path[p].lines[line].ratio;
    const gm_real slip = q->w - r * q->w_o, sigma = q->j == GM_BACKWARD ? -1 : 1;
    gm_cell1 unused;
    const gm_value1 j = line_jump(d, p, line, q, &unused);
    const gm_real half = d->scale * j.value / 2, half_o = d->scale * sigma * j.dx / 2;
    const unsigned side = side_of(slip), side_rest = side_of(r * q->w_o);
    gm_real slope, slope_rest;
    const gm_real s = ramp(slip, side, &slope);
    const gm_real s_both = s + ramp(r * q->w_o, side_rest, &slope_rest);
    gm_path_terms *path = &t->path[p];
    path->drag += half * s;
    path->drag_n += half * slope;
    path->drag_o += half_o * s - half * slope * r;
    path->reaction -= r * half * s_both;
    path->reaction_n -= r * half * slope;
    path->reaction_o -= r * (half_o * s_both + half * r * (slope_rest - slope));
    path->ramps = 16 * path->ramps + 4 * side + side_rest;
    t->outside |= j.outside;
}

static void add_all(const gm_drive *d, int p, const place *q, gm_real sign_n,
                    gm_real sign_o, gm_terms *t)
{
    const gm_path *path = &d->map->path[p];
    const gm_real scale = d->scale;
    gm_path_terms *terms = &t->path[p];
    const gm_value2 n =
        gm_cell2_at(&path->drag[q->i][q->j], quadrant(q), &d->cache->drag[p], q->x, q->y);
    const gm_value2 r = gm_cell2_at(&path->reaction[q->i][q->j], quadrant(q),
                                    &d->cache->reaction[p], q->x, q->y);
    terms->drag = scale * n.value;
    terms->drag_n = scale * sign_n * n.dx;
    terms->drag_o = scale * sign_o * n.dy;
    terms->reaction = scale * r.value;
    terms->reaction_n = scale * sign_n * r.dx;
    terms->reaction_o = scale * sign_o * r.dy;
    terms->ramps = 0;
    t->outside |= n.outside || r.outside;
    for (int line = 0; line < path->n_lines; line++) {
        add_line(d, p, line, q, t);
    }
}

void gm_drag_terms(const gm_drive *d, int p, gm_real sign_n, gm_real sign_o,
                   const gm_point *at, gm_terms *t)
{
    const place q = place_of(p, sign_n, sign_o, at);
    gm_drag_patch *patch = &d->cache->patch[p][q.i];
    gm_path_terms *terms = &t->path[p];
    terms->patched = in_patch(patch, &q) || fill_patch(d, p, &q, patch);
    if (terms->patched) {
        set_from_patch(patch, &q, sign_n, sign_o, d->scale, terms);
    } else {
        add_all(d, p, &q, sign_n, sign_o, t);
    }
    if (sign_n * at->m[p] < 0) {
        terms->drag_n = terms->reaction_n = 0;
    }
    if (sign_o * at->m[GM_OUT] < 0) {
        terms->drag_o = terms->reaction_o = 0;
    }
}

/* ---- do they hold at another point? ---- */

/* Beyond rest the terms are constants, before it a surface. */
static int same_side_of_rest(gm_real sign, gm_real m, gm_real to)
{
    return (sign * m < 0) == (sign * to < 0);
}

static int patch_holds(const gm_drag_patch *c, const place *q, const place *to,
                       const gm_path_terms *t)
{
    const gm_real du = to->x - q->x, dv = to->y - q->y;
    const gm_real d_slip = to->w - q->w - c->ratio_ramp * (to->w_o - q->w_o);
    const gm_real ramp_rest = c->any_ramp ? c->half_y * dv * d_slip / GM_LINE_WIDTH : 0;
    return in_patch(c, to) && gm_is_small(c->drag.cxy * du * dv, t->drag) &&
           gm_is_small(c->reaction.cxy * du * dv, t->reaction) &&
           gm_is_small(ramp_rest, t->drag);
}

/* Whether every line's ramps and jump table are read in the same place. Of more than
 * eight lines the ramps of the last eight are compared. */
static int lines_hold(const gm_drive *d, int p, const gm_path_terms *t, const place *q,
                      const place *to)
{
    const gm_path *path = &d->map->path[p];
    unsigned now = 0;
    for (int i = 0; i < path->n_lines; i++) {
        const gm_real r = path->lines[i].ratio;
        const gm_cell1 *c = &d->cache->line[p][i < GM_CACHED_LINES ? i : 0];
        now = 16 * now + 4 * side_of(to->w - r * to->w_o) + side_of(r * to->w_o);
        if (!gm_cell1_holds(c, q->y, to->y, t->drag)) {
            return 0;
        }
    }
    return now == t->ramps;
}

int gm_drag_holds(const gm_drive *d, const gm_solution *s, int p, const gm_point *from,
                  const gm_point *next)
{
    const gm_path_terms *t = &s->terms.path[p];
    const place q = place_of(p, s->sign[p], s->sign[GM_OUT], from);
    const place to = place_of(p, s->sign[p], s->sign[GM_OUT], next);
    if (!same_side_of_rest(s->sign[p], from->m[p], next->m[p]) ||
        !same_side_of_rest(s->sign[GM_OUT], from->m[GM_OUT], next->m[GM_OUT])) {
        return 0;
    }
    if (t->patched) {
        return patch_holds(&d->cache->patch[p][q.i], &q, &to, t);
    }
    return gm_cell2_holds(&d->cache->drag[p], q.x, q.y, to.x, to.y, t->drag) &&
           gm_cell2_holds(&d->cache->reaction[p], q.x, q.y, to.x, to.y, t->reaction) &&
           lines_hold(d, p, t, &q, &to);
}
