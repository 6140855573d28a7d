/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Numbers of worked examples that no test of a single law holds. Where the others are:
 *
 *   FZG gear C14, geometry                          test_pair.c
 *   FZG gear C14, loss; third gear and final drive  test_mesh.c
 *   LossyGear, ISO/TR 14179-1 mesh                  test_mesh.c
 *   75W oil by ASTM D341 and by Vogel               test_oil.c
 *   6206 and 30206 by SKF, oil bath, seals          test_bearing_skf.c
 *   6206 by Palmgren                                test_bearing_palmgren.c
 *   Stribeck curve, plain bearing, table            test_bearing_sliding.c
 *   break-away deflection                           test_bristle.c
 *   shaft seals, gaps, plates, Changenet and Velex  test_drag.c
 *   ISO/TR 14179-1 and -2 in the bath, jets         test_drag_speed.c
 *   loads of a helical pinion on two bearings       test_statics.c, test_gearset.c
 *   contact law, mesh stiffness, its frequency      test_contact.c, test_stiffness.c
 *   planetary efficiency by Willis                  solve/test_planetary.c
 *   steel disc                                      test_inertia.c
 */
#include "bearing_cases.h"
#include "description_fixture.h"

#include "model/bearing_models.h"
#include "model/gearset.h"

#include <stdlib.h>

/* Loss factors of a seven-speed gearset, five digits printed: half of the last is 5e-6 of
 * 0.1. */
static void loss_factors_of_the_example(void **state)
{
    (void)state;
    static const struct {
        const char *mesh;
        double H_V;
    } table[] = {
        {"first", .15180},   {"second", .13316},        {"third", .10756},
        {"fourth", .09577},  {"fifth", .11214},         {"sixth", .10318},
        {"seventh", .11866}, {"final_drive_1", .15851}, {"final_drive_2", .12552}};
    gm_description *d = gm_test_read(EXAMPLE);
    gm_gearset *g = NULL;
    assert_int_equal(gm_gearset_create(d, 353.15, &g, NULL), GM_OK);
    int found = 0;
    for (int m = 0; m < d->n_meshes; m++)
        for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
            if (strcmp(d->meshes[m].id.name, table[i].mesh) == 0) {
                check_close(table[i].mesh, g->meshes[m].law.H_V, table[i].H_V, 6e-5);
                found++;
            }
    assert_int_equal(found, 9);
    gm_gearset_destroy(g);
    gm_description_destroy(d);
}

/* Final drive behind third gear: 153.125 N.m at 1306.122 rpm, 75W oil at 80 degC. */
static void final_drive(void **state)
{
    (void)state;
    const int z[2] = {16, 71};
    const double x[2] = {0., 0.}, degree = GM_PI / 180.;
    gm_pair pair = gm_pair_make(z, 2.25e-3, 20. * degree, 25. * degree, x, .030, 0.);
    gm_mesh mesh = {.loss = GM_MESH_TEMPERATURE_DEPENDENT};
    gm_oil oil = {.eta = 7.317801e-3, .mesh_lubricant_factor = 0.75};
    gm_mesh_law law = gm_mesh_law_make(&mesh, &pair, 0.5e-6, &oil);
    double F_bt = 2. * 153.125 / pair.d_b[0], v_t = 0.5 * pair.d_w[0] * 1306.122 * rpm;
    double share = gm_mesh_loss_share(&law, F_bt, v_t).kappa;
    check_close("mu", share / law.H_V, 0.0502768, PRINTED);
    check_close("share", share, 0.00796933, PRINTED);
}

/* mu of Schlenk goes with eta^-0.05: the 75W oil at 20 degC rubs less than at 80. */
static void cold_oil_lowers_mesh_friction(void **state)
{
    (void)state;
    gm_oil_part part = {.viscosity_40 = 30.8e-6,
                        .viscosity_100 = 5.9e-6,
                        .density_15 = 845.,
                        .thermal_expansion = 7e-4};
    gm_oil cold = gm_oil_at(&part, 293.15), hot = gm_oil_at(&part, 353.15);
    double ratio = gm_schlenk_mu(200., 5., 8., 1e3 * cold.eta, 0.5, 1.) /
                   gm_schlenk_mu(200., 5., 8., 1e3 * hot.eta, 0.5, 1.);
    check_close("20 against 80 degC", ratio, 0.898, 1e-3);
}

static gm_bearing_law law_of_6206(gm_bearing_friction_model friction)
{
    gm_bearing_data data = {.type = GM_BEARING_DEEP_GROOVE_BALL,
                            .friction = friction,
                            .designation = "6206",
                            .f0 = 2.,
                            .f1 = (double)NAN};
    return bearing_in_oil(data, 15., 0.05);
}

/* Loss power with SKF's rounded factor 1.05e-4 W per N.mm and rpm. */
static double skf_power(const gm_bearing_law *law, double F_r, double F_a, double n)
{
    bearing_point p = {*law, n * rpm, F_r, F_a};
    return 1.05e-4 * 1e3 * torque_at(&p).value * n;
}

static void power_by_skf(void **state)
{
    (void)state;
    gm_bearing_law ball = law_of_6206(GM_FRICTION_SKF);
    check_close("6206", skf_power(&ball, 2000., 0., 3000.), 13.97349, 1e-6);
    check_close("6206", skf_power(&ball, 2000., 500., 3000.), 24.31084, 1e-6);
    gm_bearing_data data = bearing_of(GM_BEARING_TAPERED_ROLLER, GM_FRICTION_SKF);
    gm_bearing_law tapered = bearing_in_oil(data, 15., 0.05);
    check_close("30206", skf_power(&tapered, 3000., 1500., 2000.), 47.0821, 1e-6);
    /* with 15 mm of oil and V_M 4.05e-4: 3.594961 N.mm more */
    ball.bath = gm_skf_bath_at(&ball, 15., 4.05e-4);
    bearing_point p = {ball, 3000. * rpm, 2000., 500.};
    check_close("in oil", 1e3 * torque_at(&p).value, 80.77224, 1e-6);
    gm_bearing_speed speed = gm_bearing_at_speed(&ball, p.w);
    check_close("drag", speed.drag, 3.594961, 1e-6);
}

/* M_0 24.62891, M_1 32.10162 N.mm at 3000 rpm and 2000 N. */
static void parts_by_palmgren(void **state)
{
    (void)state;
    gm_bearing_law law = law_of_6206(GM_FRICTION_PALMGREN);
    gm_bearing_speed speed = gm_bearing_at_speed(&law, 3000. * rpm);
    check_close("M_0", speed.rolling, 24.62891, 1e-6);
    double M = 1e3 * gm_bearing_friction(&law, &speed, 2000., 0.).value;
    check_close("M_1", M - speed.rolling, 32.10162, 1e-6);
}

/* C_m from the torque, with the printed immersed area 0.0101172 m2. */
static void churning_coefficients(void **state)
{
    (void)state;
    const gm_oil oil = {.nu = 30e-6, .rho = 850.};
    const gm_dip dip = {.R_p = 0.09, .b = 0.03, .h = 0.03, .V_0 = 1.7e-3};
    const double table[][2] = {{500., .0104671}, {1000., .00593082}, {2000., .00258154}};
    for (int i = 0; i < 3; i++) {
        double w = table[i][0] * rpm, R = dip.R_p;
        double C_m = gm_churning_torque(&dip, &oil, w).value /
                     (0.5 * oil.rho * w * w * R * R * R * 0.0101172);
        check_close("C_m", C_m, table[i][1], PRINTED);
    }
}

/* Ratios of the gears of the only path, as the teeth make them. */
static void check_ratios(const char *file, const double (*table)[2], int n)
{
    gm_description *d = gm_test_read(file);
    gm_gearset *g = NULL;
    assert_int_equal(gm_gearset_create(d, 353.15, &g, NULL), GM_OK);
    for (int i = 0; i < n; i++) {
        gm_kinematics k;
        const int gear[GM_MAX_INPUT_PATHS] = {(int)table[i][0]};
        assert_int_equal(gm_gearset_kinematics(g, gear, &k, NULL), GM_OK);
        check_close(file, k.ratio[0], table[i][1], 1e-7); /* seven decimals printed */
    }
    gm_gearset_destroy(g);
    gm_description_destroy(d);
}

/* Simpson set of 33 and 72 teeth, Ravigneaux set of 57, 21 and 27. */
static void ratios_of_automatics(void **state)
{
    (void)state;
    const double simpson[][2] = {
        {1, 2.4583333}, {2, 1.4583333}, {3, 1.}, {-1, -2.1818182}};
    const double ravigneaux[][2] = {
        {1, 2.7142857}, {2, 1.5510204}, {3, 1.}, {4, 0.6785714}, {-1, -2.1111111}};
    check_ratios(GM_SOURCE_DIR "/examples/at3_simpson.yaml", simpson, 4);
    check_ratios(GM_SOURCE_DIR "/examples/at4_ravigneaux.yaml", ravigneaux, 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(loss_factors_of_the_example),
        cmocka_unit_test(final_drive),
        cmocka_unit_test(cold_oil_lowers_mesh_friction),
        cmocka_unit_test(power_by_skf),
        cmocka_unit_test(parts_by_palmgren),
        cmocka_unit_test(churning_coefficients),
        cmocka_unit_test(ratios_of_automatics),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
