/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Random drives on random passive maps, with shifts, reversals, every step length: the
 * energy account closes, losses never give energy back, the mirrored gearset moves in
 * mirror image, and caches change no bit.
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

enum { MAPS = 200, STEPS = 400 };

static hand_map m, mirror;
static gm_reduced_params params;
static int fidelity, monotone;

static void vary_inputs(int i, unsigned *seed, gm_reduced_inputs *in)
{
    static const int gears_0[5] = {-1, 0, 1, 3, 7}, gears_1[4] = {0, 2, 4, -3};
    if (i % 20 == 0) {
        in->gear[0] = gears_0[(int)(5 * hand_random(seed))];
        in->gear[1] = gears_1[(int)(4 * hand_random(seed))];
    }
    const int idle = i % 7 == 0;
    for (int p = 0; p < 2; p++) {
        in->path_tau[p] = idle ? 0 : hand_between(seed, -60, 60);
        in->path_tau_rate[p] = hand_between(seed, -100, 100);
    }
    in->output_tau = idle ? 0 : hand_between(seed, -400, 400);
    in->output_tau_rate = hand_between(seed, -1000, 1000);
}

static double any_step(unsigned *seed)
{
    return pow(10, hand_between(seed, -6, -1));
}

static void new_map(int k, unsigned *seed)
{
    hand_spec spec = hand_random_spec(seed);
    spec.monotone = monotone;
    hand_build(&spec, &m);
    gm_reduced_default_params(&m.map, &params);
    if (k % 4 == 0) {
        params.sync_torque[0] = HUGE_VAL;
    }
    params.loss_scale = k % 9 == 0 ? 0.3 : 1;
    params.fidelity = fidelity;
}

static void work_is_kinetic_energy_plus_loss_on_every_step(void **state)
{
    unsigned seed = 2024;
    (void)state;
    for (int k = 0; k < MAPS; k++) {
        new_map(k, &seed);
        gm_reduced_state s = hand_start(&m, 0, 0, hand_between(&seed, -40, 40));
        gm_reduced_inputs in = hand_inputs(0, 0);
        double energy = hand_energy(&m, &params, &s), largest = energy;
        for (int i = 0; i < STEPS; i++) {
            const double work = s.work, loss = s.loss_energy;
            vary_inputs(i, &seed, &in);
            gm_reduced_step(&m.map, &params, &in, any_step(&seed), &s);
            const double now = hand_energy(&m, &params, &s);
            largest = fmax(largest, fmax(now, fabs(s.work) + s.loss_energy));
            /* a step adds some 30 roundings of the largest energy so far; springs meet
             * their slips to 1e-11 of their torque */
            assert_near(s.work - work, now - energy + (s.loss_energy - loss),
                        (fidelity == GM_LASH ? 1e-11 : 1e-14) * largest + 1e-300);
            /* never falling; the bilinear remainder that a long step leaves out is at
             * most 1e-4 of a torque that is itself a loss */
            assert_true(s.loss_energy >= loss - 1e-15 * largest);
            energy = now;
        }
    }
}

static void the_power_lost_is_never_negative(void **state)
{
    unsigned seed = 77;
    (void)state;
    for (int k = 0; k < MAPS; k++) {
        new_map(k, &seed);
        gm_reduced_inputs in = hand_inputs(k % 2, k % 3 == 0 ? 2 : 0);
        gm_reduced_state s =
            hand_start(&m, in.gear[0], in.gear[1], hand_between(&seed, -40, 40));
        gm_reduced_outputs o;
        for (int p = 0; p < 2; p++) {
            if (in.gear[p] == 0) {
                s.path[p].w = hand_between(&seed, -300, 300);
            }
        }
        for (int i = 0; i < 50; i++) {
            in.path_tau[0] = hand_between(&seed, -60, 60);
            in.path_tau[1] = hand_between(&seed, -60, 60);
            in.output_tau = hand_between(&seed, -900, 900);
            assert_int_equal(gm_reduced_outputs_at(&m.map, &params, &in, &s, &o) &
                                 ~GM_FLAG_OUT_OF_MAP,
                             0);
            assert_true(o.loss_power >= 0);
            assert_near(o.kinetic_energy, hand_kinetic(&m, &s), 1e-14 * o.kinetic_energy);
            gm_reduced_step(&m.map, &params, &in, 1e-3, &s);
        }
    }
}

static void negate(gm_reduced_inputs *in)
{
    in->output_tau = -in->output_tau;
    in->output_tau_rate = -in->output_tau_rate;
    for (int p = 0; p < 2; p++) {
        in->path_tau[p] = -in->path_tau[p];
        in->path_tau_rate[p] = -in->path_tau_rate[p];
    }
}

static void the_mirrored_gearset_moves_in_mirror_image(void **state)
{
    unsigned seed = 5;
    (void)state;
    for (int k = 0; k < MAPS / 4; k++) {
        hand_spec spec = hand_random_spec(&seed);
        spec.monotone = monotone;
        spec.roughness = 0; /* node values drawn at random have no mirror image */
        const hand_spec mirrored = hand_mirrored(&spec);
        hand_build(&spec, &m);
        hand_build(&mirrored, &mirror);
        /* the axis of C is not symmetric, so its cubic is none either */
        m.map.coupling.monotone = mirror.map.coupling.monotone = 0;
        gm_reduced_default_params(&m.map, &params);
        params.fidelity = fidelity;
        const double w = hand_between(&seed, -40, 40);
        gm_reduced_state a = hand_start(&m, 0, 0, w), b = hand_start(&mirror, 0, 0, -w);
        gm_reduced_inputs in = hand_inputs(0, 0);
        /* rattling teeth make little of much: 1e-15 grows by impacts */
        const int steps = fidelity == GM_LASH ? 25 : STEPS;
        for (int i = 0; i < steps; i++) {
            const double h = any_step(&seed);
            vary_inputs(i, &seed, &in);
            gm_reduced_inputs back = in;
            negate(&back);
            gm_reduced_step(&m.map, &params, &in, h, &a);
            gm_reduced_step(&mirror.map, &params, &back, h, &b);
            /* the coupling's table is read in another cell: rounding, some 1e-15 a step
             */
            const double close = (fidelity == GM_LASH ? 1e-6 : 1e-9) * (1 + fabs(a.w_o));
            assert_near(a.w_o, -b.w_o, close);
            assert_near(a.path[0].w, -b.path[0].w, 20 * close);
            assert_near(a.path[1].w, -b.path[1].w, 20 * close);
            assert_near(a.loss_energy, b.loss_energy, close * (1 + a.loss_energy));
            assert_int_equal(a.path[0].mode, b.path[0].mode);
            assert_int_equal(a.path[1].mode, b.path[1].mode);
        }
    }
}

static void caches_change_no_bit(void **state)
{
    const gm_reduced_cache empty = {0};
    unsigned seed = 11;
    (void)state;
    for (int k = 0; k < MAPS / 4; k++) {
        new_map(k, &seed);
        gm_reduced_state s = hand_start(&m, 0, 0, hand_between(&seed, -40, 40));
        gm_reduced_state fresh = s;
        gm_reduced_inputs in = hand_inputs(0, 0);
        for (int i = 0; i < STEPS; i++) {
            const double h = any_step(&seed);
            gm_reduced_outputs o = {0}, o_fresh = {0};
            vary_inputs(i, &seed, &in);
            fresh.cache = empty;
            gm_reduced_step(&m.map, &params, &in, h, &s);
            gm_reduced_step(&m.map, &params, &in, h, &fresh);
            assert_memory_equal(&s, &fresh, offsetof(gm_reduced_state, cache));
            fresh.cache = empty;
            gm_reduced_outputs_at(&m.map, &params, &in, &s, &o);
            gm_reduced_outputs_at(&m.map, &params, &in, &fresh, &o_fresh);
            assert_memory_equal(&o, &o_fresh, sizeof o);
        }
    }
}

static void a_shaft_at_rest_is_exactly_at_rest(void **state)
{
    hand_spec spec = hand_default();
    unsigned seed = 3;
    int rests = 0;
    (void)state;
    spec.monotone = monotone;
    hand_build(&spec, &m);
    gm_reduced_default_params(&m.map, &params);
    params.fidelity = fidelity;
    gm_reduced_inputs in = hand_inputs(1, 0);
    for (int k = 0; k < 200; k++) {
        gm_reduced_state s = hand_start(&m, 1, 0, hand_between(&seed, -5, 5));
        in.output_tau = hand_between(&seed, -2, 2); /* P holds 5 and 6 */
        for (int i = 0; i < 1500; i++) {
            gm_reduced_step(&m.map, &params, &in, any_step(&seed), &s);
        }
        rests += s.w_o == 0 && s.path[0].w == 0;
    }
    assert_int_equal(rests, 200);
}

static int set_rigid(void **state)
{
    (void)state;
    fidelity = GM_RIGID;
    monotone = 0;
    return 0;
}

static int set_lash(void **state)
{
    (void)state;
    fidelity = GM_LASH;
    return 0;
}

static int set_rigid_monotone(void **state)
{
    (void)set_rigid(state);
    monotone = 1;
    return 0;
}

static int set_lash_monotone(void **state)
{
    (void)set_lash(state);
    monotone = 1;
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(work_is_kinetic_energy_plus_loss_on_every_step),
        cmocka_unit_test(the_power_lost_is_never_negative),
        cmocka_unit_test(the_mirrored_gearset_moves_in_mirror_image),
        cmocka_unit_test(caches_change_no_bit),
        cmocka_unit_test(a_shaft_at_rest_is_exactly_at_rest),
    };
    return cmocka_run_group_tests_name("rigid", tests, set_rigid, NULL) +
           cmocka_run_group_tests_name("lash", tests, set_lash, NULL) +
           cmocka_run_group_tests_name("rigid, monotone", tests, set_rigid_monotone,
                                       NULL) +
           cmocka_run_group_tests_name("lash, monotone", tests, set_lash_monotone, NULL);
}
