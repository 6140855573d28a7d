/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The FMU where motion comes in at path 0 and at the output, torque at path 1: what can
 * be set and read, how inputs go on over a step, and that a motion which torques have
 * made gives these torques back.
 */
#include "fmi2_fixture.h"
#include "gm_states.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "../core/near.h"

enum { OUT = GM_OUTPUT_FLANGE };
#define H 1e-4 /* s */

/* ---- interface ---- */

static fmi2Status try_to_set(fmi2Component c, gm_variable_id id, int p, double value)
{
    const unsigned vr = reference(id, p);
    return fmi2SetReal(c, &vr, 1, &value);
}

static void motion_comes_in_and_torque_goes_out(void **state)
{
    static const struct {
        gm_variable_id id;
        int path;
        bool comes_in;
    } expected[] = {
        {GM_PATH_PHI, 0, true},   {GM_PATH_W, 0, true},      {GM_PATH_A, 0, true},
        {GM_PATH_TAU, 0, false},  {GM_PATH_W, 1, false},     {GM_PATH_A, 1, false},
        {GM_PATH_TAU, 1, true},   {GM_OUTPUT_W, 0, true},    {GM_OUTPUT_A, 0, true},
        {GM_OUTPUT_PHI, 0, true}, {GM_OUTPUT_TAU, 0, false}, {GM_PATH_TWIST, 0, false},
    };
    (void)state;
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        host h;
        fmi2Component c = host_start(&h);
        const fmi2Status status = try_to_set(c, expected[i].id, expected[i].path, 1.5);
        if (expected[i].comes_in) {
            assert_int_equal(status, fmi2OK);
            assert_near(get(c, expected[i].id, expected[i].path), 1.5, 0);
        } else {
            assert_int_equal(status, fmi2Error);
        }
        fmi2FreeInstance(c);
    }
}

static void what_a_prescribed_flange_has_not_is_unknown(void **state)
{
    host h;
    (void)state;
    fmi2Component c = host_initialise(&h);
    assert_refused(&h, try_to_set(c, GM_OUTPUT_W_START, 0, 1), "no variable", NULL);
    fmi2FreeInstance(c);
    c = host_initialise(&h);
    assert_refused(&h, try_to_set(c, GM_PATH_W_START, 0, 1), "no variable", NULL);
    fmi2FreeInstance(c);
    c = host_initialise(&h);
    assert_int_equal(try_to_set(c, GM_PATH_W_START, 1, 30), fmi2OK);
    assert_near(get(c, GM_PATH_W, 1), 30, 0);
    fmi2FreeInstance(c);
}

static void a_prescribed_path_cannot_be_rigid(void **state)
{
    host h;
    const unsigned vr = reference(GM_FIDELITY, 0);
    int fidelity = GM_RIGID;
    (void)state;
    fmi2Component c = host_initialise(&h);
    assert_refused(&h, fmi2SetInteger(c, &vr, 1, &fidelity), "fidelity", "2 to 2", NULL);
    fmi2FreeInstance(c);
}

static void angle_and_speed_are_no_states_there(void **state)
{
    static const gm_reference expected[] = {
        {GM_PATH_PHI, 1},   {GM_PATH_W, 1}, {GM_PATH_TWIST, 0},
        {GM_PATH_TWIST, 1}, {GM_WORK, 0},   {GM_LOSS_ENERGY, 0},
    };
    gm_reference states[GM_MAX_STATES];
    const int n = gm_states_list(gm_model_map(), states);
    (void)state;
    assert_int_equal(n, sizeof expected / sizeof *expected);
    for (int i = 0; i < n; i++) {
        assert_int_equal(states[i].id, expected[i].id);
        assert_int_equal(states[i].path, expected[i].path);
    }
}

static fmi2Status set_slope(fmi2Component c, gm_variable_id id, int p, double slope)
{
    const unsigned vr = reference(id, p);
    const int order = 1;
    return fmi2SetRealInputDerivatives(c, &vr, 1, &order, &slope);
}

/* The acceleration has a slope of its own; those of speed and angle are known. */
static void inputs_go_on_over_a_step(void **state)
{
    const double dt = 0.01, a = 7, jerk = 30, w = 20, phi = 3;
    host h;
    (void)state;
    fmi2Component c = host_start(&h);
    set(c, GM_OUTPUT_PHI, 0, phi);
    set(c, GM_OUTPUT_W, 0, w);
    set(c, GM_OUTPUT_A, 0, a);
    assert_int_equal(set_slope(c, GM_OUTPUT_A, 0, jerk), fmi2OK);
    assert_int_equal(set_slope(c, GM_OUTPUT_W, 0, 1e6), fmi2OK);
    assert_int_equal(set_slope(c, GM_OUTPUT_PHI, 0, 1e6), fmi2OK);
    assert_int_equal(fmi2DoStep(c, 0, dt, 1), fmi2OK);
    const double next = w + dt * a + dt * dt * jerk / 2;
    assert_near(get(c, GM_OUTPUT_A, 0), a + dt * jerk, 1e-12);
    assert_near(get(c, GM_OUTPUT_W, 0), next, 1e-12);
    assert_near(get(c, GM_OUTPUT_PHI, 0), phi + dt * (w + next) / 2, 1e-12);
    assert_refused(&h, set_slope(c, GM_OUTPUT_TAU, 0, 1), "output.tau", "input", NULL);
    fmi2FreeInstance(c);
}

/* ---- the same motion by torques, in the core ---- */

typedef struct twin {
    gm_reduced_map map; /* nothing is prescribed */
    gm_reduced_params params;
    gm_reduced_inputs in;
    gm_reduced_state s;
} twin;

static void start_twin(twin *t, int gear0, int gear1, double w_o)
{
    const double w[GM_MAX_PATHS] = {40, 60};
    *t = (twin){.map = *gm_model_map()};
    for (int k = 0; k <= OUT; k++)
        t->map.prescribed[k] = 0;
    gm_reduced_default_params(&t->map, &t->params);
    t->params.fidelity = GM_LASH;
    t->in.gear[0] = gear0;
    t->in.gear[1] = gear1;
    t->in.oil_temperature = t->map.oil_temperature;
    gm_reduced_start(&t->map, &t->in, w_o, w, &t->s);
}

static fmi2Component start_as(const twin *t, host *h)
{
    fmi2Component c = host_initialise(h);
    set_integer(c, GM_PATH_GEAR, 0, t->in.gear[0]);
    set_integer(c, GM_PATH_GEAR, 1, t->in.gear[1]);
    set(c, GM_PATH_W, 0, t->s.path[0].w);
    set(c, GM_OUTPUT_W, 0, t->s.w_o);
    set(c, GM_PATH_W_START, 1, 60);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    return c;
}

/* Torques that change all the time and nearly cancel at the output: it stays at some
 * 30 rad/s. */
static void load_twin(twin *t, double time)
{
    const double ratio = t->in.gear[0] == 1 ? 15 : t->in.gear[0] == 3 ? 6 : 0;
    t->in.path_tau[0] = ratio > 0 ? 60 + 40 * sin(3 * time) : 0.3;
    t->in.path_tau[1] = 0.5;
    t->in.output_tau =
        20 * sin(2 * time) - ratio * t->in.path_tau[0] - 2 * (t->s.w_o - 30);
}

/* One step of the twin by torques, of the FMU by the motion that comes of it. */
static void step_both(twin *t, fmi2Component c, double time)
{
    const gm_reduced_state before = t->s;
    load_twin(t, time);
    gm_reduced_step(&t->map, &t->params, &t->in, H, &t->s);
    set(c, GM_PATH_TAU, 1, t->in.path_tau[1]);
    set(c, GM_PATH_W, 0, before.path[0].w);
    set(c, GM_PATH_A, 0, (t->s.path[0].w - before.path[0].w) / H);
    set(c, GM_OUTPUT_W, 0, before.w_o);
    set(c, GM_OUTPUT_A, 0, (t->s.w_o - before.w_o) / H);
    assert_int_equal(fmi2DoStep(c, time, H, 1), fmi2OK);
}

/* At this instant: the motion that the torques make, and the torques that it takes. */
static void assert_torques_come_back(twin *t, fmi2Component c)
{
    gm_reduced_outputs o;
    gm_reduced_outputs_at(&t->map, &t->params, &t->in, &t->s, &o);
    set(c, GM_PATH_W, 0, t->s.path[0].w);
    set(c, GM_PATH_A, 0, o.a[0]);
    set(c, GM_OUTPUT_W, 0, t->s.w_o);
    set(c, GM_OUTPUT_A, 0, o.a_o);
    /* what differs in twist and in the other path's speed, over all steps: see below */
    assert_near(get(c, GM_PATH_TAU, 0), t->in.path_tau[0], 0.02);
    assert_near(get(c, GM_OUTPUT_TAU, 0), t->in.output_tau, 0.3);
    assert_near(get(c, GM_POWER, 0),
                t->in.path_tau[0] * t->s.path[0].w + t->in.output_tau * t->s.w_o +
                    t->in.path_tau[1] * t->s.path[1].w,
                0.02 * fabs(t->s.path[0].w) + 0.3 * fabs(t->s.w_o));
}

static void a_recorded_motion_gives_its_torques_back(void **state)
{
    static const int gears[][2] = {{1, 0}, {3, 2}, {1, -1}, {0, 0}};
    (void)state;
    for (size_t g = 0; g < sizeof gears / sizeof *gears; g++) {
        twin t;
        host h;
        start_twin(&t, gears[g][0], gears[g][1], 30);
        fmi2Component c = start_as(&t, &h);
        for (int i = 0; i < 5000; i++) {
            step_both(&t, c, i * H);
            if (i % 250 == 249)
                assert_torques_come_back(&t, c);
        }
        assert_near(get(c, GM_PATH_TWIST, 0), t.s.path[0].twist, 1e-6);
        assert_near(get(c, GM_PATH_W, 1), t.s.path[1].w, 1e-3);
        assert_near(get(c, GM_WORK, 0), t.s.work, 1e-4 * fabs(t.s.work));
        assert_near(get(c, GM_LOSS_ENERGY, 0), t.s.loss_energy, 1e-4 * t.s.loss_energy);
        fmi2FreeInstance(c);
    }
}

/* ---- shifts, standstill, jumps ---- */

static double stored(fmi2Component c)
{
    return get(c, GM_KINETIC_ENERGY, 0) + get(c, GM_ELASTIC_ENERGY, 0);
}

/* What is told of the output at step i: it goes to 20 rad/s and back to rest, stands,
 * goes backward and comes back. */
static void tell_output(int i, double *w_o, double *a_o)
{
    static const struct {
        int from;
        double w, a;
    } parts[] = {{0, 0, 100}, {200, 20, -100}, {400, 0, 0}, {700, 0, -40}, {850, -6, 40}};
    int k = 4;
    while (i % 1000 < parts[k].from)
        k--;
    *a_o = parts[k].a;
    *w_o = parts[k].w + 1e-3 * (i % 1000 - parts[k].from) * *a_o;
}

/* And of path 0: it turns beside its gear for a while after each command, then with it
 * but for a vibration. */
static void tell_motion(fmi2Component c, int i, int gear)
{
    const double ratio = gear == 1 ? 15 : gear == 3 ? 6 : 10;
    const double beside = i % 500 < 100 ? 3 : 0;
    double w_o, a_o;
    tell_output(i, &w_o, &a_o);
    set(c, GM_OUTPUT_W, 0, w_o);
    set(c, GM_OUTPUT_A, 0, a_o);
    set(c, GM_PATH_W, 0, ratio * w_o + beside + 0.05 * sin(i * 0.1));
    set(c, GM_PATH_A, 0, ratio * a_o + 5 * cos(i * 0.1));
}

static void shifts_and_standstill_are_in_the_account(void **state)
{
    static const int commands[] = {1, 0, 3, 1, 0, 1};
    host h;
    double lost = 0, through = 0, before = 0;
    int states[3] = {0};
    (void)state;
    fmi2Component c = host_start(&h);
    const double start = stored(c) - get(c, GM_WORK, 0) + get(c, GM_LOSS_ENERGY, 0);
    for (int i = 0; i < 3000; i++) {
        set_integer(c, GM_PATH_GEAR, 0, commands[i / 500]);
        set_integer(c, GM_PATH_GEAR, 1, i / 700 % 2 ? 2 : 0);
        tell_motion(c, i, commands[i / 500]);
        assert_int_equal(fmi2DoStep(c, i * 1e-3, 1e-3, 1), fmi2OK);
        states[get_integer(c, GM_PATH_STATE, 0)]++;
        through += fabs(get(c, GM_WORK, 0) - before);
        before = get(c, GM_WORK, 0);
        assert_true(get(c, GM_LOSS_ENERGY, 0) >= lost - 1e-9 * through);
        lost = get(c, GM_LOSS_ENERGY, 0);
        assert_near(get(c, GM_WORK, 0) + start, stored(c) + lost, 1e-9 * (1 + through));
    }
    for (int i = 0; i < 3; i++)
        assert_true(states[i] > 50);
    fmi2FreeInstance(c);
}

/* A shaft that is told to stand stands, and takes what acts on it. */
static void a_standing_output_takes_the_springs_torque(void **state)
{
    host h;
    (void)state;
    fmi2Component c = host_initialise(&h);
    set_integer(c, GM_PATH_GEAR, 1, 2);
    set(c, GM_PATH_TAU, 1, 50);
    assert_int_equal(fmi2ExitInitializationMode(c), fmi2OK);
    for (int i = 0; i < 2000; i++)
        assert_int_equal(fmi2DoStep(c, i * 1e-3, 1e-3, 1), fmi2OK);
    assert_near(get(c, GM_OUTPUT_W, 0), 0, 0);
    assert_near(get(c, GM_OUTPUT_PHI, 0), 0, 0);
    /* at rest after two seconds: 9 * 50 N.m hold the output */
    assert_near(get(c, GM_PATH_W, 1), 0, 1e-6);
    assert_near(get(c, GM_OUTPUT_TAU, 0), -9.0 * 50, 1e-3 * 450);
    fmi2FreeInstance(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(motion_comes_in_and_torque_goes_out),
        cmocka_unit_test(what_a_prescribed_flange_has_not_is_unknown),
        cmocka_unit_test(a_prescribed_path_cannot_be_rigid),
        cmocka_unit_test(angle_and_speed_are_no_states_there),
        cmocka_unit_test(inputs_go_on_over_a_step),
        cmocka_unit_test(a_recorded_motion_gives_its_torques_back),
        cmocka_unit_test(shifts_and_standstill_are_in_the_account),
        cmocka_unit_test(a_standing_output_takes_the_springs_torque),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
