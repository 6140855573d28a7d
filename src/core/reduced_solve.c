/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Motion of the reduced gearset over one sub-step, implicit midpoint.
 *
 * Unknown are the acceleration a of the output and b_n of each free path. The balance
 *
 *   F_o = J_s a - tau_o - sum_E r (g_p - sigma_p D_p) - sum_sync r T_c + sum_N R
 *         + sigma (P + X)
 *   F_n = J_n b - g_n + N_n + T_c,n            g_0 = tau_0 - C,  g_1 = tau_1 + C
 *
 * holds at the mean speeds m = w + h/2 dw/dt. Inside the cells of all tables the terms
 * are linear but for small bilinear remainders, so one Newton pass solves it; when a
 * table leaves its cell the next pass starts there. Every pass yields torques that fulfil
 * the linearised balance to rounding, and these torques are what the account of losses
 * uses: it closes whether or not the passes have converged. The passes are bounded by
 * GM_PASSES; brackets on every unknown turn cycles between cells into bisection. Only the
 * coupling C may be read later than at the middle of the step, when it is stiff.
 *
 * Friction at rest: a shaft at standstill is held unless the torque on it exceeds one of
 * the two one-sided limits; then it is let go in that direction. Each shaft can be let go
 * once and be held again once, so the search is bounded by GM_ROUNDS.
 *
 * Gradients that would take the system matrix near singularity (a map that is not
 * monotone, with a long step) are dropped: the terms are then explicit, the account stays
 * exact.
 */
#include "reduced_parts.h"

enum { GM_PASSES = 60, GM_FREE_PASSES = 3, GM_ROUNDS = 2 * GM_SHAFTS + 1 };

#define GM_FAR 1e300 /* bracket that excludes nothing */

/* A pivot below this part of the inertia means that falling gradients or dD/dtau near 1
 * leave no unique solution. */
#define PIVOT_LIMIT 0.1

/* One row of the linear system for the changes of the accelerations. */
typedef struct row {
    gm_real k[GM_SHAFTS], right;
    gm_real least; /* smallest pivot that is accepted */
} row;

/* ---- the linear system ---- */

static gm_real output_balance(const gm_drive *d, const gm_terms *t, const gm_point *at)
{
    gm_real sum = d->tau[GM_OUT] - t->out - d->inertia[GM_OUT] * at->a[GM_OUT];
    for (int p = 0; p < d->n_paths; p++) {
        const gm_real c = p == 0 ? -t->coupling : t->coupling;
        if (d->engaged[p]) {
            sum += d->ratio[p] * (d->tau[p] + c - t->path[p].load);
        } else {
            sum += d->ratio[p] * d->cone[p] - t->path[p].reaction;
        }
    }
    return sum;
}

static gm_real path_balance(const gm_drive *d, const gm_terms *t, const gm_point *at,
                            int p)
{
    const gm_real c = p == 0 ? -t->coupling : t->coupling;
    return d->tau[p] + c - t->path[p].drag - d->cone[p] - d->inertia[p] * at->a[p];
}

/* Part of a torque at flange p that reaches the output: r (1 - dD/dtau) - dX/dtau. */
static gm_real passed_on(const gm_drive *d, const gm_terms *t, int p)
{
    return d->ratio[p] * (1 - t->path[p].load_tau) - t->out_tau[p];
}

static row output_row(const gm_drive *d, const gm_terms *t, const gm_point *at)
{
    const gm_real half = d->h / 2;
    gm_real slope = t->out_o, inertia = d->map->inertia_output;
    row line = {{0, 0, 0}, output_balance(d, t, at), PIVOT_LIMIT * d->inertia[GM_OUT]};
    for (int p = 0; p < d->n_paths; p++) {
        const gm_path_terms *path = &t->path[p];
        const gm_real r = d->ratio[p];
        if (d->engaged[p]) {
            const gm_real q = passed_on(d, t, p);
            inertia += d->inertia[p] * r * q;
            slope += r * path->load_o;
            inertia += r * q * t->coupling_a;
            line.k[1 - p] -= q * t->coupling_a;
        } else {
            slope += path->reaction_o;
            line.k[p] += half * path->reaction_n;
        }
    }
    line.k[GM_OUT] = inertia + half * slope;
    return line;
}

static row path_row(const gm_drive *d, const gm_terms *t, const gm_point *at, int p)
{
    const gm_real half = d->h / 2, c_a = t->coupling_a;
    const gm_path_terms *path = &t->path[p];
    const int other = 1 - p;
    row line = {{0, 0, 0}, path_balance(d, t, at, p), PIVOT_LIMIT * d->inertia[p]};
    line.k[p] = d->inertia[p] + half * path->drag_n + c_a;
    line.k[other] = -c_a;
    line.k[GM_OUT] =
        half * path->drag_o - (d->engaged[other] ? c_a * d->ratio[other] : 0);
    return line;
}

/* Elimination in fixed order; a shaft that does not move by itself has a row of the unit
 * matrix. 0 when a pivot is too small. */
static int eliminate(row r[GM_SHAFTS], gm_real change[GM_SHAFTS])
{
    row *a = &r[0], *b = &r[1], *o = &r[GM_OUT];
    const gm_real inverse_a = 1 / a->k[0], f_b = b->k[0] * inverse_a;
    const gm_real f_o = o->k[0] * inverse_a;
    b->k[1] -= f_b * a->k[1];
    b->k[2] -= f_b * a->k[2];
    b->right -= f_b * a->right;
    o->k[1] -= f_o * a->k[1];
    o->k[2] -= f_o * a->k[2];
    o->right -= f_o * a->right;
    const gm_real inverse_b = 1 / b->k[1], g_o = o->k[1] * inverse_b;
    o->k[2] -= g_o * b->k[2];
    o->right -= g_o * b->right;
    change[GM_OUT] = o->right / o->k[2];
    change[1] = (b->right - b->k[2] * change[GM_OUT]) * inverse_b;
    change[0] = (a->right - a->k[1] * change[1] - a->k[2] * change[GM_OUT]) * inverse_a;
    return a->k[0] > a->least && b->k[1] > b->least && o->k[2] > o->least;
}

static void drop_gradients(gm_terms *t)
{
    t->out_o = t->coupling_a = 0;
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        gm_path_terms *path = &t->path[p];
        t->out_tau[p] = path->load_o = path->load_tau = 0;
        path->drag_n = path->drag_o = path->reaction_n = path->reaction_o = 0;
    }
}

static void newton_change(const gm_drive *d, gm_solution *s, const gm_point *at,
                          gm_real change[GM_SHAFTS])
{
    for (int attempt = 0; attempt < 2; attempt++) {
        row rows[GM_SHAFTS] = {{{1, 0, 0}, 0, 0}, {{0, 1, 0}, 0, 0}, {{0, 0, 1}, 0, 0}};
        for (int p = 0; p < d->n_paths; p++) {
            if (d->free[p] && !s->held[p]) {
                rows[p] = path_row(d, &s->terms, at, p);
            }
        }
        if (!s->held[GM_OUT]) {
            rows[GM_OUT] = output_row(d, &s->terms, at);
        }
        if (eliminate(rows, change)) {
            return;
        }
        drop_gradients(&s->terms); /* leaves a diagonal of inertias */
    }
}

/* ---- the passes ---- */

static void set_speeds(const gm_drive *d, gm_point *at)
{
    const gm_real half = d->h / 2;
    at->m[GM_OUT] = d->w[GM_OUT] + half * at->a[GM_OUT];
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        at->m[p] =
            d->engaged[p] ? d->ratio[p] * at->m[GM_OUT] : d->w[p] + half * at->a[p];
    }
}

static void linearise(const gm_drive *d, gm_terms *t, const gm_point *from, gm_point *to)
{
    const gm_real d_o = to->m[GM_OUT] - from->m[GM_OUT];
    const gm_real d_a = to->a[GM_OUT] - from->a[GM_OUT];
    const gm_real d_c = t->coupling_a * (gm_parting(d, to) - gm_parting(d, from));
    t->coupling += d_c;
    t->out += t->out_o * d_o;
    for (int p = 0; p < d->n_paths; p++) {
        gm_path_terms *path = &t->path[p];
        if (d->engaged[p]) {
            const gm_real d_tau =
                (p == 0 ? -d_c : d_c) - d->inertia[p] * d->ratio[p] * d_a;
            to->tau_m[p] = from->tau_m[p] + d_tau;
            t->out += t->out_tau[p] * d_tau;
            path->load += path->load_o * d_o + path->load_tau * d_tau;
        } else {
            const gm_real d_n = to->m[p] - from->m[p];
            path->drag += path->drag_n * d_n + path->drag_o * d_o;
            path->reaction += path->reaction_n * d_n + path->reaction_o * d_o;
        }
    }
}

/* Where the next pass reads the tables: at the solution of the last one, or half way to
 * the last place on the other side once the passes go to and fro. */
static void next_place(int pass, const gm_point *at, gm_point *to, gm_real low[GM_SHAFTS],
                       gm_real high[GM_SHAFTS])
{
    for (int k = 0; k < GM_SHAFTS; k++) {
        const gm_real from = at->a[k];
        if (to->a[k] > from) {
            low[k] = from > low[k] ? from : low[k];
        } else if (to->a[k] < from) {
            high[k] = from < high[k] ? from : high[k];
        }
        if (pass >= GM_FREE_PASSES && low[k] < high[k] &&
            (to->a[k] <= low[k] || to->a[k] >= high[k])) {
            const gm_real middle = low[k] / 2 + high[k] / 2;
            to->a[k] = low[k] > -GM_FAR && high[k] < GM_FAR ? middle : to->a[k];
        }
    }
}

/* Torque on the output before losses. */
static gm_real driving_torque(const gm_drive *d)
{
    gm_real sum = d->tau[GM_OUT];
    for (int p = 0; p < d->n_paths; p++) {
        sum += d->ratio[p] * (d->engaged[p] ? d->tau[p] : d->cone[p]);
    }
    return sum;
}

gm_real gm_brake(const gm_drive *d, const gm_solution *s)
{
    return driving_torque(d) - d->inertia[GM_OUT] * s->point.a[GM_OUT];
}

/* First place: the output under its flange torques with the losses of the last step, free
 * paths at their present speed. */
static void first_place(const gm_drive *d, const gm_solution *s, gm_point *at)
{
    at->a[0] = at->a[1] = 0;
    at->a[GM_OUT] =
        s->held[GM_OUT] ? 0 : (driving_torque(d) - d->brake) / d->inertia[GM_OUT];
    set_speeds(d, at);
}

static void one_pass(const gm_drive *d, gm_solution *s, gm_point *at)
{
    gm_real change[GM_SHAFTS];
    gm_terms_at(d, s, at);
    newton_change(d, s, at, change);
    for (int k = 0; k < GM_SHAFTS; k++) {
        s->point.a[k] = at->a[k] + change[k];
    }
    set_speeds(d, &s->point);
    linearise(d, &s->terms, at, &s->point);
}

/* Another problem than the pass before solved (s->lead has moved): nothing is excluded.
 */
static void reset_brackets(gm_real low[GM_SHAFTS], gm_real high[GM_SHAFTS])
{
    for (int k = 0; k < GM_SHAFTS; k++) {
        low[k] = -GM_FAR;
        high[k] = GM_FAR;
    }
}

void gm_solve_given(const gm_drive *d, gm_solution *s)
{
    gm_point at;
    s->lead = d->h / 2;
    first_place(d, s, &at);
    one_pass(d, s, &at);
    if (gm_terms_hold(d, s, &at, &s->point)) {
        return;
    }
    gm_real low[GM_SHAFTS], high[GM_SHAFTS], lead = d->h / 2;
    reset_brackets(low, high);
    for (int pass = 1; pass < GM_PASSES; pass++) {
        gm_point next = s->point;
        if (s->lead != lead) {
            reset_brackets(low, high);
            lead = s->lead;
        } else {
            next_place(pass, &at, &next, low, high);
            set_speeds(d, &next);
        }
        at = next;
        one_pass(d, s, &at);
        if (gm_terms_hold(d, s, &at, &s->point)) {
            return;
        }
    }
}

/* ---- rest ---- */

static gm_real path_excess(const gm_drive *d, const gm_solution *s, int p, gm_real sign,
                           gm_terms *t)
{
    gm_point at = s->point;
    at.a[p] = at.m[p] = 0;
    gm_drag_terms(d, p, sign, s->sign[GM_OUT], &at, t);
    return path_balance(d, t, &at, p);
}

static gm_real output_excess(const gm_drive *d, const gm_solution *s, gm_real sign,
                             gm_terms *t)
{
    gm_point at = s->point;
    at.a[GM_OUT] = at.m[GM_OUT] = 0;
    for (int p = 0; p < d->n_paths; p++) {
        if (d->engaged[p]) {
            at.m[p] = 0;
            at.tau_m[p] = d->tau[p] + (p == 0 ? -t->coupling : t->coupling);
        } else if (!s->held[p]) {
            gm_drag_terms(d, p, s->sign[p], sign, &at, t);
        }
    }
    gm_output_terms(d, sign, &at, t);
    return output_balance(d, t, &at);
}

gm_real gm_excess(const gm_drive *d, const gm_solution *s, int k, gm_real sign,
                  gm_terms *terms)
{
    *terms = s->terms;
    return k == GM_OUT ? output_excess(d, s, sign, terms)
                       : path_excess(d, s, k, sign, terms);
}

/* Direction in which shaft k breaks away; 0: friction holds it. */
static int breaks_away(const gm_drive *d, const gm_solution *s, int k)
{
    gm_terms t;
    const gm_real forward = gm_excess(d, s, k, 1, &t);
    const gm_real backward = gm_excess(d, s, k, -1, &t);
    if (forward > 0 && forward >= -backward) {
        return 1;
    }
    return backward < 0 ? -1 : 0;
}

static int revise(const gm_drive *d, gm_solution *s, int k)
{
    if (d->w[k] != 0 || (k != GM_OUT && !d->free[k])) {
        return 0;
    }
    if (s->held[k]) {
        const int sign = s->barred[k] ? 0 : breaks_away(d, s, k);
        s->held[k] = sign == 0;
        s->sign[k] = sign < 0 ? -1 : 1;
        return sign != 0;
    }
    if (s->point.a[k] * s->sign[k] > 0) {
        return 0;
    }
    s->held[k] = s->barred[k] = 1;
    s->sign[k] = 1;
    return 1;
}

void gm_solve(const gm_drive *d, gm_solution *s)
{
    int standing = 0;
    for (int k = 0; k < GM_SHAFTS; k++) {
        s->sign[k] = d->w[k] < 0 ? -1 : 1;
        s->held[k] = d->w[k] == 0 && (k == GM_OUT || d->free[k]);
        s->barred[k] = 0;
        standing += s->held[k];
    }
    gm_solve_given(d, s);
    if (standing == 0) {
        return;
    }
    for (int round = 0; round < GM_ROUNDS; round++) {
        const int changed = revise(d, s, GM_OUT) + revise(d, s, 0) + revise(d, s, 1);
        if (changed == 0) {
            return;
        }
        gm_solve_given(d, s);
    }
}
