/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A baked component in Co-Simulation as a plant in motion: it gets the impulse that acts,
 * its speeds are those of the FMU, and a stiff clutch beside it does no harm.
 */
#include "baked.h"
#include "plant/gm_fmu_steps.h"

#include "base/alloc.h"
#include "plant/gm_fmu.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#define STEP 1e-3
enum { ODD = 1, EVEN = 2, N_FLANGES = 3, NEUTRAL = 0, ENGAGED = 2 };

typedef struct rig {
    gm_fmu_steps_plant *plant;
    const gm_dynamics_class *is;
    void *motion;
    double t, x[N_FLANGES];
    gm_motion_input input;
} rig;

static void open_rig(rig *r, const char *path, gm_fmu_fidelity fidelity,
                     const gm_motion_input *input, const double *speed)
{
    gm_error error;
    *r = (rig){.input = *input};
    if (gm_fmu_steps_create(path, fidelity, STEP, &r->plant, &error) != GM_OK)
        fail_msg("%s", error.message);
    const gm_dynamics dynamics = gm_fmu_steps_dynamics(r->plant);
    r->is = dynamics.is;
    assert_int_equal(dynamics.n_paths, 2);
    assert_int_equal(r->is->create(dynamics.plant, &r->motion, &error), GM_OK);
    assert_int_equal(r->is->n_states(r->motion), N_FLANGES);
    if (r->is->start(r->motion, &r->input, speed, r->x, &error) != GM_OK)
        fail_msg("%s", error.message);
}

static void close_rig(rig *r)
{
    r->is->destroy(r->motion);
    gm_fmu_steps_destroy(r->plant);
}

/* Euler's steps: exact while the torques are constant. */
static void move(rig *r, double dt)
{
    double dx[N_FLANGES];
    assert_int_equal(r->is->rates(r->motion, &r->input, r->x, dx), 0);
    for (int i = 0; i < N_FLANGES; i++)
        r->x[i] += dt * dx[i];
    r->t += dt;
}

static void settle(rig *r)
{
    gm_error error;
    int changed = 1;
    if (r->is->handle(r->motion, &r->input, r->t, r->x, &changed, &error) != GM_OK)
        fail_msg("%s", error.message);
    assert_int_equal(changed, 0); /* nothing jumps */
}

static double fmu_number(gm_fmu *fmu, const char *name)
{
    unsigned reference;
    double value;
    assert_int_equal(gm_fmu_find(fmu, name, &reference, NULL), GM_OK);
    assert_int_equal(gm_fmu_get_real(fmu, reference, &value, NULL), GM_OK);
    return value;
}

static void set(gm_fmu *fmu, const char *name, double value)
{
    unsigned reference;
    assert_int_equal(gm_fmu_find(fmu, name, &reference, NULL), GM_OK);
    assert_int_equal(gm_fmu_set_real(fmu, reference, value, NULL), GM_OK);
}

static void set_integer(gm_fmu *fmu, const char *name, int value)
{
    unsigned reference;
    assert_int_equal(gm_fmu_find(fmu, name, &reference, NULL), GM_OK);
    assert_int_equal(gm_fmu_set_integer(fmu, reference, value, NULL), GM_OK);
}

static const gm_motion_input driving = {.torque = {-300.0, 80.0, 2.0}, .gear = {1, 0}};
static const double turning[GM_MAX_FLANGES] = {30.0, 0.0, 12.0};

/* The same torques on the FMU by itself. Its own steps see the same numbers but for the
 * rounding of the torque, 1e-13 of J dw / h; speeds around it are a step's change of
 * acceleration (below 1 rad/s2 here) times h behind at most. */
static void constant_torques_move_it_as_the_fmu(void **state)
{
    const char *path = *state;
    rig r;
    gm_fmu *fmu = NULL;
    gm_motion_view view;
    open_rig(&r, path, GM_FMU_RIGID, &driving, turning);
    assert_int_equal(gm_fmu_open(path, &fmu, NULL), GM_OK);
    set_integer(fmu, "fidelity", 1);
    set(fmu, "output.w_start", turning[0]);
    set(fmu, "even.w_start", turning[EVEN]);
    assert_int_equal(gm_fmu_initialise(fmu, NULL), GM_OK);
    set_integer(fmu, "odd.gear", 1);
    assert_int_equal(gm_fmu_start(fmu, NULL), GM_OK);
    set(fmu, "output.tau", driving.torque[0]);
    set(fmu, "odd.tau", driving.torque[ODD]);
    set(fmu, "even.tau", driving.torque[EVEN]);
    for (int k = 0; k < 500; k++) {
        assert_true(fabs(r.is->next(r.motion, r.t) - (r.t + STEP)) < 1e-12);
        move(&r, 0.5 * STEP);
        settle(&r); /* in the middle of a step nothing is due */
        move(&r, 0.5 * STEP);
        settle(&r);
        assert_int_equal(gm_fmu_step(fmu, k * STEP, STEP, NULL), GM_OK);
    }
    r.is->view(r.motion, &r.input, r.x, &view);
    assert_true(fabs(view.speed[0] - fmu_number(fmu, "output.w")) < 1e-3);
    assert_true(fabs(view.speed[ODD] - fmu_number(fmu, "odd.w")) < 1e-3);
    assert_true(fabs(view.speed[EVEN] - fmu_number(fmu, "even.w")) < 1e-3);
    assert_true(view.speed[ODD] > 1.1 * turning[0]); /* it did move */
    const double loss = fmu_number(fmu, "loss_power");
    assert_true(fabs(view.loss_power - loss) < 1e-9 * loss);
    gm_fmu_close(fmu);
    close_rig(&r);
}

/* An engine on the input in neutral through a clutch of 600 N.m.s/rad. Held speeds would
 * be unstable beyond 2 J / c; here they meet and stay, and what the engine gives the path
 * has, but for drag (0.3 N.m over 0.2 s). */
static void a_stiff_clutch_beside_it_is_stable(void **state)
{
    const gm_motion_input neutral = {.gear = {0, 0}};
    const double c = 600.0, j_engine = 0.2, rest[GM_MAX_FLANGES] = {0.0};
    double column[N_FLANGES], engine = 100.0;
    rig r;
    open_rig(&r, *state, GM_FMU_LASH, &neutral, rest);
    assert_int_equal(r.is->torque_column(r.motion, &r.input, r.x, ODD, column), 0);
    const double j = 1.0 / column[ODD];
    assert_true(column[0] == 0.0 && column[EVEN] == 0.0);
    assert_true(2.0 * j / c < 0.5 * STEP);
    for (int k = 0; k < 200; k++) {
        const int parts = 2000; /* c dt / j is small */
        for (int i = 0; i < parts; i++) {
            r.input.torque[ODD] = c * (engine - r.x[ODD]);
            engine -= STEP / parts * r.input.torque[ODD] / j_engine;
            move(&r, STEP / parts);
        }
        r.t = (k + 1) * STEP;
        settle(&r);
        assert_true(k < 50 || fabs(engine - r.x[ODD]) < 0.01);
    }
    assert_true(fabs((j_engine + j) * engine - j_engine * 100.0) < 0.1);
    close_rig(&r);
}

static void a_commanded_gear_reaches_the_fmu(void **state)
{
    rig r;
    gm_motion_view view;
    gm_motion_input neutral = driving;
    neutral.gear[0] = 0;
    open_rig(&r, *state, GM_FMU_RIGID, &driving, turning);
    r.is->view(r.motion, &r.input, r.x, &view);
    assert_int_equal(view.state[0], ENGAGED);
    r.input = neutral;
    for (int k = 0; k < 2; k++) { /* told with the first step, done in the second */
        move(&r, STEP);
        settle(&r);
        r.is->view(r.motion, &r.input, r.x, &view);
        assert_int_equal(view.state[0], k == 0 ? ENGAGED : NEUTRAL);
    }
    close_rig(&r);
}

static void the_component_recommends_a_step(void **state)
{
    const char *path = *state;
    const int first[GM_MAX_INPUT_PATHS] = {1, 0};
    double step[2] = {0.0, 0.0};
    for (int i = 0; i < 2; i++) {
        gm_fmu_steps_plant *plant = NULL;
        assert_int_equal(
            gm_fmu_steps_create(path, i ? GM_FMU_LASH : GM_FMU_RIGID, STEP, &plant, NULL),
            GM_OK);
        assert_int_equal(gm_fmu_steps_recommended(plant, first, &step[i], NULL), GM_OK);
        gm_fmu_steps_destroy(plant);
    }
    assert_true(step[1] > 0.0 && step[1] <= step[0]);
}

static void what_cannot_be_is_refused(void **state)
{
    const char *path = *state;
    const double steps[] = {0.0, -1e-3, (double)NAN, (double)INFINITY};
    gm_fmu_steps_plant *plant = NULL;
    gm_error error;
    for (int i = 0; i < 4; i++)
        assert_int_equal(
            gm_fmu_steps_create(path, GM_FMU_RIGID, steps[i], &plant, &error),
            GM_ERR_ARGUMENT);
    assert_int_not_equal(
        gm_fmu_steps_create("/nowhere/a.fmu", GM_FMU_RIGID, STEP, &plant, &error), GM_OK);
    assert_non_null(strstr(error.message, "/nowhere/a.fmu"));
    assert_null(plant);
}

static void no_memory(void **state)
{
    const char *path = *state;
    gm_status status = GM_ERR_MEMORY;
    gm_fmu_steps_plant *plant = NULL;
    for (long k = 1; status != GM_OK && k < 1000; k++) {
        gm_alloc_fail_after(k);
        status = gm_fmu_steps_create(path, GM_FMU_RIGID, STEP, &plant, NULL);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || !plant);
        if (status != GM_OK) /* a name that could not be copied reads as a missing one */
            assert_true(status == GM_ERR_MEMORY || status == GM_ERR_FORMAT);
        else
            gm_fmu_steps_destroy(plant);
        k += k > 20 ? 40 : 0; /* each of them unpacks the FMU */
    }
    assert_int_equal(status, GM_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constant_torques_move_it_as_the_fmu),
        cmocka_unit_test(a_stiff_clutch_beside_it_is_stable),
        cmocka_unit_test(a_commanded_gear_reaches_the_fmu),
        cmocka_unit_test(the_component_recommends_a_step),
        cmocka_unit_test(what_cannot_be_is_refused),
        cmocka_unit_test(no_memory),
    };
    return cmocka_run_group_tests(tests, baked_make, baked_remove);
}
