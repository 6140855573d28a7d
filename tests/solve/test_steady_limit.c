/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The two solvers of the room against each other: a detailed gearset whose output and
 * neutral paths are driven at constant speeds, and whose engaged path gets a torque, must
 * come to rest, so to speak, at the steady experiment's point.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "plant/gm_builtin.h"
#include "solve/gm_driven.h"
#include "solve/gm_steady_solver.h"

#include <math.h>
#include <string.h>

#define POINTS 100
#define RISE 0.02   /* s, in which the torque comes on: a step would ring for long */
#define SETTLED 0.5 /* s: mesh vibrations of some kHz with 5 % damping are gone */

typedef struct rig {
    gm_description *d;
    gm_gearset *gearset;
    gm_plant *plant;
    gm_steady_solver *solver;
    gm_dynamics dynamics;
    gm_error error;
} rig;

static void must(const rig *r, gm_status status)
{
    if (status != GM_OK)
        fail_msg("%s", r->error.message);
}

static void open_rig(rig *r, const char *file)
{
    memset(r, 0, sizeof *r);
    must(r, gm_description_read(file, &r->d, &r->error));
    must(r, gm_gearset_create(r->d, r->d->oil.temperature, &r->gearset, &r->error));
    must(r, gm_builtin_create(r->gearset, &r->plant, &r->error));
    must(r, gm_steady_solver_create(r->plant, &r->solver, &r->error));
    r->dynamics = gm_builtin_dynamics(r->gearset);
}

static void close_rig(rig *r)
{
    gm_steady_solver_destroy(r->solver);
    gm_builtin_destroy(r->plant);
    gm_gearset_destroy(r->gearset);
    gm_description_destroy(r->d);
}

/* ---- constant speeds, a torque that comes on ---- */

static double enter(void *user, double t, int *jump)
{
    (void)user;
    *jump = 0;
    return t < RISE ? RISE : (double)INFINITY;
}

static void at(void *user, double t, gm_drive_point *point)
{
    const gm_steady_point *steady = user;
    double u = fmin(t / RISE, 1.0);
    memcpy(point->input.gear, steady->gear, sizeof steady->gear);
    for (int f = 0; f < GM_MAX_FLANGES; f++) {
        point->input.torque[f] = u * u * (3.0 - 2.0 * u) * steady->torque[f];
        point->speed[f] = steady->speed[f];
        point->acceleration[f] = 0.0;
    }
}

/* Loss of the moving gearset after it has settled, and what its flanges say. */
static double settled_loss(rig *r, gm_steady_point *point, gm_motion_input *input)
{
    gm_driven *driven = NULL;
    gm_transient *transient = NULL;
    gm_motion_view view;
    gm_drive drive = {.user = point, .driven = {1}, .enter = enter, .at = at};
    for (int p = 0; p < r->dynamics.n_paths; p++)
        drive.driven[1 + p] = point->gear[p] == 0;
    must(r,
         gm_driven_create(&r->dynamics, &drive, 0.0, point->speed, &driven, &r->error));
    const gm_transient_system system = gm_driven_system(driven);
    const gm_transient_options options = {.tolerance = 1e-4};
    must(r, gm_transient_create(&system, &options, &transient, &r->error));
    must(r, gm_transient_start(transient, 0.0, &r->error));
    must(r, gm_transient_advance(transient, SETTLED, &r->error));
    const double *x = gm_transient_state(transient);
    assert_int_equal(gm_driven_input(driven, SETTLED, x, input), 0);
    r->dynamics.is->view(gm_driven_motion(driven), input, x, &view);
    gm_transient_destroy(transient);
    gm_driven_destroy(driven);
    return view.loss_power;
}

/* ---- random points ---- */

static double random_between(uint64_t *seed, double low, double high)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(*seed >> 11) / 9007199254740992.0;
}

static gm_steady_point random_point(const rig *r, uint64_t *seed)
{
    const gm_plant_info *info = &r->plant->info;
    gm_steady_point point = {.direction = {1.0, 1.0, 1.0}};
    gm_kinematics k;
    int p = (int)random_between(seed, 0.0, info->n_paths);
    const gm_plant_path *path = &info->path[p];
    point.gear[p] = path->gears[(int)random_between(seed, 0.0, path->n_gears)].number;
    assert_int_equal(r->plant->is->kinematics(r->plant->self, point.gear, &k, NULL),
                     GM_OK);
    /* no slower: parts that turn by less than 0.1 rad/s against each other are in the
       band in which the motion rounds Coulomb friction */
    double speed = random_between(seed, 0.05, 1.0) * info->speed_max;
    point.speed[0] = speed / k.ratio[p];
    if (random_between(seed, 0.0, 1.0) < 0.3)
        point.speed[0] = -point.speed[0];
    for (int q = 0; q < info->n_paths; q++)
        if (q != p)
            point.speed[1 + q] = random_between(seed, -0.5, 0.5) * info->speed_max;
    point.torque[1 + p] = random_between(seed, -1.0, 1.0) * info->torque_max;
    return point;
}

static void compare(rig *r, gm_steady_point *point, double *worst)
{
    gm_steady_result steady;
    gm_motion_input input;
    double loss = 0.0, through = 0.0;
    must(r, gm_steady_solve(r->solver, point, &steady, &r->error));
    for (int f = 0; f <= r->dynamics.n_paths; f++) {
        double power = steady.torque[f] * steady.speed[f];
        loss += power;
        through = fmax(through, fabs(power));
    }
    double moving = settled_loss(r, point, &input);
    worst[0] = fmax(worst[0], fabs(moving / loss - 1.0));
    double off = fabs(input.torque[0] - steady.torque[0]) * fabs(steady.speed[0]);
    worst[1] = fmax(worst[1], off / through);
}

/* 1e-4: the bar. What is left is vibration that has not died out. */
static void the_motion_settles_at_the_steady_point(void **state)
{
    (void)state;
    rig r;
    uint64_t seed = 11;
    double worst[2] = {0.0, 0.0};
    open_rig(&r, GM_SOURCE_DIR "/examples/dct7.yaml");
    for (int i = 0; i < POINTS; i++) {
        gm_steady_point point = random_point(&r, &seed);
        compare(&r, &point, worst);
    }
    print_message("largest error of the loss %.2e of it, of the output power %.2e of the "
                  "power\n",
                  worst[0], worst[1]);
    assert_true(worst[0] < 1e-4 && worst[1] < 1e-4);
    close_rig(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_motion_settles_at_the_steady_point),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
