/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The reduced gearset on maps whose truth is known in closed form: coasting, holding and
 * breaking away, transmitted torque, directions, inputs that are refused.
 */
#include "hand_map.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

#include "near.h"

typedef struct fixture {
    hand_spec spec;
    hand_map m;
    gm_reduced_params params;
} fixture;

static fixture f;

static void use(const hand_spec *spec)
{
    f.spec = *spec;
    hand_build(spec, &f.m);
    gm_reduced_default_params(&f.m.map, &f.params);
}

static int step(const gm_reduced_inputs *in, double h, gm_reduced_state *s)
{
    return gm_reduced_step(&f.m.map, &f.params, in, h, s);
}

static gm_reduced_outputs outputs(const gm_reduced_inputs *in, gm_reduced_state *s)
{
    gm_reduced_outputs o;
    assert_int_equal(gm_reduced_outputs_at(&f.m.map, &f.params, in, s, &o), 0);
    return o;
}

/* P of the gears (indices) at standstill. */
static double parasitic_at_rest(int g0, int g1, int direction)
{
    return f.m.p[(g0 + 1) * (f.spec.n_gears[1] + 1) + g1 + 1][direction][0];
}

/* J dw/dt = -(p0 + p1 w): w = (w0 + p0/p1) exp(-p1 t/J) - p0/p1, at rest after
 * J/p1 log(1 + w0 p1/p0), and then at rest for good. */
static void coasts_down_as_the_exponential_and_stops_for_good(void **state)
{
    hand_spec spec = hand_lossless();
    const double p0 = 5, p1 = 0.06, w0 = 40, j = spec.inertia_output, h = 1e-3;
    (void)state;
    spec.p0[0] = spec.p0[1] = p0;
    spec.p1 = p1;
    use(&spec);
    gm_reduced_inputs in = hand_inputs(0, 0);
    gm_reduced_state s = hand_start(&f.m, 0, 0, w0);
    const double stop = j / p1 * log(1 + w0 * p1 / p0);
    double t = 0;
    for (; t + h < stop; t += h) {
        assert_int_equal(step(&in, h, &s), 0);
        const double w = (w0 + p0 / p1) * exp(-p1 * (t + h) / j) - p0 / p1;
        /* midpoint rule: (p1 h/J)^2/12 of the speed scale, 2e-9 * 120 */
        assert_near(s.w_o, w, 1e-6);
    }
    for (int i = 0; i < 10; i++) {
        step(&in, h, &s);
    }
    assert_true(s.w_o == 0);
    assert_near(s.loss_energy, j * w0 * w0 / 2, 1e-9 * j * w0 * w0);
    assert_true(s.work == 0);
    const double angle = s.phi_o;
    step(&in, 0.1, &s);
    assert_true(s.phi_o == angle);
}

static void one_long_step_stops_where_many_short_ones_do(void **state)
{
    hand_spec spec = hand_lossless();
    (void)state;
    spec.p0[0] = spec.p0[1] = 5; /* constant torque: the midpoint rule is exact */
    use(&spec);
    const gm_reduced_inputs in = hand_inputs(0, 0);
    gm_reduced_state s = hand_start(&f.m, 0, 0, 3);
    step(&in, 10.0, &s);
    assert_true(s.w_o == 0);
    /* stopping angle w0^2 J/(2 P) */
    assert_near(s.phi_o, 9 * f.spec.inertia_output / (2 * 5), 1e-9);
}

/* Output torque at which gear 1 under input torque tau leaves rest in a direction. */
static double break_away_torque(double tau, int direction)
{
    const double r = f.spec.ratio[0][1], d = f.spec.d0[direction];
    const double p = parasitic_at_rest(1, -1, direction);
    const int driving = (tau > 0) == (direction == GM_FORWARD);
    const double load = r * d * fabs(tau) * (driving ? 1 : f.spec.overrun);
    return (direction == GM_FORWARD ? p + load : -p - load) - r * tau;
}

static void holds_between_two_different_limits(void **state)
{
    const hand_spec spec = hand_default();
    (void)state;
    use(&spec);
    for (double tau = -20; tau <= 20; tau += 5) {
        for (int direction = 0; direction < 2; direction++) {
            const double limit = break_away_torque(tau, direction);
            const double sign = direction == GM_FORWARD ? 1 : -1;
            gm_reduced_inputs in = hand_inputs(1, 0);
            gm_reduced_state s = hand_start(&f.m, 1, 0, 0);
            in.path_tau[0] = tau;
            in.output_tau = limit - sign * 1e-9;
            assert_int_equal(step(&in, 0.01, &s), 0);
            assert_true(s.w_o == 0 && s.phi_o == 0 && s.loss_energy == 0);
            assert_true(outputs(&in, &s).a_o == 0);
            in.output_tau = limit + sign * 1e-6;
            assert_true(outputs(&in, &s).a_o * sign > 0);
            step(&in, 0.01, &s);
            assert_true(s.w_o * sign > 0);
        }
    }
}

static void the_torques_at_rest_balance(void **state)
{
    const hand_spec spec = hand_default();
    (void)state;
    use(&spec);
    gm_reduced_inputs in = hand_inputs(1, 2);
    gm_reduced_state s = hand_start(&f.m, 1, 2, 0);
    for (double tau = -3; tau <= 3; tau += 0.5) {
        in.path_tau[0] = tau;
        in.path_tau[1] = -tau / 2;
        in.output_tau = 1;
        const gm_reduced_outputs o = outputs(&in, &s);
        const double r0 = f.spec.ratio[0][1], r1 = f.spec.ratio[1][0];
        const double sum = in.output_tau + r0 * (tau - o.path_loss_torque[0]) +
                           r1 * (in.path_tau[1] - o.path_loss_torque[1]) -
                           o.output_loss_torque;
        const double j = f.spec.inertia_output + r0 * r0 * f.spec.inertia[0] +
                         r1 * r1 * f.spec.inertia[1];
        assert_near(sum, o.a_o * j, 1e-11); /* rounding of torques up to 50 */
        assert_true(o.a_o != 0 || o.loss_power == 0);
    }
}

static void does_not_creep_in_a_million_steps(void **state)
{
    const hand_spec spec = hand_default();
    (void)state;
    use(&spec);
    gm_reduced_inputs in = hand_inputs(1, 2);
    gm_reduced_state s = hand_start(&f.m, 1, 2, 0);
    unsigned seed = 1;
    for (int i = 0; i < 1000000; i++) {
        in.output_tau = 0.999 * (i % 2 ? parasitic_at_rest(1, 0, GM_FORWARD)
                                       : -parasitic_at_rest(1, 0, GM_BACKWARD));
        step(&in, i % 16 ? 1e-3 : hand_between(&seed, 1e-6, 0.1), &s);
    }
    assert_true(s.w_o == 0 && s.phi_o == 0 && s.path[0].w == 0 && s.path[1].phi == 0);
    assert_true(s.work == 0 && s.loss_energy == 0);
}

static void a_preselected_path_transmits_its_inertia_torque(void **state)
{
    hand_spec spec = hand_lossless();
    (void)state;
    use(&spec);
    gm_reduced_inputs in = hand_inputs(1, 2);
    gm_reduced_state s = hand_start(&f.m, 1, 2, 10);
    in.path_tau[0] = 30;
    const gm_reduced_outputs o = outputs(&in, &s);
    const double r0 = 15, r1 = 9, j0 = spec.inertia[0], j1 = spec.inertia[1];
    const double a = r0 * 30 / (spec.inertia_output + r0 * r0 * j0 + r1 * r1 * j1);
    assert_near(o.a_o, a, 1e-12 * a);
    assert_near(o.transmitted[0], 30 - j0 * r0 * a, 1e-12 * 30);
    assert_near(o.transmitted[1], -j1 * r1 * a, 1e-12 * 30);
    assert_near(o.a[1], r1 * a, 1e-12 * r1 * a);
}

static void reverse_turns_the_output_back_and_costs_energy(void **state)
{
    const hand_spec spec = hand_default();
    (void)state;
    use(&spec);
    gm_reduced_inputs in = hand_inputs(-1, 0);
    gm_reduced_state s = hand_start(&f.m, -1, 0, -10);
    const double r = -13, d = spec.d0[GM_FORWARD] + spec.d1 * 130;
    assert_near(s.path[0].w, 130, 0);
    in.path_tau[0] = 20;
    in.output_tau = 5;
    const gm_reduced_outputs o = outputs(&in, &s);
    const double coupling = spec.c0 + spec.c1 * 130; /* the other shaft is at rest */
    const double t_m = 20 - coupling - spec.inertia[0] * r * o.a_o;
    assert_true(o.a_o < 0);
    assert_near(o.transmitted[0], t_m, 1e-12 * 20);
    /* the path turns forward and drives: d of the forward direction, positive brakes */
    assert_near(o.path_loss_torque[0], d * t_m, 1e-12 * 20);
    assert_true(o.output_loss_torque < 0 && o.loss_power > 0);
    in.path_tau[0] = -20; /* overrun */
    const gm_reduced_outputs b = outputs(&in, &s);
    assert_near(b.path_loss_torque[0], -d * spec.overrun * b.transmitted[0], 1e-12 * 20);
}

static void two_loaded_paths_share_the_correction(void **state)
{
    hand_spec spec = hand_default();
    (void)state;
    use(&spec);
    gm_reduced_inputs in = hand_inputs(1, 2);
    gm_reduced_state s = hand_start(&f.m, 1, 2, 20);
    in.path_tau[0] = 60;
    in.path_tau[1] = 40;
    in.output_tau = -1200;
    const gm_reduced_outputs o = outputs(&in, &s);
    const double y0 = o.transmitted[0], y1 = o.transmitted[1];
    const double x = spec.x * y0 * y1 / spec.torque_max;
    const double p = spec.p0[0] + spec.p1 * 20;
    assert_true(y0 > 0 && y1 > 0 && x > 1);
    /* of X's bilinear surface a pass may leave 1e-4 of the torque */
    assert_near(o.output_loss_torque, p + x, 1e-4 * (p + x));
    assert_near(o.a_o * spec.inertia_output,
                in.output_tau + 15 * (y0 - o.path_loss_torque[0]) +
                    9 * (y1 - o.path_loss_torque[1]) - o.output_loss_torque,
                1e-9); /* rounding of torques near 1000, by 1/J */
}

static void follows_torques_that_change_linearly_in_a_step(void **state)
{
    hand_spec spec = hand_lossless();
    (void)state;
    use(&spec);
    gm_reduced_inputs in = hand_inputs(0, 0);
    gm_reduced_state s = hand_start(&f.m, 0, 0, 1);
    in.output_tau = 0.5;
    in.output_tau_rate = 2;
    step(&in, 0.1, &s);
    const double w = 1 + (0.5 * 0.1 + 2 * 0.1 * 0.1 / 2) / spec.inertia_output;
    assert_near(s.w_o, w, 1e-15 * 4);
    assert_near(s.work, spec.inertia_output * (w * w - 1) / 2, 1e-15);
}

static void the_loss_scale_scales_every_loss(void **state)
{
    const hand_spec spec = hand_default();
    (void)state;
    use(&spec);
    for (int g1 = 0; g1 <= 2; g1 += 2) {
        gm_reduced_inputs in = hand_inputs(1, g1);
        gm_reduced_state s = hand_start(&f.m, 1, g1, 20);
        s.path[1].w = g1 ? s.path[1].w : 90;
        f.params.loss_scale = 0;
        gm_reduced_outputs none = outputs(&in, &s);
        assert_true(none.loss_power == 0 && none.a_o == 0);
        f.params.loss_scale = 1;
        /* the load loss follows the torque that a needs, so take a's part by a balance */
        const gm_reduced_outputs one = outputs(&in, &s);
        f.params.loss_scale = 2;
        const gm_reduced_outputs two = outputs(&in, &s);
        assert_near(two.loss_power / one.loss_power, 2, 0.1);
        assert_true(one.loss_power > 0);
    }
}

static void refuses_what_is_not_finite_and_keeps_the_state(void **state)
{
    const hand_spec spec = hand_default();
    /* 1e150: products with it overflow, which at rest would look like a torque to hold */
    const double bad[4] = {(double)NAN, HUGE_VAL, -HUGE_VAL, 1e150};
    (void)state;
    use(&spec);
    gm_reduced_state s = hand_start(&f.m, 1, 2, 20);
    for (int i = 0; i < 4 * 8 - 1; i++) {
        gm_reduced_inputs in = hand_inputs(3, 4);
        gm_reduced_outputs o = {0}, untouched = {0};
        double h = 1e-3;
        double *field[8] = {&in.output_tau,      &in.output_tau_rate,
                            &in.path_tau[0],     &in.path_tau_rate[0],
                            &in.path_tau[1],     &in.path_tau_rate[1],
                            &in.oil_temperature, &h};
        *field[i % 8] = bad[i / 8];
        const gm_reduced_state before = s;
        assert_int_equal(step(&in, h, &s), GM_FLAG_NOT_FINITE);
        assert_memory_equal(&s, &before, sizeof s);
        if (i % 8 != 7) {
            assert_int_equal(gm_reduced_outputs_at(&f.m.map, &f.params, &in, &s, &o),
                             GM_FLAG_NOT_FINITE);
            assert_memory_equal(&o, &untouched, sizeof o);
        }
    }
}

static void keeps_the_state_when_the_result_overflows(void **state)
{
    const hand_spec spec = hand_default();
    (void)state;
    use(&spec);
    gm_reduced_state s = hand_start(&f.m, 1, 2, 20);
    const gm_reduced_state before = s;
    gm_reduced_inputs in = hand_inputs(1, 2);
    in.output_tau = 1e308;
    assert_int_equal(step(&in, 0.1, &s), GM_FLAG_NOT_FINITE);
    assert_memory_equal(&s, &before, offsetof(gm_reduced_state, cache));
}

static void tells_when_the_map_is_left(void **state)
{
    const hand_spec spec = hand_default();
    (void)state;
    use(&spec);
    gm_reduced_inputs in = hand_inputs(1, 0);
    gm_reduced_state s = hand_start(&f.m, 1, 0, 20);
    assert_int_equal(step(&in, 1e-3, &s), 0);
    in.path_tau[0] = 1.5 * spec.torque_max;
    in.output_tau = -15 * in.path_tau[0];
    assert_int_equal(step(&in, 1e-6, &s), GM_FLAG_OUT_OF_MAP);
    in.path_tau[0] = in.output_tau = 0;
    s = hand_start(&f.m, 1, 0, spec.speed_max * 1.01);
    assert_int_equal(step(&in, 1e-6, &s), GM_FLAG_OUT_OF_MAP);
    const gm_reduced_state fast = s;
    gm_reduced_outputs o;
    assert_int_equal(gm_reduced_outputs_at(&f.m.map, &f.params, &in, &s, &o),
                     GM_FLAG_OUT_OF_MAP);
    assert_memory_equal(&s, &fast, offsetof(gm_reduced_state, cache));
}

static void a_single_path_works_alone(void **state)
{
    hand_spec spec = hand_default();
    (void)state;
    spec.n_paths = 1;
    use(&spec);
    assert_int_equal(f.m.map.n_configurations, 4);
    gm_reduced_inputs in = hand_inputs(1, 99);
    gm_reduced_state s = hand_start(&f.m, 1, 99, 0);
    const double j = spec.inertia_output + 225 * spec.inertia[0], tau = 20;
    in.path_tau[0] = tau;
    assert_int_equal(step(&in, 1e-3, &s), 0);
    const double loss = spec.p0[0] + 15 * spec.d0[0] * tau;
    assert_near(s.w_o, (15 * tau - loss) / j * 1e-3, 0.03 * s.w_o); /* D(tau_m) */
    assert_near(s.path[0].w, 15 * s.w_o, 0);
    assert_near(s.work, hand_kinetic(&f.m, &s) + s.loss_energy, 1e-15);
}

/* What calls leave on the stack where those after them have their variables: NaN. */
static void fill_with_nan(void)
{
    volatile unsigned char bytes[8192];
    for (size_t i = 0; i < sizeof bytes; i++)
        bytes[i] = 0xff;
}

/* By a pointer, so that it has a frame of its own. */
static void (*volatile leave_nan_behind)(void) = fill_with_nan;

static void nothing_is_read_of_the_path_that_is_not_there(void **state)
{
    hand_spec spec = hand_default();
    (void)state;
    spec.n_paths = 1;
    use(&spec);
    for (int gear = 0; gear <= 1; gear++) {
        gm_reduced_inputs in = hand_inputs(gear, 99);
        gm_reduced_state s = hand_start(&f.m, gear, 99, 10);
        gm_reduced_outputs o;
        in.path_tau[0] = 20;
        leave_nan_behind();
        assert_int_equal(gm_reduced_outputs_at(&f.m.map, &f.params, &in, &s, &o), 0);
        assert_true(o.loss_power > 0);
        leave_nan_behind();
        assert_int_equal(gm_reduced_step(&f.m.map, &f.params, &in, 1e-3, &s), 0);
        assert_true(s.loss_energy > 0);
    }
}

static void starts_in_the_commanded_gears(void **state)
{
    const hand_spec spec = hand_default();
    const double w[2] = {11, 22};
    gm_reduced_state s;
    (void)state;
    use(&spec);
    gm_reduced_inputs in = hand_inputs(3, 0);
    assert_int_equal(gm_reduced_start(&f.m.map, &in, 10, w, &s), 0);
    assert_true(s.path[0].w == 60 && s.path[1].w == 22 && s.w_o == 10);
    assert_int_equal(s.path[0].mode, GM_PATH_ENGAGED);
    assert_int_equal(s.path[1].mode, GM_PATH_NEUTRAL);
    assert_int_equal(gm_reduced_configuration(&f.m.map, &s), 3 * 3 + 0);
    in.gear[0] = 2;
    assert_int_equal(gm_reduced_start(&f.m.map, &in, 10, w, &s), GM_FLAG_GEAR_REFUSED_0);
    assert_int_equal(s.path[0].mode, GM_PATH_NEUTRAL);
    assert_true(s.path[0].w == 11);
    const gm_reduced_state before = s;
    assert_int_equal(gm_reduced_start(&f.m.map, &in, (double)NAN, w, &s),
                     GM_FLAG_NOT_FINITE);
    assert_memory_equal(&s, &before, sizeof s);
    assert_int_equal(gm_reduced_find_gear(&f.m.map, 0, -1), 0);
    assert_int_equal(gm_reduced_find_gear(&f.m.map, 0, 2), -2);
    assert_int_equal(gm_reduced_find_gear(&f.m.map, 1, 0), -1);
}

static void an_instance_stays_small(void **state)
{
    (void)state;
    assert_true(sizeof(gm_reduced_state) <= 4096);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coasts_down_as_the_exponential_and_stops_for_good),
        cmocka_unit_test(one_long_step_stops_where_many_short_ones_do),
        cmocka_unit_test(holds_between_two_different_limits),
        cmocka_unit_test(the_torques_at_rest_balance),
        cmocka_unit_test(does_not_creep_in_a_million_steps),
        cmocka_unit_test(a_preselected_path_transmits_its_inertia_torque),
        cmocka_unit_test(reverse_turns_the_output_back_and_costs_energy),
        cmocka_unit_test(two_loaded_paths_share_the_correction),
        cmocka_unit_test(follows_torques_that_change_linearly_in_a_step),
        cmocka_unit_test(the_loss_scale_scales_every_loss),
        cmocka_unit_test(refuses_what_is_not_finite_and_keeps_the_state),
        cmocka_unit_test(keeps_the_state_when_the_result_overflows),
        cmocka_unit_test(tells_when_the_map_is_left),
        cmocka_unit_test(a_single_path_works_alone),
        cmocka_unit_test(nothing_is_read_of_the_path_that_is_not_there),
        cmocka_unit_test(starts_in_the_commanded_gears),
        cmocka_unit_test(an_instance_stays_small),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
