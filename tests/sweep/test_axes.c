/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/axes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

static gm_nodes nodes;

static void assert_near(double a, double b, double tolerance)
{
    if (!(fabs(a - b) <= tolerance))
        fail_msg("%.17g is not %.17g", a, b);
}

static void assert_increasing(void)
{
    for (int i = 1; i < nodes.n; i++)
        assert_true(nodes.x[i] > nodes.x[i - 1]);
}

static void power_axis_starts_at_zero_and_ends_at_max(void **state)
{
    (void)state;
    gm_nodes_power(35, 675.4, 3.0, &nodes);
    assert_int_equal(nodes.n, 35);
    assert_true(nodes.x[0] == 0.0 && nodes.x[34] == 675.4);
    assert_near(nodes.x[17], 675.4 / 8.0, 1e-12); /* (1/2)^3 of it, to rounding */
    assert_increasing();
}

/* Interpolating x^q on nodes (i/n)^(2/q) leaves the same error in every cell: that is why
   the power was chosen. */
static void power_axis_spreads_the_error_of_a_root_evenly(void **state)
{
    (void)state;
    const double q = 0.6;
    double least = HUGE_VAL, most = 0.0;
    gm_nodes_power(30, 1.0, 2.0 / q, &nodes);
    for (int i = 1; i + 1 < nodes.n; i++) { /* the first cell has no curvature at 0 */
        double a = nodes.x[i], b = nodes.x[i + 1], m = 0.5 * (a + b);
        double error = pow(m, q) - 0.5 * (pow(a, q) + pow(b, q));
        least = fmin(least, error);
        most = fmax(most, error);
    }
    assert_true(least > 0.0 && most < 2.0 * least);
}

/* Even at first, in equal ratios far above the share: what v^-0.2 wants. */
static void growth_axis_is_even_and_then_geometric(void **state)
{
    (void)state;
    gm_nodes_growth(61, 1000.0, 0.001, &nodes);
    assert_true(nodes.x[0] == 0.0 && nodes.x[60] == 1000.0);
    assert_increasing();
    double first = nodes.x[1], second = nodes.x[2] - nodes.x[1];
    assert_true(second / first < 1.13); /* (1 + 1000)^(1/60) = 1.122 */
    for (int i = 40; i < 60; i++)       /* a / x < 1 % of the ratio there */
        assert_near(nodes.x[i + 1] / nodes.x[i], pow(1001.0, 1.0 / 60.0), 0.01);
}

static void uniform_axis_has_every_step_and_the_end(void **state)
{
    (void)state;
    assert_int_equal(gm_nodes_uniform(6450.0, 150.0, "speed", &nodes, NULL), GM_OK);
    assert_int_equal(nodes.n, 44);
    assert_true(nodes.x[1] == 150.0 && nodes.x[43] == 6450.0);
    assert_int_equal(gm_nodes_uniform(1.0, 0.3, "speed", &nodes, NULL), GM_OK);
    assert_int_equal(nodes.n, 5);
    assert_true(nodes.x[4] == 1.0);
    assert_increasing();
    assert_int_equal(gm_nodes_uniform(1.0, 7.0, "speed", &nodes, NULL), GM_OK);
    assert_int_equal(nodes.n, 2);
}

static void uniform_axis_does_not_double_its_end_by_rounding(void **state)
{
    (void)state;
    double step = 0.1; /* 3 * 0.1 > 0.3 in binary */
    assert_int_equal(gm_nodes_uniform(0.3, step, "speed", &nodes, NULL), GM_OK);
    assert_int_equal(nodes.n, 4);
    assert_int_equal(gm_nodes_uniform(step * 7 / 7 * 3, step, "speed", &nodes, NULL),
                     GM_OK);
    assert_int_equal(nodes.n, 4);
}

static void too_small_a_step_is_refused_and_nothing_changes(void **state)
{
    (void)state;
    gm_error error = {GM_OK, ""};
    gm_nodes_power(3, 1.0, 1.0, &nodes);
    assert_int_equal(gm_nodes_uniform(1.0, 1e-9, "speed", &nodes, &error),
                     GM_ERR_ARGUMENT);
    assert_non_null(strstr(error.message, "speed axis"));
    assert_int_equal(nodes.n, 3);
}

static void a_kink_becomes_a_node(void **state)
{
    (void)state;
    gm_nodes_power(5, 16.0, 1.0, &nodes);
    gm_nodes_include(5.0, 6, &nodes);
    assert_int_equal(nodes.n, 6);
    assert_true(nodes.x[2] == 5.0);
    assert_increasing();
}

static void a_kink_on_a_full_axis_moves_the_nearest_inner_node(void **state)
{
    (void)state;
    gm_nodes_power(5, 16.0, 1.0, &nodes);
    gm_nodes_include(5.0, 5, &nodes);
    assert_int_equal(nodes.n, 5);
    assert_true(nodes.x[1] == 5.0 && nodes.x[2] == 8.0);
    gm_nodes_include(0.5, 5, &nodes);
    assert_true(nodes.x[0] == 0.0 && nodes.x[1] == 0.5);
    gm_nodes_include(15.9, 5, &nodes);
    assert_true(nodes.x[4] == 16.0 && nodes.x[3] == 15.9);
    assert_increasing();
}

static void kinks_outside_or_on_nodes_change_nothing(void **state)
{
    (void)state;
    const double outside[] = {-1.0, 0.0, 16.0, 17.0, 4.0, 4.0 * (1.0 + 1e-12)};
    gm_nodes_power(5, 16.0, 1.0, &nodes);
    for (int i = 0; i < 6; i++)
        gm_nodes_include(outside[i], 40, &nodes);
    assert_int_equal(nodes.n, 5);
    assert_true(nodes.x[1] == 4.0);
}

static void mirrored_axis_is_odd(void **state)
{
    (void)state;
    gm_nodes_power(14, 250.0, 3.0, &nodes);
    gm_nodes_mirror(&nodes, &nodes);
    assert_int_equal(nodes.n, 27);
    assert_true(nodes.x[13] == 0.0);
    for (int i = 0; i < 27; i++)
        assert_true(nodes.x[i] == -nodes.x[26 - i]);
    assert_increasing();
}

static void extension_reaches_its_end_in_equal_ratios(void **state)
{
    (void)state;
    gm_nodes_power(5, 10.0, 1.0, &nodes);
    gm_nodes_extend(80.0, 3, &nodes);
    assert_int_equal(nodes.n, 8);
    assert_near(nodes.x[5], 20.0, 1e-12); /* rounding of pow */
    assert_near(nodes.x[6], 40.0, 1e-12);
    assert_true(nodes.x[7] == 80.0);
    gm_nodes_scale(0.5, &nodes);
    assert_true(nodes.x[7] == 40.0 && nodes.x[0] == 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(power_axis_starts_at_zero_and_ends_at_max),
        cmocka_unit_test(power_axis_spreads_the_error_of_a_root_evenly),
        cmocka_unit_test(growth_axis_is_even_and_then_geometric),
        cmocka_unit_test(uniform_axis_has_every_step_and_the_end),
        cmocka_unit_test(uniform_axis_does_not_double_its_end_by_rounding),
        cmocka_unit_test(too_small_a_step_is_refused_and_nothing_changes),
        cmocka_unit_test(a_kink_becomes_a_node),
        cmocka_unit_test(a_kink_on_a_full_axis_moves_the_nearest_inner_node),
        cmocka_unit_test(kinks_outside_or_on_nodes_change_nothing),
        cmocka_unit_test(mirrored_axis_is_odd),
        cmocka_unit_test(extension_reaches_its_end_in_equal_ratios),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
