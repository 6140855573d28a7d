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
    gm_mesh mesh = {.loss = GM_MESH_TEMPERATURE_DEPENDENT,
                    .minimum_line_load = minimum_line_load};
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

static double friction_of_force(const void *data, double F)
{
    const mesh_point *p = data;
    return gm_mesh_law_force(&p->law, F, p->v).value;
}

static double friction_of_speed(const void *data, double v)
{
    const mesh_point *p = data;
    return gm_mesh_law_force(&p->law, p->F, v).value;
}

static gm_mesh_law law_by_iso14179_1(const gm_pair *pair, double nu, double eta)
{
    gm_mesh mesh = {.loss = GM_MESH_TEMPERATURE_DEPENDENT, .method = GM_MESH_ISO14179_1};
    gm_oil oil = {.nu = nu, .eta = eta, .mesh_lubricant_factor = 1.};
    return gm_mesh_law_make(&mesh, pair, 0.5e-6, &oil);
}

/* f_m of nu 100 mm2/s, K 5 N/mm2, 10 m/s by hand: 100^-0.223 = 0.358096,
 * 5^-0.4 = 0.525306, 10^-0.7 = 0.199526. M of the C14 pair by hand: H_s = 2.5 x
 * (sqrt(1.079630^2 - 0.924281^2) - 0.381697), H_t = 5/3 (sqrt(1.128898^2 - ...) - ...).
 */
static void iso14179_1_by_hand(void **state)
{
    (void)state;
    check_close("f_m", gm_iso14179_1_f_m(100., 5., 10.),
                0.358096 * 0.525306 * 0.199526 / 3.239, 1e-5);
    gm_pair pair = fzg_c14();
    double c = 0.924281, s = 0.381697;
    double H_s = 2.5 * (sqrt(1.079630 * 1.079630 - c * c) - s);
    double H_t = 5. / 3. * (sqrt(1.128898 * 1.128898 - c * c) - s);
    double M = 2. * c * (H_s + H_t) / (H_s * H_s + H_t * H_t);
    check_close("M", gm_pair_advantage(&pair), M, 1e-4);
    /* K of 200 N.m: 1000 T (z1 + z2) / (2 b r_w1^2 z2) */
    gm_mesh_law law = law_by_iso14179_1(&pair, 30e-6, 0.026);
    double K = 1000. * 200. * 40. / (2. * 14. * 36.60005 * 36.60005 * 24.);
    double F_bt = 400. / pair.d_b[0];
    check_close("K", law.K_per_force * F_bt, K, 1e-5);
    double share = gm_iso14179_1_f_m(30., K, 5.749119) / M;
    check_close("kappa", gm_mesh_loss_share(&law, F_bt, 5.749119).kappa, share, 1e-4);
}

/* The two parts of the standard describe the same gears: alike in the middle of the first
 * part's range; at its corners K^-0.6 and v^-0.5 apart. Outside of it the second counts,
 * exactly. */
static void iso14179_1_stays_within_its_range(void **state)
{
    (void)state;
    gm_pair pair = fzg_c14();
    gm_mesh_law one = law_by_iso14179_1(&pair, 30e-6, 0.026), two = one;
    two.share_1 = 0.;
    double per_K = 1. / one.K_per_force;
    for (double K = 1.4; K <= 14.; K *= 1.2)
        for (double v = 2.; v <= 25.; v *= 1.2) {
            double a = gm_mesh_loss_share(&one, K * per_K, v).kappa;
            double b = gm_mesh_loss_share(&two, K * per_K, v).kappa;
            assert_true(a > 0.1 * b && a < 6. * b);
        }
    double a = gm_mesh_loss_share(&one, 4.4 * per_K, 7.).kappa;
    check_close("middle", a, gm_mesh_loss_share(&two, 4.4 * per_K, 7.).kappa, 0.5);
    const double outside[][2] = {{0.69, 10.}, {28.1, 10.}, {5., 0.99}, {5., 50.1}};
    for (int i = 0; i < 4; i++) {
        double F = outside[i][0] * per_K, v = outside[i][1];
        assert_true(gm_mesh_loss_share(&one, F, v).kappa ==
                    gm_mesh_loss_share(&two, F, v).kappa);
    }
    /* at rest and without load nothing is divided by zero */
    gm_mesh_force none = gm_mesh_law_force(&one, 0., 0.);
    assert_true(none.value == 0. && isfinite(none.d_force) && none.d_speed == 0.);
}

/* Ring 60 and pinion 20, m 2 mm, 20 degrees: H_s = (u - 1)(sin - sqrt(...)) of the
 * internal pair with u = 3 and tips at 58 and 22 mm. */
static void iso14179_1_of_a_ring(void **state)
{
    (void)state;
    const int z[2] = {20, -60};
    const double x[2] = {0., 0.};
    gm_pair pair = gm_pair_make(z, 2e-3, 20. * degree, 0., x, 20e-3, 0.);
    double c = cos(20. * degree), s = sin(20. * degree);
    double H_s = 2. * (s - sqrt(58. * 58. / 3600. - c * c));
    double H_t = 2. / 3. * (sqrt(22. * 22. / 400. - c * c) - s);
    check_close("M", gm_pair_advantage(&pair),
                2. * c * (H_s + H_t) / (H_s * H_s + H_t * H_t), 1e-12);
}

/* Modelica LossyGear, i = 2: driven by a with eta 0.97 and 0.5 N.m at a, 10 N.m give
 * 18.4; driven by b with eta 0.96 and 0.6 N.m, 10 N.m at a need 22.03333 at b. There the
 * friction torque is at the side of the loss's output: 0.6 * 0.96 referred to what
 * enters. */
static double torque_that_leaves(const gm_pair *pair, double T_0, double share,
                                 double T_enters)
{
    gm_mesh mesh = {
        .loss = GM_MESH_TORQUE_DEPENDENT, .idle_torque = T_0, .torque_share = share};
    gm_oil oil = {0};
    gm_mesh_law law = gm_mesh_law_make(&mesh, pair, 0.5e-6, &oil);
    double r_b = 0.5 * pair->d_b[0], F = T_enters / r_b;
    for (int i = 0; i < 60; i++) /* F + f(F)/2 = T / r_b */
        F = T_enters / r_b - 0.5 * gm_mesh_law_force(&law, F, 3.).value;
    return (F - 0.5 * gm_mesh_law_force(&law, F, 3.).value) * r_b;
}

static void torque_dependent_model_is_a_lossy_gear(void **state)
{
    (void)state;
    gm_pair pair = fzg_c14();
    check_close("driving", 2. * torque_that_leaves(&pair, 0.5, 0.03, 10.), 18.4, 1e-12);
    double T_b = 22.03333;
    check_close("driven", torque_that_leaves(&pair, 0.6 * 0.96, 0.04, 0.5 * T_b), 10.,
                1e-6);
    /* without load the idle torque remains */
    gm_mesh mesh = {
        .loss = GM_MESH_TORQUE_DEPENDENT, .idle_torque = 0.5, .torque_share = 0.};
    gm_oil oil = {0};
    gm_mesh_law law = gm_mesh_law_make(&mesh, &pair, 0.5e-6, &oil);
    check_close("idle", gm_mesh_law_force(&law, 0., 3.).value * 0.5 * pair.d_b[0], 0.5,
                1e-12);
}

static mesh_point random_mesh(uint64_t *seed)
{
    gm_pair pair = fzg_c14();
    double least = random_unit(seed) < 0.5 ? 0. : 150e3;
    double eta = random_scale(seed, 3e-3, 1.);
    double Ra = random_between(seed, 0.1e-6, 2e-6);
    mesh_point p = {.law = law_of(&pair, eta, Ra, random_between(seed, 0.5, 1.), least)};
    if (random_unit(seed) < 0.5)
        p.law = law_by_iso14179_1(&pair, eta / 850., eta);
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
        assert_true(share.kappa > 0. && share.kappa < 0.1);
        if (p.law.share_1 == 0.) {
            assert_true(share.kappa <= 0.12 * p.law.H_V);
            assert_true(share.d_force >= 0. && share.d_speed <= 0.);
        }
        gm_mesh_force f = gm_mesh_law_force(&p.law, p.F, p.v);
        check_slope("f(F)", friction_of_force, &p, p.F, f.d_force);
        check_slope("f(v)", friction_of_speed, &p, p.v, f.d_speed);
        assert_true(f.d_force > 0.); /* more load, more friction */
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
        cmocka_unit_test(iso14179_1_by_hand),
        cmocka_unit_test(iso14179_1_stays_within_its_range),
        cmocka_unit_test(iso14179_1_of_a_ring),
        cmocka_unit_test(torque_dependent_model_is_a_lossy_gear),
        cmocka_unit_test(derivatives_are_exact),
        cmocka_unit_test(share_has_no_jumps_and_starts_at_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
