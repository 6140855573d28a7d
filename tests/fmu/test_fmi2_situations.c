/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Every situation a vehicle brings, in Model Exchange by a small host with steps of its
 * own and in Co-Simulation: the same trajectory, the same energies.
 */
#include "fmi2_fixture.h"
#include "gm_model.h"
#include "gm_states.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "../core/near.h"

enum { NX = 10, NZ = 6 }; /* of two paths */

/* ---- a host with fixed steps ---- */

typedef struct solver {
    host h;
    fmi2Component c;
    double t, x[NX], z[NZ];
    int events, jumps;
} solver;

static void handle_event(solver *s)
{
    fmi2EventInfo info;
    assert_true(fmi2NewDiscreteStates(s->c, &info) <= fmi2Warning); /* out of map */
    assert_false(info.newDiscreteStatesNeeded);
    assert_false(info.terminateSimulation || info.nextEventTimeDefined ||
                 info.nominalsOfContinuousStatesChanged);
    assert_int_equal(fmi2EnterContinuousTimeMode(s->c), fmi2OK);
    assert_int_equal(fmi2GetContinuousStates(s->c, s->x, NX), fmi2OK);
    assert_int_equal(fmi2GetEventIndicators(s->c, s->z, NZ), fmi2OK);
    for (int i = 0; i < NZ - 1; i++) /* the last: outside the map */
        assert_true(s->z[i] > 0);
    s->events++;
    s->jumps += info.valuesOfContinuousStatesChanged != fmi2False;
}

static void rates(solver *s, double t, const double x[NX], double dx[NX])
{
    assert_int_equal(fmi2SetTime(s->c, t), fmi2OK);
    assert_int_equal(fmi2SetContinuousStates(s->c, x, NX), fmi2OK);
    assert_int_equal(fmi2GetDerivatives(s->c, dx, NX), fmi2OK);
}

static void add(const double x[NX], double h, const double dx[NX], double y[NX])
{
    for (int i = 0; i < NX; i++)
        y[i] = x[i] + h * dx[i];
}

/* Heun's third order rule over h from s->x to y, and the indicators there. */
static void try_step(solver *s, double h, double y[NX], double z[NZ])
{
    double k1[NX], k2[NX], k3[NX];
    rates(s, s->t, s->x, k1);
    add(s->x, h / 3, k1, y);
    rates(s, s->t + h / 3, y, k2);
    add(s->x, 2 * h / 3, k2, y);
    rates(s, s->t + 2 * h / 3, y, k3);
    add(s->x, h / 4, k1, y);
    add(y, 3 * h / 4, k3, y);
    assert_int_equal(fmi2SetTime(s->c, s->t + h), fmi2OK);
    assert_int_equal(fmi2SetContinuousStates(s->c, y, NX), fmi2OK);
    assert_int_equal(fmi2GetEventIndicators(s->c, z, NZ), fmi2OK);
    fmi2Boolean enter, terminate;
    assert_int_equal(fmi2CompletedIntegratorStep(s->c, fmi2True, &enter, &terminate),
                     fmi2OK);
}

static int is_event(const double from[NZ], const double to[NZ])
{
    for (int i = 0; i < NZ; i++)
        if ((from[i] > 0) != (to[i] > 0))
            return 1;
    return 0;
}

/* Up to h onward; it ends at the first event, found by bisection. Returns what is left.
 */
static double advance(solver *s, double h)
{
    double y[NX], z[NZ], low = 0, high = h;
    try_step(s, h, y, z);
    int event = is_event(s->z, z);
    for (int i = 0; event && i < 50 && high - low > 1e-12; i++) {
        const double middle = (low + high) / 2;
        try_step(s, middle, y, z);
        *(is_event(s->z, z) ? &high : &low) = middle;
    }
    if (event)
        try_step(s, high, y, z);
    s->t += high;
    memcpy(s->x, y, sizeof y);
    memcpy(s->z, z, sizeof z);
    if (event) {
        assert_int_equal(fmi2EnterEventMode(s->c), fmi2OK);
        handle_event(s);
    }
    return h - high;
}

static void step(solver *s, double h)
{
    double rest = h;
    for (int i = 0; rest > 1e-12; i++) {
        assert_true(i < 20);
        rest = advance(s, rest);
    }
}

/* ---- the same commands in both ---- */

typedef struct command {
    double until; /* s */
    double tau[3];
    int gear[2];
} command;

typedef struct situation {
    const char *name;
    double w_o, w[2];
    command commands[8];
} situation;

/* clang-format off */
static const situation situations[] = {
    {"hold on a hill, break away, roll back, stop, reverse", 0, {0, 0},
     {{0.5, {1, 0, -15}, {1, 0}}, {1, {10, 0, -15}, {1, 0}}, {1.5, {0, 0, -60}, {1, 0}},
      {2.2, {12, 0, -60}, {1, 0}}, {3, {0.5, 0, -7}, {1, 0}}}},
    {"driving to driven and back", 60, {0, 500},
     {{0.5, {100, 0, -500}, {3, 0}}, {1, {-60, 0, 200}, {3, 0}},
      {1.5, {100, 0, -500}, {3, 0}}}},
    {"neutral, synchronising, engaged", 40, {300, 100},
     {{0.3, {0, 0, -20}, {0, 0}}, {1, {0, 0, -20}, {3, 0}}, {1.5, {50, 0, -20}, {3, 0}}}},
    {"preselection while the other path drives", 30, {0, 50},
     {{0.3, {60, 0, -300}, {3, 0}}, {1, {60, 0, -300}, {3, 2}},
      {1.4, {60, 5, -300}, {3, 2}}, {2, {60, 0, -300}, {3, -1}}}},
    {"both paths loaded", 20, {0, 0},
     {{0.5, {60, 20, -400}, {3, 2}}, {1, {20, 90, -700}, {3, 2}},
      {1.5, {-30, 90, -700}, {3, 2}}}},
    {"engagement at standstill", 0, {0, 80},
     {{0.2, {0, 0, 0}, {0, 0}}, {0.5, {0, 0, 0}, {1, 2}}, {1, {20, 0, 0}, {1, 2}}}},
    {"a gear command taken back half-way", 50, {0, 0},
     {{0.05, {0, 0, 0}, {0, 0}}, {0.07, {0, 0, 0}, {3, 0}}, {0.5, {0, 0, 0}, {0, 0}},
      {0.51, {0, 0, 0}, {3, 0}}, {1, {0, 0, 0}, {1, 0}}}},
    {"torques far outside the map", 300, {0, 0},
     {{0.2, {900, 0, -2000}, {3, 0}}, {0.6, {900, 0, -9000}, {3, 2}},
      {1, {-900, 0, -9000}, {3, 2}}}},
    {"an unknown gear: the one that was is kept", 30, {0, 50},
     {{0.3, {60, 0, -300}, {3, 0}}, {0.6, {60, 0, -300}, {9, -7}},
      {0.9, {60, 5, -300}, {2, 2}}, {1.2, {60, 0, -300}, {3, 2}}}},
};
/* clang-format on */

static void set_start(fmi2Component c, const situation *s)
{
    set(c, GM_OUTPUT_W_START, 0, s->w_o);
    for (int p = 0; p < 2; p++) {
        set(c, GM_PATH_W_START, p, s->w[p]);
        set_integer(c, GM_PATH_GEAR, p, s->commands[0].gear[p]);
    }
}

static void set_command(fmi2Component c, const command *k)
{
    for (int p = 0; p < 2; p++) {
        set(c, GM_PATH_TAU, p, k->tau[p]);
        set_integer(c, GM_PATH_GEAR, p, k->gear[p]);
    }
    set(c, GM_OUTPUT_TAU, 0, k->tau[2]);
}

static fmi2Component slave_of(host *h, const situation *s)
{
    fmi2Component c = host_initialise(h);
    set_start(c, s);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    return c;
}

static void start_solver(solver *s, const situation *which)
{
    memset(s, 0, sizeof *s);
    s->c = host_instantiate_as(&s->h, fmi2ModelExchange);
    assert_int_equal(fmi2SetupExperiment(s->c, fmi2False, 0, 0, fmi2False, 0), fmi2OK);
    assert_int_equal(fmi2EnterInitializationMode(s->c), fmi2OK);
    set_start(s->c, which);
    assert_int_equal(fmi2ExitInitializationMode(s->c), fmi2OK);
    set_command(s->c, which->commands);
    handle_event(s);
}

static double kinetic(fmi2Component c)
{
    return get(c, GM_KINETIC_ENERGY, 0);
}

/* Speeds, angles and energies of both; and what the account of energy leaves open. */
static void compare(const situation *s, const command *k, fmi2Component slave,
                    const solver *x, double kinetic_start)
{
    static const gm_variable_id ids[] = {GM_PATH_W, GM_PATH_PHI};
    const double top = 20 + fabs(s->w_o) * 15;
    double scale = 1 + fabs(get(slave, GM_WORK, 0)) + kinetic_start;
    for (int p = 0; p < 2; p++)
        for (int i = 0; i < 2; i++)
            if (fabs(get(slave, ids[i], p) - get(x->c, ids[i], p)) > 1e-3 * top)
                fail_msg("%s, until %g: path %d: %.9g, %.9g", s->name, k->until, p,
                         get(slave, ids[i], p), get(x->c, ids[i], p));
    assert_near(get(slave, GM_OUTPUT_W, 0), get(x->c, GM_OUTPUT_W, 0), 1e-4 * top);
    assert_near(get(slave, GM_LOSS_ENERGY, 0), get(x->c, GM_LOSS_ENERGY, 0),
                1e-3 * get(slave, GM_LOSS_ENERGY, 0) + 1e-4);
    assert_near(get(x->c, GM_WORK, 0),
                get(x->c, GM_LOSS_ENERGY, 0) + kinetic(x->c) - kinetic_start,
                1e-6 * scale); /* third order, and where tables have kinks */
    for (int p = 0; p < 2; p++) {
        assert_int_equal(get_integer(slave, GM_PATH_STATE, p),
                         get_integer(x->c, GM_PATH_STATE, p));
        assert_int_equal(get_boolean(slave, GM_PATH_GEAR_REFUSED, p),
                         get_boolean(x->c, GM_PATH_GEAR_REFUSED, p));
    }
}

/* Co-Simulation at 1 ms against Model Exchange at 1 ms with events located. */
static void every_situation_is_the_same_in_both(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof situations / sizeof *situations; i++) {
        const situation *s = &situations[i];
        const double h = 1e-3;
        host slave_host;
        solver x;
        fmi2Component slave = slave_of(&slave_host, s);
        start_solver(&x, s);
        const double kinetic_start = kinetic(slave);
        long steps = 0;
        for (const command *k = s->commands; k->until > 0; k++) {
            set_command(slave, k);
            assert_int_equal(fmi2EnterEventMode(x.c), fmi2OK);
            set_command(x.c, k);
            handle_event(&x);
            for (; (double)steps * h < k->until - h / 2; steps++) {
                assert_true(fmi2DoStep(slave, (double)steps * h, h, fmi2True) <=
                            fmi2Warning);
                step(&x, h);
            }
            compare(s, k, slave, &x, kinetic_start);
        }
        fmi2FreeInstance(slave);
        fmi2FreeInstance(x.c);
    }
}

/* The longest steps cannot follow what happens inside of them, but events are found and
 * the account of energy closes at any step; speeds agree as far as the second order of
 * 0.1 s lets them. */
static void steps_may_change_from_a_microsecond_to_a_tenth_of_a_second(void **state)
{
    static const double lengths[] = {1e-6, 1e-1, 1e-5, 1e-3, 2e-2, 1e-4, 5e-2, 3e-6};
    const situation *s = &situations[2];
    host slave_host;
    fmi2Component slave = slave_of(&slave_host, s);
    solver x;
    double t = 0;
    (void)state;
    start_solver(&x, s);
    const double kinetic_start = kinetic(slave);
    for (const command *k = s->commands; k->until > 0; k++) {
        set_command(slave, k);
        assert_int_equal(fmi2EnterEventMode(x.c), fmi2OK);
        set_command(x.c, k);
        handle_event(&x);
        for (int i = 0; t < k->until - 1e-9; i++) {
            const double h = fmin(lengths[i % 8], k->until - t);
            assert_int_equal(fmi2DoStep(slave, t, h, fmi2True), fmi2OK);
            t += h;
        }
        while (x.t < t - 1e-9)
            step(&x, fmin(1e-3, t - x.t));
        assert_near(get(slave, GM_WORK, 0),
                    get(slave, GM_LOSS_ENERGY, 0) + kinetic(slave) - kinetic_start,
                    1e-9 * (get(slave, GM_LOSS_ENERGY, 0) + kinetic_start));
        assert_near(get(slave, GM_OUTPUT_W, 0), get(x.c, GM_OUTPUT_W, 0), 5e-3 * s->w_o);
        assert_near(get(slave, GM_LOSS_ENERGY, 0), get(x.c, GM_LOSS_ENERGY, 0),
                    5e-3 * get(x.c, GM_LOSS_ENERGY, 0));
    }
    fmi2FreeInstance(slave);
    fmi2FreeInstance(x.c);
}

static void a_held_shaft_has_no_speed_at_all(void **state)
{
    const situation *hill = &situations[0];
    solver x;
    (void)state;
    gm_reference states[GM_MAX_STATES];
    assert_int_equal(gm_states_list(gm_model_map(), states), NX);
    start_solver(&x, hill);
    for (int i = 0; i < 500; i++) {
        step(&x, 1e-3);
        for (int k = 0; k < NX; k++)
            assert_true(states[k].id == GM_LOSS_ENERGY || x.x[k] == 0);
    }
    assert_int_equal(x.events, 1);
    fmi2FreeInstance(x.c);
}

static void an_engagement_at_unequal_speeds_is_told_and_in_the_account(void **state)
{
    const situation s = {"", 30, {400, 0}, {{1, {0, 0, 0}, {0, 0}}}};
    solver x;
    (void)state;
    start_solver(&x, &s);
    const double before = kinetic(x.c);
    const int jumps = x.jumps;
    assert_int_equal(fmi2EnterEventMode(x.c), fmi2OK);
    set(x.c, GM_PATH_SYNC_TORQUE, 0, 1e30);
    set_integer(x.c, GM_PATH_GEAR, 0, 3);
    handle_event(&x);
    assert_int_equal(x.jumps, jumps + 1);
    assert_int_equal(get_integer(x.c, GM_PATH_STATE, 0), GM_PATH_ENGAGED);
    assert_near(get(x.c, GM_PATH_W, 0), 6 * get(x.c, GM_OUTPUT_W, 0), 1e-12);
    assert_near(get(x.c, GM_LOSS_ENERGY, 0), before - kinetic(x.c), 1e-9);
    assert_true(get(x.c, GM_LOSS_ENERGY, 0) > 1);
    fmi2FreeInstance(x.c);
}

static void losses_follow_loss_scale(void **state)
{
    const situation s = {"", 30, {0, 0}, {{1, {50, 0, -200}, {3, 0}}}};
    double power[2];
    (void)state;
    for (int i = 0; i < 2; i++) {
        solver x;
        start_solver(&x, &s);
        assert_int_equal(fmi2EnterEventMode(x.c), fmi2OK);
        set(x.c, GM_LOSS_SCALE, 0, i);
        handle_event(&x);
        power[i] = get(x.c, GM_LOSS_POWER, 0);
        fmi2FreeInstance(x.c);
    }
    assert_true(power[0] == 0);
    assert_true(power[1] > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_situation_is_the_same_in_both),
        cmocka_unit_test(steps_may_change_from_a_microsecond_to_a_tenth_of_a_second),
        cmocka_unit_test(a_held_shaft_has_no_speed_at_all),
        cmocka_unit_test(an_engagement_at_unequal_speeds_is_told_and_in_the_account),
        cmocka_unit_test(losses_follow_loss_scale),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
