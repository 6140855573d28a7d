/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Loss torques of the reduced gearset from its tables, with gradients, at one point of
 * mid-step speeds and transmitted torques.
 *
 *   output          sigma [P(|w_o|) + X(|w_o|, sigma_0 tau_m,0, sigma_1 tau_m,1)]
 *   engaged path    sigma_p D(|w_p|, sigma_p tau_m,p)          sigma_p = sgn(r_p) sigma
 *   free path       N = N_table + sum_lines jump/2 sat(w_n - r w_o)
 *                   R = R_table - sum_lines r jump/2 [sat(w_n - r w_o) + sat(r w_o)]
 *   coupling        C(w_0 - w_1), unless both paths are engaged (then it is inside P)
 *
 * sat(x) is x/GM_LINE_WIDTH, limited to -1 .. +1; R(0, w_o) = 0 is kept by construction.
 * Sources: the equations in gm_reduced.h. Speeds enter the tables as magnitudes; an
 * iterate that overshoots standstill is read at zero.
 */
#include "reduced_parts.h"
#include "cell.h"

#include <stddef.h>

/* ---- values ---- */

static gm_real coupling_at(const gm_drive *d, const gm_point *at, gm_terms *t)
{
    const gm_value1 c =
        gm_cell1_at(&d->map->coupling, 1, &d->cache->coupling, at->m[0] - at->m[1]);
    t->coupling = d->scale * c.value;
    t->coupling_w = d->scale * c.dx;
    t->outside |= c.outside;
    return t->coupling;
}

static void load_terms(const gm_drive *d, int p, int sign_o, const gm_point *at,
                       gm_terms *t)
{
    const gm_gear *gear = d->gear[p];
    const int sign = gear->ratio < 0 ? -sign_o : sign_o, dir = gm_direction(sign);
    const gm_real sigma = sign;
    const gm_value2 v =
        gm_cell2_at(&gear->load_loss[dir], 1 + (int)(gear - d->map->path[p].gears),
                    &d->cache->load_loss[p][dir], gm_not_below_zero(sigma * at->m[p]),
                    sigma * at->tau_m[p]);
    gm_path_terms *path = &t->path[p];
    path->load = d->scale * sigma * v.value;
    path->load_o = d->scale * v.dx * gear->ratio;
    path->load_tau = d->scale * v.dy;
    t->outside |= v.outside;
}

/* X acts only while both paths are engaged. */
static void add_both_loaded(const gm_drive *d, int sign_o, const gm_point *at,
                            gm_terms *t)
{
    const gm_table3 *table = &d->configuration->both_loaded[gm_direction(sign_o)];
    const gm_real sigma = sign_o, scale = d->scale;
    if (table->value == NULL) {
        return;
    }
    const gm_real s0 = d->ratio[0] < 0 ? -sigma : sigma,
                  s1 = d->ratio[1] < 0 ? -sigma : sigma;
    const gm_value3 v = gm_table3_at(table, gm_not_below_zero(sigma * at->m[GM_OUT]),
                                     s0 * at->tau_m[0], s1 * at->tau_m[1]);
    t->out += scale * sigma * v.value;
    t->out_o += scale * v.dx;
    t->out_tau[0] = scale * sigma * v.dy * s0;
    t->out_tau[1] = scale * sigma * v.dz * s1;
    t->outside |= v.outside;
}

void gm_output_terms(const gm_drive *d, int sign, const gm_point *at, gm_terms *t)
{
    const int dir = gm_direction(sign);
    const gm_real sigma = sign;
    const gm_value1 v =
        gm_cell1_at(&d->configuration->parasitic[dir], d->index + 1,
                    &d->cache->parasitic[dir], gm_not_below_zero(sigma * at->m[GM_OUT]));
    t->out = d->scale * sigma * v.value;
    t->out_o = d->scale * v.dx;
    t->outside |= v.outside;
    for (int p = 0; p < d->n_paths; p++) {
        if (d->engaged[p]) {
            load_terms(d, p, sign, at, t);
        }
    }
    if (d->engaged[0] && d->engaged[1]) {
        add_both_loaded(d, sign, at, t);
    }
}

static gm_value1 line_jump(const gm_drive *d, int p, int line, int dir, gm_real speed)
{
    const gm_table1 *jump = &d->map->path[p].lines[line].jump[dir];
    gm_cell1 local = {0, 0, 0, 0, 0};
    gm_cell1 *cell = line < GM_CACHED_LINES ? &d->cache->line[p][line] : &local;
    return gm_cell1_at(jump, 1 + dir, cell, speed);
}

/* sat and its slope */
static gm_real ramp(gm_real x, gm_real *slope)
{
    const gm_real y = x / GM_LINE_WIDTH;
    *slope = 0;
    if (y >= 1) {
        return 1;
    }
    if (y <= -1) {
        return -1;
    }
    *slope = 1 / GM_LINE_WIDTH;
    return y;
}

static void add_line(const gm_drive *d, int p, int line, int sign_o, const gm_point *at,
                     gm_terms *t)
{
    const gm_real m_o = at->m[GM_OUT], sigma = sign_o;
    const gm_real r = d->map->path[p].lines[line].ratio;
    const gm_value1 j =
        line_jump(d, p, line, gm_direction(sign_o), gm_not_below_zero(sigma * m_o));
    const gm_real half = d->scale * j.value / 2, half_o = d->scale * sigma * j.dx / 2;
    gm_real slope, slope_rest;
    const gm_real s = ramp(at->m[p] - r * m_o, &slope);
    const gm_real s_both = s + ramp(r * m_o, &slope_rest);
    gm_path_terms *path = &t->path[p];
    path->drag += half * s;
    path->drag_n += half * slope;
    path->drag_o += half_o * s - half * slope * r;
    path->reaction -= r * half * s_both;
    path->reaction_n -= r * half * slope;
    path->reaction_o -= r * (half_o * s_both + half * r * (slope_rest - slope));
    t->outside |= j.outside;
}

void gm_drag_terms(const gm_drive *d, int p, int sign_n, int sign_o, const gm_point *at,
                   gm_terms *t)
{
    const gm_path *path = &d->map->path[p];
    const int i = gm_direction(sign_n), j = gm_direction(sign_o);
    const gm_real s_n = d->scale * sign_n, s_o = d->scale * sign_o, scale = d->scale;
    const gm_real x = gm_not_below_zero(sign_n * at->m[p]);
    const gm_real y = gm_not_below_zero(sign_o * at->m[GM_OUT]);
    const gm_value2 n = gm_cell2_at(&path->drag[i][j], 1, &d->cache->drag[p][i][j], x, y);
    const gm_value2 r =
        gm_cell2_at(&path->reaction[i][j], 1, &d->cache->reaction[p][i][j], x, y);
    gm_path_terms *terms = &t->path[p];
    terms->drag = scale * n.value;
    terms->drag_n = s_n * n.dx;
    terms->drag_o = s_o * n.dy;
    terms->reaction = scale * r.value;
    terms->reaction_n = s_n * r.dx;
    terms->reaction_o = s_o * r.dy;
    t->outside |= n.outside || r.outside;
    for (int line = 0; line < path->n_lines; line++) {
        add_line(d, p, line, sign_o, at, t);
    }
}

void gm_terms_at(const gm_drive *d, gm_solution *s, gm_point *at)
{
    static const gm_terms none = {0};
    gm_terms *t = &s->terms;
    *t = none;
    const gm_real c = d->coupled ? coupling_at(d, at, t) : 0;
    for (int p = 0; p < d->n_paths; p++) {
        const gm_real tau = d->tau[p] + (p == 0 ? -c : c);
        at->tau_m[p] = tau - d->inertia[p] * d->ratio[p] * at->a[GM_OUT];
        if (d->free[p]) {
            gm_drag_terms(d, p, s->sign[p], s->sign[GM_OUT], at, t);
        }
    }
    if (!s->held[GM_OUT]) {
        gm_output_terms(d, s->sign[GM_OUT], at, t);
    }
}

/* ---- do they hold at another point? ---- */

/* Relative size of the bilinear remainder cxy du dv that a step may leave out. It is of
 * second order in the step, like the method; the bound matters for large steps only. */
#define REMAINDER 1e-3

static int stays(gm_real low, gm_real high, gm_real from, gm_real to)
{
    if (from < low) {
        return to < low;
    }
    return from >= high ? to >= high : to >= low && to < high;
}

static int cell2_holds(const gm_cell2 *c, gm_real x, gm_real y, gm_real x_to,
                       gm_real y_to)
{
    if (!stays(c->x_low, c->x_high, x, x_to) || !stays(c->y_low, c->y_high, y, y_to)) {
        return 0;
    }
    const gm_real rest = gm_abs(c->cxy * (x_to - x) * (y_to - y));
    return rest <=
           REMAINDER * gm_abs(c->c0 + c->cx * (x_to - c->x_low) +
                              (c->cy + c->cxy * (x_to - c->x_low)) * (y_to - c->y_low));
}

static int on_ramp(gm_real x)
{
    return (x >= GM_LINE_WIDTH) - (x <= -GM_LINE_WIDTH);
}

static int lines_hold(const gm_drive *d, int p, int sign_o, const gm_point *at,
                      const gm_point *to)
{
    const gm_path *path = &d->map->path[p];
    const gm_real m_o = at->m[GM_OUT], to_o = to->m[GM_OUT];
    for (int i = 0; i < path->n_lines; i++) {
        const gm_real r = path->lines[i].ratio;
        const gm_cell1 *c = &d->cache->line[p][i < GM_CACHED_LINES ? i : 0];
        if (on_ramp(at->m[p] - r * m_o) != on_ramp(to->m[p] - r * to_o) ||
            on_ramp(r * m_o) != on_ramp(r * to_o) ||
            !stays(c->x_low, c->x_high, gm_not_below_zero(sign_o * m_o),
                   gm_not_below_zero(sign_o * to_o))) {
            return 0;
        }
    }
    return 1;
}

static int drag_holds(const gm_drive *d, const gm_solution *s, int p, const gm_point *at,
                      const gm_point *to)
{
    const int sign_n = s->sign[p], sign_o = s->sign[GM_OUT];
    const int i = gm_direction(sign_n), j = gm_direction(sign_o);
    const gm_real x = gm_not_below_zero(sign_n * at->m[p]);
    const gm_real y = gm_not_below_zero(sign_o * at->m[GM_OUT]);
    const gm_real x_to = gm_not_below_zero(sign_n * to->m[p]);
    const gm_real y_to = gm_not_below_zero(sign_o * to->m[GM_OUT]);
    return cell2_holds(&d->cache->drag[p][i][j], x, y, x_to, y_to) &&
           cell2_holds(&d->cache->reaction[p][i][j], x, y, x_to, y_to) &&
           lines_hold(d, p, sign_o, at, to);
}

static int same_cell(const gm_axis *axis, gm_real from, gm_real to)
{
    return gm_axis_find(axis, from) == gm_axis_find(axis, to);
}

static int both_loaded_holds(const gm_drive *d, int sign_o, const gm_point *at,
                             const gm_point *to)
{
    const gm_table3 *table = &d->configuration->both_loaded[gm_direction(sign_o)];
    if (!d->engaged[0] || !d->engaged[1] || table->value == NULL) {
        return 1;
    }
    const int s0 = d->ratio[0] < 0 ? -sign_o : sign_o,
              s1 = d->ratio[1] < 0 ? -sign_o : sign_o;
    return same_cell(&table->x, sign_o * at->m[GM_OUT], sign_o * to->m[GM_OUT]) &&
           same_cell(&table->y, s0 * at->tau_m[0], s0 * to->tau_m[0]) &&
           same_cell(&table->z, s1 * at->tau_m[1], s1 * to->tau_m[1]);
}

static int output_holds(const gm_drive *d, int sign_o, const gm_point *at,
                        const gm_point *to)
{
    const gm_cell1 *c = &d->cache->parasitic[gm_direction(sign_o)];
    if (!stays(c->x_low, c->x_high, gm_not_below_zero(sign_o * at->m[GM_OUT]),
               gm_not_below_zero(sign_o * to->m[GM_OUT])) ||
        !both_loaded_holds(d, sign_o, at, to)) {
        return 0;
    }
    for (int p = 0; p < d->n_paths; p++) {
        const int sign = d->ratio[p] < 0 ? -sign_o : sign_o;
        if (d->engaged[p] &&
            !cell2_holds(&d->cache->load_loss[p][gm_direction(sign)],
                         gm_not_below_zero(sign * at->m[p]), sign * at->tau_m[p],
                         gm_not_below_zero(sign * to->m[p]), sign * to->tau_m[p])) {
            return 0;
        }
    }
    return 1;
}

int gm_terms_hold(const gm_drive *d, const gm_solution *s, const gm_point *at,
                  const gm_point *to)
{
    const gm_cell1 *c = &d->cache->coupling;
    if (d->coupled &&
        !stays(c->x_low, c->x_high, at->m[0] - at->m[1], to->m[0] - to->m[1])) {
        return 0;
    }
    if (!s->held[GM_OUT] && !output_holds(d, s->sign[GM_OUT], at, to)) {
        return 0;
    }
    for (int p = 0; p < d->n_paths; p++) {
        if (d->free[p] && !drag_holds(d, s, p, at, to)) {
            return 0;
        }
    }
    return 1;
}
