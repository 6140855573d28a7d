/* SPDX-License-Identifier: BSD-2-Clause */
#include "property.h"

#include "model/oil.h"

/* 75W gear oil, 30.8 and 5.9 mm2/s: 9.12 at 80 and 7.25 at 90 degC are its maker's
 * figures; the others follow from Walther's equation. */
static void viscosity_of_a_75w_oil(void **state)
{
    (void)state;
    const double table[][2] = {{-20., 1235.13}, {0., 243.13},  {20., 74.566},
                               {40., 30.8},     {60., 15.602}, {80., 9.1159},
                               {90., 7.255},    {100., 5.9},   {120., 4.116}};
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        double nu = gm_oil_viscosity(30.8e-6, 5.9e-6, table[i][0] + 273.15);
        /* last digit printed: 4.116 */
        check_close("nu", 1e6 * nu, table[i][1], 1e-4);
    }
}

static void oil_at_80_degrees(void **state)
{
    (void)state;
    gm_oil_part part = {.viscosity_40 = 30.8e-6,
                        .viscosity_100 = 5.9e-6,
                        .density_15 = 845.,
                        .thermal_expansion = 0.65 / 845.,
                        .mesh_lubricant_factor = 0.75,
                        .bearing_mu_ehl = 0.1};
    gm_oil oil = gm_oil_at(&part, 353.15);
    check_close("eta", oil.eta, 7.317801e-3, 1e-6);
    check_close("rho", oil.rho, 802.75, 1e-12);
    assert_true(oil.mesh_lubricant_factor == 0.75 && oil.bearing_mu_ehl == 0.1);
    assert_true(oil.nu_40 == part.viscosity_40 && oil.temperature == 353.15);
    check_close("rho at 15 degC", gm_oil_at(&part, 288.15).rho, 845., 1e-14);
}

static void warmer_oil_is_thinner_and_lighter(void **state)
{
    (void)state;
    uint64_t seed = 5;
    for (int i = 0; i < 200; i++) {
        gm_oil_part part = {.density_15 = 870., .thermal_expansion = 7e-4};
        part.viscosity_100 = random_between(&seed, 4e-6, 25e-6);
        part.viscosity_40 = part.viscosity_100 * random_between(&seed, 3., 12.);
        gm_oil before = gm_oil_at(&part, 253.15);
        for (double T = 255.; T <= 423.15; T += 2.) {
            gm_oil oil = gm_oil_at(&part, T);
            assert_true(oil.nu > 0. && oil.nu < before.nu && oil.rho < before.rho);
            before = oil;
        }
        /* interpolation points come back */
        double nu_40 = gm_oil_viscosity(part.viscosity_40, part.viscosity_100, 313.15);
        check_close("nu_40", nu_40, part.viscosity_40, 1e-12);
    }
}

/* The same oil by Vogel through 40, 80 and 100 degC, at 80 by ASTM D341: A -2.3648017,
 * B 870.60310, C 110.303099 and its values at 20, 60 and 120 degC. */
static void vogel_through_three_points(void **state)
{
    (void)state;
    gm_oil_part part = {
        .viscosity_40 = 30.8e-6, .viscosity_100 = 5.9e-6, .third_temperature = 353.15};
    part.third_viscosity = gm_oil_viscosity(30.8e-6, 5.9e-6, 353.15);
    gm_vogel vogel = {0};
    assert_true(gm_oil_vogel(&part, &vogel));
    check_close("A", vogel.A, -2.3648017, 1e-6);
    check_close("B", vogel.B, 870.60310, 1e-6);
    check_close("C", vogel.C, 110.303099, 1e-6);
    const double table[][2] = {
        {20., 74.931}, {40., 30.8}, {60., 15.600}, {100., 5.9}, {120., 4.118}};
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++) {
        gm_oil oil = gm_oil_at(&part, table[i][0] + 273.15);
        check_close("nu", 1e6 * oil.nu, table[i][1], 1e-4);
    }
    check_close("third", gm_oil_at(&part, 353.15).nu, part.third_viscosity, 1e-12);
}

/* Points of a curve, wherever the third lies, give the curve back. */
static void vogel_gives_a_curve_back(void **state)
{
    (void)state;
    uint64_t seed = 7;
    for (int i = 0; i < 500; i++) {
        double B = random_between(&seed, 500., 1500.),
               C = random_between(&seed, 70., 200.);
        double T = random_between(&seed, -40., 160.), A = -2.;
        if (fabs(T - 40.) < 5. || fabs(T - 100.) < 5.)
            continue;
        gm_oil_part part = {.viscosity_40 = 1e-6 * exp(A + B / (40. + C)),
                            .viscosity_100 = 1e-6 * exp(A + B / (100. + C)),
                            .third_viscosity = 1e-6 * exp(A + B / (T + C)),
                            .third_temperature = T + 273.15};
        double at = random_between(&seed, -30., 140.);
        /* differences of logarithms over 5 K cost five digits */
        check_close("nu", 1e6 * gm_oil_at(&part, at + 273.15).nu, exp(A + B / (at + C)),
                    1e-9);
    }
}

static void a_third_point_off_every_curve_is_refused(void **state)
{
    (void)state;
    gm_oil_part part = {
        .viscosity_40 = 30.8e-6, .viscosity_100 = 5.9e-6, .third_temperature = 353.15};
    gm_vogel vogel = {1., 2., 3.};
    const double off[] = {40e-6, 12e-6, 8e-6, 5e-6};
    for (size_t i = 0; i < sizeof off / sizeof off[0]; i++) {
        part.third_viscosity = off[i];
        assert_false(gm_oil_vogel(&part, &vogel));
        assert_true(vogel.A == 1. && vogel.B == 2. && vogel.C == 3.);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(viscosity_of_a_75w_oil),
        cmocka_unit_test(oil_at_80_degrees),
        cmocka_unit_test(vogel_through_three_points),
        cmocka_unit_test(vogel_gives_a_curve_back),
        cmocka_unit_test(a_third_point_off_every_curve_is_refused),
        cmocka_unit_test(warmer_oil_is_thinner_and_lighter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
