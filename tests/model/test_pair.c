/* SPDX-License-Identifier: BSD-2-Clause */
#include "property.h"

#include "model/mesh.h"
#include "model/power.h"

#include <string.h>

static const double degree = GM_PI / 180.;

/* FZG type C gear; the values are printed in the report of the gear test rig (Fernandes,
 * Martins, Seabra, "Gearpie") and follow from ISO 21771. */
static void fzg_c_gear_has_its_published_geometry(void **state)
{
    (void)state;
    const int z[2] = {16, 24};
    const double x[2] = {0.1817, 0.1715};
    gm_pair p = gm_pair_make(z, 4.5e-3, 20. * degree, 0., x, 14e-3, 0.);
    check_close("alpha_wt", p.alpha_wt / degree, 22.43891, PRINTED);
    check_close("a_w", p.a_w, 91.50008e-3, 1e-7);
    check_close("d_w1", p.d_w[0], 73.2001e-3, PRINTED);
    check_close("d_w2", p.d_w[1], 109.8001e-3, PRINTED);
    check_close("d_a1", p.d_a[0], 82.6353e-3, PRINTED);
    check_close("d_a2", p.d_a[1], 118.5435e-3, PRINTED);
    check_close("d_b1", p.d_b[0], 67.65787e-3, 1e-7);
    check_close("d_b2", p.d_b[1], 101.48680e-3, 1e-7);
    check_close("eps_1", p.eps[0], 0.734100, PRINTED);
    check_close("eps_2", p.eps[1], 0.728331, PRINTED);
    check_close("eps_alpha", p.eps_alpha, 1.462431, PRINTED);
    /* path of contact, printed with four digits */
    double p_bt = GM_PI * p.m_t * cos(p.alpha_t);
    check_close("path of contact", p.eps_alpha * p_bt, 19.43e-3, 5e-4);
    check_close("H_V", gm_pair_loss_factor(&p), 0.198620, PRINTED);
    check_close("rho_redC", gm_pair_curvature(&p), 8.382099e-3, PRINTED);
}

/* Forces on a helical pair need pitch diameter and angle: z 32/49, m_n 1.75,
 * alpha_n 17.5 deg, beta 30 deg. */
static void helical_pair_has_its_transverse_angle(void **state)
{
    (void)state;
    const int z[2] = {32, 49};
    const double x[2] = {0., 0.};
    gm_pair p = gm_pair_make(z, 1.75e-3, 17.5 * degree, -30. * degree, x, 16e-3, 0.);
    check_close("alpha_wt", p.alpha_wt / degree, 20.00533, PRINTED);
    check_close("d_w1", p.d_w[0], 64.66323e-3, PRINTED);
    assert_true(p.beta > 0.);
}

static void loss_factors_of_a_gearset(void **state)
{
    (void)state;
    /* DCT with third gear 32/49: m_n 1.75, beta 27.6329 deg; final drive 16/71 */
    const double x[2] = {0., 0.};
    const int third[2] = {32, 49}, final[2] = {16, 71};
    gm_pair p =
        gm_pair_make(third, 1.75e-3, 20. * degree, 27.6329 * degree, x, .016, .08);
    check_close("third eps_alpha", p.eps_alpha, 1.43848, PRINTED);
    check_close("third H_V", gm_pair_loss_factor(&p), 0.10756, 5e-5);
    check_close("third rho", gm_pair_curvature(&p), 8.072473e-3, PRINTED);
    p = gm_pair_make(final, 2.25e-3, 20. * degree, 25. * degree, x, .030, 0.);
    check_close("final H_V", gm_pair_loss_factor(&p), 0.15851, 5e-5);
}

static gm_pair random_pair(uint64_t *seed, double a_w_share)
{
    int z[2] = {12 + (int)(random_unit(seed) * 40.), 12 + (int)(random_unit(seed) * 80.)};
    double x[2] = {random_between(seed, -0.2, 0.6), random_between(seed, -0.2, 0.6)};
    double m_n = random_between(seed, 1e-3, 6e-3);
    double alpha_n = random_between(seed, 17. * degree, 25. * degree);
    double beta = random_between(seed, 0., 33. * degree);
    double a_w = 0.5 * m_n / cos(beta) * (z[0] + z[1]) * a_w_share;
    return gm_pair_make(z, m_n, alpha_n, beta, x, 0.02, a_w);
}

static void external_pairs_obey_the_law_of_gearing(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < 2000; i++) {
        gm_pair p = random_pair(&seed, 0.);
        /* rounding of a few operations */
        check_close("d_w1 + d_w2", p.d_w[0] + p.d_w[1], 2. * p.a_w, 1e-13);
        check_close("ratio", p.d_w[1] * p.z[0], p.d_w[0] * p.z[1], 1e-13);
        double left = tan(p.alpha_wt) - p.alpha_wt - tan(p.alpha_t) + p.alpha_t;
        double sum = 2. * tan(p.alpha_n) * (p.x[0] + p.x[1]);
        /* cancellation: involutes are about 0.01 */
        assert_true(fabs(left * (p.z[0] + p.z[1]) - sum) < 1e-12);
        assert_true(gm_pair_loss_factor(&p) > 0.);
    }
}

static void inverse_involute_undoes_the_centre_distance(void **state)
{
    (void)state;
    uint64_t seed = 2;
    for (int i = 0; i < 500; i++) {
        gm_pair p = random_pair(&seed, 0.);
        gm_pair q = gm_pair_make(p.z, p.m_n, p.alpha_n, p.beta, p.x, p.b, p.a_w);
        /* acos loses digits where the working angle is small */
        check_close("alpha_wt", q.alpha_wt, p.alpha_wt, 1e-12);
        check_close("eps", q.eps_alpha, p.eps_alpha, 1e-10);
    }
}

static void gears_may_be_given_in_either_order(void **state)
{
    (void)state;
    const int z[2] = {17, 64}, r[2] = {64, 17}, ring[2] = {21, -57},
              turned[2] = {-57, 21};
    const double x[2] = {0.3, -0.1}, y[2] = {-0.1, 0.3};
    gm_pair a = gm_pair_make(z, 2e-3, 0.35, 0.4, x, 0.02, 0.);
    gm_pair b = gm_pair_make(r, 2e-3, 0.35, 0.4, y, 0.02, 0.);
    check_close("H_V", gm_pair_loss_factor(&a), gm_pair_loss_factor(&b), 1e-14);
    check_close("rho", gm_pair_curvature(&a), gm_pair_curvature(&b), 1e-14);
    a = gm_pair_make(ring, 2e-3, 0.35, 0., x, 0.02, 0.);
    b = gm_pair_make(turned, 2e-3, 0.35, 0., y, 0.02, 0.);
    check_close("H_V of a ring", gm_pair_loss_factor(&a), gm_pair_loss_factor(&b), 1e-14);
    check_close("d_a of a ring", a.d_a[1], b.d_a[0], 1e-14);
}

/* z 21 in a ring of 57, m 2 mm, no shift: by hand d = 42 and 114, a = 36, tip of the
 * ring 114 - 4 = 110 mm; eps_2 = 57 (tan 20 - tan acos(114 cos 20 / 110)) / 2 pi. */
static void ring_gear_by_hand(void **state)
{
    (void)state;
    const int z[2] = {21, -57};
    const double x[2] = {0., 0.};
    gm_pair p = gm_pair_make(z, 2e-3, 20. * degree, 0., x, 0.02, 0.);
    check_close("a_w", p.a_w, 36e-3, 1e-12);
    check_close("d_w2", p.d_w[1], 114e-3, 1e-12);
    check_close("d_a2", p.d_a[1], 110e-3, 1e-12);
    check_close("d_w2 - d_w1", p.d_w[1] - p.d_w[0], 72e-3, 1e-12);
    /* tan acos(0.973863) = 0.233230; (0.363970 - 0.233230) 57 / 6.283185 = 1.18605 */
    check_close("eps_2", p.eps[1], 1.18605, 1e-5);
    /* 0.5 sin 20 deg / (1/42 - 1/114) mm */
    check_close("rho", gm_pair_curvature(&p), 11.3714e-3, 1e-4);
    /* the same by its given centre distance; acos loses some digits */
    gm_pair given = gm_pair_make(z, 2e-3, 20. * degree, 0., x, 0.02, 36e-3);
    check_close("alpha_wt", given.alpha_wt, 20. * degree, 1e-12);
    /* internal contact: fewer sliding losses than the same teeth outside */
    const int outside[2] = {21, 57};
    gm_pair o = gm_pair_make(outside, 2e-3, 20. * degree, 0., x, 0.02, 0.);
    assert_true(gm_pair_loss_factor(&p) < gm_pair_loss_factor(&o));
    assert_true(gm_pair_loss_factor(&p) > 0.);
}

static void flanks_that_cannot_meet_give_nan(void **state)
{
    (void)state;
    const int z[2] = {20, 30};
    const double x[2] = {0., 0.}, far[2] = {-3., -3.};
    /* base circles 2 mm, 20 deg: a cos alpha = 46.98 mm */
    gm_pair p = gm_pair_make(z, 2e-3, 20. * degree, 0., x, 0.02, 46e-3);
    assert_true(isnan(p.alpha_wt) && isnan(p.eps_alpha) && isnan(p.d_w[0]));
    p = gm_pair_make(z, 2e-3, 20. * degree, 0., far, 0.02, 0.);
    assert_true(isnan(p.alpha_wt) && isnan(p.a_w));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fzg_c_gear_has_its_published_geometry),
        cmocka_unit_test(helical_pair_has_its_transverse_angle),
        cmocka_unit_test(loss_factors_of_a_gearset),
        cmocka_unit_test(external_pairs_obey_the_law_of_gearing),
        cmocka_unit_test(inverse_involute_undoes_the_centre_distance),
        cmocka_unit_test(gears_may_be_given_in_either_order),
        cmocka_unit_test(ring_gear_by_hand),
        cmocka_unit_test(flanks_that_cannot_meet_give_nan),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
