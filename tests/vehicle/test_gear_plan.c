/* SPDX-License-Identifier: BSD-2-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/alloc.h"
#include "vehicle/gear_plan.h"

#include <math.h>

static const gm_transmission dct = {.n_paths = 2,
                                    .n_gears = 7,
                                    .gear = {{1, 0, 16.7},
                                             {2, 1, 10.1},
                                             {3, 0, 6.8},
                                             {4, 1, 5.0},
                                             {5, 0, 3.8},
                                             {6, 1, 3.1},
                                             {7, 0, 2.6}}};
static const gm_transmission manual = {
    .n_paths = 1,
    .n_gears = 5,
    .gear = {{1, 0, 13.9}, {2, 0, 8.2}, {3, 0, 5.4}, {4, 0, 3.9}, {5, 0, 3.2}}};
static const gm_transmission single = {.n_paths = 1, .n_gears = 1, .gear = {{1, 0, 8.3}}};

static const char *const cycles[] = {"ece15", "urban", "eudc", "nedc", "wltc3b"};

static gm_gear_plan *plan_of(const char *name, const gm_transmission *t)
{
    gm_cycle *cycle = NULL;
    gm_gear_plan *plan = NULL;
    gm_error error;
    gm_vehicle v = gm_vehicle_reference();
    assert_int_equal(gm_cycle_named(name, &cycle, &error), GM_OK);
    assert_int_equal(gm_gear_plan_create(cycle, &v, t, &plan, &error), GM_OK);
    gm_cycle_destroy(cycle);
    return plan;
}

/* A path carries torque only in gear; two paths always share the whole capacity. */
static void check_plan(const char *name, const gm_transmission *t)
{
    gm_gear_plan *plan = plan_of(name, t);
    int before[GM_MAX_INPUT_PATHS], gear[GM_MAX_INPUT_PATHS];
    gm_gear_plan_gears(plan, 0.0, before);
    for (double time = 0.0; time < 1800.0; time += 0.05) {
        double sum = 0.0;
        gm_gear_plan_gears(plan, time, gear);
        for (int p = 0; p < t->n_paths; p++) {
            double share = gm_gear_plan_share(plan, p, time);
            assert_true(share >= 0.0 && share <= 1.0);
            assert_true(share == 0.0 || gear[p] != 0);
            /* a gear changes under an open clutch only */
            assert_true(gear[p] == before[p] || share < 0.35);
            sum += share;
            before[p] = gear[p];
        }
        assert_true(t->n_paths == 1 || sum <= 1.0 + 1e-12);
        double ratio = gm_gear_plan_ratio(plan, time);
        assert_true(ratio <= t->gear[0].ratio + 1e-12 &&
                    ratio >= t->gear[t->n_gears - 1].ratio - 1e-12);
    }
    for (int i = 1; i < plan->n_commands; i++)
        assert_true(plan->commands[i].time >= plan->commands[i - 1].time);
    gm_gear_plan_destroy(plan);
}

static void plans_make_sense_for_every_cycle(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof cycles / sizeof cycles[0]; i++) {
        check_plan(cycles[i], &dct);
        check_plan(cycles[i], &manual);
        check_plan(cycles[i], &single);
    }
}

static void next_gear_waits_before_the_clutches_hand_over(void **state)
{
    (void)state;
    gm_gear_plan *plan = plan_of("ece15", &dct);
    int gear[GM_MAX_INPUT_PATHS];
    gm_gear_plan_gears(plan, 52.4, gear);
    assert_true(gear[0] == 1 && gear[1] == 0);
    gm_gear_plan_gears(plan, 52.6, gear);
    assert_true(gear[0] == 1 && gear[1] == 2);
    assert_true(gm_gear_plan_share(plan, 0, 53.9) == 1.0);
    assert_true(fabs(gm_gear_plan_share(plan, 0, 54.2) - 0.5) < 1e-12);
    assert_true(gm_gear_plan_share(plan, 1, 54.5) == 1.0);
    assert_true(gm_gear_plan_next(plan, 53.0) == 54.0);
    assert_true(fabs(gm_gear_plan_next(plan, 54.0) - 54.4) < 1e-12);
    gm_gear_plan_destroy(plan);
}

static void no_memory_is_an_error(void **state)
{
    (void)state;
    gm_cycle *cycle = NULL;
    gm_gear_plan *plan = NULL;
    gm_error error;
    gm_vehicle v = gm_vehicle_reference();
    gm_status status = GM_ERR_MEMORY;
    assert_int_equal(gm_cycle_named("nedc", &cycle, &error), GM_OK);
    for (int k = 1; status != GM_OK; k++) {
        gm_alloc_fail_after(k);
        status = gm_gear_plan_create(cycle, &v, &dct, &plan, &error);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || (status == GM_ERR_MEMORY && !plan));
        assert_true(k < 20);
    }
    gm_gear_plan_destroy(plan);
    plan = NULL;
    gm_transmission none = {.n_paths = 1};
    assert_int_equal(gm_gear_plan_create(cycle, &v, &none, &plan, &error),
                     GM_ERR_ARGUMENT);
    gm_cycle_destroy(cycle);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plans_make_sense_for_every_cycle),
        cmocka_unit_test(next_gear_waits_before_the_clutches_hand_over),
        cmocka_unit_test(no_memory_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
