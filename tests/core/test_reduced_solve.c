/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The solution of a step: order of convergence, balance of momentum with the tables read
 * at mid-step, stiff couplings with long steps, maps that break the rules.
 */
#include "core/reduced_parts.h"
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

typedef double torque_law(double t);

static double swell(double t)
{
    return 40 + 20 * sin(9 * t);
}

static double to_and_fro(double t)
{
    return 30 * sin(9 * t);
}

/* One second with step h in the given gears; torques are linear between their values at
 * the steps' ends, the other path (when free) starts at 150 rad/s. */
static gm_reduced_state one_second(torque_law *law, int g0, int g1, double w_o, double h)
{
    gm_reduced_inputs in = hand_inputs(g0, g1);
    gm_reduced_state s = hand_start(&m, g0, g1, w_o);
    const int n = (int)(1 / h + 0.5);
    s.path[1].w = g1 == 0 ? 150 : s.path[1].w;
    for (int i = 0; i < n; i++) {
        const double t0 = law(i * h), t1 = law((i + 1) * h);
        in.path_tau[0] = t0;
        in.path_tau_rate[0] = (t1 - t0) / h;
        in.output_tau = -10 * 15;
        in.output_tau = w_o > 5 ? -35 * 15 : 0;
        assert_int_equal(gm_reduced_step(&m.map, &params, &in, h, &s), 0);
    }
    return s;
}

static double difference(const gm_reduced_state *a, const gm_reduced_state *b)
{
    return fabs(a->w_o - b->w_o) + fabs(a->phi_o - b->phi_o) +
           fabs(a->path[1].w - b->path[1].w) / 10 +
           fabs(a->loss_energy - b->loss_energy) / 100;
}

/* Mean order over several halvings; single ones vary as kinks of the tables move against
 * the steps. */
static double order(torque_law *law, int g0, int g1, double w_o, double h, int halvings)
{
    const gm_reduced_state truth = one_second(law, g0, g1, w_o, h / 256);
    const gm_reduced_state first = one_second(law, g0, g1, w_o, h);
    const gm_reduced_state last = one_second(law, g0, g1, w_o, ldexp(h, -halvings));
    assert_true(difference(&first, &truth) > 1e-8); /* above rounding: something to see */
    return log(difference(&first, &truth) / difference(&last, &truth)) /
           (halvings * log(2));
}

static void smooth_motion_converges_with_the_second_order(void **state)
{
    const hand_spec spec = hand_default();
    (void)state;
    use(&spec);
    assert_true(order(swell, 1, 2, 12, 1.0 / 64, 3) > 1.8);
    assert_true(order(swell, 1, 0, 12, 1.0 / 64, 3) > 1.8); /* with a free shaft */
}

static void motion_with_stops_converges_with_the_first_order_at_least(void **state)
{
    const hand_spec spec = hand_default();
    (void)state;
    use(&spec);
    assert_true(order(to_and_fro, 1, 2, 0, 1.0 / 64, 4) > 0.95);
    assert_true(order(to_and_fro, 1, 0, 0, 1.0 / 64, 4) > 0.95);
}

/* Momentum with the tables read at the mean speeds: what the step claims to solve. */
static void the_step_fulfils_the_midpoint_balance(void **state)
{
    hand_spec spec = hand_default();
    unsigned seed = 31;
    (void)state;
    spec.j0 = spec.j1 = spec.k = 0; /* R = 0; the drag has its own test */
    use(&spec);
    for (int i = 0; i < 2000; i++) {
        gm_reduced_inputs in = hand_inputs(1, 0);
        gm_reduced_state s = hand_start(&m, 1, 0, hand_between(&seed, 5, 40));
        s.path[1].w = hand_between(&seed, 20, 300);
        in.path_tau[0] = hand_between(&seed, -100, 100);
        in.output_tau = -15 * in.path_tau[0] + hand_between(&seed, -20, 20);
        const gm_reduced_state old = s;
        const double h = pow(10, hand_between(&seed, -4, -1));
        gm_reduced_step(&m.map, &params, &in, h, &s);
        const double a = (s.w_o - old.w_o) / h, b = (s.path[1].w - old.path[1].w) / h;
        const double m_o = (s.w_o + old.w_o) / 2, m_n = (s.path[1].w + old.path[1].w) / 2;
        if (m_o - 2 * fabs(m_o - old.w_o) < 0 ||
            m_n - 2 * fabs(m_n - old.path[1].w) < 0) {
            continue; /* stopped within the step */
        }
        const double rel = 15 * m_o - m_n;
        const double c = spec.c0 * fmax(-1, fmin(1, rel / spec.c_width)) + spec.c1 * rel;
        const double t = in.path_tau[0] - c - spec.inertia[0] * 15 * a;
        const double d =
            (spec.d0[0] + spec.d1 * 15 * m_o) * fabs(t) * (t < 0 ? spec.overrun : 1);
        const double p = spec.p0[0] + spec.p1 * m_o;
        /* 1e-4 of D may be left; everything else is exact but for rounding times 1/h */
        assert_near(spec.inertia_output * a, in.output_tau + 15 * (t - d) - p,
                    15 * 1e-4 * d + 1e-8);
        assert_near(spec.inertia[1] * b, c - spec.n0[0] - spec.n1 * m_n, 1e-9);
    }
}

/* A coupling like dry friction over 0.02 rad/s, both shafts free, steps of 0.1 s: the
 * explicit limit is 2 J/(c'/2) = 0.4 ms. */
static void a_stiff_coupling_stays_calm_with_long_steps(void **state)
{
    hand_spec spec = hand_lossless();
    (void)state;
    spec.c0 = 1;
    spec.c_width = 0.02;
    use(&spec);
    gm_reduced_inputs in = hand_inputs(0, 0);
    gm_reduced_state s = hand_start(&m, 0, 0, 0);
    s.path[0].w = 100;
    const double j0 = spec.inertia[0], j1 = spec.inertia[1],
                 energy = hand_kinetic(&m, &s);
    double slip = 100;
    for (int i = 0; i < 60; i++) {
        const double loss = s.loss_energy;
        gm_reduced_step(&m.map, &params, &in, 0.1, &s);
        assert_true(s.loss_energy >= loss);
        assert_true(fabs(s.path[0].w - s.path[1].w) <= fabs(slip) * (1 + 1e-12));
        slip = s.path[0].w - s.path[1].w;
        /* momentum is kept: nothing else acts */
        assert_near(j0 * s.path[0].w + j1 * s.path[1].w, j0 * 100, 1e-12);
    }
    assert_true(fabs(slip) < 0.05);
    assert_near(energy - s.loss_energy, hand_kinetic(&m, &s), 1e-12 * energy);
}

/* dD/dtau beyond 1, or friction that falls steeply with speed: no unique solution, but
 * bounded work, finite states and an exact account. */
static void maps_that_break_the_rules_do_no_harm(void **state)
{
    unsigned seed = 8;
    (void)state;
    for (int k = 0; k < 40; k++) {
        hand_spec spec = hand_random_spec(&seed);
        spec.d0[0] = hand_between(&seed, 0.5, 3);
        spec.p1 = hand_between(&seed, -3, 0.1);
        spec.n1 = hand_between(&seed, -0.01, 0.001);
        use(&spec);
        gm_reduced_state s = hand_start(&m, 1, 0, hand_between(&seed, -20, 20));
        gm_reduced_inputs in = hand_inputs(1, 0);
        const double start = hand_kinetic(&m, &s);
        double largest = start;
        for (int i = 0; i < 300; i++) {
            in.gear[1] = i % 50 < 25 ? 0 : 2;
            in.path_tau[0] = hand_between(&seed, -50, 50);
            in.output_tau = hand_between(&seed, -300, 300);
            gm_reduced_step(&m.map, &params, &in, hand_between(&seed, 1e-4, 0.1), &s);
            const double now = hand_kinetic(&m, &s);
            assert_true(now - now == 0);
            largest = fmax(largest, fmax(now, fabs(s.work) + fabs(s.loss_energy)));
            assert_near(start + s.work - s.loss_energy, now, 1e-11 * largest);
        }
    }
}

static void a_shaft_released_against_its_neighbour_is_held_again(void **state)
{
    hand_spec spec = hand_default();
    (void)state;
    spec.c0 = 0.6; /* more than n0 holds: the turning shaft 0 takes shaft 1 along */
    use(&spec);
    gm_reduced_inputs in = hand_inputs(0, 0);
    gm_reduced_state s = hand_start(&m, 0, 0, 0);
    s.path[0].w = 60;
    gm_reduced_outputs o;
    gm_reduced_outputs_at(&m.map, &params, &in, &s, &o);
    /* 0.6 + 60 c1 - n0 - nothing from lines at w_n = w_o = 0 */
    assert_near(o.a[1] * spec.inertia[1], 0.6 + 60 * spec.c1 - spec.n0[0], 1e-12);
    assert_true(o.a_o == 0);
    for (int i = 0; i < 5000; i++) {
        gm_reduced_step(&m.map, &params, &in, 1e-3, &s);
        assert_true(s.w_o == 0 && s.path[1].w >= 0);
    }
    assert_true(s.path[0].w == 0 && s.path[1].w == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(smooth_motion_converges_with_the_second_order),
        cmocka_unit_test(motion_with_stops_converges_with_the_first_order_at_least),
        cmocka_unit_test(the_step_fulfils_the_midpoint_balance),
        cmocka_unit_test(a_stiff_coupling_stays_calm_with_long_steps),
        cmocka_unit_test(maps_that_break_the_rules_do_no_harm),
        cmocka_unit_test(a_shaft_released_against_its_neighbour_is_held_again),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
