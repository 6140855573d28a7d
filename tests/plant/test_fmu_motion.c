/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A baked component in Model Exchange as a plant in motion: starts at the speeds that are
 * given, its derivatives are those of its rates, what is no component is refused.
 */
#include "baked.h"
#include "plant/gm_fmu_motion.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { N_MAX = 32 };

/* One motion with its first gear engaged, its output turning. */
typedef struct rig {
    gm_fmu_plant *plant;
    gm_dynamics dynamics;
    void *motion;
    int n;
    double x[N_MAX];
    gm_motion_input input;
} rig;

static void open_rig(rig *r, const char *fmu, gm_fmu_fidelity fidelity)
{
    gm_error error;
    const double speed[GM_MAX_FLANGES] = {30.0, 0.0, 12.0};
    memset(r, 0, sizeof *r);
    r->input = (gm_motion_input){.torque = {-300.0, 80.0, 2.0}, .gear = {1, 0}};
    if (gm_fmu_plant_create(fmu, fidelity, &r->plant, &error) != GM_OK)
        fail_msg("%s", error.message);
    r->dynamics = gm_fmu_plant_dynamics(r->plant);
    assert_int_equal(r->dynamics.n_paths, 2);
    assert_int_equal(r->dynamics.is->create(r->plant, &r->motion, &error), GM_OK);
    r->n = r->dynamics.is->n_states(r->motion);
    assert_true(r->n <= N_MAX);
    if (r->dynamics.is->start(r->motion, &r->input, speed, r->x, &error) != GM_OK)
        fail_msg("%s", error.message);
}

static void close_rig(rig *r)
{
    r->dynamics.is->destroy(r->motion);
    gm_fmu_plant_destroy(r->plant);
}

static void rates(rig *r, const double *x, double *dx)
{
    assert_int_equal(r->dynamics.is->rates(r->motion, &r->input, x, dx), 0);
}

/* Central differences inside a cell of a table: curvature over h, rounding of rates of
 * 1e4. */
static void check_column(const double *exact, const double *up, const double *down,
                         double h, int n)
{
    for (int i = 0; i < n; i++) {
        double slope = (up[i] - down[i]) / (2.0 * h);
        assert_true(fabs(exact[i] - slope) <= 1e-4 * fabs(slope) + 1e-4);
    }
}

static void check_derivatives(rig *r)
{
    double value[N_MAX * N_MAX], up[N_MAX], down[N_MAX], moved[N_MAX], column[N_MAX];
    int column_start[N_MAX + 1], row[N_MAX * N_MAX];
    const gm_dynamics_class *is = r->dynamics.is;
    assert_non_null(is->jacobian);
    assert_true(is->entries(r->motion) <= N_MAX * N_MAX);
    is->pattern(r->motion, column_start, row);
    assert_int_equal(is->jacobian(r->motion, &r->input, r->x, value), 0);
    for (int k = 0; k < r->n; k++) {
        double exact[N_MAX] = {0.0}, h = 1e-5;
        memcpy(moved, r->x, sizeof moved);
        moved[k] = r->x[k] + h;
        rates(r, moved, up);
        moved[k] = r->x[k] - h;
        rates(r, moved, down);
        for (int e = column_start[k]; e < column_start[k + 1]; e++)
            exact[row[e]] = value[e];
        check_column(exact, up, down, h, r->n);
    }
    for (int f = 0; f <= r->dynamics.n_paths; f++) {
        assert_int_equal(is->torque_column(r->motion, &r->input, r->x, f, column), 0);
        r->input.torque[f] += 1e-3;
        rates(r, r->x, up);
        r->input.torque[f] -= 2e-3;
        rates(r, r->x, down);
        r->input.torque[f] += 1e-3;
        check_column(column, up, down, 1e-3, r->n);
    }
}

static void derivatives_are_those_of_the_rates(void **state)
{
    const gm_fmu_fidelity both[] = {GM_FMU_RIGID, GM_FMU_LASH};
    for (int i = 0; i < 2; i++) {
        rig r;
        open_rig(&r, *state, both[i]);
        check_derivatives(&r);
        close_rig(&r);
    }
}

static void starts_at_the_speeds_that_are_given(void **state)
{
    rig r;
    gm_motion_view view;
    open_rig(&r, *state, GM_FMU_RIGID);
    const gm_dynamics_class *is = r.dynamics.is;
    is->view(r.motion, &r.input, r.x, &view);
    assert_true(r.x[is->speed_state(r.motion, 0)] == 30.0 && view.speed[0] == 30.0);
    assert_true(view.speed[2] == 12.0);
    assert_int_equal(view.state[0], 2); /* engaged */
    assert_int_equal(view.state[1], 0);
    assert_true(view.loss_power > 0.0 && view.stored_energy > 0.0);
    close_rig(&r);
}

static void what_is_no_component_is_refused(void **state)
{
    const char *fmu = *state;
    char missing[128];
    gm_fmu_plant *plant = NULL;
    gm_error error;
    snprintf(missing, sizeof missing, "%.*s/missing.fmu", (int)(strrchr(fmu, '/') - fmu),
             fmu);
    assert_int_not_equal(gm_fmu_plant_create(missing, GM_FMU_RIGID, &plant, &error),
                         GM_OK);
    assert_non_null(strstr(error.message, "missing.fmu"));
    assert_null(plant);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(derivatives_are_those_of_the_rates),
        cmocka_unit_test(starts_at_the_speeds_that_are_given),
        cmocka_unit_test(what_is_no_component_is_refused),
    };
    return cmocka_run_group_tests(tests, baked_make, baked_remove);
}
