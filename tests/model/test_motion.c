/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The gearset in motion: accounts of energy, the steady limit, shifts, backlash.
 */
#include "motion_fixture.h"
#include "property.h"
#include "reducer_fixture.h"

#include "base/alloc.h"
#include "core/gm_reduced.h"
#include "model/motion.h"

#include <stdlib.h>
#include <string.h>

#define DCT7 MOTION_EXAMPLES "dct7.yaml"

/* ---- energy ---- */

/* Work of the flanges since the start = stored + lost, relative to what was turned over.
 * Runge-Kutta of fourth order at 0.5 us: 30 steps in a period of the fastest mode. */
static void check_account(moving *m, double stored, double turned, double tolerance)
{
    gm_motion_view view = moving_view(m);
    double left = m->work - m->lost - view.jump_loss - (view.stored_energy - stored);
    if (!(fabs(left) <= tolerance * turned))
        fail_msg("%.9g J left of %.9g J: work %.9g, lost %.9g, stored %.9g", left, turned,
                 m->work, m->lost, view.stored_energy - stored);
    assert_true(m->lost >= 0.);
}

static void torque_reversals_close_the_account(void **state)
{
    (void)state;
    moving m;
    const double speed[GM_MAX_FLANGES] = {30., 0., 0.};
    moving_read(&m, DCT7);
    m.input.gear[0] = 3;
    m.input.gear[1] = 4;
    moving_start(&m, speed);
    double stored = moving_view(&m).stored_energy;
    const double torque[4][3] = {
        {-400., 80., 0.}, {350., -60., 10.}, {-500., 0., 120.}, {0., 30., -30.}};
    for (int i = 0; i < 4; i++) {
        memcpy(m.input.torque, torque[i], sizeof torque[i]);
        moving_run(&m, 1.5e-3, 5e-7);
    }
    check_account(&m, stored, stored, 1e-9);
    moving_clear(&m);
}

/* ---- steady limit ---- */

/* Deflection at which a row at rest carries force F: the spring rises monotonically. */
static double deflection_of(const gm_contact_law *law, double F)
{
    double s = F < 0. ? -1. : 1.;
    double low = law->gap, high = law->gap + law->entry + 2. * fabs(F) / law->stiffness;
    for (int i = 0; i < 200; i++) {
        double middle = 0.5 * (low + high);
        if (gm_contact_force_at(law, middle, 0.).value < fabs(F))
            low = middle;
        else
            high = middle;
    }
    return s * high;
}

/* Of a gear that locks one idling gear. */
static int lock_of(const gm_motion *motion, const gm_path_part *path, int number)
{
    const gm_path_gear *gear = gm_path_gear_of(path, number);
    assert_non_null(gear);
    for (int i = 0; i < motion->n_locks; i++)
        if (motion->locks[i].what.index == gear->locks[0].index)
            return i;
    fail_msg("no lock of gear %d", number);
    return -1;
}

typedef struct steady {
    gm_balance *balance;
    double x[64];
} steady;

static void solve(steady *s, const gm_steady_point *point)
{
    assert_int_equal(gm_balance_set_point(s->balance, point, NULL), GM_OK);
    assert_true(gm_balance_size(s->balance) <= 64);
    memset(s->x, 0, sizeof s->x);
    double change = 1.;
    for (int i = 0; i < 300 && change > 1e-15; i++)
        change = gm_balance_pass(s->balance, s->x);
    assert_true(change < 1e-12);
}

/* The motion with speeds, torques and row forces of a steady point. */
static void take(moving *m, const steady *s, const gm_steady_result *result)
{
    const gm_motion *motion = m->motion;
    int n_meshes = m->gearset->n_meshes;
    moving_start(m, result->speed);
    memcpy(m->input.torque, result->torque, sizeof m->input.torque);
    for (int e = 0; e < n_meshes; e++)
        m->x[motion->n_nodes + e] = deflection_of(&motion->rows[e].law, s->x[e]);
    for (int p = 0, k = n_meshes; p < m->d->n_paths; p++)
        if (m->input.gear[p] != 0) {
            int row =
                motion->locks[lock_of(motion, &m->d->paths[p], m->input.gear[p])].row;
            m->x[motion->n_nodes + row] =
                deflection_of(&motion->rows[row].law, s->x[k++]);
        }
}

/* Steady power balance at 100 random points of all gears: with the forces of the steady
 * experiment nothing accelerates, and the motion's loss is the experiment's. Points
 * within the band of Coulomb friction (0.1 rad/s between two parts) would not agree; the
 * speeds here are above, the slowest relative ones are those of concentric parts. */
static void steady_points_are_its_limit(void **state)
{
    (void)state;
    moving m;
    steady s;
    uint64_t seed = 5;
    moving_read(&m, DCT7);
    assert_int_equal(gm_balance_create(m.gearset, &s.balance, NULL), GM_OK);
    double *dx = calloc((size_t)m.n, sizeof *dx), worst = 0., worst_loss = 0.;
    assert_non_null(dx);
    for (int i = 0; i < 100; i++) {
        int p = (int)(random_unit(&seed) * 2.), g = (int)(random_unit(&seed) * 4.);
        gm_steady_point point = {.direction = {1., 1., 1.}};
        point.gear[p] = m.d->paths[p].gears[g].number;
        point.speed[0] = random_between(&seed, 5., 100.);
        point.speed[2 - p] = random_between(&seed, -200., 200.);
        point.torque[1 + p] = random_between(&seed, -200., 200.);
        memcpy(m.input.gear, point.gear, sizeof point.gear);
        solve(&s, &point);
        gm_steady_result result;
        gm_balance_result(s.balance, s.x, &result);
        take(&m, &s, &result);
        assert_int_equal(gm_motion_rates(m.motion, &m.input, m.x, dx), 0);
        gm_motion_view view = moving_view(&m);
        double in = 0., through = 0.;
        for (int f = 0; f < 3; f++) {
            in += result.torque[f] * result.speed[f];
            through += 0.5 * fabs(result.torque[f] * result.speed[f]);
        }
        for (int b = 0; b < m.motion->n_nodes; b++)
            worst = fmax(worst, fabs(dx[b]) * m.motion->inertia[b] / 200.);
        worst_loss = fmax(worst_loss, fabs(view.loss_power - in) / in);
        assert_true(through > in && in > 0.);
    }
    print_message("largest torque left %.2e of 200 N.m, loss %.2e\n", worst, worst_loss);
    assert_true(worst < 1e-9); /* bisection and 1e-12 of the passes */
    assert_true(worst_loss < 1e-8);
    free(dx);
    gm_balance_destroy(s.balance);
    moving_clear(&m);
}

/* ---- shifts ---- */

static void reducer_moving(moving *m, reducer *r)
{
    reducer_make(r);
    r->meshes[0].flanks.backlash = 0.05e-3;
    moving_make(m, &r->d);
    m->input.gear[0] = 0;
}

/* Two bodies and a cone of 49 N.m: the difference of speed falls at 49/J_1 + 49/J_2, the
 * lock closes when it is gone, and the energy lost is 49 N.m times the angle slipped. */
static void cones_synchronise_then_dogs_hold(void **state)
{
    (void)state;
    moving m;
    reducer r;
    const double speed[GM_MAX_FLANGES] = {100., 0.};
    reducer_moving(&m, &r);
    moving_start(&m, speed);
    double stored = moving_view(&m).stored_energy, slip = 0.;
    assert_int_equal(moving_view(&m).state[0], GM_PATH_NEUTRAL);
    int changed = 0;
    m.input.gear[0] = 1;
    assert_int_equal(gm_motion_handle(m.motion, &m.input, m.x, &changed, NULL), GM_OK);
    assert_true(changed);
    assert_int_equal(moving_view(&m).state[0], GM_PATH_SYNCHRONISING);
    /* output 2e-3; input, pinion and wheel with the ratio 32/49: the cones turn the
       wheel, which takes the input along through the mesh */
    double J_w = 1e-3 + (1e-3 + 1e-4) * (49. / 32.) * (49. / 32.);
    double decay = 49. * (1. / 2e-3 + 1. / J_w), expected = 100. / decay;
    while (moving_view(&m).state[0] == GM_PATH_SYNCHRONISING && m.t < 10. * expected) {
        slip += fabs(moving_signal(&m, "lock.wheel.w")) * 1e-6;
        moving_run(&m, 1e-6, 1e-6);
    }
    assert_int_equal(moving_view(&m).state[0], GM_PATH_ENGAGED);
    /* the play of the mesh, 0.05 mm of 34 mm, comes first, then it rings */
    check_close("time to synchronise", m.t, expected, 0.02);
    /* half of the play is crossed while the wheel alone is accelerated */
    check_close("energy of the cones", m.lost, 49. * slip, 0.02);
    moving_run(&m, 5e-3, 1e-6);
    check_account(&m, stored, stored, 1e-6); /* a step runs past the closing */
    /* without load the dogs drift within their play */
    assert_true(fabs(moving_signal(&m, "lock.wheel.w")) < 1.);
    moving_clear(&m);
}

/* A command taken back before the speeds agree opens again, at no cost in energy. */
static void a_command_can_be_taken_back(void **state)
{
    (void)state;
    moving m;
    reducer r;
    const double speed[GM_MAX_FLANGES] = {100., 0.};
    int changed = 0;
    reducer_moving(&m, &r);
    moving_start(&m, speed);
    m.input.gear[0] = 1;
    assert_int_equal(gm_motion_handle(m.motion, &m.input, m.x, &changed, NULL), GM_OK);
    moving_run(&m, 1e-4, 1e-6);
    m.input.gear[0] = 0;
    assert_int_equal(gm_motion_handle(m.motion, &m.input, m.x, &changed, NULL), GM_OK);
    assert_true(changed);
    assert_int_equal(moving_view(&m).state[0], GM_PATH_NEUTRAL);
    assert_true(moving_view(&m).jump_loss == 0.);
    assert_int_equal(gm_motion_handle(m.motion, &m.input, m.x, &changed, NULL), GM_OK);
    assert_false(changed);
    moving_clear(&m);
}

/* Dogs pulled apart under load lose what they stored, and the account knows it. */
static void opening_under_load_is_accounted(void **state)
{
    (void)state;
    moving m;
    reducer r;
    const double speed[GM_MAX_FLANGES] = {100., 0.};
    int changed = 0;
    reducer_moving(&m, &r);
    m.input.gear[0] = 1;
    m.input.torque[1] = 150.;
    m.input.torque[0] = 150. * 49. / 32.;
    moving_start(&m, speed);
    double stored = moving_view(&m).stored_energy;
    moving_run(&m, 4e-3, 5e-7);
    double twist = m.x[m.motion->n_nodes + m.motion->locks[0].row];
    double energy = gm_contact_energy(&m.motion->rows[m.motion->locks[0].row].law, twist);
    assert_true(energy > 0.01);
    m.input.gear[0] = 0;
    assert_int_equal(gm_motion_handle(m.motion, &m.input, m.x, &changed, NULL), GM_OK);
    check_close("jump", moving_view(&m).jump_loss, energy, 1e-15);
    assert_true(moving_signal(&m, "lock.wheel.torque") == 0.);
    moving_run(&m, 1e-3, 5e-7);
    check_account(&m, stored, stored, 1e-8);
    moving_clear(&m);
}

static void what_is_no_gear_is_refused(void **state)
{
    (void)state;
    moving m;
    reducer r;
    const double speed[GM_MAX_FLANGES] = {0.};
    int changed = 7;
    reducer_moving(&m, &r);
    moving_start(&m, speed);
    m.input.gear[0] = 3;
    gm_error error = {GM_OK, ""};
    assert_int_equal(gm_motion_handle(m.motion, &m.input, m.x, &changed, &error),
                     GM_ERR_ARGUMENT);
    assert_string_equal(error.message, "reducer: path 'input' has no gear 3");
    assert_int_equal(changed, 7);
    assert_int_equal(gm_motion_start(m.motion, &m.input, speed, m.x, NULL),
                     GM_ERR_ARGUMENT);
    m.x[0] = (double)NAN;
    double dx[16];
    assert_int_equal(gm_motion_rates(m.motion, &m.input, m.x, dx), 1);
    moving_clear(&m);
}

/* ---- backlash ---- */

/* Output held by its inertia, torque turned round: the mesh leaves one flank, crosses
 * its play and rests on the other with the force that statics gives. */
static void torque_reversal_crosses_the_play(void **state)
{
    (void)state;
    moving m;
    reducer r;
    const double speed[GM_MAX_FLANGES] = {0.};
    reducer_make(&r);
    r.meshes[0].flanks.backlash = 0.05e-3;
    r.shafts[1].inertia = 1e3; /* a wall */
    moving_make(&m, &r.d);
    m.input.gear[0] = 1;
    moving_start(&m, speed);
    double r_b = m.gearset->meshes[0].row.g[0];
    double gap = 0.5 * 0.05e-3 / cos(m.gearset->meshes[0].pair.beta_b);
    for (int i = 0; i < 4; i++) {
        m.input.torque[1] = i % 2 ? -40. : 40.;
        moving_run(&m, 0.15, 2e-6);
        double x = moving_signal(&m, "mesh.stage.deflection");
        assert_true(fabs(x) > gap && fabs(x) < gap + 1e-5);
        assert_true(x * m.input.torque[1] > 0.);
        /* what is left of the ringing */
        check_close("force", moving_signal(&m, "mesh.stage.force"),
                    m.input.torque[1] / r_b, 1e-3);
    }
    moving_clear(&m);
}

/* ---- failure paths ---- */

static void without_memory_nothing_is_left_behind(void **state)
{
    (void)state;
    reducer r;
    reducer_make(&r);
    gm_gearset *g = NULL;
    assert_int_equal(gm_gearset_create(&r.d, 353.15, &g, NULL), GM_OK);
    gm_motion *motion = NULL;
    gm_status status = GM_ERR_MEMORY;
    int k = 0;
    while (status == GM_ERR_MEMORY) {
        assert_null(motion);
        gm_alloc_fail_after(++k);
        status = gm_motion_create(g, &motion, NULL);
        gm_alloc_fail_after(0);
    }
    assert_int_equal(status, GM_OK);
    assert_true(k > 20);
    gm_motion_destroy(motion);
    gm_motion_destroy(NULL);
    gm_gearset_destroy(g);
}

static void a_part_without_inertia_is_refused(void **state)
{
    (void)state;
    reducer r;
    reducer_make(&r);
    r.wheels[1].inertia = 0.;
    gm_gearset *g = NULL;
    gm_motion *motion = NULL;
    gm_error error = {GM_OK, ""};
    assert_int_equal(gm_gearset_create(&r.d, 353.15, &g, NULL), GM_OK);
    assert_int_equal(gm_motion_create(g, &motion, &error), GM_ERR_MODEL);
    assert_string_equal(
        error.message,
        "reducer:0: 'wheel' has no moment of inertia: it cannot move in time");
    assert_null(motion);
    gm_gearset_destroy(g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(torque_reversals_close_the_account),
        cmocka_unit_test(steady_points_are_its_limit),
        cmocka_unit_test(cones_synchronise_then_dogs_hold),
        cmocka_unit_test(a_command_can_be_taken_back),
        cmocka_unit_test(opening_under_load_is_accounted),
        cmocka_unit_test(what_is_no_gear_is_refused),
        cmocka_unit_test(torque_reversal_crosses_the_play),
        cmocka_unit_test(without_memory_nothing_is_left_behind),
        cmocka_unit_test(a_part_without_inertia_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
