/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Drag of free paths: tables, drag lines with their ramps, and the patch that sums them,
 * against the law of the map written out.
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

static hand_spec spec;
static hand_map m;
static gm_reduced_cache cache;

static void use_default(void)
{
    const gm_reduced_cache empty = {0};
    spec = hand_default();
    hand_build(&spec, &m);
    cache = empty;
}

static double sat(double x)
{
    return fmax(-1, fmin(1, x / GM_LINE_WIDTH));
}

static double law_n(int p, double sign_n, double w_n, double w_o)
{
    const double jump = spec.j0 + spec.j1 * fabs(w_o);
    double n = sign_n * spec.n0[sign_n > 0 ? GM_FORWARD : GM_BACKWARD] + spec.n1 * w_n +
               spec.k * (w_n - spec.r_k * w_o);
    for (int g = 0; g < spec.n_gears[p]; g++) {
        n += jump / 2 * sat(w_n - spec.ratio[p][g] * w_o);
    }
    return n;
}

static double law_r(int p, double w_n, double w_o)
{
    const double jump = spec.j0 + spec.j1 * fabs(w_o);
    double sum = -spec.r_k * spec.k * w_n;
    for (int g = 0; g < spec.n_gears[p]; g++) {
        const double r = spec.ratio[p][g];
        sum -= r * jump / 2 * (sat(w_n - r * w_o) - sat(-r * w_o));
    }
    return sum;
}

static gm_path_terms terms_at(int p, double sign_n, double w_n, double w_o)
{
    const gm_reduced_params params = {GM_RIGID, 1, {1, 1}};
    gm_motion motion = {0};
    gm_drive d;
    gm_terms t;
    gm_point at = {{0}, {0}, {0}, {0}};
    gm_make_drive(&m.map, &params, &motion, &cache, &d);
    memset(&t, 0, sizeof t);
    at.m[p] = w_n;
    at.m[GM_OUT] = w_o;
    gm_drag_terms(&d, p, sign_n, w_o < 0 ? -1 : 1, &at, &t);
    return t.path[p];
}

static double sign_of(double w)
{
    return w < 0 ? -1 : 1;
}

static void follows_the_law_everywhere(void **state)
{
    unsigned seed = 9;
    (void)state;
    use_default();
    for (int i = 0; i < 20000; i++) {
        const int p = i % 2;
        const double w_o = 30 * pow(hand_between(&seed, -1, 1), 3); /* often slow */
        double w_n = hand_between(&seed, -300, 300);
        if (i % 3 == 0) { /* near a line */
            w_n = spec.ratio[p][i % spec.n_gears[p]] * w_o + hand_between(&seed, -2, 2);
        }
        const gm_path_terms t = terms_at(p, sign_of(w_n), w_n, w_o);
        /* rounding of torques near 1 in coefficients of wide cells */
        assert_near(t.drag, law_n(p, sign_of(w_n), w_n, w_o), 1e-13);
        assert_near(t.reaction, law_r(p, w_n, w_o), 1e-12);
    }
}

static void gradients_are_difference_quotients(void **state)
{
    unsigned seed = 19;
    const double e = 1e-5;
    (void)state;
    use_default();
    int compared = 0;
    for (int i = 0; i < 5000; i++) {
        const double w_o = hand_between(&seed, -30, 30),
                     w_n = hand_between(&seed, -300, 300);
        const double s = sign_of(w_n);
        const gm_path_terms t = terms_at(0, s, w_n, w_o);
        const gm_path_terms n1 = terms_at(0, s, w_n + e, w_o),
                            n0 = terms_at(0, s, w_n - e, w_o);
        const gm_path_terms o1 = terms_at(0, s, w_n, w_o + e),
                            o0 = terms_at(0, s, w_n, w_o - e);
        const double kink = fabs(n1.drag - 2 * t.drag + n0.drag) +
                            fabs(o1.reaction - 2 * t.reaction + o0.reaction) +
                            fabs(o1.drag - 2 * t.drag + o0.drag);
        if (kink > 1e-9) {
            continue; /* a node or the edge of a ramp lies in between */
        }
        compared++;
        /* rounding 1e-16/1e-5, and j1 times the ramp's slope, bilinear: 1e-4 e */
        assert_near((n1.drag - n0.drag) / (2 * e), t.drag_n, 1e-8);
        assert_near((o1.drag - o0.drag) / (2 * e), t.drag_o, 1e-8);
        assert_near((n1.reaction - n0.reaction) / (2 * e), t.reaction_n, 1e-7);
        assert_near((o1.reaction - o0.reaction) / (2 * e), t.reaction_o, 1e-7);
    }
    assert_true(compared > 4000);
}

static void there_is_no_reaction_to_a_shaft_at_rest(void **state)
{
    (void)state;
    use_default();
    for (double w_o = -50; w_o <= 50; w_o += 0.37) {
        for (double sign = -1; sign <= 1; sign += 2) {
            assert_near(terms_at(0, sign, 0, w_o).reaction, 0, 1e-15);
            assert_near(terms_at(1, sign, 0, w_o).reaction, 0, 1e-15);
        }
    }
}

static void the_jump_at_rest_stays_exact(void **state)
{
    (void)state;
    use_default();
    for (double w_o = -20; w_o <= 20; w_o += 5) {
        const double jump = terms_at(0, 1, 0, w_o).drag - terms_at(0, -1, 0, w_o).drag;
        assert_near(jump, spec.n0[0] + spec.n0[1], 1e-15);
    }
}

/* A neutral shaft of a moving gearset is dragged along until N vanishes, and stays there:
 * with the lines smoothed over 1 rad/s it settles next to one of them. */
static void an_idle_shaft_is_dragged_along(void **state)
{
    gm_reduced_params params;
    (void)state;
    use_default();
    spec.n0[0] = spec.n0[1] = 0.01;
    spec.c0 = spec.c1 = 0;
    hand_build(&spec, &m);
    gm_reduced_default_params(&m.map, &params);
    gm_reduced_inputs in = hand_inputs(1, 0);
    gm_reduced_state s = hand_start(&m, 1, 0, 10);
    gm_reduced_outputs o;
    for (int i = 0; i < 4000; i++) {
        in.output_tau = 20 * (10 - s.w_o) + 12;
        gm_reduced_step(&m.map, &params, &in, 5e-3, &s);
    }
    gm_reduced_outputs_at(&m.map, &params, &in, &s, &o);
    assert_near(s.path[1].w, 4.5 * s.w_o, GM_LINE_WIDTH);
    assert_near(o.a[1], 0, 1e-6);
    assert_near(law_n(1, 1, s.path[1].w, s.w_o), 0, 1e-7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(follows_the_law_everywhere),
        cmocka_unit_test(gradients_are_difference_quotients),
        cmocka_unit_test(there_is_no_reaction_to_a_shaft_at_rest),
        cmocka_unit_test(the_jump_at_rest_stays_exact),
        cmocka_unit_test(an_idle_shaft_is_dragged_along),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
