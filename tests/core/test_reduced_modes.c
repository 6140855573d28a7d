/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The reduced gearset as an equation with events: modes agree with the rates after one
 * update from anywhere, indicators tell every change of mode, and an integrator that
 * knows nothing of gears arrives where the time stepping does.
 */
#include "core/gm_reduced_modes.h"
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
    gm_reduced_inputs in;
    gm_reduced_state s;
    gm_reduced_modes modes;
} fixture;

static fixture f;

static void use(const hand_spec *spec)
{
    static const gm_reduced_modes unknown = {{0}, {0}, 0};
    f.spec = *spec;
    hand_build(spec, &f.m);
    gm_reduced_default_params(&f.m.map, &f.params);
    f.modes = unknown;
}

static int update(void)
{
    int jumped = 0;
    const int flags =
        gm_reduced_modes_update(&f.m.map, &f.params, &f.in, &f.s, &f.modes, &jumped);
    assert_int_equal(flags & GM_FLAG_NOT_FINITE, 0);
    return jumped;
}

static gm_reduced_outputs outputs(void)
{
    gm_reduced_outputs o;
    assert_int_equal(
        gm_reduced_modes_outputs(&f.m.map, &f.params, &f.in, &f.modes, &f.s, &o) &
            GM_FLAG_NOT_FINITE,
        0);
    return o;
}

static void indicators(double z[GM_MAX_INDICATORS])
{
    assert_int_equal(
        gm_reduced_modes_indicators(&f.m.map, &f.params, &f.in, &f.modes, &f.s, z) &
            GM_FLAG_NOT_FINITE,
        0);
}

static void random_inputs(unsigned *seed)
{
    static const int gears[] = {0, 0, 1, 2, 3, 4, -1, 7};
    const double t = f.spec.torque_max * (hand_random(seed) < 0.3 ? 0.01 : 1);
    f.in = hand_inputs(gears[(int)(hand_random(seed) * 8)],
                       gears[(int)(hand_random(seed) * 8)]);
    f.in.output_tau = hand_between(seed, -5 * t, 5 * t);
    f.in.path_tau[0] = hand_between(seed, -t, t);
    f.in.path_tau[1] = hand_between(seed, -t, t);
}

/* Zero, tiny or any speed. */
static double random_speed(unsigned *seed, double most)
{
    const double kind = hand_random(seed), w = hand_between(seed, -most, most);
    return kind < 0.4 ? 0 : kind < 0.5 ? 1e-9 * w : w;
}

static void random_state(unsigned *seed)
{
    const double w[2] = {random_speed(seed, 400), random_speed(seed, 400)};
    f.params.fidelity = hand_random(seed) < 0.5 ? GM_RIGID : GM_LASH;
    gm_reduced_start(&f.m.map, &f.in, random_speed(seed, 60), w, &f.s);
    for (int p = 0; p < 2 && f.params.fidelity == GM_LASH; p++) {
        if (f.s.path[p].mode == GM_PATH_ENGAGED) {
            f.s.path[p].w += random_speed(seed, 3);
            f.s.path[p].twist = random_speed(seed, 0.02);
        }
    }
}

/* ---- one pass ---- */

static void check_rates_agree(const gm_reduced_outputs *o)
{
    for (int k = 0; k < GM_MODE_SHAFTS; k++) {
        const int is_path = k < GM_OUTPUT_SHAFT;
        if (is_path && (k >= f.m.map.n_paths || f.s.path[k].mode == GM_PATH_ENGAGED)) {
            continue;
        }
        const double w = is_path ? f.s.path[k].w : f.s.w_o,
                     a = is_path ? o->a[k] : o->a_o;
        const int direction = f.modes.direction[k];
        if (direction == 0) {
            assert_true(w == 0 && a == 0);
        } else {
            assert_true(direction * w >= 0);
            assert_true(w != 0 || direction * a > 0);
        }
    }
}

/* From any state, under any inputs and whatever the modes were. */
static void one_update_leads_to_modes_that_agree_with_the_rates(void **state)
{
    unsigned seed = 7;
    (void)state;
    for (int trial = 0; trial < 40000; trial++) {
        double z[GM_MAX_INDICATORS];
        if (trial % 20 == 0) {
            const hand_spec spec = hand_random_spec(&seed);
            use(&spec);
        }
        random_inputs(&seed);
        if (trial % 3 == 0 || trial % 20 == 0) {
            random_state(&seed);
        }
        for (int k = 0; k < GM_MODE_SHAFTS; k++) {
            f.modes.direction[k] = (int)(hand_random(&seed) * 3) - 1;
        }
        update();
        const gm_reduced_outputs o = outputs();
        check_rates_agree(&o);
        indicators(z);
        for (int i = 0; i < gm_reduced_indicators(&f.m.map) - 1; i++) {
            assert_true(z[i] > 0);
        }
    }
}

static void a_second_update_changes_nothing(void **state)
{
    unsigned seed = 19;
    (void)state;
    for (int trial = 0; trial < 2000; trial++) {
        const hand_spec spec = hand_random_spec(&seed);
        use(&spec);
        random_inputs(&seed);
        random_state(&seed);
        random_inputs(&seed);
        update();
        const gm_reduced_modes modes = f.modes;
        const gm_reduced_state s = f.s;
        assert_int_equal(update(), 0);
        assert_memory_equal(&modes, &f.modes, sizeof modes);
        assert_true(s.w_o == f.s.w_o && s.loss_energy == f.s.loss_energy);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_update_leads_to_modes_that_agree_with_the_rates),
        cmocka_unit_test(a_second_update_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
