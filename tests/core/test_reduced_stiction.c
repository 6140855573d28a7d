/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Friction rigs in both fidelities, against solutions with events in closed form: a mass
 * J under dry friction F_+ forward and F_- backward,
 *
 *   J dw/dt = tau(t) - F_+        w > 0, or w = 0 and tau > F_+
 *   J dw/dt = tau(t) + F_-        w < 0, or w = 0 and tau < -F_-
 *   w = 0                         else
 *
 * with tau(t) = a + b t + c sin(2 pi f t). Inputs are held over each step, as a master of
 * co-simulation does: the error is proportional to the step. In fidelity lash the path's
 * mass hangs on its spring; its lash is small against the motion.
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

#define TURN 6.283185307179586

typedef struct rig {
    const char *name;
    double a, b, c, f; /* of tau(t): N.m, N.m/s, N.m, Hz */
    double w_start, duration;
    int moves; /* 1: in the end it has moved */
} rig;

static const rig rigs[] = {
    {"hill hold", 5.9, 0, 0, 1, 0, 60, 0},
    {"hill hold, backward", -4.9, 0, 0, 1, 0, 60, 0},
    {"vibrated, held", 0.5, 0, 4.9, 25, 0, 5, 0},
    {"break away", 0, 4, 0, 1, 0, 3, 1},
    {"break away backward", 0, -4, 0, 1, 0, 3, 1},
    {"roll out and hold", 3, 0, 0, 1, 4, 3, 1},
    {"roll back", 12, 0, 0, 1, -4, 3, 1},
    {"1 Hz through the band", 0, 0, 15, 1, 0, 3, 1},
    {"1 Hz on a slope", 2, 0, 12, 1, 0, 3, 1},
    {"0.5 Hz, just beyond the band", 0, 0, 6.6, 0.5, 0, 4, 1},
};
enum { RIGS = sizeof rigs / sizeof *rigs };

static hand_map m;
static gm_reduced_params params;
static double inertia, forward, backward; /* J, F_+, F_- at the output */

/* Gear 1 of path 0 engaged: J, F_+ and F_- are those of the whole. */
static void use(int fidelity)
{
    hand_spec spec = hand_lossless();
    spec.p0[0] = 6;
    spec.p0[1] = 5;
    spec.lash[0] = 1e-3;
    hand_build(&spec, &m);
    gm_reduced_default_params(&m.map, &params);
    params.fidelity = fidelity;
    const double r = m.gear[0][1].ratio;
    inertia = spec.inertia_output + r * r * spec.inertia[0];
    forward = spec.p0[0];
    backward = spec.p0[1];
}

static double torque(const rig *g, double t)
{
    return g->a + g->b * t + g->c * sin(TURN * g->f * t);
}

/* ---- the reference: integrals of the torque, events by bisection ---- */

typedef struct mass {
    double t, w, phi;
    int sign; /* direction of motion, 0: held */
} mass;

static double impulse(const rig *g, double t)
{
    const double omega = TURN * g->f;
    return g->a * t + g->b * t * t / 2 - g->c / omega * cos(omega * t);
}

static double second_integral(const rig *g, double t)
{
    const double omega = TURN * g->f;
    return g->a * t * t / 2 + g->b * t * t * t / 6 -
           g->c / (omega * omega) * sin(omega * t);
}

static mass moved(const rig *g, const mass *from, double t)
{
    const double friction = from->sign > 0 ? forward : from->sign < 0 ? -backward : 0;
    const double d = t - from->t;
    mass to = *from;
    to.t = t;
    if (from->sign == 0) {
        return to;
    }
    to.w = from->w + (impulse(g, t) - impulse(g, from->t) - friction * d) / inertia;
    to.phi = from->phi + from->w * d +
             (second_integral(g, t) - second_integral(g, from->t) -
              impulse(g, from->t) * d - friction * d * d / 2) /
                 inertia;
    return to;
}

static int direction_at_rest(const rig *g, double t)
{
    return torque(g, t) > forward ? 1 : torque(g, t) < -backward ? -1 : 0;
}

static int has_event(const rig *g, const mass *at)
{
    return at->sign == 0 ? direction_at_rest(g, at->t) != 0 : at->sign * at->w < 0;
}

/* Over one interval of the search, short against all that happens. */
static mass advance(const rig *g, const mass *from, double t)
{
    mass to = moved(g, from, t);
    if (!has_event(g, &to)) {
        return to;
    }
    double low = from->t, high = t;
    for (int i = 0; i < 60; i++) {
        const double middle = (low + high) / 2;
        const mass at = moved(g, from, middle);
        if (has_event(g, &at)) {
            high = middle;
        } else {
            low = middle;
        }
    }
    to = moved(g, from, high);
    to.w = 0;
    to.sign = direction_at_rest(g, high);
    return moved(g, &to, t);
}

static mass reference(const rig *g, double t, mass at)
{
    const double interval = 1e-4;
    while (at.t < t - interval / 2) {
        at = advance(g, &at, at.t + interval);
    }
    return at;
}

static mass begin(const rig *g)
{
    mass at = {0, g->w_start, 0, 0};
    at.sign = at.w > 0 ? 1 : at.w < 0 ? -1 : direction_at_rest(g, 0);
    return at;
}

/* ---- the rig ---- */

/* Largest deviation of the position from the reference; *way: the largest way. */
static double deviation(const rig *g, double h, double *way, gm_reduced_state *end)
{
    gm_reduced_inputs in = hand_inputs(1, 0);
    gm_reduced_state s = hand_start(&m, 1, 0, g->w_start);
    mass at = begin(g);
    double largest = 0;
    *way = 0;
    const int n = (int)(g->duration / h + 0.5);
    for (int i = 0; i < n; i++) {
        in.output_tau = torque(g, i * h);
        gm_reduced_step(&m.map, &params, &in, h, &s);
        at = reference(g, (i + 1) * h, at);
        largest = fmax(largest, fabs(s.phi_o - at.phi));
        *way = fmax(*way, fabs(at.phi));
    }
    *end = s;
    return largest;
}

static void check_rig(const rig *g, int fidelity)
{
    double way, error_1, error_2;
    gm_reduced_state s;
    use(fidelity);
    error_2 = deviation(g, 2e-3, &way, &s);
    error_1 = deviation(g, 1e-3, &way, &s);
    if (!g->moves) {
        assert_true(way == 0 && s.w_o == 0);
        /* rigid: not a bit; lash: the output rests on the same side of its lash */
        assert_true(error_1 == 0 || (fidelity == GM_LASH && error_1 < 1e-3));
        return;
    }
    print_message("%-30s %s: %.3f %% of %.3g rad at 1 ms, %.2f times that at 2 ms\n",
                  g->name, fidelity == GM_LASH ? "lash " : "rigid", 100 * error_1 / way,
                  way, error_2 / error_1);
    assert_true(error_1 <= 0.02 * way);
    /* a constant torque leaves rounding; of lash the twist is in the error */
    if (fidelity == GM_RIGID && (g->b != 0 || g->c != 0)) {
        assert_true(error_2 > 1.6 * error_1 && error_2 < 2.5 * error_1);
    }
}

static void rigs_move_as_the_reference(void **state)
{
    (void)state;
    for (int i = 0; i < RIGS; i++) {
        check_rig(&rigs[i], GM_RIGID);
        check_rig(&rigs[i], GM_LASH);
    }
}

/* A load on a hill within the band, with a motor that hums: once at rest it stays for
 * good, whatever the steps. */
static void nothing_creeps(void **state)
{
    unsigned seed = 4;
    (void)state;
    for (int fidelity = GM_RIGID; fidelity <= GM_LASH; fidelity++) {
        use(fidelity);
        gm_reduced_inputs in = hand_inputs(1, 0);
        gm_reduced_state s = hand_start(&m, 1, 0, 0);
        in.output_tau = 5.5;
        for (int i = 0; i < 1000; i++) {
            gm_reduced_step(&m.map, &params, &in, 1e-3, &s);
        }
        const double phi = s.phi_o, loss = s.loss_energy;
        for (int i = 0; i < 200000; i++) {
            const double h = pow(10, hand_between(&seed, -6, -1));
            gm_reduced_step(&m.map, &params, &in, h, &s);
            assert_true(s.w_o == 0 && s.phi_o == phi && s.loss_energy == loss);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rigs_move_as_the_reference),
        cmocka_unit_test(nothing_creeps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
