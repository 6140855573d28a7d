/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The detailed gearset integrated by the transient solver: holding friction, accounts of
 * energy, shifts.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "plant/gm_builtin.h"
#include "reducer_fixture.h"
#include "solve/gm_driven.h"

#include <math.h>
#include <string.h>

/* ---- a schedule of steps ---- */

typedef struct row {
    double end; /* s: the row holds up to here */
    double torque[GM_MAX_FLANGES];
    int gear[GM_MAX_INPUT_PATHS];
} row;

typedef struct schedule {
    int n, present;
    const row *rows;
} schedule;

static double enter(void *user, double t, int *jump)
{
    schedule *s = user;
    s->present = 0;
    while (s->present < s->n - 1 && t >= s->rows[s->present].end)
        s->present++;
    *jump = 1;
    return s->rows[s->present].end > t ? s->rows[s->present].end : (double)INFINITY;
}

static void at(void *user, double t, gm_drive_point *point)
{
    const schedule *s = user;
    const row *r = &s->rows[s->present];
    (void)t;
    memset(point, 0, sizeof *point);
    memcpy(point->input.torque, r->torque, sizeof r->torque);
    memcpy(point->input.gear, r->gear, sizeof r->gear);
}

typedef struct rig {
    gm_gearset *gearset;
    gm_dynamics dynamics;
    schedule schedule;
    gm_driven *driven;
    gm_transient *transient;
    gm_error error;
} rig;

static void must(const rig *r, gm_status status)
{
    if (status != GM_OK)
        fail_msg("%s", r->error.message);
}

static void open_rig(rig *r, gm_description *d, int n, const row *rows, double tolerance,
                     double w_output)
{
    double speed[GM_MAX_FLANGES] = {w_output};
    gm_transient_options options = {.tolerance = tolerance};
    memset(r, 0, sizeof *r);
    r->schedule = (schedule){n, 0, rows};
    gm_drive drive = {.user = &r->schedule, .enter = enter, .at = at};
    must(r, gm_gearset_create(d, d->oil.temperature, &r->gearset, &r->error));
    r->dynamics = gm_builtin_dynamics(r->gearset);
    must(r, gm_driven_create(&r->dynamics, &drive, 0.0, speed, &r->driven, &r->error));
    gm_transient_system system = gm_driven_system(r->driven);
    must(r, gm_transient_create(&system, &options, &r->transient, &r->error));
    must(r, gm_transient_start(r->transient, 0.0, &r->error));
}

static void close_rig(rig *r)
{
    gm_transient_destroy(r->transient);
    gm_driven_destroy(r->driven);
    gm_gearset_destroy(r->gearset);
}

static gm_motion_view view_at(rig *r, double t)
{
    gm_motion_input input;
    gm_motion_view view;
    const double *x = gm_transient_state(r->transient);
    assert_int_equal(gm_driven_input(r->driven, t, x, &input), 0);
    r->dynamics.is->view(gm_driven_motion(r->driven), &input, x, &view);
    return view;
}

/* ---- holding ---- */

static void make_elastic(gm_bearing_data *data)
{
    data->friction = GM_FRICTION_ELASTIC;
    data->torque = 0.10;
    data->static_torque = 0.15;
    data->mu = data->static_mu = data->viscous = (double)NAN;
    data->stribeck = 0.05;
    data->stiffness = 200.0;
    data->damping = 1.0;
}

/* How far the input turns between 1 s and 11 s under a constant torque; the path of its
 * speed, sampled each millisecond, is an upper bound of the angle. */
static double creep(double torque, double tolerance)
{
    reducer r;
    rig g;
    const row rows[1] = {{(double)INFINITY, {0.0, torque}, {0}}};
    reducer_make(&r);
    make_elastic(&r.bearings[0].data);
    open_rig(&g, &r.d, 1, rows, tolerance, 0.0);
    double way = 0.0;
    for (int k = 1; k <= 11000; k++) {
        must(&g, gm_transient_advance(g.transient, 1e-3 * k, &g.error));
        if (k > 1000)
            way += 1e-3 * fabs(view_at(&g, 1e-3 * k).speed[1]);
    }
    close_rig(&g);
    return way;
}

/* Friction of 0.10 N.m sliding and 0.15 N.m at rest holds 0.05 N.m and 0.08 N.m without
 * creep; 0.16 N.m it does not hold. */
static void elastic_friction_holds_without_creep(void **state)
{
    (void)state;
    const double torque[3] = {0.05, -0.05, 0.08};
    for (int i = 0; i < 3; i++) {
        double way = creep(torque[i], 1e-4);
        print_message("%g N.m: %.3g rad in 10 s\n", torque[i], way);
        assert_true(way < 1e-6);
    }
    assert_true(creep(0.16, 1e-4) > 1.0);
}

/* ---- energy ---- */

/* Tip-in, tip-out, preselection, a shift with both paths, standstill and reversal of
 * rotation: what the flanges put in is stored, lost or given up, to 1e-5 of what passed
 * and was stored at a solver tolerance of 1e-7. */
static void shifts_and_reversals_close_the_account(void **state)
{
    (void)state;
    static const row rows[] = {
        {0.2, {-1600.0, 100.0, 0.0}, {1, 0}}, /* tip-in */
        {0.4, {600.0, -40.0, 0.0}, {1, 0}},   /* tip-out */
        {0.6, {-1400.0, 100.0, 0.0}, {1, 2}}, /* preselect */
        {0.8, {-900.0, 0.0, 100.0}, {0, 2}},  /* shift */
        {1.2, {-4000.0, 0.0, 0.0}, {0, 2}},   /* through standstill */
        {1.4, {200.0, 0.0, 20.0}, {0, 2}},
    };
    rig r;
    gm_description *d = NULL;
    gm_error error = {GM_OK, ""};
    if (gm_description_read(GM_SOURCE_DIR "/examples/dct7.yaml", &d, &error) != GM_OK)
        fail_msg("%s", error.message);
    open_rig(&r, d, 6, rows, 1e-7, 10.0);
    const double t[4] = {0.6, 0.8, 1.2, 1.4};
    for (int k = 0; k < 4; k++)
        must(&r, gm_transient_advance(r.transient, t[k], &r.error));
    gm_motion_view view = view_at(&r, 1.4);
    assert_int_equal(view.state[0], 0);
    assert_int_equal(view.state[1], 2);
    assert_true(view.speed[0] < 0.0);
    gm_transient_energy e = gm_transient_account(r.transient);
    gm_transient_statistics s = gm_transient_work(r.transient);
    print_message("%ld steps; passed %.6g J, lost %.6g J, jumps %.3g J, open %.3g J\n",
                  s.steps, e.through, e.dissipated, e.impulses, e.residual);
    assert_true(fabs(e.residual) <= 1e-5 * fmax(e.through, e.stored));
    assert_true(e.dissipated > 0.0 && e.impulses >= 0.0);
    close_rig(&r);
    gm_description_destroy(d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elastic_friction_holds_without_creep),
        cmocka_unit_test(shifts_and_reversals_close_the_account),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
