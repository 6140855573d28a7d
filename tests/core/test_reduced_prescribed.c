/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Flanges whose motion is prescribed: the same gearset driven by torques tells the speeds
 * and accelerations, the prescribed one must tell the torques back, at an instant and
 * over steps; and it keeps the account whatever is prescribed.
 */
#include "core/gm_reduced_modes.h"
#include "hand_map.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "near.h"

enum { SHAFTS = GM_MAX_PATHS + 1, OUT = GM_MAX_PATHS };

static hand_map m, told;

typedef struct rig {
    gm_reduced_params params;
    gm_reduced_inputs in;
    gm_reduced_state s;
} rig;

/* The same map twice; in the second the flanges of the mask are prescribed. */
static void build(unsigned *seed, int mask)
{
    const hand_spec spec = hand_random_spec(seed);
    hand_build(&spec, &m);
    hand_build(&spec, &told);
    for (int k = 0; k < SHAFTS; k++) {
        told.map.prescribed[k] = mask >> k & 1;
    }
}

static void speeds_of(const gm_reduced_state *s, double w[SHAFTS])
{
    w[0] = s->path[0].w;
    w[1] = s->path[1].w;
    w[OUT] = s->w_o;
}

static void take_accelerations(const gm_reduced_outputs *o, gm_reduced_inputs *in)
{
    in->a[0] = o->a[0];
    in->a[1] = o->a[1];
    in->a[OUT] = o->a_o;
}

static rig random_rig(unsigned *seed, int fidelity)
{
    static const int gears[2][3] = {{0, 1, 3}, {0, 2, 4}};
    const double w[2] = {hand_between(seed, -300, 300), hand_between(seed, -300, 300)};
    rig r;
    gm_reduced_default_params(&m.map, &r.params);
    r.params.fidelity = fidelity;
    r.in = hand_inputs(gears[0][(int)(3 * hand_random(seed))],
                       gears[1][(int)(3 * hand_random(seed))]);
    r.in.output_tau = hand_between(seed, -500, 500);
    r.in.path_tau[0] = hand_between(seed, -100, 100);
    r.in.path_tau[1] = hand_between(seed, -100, 100);
    gm_reduced_start(&m.map, &r.in, hand_between(seed, -40, 40), w, &r.s);
    return r;
}

static double torque_of(const gm_reduced_inputs *in, int k)
{
    return k == OUT ? in->output_tau : in->path_tau[k];
}

/* Paths' motion is prescribed in fidelity lash only. */
static int mask_of(int trial, int fidelity)
{
    return fidelity == GM_RIGID ? 1 << OUT : 1 + trial % 7;
}

static void torques_come_back_at_an_instant(void **state)
{
    unsigned seed = 11;
    (void)state;
    for (int trial = 0; trial < 4000; trial++) {
        const int fidelity = trial % 2 ? GM_RIGID : GM_LASH,
                  mask = mask_of(trial, fidelity);
        gm_reduced_outputs o, back;
        build(&seed, mask);
        rig r = random_rig(&seed, fidelity);
        assert_int_equal(gm_reduced_outputs_at(&m.map, &r.params, &r.in, &r.s, &o) &
                             GM_FLAG_NOT_FINITE,
                         0);
        rig p = r;
        speeds_of(&r.s, p.in.w);
        take_accelerations(&o, &p.in);
        p.in.output_tau = mask >> OUT & 1 ? 1e9 : p.in.output_tau; /* not looked at */
        gm_reduced_outputs_at(&told.map, &p.params, &p.in, &p.s, &back);
        for (int k = 0; k < SHAFTS; k++) { /* rounding of torques of 1e3 */
            assert_near(back.tau[k], torque_of(&r.in, k), 1e-9 * 1e3);
        }
        assert_near(back.loss_power, o.loss_power, 1e-9 * (1e3 + fabs(o.loss_power)));
        assert_near(back.a_o, o.a_o, 1e-9 * (1 + fabs(o.a_o)));
    }
}

/* One step by torques tells the mean accelerations; prescribed, these lead through the
 * same step. Steps with an event inside are left out: there the speed has a kink. */
static void steps_are_the_same(void **state)
{
    unsigned seed = 12;
    int compared = 0;
    (void)state;
    for (int trial = 0; trial < 4000; trial++) {
        const int fidelity = trial % 2 ? GM_RIGID : GM_LASH,
                  mask = mask_of(trial, fidelity);
        const double h = 2e-5; /* one part: no vibration asks for more */
        double before[SHAFTS], after[SHAFTS];
        int turned = 0;
        build(&seed, mask);
        rig r = random_rig(&seed, fidelity), p = r;
        speeds_of(&r.s, before);
        gm_reduced_step(&m.map, &r.params, &r.in, h, &r.s);
        speeds_of(&r.s, after);
        for (int k = 0; k < SHAFTS; k++) {
            p.in.w[k] = before[k];
            p.in.a[k] = (after[k] - before[k]) / h;
            turned |= before[k] * after[k] <= 0;
        }
        if (turned) {
            continue;
        }
        compared++;
        gm_reduced_step(&told.map, &p.params, &p.in, h, &p.s);
        for (int q = 0; q < 2; q++) {
            assert_near(p.s.path[q].w, r.s.path[q].w, 1e-5 * (1 + fabs(after[q])));
            assert_near(p.s.path[q].twist, r.s.path[q].twist, 1e-8);
        }
        assert_near(p.s.w_o, r.s.w_o, 1e-5 * (1 + fabs(after[OUT])));
        /* passes leave up to 1e-4 of a loss torque: 1e-3 N.m / J h */
        assert_near(p.s.work, r.s.work, 1e-5 * (1 + fabs(r.s.work)));
        assert_near(p.s.loss_energy, r.s.loss_energy, 1e-5 * (1 + r.s.loss_energy));
    }
    assert_true(compared > 2000);
}

static double random_speed(unsigned *seed, double most)
{
    return hand_random(seed) < 0.2 ? 0 : hand_between(seed, -most, most);
}

/* Speeds that jump, accelerations that do not belong to them, gears that come and go. */
static void the_account_closes_whatever_is_prescribed(void **state)
{
    unsigned seed = 13;
    (void)state;
    for (int trial = 0; trial < 400; trial++) {
        const int fidelity = trial % 2 ? GM_RIGID : GM_LASH;
        build(&seed, mask_of(trial, fidelity));
        rig r = random_rig(&seed, fidelity);
        double scale = 1;
        r.in.w[OUT] = r.s.w_o;
        gm_reduced_start(&told.map, &r.in, r.s.w_o, r.in.w, &r.s);
        const double start = hand_energy(&told, &r.params, &r.s);
        for (int i = 0; i < 60; i++) {
            const double loss = r.s.loss_energy;
            if (i % 7 == 0) {
                for (int k = 0; k < SHAFTS; k++) {
                    r.in.w[k] = random_speed(&seed, k == OUT ? 40 : 300);
                    r.in.a[k] = random_speed(&seed, 1000);
                }
                r.in.gear[i % 2] = i % 2 ? 2 : 3;
            }
            r.in.gear[0] = i % 20 > 14 ? 0 : r.in.gear[0];
            assert_int_equal(gm_reduced_step(&told.map, &r.params, &r.in, 1e-3, &r.s) &
                                 GM_FLAG_NOT_FINITE,
                             0);
            for (int k = 0; k < SHAFTS; k++) {
                r.in.w[k] += 1e-3 * r.in.a[k];
            }
            scale += fabs(r.s.work) + r.s.loss_energy;
            assert_true(r.s.loss_energy >= loss - 1e-9 * scale);
            assert_near(r.s.work + start,
                        hand_energy(&told, &r.params, &r.s) + r.s.loss_energy,
                        1e-9 * (scale + start));
        }
    }
}

/* Nothing tells the friction of a prescribed shaft that stands: it takes what the springs
 * give, and a path that stands by itself is held. */
static void a_prescribed_shaft_at_rest_has_no_friction(void **state)
{
    hand_spec spec = hand_default();
    gm_reduced_outputs o;
    (void)state;
    hand_build(&spec, &told);
    told.map.prescribed[OUT] = 1;
    rig r = {.in = hand_inputs(1, 0), .s = hand_start(&told, 1, 0, 0)};
    gm_reduced_default_params(&told.map, &r.params);
    r.params.fidelity = GM_LASH;
    r.s.path[0].twist = 0.004;
    r.in.path_tau[0] = 0.0;
    assert_int_equal(gm_reduced_outputs_at(&told.map, &r.params, &r.in, &r.s, &o), 0);
    const double spring = spec.stiffness[0] * (0.004 - spec.lash[0] / 2);
    assert_near(o.tau[OUT], -spec.ratio[0][1] * spring, 1e-9 * 1e3);
    assert_near(o.a_o, 0, 0);
}

/* Modes of an exchange: one update finds them, another changes nothing, and the event of
 * a prescribed shaft that starts to turn is told. */
static void events_of_an_exchange_are_told(void **state)
{
    hand_spec spec = hand_default();
    gm_reduced_modes modes = {{0}, {0}, 0};
    double z[GM_MAX_INDICATORS];
    int jumped;
    (void)state;
    hand_build(&spec, &told);
    told.map.prescribed[OUT] = 1;
    rig r = {.in = hand_inputs(1, 0), .s = hand_start(&told, 1, 0, 0)};
    gm_reduced_default_params(&told.map, &r.params);
    r.params.fidelity = GM_LASH;
    gm_reduced_modes_update(&told.map, &r.params, &r.in, &r.s, &modes, &jumped);
    assert_int_equal(modes.direction[OUT], 0);
    const int last = 2 * told.map.n_paths;
    gm_reduced_modes_indicators(&told.map, &r.params, &r.in, &modes, &r.s, z);
    assert_true(z[last] > 0);
    r.in.w[OUT] = -0.5;
    gm_reduced_modes_indicators(&told.map, &r.params, &r.in, &modes, &r.s, z);
    assert_true(z[last] < 0);
    gm_reduced_modes_update(&told.map, &r.params, &r.in, &r.s, &modes, &jumped);
    assert_int_equal(modes.direction[OUT], -1);
    assert_false(jumped);
    gm_reduced_modes_indicators(&told.map, &r.params, &r.in, &modes, &r.s, z);
    assert_true(z[last] > 0);
}

/* From rest and back to it: what was read before changes no bit. */
static void caches_have_no_influence(void **state)
{
    static const gm_reduced_cache empty;
    unsigned seed = 16;
    (void)state;
    for (int trial = 0; trial < 200; trial++) {
        build(&seed, trial % 2 ? 1 << OUT : 1 + trial % 7);
        rig r = random_rig(&seed, GM_LASH);
        r.in.gear[trial % 2] = 0;
        r.in.w[OUT] = 0;
        for (int p = 0; p < 2; p++) { /* on the ramps of drag lines */
            r.in.w[p] = hand_between(&seed, -1.5, 1.5);
        }
        gm_reduced_start(&told.map, &r.in, 0, r.in.w, &r.s);
        rig fresh = r;
        for (int i = 0; i < 60; i++) {
            gm_reduced_outputs o, p;
            r.in.a[OUT] = fresh.in.a[OUT] = i < 10 || i >= 50 ? 0 : i < 30 ? 30 : -30;
            fresh.s.cache = empty;
            gm_reduced_outputs_at(&told.map, &r.params, &r.in, &r.s, &o);
            gm_reduced_outputs_at(&told.map, &r.params, &fresh.in, &fresh.s, &p);
            assert_near(o.loss_power, p.loss_power, 0);
            fresh.s.cache = empty;
            gm_reduced_step(&told.map, &r.params, &r.in, 1e-3, &r.s);
            gm_reduced_step(&told.map, &r.params, &fresh.in, 1e-3, &fresh.s);
            assert_near(r.s.loss_energy, fresh.s.loss_energy, 0);
            for (int q = 0; q < 2; q++) {
                assert_near(r.s.path[q].w, fresh.s.path[q].w, 0);
            }
            r.in.w[OUT] = fresh.in.w[OUT] = r.s.w_o;
        }
    }
}

static void a_prescribed_motion_that_is_no_number_is_told(void **state)
{
    unsigned seed = 15;
    (void)state;
    build(&seed, 1 << OUT);
    rig r = random_rig(&seed, GM_RIGID);
    const gm_reduced_state before = r.s;
    r.in.w[OUT] = (double)NAN;
    assert_int_equal(gm_reduced_step(&told.map, &r.params, &r.in, 1e-3, &r.s),
                     GM_FLAG_NOT_FINITE);
    assert_near(r.s.w_o, before.w_o, 0);
    assert_int_equal(gm_reduced_step(&m.map, &r.params, &r.in, 1e-3, &r.s) &
                         GM_FLAG_NOT_FINITE,
                     0); /* not prescribed there */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(torques_come_back_at_an_instant),
        cmocka_unit_test(steps_are_the_same),
        cmocka_unit_test(the_account_closes_whatever_is_prescribed),
        cmocka_unit_test(a_prescribed_shaft_at_rest_has_no_friction),
        cmocka_unit_test(caches_have_no_influence),
        cmocka_unit_test(events_of_an_exchange_are_told),
        cmocka_unit_test(a_prescribed_motion_that_is_no_number_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
