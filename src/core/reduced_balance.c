/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The balance of torques on the shafts at one place, and the linear system for the
 * changes of the accelerations that one pass solves: balances and equations of
 * reduced_solve.c with the gradients of all terms.
 *
 * Gradients that would take the matrix near singularity (a map that is not monotone, with
 * a long step) are dropped: the terms are then explicit, the account stays exact.
 */
#include "reduced_parts.h"

/* The linear system for the changes of the accelerations, a row for each shaft,
 * factorised in place: multipliers below the diagonal, inverse pivots on it. */
typedef struct matrix {
    gm_real k[GM_SHAFTS][GM_SHAFTS];
    gm_real least[GM_SHAFTS]; /* smallest pivots that are accepted */
} matrix;

gm_real gm_output_balance(const gm_drive *d, const gm_terms *t, const gm_point *at)
{
    gm_real sum = d->tau[GM_OUT] - t->out - d->inertia[GM_OUT] * at->a[GM_OUT];
    for (int p = 0; p < d->n_paths; p++) {
        const gm_real c = p == 0 ? -t->coupling : t->coupling;
        if (d->elastic[p]) {
            sum += d->ratio[p] * (at->spring[p] - t->path[p].load);
        } else if (d->engaged[p]) {
            sum += d->ratio[p] * (d->tau[p] + c - t->path[p].load);
        } else {
            sum += d->ratio[p] * d->cone[p] - t->path[p].reaction;
        }
    }
    return sum;
}

gm_real gm_path_balance(const gm_drive *d, const gm_terms *t, const gm_point *at, int p)
{
    const gm_real c = p == 0 ? -t->coupling : t->coupling;
    const gm_real spring = d->elastic[p] ? at->spring[p] : 0;
    return d->tau[p] + c - t->path[p].drag - spring - d->cone[p] -
           d->inertia[p] * at->a[p];
}

/* Part of a torque at flange p that reaches the output: r (1 - dD/dtau) - dX/dtau. */
static gm_real passed_on(const gm_drive *d, const gm_terms *t, int p)
{
    return d->ratio[p] * (1 - t->path[p].load_tau) - t->out_tau[p];
}

/* While friction holds an elastic path, its transmitted torque is the one on its flange
 * and does not follow the spring. */
static gm_real passed_by_spring(const gm_drive *d, const gm_solution *s, int p)
{
    return s->held[p] ? d->ratio[p] : passed_on(d, &s->terms, p);
}

static void output_row(const gm_drive *d, const gm_solution *s, matrix *m)
{
    const gm_terms *t = &s->terms;
    const gm_real mean = d->mean;
    gm_real slope = t->out_o, inertia = d->inertia_own, *k = m->k[GM_OUT];
    k[0] = k[1] = 0;
    m->least[GM_OUT] = GM_PIVOT_LIMIT * d->inertia[GM_OUT];
    for (int p = 0; p < d->n_paths; p++) {
        const gm_path_terms *path = &t->path[p];
        const gm_real r = d->ratio[p];
        if (d->elastic[p]) {
            slope += r * path->load_o + (r - passed_by_spring(d, s, p)) * path->drag_o;
        } else if (d->engaged[p]) {
            const gm_real q = passed_on(d, t, p);
            inertia += d->inertia[p] * r * q;
            slope += r * path->load_o;
            inertia += r * q * t->coupling_a;
            k[1 - p] -= q * t->coupling_a;
        } else {
            slope += path->reaction_o;
            k[p] += mean * path->reaction_n;
        }
    }
    k[GM_OUT] = inertia + mean * slope;
}

static void path_row(const gm_drive *d, const gm_terms *t, int p, matrix *m)
{
    const gm_real mean = d->mean, c_a = t->coupling_a;
    const gm_path_terms *path = &t->path[p];
    const int other = 1 - p;
    m->least[p] = GM_PIVOT_LIMIT * d->inertia[p];
    m->k[p][p] = d->inertia[p] + mean * path->drag_n + c_a;
    m->k[p][other] = -c_a;
    m->k[p][GM_OUT] = mean * path->drag_o - (d->own[other] ? 0 : c_a * d->ratio[other]);
}

/* Elimination in fixed order; a shaft that does not move by itself has a row of the unit
 * matrix. 0 when a pivot is too small. */
static int factorise(matrix *m)
{
    gm_real(*k)[GM_SHAFTS] = m->k;
    int good = k[0][0] > m->least[0];
    k[0][0] = 1 / k[0][0];
    k[1][0] *= k[0][0];
    k[2][0] *= k[0][0];
    k[1][1] -= k[1][0] * k[0][1];
    k[1][2] -= k[1][0] * k[0][2];
    k[2][1] -= k[2][0] * k[0][1];
    good &= k[1][1] > m->least[1];
    k[1][1] = 1 / k[1][1];
    k[2][1] *= k[1][1];
    k[2][2] -= k[2][0] * k[0][2] + k[2][1] * k[1][2];
    good &= k[2][2] > m->least[2];
    k[2][2] = 1 / k[2][2];
    return good;
}

static void substitute(const matrix *m, gm_real x[GM_SHAFTS])
{
    const gm_real(*k)[GM_SHAFTS] = m->k;
    x[1] -= k[1][0] * x[0];
    x[2] -= k[2][0] * x[0] + k[2][1] * x[1];
    x[2] *= k[2][2];
    x[1] = (x[1] - k[1][2] * x[2]) * k[1][1];
    x[0] = (x[0] - k[0][1] * x[1] - k[0][2] * x[2]) * k[0][0];
}

void gm_drop_gradients(gm_terms *t)
{
    t->out_o = t->coupling_a = 0;
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        gm_path_terms *path = &t->path[p];
        t->out_tau[p] = path->load_o = path->load_tau = 0;
        path->drag_n = path->drag_o = path->reaction_n = path->reaction_o = 0;
    }
}

static void make_matrix(const gm_drive *d, gm_solution *s, matrix *m)
{
    static const matrix unit = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}};
    for (int attempt = 0; attempt < 2; attempt++) {
        *m = unit;
        for (int p = 0; p < d->n_paths; p++) {
            if (gm_moves(d, s, p)) {
                path_row(d, &s->terms, p, m);
            }
        }
        if (gm_moves(d, s, GM_OUT)) {
            output_row(d, s, m);
        }
        if (factorise(m)) {
            return;
        }
        gm_drop_gradients(&s->terms); /* leaves a diagonal of inertias */
    }
}

/* The springs' torques, and what they change in *to; linear but for the springs
 * themselves. */
static void add_springs(const gm_drive *d, gm_solution *s, const matrix *m,
                        const gm_point *at, gm_real change[GM_SHAFTS])
{
    gm_real per_torque[GM_MAX_PATHS][GM_SHAFTS] = {{0, 0, 0}, {0, 0, 0}};
    gm_yield yield = {{0, 0}, {{0, 0}, {0, 0}}};
    for (int q = 0; q < d->n_paths; q++) {
        if (d->elastic[q]) {
            per_torque[q][q] = gm_moves(d, s, q) ? -1 : 0;
            per_torque[q][GM_OUT] =
                gm_moves(d, s, GM_OUT) ? passed_by_spring(d, s, q) : 0;
            substitute(m, per_torque[q]);
        }
    }
    for (int p = 0; p < d->n_paths; p++) {
        const gm_real r = d->ratio[p];
        yield.free[p] = gm_slip(d, at, p) + d->mean * (change[p] - r * change[GM_OUT]);
        for (int q = 0; q < d->n_paths; q++) {
            yield.y[p][q] = d->mean * (r * per_torque[q][GM_OUT] - per_torque[q][p]);
        }
    }
    for (int q = 0; q < GM_MAX_PATHS; q++) {
        s->point.spring[q] = at->spring[q];
    }
    gm_springs_meet(d, &yield, s);
    for (int q = 0; q < d->n_paths; q++) {
        const gm_real more = s->point.spring[q] - at->spring[q];
        for (int k = 0; k < GM_SHAFTS; k++) {
            change[k] += more * per_torque[q][k];
        }
    }
}

void gm_newton_change(const gm_drive *d, gm_solution *s, const gm_point *at,
                      gm_real *change)
{
    matrix m;
    make_matrix(d, s, &m);
    change[GM_OUT] = gm_moves(d, s, GM_OUT) ? gm_output_balance(d, &s->terms, at) : 0;
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        change[p] = gm_moves(d, s, p) ? gm_path_balance(d, &s->terms, at, p) : 0;
    }
    substitute(&m, change);
    if (d->elastic[0] || d->elastic[1]) {
        add_springs(d, s, &m, at, change);
    }
}
