/* SPDX-License-Identifier: BSD-2-Clause */
#include "property.h"

#include "model/power.h"
#include "model/stiffness.h"

#define DEGREE (GM_PI / 180.)

static gm_pair fzg_c(double b)
{
    const int z[2] = {16, 24};
    const double x[2] = {0.1817, 0.1715};
    return gm_pair_make(z, 4.5e-3, 20. * DEGREE, 0., x, b, 0.);
}

/* ISO 6336-1 for the FZG gear pair C at 390 N/mm, computed by hand from the formula. */
static void fzg_pair_has_the_stiffness_of_the_standard(void **state)
{
    (void)state;
    gm_pair pair = fzg_c(0.023);
    gm_tooth_stiffness c = gm_tooth_stiffness_of(&pair, 390e3);
    check_close("c'", c.single, 12.62086e9, PRINTED);
    check_close("c_gamma_alpha", c.mesh, 16.99807e9, PRINTED);
    check_close("c_gamma_beta", c.mesh_load, 14.44836e9, PRINTED);
}

/* A ring's equivalent number of teeth is infinite; pinion and wheel may stand in either
 * order. */
static void low_load_softens_and_order_does_not_matter(void **state)
{
    (void)state;
    gm_pair pair = fzg_c(0.023);
    gm_tooth_stiffness full = gm_tooth_stiffness_of(&pair, 100e3);
    gm_tooth_stiffness low = gm_tooth_stiffness_of(&pair, 6.25e3);
    check_close("sixteenth of the load", low.mesh, 0.5 * full.mesh, 1e-14);
    check_close("above 100 N/mm", gm_tooth_stiffness_of(&pair, 1e6).mesh, full.mesh, 0.);
    const int z[2] = {24, 16};
    const double x[2] = {0.1715, 0.1817};
    gm_pair turned = gm_pair_make(z, 4.5e-3, 20. * DEGREE, 0., x, 0.023, 0.);
    check_close("turned", gm_tooth_stiffness_of(&turned, 1e6).mesh, full.mesh, 1e-14);
}

static void outside_its_range_the_average_is_taken(void **state)
{
    (void)state;
    const int z[2] = {16, 24};
    const double x[2] = {-0.4, -0.3};
    gm_pair pair = gm_pair_make(z, 4.5e-3, 20. * DEGREE, 0., x, 0.023, 0.);
    gm_tooth_stiffness c = gm_tooth_stiffness_of(&pair, 1e6);
    check_close("c'", c.single, 14e9, 1e-15);
    check_close("c_gamma", c.mesh, 20e9, 1e-15);
}

/* K2: b 23 mm, J 2e-3 and 4e-3 kg.m2 on base radii 33.907 and 50.861 mm: reduced mass
 * 0.8186223 kg, natural frequency 3541.16 Hz with 4.0526e8 N/m; 2550 N.s/m at 0.07. */
static void frequency_and_damping_of_the_rig(void **state)
{
    (void)state;
    const gm_row row = {.n = 2, .body = {0, 1}, .g = {33.907e-3, 50.861e-3}};
    const double J[2] = {2e-3, 4e-3};
    double mass = gm_row_reduced_mass(&row, J);
    check_close("m_red", mass, 0.8186223, PRINTED);
    gm_flanks flanks = {.model = GM_CONTACT_FILM, .damping_ratio = 0.07};
    gm_contact_law law = gm_flanks_law(&flanks, 4.0526e8, 0., mass);
    check_close("k r_b1^2", law.stiffness * row.g[0] * row.g[0], 4.6593e5,
                5e-5); /* radius: five digits */
    check_close("f_0", sqrt(law.stiffness / mass) / (2. * GM_PI), 3541.16, PRINTED);
    check_close("damping", law.damping, 2550., 1e-3); /* printed with three digits */
}

/* a 80 mm, m_n 1.75 mm: 2/3 (0.06 + 0.04 + 0.0525) = 0.101667 mm. */
static void default_backlash_by_hand(void **state)
{
    (void)state;
    gm_pair pair = {.a_w = 0.080, .m_n = 1.75e-3};
    check_close("j_bn", gm_default_backlash(&pair), 0.1016667e-3, 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fzg_pair_has_the_stiffness_of_the_standard),
        cmocka_unit_test(low_load_softens_and_order_does_not_matter),
        cmocka_unit_test(outside_its_range_the_average_is_taken),
        cmocka_unit_test(frequency_and_damping_of_the_rig),
        cmocka_unit_test(default_backlash_by_hand),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
