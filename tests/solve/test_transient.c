/* SPDX-License-Identifier: BSD-2-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/alloc.h"
#include "solve/gm_driven.h"
#include "toy_drive.h"
#include "toy_dynamics.h"

#include <math.h>
#include <string.h>

typedef struct rig {
    toy toy;
    gm_dynamics dynamics;
    toy_drive drive;
    gm_drive calls;
    gm_transient_options options;
    double speed[2];
    gm_driven *driven;
    gm_transient *transient;
    gm_error error;
} rig;

static void prepare(rig *r, toy_kind kind)
{
    memset(r, 0, sizeof *r);
    r->toy = (toy){.kind = kind, .inertia = {2.0, 0.5}};
    r->drive.change = (double)INFINITY;
    r->calls = toy_drive_calls(&r->drive);
    r->options.tolerance = 1e-7;
}

static gm_status open_rig(rig *r)
{
    r->dynamics = toy_dynamics(&r->toy);
    gm_status status =
        gm_driven_create(&r->dynamics, &r->calls, 0.0, r->speed, &r->driven, &r->error);
    if (status != GM_OK)
        return status;
    gm_transient_system system = gm_driven_system(r->driven);
    status = gm_transient_create(&system, &r->options, &r->transient, &r->error);
    return status == GM_OK ? gm_transient_start(r->transient, 0.0, &r->error) : status;
}

static void close_rig(rig *r)
{
    gm_transient_destroy(r->transient);
    gm_driven_destroy(r->driven);
}

static void open_well(rig *r)
{
    assert_int_equal(open_rig(r), GM_OK);
}

static const double *reach(rig *r, double t)
{
    assert_int_equal(gm_transient_advance(r->transient, t, &r->error), GM_OK);
    assert_true(gm_transient_time(r->transient) == t);
    return gm_transient_state(r->transient);
}

/* Residual of the account relative to what passed. */
static double open_balance(const rig *r)
{
    gm_transient_energy e = gm_transient_account(r->transient);
    double scale = fmax(e.through, fmax(e.stored, e.stored_start));
    return fabs(e.residual) / scale;
}

/* ---- closed forms ---- */

/* Two bodies on a spring without damping: the twist is a sine of the relative speed. */
static void oscillator_swings_as_the_closed_form(int no_jacobian)
{
    rig r;
    prepare(&r, TOY_OSCILLATOR);
    r.toy.stiffness = 100.0;
    r.toy.no_jacobian = no_jacobian;
    r.speed[0] = 1.0;
    open_well(&r);
    double reduced = 1.0 / (1.0 / 2.0 + 1.0 / 0.5), w = sqrt(100.0 / reduced);
    for (int i = 1; i <= 20; i++) {
        double t = 0.05 * i;
        const double *x = reach(&r, t);
        /* global error: some hundred steps of local error 1e-7 each */
        assert_true(fabs(x[0] - sin(w * t) / w) < 1e-4);
        assert_true(fabs(2.0 * x[1] + 0.5 * x[2] - 2.0) < 1e-5);
    }
    assert_true(open_balance(&r) < 1e-4);
    close_rig(&r);
}

static void oscillator_swings_by_jacobian(void **state)
{
    (void)state;
    oscillator_swings_as_the_closed_form(0);
}

static void oscillator_swings_by_differences(void **state)
{
    (void)state;
    oscillator_swings_as_the_closed_form(1);
}

/* Body 0 turns at a given speed: body 1 swings behind it, and the torque found at body 0
 * is what the spring, its drag and its inertia take. */
static void driven_speed_is_exact(int no_jacobian)
{
    rig r;
    prepare(&r, TOY_OSCILLATOR);
    r.toy.stiffness = 100.0;
    r.toy.drag = 0.3;
    r.toy.no_jacobian = no_jacobian;
    r.calls.driven[0] = 1;
    r.drive.before.acceleration[0] = 4.0;
    open_well(&r);
    double w = sqrt(100.0 / 0.5);
    for (int i = 1; i <= 10; i++) {
        double t = 0.1 * i;
        const double *x = reach(&r, t);
        /* twist z: z'' = 4 - w^2 z from rest */
        double z = 4.0 / (w * w) * (1.0 - cos(w * t));
        gm_motion_input input;
        assert_int_equal(gm_driven_input(r.driven, t, x, &input), 0);
        assert_true(fabs(x[1] - 4.0 * t) < 1e-9);
        assert_true(fabs(x[0] - z) < 1e-4);
        double torque = 2.0 * 4.0 + 100.0 * x[0] + 0.3 * x[1];
        assert_true(fabs(input.torque[0] - torque) < 1e-9);
    }
    assert_true(open_balance(&r) < 1e-5);
    close_rig(&r);
}

static void driven_speed_is_exact_by_jacobian(void **state)
{
    (void)state;
    driven_speed_is_exact(0);
}

static void driven_speed_is_exact_by_differences(void **state)
{
    (void)state;
    driven_speed_is_exact(1);
}

/* A speed that jumps: the flange's own body jumps, its energy is work of the outside. */
static void a_jump_of_speed_is_work(void **state)
{
    (void)state;
    rig r;
    prepare(&r, TOY_OSCILLATOR);
    r.calls.driven[0] = 1;
    r.drive.change = 0.5;
    r.drive.after.speed[0] = 3.0;
    open_well(&r);
    assert_true(reach(&r, 0.5)[1] == 0.0);
    assert_true(reach(&r, 0.75)[1] == 3.0);
    gm_transient_energy e = gm_transient_account(r.transient);
    assert_true(fabs(e.work - 0.5 * 2.0 * 9.0) < 1e-12 && fabs(e.residual) < 1e-12);
    close_rig(&r);
}

/* Bounces of height 1, 0.64, ... under unit weight: 2 J, gravity 2 N.m. */
static void ball_bounces_at_the_right_times(void **state)
{
    (void)state;
    rig r;
    prepare(&r, TOY_BALL);
    r.toy.gravity = 2.0;
    r.toy.restitution = 0.8;
    open_well(&r);
    double first = sqrt(2.0), second = first * (1.0 + 2.0 * 0.8);
    assert_true(fabs(reach(&r, first)[0]) < 1e-6);
    double t = second - first;
    (void)reach(&r, 0.5 * (first + second));
    assert_true(fabs(gm_transient_state(r.transient)[0] - 0.125 * t * t) < 1e-6);
    (void)reach(&r, second + 0.1);
    gm_transient_energy e = gm_transient_account(r.transient);
    /* each bounce loses 36 % of what is left of 2 J */
    assert_true(fabs(e.impulses - 2.0 * (1.0 - pow(0.8, 4))) < 1e-5);
    assert_true(open_balance(&r) < 1e-6);
    assert_int_equal(gm_transient_work(r.transient).events, 2);
    close_rig(&r);
}

/* ... which pile up before t = 9 sqrt(2): infinitely many of them in finite time. The
 * solver comes through to what is left, a ball on the ground. */
static void bounces_that_pile_up_end_at_rest(void **state)
{
    (void)state;
    rig r;
    prepare(&r, TOY_BALL);
    r.toy.gravity = 2.0;
    r.toy.restitution = 0.8;
    open_well(&r);
    assert_true(fabs(reach(&r, 13.0)[0]) < 1e-5);
    assert_true(fabs(gm_transient_account(r.transient).impulses - 2.0) < 1e-4);
    close_rig(&r);
}

static void a_plant_that_never_settles_is_refused(void **state)
{
    (void)state;
    rig r;
    prepare(&r, TOY_RESTLESS);
    r.options.step_max = 1e-13;
    open_well(&r);
    assert_int_equal(gm_transient_advance(r.transient, 1.0, &r.error), GM_ERR_SOLVE);
    assert_non_null(strstr(r.error.message, "time stands still"));
    close_rig(&r);
}

/* Torque 1 N.m/s on a body held by 2 N.m that slides with 1.5: at rest up to t = 2,
 * then 2 J dw/dt = t - 1.5; torque jumps to zero at t = 3 and it stops. */
static void friction_sticks_breaks_away_and_stops(void **state)
{
    (void)state;
    rig r;
    prepare(&r, TOY_STICK);
    r.toy.hold = 2.0;
    r.toy.slide = 1.5;
    r.drive.slope[0] = 1.0;
    r.drive.change = 3.0;
    r.drive.after.input.torque[0] = -5.0;
    open_well(&r);
    const double *x = reach(&r, 1.999);
    assert_true(x[0] == 0.0 && x[1] == 0.0);
    double w_3 = ((9.0 - 4.0) / 2.0 - 1.5) / 2.0;
    assert_true(fabs(reach(&r, 3.0)[1] - w_3) < 1e-6);
    /* from 3 on: 2 dw/dt = t - 5 - 1.5; it stops, holds, and breaks away at t = 7 */
    x = reach(&r, 4.9);
    assert_true(x[1] == 0.0);
    double held = x[0];
    assert_true(reach(&r, 6.9)[0] == held);
    assert_true(reach(&r, 7.5)[1] > 0.1);
    assert_true(open_balance(&r) < 1e-6);
    close_rig(&r);
}

/* Gear 1 joins two bodies: momentum stays, the rest is an impulse. */
static void an_impulse_keeps_momentum_and_counts_its_loss(void **state)
{
    (void)state;
    rig r;
    prepare(&r, TOY_CLUTCH);
    r.drive.change = 0.25;
    r.drive.after.input.gear[0] = 1;
    r.speed[0] = 1.0;
    r.speed[1] = 11.0;
    open_well(&r);
    assert_true(reach(&r, 0.25)[2] == 11.0); /* what was before */
    const double *x = reach(&r, 0.3);
    assert_true(fabs(x[1] - 3.0) < 1e-12 && fabs(x[2] - 3.0) < 1e-12);
    gm_transient_energy e = gm_transient_account(r.transient);
    assert_true(fabs(e.impulses - 0.5 * 0.4 * 100.0) < 1e-9);
    assert_true(fabs(e.residual) < 1e-9);
    close_rig(&r);
}

/* A driven flange whose torque reaches other states too. */
static void a_torque_that_reaches_more_than_its_flange(void **state)
{
    (void)state;
    rig r;
    prepare(&r, TOY_CLUTCH);
    r.calls.driven[1] = 1;
    r.toy.drag = 0.1;
    r.drive.before.input.gear[0] = 1;
    r.drive.before.acceleration[1] = 2.0;
    open_well(&r);
    const double *x = reach(&r, 1.5);
    gm_motion_input input;
    assert_true(fabs(x[1] - 3.0) < 1e-9 && fabs(x[2] - 3.0) < 1e-9);
    assert_int_equal(gm_driven_input(r.driven, 1.5, x, &input), 0);
    assert_true(fabs(input.torque[1] - (2.5 * 2.0 + 0.1 * 3.0)) < 1e-9);
    close_rig(&r);
}

/* ---- work ---- */

/* BDF needs few steps where nothing happens, and a damped mode costs none. */
static void a_damped_stiff_mode_costs_few_steps(void **state)
{
    (void)state;
    rig r;
    prepare(&r, TOY_OSCILLATOR);
    r.options.tolerance = 1e-4;
    r.toy.stiffness = 1e9;
    r.toy.damping = 1e3;
    r.toy.drag = 1.0;
    r.drive.before.input.torque[1] = 10.0;
    open_well(&r);
    (void)reach(&r, 10.0);
    gm_transient_statistics s = gm_transient_work(r.transient);
    assert_true(s.steps < 2000 && s.rates < 3 * s.steps && s.jacobians < s.steps);
    close_rig(&r);
}

static void reads_do_not_change_the_motion(void **state)
{
    (void)state;
    rig a, b;
    prepare(&a, TOY_OSCILLATOR);
    a.toy.stiffness = 100.0;
    a.speed[0] = 1.0;
    prepare(&b, TOY_OSCILLATOR);
    b.toy.stiffness = 100.0;
    b.speed[0] = 1.0;
    open_well(&a);
    open_well(&b);
    for (int i = 0; i < 997; i++)
        (void)reach(&a, i / 997.0);
    assert_memory_equal(reach(&a, 1.0), reach(&b, 1.0), 3 * sizeof(double));
    close_rig(&a);
    close_rig(&b);
}

/* ---- failures ---- */

static void says_when_and_what_is_not_a_number(void **state)
{
    (void)state;
    rig r;
    prepare(&r, TOY_NAN);
    r.speed[0] = 1.0;
    open_well(&r);
    assert_int_equal(gm_transient_advance(r.transient, 5.0, &r.error), GM_ERR_SOLVE);
    assert_non_null(strstr(r.error.message, "no motion beyond t = "));
    assert_non_null(strstr(r.error.message, "the rate of body 0 is not a number"));
    double t = gm_transient_time(r.transient);
    assert_true(t > 0.99 && t <= 1.0 + 1e-9);
    assert_true(isfinite(gm_transient_state(r.transient)[1]));
    close_rig(&r);
}

static void says_when_the_plant_gave_up(void **state)
{
    (void)state;
    rig r;
    prepare(&r, TOY_GIVES_UP);
    r.speed[0] = 1.0;
    open_well(&r);
    assert_int_equal(gm_transient_advance(r.transient, 5.0, &r.error), GM_ERR_SOLVE);
    assert_non_null(strstr(r.error.message, "the plant cannot be evaluated"));
    close_rig(&r);
}

static void limits_stop_a_run(void **state)
{
    (void)state;
    rig r;
    prepare(&r, TOY_OSCILLATOR);
    r.toy.stiffness = 1e4;
    r.speed[0] = 1.0;
    r.options.steps_max = 50;
    open_well(&r);
    assert_int_equal(gm_transient_advance(r.transient, 5.0, &r.error), GM_ERR_SOLVE);
    assert_non_null(strstr(r.error.message, "the limit of 50 steps"));
    close_rig(&r);
    memset(&r.options, 0, sizeof r.options);
    r.options.tolerance = 1e-9;
    r.options.cpu_max = 1e-3;
    open_well(&r);
    assert_int_equal(gm_transient_advance(r.transient, 1e6, &r.error), GM_ERR_SOLVE);
    assert_non_null(strstr(r.error.message, "of processor time"));
    close_rig(&r);
}

static void time_does_not_run_back(void **state)
{
    (void)state;
    rig r;
    prepare(&r, TOY_OSCILLATOR);
    open_well(&r);
    (void)reach(&r, 1.0);
    assert_int_equal(gm_transient_advance(r.transient, 0.5, &r.error), GM_ERR_ARGUMENT);
    assert_int_equal(gm_transient_advance(r.transient, (double)NAN, NULL),
                     GM_ERR_ARGUMENT);
    close_rig(&r);
}

static void dependent_speeds_are_refused(void **state)
{
    (void)state;
    rig r;
    prepare(&r, TOY_CLUTCH);
    r.calls.driven[0] = r.calls.driven[1] = 1;
    r.drive.before.input.gear[0] = 1;
    assert_int_equal(open_rig(&r), GM_ERR_MODEL);
    assert_non_null(strstr(r.error.message, "not independent"));
    close_rig(&r);
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    gm_status status = GM_ERR_MEMORY;
    int k;
    for (k = 1; status != GM_OK; k++) {
        rig r;
        prepare(&r, TOY_OSCILLATOR);
        r.calls.driven[0] = 1;
        gm_alloc_fail_after(k);
        status = open_rig(&r);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || status == GM_ERR_MEMORY);
        close_rig(&r);
    }
    assert_true(k > 15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(oscillator_swings_by_jacobian),
        cmocka_unit_test(oscillator_swings_by_differences),
        cmocka_unit_test(driven_speed_is_exact_by_jacobian),
        cmocka_unit_test(driven_speed_is_exact_by_differences),
        cmocka_unit_test(a_jump_of_speed_is_work),
        cmocka_unit_test(ball_bounces_at_the_right_times),
        cmocka_unit_test(bounces_that_pile_up_end_at_rest),
        cmocka_unit_test(a_plant_that_never_settles_is_refused),
        cmocka_unit_test(friction_sticks_breaks_away_and_stops),
        cmocka_unit_test(an_impulse_keeps_momentum_and_counts_its_loss),
        cmocka_unit_test(a_torque_that_reaches_more_than_its_flange),
        cmocka_unit_test(a_damped_stiff_mode_costs_few_steps),
        cmocka_unit_test(reads_do_not_change_the_motion),
        cmocka_unit_test(says_when_and_what_is_not_a_number),
        cmocka_unit_test(says_when_the_plant_gave_up),
        cmocka_unit_test(limits_stop_a_run),
        cmocka_unit_test(time_does_not_run_back),
        cmocka_unit_test(dependent_speeds_are_refused),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
