/* SPDX-License-Identifier: BSD-2-Clause */
#include "property.h"

#include "model/bristle.h"

/* A small gearbox bearing: 0.10 N.m sliding, 0.15 N.m at rest, over 0.05 rad/s. */
static const gm_bristle_law law = {.stiffness = 200., .damping = 1., .speed = 0.05};
static const double T_c = 0.10, T_s = 0.15;

static gm_bristle_level level_at(double w)
{
    double u = fabs(w) / law.speed, fall = (T_s - T_c) * exp(-u * u);
    return (gm_bristle_level){T_c + fall, -2. * u / law.speed * fall};
}

static gm_bristle at(double w, double z)
{
    gm_bristle_level level = level_at(w);
    return gm_bristle_at(&law, &level, w, z);
}

/* A body of 1e-3 kg.m2 under the load torque: velocity Verlet is not for friction, so
 * implicit in w and z by a few Newton steps each; h far below the oscillation of
 * sqrt(200/1e-3)/2pi = 71 Hz. Returns the angle travelled. */
typedef double (*load_law)(double t);

static double travel(load_law load, double from, double to, int per_second, double *start)
{
    const double J = 1e-3;
    double w = 0., z = 0., phi = 0., h = 1. / per_second;
    for (int k = 1; k <= (int)(to * per_second); k++) {
        double w_1 = w, z_1 = z;
        for (int i = 0; i < 8; i++) {
            gm_bristle b = at(w_1, z_1);
            double r_w = J * (w_1 - w) - h * (load(k * h) - b.torque);
            double r_z = z_1 - z - h * b.rate;
            double a = J + h * b.torque_speed, c = h * b.torque_state;
            double d = -h * b.rate_speed, e = 1. - h * b.rate_state;
            double det = a * e - c * d;
            w_1 -= (e * r_w - c * r_z) / det;
            z_1 -= (a * r_z - d * r_w) / det;
        }
        w = w_1, z = z_1, phi += h * w;
        if (k <= (int)(from * per_second))
            *start = phi;
    }
    return phi;
}

/* Raised slowly: the break-away torque falls with the rate at which it is reached, as
 * the bristles slide ahead of the load. */
static double constant_load(double t)
{
    return 0.97 * T_s * fmin(t / 2., 1.);
}

/* Peaks of 0.88 T_s and always above zero: LuGre without the elastic zone creeps. */
static double shaking_load(double t)
{
    return fmin(t / 0.5, 1.) * T_s * (0.58 + 0.30 * sin(2. * 3.14159265358979 * 5. * t));
}

static void holds_below_the_holding_torque(void **state)
{
    (void)state;
    double settled = 0.;
    double end = travel(constant_load, 3., 13., 1000, &settled);
    assert_true(fabs(end - settled) < 1e-6);
    assert_true(end > 0. && end < 2. * T_s / law.stiffness);
    /* start and end at the same phase of the shaking: 2 s and 12 s */
    end = travel(shaking_load, 2., 12., 10000, &settled);
    assert_true(fabs(end - settled) < 1e-6);
}

static double breaking_load(double t)
{
    return 1.05 * T_s * fmin(t / 0.5, 1.);
}

static void slips_above_the_holding_torque(void **state)
{
    (void)state;
    double settled = 0.;
    assert_true(travel(breaking_load, 0., 2., 1000, &settled) > 1.);
}

/* Break-away deflection T_s / sigma_0 = 7.5e-4 rad; a load of 0.05 N.m deflects
 * 2.5e-4 rad. */
static void deflects_like_a_spring(void **state)
{
    (void)state;
    gm_bristle_level level = level_at(0.);
    check_close("break-away", gm_bristle_steady(&law, &level, 1e-300), 7.5e-4, 1e-12);
    check_close("0.05 N.m", at(0., 2.5e-4).torque, 0.05, 1e-12);
    assert_true(at(0., 2.5e-4).rate == 0.);
}

static void settles_on_the_steady_law(void **state)
{
    (void)state;
    const double speeds[] = {-300., -1., -0.05, -0.001, 0.001, 0.05, 1., 300.};
    for (int i = 0; i < 8; i++) {
        double w = speeds[i];
        gm_bristle_level level = level_at(w);
        double z = gm_bristle_steady(&law, &level, w);
        gm_bristle b = at(w, z);
        assert_true(fabs(b.rate) <= 1e-12 * fabs(w));
        check_close("T", b.torque, copysign(level.g, w), 1e-12);
        /* and goes there from both sides */
        assert_true(b.rate_state < 0.);
        assert_true(at(w, 0.9 * z).rate * w > 0. && at(w, 1.1 * z).rate * w < 0.);
    }
}

static double rate_of_z(const void *data, double z)
{
    return at(*(const double *)data, z).rate;
}

static double torque_of_z(const void *data, double z)
{
    return at(*(const double *)data, z).torque;
}

/* Against central differences by w, whose truncation grows with the curvature of the
 * Stribeck curve: steps of 1e-5 of w, at most 1e-7 relative. */
static void derivatives_are_exact(void **state)
{
    (void)state;
    uint64_t seed = 21;
    for (int i = 0; i < 4000; i++) {
        double w = random_scale(&seed, 1e-4, 600.) * (i & 1 ? 1. : -1.);
        double z = random_between(&seed, 1e-5, 1.2e-3), h = 1e-5 * fabs(w);
        gm_bristle b = at(w, z), up = at(w + h, z), down = at(w - h, z);
        check_slope("rate(z)", rate_of_z, &w, z, b.rate_state);
        check_slope("torque(z)", torque_of_z, &w, z, b.torque_state);
        double rate_w = (up.rate - down.rate) / (2. * h);
        double torque_w = (up.torque - down.torque) / (2. * h);
        assert_true(fabs(rate_w - b.rate_speed) <= 1e-6 * (1. + fabs(rate_w)));
        assert_true(fabs(torque_w - b.torque_speed) <= 1e-6 * (1. + fabs(torque_w)));
        gm_bristle_level level = level_at(w);
        double d = 1e-6 * level.g;
        gm_bristle_level high = {level.g + d, level.d_speed},
                         low = {level.g - d, level.d_speed};
        gm_bristle above = gm_bristle_at(&law, &high, w, z),
                   below = gm_bristle_at(&law, &low, w, z);
        double rate_g = (above.rate - below.rate) / (2. * d);
        double torque_g = (above.torque - below.torque) / (2. * d);
        assert_true(fabs(rate_g - b.rate_level) <= 1e-6 * (fabs(w) + fabs(rate_g)));
        assert_true(fabs(torque_g - b.torque_level) <= 1e-6 * (1. + fabs(torque_g)));
    }
}

static void never_gives_energy_back(void **state)
{
    (void)state;
    uint64_t seed = 22;
    for (int i = 0; i < 20000; i++) {
        double w = random_scale(&seed, 1e-5, 600.) * (i & 1 ? 1. : -1.);
        double z = random_between(&seed, -3e-3, 3e-3);
        gm_bristle b = at(w, z);
        assert_true(b.loss >= 0.);
        check_close("account", b.torque * w, b.loss + law.stiffness * z * b.rate, 1e-9);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(holds_below_the_holding_torque),
        cmocka_unit_test(slips_above_the_holding_torque),
        cmocka_unit_test(deflects_like_a_spring),
        cmocka_unit_test(settles_on_the_steady_law),
        cmocka_unit_test(derivatives_are_exact),
        cmocka_unit_test(never_gives_energy_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
