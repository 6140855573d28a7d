/* SPDX-License-Identifier: BSD-2-Clause */
#include "property.h"

#include "model/contact.h"

/* The numbers of Modelica's ElastoBacklash: c 1e5 N.m/rad, d 50 N.m.s/rad, b 1e-3 rad at
 * 8e-4 rad. */
static void dry_flanks_follow_elasto_backlash(void **state)
{
    (void)state;
    const gm_contact_law law = {
        .model = GM_CONTACT_DRY, .stiffness = 1e5, .damping = 50., .gap = 0.5e-3};
    const double cases[][2] = {{0., 30.}, {1., 60.}, {-1., 0.}, {-0.1, 25.}};
    for (int i = 0; i < 4; i++)
        for (double s = -1.; s < 2.; s += 2.) {
            double F = gm_contact_force_at(&law, s * 8e-4, s * cases[i][0]).value;
            assert_true(fabs(F - s * cases[i][1]) < 1e-11); /* rounding of 30 N.m */
        }
    assert_true(gm_contact_force_at(&law, 4e-4, 3.).value == 0.);
    assert_true(gm_contact_force_at(&law, -4e-4, 3.).value == 0.);
}

static gm_contact_law random_law(uint64_t *seed, gm_contact_model model)
{
    return (gm_contact_law){.model = model,
                            .stiffness = random_scale(seed, 1e7, 1e9),
                            .damping = random_scale(seed, 10., 1e4),
                            .gap = random_scale(seed, 1e-7, 1e-4),
                            .entry = random_scale(seed, 1e-6, 1e-5),
                            .film = random_unit(seed)};
}

/* Deflections in the gap, in the entry and in full contact alike. */
static double random_deflection(uint64_t *seed, const gm_contact_law *law)
{
    double u = random_unit(seed) < 0.3 ? -law->gap : 0.;
    u += random_scale(seed, 1e-8, 1e-4);
    return (random_unit(seed) < 0.5 ? -1. : 1.) * fabs(law->gap + u);
}

/* Central differences over 1e-11 m and 1e-7 m/s: away from kinks of the second derivative
 * the error is rounding, 1e-16 F / h. */
static void derivatives_are_exact(void **state)
{
    (void)state;
    uint64_t seed = 11;
    for (int i = 0; i < 3000; i++) {
        gm_contact_law law = random_law(&seed, (gm_contact_model)(i % 3));
        double x = random_deflection(&seed, &law), v = random_between(&seed, -0.3, 0.3);
        gm_contact_force f = gm_contact_force_at(&law, x, v);
        double h = 1e-11, k = 1e-7;
        double d_x = gm_contact_force_at(&law, x + h, v).value -
                     gm_contact_force_at(&law, x - h, v).value;
        double d_v = gm_contact_force_at(&law, x, v + k).value -
                     gm_contact_force_at(&law, x, v - k).value;
        double dU = gm_contact_energy(&law, x + h) - gm_contact_energy(&law, x - h);
        double size = law.stiffness * (fabs(x) + law.entry);
        double thin = fmin(law.entry, law.gap);
        assert_true(fabs(d_x / (2. * h) - f.d_x) <=
                    1e-4 * (law.stiffness + law.damping * fabs(v) / thin));
        assert_true(fabs(d_v / (2. * k) - f.d_v) <= 1e-5 * law.damping + 1e-8 * size);
        assert_true(fabs(dU / (2. * h) - f.spring) <= 1e-4 * size);
    }
}

static void film_has_no_kink(void **state)
{
    (void)state;
    uint64_t seed = 12;
    for (int i = 0; i < 200; i++) {
        gm_contact_law law = random_law(&seed, GM_CONTACT_FILM);
        double r = fmin(law.gap, law.entry);
        const double corners[4] = {law.gap - r, law.gap, law.gap + law.entry, 0.};
        for (int c = 0; c < 4; c++) {
            double v = random_between(&seed, -1., 1.), h = 1e-6 * r;
            gm_contact_force a = gm_contact_force_at(&law, corners[c] - h, v);
            gm_contact_force b = gm_contact_force_at(&law, corners[c] + h, v);
            /* second derivatives times 2 h */
            double step = 4e-6 * (law.stiffness + 6. * law.damping / r);
            assert_true(fabs(b.d_x - a.d_x) <= step);
            assert_true(fabs(b.value - a.value) <= step * r);
        }
    }
}

static void every_law_dissipates(void **state)
{
    (void)state;
    uint64_t seed = 13;
    for (int i = 0; i < 30000; i++) {
        gm_contact_law law = random_law(&seed, (gm_contact_model)(i % 3));
        double x = random_deflection(&seed, &law), v = random_between(&seed, -1., 1.);
        gm_contact_force f = gm_contact_force_at(&law, x, v);
        assert_true((f.value - f.spring) * v >= 0.);
        assert_true(gm_contact_energy(&law, x) >= 0.);
        if (law.model == GM_CONTACT_DRY)
            assert_true(f.value * x >= 0.);
    }
}

/* A cycle of any deflection takes in work: the integral of F dx, by the midpoint rule,
 * whose error falls with the square of the step (4e-7 of a cycle of 4000 steps). */
static void a_cycle_never_gives_energy(void **state)
{
    (void)state;
    uint64_t seed = 14;
    for (int i = 0; i < 60; i++) {
        gm_contact_law law = random_law(&seed, (gm_contact_model)(i % 3));
        double a = law.gap + 2e-5, b = random_between(&seed, -0.4, 0.4) * a;
        double rate = random_scale(&seed, 1., 3e3), work = 0., taken = 0.;
        int n = 4000;
        for (int k = 0; k < n; k++) {
            double t = 6.283185307179586 * (k + 0.5) / n;
            double x = a * sin(t) + b * sin(2. * t);
            double v = rate * (a * cos(t) + 2. * b * cos(2. * t));
            double F = gm_contact_force_at(&law, x, v).value;
            work += F * v / rate * 6.283185307179586 / n;
            taken += fabs(F * v) / rate * 6.283185307179586 / n;
        }
        assert_true(work >= -1e-6 * taken);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dry_flanks_follow_elasto_backlash),
        cmocka_unit_test(derivatives_are_exact),
        cmocka_unit_test(film_has_no_kink),
        cmocka_unit_test(every_law_dissipates),
        cmocka_unit_test(a_cycle_never_gives_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
