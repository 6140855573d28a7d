/* SPDX-License-Identifier: BSD-2-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/alloc.h"
#include "vehicle/cycle_data.h"
#include "vehicle/gm_cycle.h"

#include <math.h>
#include <string.h>

static gm_cycle *named(const char *name)
{
    gm_cycle *cycle = NULL;
    gm_error error;
    assert_int_equal(gm_cycle_named(name, &cycle, &error), GM_OK);
    return cycle;
}

/* Distances: integral of the regulation's own points, in metres. */
static void cycles_have_their_length(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double duration, distance;
    } known[] = {{"ece15", 195.0, 1018.333},
                 {"urban", 780.0, 4 * 1018.333},
                 {"eudc", 400.0, 6954.861},
                 {"nedc", 1180.0, 11028.194},
                 {"wltc3b", 1800.0, 23266.28}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        gm_cycle *c = named(known[i].name);
        assert_true(gm_cycle_duration(c) == known[i].duration);
        assert_true(fabs(gm_cycle_distance(c) - known[i].distance) < 0.005);
        gm_cycle_destroy(c);
    }
}

/* Check sums of UN GTR 15, annex 1, in tenths of km/h. */
static void wltc_has_the_regulations_sums(void **state)
{
    (void)state;
    static const struct {
        int first, last, sum;
    } part[] = {{0, 589, 111403},
                {590, 1022, 171212},
                {1023, 1477, 257822},
                {1478, 1800, 297149}};
    for (int k = 0; k < 4; k++) {
        int sum = 0;
        for (int i = part[k].first; i <= part[k].last; i++)
            sum += gm_wltc_class3b[i];
        assert_int_equal(sum, part[k].sum);
    }
}

/* The regulation's shares of the elementary cycle: 60 s idle with 5 s in gear among them,
 * 57 s of steady speed. */
static void ece15_stands_and_holds_as_the_regulation_says(void **state)
{
    (void)state;
    double stands = 0.0, steady = 0.0;
    for (int i = 1; i < GM_ECE15_POINTS; i++) {
        double dt = gm_ece15[i].time - gm_ece15[i - 1].time;
        if (gm_ece15[i].speed == gm_ece15[i - 1].speed)
            *(gm_ece15[i].speed == 0 ? &stands : &steady) += dt;
    }
    assert_true(stands == 60.0);
    /* 57 s and the 2 s at 15 and 35 km/h in each of four gear changes */
    assert_true(steady == 57.0 + 4 * 2.0);
}

static void smoothing_keeps_distance_and_stays_near(void **state)
{
    (void)state;
    gm_cycle *c = named("nedc");
    double distance = 0.0, before, a_before, a;
    const double h = 0.01;
    before = gm_cycle_speed(c, 0.0, &a_before);
    for (int i = 1; i <= 118000; i++) {
        double t = i * h, v = gm_cycle_speed(c, t, &a);
        assert_true(v >= 0.0);
        /* between its ends a cycle's jerk is at most 2 x 1.4 m/s2 over the smoothing */
        assert_true(fabs(a - a_before) <= 3.0 * h / GM_CYCLE_SMOOTHING);
        assert_true(fabs(v - before - 0.5 * h * (a + a_before)) < 1e-4);
        distance += 0.5 * h * (v + before);
        before = v;
        a_before = a;
    }
    assert_true(fabs(distance - gm_cycle_distance(c)) < 1e-3);
    for (int i = 0; i < c->n; i++)
        assert_true(fabs(gm_cycle_speed(c, c->time[i], &a) - c->speed[i]) < 0.35);
    gm_cycle_destroy(c);
}

/* Between the times that gm_cycle_next names, the acceleration is a straight line. */
static void laws_change_where_it_is_said(void **state)
{
    (void)state;
    gm_cycle *c = named("ece15");
    int n = 0;
    double t = 0.0, next = gm_cycle_next(c, 0.0);
    for (; isfinite(next); t = next, next = gm_cycle_next(c, t), n++) {
        double a[3], third = (next - t) / 4.0;
        assert_true(next > t);
        for (int k = 0; k < 3; k++)
            (void)gm_cycle_speed(c, t + (k + 1) * third, &a[k]);
        assert_true(fabs(a[0] - 2.0 * a[1] + a[2]) < 1e-12);
    }
    assert_true(n > GM_ECE15_POINTS && n < 2 * GM_ECE15_POINTS);
    gm_cycle_destroy(c);
}

static void broken_cycles_are_refused(void **state)
{
    (void)state;
    gm_cycle *c = NULL;
    gm_error error;
    const double late[] = {1.0, 2.0}, back[] = {0.0, 0.0}, fine[] = {0.0, 1.0};
    const double speed[] = {0.0, 1.0}, negative[] = {0.0, -1.0},
                 nan_[] = {0.0, (double)NAN};
    assert_int_equal(gm_cycle_named("ftp75", &c, &error), GM_ERR_ARGUMENT);
    assert_non_null(strstr(error.message, "wltc3b"));
    assert_int_equal(gm_cycle_create("x", 2, late, speed, 0, NULL, &c, &error),
                     GM_ERR_ARGUMENT);
    assert_int_equal(gm_cycle_create("x", 2, back, speed, 0, NULL, &c, &error),
                     GM_ERR_ARGUMENT);
    assert_int_equal(gm_cycle_create("x", 2, fine, negative, 0, NULL, &c, &error),
                     GM_ERR_ARGUMENT);
    assert_int_equal(gm_cycle_create("x", 2, fine, nan_, 0, NULL, &c, &error),
                     GM_ERR_ARGUMENT);
    assert_int_equal(gm_cycle_create("x", 1, fine, speed, 0, NULL, &c, &error),
                     GM_ERR_ARGUMENT);
    assert_null(c);
}

static void no_memory_is_an_error(void **state)
{
    (void)state;
    gm_cycle *c = NULL;
    gm_error error;
    gm_status status = GM_ERR_MEMORY;
    for (int k = 1; status != GM_OK; k++) {
        gm_alloc_fail_after(k);
        status = gm_cycle_named("ece15", &c, &error);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || (status == GM_ERR_MEMORY && !c));
        assert_true(k < 20);
    }
    gm_cycle_destroy(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cycles_have_their_length),
        cmocka_unit_test(wltc_has_the_regulations_sums),
        cmocka_unit_test(ece15_stands_and_holds_as_the_regulation_says),
        cmocka_unit_test(smoothing_keeps_distance_and_stays_near),
        cmocka_unit_test(laws_change_where_it_is_said),
        cmocka_unit_test(broken_cycles_are_refused),
        cmocka_unit_test(no_memory_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
