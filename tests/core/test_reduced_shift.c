/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Shifts: synchronising in closed form, engagement by impulse, gears taken back.
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

static hand_map m;
static gm_reduced_params params;

static void use(const hand_spec *spec)
{
    hand_build(spec, &m);
    gm_reduced_default_params(&m.map, &params);
}

static int step(const gm_reduced_inputs *in, double h, gm_reduced_state *s)
{
    return gm_reduced_step(&m.map, &params, in, h, s);
}

/* Without losses the slip falls as s0 - T (1/J_n + r^2/J_s) t; half of the cone's work
 * T s0 t/2 = s0^2/2 /(1/J_n + r^2/J_s) is lost; momentum is kept. */
static void synchronises_in_the_time_that_capacity_and_inertia_give(void **state)
{
    const double steps[4] = {1e-5, 1e-3, 7e-3, 0.1};
    const hand_spec spec = hand_lossless();
    (void)state;
    use(&spec);
    for (int i = 0; i < 4; i++) {
        gm_reduced_inputs in = hand_inputs(1, 0);
        gm_reduced_state s = hand_start(&m, 1, 0, 20);
        const double r = 9, j_n = spec.inertia[1], cap = spec.sync_torque[1];
        const double j_s = spec.inertia_output + 225 * spec.inertia[0];
        const double ease = 1 / j_n + r * r / j_s, slip = -r * 20;
        const double time = fabs(slip) / (cap * ease);
        in.gear[1] = 2;
        double t = 0;
        for (; t + steps[i] < time; t += steps[i]) {
            step(&in, steps[i], &s);
            assert_int_equal(s.path[1].mode, GM_PATH_SYNCHRONISING);
            const double now = s.path[1].w - r * s.w_o;
            assert_near(now, slip + cap * ease * (t + steps[i]), 1e-8);
        }
        step(&in, steps[i], &s);
        step(&in, steps[i],
             &s); /* t is a sum: the last step may end just short of time */
        assert_int_equal(s.path[1].mode, GM_PATH_ENGAGED);
        assert_true(s.path[1].w == r * s.w_o);
        assert_near(s.w_o, (j_s * 20 + 0) / (j_s + r * r * j_n), 1e-9);
        assert_near(s.loss_energy, slip * slip / 2 / ease, 1e-7);
        assert_true(s.work == 0);
    }
}

static void infinite_capacity_engages_at_once_and_keeps_momentum(void **state)
{
    const hand_spec spec = hand_default();
    (void)state;
    use(&spec);
    params.sync_torque[1] = HUGE_VAL;
    gm_reduced_inputs in = hand_inputs(1, 0);
    gm_reduced_state s = hand_start(&m, 1, 0, 20);
    s.path[1].w = 100;
    const double j_s = spec.inertia_output + 225 * spec.inertia[0], j_n = spec.inertia[1];
    const double w = (j_s * 20 + 9 * j_n * 100) / (j_s + 81 * j_n);
    const double slip = 100 - 9 * 20.0, energy = hand_kinetic(&m, &s);
    in.gear[1] = 2;
    step(&in, 1e-6, &s); /* 1e-6 s of losses: 10 N.m/5 kg.m2 * 1e-6 s = 2e-6 rad/s */
    assert_int_equal(s.path[1].mode, GM_PATH_ENGAGED);
    assert_near(s.w_o, w, 1e-5);
    const double impulse = slip * slip / 2 / (1 / j_n + 81 / j_s);
    assert_near(s.loss_energy, impulse, 1e-3);
    assert_true(s.loss_energy > impulse);
    /* the account closes to rounding of energies near 1 kJ */
    assert_near(energy + s.work - s.loss_energy, hand_kinetic(&m, &s), 1e-11);
}

/* Parts that come with gear 2 (E > 0) or go (E < 0), with the path in step already. What
 * stays in motion keeps its momentum, the rest comes from or goes to standstill; back in
 * neutral the other way round. */
static void parts_of_a_gear_come_and_go_at_rest(void **state)
{
    (void)state;
    for (int sign = -1; sign <= 1; sign += 2) {
        hand_spec spec = hand_lossless();
        const double extra = sign * 0.3 * spec.inertia_output, r = 9, w_o = 20;
        spec.inertia_extra[1][0] = extra;
        use(&spec);
        gm_reduced_inputs in = hand_inputs(0, 0);
        gm_reduced_state s = hand_start(&m, 0, 0, w_o);
        s.path[1].w = r * w_o;
        const double start = hand_kinetic(&m, &s);
        const double before =
            spec.inertia_output + fmin(extra, 0) + r * r * spec.inertia[1];
        const double after = spec.inertia_output + extra + r * r * spec.inertia[1];
        in.gear[1] = 2;
        step(&in, 1e-3, &s);
        assert_int_equal(s.path[1].mode, GM_PATH_ENGAGED);
        assert_near(s.w_o, w_o * before / after, 1e-12);
        assert_near(start - s.loss_energy, hand_kinetic(&m, &s), 1e-12);
        assert_true(s.loss_energy > 0);
        const double w = s.w_o, lost = s.loss_energy;
        in.gear[1] = 0;
        step(&in, 1e-3, &s);
        assert_near(s.w_o,
                    w * (spec.inertia_output + fmin(extra, 0)) / spec.inertia_output,
                    1e-12);
        assert_near(s.path[1].w, r * w, 1e-12);
        assert_near(start - s.loss_energy, hand_kinetic(&m, &s), 1e-12);
        assert_true(s.loss_energy > lost);
    }
}

/* Torque on the output meets J_out + r^2 J_p + J_g. */
static void parts_of_a_gear_take_part(void **state)
{
    (void)state;
    hand_spec spec = hand_lossless();
    gm_reduced_outputs out;
    spec.inertia_extra[0][0] = 0.25;
    use(&spec);
    gm_reduced_inputs in = hand_inputs(spec.number[0][0], 0);
    gm_reduced_state s = hand_start(&m, spec.number[0][0], 0, 10);
    const double r = spec.ratio[0][0];
    const double j = spec.inertia_output + r * r * spec.inertia[0] + 0.25;
    in.output_tau = 3;
    in.path_tau[0] = 2;
    assert_int_equal(gm_reduced_outputs_at(&m.map, &params, &in, &s, &out), 0);
    assert_near(out.a_o, (3 + 2 * r) / j, 1e-12);
    assert_near(out.kinetic_energy, j * 100 / 2, 1e-12);
}

/* A path without drag tables is always in its gear. */
static void a_path_without_neutral_starts_and_stays_in_gear(void **state)
{
    (void)state;
    hand_spec spec = hand_default();
    gm_reduced_state s;
    spec.n_paths = 1;
    spec.n_gears[0] = 1;
    use(&spec);
    memset(m.map.path[0].drag, 0, sizeof m.map.path[0].drag);
    memset(m.map.path[0].reaction, 0, sizeof m.map.path[0].reaction);
    m.map.path[0].n_lines = 0;
    m.configuration[0].parasitic[0].value = m.configuration[0].parasitic[1].value = NULL;
    assert_false(gm_reduced_has_neutral(&m.map, 0));
    assert_int_equal(gm_reduced_find_gear(&m.map, 0, GM_NEUTRAL), -2);
    gm_reduced_inputs in = hand_inputs(GM_NEUTRAL, 0);
    const double w[2] = {0, 0}, r = spec.ratio[0][0];
    assert_int_equal(gm_reduced_start(&m.map, &in, 10, w, &s), GM_FLAG_GEAR_REFUSED_0);
    assert_int_equal(s.path[0].mode, GM_PATH_ENGAGED);
    assert_near(s.path[0].w, 10 * r, 1e-12);
    in.path_tau[0] = 5;
    for (int i = 0; i < 100; i++) {
        assert_int_equal(step(&in, 1e-2, &s), GM_FLAG_GEAR_REFUSED_0);
        assert_int_equal(s.path[0].mode, GM_PATH_ENGAGED);
        assert_true(s.path[0].w == r * s.w_o);
    }
    in.gear[0] = spec.number[0][0];
    assert_int_equal(step(&in, 1e-2, &s), 0);
}

static void an_impulse_moves_a_standing_output(void **state)
{
    const hand_spec spec = hand_default();
    (void)state;
    use(&spec);
    params.sync_torque[0] = 1e30;
    gm_reduced_inputs in = hand_inputs(0, 0);
    gm_reduced_state s = hand_start(&m, 0, 0, 0);
    s.path[0].w = 100;
    in.gear[0] = -1;
    step(&in, 1e-6, &s);
    assert_int_equal(s.path[0].mode, GM_PATH_ENGAGED);
    const double j = spec.inertia_output + 169 * spec.inertia[0];
    assert_near(s.w_o, -13 * spec.inertia[0] * 100 / j, 1e-3);
}

static void engages_at_once_at_standstill(void **state)
{
    const hand_spec spec = hand_default();
    (void)state;
    use(&spec);
    gm_reduced_inputs in = hand_inputs(0, 0);
    gm_reduced_state s = hand_start(&m, 0, 0, 0);
    in.gear[0] = 1;
    in.gear[1] = 2;
    assert_int_equal(step(&in, 1e-6, &s), 0);
    assert_int_equal(s.path[0].mode, GM_PATH_ENGAGED);
    assert_int_equal(s.path[1].mode, GM_PATH_ENGAGED);
    assert_true(s.loss_energy == 0 && s.w_o == 0);
}

static void a_gear_can_be_taken_back_half_way(void **state)
{
    const hand_spec spec = hand_lossless();
    (void)state;
    use(&spec);
    gm_reduced_inputs in = hand_inputs(1, 2);
    gm_reduced_state s = hand_start(&m, 1, 0, 20);
    for (int i = 0; i < 20; i++) {
        step(&in, 1e-3, &s);
    }
    const double part = s.path[1].w;
    assert_int_equal(s.path[1].mode, GM_PATH_SYNCHRONISING);
    assert_true(part > 10 && part < 170);
    in.gear[1] = 0;
    step(&in, 1e-3, &s);
    assert_int_equal(s.path[1].mode, GM_PATH_NEUTRAL);
    assert_true(s.path[1].w == part);
    in.gear[1] = 4; /* 90 rad/s are above or below: either way it gets there */
    for (int i = 0; i < 100; i++) {
        step(&in, 1e-3, &s);
    }
    assert_int_equal(s.path[1].mode, GM_PATH_ENGAGED);
    assert_true(s.path[1].w == 4.5 * s.w_o);
    in.gear[1] = 2; /* straight from one gear of a path to another */
    step(&in, 1e-3, &s);
    assert_int_equal(s.path[1].mode, GM_PATH_SYNCHRONISING);
    assert_int_equal(s.path[1].gear, 0);
}

static void an_unknown_gear_is_refused_and_the_gear_kept(void **state)
{
    const hand_spec spec = hand_default();
    (void)state;
    use(&spec);
    gm_reduced_inputs in = hand_inputs(2, 1);
    gm_reduced_state s = hand_start(&m, 1, 2, 20);
    assert_int_equal(step(&in, 1e-3, &s),
                     GM_FLAG_GEAR_REFUSED_0 | GM_FLAG_GEAR_REFUSED_1);
    assert_int_equal(s.path[0].mode, GM_PATH_ENGAGED);
    assert_int_equal(s.path[0].gear, 1);
    assert_int_equal(s.path[1].gear, 0);
    assert_true(s.w_o < 20); /* the step itself was done */
}

static void both_paths_can_synchronise_together(void **state)
{
    const double steps[3] = {1e-4, 3e-3, 0.1};
    const hand_spec spec = hand_default();
    (void)state;
    use(&spec);
    for (int i = 0; i < 3; i++) {
        gm_reduced_inputs in = hand_inputs(3, 4);
        gm_reduced_state s = hand_start(&m, 0, 0, 40);
        s.path[0].w = -30;
        const double energy = hand_kinetic(&m, &s);
        double t = 0, last = 0;
        while (t < 0.8) {
            step(&in, steps[i], &s);
            t += steps[i];
            assert_true(s.loss_energy >= last);
            last = s.loss_energy;
        }
        assert_int_equal(s.path[0].mode, GM_PATH_ENGAGED);
        assert_int_equal(s.path[1].mode, GM_PATH_ENGAGED);
        assert_true(s.path[0].w == 6 * s.w_o && s.path[1].w == 4.5 * s.w_o);
        assert_near(energy - s.loss_energy, hand_kinetic(&m, &s), 1e-9);
    }
}

static void a_weak_synchroniser_never_closes_against_a_strong_torque(void **state)
{
    const hand_spec spec = hand_lossless();
    (void)state;
    use(&spec);
    gm_reduced_inputs in = hand_inputs(1, 2);
    gm_reduced_state s = hand_start(&m, 1, 0, 20);
    s.path[1].w = 200;
    in.path_tau[1] = spec.sync_torque[1] + 5;
    for (int i = 0; i < 50; i++) {
        step(&in, 1e-3, &s);
        assert_int_equal(s.path[1].mode, GM_PATH_SYNCHRONISING);
    }
    assert_near(s.path[1].w, 200 + 5 / spec.inertia[1] * 0.05, 1e-9);
}

static void a_held_output_stops_the_shaft_that_synchronises_to_it(void **state)
{
    hand_spec spec = hand_default();
    (void)state;
    spec.sync_torque[0] = 0.2; /* times 15: less than P holds */
    use(&spec);
    gm_reduced_inputs in = hand_inputs(1, 0);
    gm_reduced_state s = hand_start(&m, 0, 0, 0);
    s.path[0].w = 20;
    for (int i = 0; i < 2000 && s.path[0].mode != GM_PATH_ENGAGED; i++) {
        step(&in, 1e-3, &s);
        assert_true(s.w_o == 0);
    }
    assert_int_equal(s.path[0].mode, GM_PATH_ENGAGED);
    assert_true(s.path[0].w == 0);
    const double energy = spec.inertia[0] * 20 * 20 / 2;
    assert_near(s.loss_energy, energy, 1e-9 * energy);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(synchronises_in_the_time_that_capacity_and_inertia_give),
        cmocka_unit_test(infinite_capacity_engages_at_once_and_keeps_momentum),
        cmocka_unit_test(parts_of_a_gear_come_and_go_at_rest),
        cmocka_unit_test(parts_of_a_gear_take_part),
        cmocka_unit_test(a_path_without_neutral_starts_and_stays_in_gear),
        cmocka_unit_test(an_impulse_moves_a_standing_output),
        cmocka_unit_test(engages_at_once_at_standstill),
        cmocka_unit_test(a_gear_can_be_taken_back_half_way),
        cmocka_unit_test(an_unknown_gear_is_refused_and_the_gear_kept),
        cmocka_unit_test(both_paths_can_synchronise_together),
        cmocka_unit_test(a_weak_synchroniser_never_closes_against_a_strong_torque),
        cmocka_unit_test(a_held_output_stops_the_shaft_that_synchronises_to_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
