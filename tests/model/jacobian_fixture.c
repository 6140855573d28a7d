/* SPDX-License-Identifier: BSD-2-Clause */
#include "jacobian_fixture.h"
#include "property.h"

#include <stdlib.h>
#include <string.h>

void sparse_make(sparse *s, gm_motion *motion)
{
    s->n = gm_motion_n_states(motion);
    s->entries = gm_motion_entries(motion);
    s->column_start = calloc((size_t)s->n + 1, sizeof(int));
    s->row = calloc((size_t)s->entries, sizeof(int));
    s->value = calloc((size_t)s->entries, sizeof(double));
    assert_true(s->column_start && s->row && s->value);
    gm_motion_pattern(motion, s->column_start, s->row);
}

void sparse_clear(sparse *s)
{
    free(s->column_start);
    free(s->row);
    free(s->value);
}

static int random_gear(const gm_path_part *path, uint64_t *seed)
{
    int k = (int)(random_unit(seed) * (path->n_gears + path->has_neutral));
    return k == path->n_gears ? 0 : path->gears[k].number;
}

static void random_gears(moving *m, uint64_t *seed)
{
    for (int p = 0; p < m->d->n_paths; p++)
        m->input.gear[p] = random_gear(&m->d->paths[p], seed);
}

static void random_state(moving *m, uint64_t *seed)
{
    double w[GM_MAX_FLANGES] = {0.0}, scale = random_scale(seed, 1e-2, 300.);
    int changed;
    random_gears(m, seed);
    for (int f = 0; f <= m->d->n_paths; f++)
        w[f] = random_between(seed, -scale, scale);
    moving_start(m, w);
    double *absolute = calloc((size_t)m->n, sizeof *absolute);
    assert_non_null(absolute);
    gm_motion_tolerances(m->motion, 1., absolute);
    for (int i = 0; i < m->n; i++) /* speeds to a few percent, deflections over the gap */
        m->x[i] += absolute[i] * random_between(seed, -3., 3.) *
                   (random_unit(seed) < 0.5 ? 1e-2 : 1.);
    for (int k = 0; k < 2 && random_unit(seed) < 0.6; k++) {
        random_gears(m, seed); /* some locks begin to synchronise */
        assert_int_equal(gm_motion_handle(m->motion, &m->input, m->x, &changed, NULL),
                         GM_OK);
    }
    free(absolute);
}

/* Central quotient of the rates by x_j, and how much the quotients of both sides differ:
 * by h f'' where the rates are smooth, by the same amount for every h at a kink. */
static void difference(moving *m, int j, double h, const double *dx, double *work,
                       double *quotient, double *bend)
{
    double x_j = m->x[j], *low = work, *high = work + m->n;
    m->x[j] = x_j - h;
    assert_int_equal(gm_motion_rates(m->motion, &m->input, m->x, low), 0);
    m->x[j] = x_j + h;
    assert_int_equal(gm_motion_rates(m->motion, &m->input, m->x, high), 0);
    m->x[j] = x_j;
    for (int i = 0; i < m->n; i++) {
        quotient[i] = (high[i] - low[i]) / (2. * h);
        bend[i] = (high[i] - 2. * dx[i] + low[i]) / h;
    }
}

/* A kink near x_j: no derivative can be expected from differences. */
static int kinked(double coarse, double fine, double coarse_bend, double fine_bend,
                  double tolerance)
{
    return fabs(coarse - fine) > tolerance ||
           fabs(2. * fine_bend - coarse_bend) > tolerance;
}

static void compare_column(moving *m, const sparse *s, int j, double h, const double *dx,
                           double *work, tally *count)
{
    double *coarse = work, *fine = coarse + m->n, *dense = fine + m->n;
    double *coarse_bend = dense + m->n, *fine_bend = coarse_bend + m->n;
    difference(m, j, 2. * h, dx, fine_bend + m->n, coarse, coarse_bend);
    difference(m, j, h, dx, fine_bend + m->n, fine, fine_bend);
    memset(dense, 0, (size_t)m->n * sizeof *dense);
    for (int k = s->column_start[j]; k < s->column_start[j + 1]; k++)
        dense[s->row[k]] += s->value[k];
    for (int i = 0; i < m->n; i++) {
        double size = fabs(fine[i]) + fabs(dense[i]);
        double tolerance = 2e-5 * size + 1e-14 * (fabs(dx[i]) + 1e6) / h;
        count->compared++;
        if (kinked(coarse[i], fine[i], coarse_bend[i], fine_bend[i], tolerance))
            count->kinks++;
        else if (!(fabs(dense[i] - fine[i]) <= 2. * tolerance))
            fail_msg("d rate %d / d x %d: %.9g, by differences %.9g and %.9g", i, j,
                     dense[i], fine[i], coarse[i]);
    }
}

tally compare_jacobian(moving *m, uint64_t *seed, int states)
{
    tally count = {0, 0};
    sparse s;
    sparse_make(&s, m->motion);
    double *work = calloc(8 * (size_t)m->n, sizeof *work);
    double *unit = calloc((size_t)m->n, sizeof *unit);
    assert_true(work && unit);
    gm_motion_tolerances(m->motion, 1e-5, unit);
    for (int k = 0; k < states; k++) {
        random_state(m, seed);
        double *dx = work + 7 * m->n;
        assert_int_equal(gm_motion_jacobian(m->motion, &m->input, m->x, s.value), 0);
        assert_int_equal(gm_motion_rates(m->motion, &m->input, m->x, dx), 0);
        for (int j = 0; j < m->n; j++)
            compare_column(m, &s, j, unit[j], dx, work, &count);
    }
    free(work);
    free(unit);
    sparse_clear(&s);
    return count;
}
