/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Geometry of an involute cylindrical gear pair in the transverse plane, ISO 21771:2007.
 *
 *   m_t = m_n / cos beta,  tan alpha_t = tan alpha_n / cos beta,
 *   sin beta_b = sin beta cos alpha_n
 *   d = m_t z,  d_b = d cos alpha_t,  a = (d_1 + d_2) / 2
 *   cos alpha_wt = a cos alpha_t / a_w                            a_w given, or
 *   inv alpha_wt = inv alpha_t + 2 tan alpha_n (x_1 + x_2) / (z_1 + z_2)
 *   d_w = d_b / cos alpha_wt,  d_a = d + 2 m_n (1 + x)
 *   eps_i = z_i (tan alpha_a,i - tan alpha_wt) / (2 pi),  cos alpha_a = d_b / d_a
 *
 * A ring has z < 0; then its diameters, and a, are negative in these formulas. The
 * struct keeps magnitudes, as everything that uses it measures lengths.
 * Tip interference of rings is not looked at.
 */
#include "model/mesh.h"

#include "model/power.h"

#include <math.h>
#include <stdlib.h>

static double involute(double angle)
{
    return tan(angle) - angle;
}

/* The angle whose involute is given, by Newton: inv' = tan^2. The function is convex,
 * so that from the right the iteration falls monotonically; the start value is the lower
 * of two upper bounds, inv >= angle^3 / 3 and tan angle <= inv + pi / 2. */
static double inverse_involute(double inv)
{
    if (!(inv >= 0.))
        return (double)NAN;
    double angle = fmin(cbrt(3. * inv), atan(inv + 0.5 * GM_PI));
    for (int i = 0; i < 50; i++) {
        double t = tan(angle);
        double step = t > 0. ? (t - angle - inv) / (t * t) : 0.;
        angle -= step;
        if (fabs(step) <= 4e-16 * angle)
            break;
    }
    return angle;
}

/* Transverse working pressure angle; NAN when the flanks cannot meet. */
static double working_angle(const gm_pair *pair, double a_w)
{
    int sum = pair->z[0] + pair->z[1];
    if (a_w > 0.) {
        double a = 0.5 * pair->m_t * abs(sum);
        double c = a * cos(pair->alpha_t) / a_w;
        return c <= 1. ? acos(c) : (double)NAN;
    }
    double shift = 2. * tan(pair->alpha_n) * (pair->x[0] + pair->x[1]) / sum;
    return inverse_involute(involute(pair->alpha_t) + shift);
}

/* Part of the contact ratio between the pitch point and the tip of gear i. A ring's tip
 * inside its base circle has no involute: the flank then ends at the base circle. */
static double tip_contact_ratio(const gm_pair *pair, int i)
{
    double ratio = fmin(pair->d_b[i] / pair->d_a[i], 1.);
    return pair->z[i] * (tan(acos(ratio)) - tan(pair->alpha_wt)) / (2. * GM_PI);
}

static void fill_wheel(gm_pair *pair, int i)
{
    double side = pair->z[i] < 0 ? -1. : 1.;
    pair->d[i] = pair->m_t * abs(pair->z[i]);
    pair->d_b[i] = pair->d[i] * cos(pair->alpha_t);
    pair->d_w[i] = pair->d_b[i] / cos(pair->alpha_wt);
    pair->d_a[i] = pair->d[i] + side * 2. * pair->m_n * (1. + pair->x[i]);
    pair->eps[i] = tip_contact_ratio(pair, i);
}

gm_pair gm_pair_make(const int z[2], double m_n, double alpha_n, double beta,
                     const double x[2], double b, double a_w)
{
    gm_pair pair = {.z = {z[0], z[1]},
                    .m_n = m_n,
                    .alpha_n = alpha_n,
                    .beta = fabs(beta),
                    .x = {x[0], x[1]},
                    .b = b};
    pair.m_t = m_n / cos(pair.beta);
    pair.alpha_t = atan(tan(alpha_n) / cos(pair.beta));
    pair.beta_b = asin(sin(pair.beta) * cos(alpha_n));
    pair.alpha_wt = working_angle(&pair, a_w);
    fill_wheel(&pair, 0);
    fill_wheel(&pair, 1);
    double a = 0.5 * pair.m_t * abs(z[0] + z[1]);
    pair.a_w = a_w > 0. ? a_w : a * cos(pair.alpha_t) / cos(pair.alpha_wt);
    pair.eps_alpha = pair.eps[0] + pair.eps[1];
    double p_bt = GM_PI * pair.m_t * cos(pair.alpha_t);
    pair.eps_beta = b * tan(pair.beta_b) / p_bt;
    return pair;
}

/* H_V = pi (u + 1) / (z_1 u cos beta_b) (1 - eps_alpha + eps_1^2 + eps_2^2), Ohlendorf
 * 1958, ISO/TR 14179-2:2001. (u + 1) / (z_1 u) is 1/z_1 + 1/z_2. */
double gm_pair_loss_factor(const gm_pair *pair)
{
    double e0 = pair->eps[0], e1 = pair->eps[1];
    double teeth = 1. / pair->z[0] + 1. / pair->z[1];
    return GM_PI * fabs(teeth) / cos(pair->beta_b) * (1. - e0 - e1 + e0 * e0 + e1 * e1);
}

/* rho_redC = d_w1 sin alpha_wt u / (2 cos beta_b (u + 1)); with d_w2 = u d_w1 the factor
 * d_w1 u / (u + 1) is 1 / (1/d_w1 + 1/d_w2), d_w < 0 for a ring. */
double gm_pair_curvature(const gm_pair *pair)
{
    double c0 = (pair->z[0] < 0 ? -1. : 1.) / pair->d_w[0];
    double c1 = (pair->z[1] < 0 ? -1. : 1.) / pair->d_w[1];
    return 0.5 * sin(pair->alpha_wt) / (cos(pair->beta_b) * fabs(c0 + c1));
}

/* H_s and H_t of ISO/TR 14179-1 (see mesh.c), i the gear whose tip ends the contact:
 * (1 + z_i / z_other) (...) is both of its formulas, with z < 0 for a ring. */
static double contact_end(const gm_pair *pair, int i)
{
    double c = cos(pair->alpha_wt), tip = pair->d_a[i] / pair->d_w[i];
    double share = 1. + (double)pair->z[i] / pair->z[1 - i];
    return share * (sqrt(fmax(tip * tip - c * c, 0.)) - sin(pair->alpha_wt));
}

double gm_pair_advantage(const gm_pair *pair)
{
    double H_s = contact_end(pair, 1), H_t = contact_end(pair, 0);
    double M = 2. * cos(pair->alpha_wt) * (H_s + H_t) / (H_s * H_s + H_t * H_t);
    double t = tan(pair->beta) * pair->d_w[0] / pair->d[0]; /* tan beta_w */
    return M * (1. + t * t);
}
