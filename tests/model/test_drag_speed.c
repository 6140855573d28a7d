/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Drags of speed alone: the standards' churning, windage, oil jets, films beyond laminar
 * flow.
 */
#include "property.h"

#include "model/drag.h"
#include "model/power.h"

static const double rpm = GM_PI / 30.;
static const gm_oil oil = {.nu = 60e-6, .rho = 850., .eta = 60e-6 * 850.};

/* D 120, b 20 mm, 1000 rpm, 60 mm2/s, m_t 2.5, beta 25 degrees, dipping by 0.3:
 * sides 0.942048 W, teeth 6.979133 W. */
static const gm_dip wheel = {.R_p = 0.0575,
                             .b = 0.020,
                             .h = 0.3 * 0.120,
                             .V_0 = 1e-3,
                             .R_a = 0.060,
                             .m_t = 2.5e-3,
                             .beta = 25. * GM_PI / 180.};

static void churning_by_iso14179_1(void **state)
{
    (void)state;
    gm_iso_churning k = gm_churning_iso14179_1(&wheel, &oil);
    double w = 1000. * rpm, w3 = w * w * w;
    check_close("sides", k.sides * w3, 0.942048, PRINTED);
    check_close("teeth", k.teeth * w3, 6.979133, PRINTED);
    double P = gm_churning_torque_iso14179_1(&wheel, &oil, w).value * w;
    check_close("both", P, 0.942048 + 6.979133, PRINTED);
    gm_dip changed = wheel;
    changed.h = -0.01;
    assert_true(gm_churning_torque_iso14179_1(&changed, &oil, w).value == 0.);
    changed.h = 9.; /* fully submerged: f_g = 1 */
    check_close("f_g", gm_churning_torque_iso14179_1(&changed, &oil, w).value * w * 0.3,
                P, 1e-12);
    /* spur gears count as 10 degrees */
    changed = wheel, changed.beta = 0.;
    check_close("beta", gm_churning_iso14179_1(&changed, &oil).teeth / k.teeth,
                sqrt(tan(wheel.beta) / tan(10. * GM_PI / 180.)), 1e-12);
}

/* e 0 and 20, b 20 mm, 8 m/s: C_1 0.2284, C_2 0.225, 0.2734444 N.m. */
static const gm_splash splash = {
    .depth = 0.020, .b = 0.020, .r_w = 0.040, .guidance = 1.};

static void hydraulic_torque_by_iso14179_2(void **state)
{
    (void)state;
    check_close("T_H", gm_splash_torque(&splash, 8. / 0.040).value, 0.2734444, 1e-6);
    gm_splash dry = splash;
    dry.depth = 0.;
    assert_true(gm_splash_torque(&dry, 200.).value == 0.);
    assert_true(gm_splash_torque(&splash, 0.).value == 0.); /* oil does not hold */
    assert_true(gm_splash_torque(&splash, 61. / 0.040).value ==
                gm_splash_torque(&splash, 90. / 0.040).value);
    check_close("from 1 m/s", gm_splash_torque(&splash, 1. / 0.040).value,
                0.2284 * exp(0.0225), 1e-12);
}

/* By hand: 100^1.6 = 1584.893, 20^0.52 = 4.748269, 2^0.69 = 1.613284,
 * 50^1.9 = 1690.601. */
static const gm_windage fast_gear = {.d = 0.100, .b = 0.020, .m_n = 2e-3};

static void windage_by_hand(void **state)
{
    (void)state;
    double T = 1.37e-9 * 1690.601 * 1584.893 * 4.748269 * 1.613284;
    check_close("T", gm_windage_torque(&fast_gear, 1000.).value, T, 1e-5);
    gm_speed_torque rest = gm_windage_torque(&fast_gear, 0.);
    assert_true(rest.value == 0. && rest.d_speed == 0.);
}

/* 2.5 l/min at 0.4 m/s on a gear of r 50 mm at 10 m/s: 0.85 * 0.05 * 850 * 2.5e-3/60 *
 * 10.4 = 0.01565417 N.m. */
static const gm_jet_law jet = {
    .radius = 0.05, .flow = 2.5e-3 / 60., .speed = 0.4, .factor = 0.85};

static void impulse_of_a_jet(void **state)
{
    (void)state;
    check_close("T", gm_jet_torque(&jet, &oil, 200.).value, 0.01565417, 1e-6);
    assert_true(gm_jet_torque(&jet, &oil, 0.).value == 0.);
}

/* r 12.6, c 0.2 mm, 10 mm2/s: Taylor's vortices from 1297 rad/s on. */
static const gm_oil hot = {.nu = 10e-6, .rho = 800., .eta = 8e-3};

static double film(double w)
{
    return gm_petroff_torque(12.6e-3, 0.15, 0.2e-3, &hot, w).value;
}

static void films_beyond_laminar_flow(void **state)
{
    (void)state;
    double w_T = 41.2 * sqrt(12.6 / 0.2) * 10e-6 / (12.6e-3 * 0.2e-3);
    double slope = 2. * GM_PI * 8e-3 * pow(12.6e-3, 3.) * 0.15 / 0.2e-3;
    check_close("laminar", film(0.5 * w_T), slope * 0.5 * w_T, 1e-3);
    check_close("vortices", film(2. * w_T), slope * 2. * w_T * pow(2., 0.4), 1e-3);
    check_close("far", film(20. * w_T) / film(10. * w_T), pow(2., 1.4), 1e-9);
}

static double law(const void *data, double w)
{
    switch (*(const int *)data) {
    case 0:
        return gm_churning_torque_iso14179_1(&wheel, &oil, w).value;
    case 1:
        return gm_splash_torque(&splash, w).value;
    case 2:
        return gm_windage_torque(&fast_gear, w).value;
    case 3:
        return gm_jet_torque(&jet, &oil, w).value;
    default:
        return film(w);
    }
}

static double slope_at(int which, double w)
{
    switch (which) {
    case 0:
        return gm_churning_torque_iso14179_1(&wheel, &oil, w).d_speed;
    case 1:
        return gm_splash_torque(&splash, w).d_speed;
    case 2:
        return gm_windage_torque(&fast_gear, w).d_speed;
    case 3:
        return gm_jet_torque(&jet, &oil, w).d_speed;
    default:
        return gm_petroff_torque(12.6e-3, 0.15, 0.2e-3, &hot, w).d_speed;
    }
}

static void laws_are_smooth_and_rise(void **state)
{
    (void)state;
    uint64_t seed = 41;
    for (int which = 0; which < 5; which++) {
        check_continuous("T(w)", law, &which, 1e-6, 3000.);
        for (int i = 0; i < 500; i++) {
            double w = random_scale(&seed, 1e-2, 3000.);
            double slope = slope_at(which, w);
            assert_true(slope >= 0.);
            check_slope("T(w)", law, &which, w, slope);
        }
        assert_true(law(&which, 0.) == 0. && isfinite(slope_at(which, 0.)));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(churning_by_iso14179_1),
        cmocka_unit_test(hydraulic_torque_by_iso14179_2),
        cmocka_unit_test(windage_by_hand),
        cmocka_unit_test(impulse_of_a_jet),
        cmocka_unit_test(films_beyond_laminar_flow),
        cmocka_unit_test(laws_are_smooth_and_rise),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
