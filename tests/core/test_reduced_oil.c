/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The oil axis: exact at and between the temperatures of the slices, clamped and flagged
 * beyond them, the account closes while the temperature changes, caches change no bit.
 */
#include "core/gm_reduced_gradient.h"
#include "oil_map.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

#include "near.h"

static oil_map m;
static hand_map alone; /* a map for one temperature */
static gm_reduced_params params;

static const double straight[OIL_SLICES - 1] = {0, 0};
static const double bent[OIL_SLICES - 1] = {2.5, -0.4};

/* Losses at the slices as factors: from cold to warm. */
static const double factor[OIL_SLICES] = {3.0, 1.4, 0.8};

/* A random gearset whose losses are all in proportion to factor. */
static hand_spec build(unsigned *seed, int monotone, int fidelity, const double *bend)
{
    hand_spec spec = hand_random_spec(seed), slices[OIL_SLICES];
    spec.monotone = monotone;
    for (int k = 0; k < OIL_SLICES; k++) {
        slices[k] = oil_scaled(&spec, factor[k]);
    }
    oil_build(slices, bend, &m);
    gm_reduced_default_params(&m.frame.map, &params);
    params.fidelity = fidelity;
    return spec;
}

static void vary(int i, unsigned *seed, gm_reduced_inputs *in)
{
    static const int gears_0[] = {-1, 0, 1, 3}, gears_1[] = {0, 2, 4};
    if (i % 20 == 0) {
        in->gear[0] = gears_0[(int)(4 * hand_random(seed))];
        in->gear[1] = gears_1[(int)(3 * hand_random(seed))];
    }
    for (int p = 0; p < 2; p++) {
        in->path_tau[p] = hand_between(seed, -60, 60);
    }
    in->output_tau = hand_between(seed, -400, 400);
}

static double any_step(unsigned *seed)
{
    return pow(10, hand_between(seed, -5, -2));
}

/* Both maps give the same motion, to a part of it; 0: to the bit. */
static void assert_same_drive(const gm_reduced_map *a, const gm_reduced_map *b,
                              double temperature, double part, unsigned *seed)
{
    gm_reduced_inputs in = hand_inputs(0, 0);
    gm_reduced_state s = hand_start(&m.frame, 0, 0, hand_between(seed, -40, 40)), t = s;
    in.oil_temperature = temperature;
    for (int i = 0; i < 200; i++) {
        const double h = any_step(seed);
        gm_reduced_outputs x, y;
        vary(i, seed, &in);
        gm_reduced_step(a, &params, &in, h, &s);
        gm_reduced_step(b, &params, &in, h, &t);
        assert_near(s.w_o, t.w_o, part * (1 + fabs(s.w_o)));
        assert_near(s.path[0].w, t.path[0].w, part * (1 + fabs(s.path[0].w)));
        assert_near(s.loss_energy, t.loss_energy, part * (1 + s.loss_energy));
        gm_reduced_outputs_at(a, &params, &in, &s, &x);
        gm_reduced_outputs_at(b, &params, &in, &t, &y);
        assert_near(x.loss_power, y.loss_power, part * (1 + fabs(x.loss_power)));
        if (part >
            0) { /* what differs by rounding must not grow over hundreds of steps */
            t = s;
            memset(&t.cache, 0, sizeof t.cache);
        }
    }
}

static void at_a_slice_the_map_is_that_slice_to_the_bit(void **state)
{
    unsigned seed = 11;
    (void)state;
    for (int k = 0; k < 60; k++) {
        build(&seed, k % 2, k % 4 < 2 ? GM_RIGID : GM_LASH, k % 3 ? bent : straight);
        const int slice = k % OIL_SLICES;
        assert_same_drive(&m.frame.map, &m.slice[slice].map, oil_temperatures[slice], 0,
                          &seed);
    }
}

static double expected_factor(double temperature, const double *bend)
{
    const int k = temperature >= oil_temperatures[1];
    const double u = (temperature - oil_temperatures[k]) /
                     (oil_temperatures[k + 1] - oil_temperatures[k]);
    const double share = u * (1 + bend[k]) / (1 + bend[k] * u);
    return factor[k] + share * (factor[k + 1] - factor[k]);
}

/* The tables between are those of a gearset of its own: also for cubics, whose slopes
 * are in proportion to the nodes. */
static void between_slices_losses_follow_the_share(void **state)
{
    unsigned seed = 12;
    (void)state;
    for (int k = 0; k < 60; k++) {
        const double *bend = k % 3 ? bent : straight;
        const double temperature = hand_between(&seed, 264, 363);
        const hand_spec spec = build(&seed, k % 2, k % 4 < 2 ? GM_RIGID : GM_LASH, bend);
        const hand_spec there = oil_scaled(&spec, expected_factor(temperature, bend));
        hand_build(&there, &alone);
        /* some hundred roundings, and passes that end within 1e-9 N.m of a surface */
        assert_same_drive(&m.frame.map, &alone.map, temperature, 1e-9, &seed);
    }
}

static void beyond_the_ends_the_nearest_slice_serves_and_is_flagged(void **state)
{
    static const double beyond[] = {0, 200, 263, 364, 500};
    unsigned seed = 13;
    (void)state;
    build(&seed, 0, GM_RIGID, bent);
    for (size_t i = 0; i < sizeof beyond / sizeof *beyond; i++) {
        const int slice = beyond[i] < 300 ? 0 : OIL_SLICES - 1;
        gm_reduced_inputs in = hand_inputs(1, 0);
        gm_reduced_state s = hand_start(&m.frame, 1, 0, 20), t = s;
        gm_reduced_outputs x, y;
        in.oil_temperature = beyond[i];
        assert_int_equal(gm_reduced_outputs_at(&m.frame.map, &params, &in, &s, &x),
                         GM_FLAG_OUT_OF_MAP);
        assert_int_equal(gm_reduced_outputs_at(&m.slice[slice].map, &params, &in, &t, &y),
                         0);
        assert_true(x.loss_power == y.loss_power);
        assert_int_equal(gm_reduced_step(&m.frame.map, &params, &in, 1e-3, &s),
                         GM_FLAG_OUT_OF_MAP);
        in.oil_temperature = oil_temperatures[slice];
        assert_int_equal(gm_reduced_outputs_at(&m.frame.map, &params, &in, &s, &x), 0);
    }
}

static void a_temperature_that_is_no_number_is_refused(void **state)
{
    unsigned seed = 14;
    (void)state;
    build(&seed, 0, GM_RIGID, bent);
    gm_reduced_inputs in = hand_inputs(1, 0);
    gm_reduced_state s = hand_start(&m.frame, 1, 0, 20), before = s;
    in.oil_temperature = (double)NAN;
    assert_int_equal(gm_reduced_step(&m.frame.map, &params, &in, 1e-3, &s),
                     GM_FLAG_NOT_FINITE);
    assert_memory_equal(&s, &before, sizeof s);
}

/* Work of the flanges is kinetic and elastic energy and losses, as at one temperature
 * (test_reduced_account.c); another temperature changes no state. */
static void the_account_closes_while_the_temperature_changes(void **state)
{
    unsigned seed = 15;
    (void)state;
    for (int k = 0; k < 60; k++) {
        build(&seed, k % 2, k % 4 < 2 ? GM_RIGID : GM_LASH, bent);
        gm_reduced_inputs in = hand_inputs(0, 0);
        gm_reduced_state s = hand_start(&m.frame, 0, 0, hand_between(&seed, -40, 40)), t;
        double energy = hand_energy(&m.frame, &params, &s), largest = energy;
        for (int i = 0; i < 300; i++) {
            const double work = s.work, loss = s.loss_energy, h = any_step(&seed);
            vary(i, &seed, &in);
            in.oil_temperature = i % 3 ? in.oil_temperature : 320 + 70 * sin(i / 30.0);
            t = s;
            memset(&t.cache, 0, sizeof t.cache);
            gm_reduced_step(&m.frame.map, &params, &in, h, &s);
            gm_reduced_step(&m.frame.map, &params, &in, h, &t);
            memset(&t.cache, 0, sizeof t.cache);
            gm_reduced_state u = s;
            memset(&u.cache, 0, sizeof u.cache);
            assert_memory_equal(&t, &u, sizeof t);
            const double now = hand_energy(&m.frame, &params, &s);
            largest = fmax(largest, fmax(now, fabs(s.work) + s.loss_energy));
            assert_near(s.work - work, now - energy + (s.loss_energy - loss),
                        (params.fidelity == GM_LASH ? 1e-11 : 1e-14) * largest);
            assert_true(s.loss_energy >= loss - 1e-15 * largest);
            energy = now;
        }
    }
}

/* ---- derivatives ---- */

enum { N_VALUES = 6 };

static void values_at(const gm_reduced_inputs *in, const gm_reduced_modes *modes,
                      gm_reduced_state s, double v[N_VALUES])
{
    gm_reduced_outputs o;
    assert_int_equal(gm_reduced_modes_outputs(&m.frame.map, &params, in, modes, &s, &o),
                     0);
    const double list[N_VALUES] = {o.a_o,
                                   o.a[0],
                                   o.a[1],
                                   o.loss_power,
                                   o.path_loss_torque[0] + o.path_loss_torque[1],
                                   o.output_loss_torque};
    memcpy(v, list, sizeof list);
}

static void assert_gradient(gm_reduced_inputs *in, const gm_reduced_modes *modes,
                            gm_reduced_state *s)
{
    const gm_reduced_change by = {.oil_temperature = 1};
    const double h = 1e-3, at = in->oil_temperature;
    double below[N_VALUES], above[N_VALUES];
    gm_reduced_outputs o;
    assert_int_equal(gm_reduced_derivative(&m.frame.map, &params, in, modes, s, &by, &o),
                     0);
    const double found[N_VALUES] = {o.a_o,
                                    o.a[0],
                                    o.a[1],
                                    o.loss_power,
                                    o.path_loss_torque[0] + o.path_loss_torque[1],
                                    o.output_loss_torque};
    in->oil_temperature = at - h;
    values_at(in, modes, *s, below);
    in->oil_temperature = at + h;
    values_at(in, modes, *s, above);
    in->oil_temperature = at;
    for (int i = 0; i < N_VALUES; i++) { /* what rounding leaves of a difference */
        const double size = 1 + fabs(above[i]);
        assert_near(found[i], (above[i] - below[i]) / (2 * h), 3e-8 * size);
    }
}

static void derivatives_by_temperature_are_exact(void **state)
{
    static const int gears[][2] = {{1, 0}, {3, 4}, {0, 2}, {0, 0}, {-1, 0}, {1, 2}};
    unsigned seed = 16;
    (void)state;
    for (int k = 0; k < 300; k++) {
        build(&seed, k % 2, k % 4 < 2 ? GM_RIGID : GM_LASH, bent);
        const int *gear = gears[k % 6];
        gm_reduced_inputs in = hand_inputs(gear[0], gear[1]);
        const double w[2] = {hand_between(&seed, -400, 400),
                             hand_between(&seed, -400, 400)};
        const double w_o = k % 5 ? hand_between(&seed, -40, 40) : 0;
        gm_reduced_state s;
        gm_reduced_modes modes = {{0}, {0}, 0};
        int jumped;
        vary(1, &seed, &in); /* not the gears */
        in.oil_temperature = hand_between(&seed, 264, 302);
        gm_reduced_start(&m.frame.map, &in, w_o, w, &s);
        gm_reduced_modes_update(&m.frame.map, &params, &in, &s, &modes, &jumped);
        if (!modes.outside) {
            assert_gradient(&in, &modes, &s);
        }
    }
}

static void a_map_without_axis_knows_no_temperature(void **state)
{
    unsigned seed = 17;
    (void)state;
    build(&seed, 0, GM_RIGID, bent);
    for (int n = 0; n < 2; n++) {
        gm_reduced_map map = m.slice[1].map;
        map.oil = (gm_oil_axis){n, oil_temperatures, NULL};
        for (double temperature = 100; temperature < 900; temperature += 200) {
            const gm_reduced_change by = {.oil_temperature = 1};
            gm_reduced_inputs in = hand_inputs(1, 0);
            gm_reduced_state s = hand_start(&m.frame, 1, 0, 20), t = s;
            gm_reduced_outputs x, y;
            in.oil_temperature = temperature;
            assert_int_equal(gm_reduced_outputs_at(&map, &params, &in, &s, &x), 0);
            assert_int_equal(gm_reduced_outputs_at(&m.slice[1].map, &params, &in, &t, &y),
                             0);
            assert_true(x.loss_power == y.loss_power);
            assert_int_equal(gm_reduced_derivative(&map, &params, &in, NULL, &s, &by, &x),
                             0);
            assert_true(x.loss_power == 0 && x.a_o == 0);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(at_a_slice_the_map_is_that_slice_to_the_bit),
        cmocka_unit_test(between_slices_losses_follow_the_share),
        cmocka_unit_test(beyond_the_ends_the_nearest_slice_serves_and_is_flagged),
        cmocka_unit_test(a_temperature_that_is_no_number_is_refused),
        cmocka_unit_test(the_account_closes_while_the_temperature_changes),
        cmocka_unit_test(derivatives_by_temperature_are_exact),
        cmocka_unit_test(a_map_without_axis_knows_no_temperature),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
