/* SPDX-License-Identifier: BSD-2-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/alloc.h"
#include "model/bearing.h"
#include "plant/gm_builtin.h"
#include "solve/gm_steady_solver.h"
#include "reducer_fixture.h"

#include <math.h>
#include <string.h>

typedef struct test_rig {
    reducer r;
    gm_gearset *gearset;
    gm_plant *plant;
    gm_steady_solver *solver;
} test_rig;

static void open_rig(test_rig *rig)
{
    assert_int_equal(gm_gearset_create(&rig->r.d, 353.15, &rig->gearset, NULL), GM_OK);
    assert_int_equal(gm_builtin_create(rig->gearset, &rig->plant, NULL), GM_OK);
    assert_int_equal(gm_steady_solver_create(rig->plant, &rig->solver, NULL), GM_OK);
}

static void close_rig(test_rig *rig)
{
    gm_steady_solver_destroy(rig->solver);
    gm_builtin_destroy(rig->plant);
    gm_gearset_destroy(rig->gearset);
}

static void lossy_reducer(test_rig *rig)
{
    reducer_make(&rig->r);
    rig->r.meshes[0].loss = GM_MESH_TEMPERATURE_DEPENDENT;
    rig->r.meshes[0].minimum_line_load = 0.0;
    for (int i = 0; i < 4; i++)
        rig->r.bearings[i].data.friction = i % 2 ? GM_FRICTION_PALMGREN : GM_FRICTION_SKF;
    rig->r.wheels[1].bearing.friction = GM_FRICTION_PALMGREN;
    rig->r.wheels[1].mass = 0.8;
    rig->r.shafts[0].mass = 1.5;
    rig->r.shafts[1].mass = 2.0;
}

static double sum_of_losses(test_rig *rig)
{
    const double *x;
    gm_balance *work = gm_steady_solver_work(rig->solver, &x);
    gm_element_loss losses[16];
    double sum = 0.0;
    gm_balance_losses(work, x, losses);
    for (int i = 0; i < gm_gearset_element_count(rig->gearset); i++)
        sum += losses[i].power;
    return sum;
}

static void power_balances_over_the_whole_range(void **state)
{
    (void)state;
    test_rig rig;
    lossy_reducer(&rig);
    open_rig(&rig);
    for (int i = 0; i < 400; i++) {
        gm_steady_point point = {.gear = {1},
                                 .speed = {2.0 * i - 400.0},
                                 .direction = {i % 2 ? 1.0 : -1.0},
                                 .torque = {0.0, 200.0 * sin(0.7 * i)}};
        gm_steady_result result;
        assert_int_equal(gm_steady_solve(rig.solver, &point, &result, NULL), GM_OK);
        double in =
            result.torque[0] * result.speed[0] + result.torque[1] * result.speed[1];
        double throughput = fabs(result.torque[0] * result.speed[0]);
        assert_true(fabs(in - sum_of_losses(&rig)) <= 1e-9 * throughput + 1e-12);
    }
    close_rig(&rig);
}

/* The start of the iteration may not show in the result: a grid line may begin anywhere.
 */
static void result_does_not_depend_on_the_start(void **state)
{
    (void)state;
    test_rig rig;
    lossy_reducer(&rig);
    open_rig(&rig);
    gm_steady_point near_by = {.gear = {1}, .speed = {90.0}, .direction = {1.0}};
    gm_steady_point point = near_by;
    gm_steady_result cold, warm;
    near_by.torque[1] = -150.0;
    point.speed[0] = 91.0;
    point.torque[1] = 37.0;
    assert_int_equal(gm_steady_solve(rig.solver, &point, &cold, NULL), GM_OK);
    assert_int_equal(gm_steady_solve(rig.solver, &near_by, &warm, NULL), GM_OK);
    assert_int_equal(gm_steady_solve(rig.solver, &point, &warm, NULL), GM_OK);
    assert_true(fabs(warm.torque[0] - cold.torque[0]) <= 1e-11 * fabs(cold.torque[0]));
    close_rig(&rig);
}

/* Driven by the drag of its only gear, the input turns in step with it: the idling gear's
 * bearing holds (its friction jumps there), and the torque at the free flange is zero. */
static void free_input_turns_with_its_gear(void **state)
{
    (void)state;
    test_rig rig;
    lossy_reducer(&rig);
    for (int i = 0; i < 2; i++) /* nothing else holds the input */
        rig.r.bearings[i].data.friction = GM_FRICTION_NONE;
    open_rig(&rig);
    gm_steady_point point = {.gear = {0}, .speed = {100.0, 0.0}, .direction = {1.0, 1.0}};
    gm_free_path found;
    gm_steady_result result;
    assert_int_equal(gm_steady_solve_free(rig.solver, 0, &point, &found, &result, NULL),
                     GM_OK);
    assert_int_equal(found.sticks, 1);
    assert_true(fabs(found.speed + 100.0 * 49.0 / 32.0) < 1e-9);
    assert_true(fabs(result.torque[1]) < 1e-12);
    close_rig(&rig);
}

/* With strong bearings on the input and a light drag, friction holds it at rest. */
static void free_input_is_held_at_rest(void **state)
{
    (void)state;
    test_rig rig;
    lossy_reducer(&rig);
    rig.r.shafts[0].mass = 500.0;
    rig.r.wheels[1].bearing.f0 = 0.01;
    open_rig(&rig);
    gm_steady_point point = {.gear = {0}, .speed = {1.0, 7.0}, .direction = {1.0, 1.0}};
    gm_free_path found;
    gm_steady_result result;
    assert_int_equal(gm_steady_solve_free(rig.solver, 0, &point, &found, &result, NULL),
                     GM_OK);
    assert_int_equal(found.sticks, 1);
    assert_true(found.speed == 0.0);
    assert_true(fabs(result.torque[1]) < 1e-12);
    close_rig(&rig);
}

/* ---- a plant on which the passes diverge ---- */

/* x_0 = 3 - 2 x_1 + sin x_1, x_1 = 1 + 1.5 x_0: a pass multiplies errors by up to 4. */
static gm_status strong_create(const void *self, void **work, gm_error *error)
{
    (void)self, (void)error;
    static int dummy;
    *work = &dummy;
    return GM_OK;
}

static void strong_destroy(void *work)
{
    (void)work;
}

static gm_status strong_point(void *work, const gm_steady_point *point, gm_error *error)
{
    (void)work, (void)point, (void)error;
    return GM_OK;
}

static int two(const void *work)
{
    (void)work;
    return 2;
}

static int four(const void *work)
{
    (void)work;
    return 4;
}

static void strong_residual(void *work, const double *x, double *f)
{
    (void)work;
    f[0] = 3.0 - 2.0 * x[1] + sin(x[1]) - x[0];
    f[1] = 1.0 + 1.5 * x[0] - x[1];
}

static double strong_pass(void *work, double *x)
{
    double f[2];
    strong_residual(work, x, f);
    x[0] += f[0];
    x[1] += f[1];
    return fmax(fabs(f[0]), fabs(f[1]));
}

static void strong_pattern(const void *work, int *column_start, int *row)
{
    (void)work;
    const int start[] = {0, 2, 4}, rows[] = {0, 1, 0, 1};
    memcpy(column_start, start, sizeof start);
    memcpy(row, rows, sizeof rows);
}

static void strong_jacobian(void *work, const double *x, double *value)
{
    (void)work;
    value[0] = -1.0;
    value[1] = 1.5;
    value[2] = -2.0 + cos(x[1]);
    value[3] = -1.0;
}

static void strong_result(const void *work, const double *x, gm_steady_result *result)
{
    (void)work;
    memset(result, 0, sizeof *result);
    result->torque[0] = x[0];
    result->torque[1] = x[1];
}

static void strong_coupling_is_left_to_newton(void **state)
{
    (void)state;
    const gm_plant_class strong = {.work_create = strong_create,
                                   .work_destroy = strong_destroy,
                                   .set_point = strong_point,
                                   .size = two,
                                   .entries = four,
                                   .pass = strong_pass,
                                   .residual = strong_residual,
                                   .pattern = strong_pattern,
                                   .jacobian = strong_jacobian,
                                   .result = strong_result};
    const gm_plant plant = {.is = &strong, .info = {.name = "strong", .n_paths = 1}};
    gm_steady_solver *solver;
    gm_steady_point point = {.gear = {1}};
    gm_steady_result result;
    assert_int_equal(gm_steady_solver_create(&plant, &solver, NULL), GM_OK);
    assert_int_equal(gm_steady_solve(solver, &point, &result, NULL), GM_OK);
    double f[2], x[2] = {result.torque[0], result.torque[1]};
    strong_residual(NULL, x, f);
    assert_true(fabs(f[0]) < 1e-10 && fabs(f[1]) < 1e-10);
    gm_steady_solver_destroy(solver);
}

/* x_0 = 3 + 0.4 |x_1|, x_1 = 0.5 x_0 - 2: the passes contract; the Jacobian leads uphill,
 * as that of the wrong side of a kink does. */
static void kinked_residual(void *work, const double *x, double *f)
{
    (void)work;
    f[0] = 3.0 + 0.4 * fabs(x[1]) - x[0];
    f[1] = 0.5 * x[0] - 2.0 - x[1];
}

static double kinked_pass(void *work, double *x)
{
    double f[2];
    kinked_residual(work, x, f);
    x[0] += f[0];
    x[1] += f[1];
    return fmax(fabs(f[0]), fabs(f[1]));
}

static void misleading_jacobian(void *work, const double *x, double *value)
{
    (void)work, (void)x;
    value[0] = 1.0;
    value[1] = 0.0;
    value[2] = 0.0;
    value[3] = 1.0;
}

static void what_newton_cannot_solve_is_left_to_the_passes(void **state)
{
    (void)state;
    const gm_plant_class kinked = {.work_create = strong_create,
                                   .work_destroy = strong_destroy,
                                   .set_point = strong_point,
                                   .size = two,
                                   .entries = four,
                                   .pass = kinked_pass,
                                   .residual = kinked_residual,
                                   .pattern = strong_pattern,
                                   .jacobian = misleading_jacobian,
                                   .result = strong_result};
    const gm_plant plant = {.is = &kinked, .info = {.name = "kinked", .n_paths = 1}};
    gm_steady_solver *solver;
    gm_steady_point point = {.gear = {1}};
    gm_steady_result result;
    assert_int_equal(gm_steady_solver_create(&plant, &solver, NULL), GM_OK);
    assert_int_equal(gm_steady_solve(solver, &point, &result, NULL), GM_OK);
    assert_true(fabs(result.torque[0] - 3.8 / 1.2) < 1e-10);
    gm_steady_solver_destroy(solver);
}

/* x_0 = 2 - 1.6 (x_0 - 0.5): full passes go to and fro and grow, half steps contract. */
static void steep_residual(void *work, const double *x, double *f)
{
    (void)work;
    f[0] = 2.0 - 1.6 * (x[0] - 0.5) - x[0];
    f[1] = 0.5 * x[0] - x[1];
}

static double steep_pass(void *work, double *x)
{
    double f[2];
    steep_residual(work, x, f);
    x[0] += f[0];
    x[1] += f[1];
    return fmax(fabs(f[0]), fabs(f[1]));
}

static void steep_friction_is_solved_in_part_steps(void **state)
{
    (void)state;
    const gm_plant_class steep = {.work_create = strong_create,
                                  .work_destroy = strong_destroy,
                                  .set_point = strong_point,
                                  .size = two,
                                  .entries = four,
                                  .pass = steep_pass,
                                  .residual = steep_residual,
                                  .pattern = strong_pattern,
                                  .jacobian = misleading_jacobian,
                                  .result = strong_result};
    const gm_plant plant = {.is = &steep, .info = {.name = "steep", .n_paths = 1}};
    gm_steady_solver *solver;
    gm_steady_point point = {.gear = {1}};
    gm_steady_result result;
    assert_int_equal(gm_steady_solver_create(&plant, &solver, NULL), GM_OK);
    assert_int_equal(gm_steady_solve(solver, &point, &result, NULL), GM_OK);
    assert_true(fabs(result.torque[0] - 2.8 / 2.6) < 1e-10);
    gm_steady_solver_destroy(solver);
}

static void no_residual(void *work, const double *x, double *f)
{
    (void)work;
    f[0] = 1.0 + x[0] * x[0];
    f[1] = 1.0 + x[1] * x[1];
}

static void point_without_solution_is_named(void **state)
{
    (void)state;
    const gm_plant_class none = {.work_create = strong_create,
                                 .work_destroy = strong_destroy,
                                 .set_point = strong_point,
                                 .size = two,
                                 .entries = four,
                                 .pass = strong_pass,
                                 .residual = no_residual,
                                 .pattern = strong_pattern,
                                 .jacobian = strong_jacobian,
                                 .result = strong_result};
    const gm_plant plant = {.is = &none, .info = {.name = "none", .n_paths = 1}};
    gm_steady_solver *solver;
    gm_steady_point point = {.gear = {3}, .torque = {0.0, 42.0}};
    gm_steady_result result = {.torque = {7.0}};
    gm_error error = {GM_OK, ""};
    assert_int_equal(gm_steady_solver_create(&plant, &solver, NULL), GM_OK);
    assert_int_equal(gm_steady_solve(solver, &point, &result, &error), GM_ERR_SOLVE);
    assert_non_null(strstr(error.message, "gears (3, 0)"));
    assert_non_null(strstr(error.message, "(42, 0) N.m"));
    assert_true(result.torque[0] == 7.0);
    gm_steady_solver_destroy(solver);
}

static void failing_memory_leaves_nothing_behind(void **state)
{
    (void)state;
    test_rig rig;
    lossy_reducer(&rig);
    assert_int_equal(gm_gearset_create(&rig.r.d, 353.15, &rig.gearset, NULL), GM_OK);
    for (long k = 1; k < 200; k++) {
        gm_steady_point point = {.gear = {1}, .speed = {10.0}, .direction = {1.0}};
        gm_steady_result result;
        rig.plant = NULL;
        rig.solver = NULL;
        gm_alloc_fail_after(k);
        gm_status status = gm_builtin_create(rig.gearset, &rig.plant, NULL);
        if (status == GM_OK)
            status = gm_steady_solver_create(rig.plant, &rig.solver, NULL);
        if (status == GM_OK)
            status = gm_steady_solve(rig.solver, &point, &result, NULL);
        gm_alloc_fail_after(0);
        gm_steady_solver_destroy(rig.solver);
        gm_builtin_destroy(rig.plant);
        if (status == GM_OK) {
            gm_gearset_destroy(rig.gearset);
            return;
        }
        assert_int_equal(status, GM_ERR_MEMORY);
    }
    fail_msg("never succeeded");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(power_balances_over_the_whole_range),
        cmocka_unit_test(result_does_not_depend_on_the_start),
        cmocka_unit_test(free_input_turns_with_its_gear),
        cmocka_unit_test(free_input_is_held_at_rest),
        cmocka_unit_test(strong_coupling_is_left_to_newton),
        cmocka_unit_test(what_newton_cannot_solve_is_left_to_the_passes),
        cmocka_unit_test(steep_friction_is_solved_in_part_steps),
        cmocka_unit_test(point_without_solution_is_named),
        cmocka_unit_test(failing_memory_leaves_nothing_behind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
