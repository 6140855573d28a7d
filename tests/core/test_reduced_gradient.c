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
    return hand_random(seed) < 0.15 ? 0 : hand_between(seed, -most, most);
}

static int random_gear(unsigned *seed)
{
    static const int gears[] = {0, 1, 2, 3, 4, -1};
    return gears[(int)(hand_random(seed) * 6)];
}

static double any(unsigned *seed)
{
    return hand_between(seed, -1, 1);
}

/* Many maps have flanges whose motion is prescribed; paths in fidelity lash only. */
static void prescribe(unsigned *seed, int fidelity)
{
    const int all = fidelity == GM_LASH && hand_random(seed) < 0.5;
    m.map.prescribed[GM_OUTPUT_SHAFT] = hand_random(seed) < 0.3;
    m.map.prescribed[0] = all && hand_random(seed) < 0.5;
    m.map.prescribed[1] = all && hand_random(seed) < 0.5;
}

/* Engaged paths not in step with the output. */
static void wind_up(unsigned *seed, gm_reduced_state *s)
{
    for (int p = 0; p < 2; p++) {
        if (s->path[p].mode == GM_PATH_ENGAGED) {
            const double most = m.map.path[p].gears[s->path[p].gear].lash + 0.005;
            s->path[p].twist = hand_between(seed, -most, most);
            s->path[p].w += hand_random(seed) < 0.3 ? 0 : hand_between(seed, -3, 3);
        }
    }
}

static point random_point(unsigned *seed, int fidelity, double torque)
{
    point a;
    const double w[2] = {random_speed(seed, 400), random_speed(seed, 400)};
    gm_reduced_default_params(&m.map, &a.params);
    a.params.fidelity = fidelity;
    a.params.loss_scale = hand_between(seed, 0.5, 2);
    a.in = hand_inputs(random_gear(seed), random_gear(seed));
    a.in.output_tau = hand_between(seed, -3 * torque, 3 * torque);
    a.in.path_tau[0] = hand_between(seed, -torque, torque);
    a.in.path_tau[1] = hand_between(seed, -torque, torque);
    gm_reduced_start(&m.map, &a.in, random_speed(seed, 50), w, &a.s);
    if (fidelity == GM_LASH) {
        wind_up(seed, &a.s);
    }
    for (int k = 0; k < GM_MODE_SHAFTS; k++) {
        a.in.w[k] = k == GM_OUTPUT_SHAFT ? a.s.w_o : a.s.path[k].w;
        a.in.a[k] = any(seed) * 100;
    }
    return a;
}

static gm_reduced_change random_change(unsigned *seed)
{
    const gm_reduced_change by = {.w_o = any(seed),
                                  .w = {any(seed), any(seed)},
                                  .twist = {1e-3 * any(seed), 1e-3 * any(seed)},
                                  .output_tau = any(seed),
                                  .path_tau = {any(seed), any(seed)},
                                  .a = {any(seed), any(seed), any(seed)},
                                  .loss_scale = 0.1 * any(seed)};
    return by;
}

/* The point moved; held shafts stay at rest. */
static point moved(const point *a, const gm_reduced_modes *modes,
                   const gm_reduced_change *by, double h)
{
    point b = *a;
    b.params.loss_scale += h * by->loss_scale;
    b.in.output_tau += h * by->output_tau;
    for (int k = 0; k < GM_MODE_SHAFTS; k++) {
        b.in.a[k] += h * by->a[k];
        b.in.w[k] += h * (k == GM_OUTPUT_SHAFT ? by->w_o : by->w[k]);
    }
    b.s.w_o += modes->direction[GM_OUTPUT_SHAFT] ? h * by->w_o : 0;
    for (int p = 0; p < 2; p++) {
        b.in.path_tau[p] += h * by->path_tau[p];
        b.s.path[p].twist += h * by->twist[p];
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

enum { N_VALUES = 16 };

static void values_of(const gm_reduced_outputs *o, double v[N_VALUES])
{
    const double list[N_VALUES] = {
        o->a_o,
        o->a[0],
        o->a[1],
        o->transmitted[0],
        o->transmitted[1],
        o->path_loss_torque[0],
        o->path_loss_torque[1],
        o->output_loss_torque,
        o->loss_power,
        o->kinetic_energy,
        o->elastic_energy,
        o->twist_rate[0],
        o->twist_rate[1],
        o->tau[0],
        o->tau[1],
        o->tau[GM_OUTPUT_SHAFT],
    };
    memcpy(v, list, sizeof list);
}

/* A shaft that breaks away just now: its losses have a kink right here. */
static int is_starting(const gm_reduced_modes *modes, const point *a)
{
    int starts = modes->direction[GM_OUTPUT_SHAFT] != 0 && a->s.w_o == 0;
    for (int p = 0; p < 2; p++) {
        starts |= modes->direction[p] != 0 && a->s.path[p].w == 0;
    }
    return starts;
}

/* Central difference quotients over h. */
static void quotients(const gm_reduced_modes *modes, const point *a,
                      const gm_reduced_change *by, double h, double q[N_VALUES])
{
    double low[N_VALUES], high[N_VALUES];
    point below = moved(a, modes, by, -h), above = moved(a, modes, by, h);
    const gm_reduced_outputs o = outputs(modes, &below), p = outputs(modes, &above);
    values_of(&o, low);
    values_of(&p, high);
    for (int i = 0; i < N_VALUES; i++) {
        q[i] = (high[i] - low[i]) / (2 * h);
    }
}

/* Where quotients over h and h/2 disagree there is a kink of the tables between, and
 * nothing to compare with. Returns whether there was none. */
static int check_direction(const gm_reduced_modes *modes, point *a,
                           const gm_reduced_change *by)
{
    const double h = 1e-5;
    gm_reduced_outputs exact;
    const gm_reduced_outputs o = outputs(modes, a);
    double here[N_VALUES], wide[N_VALUES], near[N_VALUES], v[N_VALUES];
    values_of(&o, here);
    quotients(modes, a, by, h, wide);
    quotients(modes, a, by, h / 2, near);
    assert_int_equal(
        gm_reduced_derivative(&m.map, &a->params, &a->in, modes, &a->s, by, &exact) &
            GM_FLAG_NOT_FINITE,
        0);
    values_of(&exact, v);
    if (is_starting(modes, a)) {
        return 0;
    }
    for (int i = 0; i < N_VALUES; i++) { /* rounding: 1e-16/h of a value */
        const double tolerance = 1e-7 * (1 + fabs(v[i])) + 1e-9 * fabs(here[i]);
        if (fabs(wide[i] - near[i]) > tolerance) {
            return 0;
        }
        if (fabs(near[i] - v[i]) > 10 * tolerance) {
            fail_msg("value %d: %.12g, by differences %.12g", i, v[i], near[i]);
        }
    }
    return 1;
}

static void check_fidelity(int fidelity)
{
    unsigned seed = 3;
    int smooth = 0, held = 0;
    const int trials = 20000;
    for (int trial = 0; trial < trials; trial++) {
        gm_reduced_modes modes = {{0}, {0}, 0};
        int jumped;
        if (trial % 20 == 0) {
            hand_spec spec = hand_random_spec(&seed);
            spec.monotone = trial % 40 == 0;
            hand_build(&spec, &m);
            prescribe(&seed, fidelity);
        }
        point a = random_point(&seed, fidelity, trial % 2 ? 300 : 2);
        const gm_reduced_change by = random_change(&seed);
        if (trial % 3 == 0) {
            a.in.gear[trial % 2] = random_gear(&seed); /* may begin to synchronise */
        }
        gm_reduced_modes_update(&m.map, &a.params, &a.in, &a.s, &modes, &jumped);
        smooth += check_direction(&modes, &a, &by);
        held += modes.direction[GM_OUTPUT_SHAFT] == 0;
    }
    assert_true(smooth > trials / 4);
    assert_true(held > trials / 100);
}

static void derivatives_are_those_of_differences(void **state)
{
    (void)state;
    check_fidelity(GM_RIGID);
    check_fidelity(GM_LASH);
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
        hand_spec spec = hand_random_spec(&seed);
        spec.monotone = trial % 4 > 1;
        hand_build(&spec, &m);
        point a = random_point(&seed, trial % 2 ? GM_RIGID : GM_LASH, 100);
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
