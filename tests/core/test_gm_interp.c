/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Interpolation: nodes to the last bit, edges clamped and flagged, gradients that agree
 * with difference quotients, and a cache that changes nothing.
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

enum { N_X = 5, N_Y = 4, N_Z = 3 };

static const double axis_x[N_X] = {0, 0.1, 0.7, 3, 10};
static const double axis_y[N_Y] = {-5, -0.3, 0.2, 7};
static const double axis_z[N_Z] = {-1, 0.4, 2};

typedef struct tables {
    double value1[N_X], value2[N_X][N_Y], value3[N_X][N_Y][N_Z];
    gm_table1 t1;
    gm_table2 t2;
    gm_table3 t3;
} tables;

static unsigned seed;

static double random_between(double low, double high)
{
    seed = seed * 1664525u + 1013904223u;
    return low + (high - low) * ((seed >> 8) / 16777216.0);
}

static void fill(tables *t)
{
    seed = 12345;
    for (int i = 0; i < N_X; i++) {
        t->value1[i] = random_between(-1, 1);
        for (int j = 0; j < N_Y; j++) {
            t->value2[i][j] = random_between(-1, 1);
            for (int k = 0; k < N_Z; k++) {
                t->value3[i][j][k] = random_between(-1, 1);
            }
        }
    }
    t->t1 = (gm_table1){{N_X, axis_x}, t->value1, 0};
    t->t2 = (gm_table2){{N_X, axis_x}, {N_Y, axis_y}, t->value2[0], 0};
    t->t3 = (gm_table3){{N_X, axis_x}, {N_Y, axis_y}, {N_Z, axis_z}, t->value3[0][0]};
}

static gm_value1 fresh1(const gm_table1 *t, double x)
{
    gm_cell1 cell = {0};
    return gm_table1_at(t, 1, &cell, x);
}

static gm_value2 fresh2(const gm_table2 *t, double x, double y)
{
    gm_cell2 cell = {0};
    return gm_table2_at(t, 1, &cell, x, y);
}

/* Bit for bit. */
static void assert_same(double a, double b)
{
    assert_memory_equal(&a, &b, sizeof a);
}

static void every_node_is_exact(void **state)
{
    tables t;
    (void)state;
    fill(&t);
    for (int i = 0; i < N_X; i++) {
        const gm_value1 v1 = fresh1(&t.t1, axis_x[i]);
        assert_same(v1.value, t.value1[i]);
        assert_int_equal(v1.outside, 0);
        for (int j = 0; j < N_Y; j++) {
            const gm_value2 v2 = fresh2(&t.t2, axis_x[i], axis_y[j]);
            assert_same(v2.value, t.value2[i][j]);
            assert_int_equal(v2.outside, 0);
            for (int k = 0; k < N_Z; k++) {
                const gm_value3 v3 = gm_table3_at(&t.t3, axis_x[i], axis_y[j], axis_z[k]);
                assert_same(v3.value, t.value3[i][j][k]);
                assert_int_equal(v3.outside, 0);
            }
        }
    }
}

static void finds_the_cell_above_a_node(void **state)
{
    const gm_axis axis = {N_X, axis_x}, one = {1, axis_x};
    (void)state;
    assert_int_equal(gm_axis_find(&axis, -1), 0);
    assert_int_equal(gm_axis_find(&axis, 0), 0);
    assert_int_equal(gm_axis_find(&axis, 0.1), 1);
    assert_int_equal(gm_axis_find(&axis, 0.69), 1);
    assert_int_equal(gm_axis_find(&axis, 0.7), 2);
    assert_int_equal(gm_axis_find(&axis, 10), N_X - 2);
    assert_int_equal(gm_axis_find(&axis, 11), N_X - 2);
    assert_int_equal(gm_axis_find(&one, 11), 0);
}

static void clamps_and_flags_outside(void **state)
{
    tables t;
    (void)state;
    fill(&t);
    const gm_value1 below = fresh1(&t.t1, -2), above = fresh1(&t.t1, 1e9);
    assert_same(below.value, t.value1[0]);
    assert_same(above.value, t.value1[N_X - 1]);
    assert_true(below.outside && above.outside && below.dx == 0 && above.dx == 0);
    const gm_value2 v = fresh2(&t.t2, 1.5, 99);
    const gm_value2 edge = fresh2(&t.t2, 1.5, axis_y[N_Y - 1]);
    assert_same(v.value, edge.value);
    assert_same(v.dx, edge.dx);
    assert_true(v.dy == 0 && edge.dy != 0 && v.outside && !edge.outside);
    const gm_value3 w = gm_table3_at(&t.t3, -9, 0.1, 9);
    assert_same(w.value, gm_table3_at(&t.t3, 0, 0.1, 2).value);
    assert_true(w.outside && w.dx == 0 && w.dz == 0 && w.dy != 0);
}

static void gradient_is_the_difference_quotient_on_both_sides_of_every_node(void **state)
{
    tables t;
    (void)state;
    fill(&t);
    for (int i = 0; i < N_X - 1; i++) {
        const double slope =
            (t.value1[i + 1] - t.value1[i]) / (axis_x[i + 1] - axis_x[i]);
        /* the node belongs to the cell above; just below the next node still this cell */
        assert_near(fresh1(&t.t1, axis_x[i]).dx, slope, 1e-14);
        const double next = nextafter(axis_x[i + 1], -1);
        assert_near(fresh1(&t.t1, next).dx, slope, 1e-14);
    }
    assert_near(fresh1(&t.t1, 10).dx, fresh1(&t.t1, 9).dx, 1e-14);
}

static void gradients_agree_with_differences_in_every_cell(void **state)
{
    tables t;
    const double e = 1e-6; /* multilinear: only rounding, about 1e-16/1e-6 */
    (void)state;
    fill(&t);
    for (int n = 0; n < 2000; n++) {
        const double x = random_between(0, 9.9), y = random_between(-5, 6.9);
        const double z = random_between(-1, 1.9);
        const gm_value2 v = fresh2(&t.t2, x, y);
        const gm_value3 w = gm_table3_at(&t.t3, x, y, z);
        const gm_axis ax = {N_X, axis_x}, ay = {N_Y, axis_y}, az = {N_Z, axis_z};
        if (gm_axis_find(&ax, x) != gm_axis_find(&ax, x + e) ||
            gm_axis_find(&ay, y) != gm_axis_find(&ay, y + e) ||
            gm_axis_find(&az, z) != gm_axis_find(&az, z + e)) {
            continue; /* a node lies in between */
        }
        assert_near((fresh2(&t.t2, x + e, y).value - v.value) / e, v.dx, 1e-8);
        assert_near((fresh2(&t.t2, x, y + e).value - v.value) / e, v.dy, 1e-8);
        const gm_value3 wx = gm_table3_at(&t.t3, x + e, y, z);
        const gm_value3 wy = gm_table3_at(&t.t3, x, y + e, z);
        const gm_value3 wz = gm_table3_at(&t.t3, x, y, z + e);
        assert_near((wx.value - w.value) / e, w.dx, 1e-8);
        assert_near((wy.value - w.value) / e, w.dy, 1e-8);
        assert_near((wz.value - w.value) / e, w.dz, 1e-8);
    }
}

static void a_multilinear_function_is_reproduced(void **state)
{
    tables t;
    (void)state;
    fill(&t);
    for (int i = 0; i < N_X * N_Y * N_Z; i++) {
        const double x = axis_x[i / (N_Y * N_Z)], y = axis_y[i / N_Z % N_Y];
        (&t.value3[0][0][0])[i] = (1 + 2 * x) * (3 - y) * (0.5 + axis_z[i % N_Z]);
    }
    for (int n = 0; n < 200; n++) {
        const double x = random_between(0, 10), y = random_between(-5, 7);
        const double z = random_between(-1, 2);
        const gm_value3 v = gm_table3_at(&t.t3, x, y, z);
        const double truth = (1 + 2 * x) * (3 - y) * (0.5 + z);
        assert_near(v.value, truth, 1e-12 * 500); /* largest value is 420 */
        assert_near(v.dx, 2 * (3 - y) * (0.5 + z), 1e-12 * 500);
        assert_near(v.dy, -(1 + 2 * x) * (0.5 + z), 1e-12 * 500);
        assert_near(v.dz, (1 + 2 * x) * (3 - y), 1e-12 * 500);
    }
}

static void an_axis_of_one_node_is_a_constant_without_bounds(void **state)
{
    const double value[N_Y] = {1, 2, 4, 8}, lone[1] = {3};
    const gm_table1 t1 = {{1, lone}, value, 0};
    const gm_table2 flat_x = {{1, lone}, {N_Y, axis_y}, value, 0};
    const gm_table2 flat_y = {{N_Y, axis_y}, {1, lone}, value, 0};
    const gm_table3 flat = {{1, lone}, {N_Y, axis_y}, {1, lone}, value};
    const double far[4] = {-1e200, -7, 3, 1e200};
    (void)state;
    for (int i = 0; i < 4; i++) {
        assert_true(fresh1(&t1, far[i]).value == 1 && fresh1(&t1, far[i]).dx == 0);
        assert_int_equal(fresh1(&t1, far[i]).outside, 0);
        const gm_value2 a = fresh2(&flat_x, far[i], -0.05),
                        b = fresh2(&flat_y, -0.05, far[i]);
        const gm_value3 c = gm_table3_at(&flat, far[i], -0.05, far[3 - i]);
        assert_near(a.value, 3, 1e-14);
        assert_near(b.value, 3, 1e-14);
        assert_near(c.value, 3, 1e-14);
        assert_true(a.dx == 0 && b.dy == 0 && c.dx == 0 && c.dz == 0);
        assert_int_equal(a.outside + b.outside + c.outside, 0);
    }
}

/* Walks, jumps, nodes and edges; the same cells serve two tables in turn. */
static double wandering(int n, double low, double high, const double *axis, int n_axis)
{
    if (n % 7 == 0) {
        return axis[n / 7 % n_axis];
    }
    return n % 11 == 0 ? high + 1 : random_between(low, high);
}

static void the_cache_changes_no_bit(void **state)
{
    tables t, other;
    gm_cell1 c1 = {0};
    gm_cell2 c2 = {0};
    gm_cell3 c3 = {0};
    (void)state;
    fill(&t);
    other = t;
    for (int i = 0; i < N_X; i++) {
        other.value1[i] += 1;
        other.value2[i][1] += 1;
    }
    other.t1.value = other.value1;
    other.t2.value = other.value2[0];
    double x = 1, y = 0;
    for (int n = 0; n < 5000; n++) {
        if (n % 3 == 0) { /* else the point stays where it is */
            x = wandering(n, -0.1, 10.1, axis_x, N_X);
            y = wandering(n, -5.1, 7.1, axis_y, N_Y);
        }
        const double z = wandering(n, -1.1, 2.1, axis_z, N_Z);
        const tables *now = n % 5 == 0 ? &other : &t;
        const int number = n % 5 == 0 ? 2 : 1;
        const gm_value1 a = gm_table1_at(&now->t1, number, &c1, x),
                        a0 = fresh1(&now->t1, x);
        const gm_value2 b = gm_table2_at(&now->t2, number, &c2, x, y);
        const gm_value2 b0 = fresh2(&now->t2, x, y);
        const gm_value3 c = gm_table3_cached(&t.t3, 1, &c3, x, y, z);
        const gm_value3 c0 = gm_table3_at(&t.t3, x, y, z);
        assert_same(a.value, a0.value);
        assert_same(a.dx, a0.dx);
        assert_same(b.value, b0.value);
        assert_same(b.dx, b0.dx);
        assert_same(b.dy, b0.dy);
        assert_same(c.value, c0.value);
        assert_same(c.dx, c0.dx);
        assert_same(c.dy, c0.dy);
        assert_same(c.dz, c0.dz);
        assert_true(a.outside == a0.outside && b.outside == b0.outside);
        assert_int_equal(c.outside, c0.outside);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_node_is_exact),
        cmocka_unit_test(finds_the_cell_above_a_node),
        cmocka_unit_test(clamps_and_flags_outside),
        cmocka_unit_test(gradient_is_the_difference_quotient_on_both_sides_of_every_node),
        cmocka_unit_test(gradients_agree_with_differences_in_every_cell),
        cmocka_unit_test(a_multilinear_function_is_reproduced),
        cmocka_unit_test(an_axis_of_one_node_is_a_constant_without_bounds),
        cmocka_unit_test(the_cache_changes_no_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
