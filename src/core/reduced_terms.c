/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Loss torques of the reduced gearset from its tables, with gradients, at one point of
 * mid-step speeds and transmitted torques.
 *
 *   output          sigma [P(|w_o|) + X(|w_o|, sigma_0 tau_m,0, sigma_1 tau_m,1)]
 *   engaged path    sigma_p D(|r_p w_o|, sigma_p tau_m,p)      sigma_p = sgn(r_p) sigma
 *   elastic path    sgn(w_p) pin(|r_p w_o|) at its flange, |r_p| pin less at the output;
 *                   tau_m is the spring's torque and what brakes the path
 *   coupling        C(w_0 - w_1), unless both paths are engaged (then it is inside P)
 *
 * The drag of free paths is in reduced_drag.c. Sources: the equations in gm_reduced.h.
 * Speeds enter the tables as magnitudes; an iterate that overshoots standstill is read at
 * zero, as a constant. What was read is linear over a range; a solution within the ranges
 * of all tables is final.
 */
#include "reduced_parts.h"

#include <stddef.h>

/* ---- values ---- */

/* theta h for a coupling of this slope. z = h slope (1/J_0 + 1/J_1), with J_s/r^2 for an
 * engaged path, is the step in time constants of the slip. Up to 2 the middle of the step
 * is right. Beyond, the midpoint rule would answer with a slip that changes sign on every
 * step; theta = 1 - 1/z takes it to rest at once. */
static gm_real coupling_lead(const gm_drive *d, gm_real slope)
{
    const gm_real j_0 = d->inertia[d->own[0] ? 0 : GM_OUT];
    const gm_real j_1 = d->inertia[d->own[1] ? 1 : GM_OUT];
    const gm_real g_0 = d->own[0] ? 1 : d->ratio[0] * d->ratio[0];
    const gm_real g_1 = d->own[1] ? 1 : d->ratio[1] * d->ratio[1];
    const gm_real above = d->h * slope * (g_0 * j_1 + g_1 * j_0), below = j_0 * j_1;
    return above <= 2 * below ? d->h / 2 : d->h - d->h * below / above;
}

static gm_real coupling_at(const gm_drive *d, const gm_solution *s, const gm_point *at,
                           gm_terms *t)
{
    const gm_real slip = d->w[0] - d->w[1] + s->lead * gm_parting(d, at);
    const gm_strip *c = gm_strip_at(&d->map->coupling, &d->cache->oil.slices, 1,
                                    &d->cache->coupling, slip);
    t->coupling = d->scale * gm_on_strip(c, slip);
    t->coupling_w = d->scale * c->cx;
    t->coupling_a = t->coupling_w * s->lead;
    t->outside |= c->outside;
    return t->coupling;
}

/* Number of a gear and a direction; drags have the numbers below. */
enum { GM_LOAD_KEYS = 8 };

static int gear_key(const gm_drive *d, int p, int dir)
{
    return GM_LOAD_KEYS + 2 * d->gear_index[p] + dir;
}

static void load_terms(const gm_drive *d, int p, gm_real sign_o, const gm_point *at,
                       gm_terms *t)
{
    const gm_real r = d->ratio[p], sigma = r < 0 ? -sign_o : sign_o;
    const int dir = gm_direction(sigma), key = gear_key(d, p, dir);
    const gm_table2 *table = &d->gear[p]->load_loss[dir];
    const gm_real speed = sigma * r * at->m[GM_OUT], x = gm_not_below_zero(speed);
    const gm_real y = sigma * at->tau_m[p];
    gm_patch *c = &d->cache->path[p];
    if (c->key != key || !gm_in_patch(c, x, y) || (GM_CURVED && table->monotone)) {
        gm_fill_patch(table, &d->cache->oil.slices, key, gm_curved_cell(d->cache, p, 0),
                      x, y, c);
    }
    const gm_real u = x - c->x_low, v = y - c->y_low, dx = c->a.cx + c->a.cxy * v;
    gm_path_terms *path = &t->path[p];
    path->load = d->scale * sigma * (c->a.c + c->a.cy * v + dx * u);
    path->load_o = speed < 0 ? 0 : d->scale * dx * r;
    path->load_tau = d->scale * sigma * sigma * (c->a.cy + c->a.cxy * u);
    t->outside |= c->outside;
}

/* X acts only while both paths are engaged. */
static void add_both_loaded(const gm_drive *d, gm_real sigma, const gm_point *at,
                            gm_terms *t)
{
    const int dir = gm_direction(sigma), key = 1 + 2 * d->index + dir;
    const gm_table3 *table = &d->configuration->both_loaded[dir];
    const gm_real scale = d->scale, speed = sigma * at->m[GM_OUT];
    const gm_real s0 = d->ratio[0] < 0 ? -sigma : sigma;
    const gm_real s1 = d->ratio[1] < 0 ? -sigma : sigma;
    const gm_real q[3] = {gm_not_below_zero(speed), s0 * at->tau_m[0], s1 * at->tau_m[1]};
    gm_block *b = &d->cache->both_loaded;
    if (table->value == NULL) {
        return;
    }
    if (b->key != key || !gm_in_block(b, q)) {
        gm_fill_block(table, &d->cache->oil.slices, key, q, b);
    }
    const gm_real u = q[0] - b->low[0], v = q[1] - b->low[1], w = q[2] - b->low[2];
    const gm_real(*c)[2][2] = (const gm_real(*)[2][2])b->c;
    const gm_real far_v = c[1][1][0] + c[1][1][1] * w;
    const gm_real dx = c[1][0][0] + c[1][0][1] * w + far_v * v;
    const gm_real dy = c[0][1][0] + c[0][1][1] * w + far_v * u;
    const gm_real dz = c[0][0][1] + c[0][1][1] * v + (c[1][0][1] + c[1][1][1] * v) * u;
    const gm_real value =
        c[0][0][0] + c[0][0][1] * w + (c[0][1][0] + c[0][1][1] * w) * v + dx * u;
    t->out += scale * sigma * value;
    t->out_o += speed < 0 ? 0 : scale * dx;
    t->out_tau[0] = scale * sigma * dy * s0;
    t->out_tau[1] = scale * sigma * dz * s1;
    t->outside |= b->outside;
}

static void take_off_pin(const gm_drive *d, gm_real sigma, int p, gm_terms *t)
{
    const gm_real r = sigma * gm_abs(d->ratio[p]);
    t->out -= r * t->path[p].pin;
    t->out_o -= r * t->path[p].pin_o;
}

void gm_output_terms(const gm_drive *d, gm_real sigma, const gm_point *at, gm_terms *t)
{
    const int dir = gm_direction(sigma);
    const gm_real speed = sigma * at->m[GM_OUT], x = gm_not_below_zero(speed);
    const gm_strip *c =
        gm_strip_at(&d->configuration->parasitic[dir], &d->cache->oil.slices,
                    1 + 2 * d->index + dir, &d->cache->parasitic, x);
    t->out = d->scale * sigma * gm_on_strip(c, x);
    t->out_o = speed < 0 ? 0 : d->scale * c->cx;
    t->outside |= c->outside;
    for (int p = 0; p < d->n_paths; p++) {
        if (d->engaged[p]) {
            load_terms(d, p, sigma, at, t);
        }
        if (d->elastic[p]) {
            take_off_pin(d, sigma, p, t);
        }
    }
    if (d->engaged[0] && d->engaged[1]) {
        add_both_loaded(d, sigma, at, t);
    }
}

void gm_output_terms_at_rest(const gm_drive *d, gm_real sign, const gm_point *at,
                             gm_terms *t)
{
    const int dir = gm_direction(sign);
    const gm_table3 *both = &d->configuration->both_loaded[dir];
    const gm_slices *of = &d->cache->oil.slices;
    gm_real sum = gm_value1_at_rest(&d->configuration->parasitic[dir], of);
    gm_real s[GM_MAX_PATHS] = {0, 0};
    for (int p = 0; p < d->n_paths; p++) {
        s[p] = d->ratio[p] < 0 ? -sign : sign;
        if (d->engaged[p]) {
            const gm_table2 *load = &d->gear[p]->load_loss[gm_direction(s[p])];
            t->path[p].load =
                d->scale * s[p] * gm_value_at_rest(load, of, s[p] * at->tau_m[p]);
        }
    }
    if (d->engaged[0] && d->engaged[1] && both->value != NULL) {
        sum += gm_value3_at_rest(both, of, s[0] * at->tau_m[0], s[1] * at->tau_m[1]);
    }
    t->out = d->scale * sign * sum;
    for (int p = 0; p < d->n_paths; p++) {
        if (d->elastic[p]) {
            take_off_pin(d, sign, p, t);
        }
    }
}

/* Pin of elastic path p where it turns in direction sign (of the path), as a torque in
 * that direction; d/dw_o in *slope. */
static gm_real pin_at(const gm_drive *d, int p, gm_real sign, const gm_point *at,
                      gm_real *slope, gm_terms *t)
{
    const int dir = gm_direction(sign);
    const gm_table1 *table = &d->gear[p]->pin[dir];
    const gm_real r = sign * d->ratio[p], speed = r * at->m[GM_OUT];
    const gm_real x = gm_not_below_zero(speed);
    *slope = 0;
    if (table->value == NULL) {
        return 0;
    }
    const gm_strip *c = gm_strip_at(table, &d->cache->oil.slices, gear_key(d, p, dir),
                                    &d->cache->pin[p], x);
    *slope = speed < 0 ? 0 : d->scale * c->cx * r;
    t->outside |= c->outside;
    return d->scale * gm_on_strip(c, x);
}

void gm_pin_terms(const gm_drive *d, const gm_solution *s, int p, gm_real sign_o,
                  gm_point *at, gm_terms *t)
{
    const gm_real sigma = d->ratio[p] < 0 ? -sign_o : sign_o;
    gm_path_terms *path = &t->path[p];
    gm_real slope, pin = pin_at(d, p, s->sign[p], at, &slope, t);
    if (s->held[p]) {
        at->tau_m[p] = d->tau[p] + (p == 0 ? -t->coupling : t->coupling);
    } else {
        path->drag = s->sign[p] * pin;
        path->drag_o = s->sign[p] * slope;
        at->tau_m[p] = at->spring[p] + path->drag;
    }
    if (sigma * s->sign[p] < 0) {
        pin = pin_at(d, p, sigma, at, &slope, t);
    }
    path->pin = pin;
    path->pin_o = slope;
}

void gm_pin_friction(const gm_drive *d, int p, gm_real sign, const gm_point *at,
                     gm_terms *t)
{
    gm_real unused;
    t->path[p].drag = sign * pin_at(d, p, sign, at, &unused, t);
}

void gm_clear_terms(gm_terms *t)
{
    static const gm_terms none = {0};
    *t = none;
}

/* All but what acts on the output. */
static void path_terms(const gm_drive *d, const gm_solution *s, gm_point *at, gm_terms *t)
{
    gm_clear_terms(t);
    t->outside = gm_has_oil_axis(d->map) && !d->cache->oil.inside;
    const gm_real c = d->coupled ? coupling_at(d, s, at, t) : 0;
    for (int p = 0; p < d->n_paths; p++) {
        const gm_real tau = d->tau[p] + (p == 0 ? -c : c);
        at->tau_m[p] = tau - d->inertia[p] * d->ratio[p] * at->a[GM_OUT];
        if (d->elastic[p]) {
            gm_pin_terms(d, s, p, s->sign[GM_OUT], at, t);
        }
        if (d->free[p] && !s->held[p] && s->sign[p] != 0) {
            gm_drag_terms(d, p, s->sign[p], s->sign[GM_OUT], at, t);
        }
    }
}

void gm_terms_at(const gm_drive *d, gm_solution *s, gm_point *at)
{
    path_terms(d, s, at, &s->terms);
    if (!s->held[GM_OUT]) {
        gm_output_terms(d, s->sign[GM_OUT], at, &s->terms);
    }
}

void gm_terms_by_oil(const gm_drive *d, const gm_solution *s, gm_terms *t)
{
    static const gm_reduced_cache empty = {0};
    gm_reduced_cache slope = empty;
    gm_drive by = *d;
    gm_point at = s->point; /* whose torques path_terms would make anew */
    gm_clear_terms(t);
    slope.oil.slices = gm_oil_slope(&d->map->oil, &d->cache->oil);
    if (slope.oil.slices.share == 0) {
        return; /* beyond the axis */
    }
    by.cache = &slope;
    path_terms(&by, s, &at, t);
    if (!s->held[GM_OUT]) {
        gm_output_terms(&by, s->sign[GM_OUT], &s->point, t);
    }
}

/* ---- do they hold at another point? ---- */

/* The moment at which C is read must fit its slope as well; it only ever moves towards
 * the end of the step, so that the passes settle. */
static int coupling_holds(const gm_drive *d, gm_solution *s, const gm_point *to)
{
    const gm_real lead = coupling_lead(d, s->terms.coupling_w);
    if (lead > s->lead) {
        s->lead = lead;
        return 0;
    }
    return gm_in_strip(&d->cache->coupling, d->w[0] - d->w[1] + lead * gm_parting(d, to));
}

/* x: speed of the output in its direction. The pin of the other direction is read where
 * the output has just left rest only, and constant then. */
static int load_holds(const gm_drive *d, const gm_solution *s, int p, gm_real x,
                      const gm_point *at, const gm_point *to)
{
    const gm_patch *c = &d->cache->path[p];
    const gm_real sigma = d->ratio[p] < 0 ? -s->sign[GM_OUT] : s->sign[GM_OUT];
    const gm_real r = gm_abs(d->ratio[p]), w = r * x, tau = sigma * to->tau_m[p];
    const gm_real dx = r * (to->m[GM_OUT] - at->m[GM_OUT]);
    return gm_in_patch(c, w, tau) &&
           gm_is_small(c->a.cxy * dx * (to->tau_m[p] - at->tau_m[p]),
                       s->terms.path[p].load) &&
           (!d->elastic[p] || d->gear[p]->pin[0].value == NULL ||
            gm_in_strip(&d->cache->pin[p], w));
}

/* Of the remainder the part of the two torques is the largest by far: each changes with
 * the acceleration, the speed only with half a step of it. At an instant it is left to
 * nothing. */
static int both_loaded_holds(const gm_drive *d, const gm_solution *s, gm_real x,
                             const gm_point *at, const gm_point *to)
{
    const gm_real sigma = s->sign[GM_OUT];
    const gm_block *b = &d->cache->both_loaded;
    const gm_real rest =
        b->c[0][1][1] * (to->tau_m[0] - at->tau_m[0]) * (to->tau_m[1] - at->tau_m[1]);
    const gm_real q[3] = {x,
                          d->ratio[0] < 0 ? -sigma * to->tau_m[0] : sigma * to->tau_m[0],
                          d->ratio[1] < 0 ? -sigma * to->tau_m[1] : sigma * to->tau_m[1]};
    return d->configuration->both_loaded[gm_direction(sigma)].value == NULL ||
           (gm_in_block(b, q) && gm_is_small(rest, d->h > 0 ? s->terms.out : 0));
}

static int output_holds(const gm_drive *d, const gm_solution *s, const gm_point *at,
                        const gm_point *to)
{
    const gm_real from = s->sign[GM_OUT] * at->m[GM_OUT];
    const gm_real speed = s->sign[GM_OUT] * to->m[GM_OUT], x = gm_not_below_zero(speed);
    if ((from < 0) != (speed < 0) || !gm_in_strip(&d->cache->parasitic, x) ||
        (d->engaged[0] && d->engaged[1] && !both_loaded_holds(d, s, x, at, to))) {
        return 0;
    }
    for (int p = 0; p < d->n_paths; p++) {
        if (d->engaged[p] && !load_holds(d, s, p, x, at, to)) {
            return 0;
        }
    }
    return 1;
}

int gm_terms_hold(const gm_drive *d, gm_solution *s, const gm_point *at,
                  const gm_point *to)
{
    if ((d->coupled && !coupling_holds(d, s, to)) ||
        (!s->held[GM_OUT] && !output_holds(d, s, at, to))) {
        return 0;
    }
    for (int p = 0; p < d->n_paths; p++) {
        if (d->free[p] && !s->held[p] && s->sign[p] != 0 &&
            !gm_drag_holds(d, s, p, at, to)) {
            return 0;
        }
    }
    return 1;
}
