/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Monotone cubic interpolation: nodes to the last bit, continuous gradients that agree
 * with difference quotients, no overshoot, monotone where the nodes are, clamped edges,
 * a cache that changes nothing, and more accurate than lines.
 */
#include "core/gm_interp.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "near.h"

enum { N_X = 7, N_Y = 6, TABLES = 300, POINTS = 200 };

static unsigned seed;

static double between(double low, double high)
{
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * ((seed >> 8) / 16777216.0);
}

/* Axes of uneven steps and values of a kind: any, rising along both, flat in parts. */
typedef struct table {
    double x[N_X], y[N_Y], f[N_X][N_Y];
    gm_table2 t;
} table;

typedef enum kind { ANY, RISING, PARTLY_FLAT, KINDS } kind;

static void make_axis(double *x, int n)
{
    x[0] = between(-3, 3);
    for (int i = 1; i < n; i++)
        x[i] = x[i - 1] + exp(between(-3, 3));
}

static void make(kind of, table *t)
{
    make_axis(t->x, N_X);
    make_axis(t->y, N_Y);
    for (int i = 0; i < N_X; i++)
        for (int j = 0; j < N_Y; j++) {
            const double left = i > 0 ? t->f[i - 1][j] : 0;
            const double below = j > 0 ? t->f[i][j - 1] : 0;
            const double step =
                of == PARTLY_FLAT ? fmax(0, between(-1, 1)) : exp(between(-4, 4));
            t->f[i][j] = of == ANY ? between(-1, 1) : fmax(left, below) + step;
        }
    t->t = (gm_table2){{N_X, t->x}, {N_Y, t->y}, t->f[0], 1};
}

static gm_value2 at(const table *t, double x, double y)
{
    gm_cell2 cell = {0};
    return gm_table2_at(&t->t, 1, &cell, x, y);
}

/* The row of the first node on the other axis, as a table of one dimension. */
static gm_value1 at1(const table *t, double y)
{
    const gm_table1 row = {{N_Y, t->y}, t->f[0], 1};
    gm_cell1 cell = {0};
    return gm_table1_at(&row, 1, &cell, y);
}

static double size_of(const table *t)
{
    double largest = 0;
    for (int i = 0; i < N_X; i++)
        for (int j = 0; j < N_Y; j++)
            largest = fmax(largest, fabs(t->f[i][j]));
    return largest;
}

static void every_node_is_exact(void **state)
{
    table t;
    (void)state;
    for (int k = 0; k < TABLES; k++) {
        make((kind)(k % KINDS), &t);
        for (int i = 0; i < N_X; i++)
            for (int j = 0; j < N_Y; j++) {
                const gm_value2 v = at(&t, t.x[i], t.y[j]);
                assert_memory_equal(&v.value, &t.f[i][j], sizeof v.value);
                assert_false(v.outside);
            }
        for (int j = 0; j < N_Y; j++) {
            const gm_value1 v = at1(&t, t.y[j]);
            assert_memory_equal(&v.value, &t.f[0][j], sizeof v.value);
        }
    }
}

/* On both sides of a grid line, one rounding of the place apart. */
static void value_and_gradient_are_continuous(void **state)
{
    table t;
    (void)state;
    for (int k = 0; k < TABLES; k++) {
        make((kind)(k % KINDS), &t);
        const double close = 1e-10 * size_of(&t); /* widths from 0.05 on: slopes up to
                                                     30 values, cubics of them */
        for (int i = 1; i < N_X; i++) {
            const double y = between(t.y[0], t.y[N_Y - 1]);
            const gm_value2 a = at(&t, nextafter(t.x[i], -HUGE_VAL), y);
            const gm_value2 b = at(&t, t.x[i], y);
            assert_near(a.value, b.value, close);
            assert_near(a.dx, b.dx, 100 * close);
            assert_near(a.dy, b.dy, 100 * close);
        }
        for (int j = 1; j < N_Y; j++) {
            const double x = between(t.x[0], t.x[N_X - 1]);
            const gm_value2 a = at(&t, x, nextafter(t.y[j], -HUGE_VAL));
            const gm_value2 b = at(&t, x, t.y[j]);
            assert_near(a.value, b.value, close);
            assert_near(a.dx, b.dx, 100 * close);
            assert_near(a.dy, b.dy, 100 * close);
            const gm_value1 c = at1(&t, nextafter(t.y[j], -HUGE_VAL));
            const gm_value1 d = at1(&t, t.y[j]);
            assert_near(c.value, d.value, close);
            assert_near(c.dx, d.dx, 100 * close);
        }
    }
}

/* Central differences of step e: error e2 times the third derivative (within a cell of
 * width >= 0.05 at most some 1e5 values), and rounding / e; the second derivative jumps
 * at grid lines, which may lie between the points: e times that. */
static void gradients_are_those_of_differences(void **state)
{
    const double e = 1e-7;
    table t;
    (void)state;
    for (int k = 0; k < TABLES; k++) {
        make((kind)(k % KINDS), &t);
        const double close = 2e-3 * size_of(&t);
        for (int i = 0; i < POINTS; i++) {
            const double x = between(t.x[0] + e, t.x[N_X - 1] - e);
            const double y = between(t.y[0] + e, t.y[N_Y - 1] - e);
            const gm_value2 v = at(&t, x, y);
            assert_near(v.dx, (at(&t, x + e, y).value - at(&t, x - e, y).value) / (2 * e),
                        close);
            assert_near(v.dy, (at(&t, x, y + e).value - at(&t, x, y - e).value) / (2 * e),
                        close);
            assert_near(at1(&t, y).dx,
                        (at1(&t, y + e).value - at1(&t, y - e).value) / (2 * e), close);
        }
    }
}

static double least_of(double a, double b, double c, double d)
{
    return fmin(fmin(a, b), fmin(c, d));
}

static void a_cell_stays_between_its_corners(void **state)
{
    table t;
    (void)state;
    for (int k = 0; k < TABLES; k++) {
        make((kind)(k % KINDS), &t);
        const double slack = 1e-13 * size_of(&t);
        for (int n = 0; n < POINTS; n++) {
            const double x = between(t.x[0], t.x[N_X - 1]),
                         y = between(t.y[0], t.y[N_Y - 1]);
            const int i = gm_axis_find(&t.t.x, x), j = gm_axis_find(&t.t.y, y);
            const double a = t.f[i][j], b = t.f[i + 1][j], c = t.f[i][j + 1],
                         d = t.f[i + 1][j + 1];
            const double value = at(&t, x, y).value;
            assert_true(value >= least_of(a, b, c, d) - slack);
            assert_true(value <= -least_of(-a, -b, -c, -d) + slack);
            const double line = at1(&t, y).value;
            assert_true(line >= fmin(t.f[0][j], t.f[0][j + 1]) - slack);
            assert_true(line <= fmax(t.f[0][j], t.f[0][j + 1]) + slack);
        }
    }
}

/* Along every grid line, and across it: slopes there have the sign of the nodes. */
static void grid_lines_rise_where_the_nodes_do(void **state)
{
    table t;
    (void)state;
    for (int k = 0; k < TABLES; k++) {
        make(k % 2 ? RISING : PARTLY_FLAT, &t);
        const double slack = 1e-12 * size_of(&t) * 20; /* slopes: values / 0.05 */
        for (int n = 0; n < POINTS; n++) {
            const double x = between(t.x[0], t.x[N_X - 1]),
                         y = between(t.y[0], t.y[N_Y - 1]);
            const int i = gm_axis_find(&t.t.x, x), j = gm_axis_find(&t.t.y, y);
            const gm_value2 on_x = at(&t, t.x[i], y), on_y = at(&t, x, t.y[j]);
            assert_true(on_x.dx >= -slack && on_x.dy >= -slack);
            assert_true(on_y.dx >= -slack && on_y.dy >= -slack);
            assert_true(at1(&t, y).dx >= -slack);
        }
    }
}

static void clamps_and_flags_outside(void **state)
{
    table t;
    (void)state;
    for (int k = 0; k < TABLES; k++) {
        make((kind)(k % KINDS), &t);
        const double x = between(t.x[0], t.x[N_X - 1]), y = between(t.y[0], t.y[N_Y - 1]);
        const double left = t.x[0] - between(0, 9),
                     above = t.y[N_Y - 1] + between(0.1, 9);
        const gm_value2 a = at(&t, left, y), b = at(&t, x, above);
        const gm_value2 edge_a = at(&t, t.x[0], y), edge_b = at(&t, x, t.y[N_Y - 1]);
        assert_true(a.outside && b.outside && !edge_a.outside && !edge_b.outside);
        assert_true(a.value == edge_a.value && a.dy == edge_a.dy && a.dx == 0);
        assert_true(b.value == edge_b.value && b.dx == edge_b.dx && b.dy == 0);
        const gm_value1 c = at1(&t, above);
        assert_true(c.outside && c.value == t.f[0][N_Y - 1] && c.dx == 0);
    }
}

static void the_cache_changes_no_bit(void **state)
{
    table t, other;
    gm_cell2 cell = {0};
    (void)state;
    make(ANY, &t);
    make(RISING, &other);
    for (int n = 0; n < 20000; n++) {
        const double x = between(t.x[0] - 1, t.x[N_X - 1] + 1),
                     y = between(t.y[0] - 1, t.y[N_Y - 1] + 1);
        const int second = n % 5 == 0;
        const table *of = second ? &other : &t;
        for (int again = 0; again < 2; again++) {
            const gm_value2 v = gm_table2_at(&of->t, 1 + second, &cell, x, y);
            const gm_value2 fresh = at(of, x, y);
            assert_memory_equal(&v.value, &fresh.value, sizeof v.value);
            assert_memory_equal(&v.dx, &fresh.dx, sizeof v.dx);
            assert_memory_equal(&v.dy, &fresh.dy, sizeof v.dy);
            assert_int_equal(v.outside, fresh.outside);
        }
    }
}

static void one_and_two_nodes_are_constant_and_straight(void **state)
{
    const double one[1] = {3}, two[2] = {1, 3}, f[2][2] = {{1, 4}, {5, 2}};
    const gm_table2 constant_x = {{1, one}, {2, two}, f[0], 1};
    const gm_table2 bilinear = {{2, two}, {2, two}, f[0], 1};
    const gm_table1 lone = {{1, one}, f[0], 1};
    gm_cell2 a = {0}, b = {0};
    gm_cell1 c = {0};
    (void)state;
    for (int n = 0; n < 100; n++) {
        const double x = between(-90, 90), y = between(1, 3), u = between(1, 3);
        const gm_value2 v = gm_table2_at(&constant_x, 1, &a, x, y);
        assert_near(v.value, 1 + 3 * (y - 1) / 2, 1e-14);
        assert_true(v.dx == 0 && !v.outside);
        assert_near(v.dy, 1.5, 1e-14);
        const gm_value1 w = gm_table1_at(&lone, 1, &c, x);
        assert_true(w.value == 1 && w.dx == 0 && !w.outside);
        const gm_value2 z = gm_table2_at(&bilinear, 1, &b, u, y);
        assert_true(z.value >= 1 - 1e-14 && z.value <= 5 + 1e-14);
    }
}

static double smooth(double x, double y)
{
    return exp(0.3 * x) * (2 + y + 0.2 * y * y);
}

/* Largest error over a square, n cells a side. */
static double error_of(int n, int monotone)
{
    static double axis[65], f[65 * 65];
    double worst = 0;
    for (int i = 0; i <= n; i++)
        axis[i] = 3.0 * i / n;
    for (int i = 0; i <= n; i++)
        for (int j = 0; j <= n; j++)
            f[i * (n + 1) + j] = smooth(axis[i], axis[j]);
    const gm_table2 t = {{n + 1, axis}, {n + 1, axis}, f, monotone};
    for (int k = 0; k < 5000; k++) {
        gm_cell2 cell = {0};
        const double x = between(0, 3), y = between(0, 3);
        worst = fmax(worst, fabs(gm_table2_at(&t, 1, &cell, x, y).value - smooth(x, y)));
    }
    return worst;
}

/* Slopes of parabolas have an error of second order, so the value one of third; with
 * lines it is of second. */
static void converges_with_third_order(void **state)
{
    (void)state;
    assert_true(error_of(64, 1) < error_of(32, 1) / 6);
    assert_true(error_of(32, 1) < error_of(16, 1) / 6);
    assert_true(error_of(32, 1) < error_of(32, 0) / 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_node_is_exact),
        cmocka_unit_test(value_and_gradient_are_continuous),
        cmocka_unit_test(gradients_are_those_of_differences),
        cmocka_unit_test(a_cell_stays_between_its_corners),
        cmocka_unit_test(grid_lines_rise_where_the_nodes_do),
        cmocka_unit_test(clamps_and_flags_outside),
        cmocka_unit_test(the_cache_changes_no_bit),
        cmocka_unit_test(one_and_two_nodes_are_constant_and_straight),
        cmocka_unit_test(converges_with_third_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
