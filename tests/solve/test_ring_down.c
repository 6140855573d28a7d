/* SPDX-License-Identifier: BSD-2-Clause
 *
 * How fast a loaded path rings down after a step of torque, output at constant speed: the
 * detailed gearset, with idling gears that hang in their backlash, beside one inertia on
 * the spring and damper of gm_compliance (law: core/reduced_spring.c).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "plant/gm_builtin.h"
#include "solve/gm_driven.h"

#include <math.h>
#include <string.h>

#define SPEED 150.0   /* rad/s, of the input */
#define PRELOAD 50.0  /* N.m: all meshes of the path stay in contact */
#define BEFORE 0.4    /* s, to settle */
#define LENGTH 0.05   /* s, looked at after the step: over by then */
#define SAMPLE 1e-5   /* s: 80 in the shortest period */
#define SLOW_SLIP 1.0 /* rad/s, beyond which damping falls (core/reduced_spring.c) */

typedef struct rig {
    gm_description *d;
    gm_gearset *gearset;
    gm_plant *plant;
    gm_error error;
} rig;

typedef struct pull {
    int p, gear, stepped;
    double ratio, step; /* step: N.m, at BEFORE */
} pull;

static void must(const rig *r, gm_status status)
{
    if (status != GM_OK)
        fail_msg("%s", r->error.message);
}

static double enter(void *user, double t, int *jump)
{
    pull *u = user;
    u->stepped = t >= BEFORE;
    *jump = u->stepped;
    return u->stepped ? (double)INFINITY : BEFORE;
}

static void at(void *user, double t, gm_drive_point *point)
{
    const pull *u = user;
    (void)t;
    *point = (gm_drive_point){.speed = {SPEED / u->ratio}};
    point->input.torque[1 + u->p] = PRELOAD + (u->stepped ? u->step : 0.0);
    point->input.gear[u->p] = u->gear;
}

/* Integral of the squared slip between input and output [rad2/s]. */
static double detailed_slip(rig *r, pull *u)
{
    gm_driven *driven = NULL;
    gm_transient *transient = NULL;
    const gm_dynamics dynamics = gm_builtin_dynamics(r->gearset);
    const gm_drive drive = {.user = u, .driven = {1}, .enter = enter, .at = at};
    const gm_transient_options options = {.tolerance = 1e-5};
    const double start[GM_MAX_FLANGES] = {SPEED / u->ratio, SPEED, SPEED};
    must(r, gm_driven_create(&dynamics, &drive, 0.0, start, &driven, &r->error));
    const gm_transient_system system = gm_driven_system(driven);
    must(r, gm_transient_create(&system, &options, &transient, &r->error));
    must(r, gm_transient_start(transient, 0.0, &r->error));
    must(r, gm_transient_advance(transient, BEFORE, &r->error));
    int input = dynamics.is->speed_state(gm_driven_motion(driven), 1 + u->p);
    double sum = 0.0;
    for (int i = 1; i <= (int)(LENGTH / SAMPLE + 0.5); i++) {
        must(r, gm_transient_advance(transient, BEFORE + i * SAMPLE, &r->error));
        double slip = gm_transient_state(transient)[input] - SPEED;
        sum += slip * slip * SAMPLE;
    }
    gm_transient_destroy(transient);
    gm_driven_destroy(driven);
    return sum;
}

/* J ds/dt = step - k x - d s - d_l s (1 + |s|) / (1 + |s| + s^2), dx/dt = s, by
 * leapfrog. */
static double reduced_slip(const gm_compliance *c, double inertia, double step)
{
    const double h = 1e-7;
    double x = 0.0, s = 0.0, sum = 0.0;
    for (int i = 0; i < (int)(LENGTH / h); i++) {
        double y = fabs(s) / SLOW_SLIP;
        double share = (1.0 + y) / (1.0 + y + y * y);
        double damper = (c->damping + c->loose_damping * share) * s;
        s += h * (step - c->stiffness * x - damper) / inertia;
        x += h * s;
        sum += s * s * h;
    }
    return sum;
}

/* One damper stands for what many small impacts take: three times off is near, in the
 * mean half as much. Without the loose gears all would be ten to thirty times off. */
static void rings_down_like_the_detailed(void **state)
{
    static const double steps[2] = {-2.0, -10.0};
    const int neutral[GM_MAX_INPUT_PATHS] = {0};
    (void)state;
    rig r = {.gearset = NULL};
    gm_kinematics rest;
    double mean = 0.0;
    int n = 0;
    must(&r, gm_description_read(GM_SOURCE_DIR "/examples/dct7.yaml", &r.d, &r.error));
    must(&r, gm_gearset_create(r.d, r.d->oil.temperature, &r.gearset, &r.error));
    must(&r, gm_builtin_create(r.gearset, &r.plant, &r.error));
    const gm_plant_class *is = r.plant->is;
    must(&r, is->kinematics(r.plant->self, neutral, &rest, &r.error));
    for (int k = 0; k < 2 * GM_MAX_INPUT_PATHS; k++) {
        int p = k / 2;
        for (int i = 0; i < r.plant->info.path[p].n_gears; i++) {
            pull u = {.p = p, .gear = r.plant->info.path[p].gears[i].number};
            int gear[GM_MAX_INPUT_PATHS] = {0};
            gm_kinematics kinematics;
            gm_compliance c;
            gear[p] = u.gear;
            must(&r, is->kinematics(r.plant->self, gear, &kinematics, &r.error));
            must(&r, is->compliance(r.plant->self, p, u.gear, &c, &r.error));
            u.ratio = kinematics.ratio[p];
            u.step = steps[k % 2];
            double reduced = reduced_slip(&c, rest.inertia[p], u.step);
            double share = detailed_slip(&r, &u) / reduced;
            print_message("gear %2d, %3.0f N.m: detailed / reduced %.2f\n", u.gear,
                          u.step, share);
            assert_true(share > 1.0 / 3.0 && share < 3.0);
            mean += log(share);
            n++;
        }
    }
    print_message("geometric mean %.2f\n", exp(mean / n));
    assert_true(fabs(mean / n) < log(1.5));
    gm_builtin_destroy(r.plant);
    gm_gearset_destroy(r.gearset);
    gm_description_destroy(r.d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rings_down_like_the_detailed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
