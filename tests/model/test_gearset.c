/* SPDX-License-Identifier: BSD-2-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/alloc.h"
#include "model/bearing.h"
#include "model/drag.h"
#include "model/mesh.h"
#include "reducer_fixture.h"

#include <math.h>
#include <string.h>

#define N_MAX 8

static void near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance * fabs(expected)))
        fail_msg("%.12g instead of %.12g", value, expected);
}

/* Solve by passes until nothing changes (this small gearset contracts by 1e-2 a pass). */
static void solve(gm_balance *balance, const gm_steady_point *point, double *x)
{
    assert_int_equal(gm_balance_set_point(balance, point, NULL), GM_OK);
    memset(x, 0, N_MAX * sizeof *x);
    for (int i = 0; i < 40; i++)
        (void)gm_balance_pass(balance, x);
    double f[N_MAX];
    gm_balance_residual(balance, x, f);
    for (int i = 0; i < gm_balance_size(balance); i++)
        assert_true(fabs(f[i]) < 1e-10);
}

static gm_steady_point in_gear(double w_o, double direction, double torque)
{
    return (gm_steady_point){
        .gear = {1}, .speed = {w_o}, .direction = {direction}, .torque = {0.0, torque}};
}

static gm_element_loss loss_of(gm_balance *balance, const gm_gearset *g, const double *x,
                               const char *name)
{
    gm_element_loss losses[16];
    assert_true(gm_gearset_element_count(g) <= 16);
    gm_balance_losses(balance, x, losses);
    for (int i = 0; i < gm_gearset_element_count(g); i++)
        if (strcmp(losses[i].name, name) == 0)
            return losses[i];
    fail_msg("no element %s", name);
    return losses[0];
}

/* 100 N.m on the pinion: |A| = 1963.278 N, |B| = 1399.479 N and F_a = 1785.714 N, the
 * same numbers as by hand from F_t = 2 T/d_w (test_statics has the beam equations). The
 * two torque directions exchange the sign of the tilting moment F_a r, and one of them is
 * the published case; seven printed digits. */
static void bearing_loads_follow_from_the_torque(void **state)
{
    (void)state;
    reducer r;
    reducer_make(&r);
    gm_gearset *g;
    gm_balance *b;
    assert_int_equal(gm_gearset_create(&r.d, 353.15, &g, NULL), GM_OK);
    assert_int_equal(gm_balance_create(g, &b, NULL), GM_OK);
    int found = 0;
    for (int k = -1; k <= 1; k += 2) {
        double x[N_MAX];
        gm_steady_point point = in_gear(100.0, 1.0, 100.0 * k);
        solve(b, &point, x);
        gm_element_loss A = loss_of(b, g, x, "input_a"), B = loss_of(b, g, x, "input_b");
        near(A.axial, 1785.714, 1e-6);
        assert_true(B.axial < 1e-6);
        found += fabs(A.radial - 1963.278) < 2e-3 && fabs(B.radial - 1399.479) < 2e-3;
    }
    assert_int_equal(found, 1);
    gm_balance_destroy(b);
    gm_gearset_destroy(g);
}

/* Right-hand driving pinion, positive torque on it: the wheel resists, the force on the
 * pinion is F_t < 0 along t and the axial force -h F_t tan(beta) points to +x. */
static void hand_of_the_helix_gives_the_axial_direction(void **state)
{
    (void)state;
    reducer r;
    reducer_make(&r);
    r.bearings[0].axial_stiffness = 1e8;
    r.bearings[1].locating = 1; /* both locating: the axial force is shared and equal */
    for (int hand = -1; hand <= 1; hand += 2) {
        gm_gearset *g;
        gm_balance *b;
        double x[N_MAX];
        r.wheels[0].helix = hand * fabs(r.wheels[0].helix);
        r.wheels[1].helix = -r.wheels[0].helix;
        assert_int_equal(gm_gearset_create(&r.d, 353.15, &g, NULL), GM_OK);
        assert_int_equal(gm_balance_create(g, &b, NULL), GM_OK);
        gm_steady_point point = in_gear(100.0, 1.0, 100.0);
        solve(b, &point, x);
        near(loss_of(b, g, x, "input_a").axial, 1785.714 / 2.0, 1e-6);
        near(loss_of(b, g, x, "output_a").axial, 1785.714, 1e-6);
        gm_balance_destroy(b);
        gm_gearset_destroy(g);
    }
}

static void constant_efficiency_is_exact_both_ways(void **state)
{
    (void)state;
    reducer r;
    reducer_make(&r);
    r.meshes[0].efficiency = 0.97;
    gm_gearset *g;
    gm_balance *b;
    double x[N_MAX];
    gm_steady_result result;
    assert_int_equal(gm_gearset_create(&r.d, 353.15, &g, NULL), GM_OK);
    assert_int_equal(gm_balance_create(g, &b, NULL), GM_OK);
    for (int k = -1; k <= 1; k += 2) {
        gm_steady_point point = in_gear(50.0, 1.0, 80.0 * k);
        solve(b, &point, x);
        gm_balance_result(b, x, &result);
        double P_in = result.torque[1] * result.speed[1];
        double P_out = result.torque[0] * result.speed[0];
        double eta = P_in > 0.0 ? -P_out / P_in : -P_in / P_out;
        near(eta, 0.97, 1e-12);
    }
    gm_balance_destroy(b);
    gm_gearset_destroy(g);
}

static void ratio_and_inertia_come_from_the_parts(void **state)
{
    (void)state;
    reducer r;
    reducer_make(&r);
    gm_gearset *g;
    gm_kinematics k;
    const int gear[2] = {1, 0};
    assert_int_equal(gm_gearset_create(&r.d, 353.15, &g, NULL), GM_OK);
    assert_int_equal(gm_gearset_kinematics(g, gear, &k, NULL), GM_OK);
    near(k.ratio[0], -49.0 / 32.0, 1e-12);
    near(k.inertia_output, 2e-3, 1e-12);
    /* pinion shaft 1.1e-3, idling wheel 1e-3 at 32/49 of its speed */
    near(k.inertia[0], 1.1e-3 + 1e-3 * pow(32.0 / 49.0, 2), 1e-12);
    near(gm_gearset_sync_torque(g, 0), 32.0, 1e-12); /* 49 N.m at the cone */
    gm_gearset_destroy(g);
}

static void add_every_friction(reducer *r)
{
    static gm_seal seal = {.id = {"seal", 1},
                           .shaft = 0,
                           .on = GM_HOUSING,
                           .diameter = 0.03,
                           .model = GM_SEAL_ISO14179_2};
    r->meshes[0].loss = GM_MESH_TEMPERATURE_DEPENDENT;
    r->meshes[0].minimum_line_load = 150e3;
    for (int i = 0; i < 4; i++)
        r->bearings[i].data.friction = i % 2 ? GM_FRICTION_PALMGREN : GM_FRICTION_SKF;
    r->wheels[1].bearing.friction = GM_FRICTION_PALMGREN;
    r->wheels[1].mass = 0.8;
    r->shafts[0].mass = 1.5;
    r->shafts[1].mass = 2.0;
    r->d.n_seals = 1;
    r->d.seals = &seal;
    r->wheels[1].churning = 1;
    r->d.oil.level = -0.03;
    r->d.oil.volume = 1e-3;
    r->synchroniser.cone_radius = 0.03;
    r->synchroniser.cone_width = 0.008;
    r->synchroniser.cone_clearance = 0.15e-3;
}

/* Power into the flanges = sum of the losses of the elements, at any point. */
static void power_balances_at_every_point(void **state)
{
    (void)state;
    reducer r;
    reducer_make(&r);
    add_every_friction(&r);
    gm_gearset *g;
    gm_balance *b;
    assert_int_equal(gm_gearset_create(&r.d, 353.15, &g, NULL), GM_OK);
    assert_int_equal(gm_balance_create(g, &b, NULL), GM_OK);
    for (int i = 0; i < 200; i++) {
        double x[N_MAX], sum = 0.0;
        int neutral = i % 3 == 0;
        gm_steady_point point = in_gear(i * 1.7 - 170.0, 1.0, 150.0 * sin(i));
        point.gear[0] = !neutral;
        point.speed[1] = 300.0 * cos(i);
        point.direction[1] = -1.0;
        gm_steady_result result;
        gm_element_loss losses[16];
        solve(b, &point, x);
        gm_balance_result(b, x, &result);
        gm_balance_losses(b, x, losses);
        for (int e = 0; e < gm_gearset_element_count(g); e++) {
            assert_true(losses[e].power >= 0.0);
            sum += losses[e].power;
        }
        double in =
            result.torque[0] * result.speed[0] + result.torque[1] * result.speed[1];
        double throughput = fabs(result.torque[0] * result.speed[0]) + sum;
        assert_true(fabs(in - sum) <= 1e-9 * throughput + 1e-12);
    }
    gm_balance_destroy(b);
    gm_gearset_destroy(g);
}

/* Friction at standstill is the limit of friction in slow motion, on either side. */
static void standstill_is_the_one_sided_limit(void **state)
{
    (void)state;
    reducer r;
    reducer_make(&r);
    add_every_friction(&r);
    gm_gearset *g;
    gm_balance *b;
    assert_int_equal(gm_gearset_create(&r.d, 353.15, &g, NULL), GM_OK);
    assert_int_equal(gm_balance_create(g, &b, NULL), GM_OK);
    for (int k = -1; k <= 1; k += 2) {
        double x[N_MAX];
        gm_steady_result at_rest, slow;
        gm_steady_point point = in_gear(0.0, k, 90.0);
        solve(b, &point, x);
        gm_balance_result(b, x, &at_rest);
        point.speed[0] = k * 1e-9;
        solve(b, &point, x);
        gm_balance_result(b, x, &slow);
        /* (nu n)^0.6 of the rolling friction at 1e-9 rad/s is 1e-5 of its usual size */
        assert_true(fabs(at_rest.torque[0] - slow.torque[0]) < 1e-5);
        /* torque balance without friction, and what holding or moving adds to it */
        double ideal = 90.0 * 49.0 / 32.0;
        assert_true(k * (at_rest.torque[0] - ideal) > 0.1);
    }
    gm_balance_destroy(b);
    gm_gearset_destroy(g);
}

static void jacobian_equals_differences(void **state)
{
    (void)state;
    reducer r;
    reducer_make(&r);
    add_every_friction(&r);
    gm_gearset *g;
    gm_balance *b;
    assert_int_equal(gm_gearset_create(&r.d, 353.15, &g, NULL), GM_OK);
    assert_int_equal(gm_balance_create(g, &b, NULL), GM_OK);
    for (int i = 0; i < 50; i++) {
        double x[N_MAX], dense[N_MAX][N_MAX] = {{0.0}}, value[N_MAX * N_MAX];
        int start[N_MAX + 1], row[N_MAX * N_MAX];
        gm_steady_point point = in_gear(10.0 + 3.0 * i, 1.0, 100.0 * cos(i));
        solve(b, &point, x);
        int n = gm_balance_size(b);
        gm_balance_pattern(b, start, row);
        gm_balance_jacobian(b, x, value);
        assert_int_equal(start[n], gm_balance_entries(b));
        for (int c = 0; c < n; c++)
            for (int e = start[c]; e < start[c + 1]; e++)
                dense[row[e]][c] = value[e];
        for (int c = 0; c < n; c++) {
            double up[N_MAX], down[N_MAX], keep = x[c], h = 1e-5 * fmax(1.0, fabs(keep));
            x[c] = keep + h;
            gm_balance_residual(b, x, up);
            x[c] = keep - h;
            gm_balance_residual(b, x, down);
            x[c] = keep;
            for (int k = 0; k < n; k++) /* torques of 1e2 over 1e-2: rounding 1e-11 */
                assert_true(fabs((up[k] - down[k]) / (2.0 * h) - dense[k][c]) < 1e-8);
        }
    }
    gm_balance_destroy(b);
    gm_gearset_destroy(g);
}

static void failing_memory_leaves_nothing_behind(void **state)
{
    (void)state;
    reducer r;
    reducer_make(&r);
    add_every_friction(&r);
    for (long k = 1; k < 200; k++) {
        gm_gearset *g = NULL;
        gm_balance *b = NULL;
        gm_alloc_fail_after(k);
        gm_status status = gm_gearset_create(&r.d, 353.15, &g, NULL);
        if (status == GM_OK)
            status = gm_balance_create(g, &b, NULL);
        gm_steady_point point = in_gear(1.0, 1.0, 1.0);
        if (status == GM_OK)
            status = gm_balance_set_point(b, &point, NULL);
        gm_alloc_fail_after(0);
        gm_balance_destroy(b);
        gm_gearset_destroy(g);
        if (status == GM_OK)
            return;
        assert_int_equal(status, GM_ERR_MEMORY);
    }
    fail_msg("never succeeded");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bearing_loads_follow_from_the_torque),
        cmocka_unit_test(hand_of_the_helix_gives_the_axial_direction),
        cmocka_unit_test(constant_efficiency_is_exact_both_ways),
        cmocka_unit_test(ratio_and_inertia_come_from_the_parts),
        cmocka_unit_test(power_balances_at_every_point),
        cmocka_unit_test(standstill_is_the_one_sided_limit),
        cmocka_unit_test(jacobian_equals_differences),
        cmocka_unit_test(failing_memory_leaves_nothing_behind),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
