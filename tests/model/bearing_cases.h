/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Bearings for the tests of both friction models, and the laws of a random point that
 * every friction model has to keep.
 */
#ifndef BEARING_CASES_H
#define BEARING_CASES_H

#include "property.h"

#include "model/bearing.h"
#include "model/power.h"

#include <string.h>

static const double rpm = GM_PI / 30.;

static inline gm_bearing_law bearing_in_oil(gm_bearing_data data, double nu,
                                            double mu_EHL)
{
    gm_oil oil = {.nu = 1e-6 * nu, .bearing_mu_ehl = mu_EHL};
    gm_bearing_law law;
    gm_error error = {0};
    if (gm_bearing_law_make(&data, &oil, &law, &error) != GM_OK)
        fail_msg("%s", error.message);
    return law;
}

/* A bearing of medium size of each type; C0 and Y typical of the size. */
static inline gm_bearing_data bearing_of(gm_bearing_type type,
                                         gm_bearing_friction_model friction)
{
    static const char *const series[] = {"62", "72xx BECBP", "2", "", "302"};
    gm_bearing_data data = {.type = type,
                            .friction = friction,
                            .d = 30e-3,
                            .D = 62e-3,
                            .B = 16e-3,
                            .C0 = 16000.,
                            .Y = 1.6,
                            .f0 = (double)NAN,
                            .f1 = (double)NAN};
    strcpy(data.series, series[type]);
    return data;
}

typedef struct bearing_point {
    gm_bearing_law law;
    double w, F_r, F_a;
} bearing_point;

static inline gm_bearing_torque torque_at(const bearing_point *p)
{
    gm_bearing_speed speed = gm_bearing_at_speed(&p->law, p->w);
    return gm_bearing_friction(&p->law, &speed, p->F_r, p->F_a);
}

static inline double torque_of_w(const void *data, double w)
{
    bearing_point p = *(const bearing_point *)data;
    p.w = w;
    return torque_at(&p).value;
}

static inline double torque_of_F_r(const void *data, double F_r)
{
    bearing_point p = *(const bearing_point *)data;
    p.F_r = F_r;
    return torque_at(&p).value;
}

static inline double torque_of_F_a(const void *data, double F_a)
{
    bearing_point p = *(const bearing_point *)data;
    p.F_a = F_a;
    return torque_at(&p).value;
}

static inline bearing_point
random_bearing(gm_bearing_type type, gm_bearing_friction_model friction, uint64_t *seed)
{
    gm_bearing_data data = bearing_of(type, friction);
    data.d = random_between(seed, 10e-3, 80e-3);
    data.D = data.d + random_between(seed, 10e-3, 60e-3);
    data.C0 = random_scale(seed, 2e3, 1e5);
    double nu = random_scale(seed, 4., 1000.);
    bearing_point p = {.law = bearing_in_oil(data, nu, random_between(seed, .02, .1))};
    p.w = random_scale(seed, 1e-4, 1500.);
    /* beyond the valid range too: a solver may pass there */
    p.F_r = random_unit(seed) < 0.1 ? 0. : random_scale(seed, 1e-3, 3e5);
    p.F_a = random_unit(seed) < 0.1 ? 0. : random_scale(seed, 1e-3, 3e5);
    return p;
}

static inline void check_derivatives(gm_bearing_friction_model friction, int n)
{
    uint64_t seed = 7;
    for (int i = 0; i < n; i++) {
        bearing_point p = random_bearing((gm_bearing_type)(i % 5), friction, &seed);
        gm_bearing_torque M = torque_at(&p);
        assert_true(M.value >= 0. && isfinite(M.value));
        check_slope("M(w)", torque_of_w, &p, p.w, M.d_speed);
        if (p.F_r > 0.)
            check_slope("M(F_r)", torque_of_F_r, &p, p.F_r, M.d_radial);
        if (p.F_a > 0.)
            check_slope("M(F_a)", torque_of_F_a, &p, p.F_a, M.d_axial);
    }
}

static inline void check_no_jumps(gm_bearing_friction_model friction, int n)
{
    uint64_t seed = 8;
    for (int i = 0; i < n; i++) {
        bearing_point p = random_bearing((gm_bearing_type)(i % 5), friction, &seed);
        check_continuous("M(w)", torque_of_w, &p, 1e-6, 3000.);
        check_continuous("M(F_r)", torque_of_F_r, &p, 1e-6, 1e6);
        check_continuous("M(F_a)", torque_of_F_a, &p, 1e-6, 1e6);
    }
}

/* At rest and without load everything is finite and is the limit from above. */
static inline void check_limits_at_zero(gm_bearing_friction_model friction)
{
    uint64_t seed = 9;
    for (int i = 0; i < 200; i++) {
        bearing_point p = random_bearing((gm_bearing_type)(i % 5), friction, &seed);
        bearing_point q = p;
        p.w = (i & 8) ? 0. : p.w;
        p.F_r = (i & 16) ? 0. : p.F_r;
        p.F_a = (i & 32) ? 0. : p.F_a;
        gm_bearing_torque M = torque_at(&p);
        assert_true(isfinite(M.value) && isfinite(M.d_speed) && isfinite(M.d_radial) &&
                    isfinite(M.d_axial));
        q.w = p.w > 0. ? p.w : 1e-9;
        q.F_r = p.F_r > 0. ? p.F_r : 1e-9;
        q.F_a = p.F_a > 0. ? p.F_a : 1e-9;
        /* 1e-9 times the slopes, twice for curvature; powers such as 1e-9^1.4 and
         * rounding of M beside it */
        double slopes = fabs(M.d_speed) + fabs(M.d_radial) + fabs(M.d_axial);
        double tolerance = 2e-9 * slopes + 1e-12 * (1. + M.value);
        assert_true(fabs(torque_at(&q).value - M.value) <= tolerance);
    }
}

#endif
