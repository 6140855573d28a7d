/* SPDX-License-Identifier: BSD-2-Clause */
#include "property.h"

#include "model/inertia.h"

static void steel_disc_with_bore(void **state)
{
    (void)state;
    check_close("J", gm_cylinder_inertia(7850., 0.016, 0.09902, 0.030), 1.175457e-3,
                1e-6);
    check_close("m", gm_cylinder_mass(7850., 0.016, 0.09902, 0.030), 0.8784388, 1e-6);
}

static void disc_and_rim_make_the_whole(void **state)
{
    (void)state;
    uint64_t seed = 6;
    for (int i = 0; i < 100; i++) {
        double d = random_between(&seed, 0.02, 0.3), b = random_between(&seed, 0.01, 0.1);
        double cut = d * random_unit(&seed), rho = random_between(&seed, 2000., 8000.);
        double J = gm_cylinder_inertia(rho, b, d, 0.),
               m = gm_cylinder_mass(rho, b, d, 0.);
        /* solid: J = m r^2 / 2; rounding only */
        check_close("solid", J, m * d * d / 8., 1e-14);
        double parts =
            gm_cylinder_inertia(rho, b, d, cut) + gm_cylinder_inertia(rho, b, cut, 0.);
        check_close("parts", parts, J, 1e-14);
        double masses =
            gm_cylinder_mass(rho, b, d, cut) + gm_cylinder_mass(rho, b, cut, 0.);
        check_close("masses", masses, m, 1e-14);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steel_disc_with_bore),
        cmocka_unit_test(disc_and_rim_make_the_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
