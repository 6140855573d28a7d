/* SPDX-License-Identifier: BSD-2-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/alloc.h"
#include "vehicle/gm_compare.h"
#include "vehicle/low_pass.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846
#define STEP 0.005
enum { N = 39001 }; /* 195 s */

/* ---- the filter ---- */

static void fill_sine(double hertz, int n, double *x)
{
    for (int i = 0; i < n; i++)
        x[i] = sin(2.0 * PI * hertz * i * STEP);
}

/* Twice Butterworth of second order: |H|^2 = 1 / (1 + (f / f_c)^4), phase zero. Compared
 * in the middle, where the edges have died away; the bilinear transform's warping moves
 * 2 Hz by less than 1e-3 at this step. */
static void filter_has_its_known_response(void **state)
{
    (void)state;
    static double x[4001], y[4001];
    const double hertz[] = {0.5, 2.0, 5.0, 20.0};
    for (int k = 0; k < 4; k++) {
        fill_sine(hertz[k], 4001, x);
        memcpy(y, x, sizeof y);
        gm_low_pass(5.0, STEP, 4001, y);
        double warped = tan(PI * hertz[k] * STEP) / tan(PI * 5.0 * STEP);
        double gain = 1.0 / (1.0 + warped * warped * warped * warped);
        for (int i = 1500; i < 2500; i++)
            assert_true(fabs(y[i] - gain * x[i]) < 1e-6);
    }
}

static void filter_keeps_a_constant(void **state)
{
    (void)state;
    double x[50];
    for (int i = 0; i < 50; i++)
        x[i] = 3.0;
    gm_low_pass(5.0, STEP, 50, x);
    for (int i = 0; i < 50; i++)
        assert_true(fabs(x[i] - 3.0) < 1e-12);
}

/* ---- the comparison ---- */

static const gm_transmission dct = {
    .n_paths = 2, .n_gears = 3, .gear = {{1, 0, 16.7}, {2, 1, 10.1}, {3, 0, 6.8}}};

typedef struct fixture {
    gm_gear_plan *plan;
    gm_record detailed, reduced;
} fixture;

static void drive(gm_record *r, const gm_gear_plan *plan)
{
    r->step = STEP;
    r->n = N;
    r->sample = gm_calloc(N, sizeof *r->sample);
    assert_non_null(r->sample);
    for (int i = 0; i < N; i++) {
        double t = i * STEP;
        gm_trip_view *v = &r->sample[i].view;
        v->speed = 5.0 + sin(0.1 * t);
        v->engine_speed = 200.0 + 50.0 * sin(0.2 * t);
        v->output_torque = 300.0 + 100.0 * sin(0.3 * t);
        v->gearset_work = 100.0 * t;
        gm_gear_plan_gears(plan, t, v->gear);
        v->state[0] = v->state[1] = 2;
    }
    r->work.cpu = 10.0;
}

static void set_up(fixture *f)
{
    gm_cycle *cycle = NULL;
    gm_error error;
    gm_vehicle vehicle = gm_vehicle_reference();
    memset(f, 0, sizeof *f);
    assert_int_equal(gm_cycle_named("ece15", &cycle, &error), GM_OK);
    assert_int_equal(gm_gear_plan_create(cycle, &vehicle, &dct, &f->plan, &error), GM_OK);
    gm_cycle_destroy(cycle);
    drive(&f->detailed, f->plan);
    drive(&f->reduced, f->plan);
}

static void tear_down(fixture *f)
{
    gm_free(f->detailed.sample);
    gm_free(f->reduced.sample);
    gm_gear_plan_destroy(f->plan);
}

static gm_comparison compare(const fixture *f)
{
    gm_comparison c;
    gm_error error;
    assert_int_equal(gm_compare(&f->detailed, &f->reduced, f->plan, &c, &error), GM_OK);
    return c;
}

static void equal_drives_do_not_differ(void **state)
{
    (void)state;
    fixture f;
    set_up(&f);
    gm_comparison c = compare(&f);
    assert_true(c.engine_speed.rms == 0.0 && c.output_torque.largest == 0.0);
    assert_true(c.loss_relative == 0.0 && c.cpu_saved == 0.0);
    assert_int_equal(c.n_shifts, 6);
    assert_true(c.shift[0].engaged_detailed == c.shift[0].engaged_reduced);
    double time = 0.0, loss = 0.0;
    for (int i = 0; i < c.n_gears; i++) {
        time += c.gear[i].time;
        loss += c.gear[i].detailed;
    }
    assert_true(fabs(time - 195.0) < 1e-6);
    assert_true(fabs(loss - c.loss_detailed) < 1e-6);
    gm_comparison_clear(&c);
    tear_down(&f);
}

/* Differences that are put in are those that are found. */
static void known_differences_are_found(void **state)
{
    (void)state;
    fixture f;
    set_up(&f);
    f.reduced.work.cpu = 0.5;
    for (int i = 0; i < N; i++) {
        double t = i * STEP;
        gm_trip_view *v = &f.reduced.sample[i].view;
        v->engine_speed += 0.5;
        v->gearset_work *= 1.01;
        /* a pulse of a second in the cruise at 70 s, a whistle of 100 Hz all over */
        if (fabs(t - 70.0) < 0.5)
            v->output_torque += 30.0;
        v->output_torque += i % 2 ? 5.0 : -5.0;
    }
    gm_comparison c = compare(&f);
    assert_true(fabs(c.engine_speed.rms - 0.5) < 1e-12);
    assert_true(fabs(c.loss_relative - 0.01) < 1e-9);
    assert_true(fabs(c.cpu_saved - 0.95) < 1e-12);
    assert_true(fabs(c.worst[0].time - 70.0) < 0.6);
    /* the filter overshoots a pulse by a few per cent; the whistle is gone */
    assert_true(fabs(c.worst[0].difference) > 29.0 && fabs(c.worst[0].difference) < 33.0);
    assert_int_equal(c.worst[0].cause, GM_CAUSE_TABLES);
    assert_true(fabs(c.output_torque.rms - sqrt(900.0 / 195.0)) < 0.1);
    gm_comparison_clear(&c);
    tear_down(&f);
}

static void unequal_records_are_refused(void **state)
{
    (void)state;
    fixture f;
    gm_error error;
    gm_comparison c;
    set_up(&f);
    f.reduced.n--;
    assert_int_equal(gm_compare(&f.detailed, &f.reduced, f.plan, &c, &error),
                     GM_ERR_ARGUMENT);
    f.reduced.n++;
    for (int k = 1; k <= 3; k++) {
        gm_alloc_fail_after(k);
        gm_status status = gm_compare(&f.detailed, &f.reduced, f.plan, &c, &error);
        gm_alloc_fail_after(0);
        assert_int_equal(status, GM_ERR_MEMORY);
    }
    tear_down(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(filter_has_its_known_response),
        cmocka_unit_test(filter_keeps_a_constant),
        cmocka_unit_test(equal_drives_do_not_differ),
        cmocka_unit_test(known_differences_are_found),
        cmocka_unit_test(unequal_records_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
