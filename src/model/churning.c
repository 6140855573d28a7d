/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Gears in the oil bath, by one of three laws.
 *
 * Changenet and Velex, "A Model for the Prediction of Churning Losses in Geared
 * Transmissions", J. Mech. Des. 129 (2007):
 *   T   = 1/2 rho w^2 R_p^3 S_m C_m
 *   C_m = 1.366 (h/D_p)^0.45 (V_0/D_p^3)^0.1 Fr^-0.6 Re^-0.21       Re_c < 6000
 *   C_m = 0.239 (h/D_p)^0.45 (V_0/D_p^3)^0.1 Fr^-0.6                Re_c > 9000
 *   Fr = w^2 R_p / g,  Re = w R_p^2 / nu,  Re_c = w R_p b / nu
 *   S_m = R_p^2 (2 theta - sin 2 theta) + 2 theta R_p b,  cos theta = 1 - h/R_p
 * and linear in between. T ~ w^0.59 has no slope at w = 0: a parabola below 0.1 rad/s.
 *
 * ISO/TR 14179-1:2001, sides and teeth (kW, mm, rpm, mm2/s), A_g = 0.2, f_g the dipping
 * share of the gear, beta >= 10 degrees:
 *   P = 1.474 f_g nu n^3 D^5.7 / (A_g 1e26)
 *     + 7.37 f_g nu n^3 D^4.7 b (7.93 - 4.648/m_t) / (sqrt(tan beta) A_g 1e26)
 * For pitch line speeds up to 10 m/s, above which n^3 is far too much: from there the
 * torque goes on along its tangent.
 *
 * ISO/TR 14179-2:2001 (Mauz), hydraulic torque of a mesh by the immersion depths e of its
 * gears, at the pinion:
 *   T = C_Sp C_1 exp(C_2 v_t / v_0),  v_0 = 10 m/s, e_0 = b_0 = 10 mm
 *   C_1 = 0.063 (e_1 + e_2)/e_0 + 0.0128 (b/b_0)^3,  C_2 = (e_1 + e_2)/(80 e_0) + 0.2
 * For v_t up to 60 m/s; higher speeds count as 60. The law has a torque at rest, where
 * oil does not hold: below 1 m/s it is led to zero by a smoothstep.
 */
#include "model/drag.h"

#include "model/power.h"

#include <math.h>

static const double gravity = 9.81;      /* m/s2 */
static const double rpm = 30. / GM_PI;   /* per rad/s */
static const double small_speed = 0.1;   /* rad/s, see power.h */
static const double laminar_end = 6000.; /* Re_c */
static const double turbulent_start = 9000.;
static const double square_end = 10.;                    /* m/s, of ISO/TR 14179-1 */
static const double splash_start = 1., splash_end = 60.; /* m/s, of ISO/TR 14179-2 */

/* S_m */
static double wetted_area(const gm_dip *dip, double h)
{
    double R = dip->R_p, theta = acos(1. - h / R);
    return R * R * (2. * theta - sin(2. * theta)) + 2. * theta * R * dip->b;
}

gm_speed_torque gm_churning_torque(const gm_dip *dip, const gm_oil *oil, double w)
{
    double R = dip->R_p, D = 2. * R, h = fmin(dip->h, D);
    if (!(h > 0.))
        return (gm_speed_torque){0., 0.};
    /* Powers of w apart: w^2 Fr^-0.6 ~ w^0.8, with Re^-0.21 ~ w^0.59. */
    double common = 0.5 * oil->rho * R * R * R * wetted_area(dip, h) * pow(h / D, 0.45) *
                    pow(dip->V_0 / (D * D * D), 0.1) * pow(R / gravity, -0.6);
    double laminar = 1.366 * pow(R * R / oil->nu, -0.21);
    gm_power slow = gm_power_from_zero(w, 0.59, small_speed);
    gm_power fast = gm_power_from_zero(w, 0.80, small_speed);
    slow = (gm_power){common * laminar * slow.value, common * laminar * slow.slope};
    fast = (gm_power){common * 0.239 * fast.value, common * 0.239 * fast.slope};
    double per_w = R * dip->b / oil->nu, width = turbulent_start - laminar_end;
    double t = (per_w * w - laminar_end) / width;
    if (t <= 0.)
        return (gm_speed_torque){slow.value, slow.slope};
    if (t >= 1.)
        return (gm_speed_torque){fast.value, fast.slope};
    return (gm_speed_torque){slow.value + t * (fast.value - slow.value),
                             slow.slope + t * (fast.slope - slow.slope) +
                                 per_w / width * (fast.value - slow.value)};
}

gm_iso_churning gm_churning_iso14179_1(const gm_dip *dip, const gm_oil *oil)
{
    const double A_g = 0.2, least_beta = 10. * GM_PI / 180.;
    double D = 2e3 * dip->R_a, b = 1e3 * dip->b, m_t = 1e3 * dip->m_t; /* mm */
    double f_g = fmin(fmax(dip->h / (2. * dip->R_a), 0.), 1.);
    double R_f = fmax(7.93 - 4.648 / m_t, 0.);
    double tan_beta = tan(fmax(dip->beta, least_beta));
    /* kW = factor n^3; T = P / w in N.m = 1e3 factor rpm^3 w^2 */
    double common = 1e3 * rpm * rpm * rpm * f_g * 1e6 * oil->nu / (A_g * 1e26);
    return (gm_iso_churning){.sides = 1.474 * common * pow(D, 5.7),
                             .teeth =
                                 7.37 * common * pow(D, 4.7) * b * R_f / sqrt(tan_beta)};
}

gm_speed_torque gm_churning_torque_iso14179_1(const gm_dip *dip, const gm_oil *oil,
                                              double w)
{
    gm_iso_churning k = gm_churning_iso14179_1(dip, oil);
    double square = k.sides + k.teeth, w_end = square_end / dip->R_p;
    if (w <= w_end)
        return (gm_speed_torque){square * w * w, 2. * square * w};
    return (gm_speed_torque){square * w_end * (2. * w - w_end), 2. * square * w_end};
}

gm_speed_torque gm_splash_torque(const gm_splash *splash, double w)
{
    double e = splash->depth / 10e-3, b = splash->b / 10e-3;
    if (!(e > 0.))
        return (gm_speed_torque){0., 0.};
    double C_1 = 0.063 * e + 0.0128 * b * b * b, C_2 = e / 80. + 0.2;
    double v = splash->r_w * w, rate = v < splash_end ? C_2 / 10. * splash->r_w : 0.;
    double T = splash->guidance * C_1 * exp(C_2 * fmin(v, splash_end) / 10.);
    double t = v / splash_start;
    if (t >= 1.)
        return (gm_speed_torque){T, T * rate};
    double s = t * t * (3. - 2. * t);
    double ds = 6. * t * (1. - t) * splash->r_w / splash_start;
    return (gm_speed_torque){T * s, T * (s * rate + ds)};
}
