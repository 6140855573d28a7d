/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What a vehicle does with a gearset, as a table of situations, each in both fidelities
 * and with steps of 10 us, 1 ms, 0.1 s and of any length in turn. On every step
 *
 *   work = change of kinetic and elastic energy + loss        losses never fall
 *   on a map without losses: change of J_o w_o + sum r_p J_p w_p of the paths that are in
 *   gear or synchronise = impulse of the flange torques
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

/* Part of a situation: gears and torques for so long [s].
 */
typedef struct part {
    double time;
    int gear[2];
    double tau[2], tau_o;
} part;

enum { PARTS = 4, FOREVER = 99 };

typedef struct situation {
    const char *name;
    double w_o;
    part parts[PARTS];
    int mode[2]; /* in the end */
    int moving;  /* sign of w_o in the end, FOREVER: any */
    double sync; /* capacity of path 1, 0: the map's */
} situation;

enum { N = GM_PATH_NEUTRAL, E = GM_PATH_ENGAGED };

static const situation table[] = {
    {"held on a hill", 0, {{1, {1, 0}, {0, 0}, 4}}, {E, N}, 0, 0},
    {"held, broken away, held again",
     0,
     {{0.3, {1, 0}, {0, 0}, 4}, {0.3, {1, 0}, {3, 0}, 4}, {3, {1, 0}, {0, 0}, -2}},
     {E, N},
     0,
     0},
    {"rolling back, stopped, away", -2, {{2, {1, 0}, {20, 0}, -20}}, {E, N}, 1, 0},
    {"reverse", 0, {{1, {-1, 0}, {20, 0}, 0}}, {E, N}, -1, 0},
    {"driving, driven, driving",
     10,
     {{0.3, {1, 0}, {60, 0}, -700},
      {0.3, {1, 0}, {-30, 0}, 300},
      {0.3, {1, 0}, {60, 0}, -700}},
     {E, N},
     FOREVER,
     0},
    {"neutral, synchronising, engaged",
     10,
     {{0.2, {1, 0}, {30, 0}, -400}, {0.5, {1, 2}, {30, 0}, -400}},
     {E, E},
     1,
     0},
    {"engaged at once",
     10,
     {{0.2, {1, 0}, {30, 0}, -400}, {0.5, {1, 2}, {30, 0}, -400}},
     {E, E},
     1,
     HUGE_VAL},
    {"preselected, taken over",
     10,
     {{0.3, {1, 2}, {30, 0}, -400},
      {0.3, {1, 2}, {15, 20}, -400},
      {0.3, {0, 2}, {0, 40}, -300}},
     {N, E},
     1,
     0},
    {"both loaded", 10, {{1, {3, 2}, {40, -30}, 0}}, {E, E}, FOREVER, 0},
    {"engaged at standstill",
     0,
     {{0.1, {0, 0}, {0, 0}, 0}, {0.5, {1, 0}, {0, 0}, 3}},
     {E, N},
     0,
     0},
    {"command taken back half-way",
     20,
     {{0.01, {1, 0}, {20, 0}, 0}, {0.02, {1, 2}, {20, 0}, 0}, {0.5, {1, 0}, {20, 0}, 0}},
     {E, N},
     1,
     0},
    {"unknown gear",
     10,
     {{0.2, {1, 0}, {20, 0}, 0}, {0.2, {7, 0}, {20, 0}, 0}},
     {E, N},
     1,
     0},
    {"from gear to gear",
     10,
     {{0.2, {1, 0}, {20, 0}, 0}, {1, {3, 0}, {0, 0}, 0}, {0.2, {3, 0}, {30, 0}, 0}},
     {E, N},
     1,
     0},
    {"torques far outside the map",
     5,
     {{0.1, {1, 2}, {5000, 0}, -20000}, {0.1, {1, 2}, {-5000, 4000}, 30000}},
     {E, E},
     FOREVER,
     0},
};
enum { SITUATIONS = sizeof table / sizeof *table };

static hand_map m;
static gm_reduced_params params;

static void use(const hand_spec *spec, int fidelity, double sync)
{
    hand_build(spec, &m);
    gm_reduced_default_params(&m.map, &params);
    params.fidelity = fidelity;
    params.sync_torque[1] = sync > 0 ? sync : params.sync_torque[1];
}

/* Step lengths: kind 0 .. 2 fixed, 3 any. */
static double next_step(int kind, unsigned *seed)
{
    static const double fixed[3] = {1e-5, 1e-3, 0.1};
    return kind < 3 ? fixed[kind] : pow(10, hand_between(seed, -6, -1));
}

static gm_reduced_inputs inputs_of(const part *p)
{
    gm_reduced_inputs in = hand_inputs(p->gear[0], p->gear[1]);
    in.path_tau[0] = p->tau[0];
    in.path_tau[1] = p->tau[1];
    in.output_tau = p->tau_o;
    return in;
}

/* Ratio of path p's gear, where it is in gear or on its way there; else 0. */
static double ratio_of(const gm_path_state *path, int p)
{
    return path->mode == GM_PATH_NEUTRAL ? 0 : m.gear[p][path->gear].ratio;
}

/* Momentum that the shafts together have, for the gears of *s; impulse of the torques. */
static double momentum(const gm_reduced_state *gears, const gm_reduced_state *speeds)
{
    double sum = m.map.inertia_output * speeds->w_o;
    for (int p = 0; p < 2; p++) {
        sum += ratio_of(&gears->path[p], p) * m.map.path[p].inertia * speeds->path[p].w;
    }
    return sum;
}

static double force(const gm_reduced_state *gears, const gm_reduced_inputs *in)
{
    return in->output_tau + ratio_of(&gears->path[0], 0) * in->path_tau[0] +
           ratio_of(&gears->path[1], 1) * in->path_tau[1];
}

static void check_step(const gm_reduced_state *before, const gm_reduced_state *s,
                       double *largest)
{
    const double now = hand_energy(&m, &params, s),
                 was = hand_energy(&m, &params, before);
    double way = 0;
    for (int p = 0; p < 2; p++) {
        way += fabs(s->path[p].twist - before->path[p].twist);
    }
    *largest = fmax(*largest, fmax(now, fabs(s->work) + s->loss_energy));
    /* springs meet their slips to 1e-11 of their torque and 1e-10 N.m */
    assert_near(s->work - before->work, now - was + s->loss_energy - before->loss_energy,
                1e-11 * *largest + 1e-10 * way + 1e-300);
    assert_true(s->loss_energy >= before->loss_energy - 1e-15 * *largest);
}

static gm_reduced_state run(const situation *t, int kind, int momentum_too)
{
    gm_reduced_state s = hand_start(&m, t->parts[0].gear[0], t->parts[0].gear[1], t->w_o);
    double largest = hand_energy(&m, &params, &s);
    unsigned seed = 17;
    for (int i = 0; i < PARTS && t->parts[i].time > 0; i++) {
        const gm_reduced_inputs in = inputs_of(&t->parts[i]);
        for (double time = 0; time < t->parts[i].time;) {
            const gm_reduced_state before = s;
            const double h = next_step(kind, &seed);
            gm_reduced_step(&m.map, &params, &in, h, &s);
            check_step(&before, &s, &largest);
            if (momentum_too) {
                /* springs to 1e-11 of their torque, the rest to rounding */
                const double done = force(&s, &in) * h, is = momentum(&s, &s);
                assert_near(is - momentum(&s, &before), done,
                            1e-9 * (fabs(is) + fabs(done) + 1));
            }
            time += h;
        }
    }
    return s;
}

static int sign_of(double x)
{
    return x > 0 ? 1 : x < 0 ? -1 : 0;
}

static void every_situation_keeps_its_accounts(void **state)
{
    const hand_spec lossless = hand_lossless();
    (void)state;
    for (int i = 0; i < SITUATIONS; i++) {
        const situation *t = &table[i];
        for (int fidelity = GM_RIGID; fidelity <= GM_LASH; fidelity++) {
            for (int kind = 0; kind < 4; kind++) {
                const hand_spec spec = hand_default();
                use(&spec, fidelity, t->sync);
                const gm_reduced_state s = run(t, kind, 0);
                const int good = s.path[0].mode == t->mode[0] &&
                                 s.path[1].mode == t->mode[1] &&
                                 (t->moving == FOREVER || sign_of(s.w_o) == t->moving);
                if (!good) {
                    fail_msg("%s, fidelity %d, steps %d: modes %d %d, w_o %g", t->name,
                             fidelity, kind, s.path[0].mode, s.path[1].mode, s.w_o);
                }
                use(&lossless, fidelity, t->sync);
                run(t, kind, 1);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_situation_keeps_its_accounts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
