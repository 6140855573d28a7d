/* SPDX-License-Identifier: BSD-2-Clause */
#include "property.h"

#include "model/mesh.h"
#include "model/power.h"

static const double degree = GM_PI / 180.;
static const double rpm = GM_PI / 30.;

static gm_pair fzg_c14(void)
{
    const int z[2] = {16, 24};
    const double x[2] = {0.1817, 0.1715};
    return gm_pair_make(z, 4.5e-3, 20. * degree, 0., x, 14e-3, 0.);
}

static gm_mesh_law law_of(const gm_pair *pair, double eta, double Ra, double X_L,
                          double minimum_line_load)
{
    gm_mesh mesh = {.loss = GM_MESH_ISO14179_2, .minimum_line_load = minimum_line_load};
    gm_oil oil = {.eta = eta, .mesh_lubricant_factor = X_L};
    return gm_mesh_law_make(&mesh, pair, Ra, &oil);
}

/* Loss power of a mesh with torque T on gear 0 turning at n. */
static double loss_power(const gm_pair *pair, const gm_mesh_law *law, double T, double n)
{
    double F_bt = 2. * T / pair->d_b[0];
    double v_t = 0.5 * pair->d_w[0] * n * rpm;
    return T * n * rpm * gm_mesh_loss_share(law, F_bt, v_t).kappa;
}

/* FZG rig, gear C14, 200 N.m, 1500 rpm; F_bt, v, mu and H_V are printed in the rig's
 * report (Fernandes, Martins, Seabra). */
static void fzg_c14_loses_280_watts(void **state)
{
    (void)state;
    gm_pair pair = fzg_c14();
    double F_bt = 400. / pair.d_b[0], v_t = 0.5 * pair.d_w[0] * 1500. * rpm;
    check_close("F_bt", F_bt, 5912.099, 1e-6);
    check_close("v_t", v_t, 5.749119, 1e-6);
    double v_sigma = 2. * v_t * sin(pair.alpha_wt);
    check_close("v_SigmaC", v_sigma, 4.388857, 1e-6);
    double rho = 1e3 * gm_pair_curvature(&pair);
    double mu = gm_schlenk_mu(F_bt / 14., v_sigma, rho, 13.28, 0.355, 0.846);
    check_close("mu", mu, 0.044874, 2e-5);
    gm_mesh_law law = law_of(&pair, 13.28e-3, 0.355e-6, 0.846, 0.);
    gm_mesh_share share = gm_mesh_loss_share(&law, F_bt, v_t);
    check_close("kappa", share.kappa, mu * gm_pair_loss_factor(&pair), 1e-13);
    check_close("eta", 1. - share.kappa, 0.991087, 1e-6);
    check_close("P_VZP", loss_power(&pair, &law, 200., 1500.), 280.0034, 1e-6);
}

/* Third gear and final drive of a dual-clutch gearset with a 75W oil at 80 degC. */
static void third_gear_and_final_drive(void **state)
{
    (void)state;
    const double x[2] = {0., 0.};
    const int third[2] = {32, 49}, final[2] = {16, 71};
    gm_pair p =
        gm_pair_make(third, 1.75e-3, 20. * degree, 27.6329 * degree, x, .016, .08);
    gm_mesh_law law = law_of(&p, 7.317801e-3, 0.5e-6, 0.75, 0.);
    double F_bt = 200. / p.d_b[0], v_t = 0.5 * p.d_w[0] * 2000. * rpm;
    check_close("F_bt", F_bt, 3420.674, PRINTED);
    check_close("v_SigmaC", law.sliding_ratio * v_t, 5.030831, PRINTED);
    double share = gm_mesh_loss_share(&law, F_bt, v_t).kappa;
    check_close("mu", share / law.H_V, 0.0382028, PRINTED);
    check_close("share", share, 0.00410908, PRINTED);
    check_close("P", loss_power(&p, &law, 100., 2000.), 86.0603, PRINTED);
    p = gm_pair_make(final, 2.25e-3, 20. * degree, 25. * degree, x, .030, 0.);
    law = law_of(&p, 7.317801e-3, 0.5e-6, 0.75, 0.);
    check_close("P final", loss_power(&p, &law, 153.125, 1306.122), 166.909, PRINTED);
}

static void constant_model_loses_one_minus_eta(void **state)
{
    (void)state;
    gm_mesh mesh = {.loss = GM_MESH_CONSTANT, .efficiency = 0.985};
    gm_oil oil = {.eta = 0.01, .mesh_lubricant_factor = 1.};
    gm_pair pair = fzg_c14();
    gm_mesh_law law = gm_mesh_law_make(&mesh, &pair, 0.5e-6, &oil);
    gm_mesh_share share = gm_mesh_loss_share(&law, 1234., 5.);
    check_close("kappa", share.kappa, 0.015, 1e-13);
    assert_true(share.d_force == 0. && share.d_speed == 0.);
}

static void limits_hold(void **state)
{
    (void)state;
    gm_pair pair = fzg_c14();
    gm_mesh_law law = law_of(&pair, 13.28e-3, 0.355e-6, 0.846, 150e3);
    double least = 150e3 * 14e-3;
    assert_true(gm_mesh_loss_share(&law, 0., 5.).kappa ==
                gm_mesh_loss_share(&law, least, 5.).kappa);
    assert_true(gm_mesh_loss_share(&law, 0.5 * least, 5.).d_force == 0.);
    assert_true(gm_mesh_loss_share(&law, 3000., 50.).kappa ==
                gm_mesh_loss_share(&law, 3000., 80.).kappa);
    /* v_SigmaC = 0.2 m/s */
    assert_true(gm_mesh_loss_share(&law, 3000., 0.).kappa ==
                gm_mesh_loss_share(&law, 3000., 0.2 / law.sliding_ratio).kappa);
    /* 0.0449 (3.4 * 4.39 / 0.2)^0.2 = 0.107 and (20 * 4.39 / 0.2)^0.2 -> 0.15 > 0.12 */
    assert_true(gm_mesh_loss_share(&law, 20000., 0.).kappa < 0.107 * law.H_V);
    check_close("cap", gm_mesh_loss_share(&law, 2e5, 0.).kappa, 0.12 * law.H_V, 1e-13);
}

typedef struct mesh_point {
    gm_mesh_law law;
    double F, v;
} mesh_point;

static double share_of_force(const void *data, double F)
{
    const mesh_point *p = data;
    return gm_mesh_loss_share(&p->law, F, p->v).kappa;
}

static double share_of_speed(const void *data, double v)
{
    const mesh_point *p = data;
    return gm_mesh_loss_share(&p->law, p->F, v).kappa;
}

static mesh_point random_mesh(uint64_t *seed)
{
    gm_pair pair = fzg_c14();
    double least = random_unit(seed) < 0.5 ? 0. : 150e3;
    double eta = random_scale(seed, 3e-3, 1.);
    double Ra = random_between(seed, 0.1e-6, 2e-6);
    mesh_point p = {.law = law_of(&pair, eta, Ra, random_between(seed, 0.5, 1.), least)};
    p.F = random_scale(seed, 1e-3, 5e4);
    p.v = random_scale(seed, 1e-3, 80.);
    return p;
}

static void derivatives_are_exact(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (int i = 0; i < 3000; i++) {
        mesh_point p = random_mesh(&seed);
        gm_mesh_share share = gm_mesh_loss_share(&p.law, p.F, p.v);
        assert_true(share.kappa > 0. && share.kappa <= 0.12 * p.law.H_V);
        assert_true(share.d_force >= 0. && share.d_speed <= 0.);
        check_slope("kappa(F)", share_of_force, &p, p.F, share.d_force);
        check_slope("kappa(v)", share_of_speed, &p, p.v, share.d_speed);
    }
}

static void share_has_no_jumps_and_starts_at_zero(void **state)
{
    (void)state;
    uint64_t seed = 4;
    for (int i = 0; i < 10; i++) {
        mesh_point p = random_mesh(&seed);
        check_continuous("kappa(F)", share_of_force, &p, 1e-6, 1e6);
        check_continuous("kappa(v)", share_of_speed, &p, 1e-6, 200.);
        p.law.minimum_force = 0.;
        gm_mesh_share none = gm_mesh_loss_share(&p.law, 0., p.v);
        assert_true(none.kappa == 0. && isfinite(none.d_force) && none.d_force > 0.);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fzg_c14_loses_280_watts),
        cmocka_unit_test(third_gear_and_final_drive),
        cmocka_unit_test(constant_model_loses_one_minus_eta),
        cmocka_unit_test(limits_hold),
        cmocka_unit_test(derivatives_are_exact),
        cmocka_unit_test(share_has_no_jumps_and_starts_at_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
