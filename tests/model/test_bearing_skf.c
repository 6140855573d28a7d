/* SPDX-License-Identifier: BSD-2-Clause */
#include "bearing_cases.h"

#include "model/bearing_models.h"

/* Every intermediate value of a point, in the model's units. */
typedef struct skf_case {
    double F_r, F_a, n;
    double G_rr, G_sl, phi_ish, phi_rs, phi_bl, mu_sl, M_rr, M_sl, M;
} skf_case;

static void check_case(const gm_bearing_law *law, const skf_case *c)
{
    gm_skf_phi phi = gm_skf_factors(law, c->n);
    gm_bearing_speed speed = gm_bearing_at_speed(law, c->n * rpm);
    gm_skf_loads g = gm_skf_at_loads(law, &speed, c->F_r, c->F_a);
    check_close("phi_ish", phi.ish, c->phi_ish, 1e-6);
    check_close("phi_rs", phi.rs, c->phi_rs, 1e-6);
    check_close("phi_bl", phi.bl, c->phi_bl, 1e-6);
    check_close("mu_sl", speed.sliding, c->mu_sl, 1e-6);
    check_close("G_rr", g.G_rr, c->G_rr, 1e-6);
    check_close("G_sl", g.G_sl, c->G_sl, 1e-6);
    check_close("M_rr", speed.rolling * g.G_rr, c->M_rr, 1e-6);
    check_close("M_sl", speed.sliding * g.G_sl, c->M_sl, 1e-6);
    double M = gm_bearing_friction(law, &speed, c->F_r, c->F_a).value;
    check_close("M", 1e3 * M, c->M, 1e-6);
}

/* The formulas of the catalogue, evaluated once independently with seven digits. */
static void ball_bearing_6206(void **state)
{
    (void)state;
    gm_bearing_data data = {.type = GM_BEARING_DEEP_GROOVE_BALL,
                            .friction = GM_FRICTION_SKF,
                            .designation = "6206"};
    gm_bearing_law law = bearing_in_oil(data, 15., 0.05);
    skf_case radial = {.F_r = 2000.,
                       .n = 3000.,
                       .G_rr = 0.04291668,
                       .G_sl = 378.9677,
                       .phi_ish = 0.962004,
                       .phi_rs = 0.9730356,
                       .phi_bl = 0.02003113,
                       .mu_sl = 0.05140218,
                       .M_rr = 24.88051,
                       .M_sl = 19.47976,
                       .M = 44.36027};
    check_case(&law, &radial);
    skf_case both = radial;
    both.F_a = 500.;
    both.G_rr = 0.07908889, both.G_sl = 609.4352;
    both.M_rr = 45.85098, both.M_sl = 31.3263, both.M = 77.17728;
    check_case(&law, &both);
}

/* 6206 with 15 mm of oil above the lowest contact and V_M 4.05e-4 at 3000 rpm, 15 mm2/s:
 * 2.676370 + 0.9185907 N.mm. */
static void drag_in_the_oil_bath(void **state)
{
    (void)state;
    gm_bearing_data data = {.type = GM_BEARING_DEEP_GROOVE_BALL,
                            .friction = GM_FRICTION_SKF,
                            .designation = "6206"};
    gm_bearing_law law = bearing_in_oil(data, 15., 0.05);
    gm_skf_bath bath = gm_skf_bath_at(&law, 15., 4.05e-4);
    check_close("flow", bath.flow * 3000. * 3000., 2.676370, 1e-6);
    check_close("viscous", bath.viscous * pow(3000., 0.621), 0.9185907, 1e-6);
    check_close("V_M", gm_skf_drag_variable(&data, 0.3), 3.814e-4, 1e-12);
    check_close("V_M", gm_skf_drag_variable(&data, 9.9), 1.238e-3, 1e-12);
    data.type = GM_BEARING_TAPERED_ROLLER;
    check_close("V_M", gm_skf_drag_variable(&data, 0.45), 6.2625e-4, 1e-12);
}

/* The oil adds a torque that does not depend on load and grows with level and speed. */
static void immersion_adds_drag(void **state)
{
    (void)state;
    static const gm_bearing_type types[] = {GM_BEARING_DEEP_GROOVE_BALL,
                                            GM_BEARING_CYLINDRICAL_ROLLER};
    for (int k = 0; k < 2; k++) {
        gm_bearing_data data = {.type = types[k],
                                .friction = GM_FRICTION_SKF,
                                .series = "2",
                                .d = 0.030,
                                .D = 0.062,
                                .B = 0.016,
                                .C0 = 11200.};
        gm_bearing_law dry = bearing_in_oil(data, 15., 0.05), wet = dry;
        gm_bearing_immerse(&wet, 0.0);
        assert_true(wet.bath.flow == 0. && wet.bath.viscous == 0.);
        gm_bearing_immerse(&wet, (double)NAN);
        assert_true(wet.bath.flow == 0.);
        double below = 0.;
        for (double H = 0.005; H < 0.08; H += 0.005) {
            gm_bearing_immerse(&wet, H);
            gm_bearing_speed at = gm_bearing_at_speed(&wet, 314.),
                             up = gm_bearing_at_speed(&wet, 314. * (1. + 1e-6)),
                             at_dry = gm_bearing_at_speed(&dry, 314.);
            gm_bearing_torque M = gm_bearing_friction(&wet, &at, 500., 0.);
            double more = M.value - gm_bearing_friction(&dry, &at_dry, 500., 0.).value;
            assert_true(more > 0. && more >= below);
            below = more;
            double slope = (gm_bearing_friction(&wet, &up, 500., 0.).value - M.value) /
                           (314. * 1e-6);
            check_close("slope", M.d_speed, slope, 1e-4);
        }
        gm_bearing_speed rest = gm_bearing_at_speed(&wet, 0.);
        assert_true(rest.drag == 0.);
    }
}

/* Seals at d_s = 40 mm: 40^2.25 = 4023.87 (40^2 = 1600, 40^0.25 = 2.514867). */
static void seals_of_capped_bearings(void **state)
{
    (void)state;
    const double lip = 1600. * 2.514867;
    check_close("rs1", gm_skf_seals(GM_CAP_RS1, 62., 40.), 0.023 * lip + 2., 1e-6);
    check_close("rs1 80", gm_skf_seals(GM_CAP_RS1, 80., 40.), 0.018 * lip + 20., 1e-6);
    check_close("rs1 90", gm_skf_seals(GM_CAP_RS1, 90., 40.), 0.018 * lip + 15., 1e-6);
    check_close("rs1 140", gm_skf_seals(GM_CAP_RS1, 140., 40.), 0.018 * lip, 1e-6);
    check_close("rsh", gm_skf_seals(GM_CAP_RSH, 52., 40.), 0.028 * lip + 2., 1e-6);
    check_close("rsl", gm_skf_seals(GM_CAP_RSL, 52., 40.), 0.0018 * lip, 1e-6);
    assert_true(gm_skf_seals(GM_CAP_RSL, 25., 20.) == 0.);
    assert_true(gm_skf_seals(GM_CAP_NONE, 62., 40.) == 0.);
    assert_true(isnan(gm_skf_seals(GM_CAP_RSL, 53., 40.)));
    gm_bearing_data data = {.type = GM_BEARING_DEEP_GROOVE_BALL,
                            .friction = GM_FRICTION_SKF,
                            .designation = "6206",
                            .cap = GM_CAP_RS1,
                            .cap_diameter = 40e-3};
    bearing_point capped = {bearing_in_oil(data, 15., 0.05), 100., 800., 100.};
    bearing_point open = capped;
    data.cap = GM_CAP_NONE;
    open.law = bearing_in_oil(data, 15., 0.05);
    gm_bearing_torque M = torque_at(&capped), M_open = torque_at(&open);
    check_close("M", M.value - M_open.value, 1e-3 * (0.023 * lip + 2.), 1e-6);
    assert_true(M.d_speed == M_open.d_speed && M.d_radial == M_open.d_radial);
}

/* K_rs = 6e-8 squares phi_rs of an oil bath; flooded there is none. */
static void starvation_depends_on_the_supply(void **state)
{
    (void)state;
    gm_bearing_data data = {.type = GM_BEARING_DEEP_GROOVE_BALL,
                            .friction = GM_FRICTION_SKF,
                            .designation = "6206"};
    gm_bearing_law bath = bearing_in_oil(data, 15., 0.05);
    data.supply = GM_SUPPLY_GREASE;
    gm_bearing_law grease = bearing_in_oil(data, 15., 0.05);
    data.supply = GM_SUPPLY_FLOODED;
    gm_bearing_law flooded = bearing_in_oil(data, 15., 0.05);
    double phi = gm_skf_factors(&bath, 3000.).rs;
    check_close("bath", phi, 0.9730356, 1e-6);
    check_close("grease", gm_skf_factors(&grease, 3000.).rs, phi * phi, 1e-12);
    assert_true(gm_skf_factors(&flooded, 3000.).rs == 1.);
}

/* SKF's quick estimate 0.5 mu P d, mu = 0.0015 for deep groove ball bearings at P = 0.1 C
 * and good lubrication: an order of magnitude, here within a quarter. */
static void agrees_with_the_quick_estimate(void **state)
{
    (void)state;
    gm_bearing_data data = {.type = GM_BEARING_DEEP_GROOVE_BALL,
                            .friction = GM_FRICTION_SKF,
                            .designation = "6206"};
    bearing_point p = {bearing_in_oil(data, 15., 0.05), 3000. * rpm, 2000., 0.};
    check_close("M", torque_at(&p).value, 0.5 * 0.0015 * 2000. * 0.030, 0.25);
}

static void tapered_bearing_30206(void **state)
{
    (void)state;
    gm_bearing_data data = bearing_of(GM_BEARING_TAPERED_ROLLER, GM_FRICTION_SKF);
    gm_bearing_law law = bearing_in_oil(data, 15., 0.05);
    skf_case c = {.F_r = 3000.,
                  .F_a = 1500.,
                  .n = 2000.,
                  .G_rr = 0.3863318,
                  .G_sl = 3061.998,
                  .phi_ish = 0.9770346,
                  .phi_rs = 0.9749664,
                  .phi_bl = 0.1089714,
                  .mu_sl = 0.01485863,
                  .M_rr = 178.7034,
                  .M_sl = 45.4971,
                  .M = 224.2005};
    check_case(&law, &c);
}

/* By hand for d_m = 46, F_r = 1000, F_a = 500 N at rest: cylindrical roller series 2
 * G_sl = 0.16 * 46^0.9 * 500 + 0.0015 * 46 * 1000; angular contact 72xx BECBP
 * G_sl = 0.0182 * 46^0.26 * (1000^(4/3) + 0.71 * 500^(4/3)). */
static void other_types_by_hand(void **state)
{
    (void)state;
    gm_bearing_data data = bearing_of(GM_BEARING_CYLINDRICAL_ROLLER, GM_FRICTION_SKF);
    gm_bearing_law law = bearing_in_oil(data, 15., 0.05);
    gm_bearing_speed rest = gm_bearing_at_speed(&law, 0.);
    gm_skf_loads g = gm_skf_at_loads(&law, &rest, 1000., 500.);
    check_close("G_sl cylindrical", g.G_sl, 2509.414 + 69., 1e-4); /* 46^0.9 = 31.36767 */
    /* 1.09e-6 * 46^2.41 * 1000^0.31 = 1.09e-6 * 10168 * 8.51138 */
    check_close("G_rr cylindrical", g.G_rr, 0.094332, 1e-3);
    data = bearing_of(GM_BEARING_NEEDLE_ROLLER, GM_FRICTION_SKF);
    gm_bearing_law needle = bearing_in_oil(data, 15., 0.05);
    /* full complement constants: R_1 2.13e-6 in place of 1.09e-6, more starvation */
    check_close("needle", needle.skf.k_rr / law.skf.k_rr, 2.13 / 1.09, 1e-12);
    check_close("K_Z", needle.skf.rs / law.skf.rs, sqrt(6.2 / 5.1), 1e-12);
    data = bearing_of(GM_BEARING_ANGULAR_CONTACT_BALL, GM_FRICTION_SKF);
    law = bearing_in_oil(data, 15., 0.05);
    g = gm_skf_at_loads(&law, &rest, 1000., 500.);
    /* 0.0182 * 2.70580 * (10000 + 0.71 * 3968.503) */
    check_close("G_sl angular", g.G_sl, 631.21, 1e-4);
    gm_bearing_speed fast = gm_bearing_at_speed(&law, 3000. * rpm);
    /* 2.44e-12 * 46^4 * 3000^2 = 98.33 N of centrifugal force */
    check_close("F_g", fast.F_g_rr, 98.326, 1e-4);
}

static void boundary_friction_rules_at_rest(void **state)
{
    (void)state;
    for (int type = 0; type < 5; type++) {
        gm_bearing_data data = bearing_of((gm_bearing_type)type, GM_FRICTION_SKF);
        gm_bearing_law law = bearing_in_oil(data, 15., 0.05);
        gm_bearing_speed rest = gm_bearing_at_speed(&law, 0.);
        assert_true(rest.rolling == 0. && rest.sliding == 0.12);
        gm_skf_loads g = gm_skf_at_loads(&law, &rest, 700., 300.);
        double M = gm_bearing_friction(&law, &rest, 700., 300.).value;
        check_close("break-away", M, 1e-3 * 0.12 * g.G_sl, 1e-13);
        gm_bearing_speed fast = gm_bearing_at_speed(&law, 3000.);
        static const double mu[] = {0.05, 0.05, 0.02, 0.02, 0.002};
        check_close("full film", fast.sliding, mu[type], 1e-2);
    }
}

/* The formulas for F_a = 0 and F_a > 0, each untouched at its end of the blend. */
static void axial_load_of_ball_bearings_enters_smoothly(void **state)
{
    (void)state;
    gm_bearing_data data = bearing_of(GM_BEARING_DEEP_GROOVE_BALL, GM_FRICTION_SKF);
    gm_bearing_law law = bearing_in_oil(data, 15., 0.05);
    gm_bearing_speed rest = gm_bearing_at_speed(&law, 0.);
    double before = 0., end = 0.002 * data.C0, F_r = 2000.;
    for (int i = 0; i <= 200; i++) {
        double G = gm_skf_at_loads(&law, &rest, F_r, end * i / 200.).G_sl;
        assert_true(G > before);
        before = G;
    }
    double radial = 3.23e-3 * pow(46., -0.26) * pow(F_r, 5. / 3.);
    check_close("F_a = 0", gm_skf_at_loads(&law, &rest, F_r, 0.).G_sl, radial, 1e-12);
    double alpha = 24.6 * pow(0.002, 0.24) * GM_PI / 180.;
    double sum = pow(F_r, 5.) + 36.5 * pow(46., 1.5) / sin(alpha) * pow(end, 4.);
    double both = 3.23e-3 * pow(46., -0.145) * cbrt(sum);
    check_close("end", gm_skf_at_loads(&law, &rest, F_r, end).G_sl, both, 1e-12);
    check_close("ratio", both / radial, pow(46., 0.115), 1e-2);
}

static void friction_rises_with_both_loads(void **state)
{
    (void)state;
    uint64_t seed = 10;
    for (int i = 0; i < 20000; i++) {
        bearing_point p =
            random_bearing((gm_bearing_type)(i % 5), GM_FRICTION_SKF, &seed);
        gm_bearing_torque M = torque_at(&p);
        assert_true(M.d_radial >= 0. && M.d_axial >= 0.);
    }
}

static void derivatives_are_exact(void **state)
{
    (void)state;
    check_derivatives(GM_FRICTION_SKF, 5000);
}

static void torque_has_no_jumps(void **state)
{
    (void)state;
    check_no_jumps(GM_FRICTION_SKF, 20);
}

static void limits_at_zero_are_finite(void **state)
{
    (void)state;
    check_limits_at_zero(GM_FRICTION_SKF);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drag_in_the_oil_bath),
        cmocka_unit_test(immersion_adds_drag),
        cmocka_unit_test(seals_of_capped_bearings),
        cmocka_unit_test(starvation_depends_on_the_supply),
        cmocka_unit_test(ball_bearing_6206),
        cmocka_unit_test(agrees_with_the_quick_estimate),
        cmocka_unit_test(tapered_bearing_30206),
        cmocka_unit_test(other_types_by_hand),
        cmocka_unit_test(boundary_friction_rules_at_rest),
        cmocka_unit_test(axial_load_of_ball_bearings_enters_smoothly),
        cmocka_unit_test(friction_rises_with_both_loads),
        cmocka_unit_test(derivatives_are_exact),
        cmocka_unit_test(torque_has_no_jumps),
        cmocka_unit_test(limits_at_zero_are_finite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
