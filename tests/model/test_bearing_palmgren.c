/* SPDX-License-Identifier: BSD-2-Clause */
#include "bearing_cases.h"

static bearing_point point(gm_bearing_data data, double n, double F_r, double F_a)
{
    return (bearing_point){bearing_in_oil(data, 15., 0.05), n * rpm, F_r, F_a};
}

static void ball_bearing_6206(void **state)
{
    (void)state;
    gm_bearing_data data = {.type = GM_BEARING_DEEP_GROOVE_BALL,
                            .friction = GM_FRICTION_PALMGREN,
                            .designation = "6206",
                            .f0 = (double)NAN,
                            .f1 = (double)NAN};
    bearing_point p = point(data, 3000., 2000., 0.);
    check_close("M", 1e3 * torque_at(&p).value, 56.73053, 1e-6);
    p.F_r = 0.;
    check_close("M_0", 1e3 * torque_at(&p).value, 24.62891, 1e-6);
    p.w = 100. * rpm;
    check_close("M_0 slow", 1e3 * torque_at(&p).value, 3.114752, 1e-6);
    p.w = 0.;
    check_close("M_0 at rest", 1e3 * torque_at(&p).value, 3.114752, 1e-6);
}

/* The larger of both forms of M_0: above the source by at most its own jump, 0.8 %. */
static void viscous_part_joins_without_a_jump(void **state)
{
    (void)state;
    gm_bearing_data data = bearing_of(GM_BEARING_TAPERED_ROLLER, GM_FRICTION_PALMGREN);
    for (double nu_n = 1500.; nu_n < 2500.; nu_n += 1.) {
        bearing_point p = point(data, nu_n / 15., 0., 0.);
        double factor = nu_n < 2000. ? 160. : pow(nu_n, 2. / 3.);
        double source = 1e-7 * 4. * 46. * 46. * 46. * factor;
        double excess = 1e3 * torque_at(&p).value / source - 1.;
        assert_true(excess > -1e-12 && excess < 0.0081);
        if (nu_n < 2000. || nu_n > 2024.)
            assert_true(excess < 1e-12);
    }
}

/* By hand, d_m = 46 mm, at rest: M_0 = 160e-7 f_0 46^3 = 1.557376 f_0. */
static void load_part_by_hand(void **state)
{
    (void)state;
    const double viscous = 1.557376;
    gm_bearing_data data = bearing_of(GM_BEARING_TAPERED_ROLLER, GM_FRICTION_PALMGREN);
    bearing_point p = point(data, 0., 1000., 500.);
    /* P_1 = 2 * 1.6 * 500 = 1600 N */
    double M = 1e3 * torque_at(&p).value - 4. * viscous;
    check_close("tapered", M, 0.0004 * 1600. * 46., 1e-9);
    data = bearing_of(GM_BEARING_CYLINDRICAL_ROLLER, GM_FRICTION_PALMGREN);
    p = point(data, 0., 1000., 500.);
    M = 1e3 * torque_at(&p).value - 2.5 * viscous;
    check_close("cylindrical", M, (0.0003 * 1000. + 0.006 * 500.) * 46., 1e-9);
    strcpy(data.series, "all_full_comp");
    p = point(data, 0., 1000., 500.);
    M = 1e3 * torque_at(&p).value - 6. * viscous;
    check_close("full complement", M, (0.00055 * 1000. + 0.003 * 500.) * 46., 1e-9);
    data = bearing_of(GM_BEARING_NEEDLE_ROLLER, GM_FRICTION_PALMGREN);
    p = point(data, 0., 1000., 0.);
    M = 1e3 * torque_at(&p).value - 12. * viscous;
    check_close("needle", M, 0.002 * 1000. * 46., 1e-9);
    data = bearing_of(GM_BEARING_ANGULAR_CONTACT_BALL, GM_FRICTION_PALMGREN);
    p = point(data, 0., 1000., 2000.);
    /* P_1 = 2800 - 100, P_0 = 500 + 520 N, C_0 = 16000 N */
    M = 1e3 * torque_at(&p).value - 2. * viscous;
    check_close("angular", M, 0.001 * pow(1020. / 16000., 0.33) * 2700. * 46., 1e-9);
}

static void given_coefficients_replace_defaults(void **state)
{
    (void)state;
    gm_bearing_data data = bearing_of(GM_BEARING_DEEP_GROOVE_BALL, GM_FRICTION_PALMGREN);
    data.f0 = 1.5;
    data.f1 = 0.0006;
    data.C0 = (double)NAN; /* not needed with a given f_1 */
    bearing_point p = point(data, 0., 1000., 0.);
    check_close("M", 1e3 * torque_at(&p).value, 1.5 * 1.557376 + 0.0006 * 1000. * 46.,
                1e-9);
}

static void friction_rises_with_speed_and_axial_load(void **state)
{
    (void)state;
    uint64_t seed = 11;
    for (int i = 0; i < 20000; i++) {
        bearing_point p =
            random_bearing((gm_bearing_type)(i % 5), GM_FRICTION_PALMGREN, &seed);
        gm_bearing_torque M = torque_at(&p);
        assert_true(M.d_speed >= 0. && M.d_axial >= 0.);
    }
}

static void derivatives_are_exact(void **state)
{
    (void)state;
    check_derivatives(GM_FRICTION_PALMGREN, 5000);
}

static void torque_has_no_jumps(void **state)
{
    (void)state;
    check_no_jumps(GM_FRICTION_PALMGREN, 20);
}

static void limits_at_zero_are_finite(void **state)
{
    (void)state;
    check_limits_at_zero(GM_FRICTION_PALMGREN);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ball_bearing_6206),
        cmocka_unit_test(viscous_part_joins_without_a_jump),
        cmocka_unit_test(load_part_by_hand),
        cmocka_unit_test(given_coefficients_replace_defaults),
        cmocka_unit_test(friction_rises_with_speed_and_axial_load),
        cmocka_unit_test(derivatives_are_exact),
        cmocka_unit_test(torque_has_no_jumps),
        cmocka_unit_test(limits_at_zero_are_finite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
