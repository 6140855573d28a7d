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
 * zero, as a constant.
 */
#include "reduced_parts.h"
#include "cell.h"

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
    const gm_value1 c = gm_cell1_at(&d->map->coupling, 1, &d->cache->coupling, slip);
    t->coupling = d->scale * c.value;
    t->coupling_w = d->scale * c.dx;
    t->coupling_a = t->coupling_w * s->lead;
    t->outside |= c.outside;
    return t->coupling;
}

static void load_terms(const gm_drive *d, int p, gm_real sign_o, const gm_point *at,
                       gm_terms *t)
{
    const gm_gear *gear = d->gear[p];
    const gm_real sigma = gear->ratio < 0 ? -sign_o : sign_o;
    const int dir = gm_direction(sigma);
    const gm_real speed = sigma * gear->ratio * at->m[GM_OUT];
    const gm_value2 v = gm_cell2_at(
        &gear->load_loss[dir], 1 + (int)(gear - d->map->path[p].gears),
        &d->cache->load_loss[p][dir], gm_not_below_zero(speed), sigma * at->tau_m[p]);
    gm_path_terms *path = &t->path[p];
    path->load = d->scale * sigma * v.value;
    path->load_o = speed < 0 ? 0 : d->scale * v.dx * gear->ratio;
    path->load_tau = d->scale * v.dy;
    t->outside |= v.outside;
}

/* X acts only while both paths are engaged. */
static void add_both_loaded(const gm_drive *d, gm_real sigma, const gm_point *at,
                            gm_terms *t)
{
    const gm_table3 *table = &d->configuration->both_loaded[gm_direction(sigma)];
    const gm_real scale = d->scale;
    if (table->value == NULL) {
        return;
    }
    const gm_real s0 = d->ratio[0] < 0 ? -sigma : sigma,
                  s1 = d->ratio[1] < 0 ? -sigma : sigma;
    const gm_value3 v = gm_cell3_at(
        table, d->index + 1, &d->cache->both_loaded[gm_direction(sigma)],
        gm_not_below_zero(sigma * at->m[GM_OUT]), s0 * at->tau_m[0], s1 * at->tau_m[1]);
    t->out += scale * sigma * v.value;
    t->out_o += sigma * at->m[GM_OUT] < 0 ? 0 : scale * v.dx;
    t->out_tau[0] = scale * sigma * v.dy * s0;
    t->out_tau[1] = scale * sigma * v.dz * s1;
    t->outside |= v.outside;
}

void gm_output_terms(const gm_drive *d, gm_real sigma, const gm_point *at, gm_terms *t)
{
    const int dir = gm_direction(sigma);
    const gm_value1 v =
        gm_cell1_at(&d->configuration->parasitic[dir], d->index + 1,
                    &d->cache->parasitic[dir], gm_not_below_zero(sigma * at->m[GM_OUT]));
    t->out = d->scale * sigma * v.value;
    t->out_o = sigma * at->m[GM_OUT] < 0 ? 0 : d->scale * v.dx;
    t->outside |= v.outside;
    for (int p = 0; p < d->n_paths; p++) {
        if (d->engaged[p]) {
            load_terms(d, p, sigma, at, t);
        }
        if (d->elastic[p]) {
            const gm_real r = sigma * gm_abs(d->ratio[p]);
            t->out -= r * t->path[p].pin;
            t->out_o -= r * t->path[p].pin_o;
        }
    }
    if (d->engaged[0] && d->engaged[1]) {
        add_both_loaded(d, sigma, at, t);
    }
}

/* Pin of elastic path p where it turns in direction sign (of the path), as a torque in
 * that direction; d/dw_o in dx. */
static gm_value1 pin_at(const gm_drive *d, int p, gm_real sign, const gm_point *at)
{
    static const gm_value1 none = {0, 0, 0};
    const gm_gear *gear = d->gear[p];
    const int dir = gm_direction(sign);
    const gm_real speed = sign * gear->ratio * at->m[GM_OUT];
    if (gear->pin[dir].value == NULL) {
        return none;
    }
    gm_value1 v = gm_cell1_at(&gear->pin[dir], 1 + (int)(gear - d->map->path[p].gears),
                              &d->cache->pin[p][dir], gm_not_below_zero(speed));
    v.value *= d->scale;
    v.dx = speed < 0 ? 0 : d->scale * v.dx * sign * gear->ratio;
    return v;
}

void gm_pin_terms(const gm_drive *d, const gm_solution *s, int p, gm_real sign_o,
                  gm_point *at, gm_terms *t)
{
    const gm_real sigma = d->ratio[p] < 0 ? -sign_o : sign_o;
    gm_path_terms *path = &t->path[p];
    gm_value1 v = pin_at(d, p, s->sign[p], at);
    if (s->held[p]) {
        at->tau_m[p] = d->tau[p] + (p == 0 ? -t->coupling : t->coupling);
    } else {
        path->drag = s->sign[p] * v.value;
        path->drag_o = s->sign[p] * v.dx;
        at->tau_m[p] = at->spring[p] + path->drag;
    }
    t->outside |= v.outside;
    if (sigma * s->sign[p] < 0) {
        v = pin_at(d, p, sigma, at);
        t->outside |= v.outside;
    }
    path->pin = v.value;
    path->pin_o = v.dx;
}

void gm_pin_friction(const gm_drive *d, int p, gm_real sign, const gm_point *at,
                     gm_terms *t)
{
    const gm_value1 v = pin_at(d, p, sign, at);
    t->path[p].drag = sign * v.value;
}

void gm_terms_at(const gm_drive *d, gm_solution *s, gm_point *at)
{
    static const gm_terms none = {0};
    gm_terms *t = &s->terms;
    *t = none;
    const gm_real c = d->coupled ? coupling_at(d, s, at, t) : 0;
    for (int p = 0; p < d->n_paths; p++) {
        const gm_real tau = d->tau[p] + (p == 0 ? -c : c);
        at->tau_m[p] = tau - d->inertia[p] * d->ratio[p] * at->a[GM_OUT];
        if (d->elastic[p]) {
            gm_pin_terms(d, s, p, s->sign[GM_OUT], at, t);
        }
        if (d->free[p] && !s->held[p]) {
            gm_drag_terms(d, p, s->sign[p], s->sign[GM_OUT], at, t);
        }
    }
    if (!s->held[GM_OUT]) {
        gm_output_terms(d, s->sign[GM_OUT], at, t);
    }
}

/* ---- do they hold at another point? ----
 *
 * Speeds beyond rest are compared as they are: there the terms are constants, not the
 * first cell. */

/* Of the remainder the part of the two torques is the largest by far: each changes with
 * the acceleration, the speed only with half a step of it. It does not fall with the step
 * (the first guess of the acceleration may be wrong at any), so next to nothing of it may
 * be left out. */
static int both_loaded_holds(const gm_drive *d, const gm_solution *s, const gm_point *at,
                             const gm_point *to)
{
    const gm_real sigma = s->sign[GM_OUT];
    const int dir = gm_direction(sigma);
    const gm_cell3 *c = &d->cache->both_loaded[dir];
    if (!d->engaged[0] || !d->engaged[1] ||
        d->configuration->both_loaded[dir].value == NULL) {
        return 1;
    }
    const gm_real s0 = d->ratio[0] < 0 ? -sigma : sigma;
    const gm_real s1 = d->ratio[1] < 0 ? -sigma : sigma;
    return gm_stays(c->x_low, c->x_high, sigma * at->m[GM_OUT], sigma * to->m[GM_OUT]) &&
           gm_stays(c->y_low, c->y_high, s0 * at->tau_m[0], s0 * to->tau_m[0]) &&
           gm_stays(c->z_low, c->z_high, s1 * at->tau_m[1], s1 * to->tau_m[1]) &&
           gm_abs(c->c[0][1][1] * (to->tau_m[0] - at->tau_m[0]) *
                  (to->tau_m[1] - at->tau_m[1])) <= GM_REMAINDER_NM;
}

static int output_holds(const gm_drive *d, const gm_solution *s, const gm_point *at,
                        const gm_point *to)
{
    const gm_real sign_o = s->sign[GM_OUT];
    const gm_cell1 *c = &d->cache->parasitic[gm_direction(sign_o)];
    if (!gm_cell1_holds(c, sign_o * at->m[GM_OUT], sign_o * to->m[GM_OUT],
                        s->terms.out) ||
        !both_loaded_holds(d, s, at, to)) {
        return 0;
    }
    for (int p = 0; p < d->n_paths; p++) {
        const gm_real sign = d->ratio[p] < 0 ? -sign_o : sign_o;
        const gm_real r = sign * d->ratio[p];
        if (d->engaged[p] &&
            !gm_cell2_holds(&d->cache->load_loss[p][gm_direction(sign)],
                            r * at->m[GM_OUT], sign * at->tau_m[p], r * to->m[GM_OUT],
                            sign * to->tau_m[p], s->terms.path[p].load)) {
            return 0;
        }
    }
    return 1;
}

/* As the others, and the moment at which C is read must fit its slope; it only ever
 * moves towards the end of the step, so that the passes settle. */
static int coupling_holds(const gm_drive *d, gm_solution *s, const gm_point *at,
                          const gm_point *to)
{
    const gm_cell1 *c = &d->cache->coupling;
    const gm_real slip = d->w[0] - d->w[1];
    const gm_real lead = coupling_lead(d, s->terms.coupling_w);
    if (lead > s->lead) {
        s->lead = lead;
        return 0;
    }
    return gm_cell1_holds(c, slip + s->lead * gm_parting(d, at),
                          slip + s->lead * gm_parting(d, to), s->terms.coupling);
}

/* Speeds beyond rest are not told apart from those below the first node. */
static int pin_holds(const gm_drive *d, gm_real sign, int p, const gm_point *at,
                     const gm_point *to, gm_real value)
{
    const int dir = gm_direction(sign);
    const gm_cell1 *c = &d->cache->pin[p][dir];
    const gm_real r = sign * d->ratio[p];
    return d->gear[p]->pin[dir].value == NULL ||
           gm_cell1_holds(c, r * at->m[GM_OUT], r * to->m[GM_OUT], value);
}

static int pins_hold(const gm_drive *d, const gm_solution *s, int p, const gm_point *at,
                     const gm_point *to)
{
    const gm_real sigma = d->ratio[p] < 0 ? -s->sign[GM_OUT] : s->sign[GM_OUT];
    return pin_holds(d, s->sign[p], p, at, to, s->terms.path[p].pin) &&
           (sigma * s->sign[p] > 0 || s->held[GM_OUT] ||
            pin_holds(d, sigma, p, at, to, s->terms.path[p].pin));
}

int gm_terms_hold(const gm_drive *d, gm_solution *s, const gm_point *at,
                  const gm_point *to)
{
    if (d->coupled && !coupling_holds(d, s, at, to)) {
        return 0;
    }
    if (!s->held[GM_OUT] && !output_holds(d, s, at, to)) {
        return 0;
    }
    for (int p = 0; p < d->n_paths; p++) {
        if (d->elastic[p] && !pins_hold(d, s, p, at, to)) {
            return 0;
        }
        if (d->free[p] && !s->held[p] && !gm_drag_holds(d, s, p, at, to)) {
            return 0;
        }
    }
    return 1;
}
