/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Every gearset in examples/, random operating points: what the flanges bring in is what
 * the parts lose, to 1e-9 of the power that goes through.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/alloc.h"
#include "plant/gm_builtin.h"
#include "property.h"
#include "solve/gm_steady_solver.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define FOLDER GM_SOURCE_DIR "/examples"
#define POINTS 2000
/* The solver leaves no torque balance open by more than 1e-11 of the largest flange
 * torque; the fastest part turns up to 20 times as fast as the output. */
#define TOLERANCE 1e-9

/* A gear of the path, or neutral if it has one. */
static int random_gear(const gm_path_part *path, uint64_t *state)
{
    int n = path->n_gears + (path->has_neutral ? 1 : 0);
    int i = (int)random_between(state, 0.0, n);
    return i < path->n_gears ? path->gears[i].number : 0;
}

/* Speeds on both sides of zero within the limits; torques of both signs. */
static gm_steady_point random_point(const gm_gearset *gearset, uint64_t *state)
{
    const gm_description *d = gm_gearset_description(gearset);
    gm_steady_point point = {.gear = {0}};
    gm_kinematics k;
    double input = random_between(state, -1.0, 1.0) * d->speed_max, ratio = 5.0;
    for (int p = 0; p < d->n_paths; p++) {
        point.gear[p] = random_gear(&d->paths[p], state);
        point.torque[1 + p] = random_between(state, -1.0, 1.0) * d->torque_max;
        point.speed[1 + p] = random_between(state, -1.0, 1.0) * d->speed_max;
    }
    assert_int_equal(gm_gearset_kinematics(gearset, point.gear, &k, NULL), GM_OK);
    for (int p = 0; p < d->n_paths; p++)
        if (point.gear[p] != 0)
            ratio = k.ratio[p];
    point.speed[0] = input / ratio;
    for (int i = 0; i < GM_MAX_FLANGES; i++)
        point.direction[i] = point.speed[i] < 0.0 ? -1.0 : 1.0;
    return point;
}

static double sum_of_losses(const gm_gearset *gearset, gm_steady_solver *solver)
{
    const double *x;
    gm_balance *work = gm_steady_solver_work(solver, &x);
    int n = gm_gearset_element_count(gearset);
    gm_element_loss *losses = gm_calloc((size_t)n, sizeof *losses);
    double sum = 0.0;
    assert_non_null(losses);
    gm_balance_losses(work, x, losses);
    for (int i = 0; i < n; i++) {
        assert_true(losses[i].power >= 0.0);
        sum += losses[i].power;
    }
    gm_free(losses);
    return sum;
}

static void check_point(const gm_gearset *gearset, gm_steady_solver *solver,
                        const gm_steady_point *point)
{
    const gm_description *d = gm_gearset_description(gearset);
    gm_steady_result result;
    gm_error error = {GM_OK, ""};
    double in = 0.0, through = 0.0;
    if (gm_steady_solve(solver, point, &result, &error) != GM_OK)
        fail_msg("%s: %s", d->file, error.message);
    for (int i = 0; i <= d->n_paths; i++) {
        in += result.torque[i] * result.speed[i];
        through += fabs(result.torque[i] * result.speed[i]);
    }
    double lost = sum_of_losses(gearset, solver);
    if (!(fabs(in - lost) <= TOLERANCE * through))
        fail_msg("%s, gears %d %d: %.17g W in, %.17g W lost, %.6g W through", d->file,
                 point->gear[0], point->gear[1], in, lost, through);
}

static void check_example(const char *file)
{
    gm_description *d = NULL;
    gm_gearset *gearset = NULL;
    gm_plant *plant = NULL;
    gm_steady_solver *solver = NULL;
    gm_error error = {GM_OK, ""};
    uint64_t state = 1;
    if (gm_description_read(file, &d, &error) != GM_OK)
        fail_msg("%s", error.message);
    assert_int_equal(gm_gearset_create(d, d->oil.temperature, &gearset, NULL), GM_OK);
    assert_int_equal(gm_builtin_create(gearset, &plant, NULL), GM_OK);
    assert_int_equal(gm_steady_solver_create(plant, &solver, NULL), GM_OK);
    for (int i = 0; i < POINTS; i++) {
        gm_steady_point point = random_point(gearset, &state);
        check_point(gearset, solver, &point);
    }
    gm_steady_solver_destroy(solver);
    gm_builtin_destroy(plant);
    gm_gearset_destroy(gearset);
    gm_description_destroy(d);
}

/* Vehicles have files of their own. */
static int is_description(const char *name)
{
    const char *end = strrchr(name, '.');
    return end && strcmp(end, ".yaml") == 0 && strncmp(name, "vehicle_", 8) != 0;
}

static void examples_lose_what_their_flanges_bring(void **state)
{
    (void)state;
    int n = 0;
    DIR *folder = opendir(FOLDER);
    assert_non_null(folder);
    for (struct dirent *entry; (entry = readdir(folder));) {
        char file[512];
        if (!is_description(entry->d_name))
            continue;
        assert_true(snprintf(file, sizeof file, "%s/%s", FOLDER, entry->d_name) <
                    (int)sizeof file);
        check_example(file);
        n++;
    }
    closedir(folder);
    assert_true(n >= 6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(examples_lose_what_their_flanges_bring),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
