/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The component of a gearset with one path: names, value references, a reducer that
 * turns backwards, instantaneous engagement.
 */
#include "fmi2_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static void the_second_path_does_not_exist(void **state)
{
    host h;
    unsigned vr = reference(GM_PATH_TAU, 1);
    (void)state;
    fmi2Component c = host_initialise(&h);
    assert_refused(&h, fmi2GetReal(c, &vr, 1, &(double){0}), "reference", NULL);
    fmi2FreeInstance(c);
}

static void messages_name_the_input_path(void **state)
{
    host h;
    unsigned vr = reference(GM_PATH_TAU, 0);
    (void)state;
    fmi2Component c = host_initialise(&h);
    assert_refused(&h, fmi2SetReal(c, &vr, 1, &(double){(double)NAN}), "input.tau", "nan",
                   NULL);
    fmi2FreeInstance(c);
}

static void an_infinite_capacity_starts_as_1e30(void **state)
{
    host h;
    (void)state;
    fmi2Component c = host_initialise(&h);
    assert_true(get(c, GM_PATH_SYNC_TORQUE, 0) == 1e30);
    fmi2FreeInstance(c);
}

/* Momentum: J_o w_o = (J_o + r^2 J_p) w; the input shaft was at rest. */
static void infinite_capacity_engages_in_one_step(void **state)
{
    host h;
    (void)state;
    fmi2Component c = host_initialise(&h);
    set(c, GM_OUTPUT_W_START, 0, 40);
    set(c, GM_LOSS_SCALE, 0, 0);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    set_integer(c, GM_PATH_GEAR, 0, 1);
    assert_int_equal(fmi2DoStep(c, 0, 0.001, fmi2True), fmi2OK);
    double w = 0.05 * 40 / (0.05 + 81 * 0.02);
    assert_int_equal(get_integer(c, GM_PATH_STATE, 0), GM_PATH_ENGAGED);
    assert_true(fabs(get(c, GM_OUTPUT_W, 0) - w) < 1e-12 * w);
    assert_true(get(c, GM_PATH_W, 0) == -9.0 * get(c, GM_OUTPUT_W, 0));
    double lost = 0.5 * 0.05 * 40 * 40 - 0.5 * (0.05 + 81 * 0.02) * w * w;
    assert_true(fabs(get(c, GM_LOSS_ENERGY, 0) - lost) < 1e-12 * lost);
    fmi2FreeInstance(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_second_path_does_not_exist),
        cmocka_unit_test(messages_name_the_input_path),
        cmocka_unit_test(an_infinite_capacity_starts_as_1e30),
        cmocka_unit_test(infinite_capacity_engages_in_one_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
