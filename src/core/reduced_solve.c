/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Motion of the reduced gearset over one sub-step, implicit midpoint.
 *
 * Unknown are the acceleration a of the output and b_n of each path with its own speed.
 * The balance
 *
 *   F_o = J_s a - tau_o - sum_E r (g_p - sigma_p D_p) - sum_sync r T_c + sum_N R
 *         + sigma (P + X)
 *   F_n = J_n b - g_n + N_n + T_c,n            g_0 = tau_0 - C,  g_1 = tau_1 + C
 *
 * (for elastic paths as gm_reduced.h has it) holds at the mean speeds m = w + mean dw/dt,
 * mean = h/2 where no vibration is too fast. Inside the cells of all tables the terms
 * are linear but for small bilinear remainders, so one Newton pass solves it; when a
 * table leaves its cell the next pass starts there. Every pass yields torques that fulfil
 * the linearised balance to rounding, and these torques are what the account of losses
 * uses: it closes whether or not the passes have converged. The passes are bounded by
 * GM_PASSES; brackets on every unknown turn cycles between cells into bisection. Only the
 * coupling C may be read later than at the middle of the step, when it is stiff.
 *
 * Springs are not linearised: within the linear system of a pass their torques are found
 * together with the slips they cause (reduced_spring.c).
 *
 * Friction at rest: a shaft at standstill is held unless the torque on it exceeds one of
 * the two one-sided limits; then it is let go in that direction. Each shaft can be let go
 * once and be held again once, so the search is bounded by GM_ROUNDS.
 */
#include "reduced_parts.h"

enum { GM_FREE_PASSES = 3, GM_ROUNDS = 2 * GM_SHAFTS + 1 };

#define GM_FAR GM_BY_TYPE(1e300, 1e38) /* bracket that excludes nothing */

/* Relative change of speeds and torques that is none. */
#define GM_SETTLED GM_BY_TYPE(1e-14, 1e-6)

/* ---- the passes ---- */

/* A place where tables are read: accelerations and springs' torques. */
enum { GM_PLACE = GM_SHAFTS + GM_MAX_PATHS };

typedef struct bracket {
    gm_real low, high;
} bracket;

static void set_speeds(const gm_drive *d, gm_point *at)
{
    const gm_real half = d->mean;
    at->m[GM_OUT] = d->w[GM_OUT] + half * at->a[GM_OUT];
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        at->m[p] = d->own[p] ? d->w[p] + half * at->a[p] : d->ratio[p] * at->m[GM_OUT];
    }
}

/* The elastic path's part of linearise: spring, pin, and with them the loads. */
static void linearise_spring(gm_solution *s, int p, const gm_point *from, gm_point *to)
{
    gm_path_terms *path = &s->terms.path[p];
    const gm_real d_o = to->m[GM_OUT] - from->m[GM_OUT];
    const gm_real d_spring = to->spring[p] - from->spring[p];
    const gm_real d_drag = path->drag_o * d_o;
    const gm_real d_tau = s->held[p] ? 0 : d_spring + d_drag;
    path->drag += d_drag;
    to->tau_m[p] = from->tau_m[p] + d_tau;
    path->load += path->load_o * d_o + path->load_tau * d_tau;
    s->terms.out += s->terms.out_tau[p] * d_tau;
}

static void linearise(const gm_drive *d, gm_solution *s, const gm_point *from,
                      gm_point *to)
{
    gm_terms *t = &s->terms;
    const gm_real d_o = to->m[GM_OUT] - from->m[GM_OUT];
    const gm_real d_a = to->a[GM_OUT] - from->a[GM_OUT];
    const gm_real d_c = t->coupling_a * (gm_parting(d, to) - gm_parting(d, from));
    t->coupling += d_c;
    t->out += t->out_o * d_o;
    for (int p = 0; p < d->n_paths; p++) {
        gm_path_terms *path = &t->path[p];
        if (d->elastic[p]) {
            linearise_spring(s, p, from, to);
        } else if (d->engaged[p]) {
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

/* What the next pass reads instead of to, one coordinate of the place: half way to the
 * last place on the other side once the passes go to and fro. */
static gm_real next_coordinate(gm_real from, gm_real to, bracket *b)
{
    if (to > from) {
        b->low = from > b->low ? from : b->low;
    } else if (to < from) {
        b->high = from < b->high ? from : b->high;
    }
    if (b->low < b->high && b->low > -GM_FAR && b->high < GM_FAR &&
        (to <= b->low || to >= b->high)) {
        return b->low / 2 + b->high / 2;
    }
    return to;
}

/* Where the next pass reads the tables. */
static void next_place(const gm_point *at, gm_point *to, bracket b[GM_PLACE])
{
    for (int k = 0; k < GM_SHAFTS; k++) {
        to->a[k] = next_coordinate(at->a[k], to->a[k], &b[k]);
    }
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        to->spring[p] = next_coordinate(at->spring[p], to->spring[p], &b[GM_SHAFTS + p]);
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

/* Where the springs are read first: at the present slips. */
static void first_springs(const gm_drive *d, gm_solution *s, gm_point *at)
{
    static const gm_spring none = {0, 0, 0};
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        const gm_stride stride = {d->h, gm_slip(d, at, p), d->late, d->damping[p]};
        s->slip[p] = d->elastic[p] ? stride.slip : 0;
        s->spring[p] =
            d->elastic[p] ? gm_spring_at(d->gear[p], d->twist[p], &stride) : none;
        at->spring[p] = s->spring[p].torque;
    }
}

/* First place: the output under its flange torques with the losses of the last step, free
 * paths at their present speed; with an elastic path everything at its present speed;
 * what is prescribed or held where it will be. Warm: as the motion before. */
static void first_place(const gm_drive *d, gm_solution *s, gm_point *at)
{
    const int sprung = d->elastic[0] || d->elastic[1];
    for (int k = 0; k < GM_SHAFTS; k++) {
        at->a[k] = s->warm && gm_moves(d, s, k) ? s->point.a[k] : d->given[k];
    }
    if (!s->warm && !sprung && gm_moves(d, s, GM_OUT)) {
        at->a[GM_OUT] = (driving_torque(d) - d->brake) / d->inertia[GM_OUT];
    }
    at->spring[0] = at->spring[1] = 0;
    set_speeds(d, at);
    if (sprung) {
        first_springs(d, s, at);
    }
}

/* The usual case: nothing but the output moves by itself. */
static int moves_alone(const gm_drive *d, const gm_solution *s)
{
    return gm_moves(d, s, GM_OUT) && !d->own[0] && !d->own[1];
}

/* What d_a changes of the terms, and the place it leads to. */
static void follow_alone(const gm_drive *d, gm_solution *s, const gm_point *at,
                         gm_real d_a)
{
    gm_terms *t = &s->terms;
    gm_point *to = &s->point;
    const gm_real d_o = d->mean * d_a;
    to->a[GM_OUT] = at->a[GM_OUT] + d_a;
    to->m[GM_OUT] = d->w[GM_OUT] + d->mean * to->a[GM_OUT];
    t->out += t->out_o * d_o;
    for (int p = 0; p < d->n_paths; p++) {
        gm_path_terms *path = &t->path[p];
        const gm_real d_tau = -d->inertia[p] * d->ratio[p] * d_a;
        to->m[p] = d->ratio[p] * to->m[GM_OUT];
        to->tau_m[p] = at->tau_m[p] + d_tau;
        t->out += t->out_tau[p] * d_tau;
        path->load += path->load_o * d_o + path->load_tau * d_tau;
    }
}

static void pass_alone(const gm_drive *d, gm_solution *s, gm_point *at)
{
    gm_terms *t = &s->terms;
    const gm_real a = at->a[GM_OUT];
    gm_real torque = d->tau[GM_OUT], inertia = d->inertia_own, slope;
    gm_clear_terms(t);
    for (int p = 0; p < d->n_paths; p++) {
        at->tau_m[p] = d->tau[p] - d->inertia[p] * d->ratio[p] * a;
    }
    gm_output_terms(d, s->sign[GM_OUT], at, t);
    slope = t->out_o;
    for (int p = 0; p < d->n_paths; p++) {
        const gm_path_terms *path = &t->path[p];
        const gm_real r = d->ratio[p];
        torque += r * (d->tau[p] - path->load);
        inertia += d->inertia[p] * r * (r * (1 - path->load_tau) - t->out_tau[p]);
        slope += r * path->load_o;
    }
    inertia += d->mean * slope;
    if (!(inertia > GM_PIVOT_LIMIT * d->inertia[GM_OUT])) {
        gm_drop_gradients(t);
        inertia = d->inertia[GM_OUT];
    }
    follow_alone(d, s, at, (torque - t->out - d->inertia[GM_OUT] * a) / inertia);
}

static void one_pass(const gm_drive *d, gm_solution *s, gm_point *at)
{
    gm_real change[GM_SHAFTS];
    s->passes--;
    if (moves_alone(d, s)) {
        pass_alone(d, s, at);
        return;
    }
    gm_terms_at(d, s, at);
    gm_newton_change(d, s, at, change);
    for (int k = 0; k < GM_SHAFTS; k++) {
        s->point.a[k] = at->a[k] + change[k];
    }
    set_speeds(d, &s->point);
    linearise(d, s, at, &s->point);
}

/* The first passes lead far, and when s->lead has moved the pass before has solved
 * another problem: nothing is excluded. */
static void reset_brackets(bracket b[GM_PLACE])
{
    for (int k = 0; k < GM_PLACE; k++) {
        b[k].low = -GM_FAR;
        b[k].high = GM_FAR;
    }
}

static int is_same(gm_real from, gm_real to, gm_real least)
{
    return gm_abs(to - from) <= GM_SETTLED * (gm_abs(from) + least);
}

/* The pass has led back to where it began: there is nothing more to find. */
static int is_settled(const gm_drive *d, const gm_point *at, const gm_point *to)
{
    int same = is_same(at->m[GM_OUT], to->m[GM_OUT], 0);
    for (int p = 0; p < d->n_paths; p++) {
        same = same && is_same(at->m[p], to->m[p], 0) &&
               (d->free[p] || is_same(at->tau_m[p], to->tau_m[p], 1));
    }
    return same;
}

/* Passes after the first, which has led from *at to s->point. */
static void more_passes(const gm_drive *d, gm_solution *s, gm_point *at)
{
    bracket brackets[GM_PLACE];
    gm_real lead = d->h / 2;
    reset_brackets(brackets);
    for (int pass = 1; pass < GM_PASSES && s->passes > 0; pass++) {
        gm_point next = s->point;
        if (s->lead != lead || pass < GM_FREE_PASSES) {
            reset_brackets(brackets);
            lead = s->lead;
        } else {
            next_place(at, &next, brackets);
            set_speeds(d, &next);
        }
        *at = next;
        one_pass(d, s, at);
        if (gm_terms_hold(d, s, at, &s->point) ||
            (s->lead == lead && is_settled(d, at, &s->point))) {
            return;
        }
    }
}

void gm_solve_given(const gm_drive *d, gm_solution *s)
{
    gm_point at;
    s->lead = d->h / 2;
    first_place(d, s, &at);
    s->point.a[0] = s->point.a[1] = s->point.spring[0] = s->point.spring[1] = 0;
    s->point.m[0] = s->point.m[1] = 0; /* also of the path that is not there */
    one_pass(d, s, &at);
    if (!gm_terms_hold(d, s, &at, &s->point)) {
        more_passes(d, s, &at);
    }
    s->warm = d->h > 0;
}

/* ---- rest ---- */

static gm_real path_excess(const gm_drive *d, const gm_solution *s, int p, gm_real sign,
                           gm_terms *t)
{
    gm_point at = s->point;
    at.a[p] = at.m[p] = 0;
    if (d->elastic[p]) {
        gm_pin_friction(d, p, sign, &at, t);
    } else {
        t->path[p].drag = gm_drag_at_rest(d, p, sign, s->sign[GM_OUT], &at, &t->outside);
        t->path[p].reaction = 0;
    }
    return gm_path_balance(d, t, &at, p);
}

static gm_real output_excess(const gm_drive *d, const gm_solution *s, gm_real sign,
                             gm_terms *t)
{
    gm_point at = s->point;
    at.a[GM_OUT] = at.m[GM_OUT] = 0;
    for (int p = 0; p < d->n_paths; p++) {
        if (d->elastic[p]) {
            gm_pin_terms(d, s, p, sign, &at, t);
        } else if (d->engaged[p]) {
            at.m[p] = 0;
            at.tau_m[p] = d->tau[p] + (p == 0 ? -t->coupling : t->coupling);
        } else if (!s->held[p]) {
            gm_drag_terms(d, p, s->sign[p], sign, &at, t);
        }
    }
    gm_output_terms_at_rest(d, sign, &at, t);
    return gm_output_balance(d, t, &at);
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
    if (d->w[k] != 0 || d->prescribed[k] || (k != GM_OUT && !d->own[k])) {
        return 0;
    }
    if (s->held[k]) {
        const int sign = s->barred[k] || s->passes <= 0 ? 0 : breaks_away(d, s, k);
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

/* Direction of a prescribed speed in the middle of the sub-step; 0: it stays at rest. */
static gm_real prescribed_sign(const gm_drive *d, int k)
{
    const gm_real middle = d->w[k] + d->mean * d->given[k];
    const gm_real heading = middle != 0 ? middle : d->given[k];
    return heading > 0 ? 1 : heading < 0 ? -1 : 0;
}

void gm_solve(const gm_drive *d, gm_solution *s)
{
    int standing = 0;
    for (int k = 0; k < GM_SHAFTS; k++) {
        s->sign[k] = d->prescribed[k] ? prescribed_sign(d, k) : d->w[k] < 0 ? -1 : 1;
        s->held[k] = d->w[k] == 0 && !d->prescribed[k] && (k == GM_OUT || d->own[k]);
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
