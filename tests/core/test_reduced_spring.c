/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Fidelity lash: the spring's law and its account of energy, its vibration against the
 * closed form, the same steady losses as rigid, and steps of any length.
 */
#include "hand_map.h"
#include "core/reduced_parts.h"

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
    params.fidelity = GM_LASH;
}

static gm_spring spring_now(const gm_gear *gear, double twist, double slip)
{
    const gm_stride stride = {0, slip, 0, gm_spring_damping(gear, twist, slip)};
    return gm_spring_at(gear, twist, &stride);
}

/* ---- the law ---- */

/* By hand: in contact k e + d s + d_l s (1 + |s|) / (1 + |s| + s^2); in the gap 0.05 of
 * the damping; half a film before contact it is half way between. */
static void follows_its_law(void **state)
{
    const gm_gear gear = {
        .stiffness = 1e5, .damping = 10, .loose_damping = 50, .lash = 1e-3, .film = 1e-4};
    const double slip[4] = {0, 1, -1, -4};
    const double torque[4] = {30, 40 + 100. / 3, 20 - 100. / 3, -10 - 1000. / 21};
    (void)state;
    for (int i = 0; i < 4; i++) {
        assert_near(spring_now(&gear, 8e-4, slip[i]).torque, torque[i], 1e-10);
        assert_near(spring_now(&gear, -8e-4, -slip[i]).torque, -torque[i], 1e-10);
        const double damper = torque[i] - 30;
        assert_near(spring_now(&gear, 3e-4, slip[i]).torque, 0.05 * damper, 1e-10);
        assert_near(spring_now(&gear, 4.5e-4, slip[i]).torque, (0.05 + 0.95 / 2) * damper,
                    1e-10);
        assert_near(spring_now(&gear, 8e-4, slip[i]).power, damper * slip[i], 1e-12);
    }
}

/* The gradient at an instant against differences, over the gap and both flanks. */
static void its_gradient_is_exact(void **state)
{
    unsigned seed = 10;
    (void)state;
    for (int i = 0; i < 10000; i++) {
        const gm_gear gear = {.stiffness = 1e5,
                              .damping = 10,
                              .loose_damping = 50,
                              .lash = 1e-3,
                              .film = 1e-4};
        const double twist = hand_between(&seed, -7e-4, 7e-4), h = 1e-9;
        const double slip = hand_between(&seed, -1, 1);
        if (fabs(fabs(twist) - 5e-4) < 2 * h)
            continue; /* the spring's kink */
        const gm_spring_gradient g = gm_spring_gradient_at(&gear, twist, slip);
        const gm_spring up = spring_now(&gear, twist + h, slip),
                        down = spring_now(&gear, twist - h, slip),
                        more = spring_now(&gear, twist, slip + 3e-5),
                        less = spring_now(&gear, twist, slip - 3e-5);
        /* curvature of the film's share: 6 / film^2 over h */
        assert_near(g.torque_twist, (up.torque - down.torque) / (2 * h), 10);
        assert_near(g.power_twist, (up.power - down.power) / (2 * h), 10);
        assert_near(g.torque_slip, (more.torque - less.torque) / 6e-5, 1e-6);
        assert_near(g.power_slip, (more.power - less.power) / 6e-5, 1e-6);
    }
}

/* A way of any length: in contact, in the gap, across one flank or both. */
static void random_way(unsigned *seed, gm_gear *gear, double *twist, gm_stride *stride)
{
    gear->stiffness = hand_between(seed, 1e3, 1e5);
    gear->lash = hand_random(seed) < 0.2 ? 0 : hand_between(seed, 1e-4, 1e-2);
    gear->film = hand_random(seed) < 0.2 ? 0 : hand_between(seed, 0, 1e-3);
    *twist = hand_between(seed, -0.01, 0.01);
    stride->h = pow(10, hand_between(seed, -6, -1));
    stride->slip = hand_between(seed, -0.02, 0.02) / stride->h;
    stride->late = hand_random(seed) < 0.5 ? 0 : hand_random(seed);
    stride->damping = hand_between(seed, 0, 50);
}

static void takes_what_it_stores_and_loses(void **state)
{
    unsigned seed = 8;
    (void)state;
    for (int i = 0; i < 100000; i++) {
        gm_gear gear = {0};
        gm_stride stride;
        double twist;
        random_way(&seed, &gear, &twist, &stride);
        const double way = stride.h * stride.slip;
        const gm_spring s = gm_spring_at(&gear, twist, &stride);
        const double u = gm_spring_energy(&gear, twist),
                     more = gm_spring_energy(&gear, twist + way) - u;
        assert_true(s.power >= 0);
        /* roundings of energies that nearly cancel */
        assert_near(s.torque * way, more + s.power * stride.h,
                    1e-13 * (u + fabs(more) + fabs(s.torque * way)));
    }
}

static void the_slope_is_the_derivative_of_the_torque(void **state)
{
    unsigned seed = 9;
    int kinks = 0;
    (void)state;
    for (int i = 0; i < 10000; i++) {
        gm_gear gear = {0};
        gm_stride stride;
        double twist;
        random_way(&seed, &gear, &twist, &stride);
        gm_stride less = stride, more = stride;
        const double step = 1e-6 * fabs(stride.slip) + 1e-9;
        less.slip -= step;
        more.slip += step;
        const gm_spring s = gm_spring_at(&gear, twist, &stride);
        const double quotient = (gm_spring_at(&gear, twist, &more).torque -
                                 gm_spring_at(&gear, twist, &less).torque) /
                                (2 * step);
        assert_true(s.slope >= 0);
        /* 1e-5: curvature and rounding of the quotient; wrong only across a kink */
        kinks += fabs(s.slope - quotient) > 1e-5 * s.slope + 1e-5 * fabs(s.torque);
    }
    assert_true(kinks < 20);
}

/* ---- the vibration ---- */

/* Path 0 in gear 1 against a heavy output, preloaded, let go: theta'' = -(k theta + d
 * theta')/J about the preload; slips are too small to lessen the damping. */
static void vibrates_as_the_damped_oscillator(void **state)
{
    hand_spec spec = hand_lossless();
    (void)state;
    spec.inertia_output = 1e9;
    use(&spec);
    gm_reduced_inputs in = hand_inputs(1, 0);
    gm_reduced_state s = hand_start(&m, 1, 0, 0);
    const gm_gear *gear = &m.gear[0][1];
    const double k = gear->stiffness, d = gear->damping + gear->loose_damping,
                 j = spec.inertia[0];
    const double rest = gear->lash / 2 + 40 / k, x_0 = 2e-3 / k, h = 1e-5;
    const double decay = d / (2 * j), omega = sqrt(k / j - decay * decay);
    in.path_tau[0] = 40;
    s.path[0].twist = rest + x_0;
    for (int i = 1; i <= 1000; i++) {
        gm_reduced_step(&m.map, &params, &in, h, &s);
        const double t = i * h, x = x_0 * exp(-decay * t) *
                                    (cos(omega * t) + decay / omega * sin(omega * t));
        /* midpoint rule: phase (omega h)^2/12 of omega t, here 3e-5 of 13 */
        assert_near(s.path[0].twist - rest, x, 1e-3 * x_0);
    }
}

/* ---- beside rigid ---- */

static double balance_of(int fidelity, gm_reduced_inputs *in, gm_reduced_state *s,
                         gm_reduced_outputs *o)
{
    params.fidelity = fidelity;
    /* far from balance the inertia torque may lie outside the map */
    assert_int_equal(
        gm_reduced_outputs_at(&m.map, &params, in, s, o) & ~GM_FLAG_OUT_OF_MAP, 0);
    return o->a_o * o->inertia_o;
}

/* The output torque for constant speed in rigid; the same point in lash, with the twist
 * that carries the torque, stands still as well and loses the same power. */
static void loses_the_same_as_rigid_in_steady_motion(void **state)
{
    unsigned seed = 31;
    (void)state;
    for (int i = 0; i < 2000; i++) {
        hand_spec spec = hand_random_spec(&seed);
        const int gear_0 = i % 3 == 0 ? -1 : i % 3 == 1 ? 1 : 3, gear_1 = i % 2 ? 4 : 2;
        const double w_o = hand_between(&seed, -90, 90);
        gm_reduced_outputs rigid, lash;
        use(&spec);
        gm_reduced_inputs in = hand_inputs(gear_0, gear_1);
        gm_reduced_state s = hand_start(&m, gear_0, gear_1, w_o);
        for (int p = 0; p < 2; p++) {
            in.path_tau[p] = hand_between(&seed, -200, 200);
        }
        for (int k = 0; k < 40; k++) { /* D and X follow J a, by a part < 1 of it */
            in.output_tau -= balance_of(GM_RIGID, &in, &s, &rigid);
        }
        for (int p = 0; p < 2; p++) {
            const gm_gear *gear = &m.gear[p][s.path[p].gear];
            const int backward = s.path[p].w < 0;
            const gm_table1 *pin = &gear->pin[backward];
            gm_cell1 cell = {0};
            const double drag = gm_table1_at(pin, 1, &cell, fabs(s.path[p].w)).value;
            const double torque = in.path_tau[p] - (backward ? -drag : drag);
            s.path[p].twist =
                torque / gear->stiffness + (torque < 0 ? -gear->lash : gear->lash) / 2;
        }
        assert_near(balance_of(GM_LASH, &in, &s, &lash), 0, 1e-8);
        assert_near(lash.a[0], 0, 1e-6);
        assert_near(lash.a[1], 0, 1e-6);
        assert_near(lash.loss_power, rigid.loss_power, 1e-9 * (1 + rigid.loss_power));
        assert_near(lash.transmitted[0], in.path_tau[0], 1e-9);
    }
}

static void a_gear_without_stiffness_is_rigid(void **state)
{
    hand_spec spec = hand_default();
    (void)state;
    spec.stiffness[0] = 0;
    use(&spec);
    gm_reduced_inputs in = hand_inputs(1, 0);
    gm_reduced_state a = hand_start(&m, 1, 0, 10), b = a;
    in.path_tau[0] = 50;
    for (int i = 0; i < 100; i++) {
        params.fidelity = GM_LASH;
        gm_reduced_step(&m.map, &params, &in, 1e-3, &a);
        params.fidelity = GM_RIGID;
        gm_reduced_step(&m.map, &params, &in, 1e-3, &b);
        assert_memory_equal(&a, &b, offsetof(gm_reduced_state, cache));
    }
}

/* ---- steps of any length ---- */

/* Torque jumps from -50 to 50 N.m through the whole lash. With every step length the
 * twist comes to its new rest, and the speed is that of the rigid body. */
static void every_step_length_is_stable(void **state)
{
    static const double steps[] = {1e-6, 1e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1};
    hand_spec spec = hand_lossless();
    (void)state;
    use(&spec);
    const gm_gear *gear = &m.gear[0][1];
    const double r = gear->ratio, j_p = spec.inertia[0];
    const double j = spec.inertia_output + r * r * j_p;
    for (int i = 0; i < 9; i++) {
        gm_reduced_inputs in = hand_inputs(1, 0);
        gm_reduced_state s = hand_start(&m, 1, 0, 20);
        const double carried = 50 - j_p * r * (r * 50 / j);
        s.path[0].twist = -gear->lash / 2 - carried / gear->stiffness;
        in.path_tau[0] = 50;
        const int n = (int)(0.6 / steps[i] + 0.5);
        for (int k = 0; k < n; k++) {
            gm_reduced_step(&m.map, &params, &in, steps[i], &s);
            assert_true(fabs(s.path[0].twist) < 2 * (gear->lash + 100 / gear->stiffness));
        }
        const double t = n * steps[i];
        /* momentum: exact but for the springs' 1e-11 */
        assert_near(r * j_p * s.path[0].w + spec.inertia_output * s.w_o,
                    j * 20 + r * 50 * t, 1e-8 * j * 20);
        assert_near(s.w_o, 20 + r * 50 / j * t, 1e-3 * s.w_o);
        assert_near(s.path[0].twist - gear->lash / 2, carried / gear->stiffness,
                    0.02 * carried / gear->stiffness);
    }
}

/* The same jump, followed for 20 ms: the error falls with the square of the step until
 * events of contact, which the steps do not meet, leave it proportional to the step. */
static void smaller_steps_are_more_exact(void **state)
{
    hand_spec spec = hand_lossless();
    double twist[5];
    (void)state;
    use(&spec);
    for (int i = 0; i < 5; i++) {
        const double h = i == 4 ? 1e-6 : 4e-4 / (1 << (2 * i));
        gm_reduced_inputs in = hand_inputs(1, 0);
        gm_reduced_state s = hand_start(&m, 1, 0, 20);
        in.path_tau[0] = 50;
        for (int k = 0; k < (int)(0.02 / h + 0.5); k++) {
            gm_reduced_step(&m.map, &params, &in, h, &s);
        }
        twist[i] = s.path[0].twist;
    }
    const double most = 50 / m.gear[0][1].stiffness;
    assert_near(twist[1], twist[4], 0.1 * most);
    assert_near(twist[2], twist[4], 0.01 * most);
    assert_near(twist[3], twist[4], 0.002 * most);
}

static void the_energy_of_the_twist_goes_when_the_gear_does(void **state)
{
    hand_spec spec = hand_lossless();
    (void)state;
    use(&spec);
    gm_reduced_inputs in = hand_inputs(1, 0);
    gm_reduced_state s = hand_start(&m, 1, 0, 20);
    s.path[0].twist = 0.01;
    const double stored = gm_spring_energy(&m.gear[0][1], 0.01);
    in.gear[0] = 0;
    gm_reduced_step(&m.map, &params, &in, 1e-3, &s);
    assert_near(s.loss_energy, stored, 1e-12 * stored);
    assert_true(s.path[0].twist == 0 && s.path[0].mode == GM_PATH_NEUTRAL);
    assert_near(s.w_o, 20, 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(follows_its_law),
        cmocka_unit_test(its_gradient_is_exact),
        cmocka_unit_test(takes_what_it_stores_and_loses),
        cmocka_unit_test(the_slope_is_the_derivative_of_the_torque),
        cmocka_unit_test(vibrates_as_the_damped_oscillator),
        cmocka_unit_test(loses_the_same_as_rigid_in_steady_motion),
        cmocka_unit_test(a_gear_without_stiffness_is_rigid),
        cmocka_unit_test(every_step_length_is_stable),
        cmocka_unit_test(smaller_steps_are_more_exact),
        cmocka_unit_test(the_energy_of_the_twist_goes_when_the_gear_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
