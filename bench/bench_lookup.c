/* SPDX-License-Identifier: BSD-2-Clause
 *
 * bench_lookup: value and both gradients from a table of 45 x 9, chained (each query
 * waits for the result of the last, as in a simulation), beside the bilinear
 * interpolation of the GNU Scientific Library with its accelerators, in the same run.
 * The point moves slowly,
 * as an operating point does, or jumps. Medians over blocks, as JSON, nanoseconds.
 */
#include "core/cell.h" /* as the core itself reads its tables */

#include <gsl/gsl_spline2d.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { N_X = 45, N_Y = 9, BLOCKS = 501, CALLS = 1000 };

static double x[N_X], y[N_Y], z[N_X * N_Y];

static double now_ns(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static int compare(const void *a, const void *b)
{
    const double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

static void fill(void)
{
    for (int i = 0; i < N_X; i++)
        x[i] = i + 0.3 * (i % 3);
    for (int j = 0; j < N_Y; j++)
        y[j] = j * (1 + 0.05 * j);
    for (int i = 0; i < N_X; i++)
        for (int j = 0; j < N_Y; j++)
            z[i * N_Y + j] = 0.01 * x[i] + 0.02 * y[j] + 1e-3 * x[i] * y[j];
}

/* What one query gives: the sum of value and gradients. */
typedef double (*query)(void *self, double at_x, double at_y);

typedef struct own_table {
    gm_table2 table;
    gm_cell2 cell;
} own_table;

static double ask_own(void *self, double at_x, double at_y)
{
    own_table *t = self;
    const gm_value2 v = gm_cell2_at(&t->table, 1, &t->cell, at_x, at_y);
    return v.value + v.dx + v.dy;
}

typedef struct gsl_table {
    gsl_spline2d *spline;
    gsl_interp_accel *x, *y;
} gsl_table;

static double ask_gsl(void *self, double at_x, double at_y)
{
    const gsl_table *t = self;
    return gsl_spline2d_eval(t->spline, at_x, at_y, t->x, t->y) +
           gsl_spline2d_eval_deriv_x(t->spline, at_x, at_y, t->x, t->y) +
           gsl_spline2d_eval_deriv_y(t->spline, at_x, at_y, t->x, t->y);
}

/* stride: part of the range that the point moves between two queries. */
static double time_of(query ask, void *self, double stride, double *check)
{
    static double blocks[BLOCKS];
    double at = 0.1, sum = 0;
    for (int b = 0; b < BLOCKS; b++) {
        const double start = now_ns();
        for (int i = 0; i < CALLS; i++) {
            const double v = ask(self, 44 * at, 11 * (1 - at));
            at += stride + 1e-12 * v;
            at = at > 1 ? at - 1 : at;
            sum += v;
        }
        blocks[b] = (now_ns() - start) / CALLS;
    }
    *check = sum;
    qsort(blocks, BLOCKS, sizeof *blocks, compare);
    return blocks[BLOCKS / 2];
}

int main(void)
{
    static const double stride[2] = {1e-6, 0.37};
    static const char *const name[2] = {"slow", "jumping"};
    double transposed[N_X * N_Y], check[2];
    fill();
    own_table own = {{{N_X, x}, {N_Y, y}, z}, {0}};
    for (int i = 0; i < N_X * N_Y; i++) /* GSL counts x first */
        transposed[i % N_Y * N_X + i / N_Y] = z[i];
    gsl_table gsl = {gsl_spline2d_alloc(gsl_interp2d_bilinear, N_X, N_Y),
                     gsl_interp_accel_alloc(), gsl_interp_accel_alloc()};
    gsl_spline2d_init(gsl.spline, x, y, transposed, N_X, N_Y);
    printf("{");
    for (int k = 0; k < 2; k++) {
        const double t_own = time_of(ask_own, &own, stride[k], &check[0]);
        const double t_gsl = time_of(ask_gsl, &gsl, stride[k], &check[1]);
        const double differ = check[0] / check[1] - 1;
        if (!(differ < 1e-6 && differ > -1e-6)) {
            fprintf(stderr, "bench_lookup: the two do not agree\n");
            return 1;
        }
        printf("%s\"%s\": {\"own_ns\": %.1f, \"gsl_ns\": %.1f, \"ratio\": %.2f}",
               k ? ", " : "", name[k], t_own, t_gsl, t_own / t_gsl);
    }
    printf("}\n");
    gsl_interp_accel_free(gsl.x);
    gsl_interp_accel_free(gsl.y);
    gsl_spline2d_free(gsl.spline);
    return 0;
}
