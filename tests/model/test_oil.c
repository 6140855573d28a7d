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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(viscosity_of_a_75w_oil),
        cmocka_unit_test(oil_at_80_degrees),
        cmocka_unit_test(warmer_oil_is_thinner_and_lighter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
