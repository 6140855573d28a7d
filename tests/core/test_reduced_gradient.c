/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Derivatives of the outputs against differences, over random maps, states, torques and
 * modes.
 */
#include "core/gm_reduced_gradient.h"
#include "hand_map.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

#include "near.h"

typedef struct point {
    gm_reduced_params params;
    gm_reduced_inputs in;
    gm_reduced_state s;
} point;

static hand_map m;

static double random_speed(unsigned *seed, double most)
{
    return hand_random(seed) < 0.3 ? 0 : hand_between(seed, -most, most);
}

static int random_gear(unsigned *seed)
{
    static const int gears[] = {0, 1, 2, 3, 4, -1};
    return gears[(int)(hand_random(seed) * 6)];
}

static point random_point(unsigned *seed, double torque)
{
    point a;
    const double w[2] = {random_speed(seed, 400), random_speed(seed, 400)};
    gm_reduced_default_params(&m.map, &a.params);
    a.params.loss_scale = hand_between(seed, 0.5, 2);
    a.in = hand_inputs(random_gear(seed), random_gear(seed));
    a.in.output_tau = hand_between(seed, -3 * torque, 3 * torque);
    a.in.path_tau[0] = hand_between(seed, -torque, torque);
    a.in.path_tau[1] = hand_between(seed, -torque, torque);
    gm_reduced_start(&m.map, &a.in, random_speed(seed, 50), w, &a.s);
    return a;
}

static gm_reduced_change random_change(unsigned *seed)
{
    const gm_reduced_change by = {hand_between(seed, -1, 1),
                                  {hand_between(seed, -1, 1), hand_between(seed, -1, 1)},
                                  hand_between(seed, -1, 1),
                                  {hand_between(seed, -1, 1), hand_between(seed, -1, 1)},
                                  hand_between(seed, -0.1, 0.1)};
    return by;
}

/* The point moved; held shafts stay at rest. */
static point moved(const point *a, const gm_reduced_modes *modes,
                   const gm_reduced_change *by, double h)
{
    point b = *a;
    b.params.loss_scale += h * by->loss_scale;
    b.in.output_tau += h * by->output_tau;
    b.s.w_o += modes->direction[GM_OUTPUT_SHAFT] ? h * by->w_o : 0;
    for (int p = 0; p < 2; p++) {
        b.in.path_tau[p] += h * by->path_tau[p];
        b.s.path[p].w += modes->direction[p] ? h * by->w[p] : 0;
    }
    return b;
}

static gm_reduced_outputs outputs(const gm_reduced_modes *modes, point *a)
{
    gm_reduced_outputs o;
    assert_int_equal(
        gm_reduced_modes_outputs(&m.map, &a->params, &a->in, modes, &a->s, &o) &
            GM_FLAG_NOT_FINITE,
        0);
    return o;
}

enum { N_VALUES = 11 };

static void values_of(const gm_reduced_outputs *o, double v[N_VALUES])
{
    const double list[N_VALUES] = {o->a_o,
                                   o->a[0],
                                   o->a[1],
                                   o->transmitted[0],
                                   o->transmitted[1],
                                   o->path_loss_torque[0],
                                   o->path_loss_torque[1],
                                   o->output_loss_torque,
                                   o->loss_power,
                                   o->kinetic_energy,
                                   0};
    memcpy(v, list, sizeof list);
}

/* Against the central difference. A kink of the tables within h bends the function by up
 * to h times its change of slope, curvature by h^2 only: more than 1e-10 is taken for a
 * kink, and kinks below that change the quotient by up to 1e-10/(2 h) = 5e-6. Returns
 * whether there was none. */
static int check_direction(const gm_reduced_modes *modes, point *a,
                           const gm_reduced_change *by)
{
    const double h = 1e-5;
    gm_reduced_outputs exact;
    double low[N_VALUES], here[N_VALUES], high[N_VALUES], v[N_VALUES];
    point below = moved(a, modes, by, -h), above = moved(a, modes, by, h);
    gm_reduced_outputs o = outputs(modes, &below);
    values_of(&o, low);
    o = outputs(modes, &above);
    values_of(&o, high);
    o = outputs(modes, a);
    values_of(&o, here);
    assert_int_equal(
        gm_reduced_derivative(&m.map, &a->params, &a->in, modes, &a->s, by, &exact) &
            GM_FLAG_NOT_FINITE,
        0);
    values_of(&exact, v);
    for (int i = 0; i < N_VALUES; i++) {
        const double size = 1 + fabs(v[i]) + fabs(here[i]) * 1e-3;
        if (fabs(high[i] - 2 * here[i] + low[i]) > 1e-10 * size) {
            return 0;
        }
    }
    for (int i = 0; i < N_VALUES; i++) {
        const double size = fabs(v[i]) + 1e-3 * fabs(here[i]) + 1;
        if (fabs((high[i] - low[i]) / (2 * h) - v[i]) > 1e-5 * size) {
            fail_msg("value %d: %.12g, by differences %.12g", i, v[i],
                     (high[i] - low[i]) / (2 * h));
        }
    }
    return 1;
}

static void derivatives_are_those_of_differences(void **state)
{
    unsigned seed = 3;
    int smooth = 0, held = 0;
    const int trials = 20000;
    (void)state;
    for (int trial = 0; trial < trials; trial++) {
        gm_reduced_modes modes = {{0}, {0}, 0};
        int jumped;
        if (trial % 20 == 0) {
            const hand_spec spec = hand_random_spec(&seed);
            hand_build(&spec, &m);
        }
        point a = random_point(&seed, trial % 2 ? 300 : 2);
        const gm_reduced_change by = random_change(&seed);
        a.in.gear[trial % 2] = random_gear(&seed); /* may begin to synchronise */
        gm_reduced_modes_update(&m.map, &a.params, &a.in, &a.s, &modes, &jumped);
        smooth += check_direction(&modes, &a, &by);
        held += modes.direction[GM_OUTPUT_SHAFT] == 0;
    }
    assert_true(smooth > trials / 2);
    assert_true(held > trials / 20);
}

/* Where nothing is at a limit the modes of a step are those of an update. */
static void derivatives_in_a_step_are_those_in_its_modes(void **state)
{
    unsigned seed = 5;
    (void)state;
    for (int trial = 0; trial < 2000; trial++) {
        gm_reduced_modes modes = {{0}, {0}, 0};
        gm_reduced_outputs in_modes, in_step;
        double u[N_VALUES], v[N_VALUES];
        int jumped;
        const hand_spec spec = hand_random_spec(&seed);
        hand_build(&spec, &m);
        point a = random_point(&seed, 100);
        const gm_reduced_change by = random_change(&seed);
        gm_reduced_modes_update(&m.map, &a.params, &a.in, &a.s, &modes, &jumped);
        gm_reduced_derivative(&m.map, &a.params, &a.in, &modes, &a.s, &by, &in_modes);
        gm_reduced_derivative(&m.map, &a.params, &a.in, NULL, &a.s, &by, &in_step);
        values_of(&in_modes, u);
        values_of(&in_step, v);
        assert_memory_equal(u, v, sizeof u);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(derivatives_are_those_of_differences),
        cmocka_unit_test(derivatives_in_a_step_are_those_in_its_modes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
