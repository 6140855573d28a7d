/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Load-dependent loss of a gear mesh, as a share kappa of the power that enters it or as
 * a torque.
 *
 * constant               kappa = 1 - eta
 * torque_dependent       T_loss = T_0 + c |T|, T_0 at the first gear, T what enters
 * temperature_dependent  by a standard, with the viscosity at the oil's temperature:
 *
 * ISO/TR 14179-2:2001 (Niemann and Winter; Ohlendorf; Schlenk)
 *   kappa = mu_mz H_V
 *   mu_mz = 0.048 ((F_bt/b) / (v_SigmaC rho_redC))^0.2 eta^-0.05 Ra^0.25 X_L
 *   v_SigmaC = 2 v_t sin alpha_wt
 * F_bt/b in N/mm, rho_redC in mm, eta in mPa.s, Ra in um. Valid for v_t <= 50 m/s (higher
 * speeds count as 50), Ra 0.1 to 2 um, and F_bt/b above a minimum line load (150 N/mm in
 * the standard) below which mu stays constant. Towards standstill the film goes and mu
 * would grow without bound: v_SigmaC counts as at least 0.2 m/s and mu is at most 0.12,
 * the coefficient of boundary friction.
 *
 * ISO/TR 14179-1:2001 (AGMA)
 *   kappa = f_m cos^2 beta_w / M,   f_m = nu^-0.223 K^-0.40 / (3.239 v_t^0.70)
 *   M = 2 cos alpha_wt (H_s + H_t) / (H_s^2 + H_t^2)
 *   H_s = (u + 1) (sqrt(r_o2^2/r_w2^2 - cos^2 alpha_wt) - sin alpha_wt)
 *   H_t = (u + 1)/u (sqrt(r_o1^2/r_w1^2 - cos^2 alpha_wt) - sin alpha_wt)
 *   K = T_1 (z_1 + z_2) / (2 b r_w1^2 z_2)
 * nu in mm2/s, K in N/mm2, v_t in m/s; 1: pinion. For a ring u < 0 gives the standard's
 * formulas of internal gears. Valid for 2 <= v_t <= 25 m/s and 1.4 <= K <= 14 N/mm2:
 * there as it stands; from there to half of the lower and twice the upper limits blended
 * to ISO/TR 14179-2, which alone counts outside.
 */
#include "model/mesh.h"

#include "model/power.h"

#include <math.h>

static const double exponent = 0.2;
static const double max_pitch_speed = 50.; /* m/s */
static const double max_mu = 0.12;
static const double small_force = 1.; /* N, see power.h */

/* Range of ISO/TR 14179-1. */
static const double low_speed = 2., high_speed = 25.; /* m/s */
static const double low_K = 1.4, high_K = 14.;        /* N/mm2 */

double gm_schlenk_mu(double line_load, double v_sigma_c, double rho_red, double eta,
                     double Ra, double X_L)
{
    return 0.048 * pow(line_load / (v_sigma_c * rho_red), exponent) * pow(eta, -0.05) *
           pow(Ra, 0.25) * X_L;
}

double gm_iso14179_1_f_m(double nu, double K, double v_t)
{
    return pow(nu, -0.223) * pow(K, -0.4) / (3.239 * pow(v_t, 0.7));
}

static void make_iso14179_2(gm_mesh_law *law, const gm_mesh *mesh, const gm_pair *pair,
                            double roughness, const gm_oil *oil)
{
    law->H_V = gm_pair_loss_factor(pair);
    law->sliding_ratio = 2. * sin(pair->alpha_wt);
    law->minimum_force = mesh->minimum_line_load * pair->b;
    /* mu is a product of powers: its value at 1 N and 1 m/s is all that is constant. */
    law->factor =
        gm_schlenk_mu(1. / (1e3 * pair->b), 1., 1e3 * gm_pair_curvature(pair),
                      1e3 * oil->eta, 1e6 * roughness, oil->mesh_lubricant_factor);
}

static void make_iso14179_1(gm_mesh_law *law, const gm_pair *pair, const gm_oil *oil)
{
    int pinion = pair->z[0] > 0 && (pair->z[1] < 0 || pair->z[0] <= pair->z[1]) ? 0 : 1;
    double z_1 = pair->z[pinion], z_2 = pair->z[1 - pinion];
    double r_w = 0.5e3 * pair->d_w[pinion], r_b = 0.5e3 * pair->d_b[pinion]; /* mm */
    law->share_1 = gm_iso14179_1_f_m(1e6 * oil->nu, 1., 1.) / gm_pair_advantage(pair);
    law->K_per_force = r_b * fabs((z_1 + z_2) / z_2) / (2. * 1e3 * pair->b * r_w * r_w);
}

gm_mesh_law gm_mesh_law_make(const gm_mesh *mesh, const gm_pair *pair, double roughness,
                             const gm_oil *oil)
{
    gm_mesh_law law = {.model = mesh->loss};
    switch (mesh->loss) {
    case GM_MESH_CONSTANT:
        law.constant = 1. - mesh->efficiency;
        break;
    case GM_MESH_TORQUE_DEPENDENT:
        law.idle_force = 2. * mesh->idle_torque / pair->d_b[0];
        law.torque_share = mesh->torque_share;
        break;
    case GM_MESH_TEMPERATURE_DEPENDENT:
        make_iso14179_2(&law, mesh, pair, roughness, oil);
        if (mesh->method == GM_MESH_ISO14179_1)
            make_iso14179_1(&law, pair, oil);
        break;
    }
    return law;
}

/* v_SigmaC within its limits, and its derivative by v_t. */
static gm_power sliding_speed(const gm_mesh_law *law, double v_t)
{
    if (v_t >= max_pitch_speed)
        return (gm_power){law->sliding_ratio * max_pitch_speed, 0.};
    double v = law->sliding_ratio * v_t;
    if (v <= GM_MESH_MIN_SLIDING_SPEED)
        return (gm_power){GM_MESH_MIN_SLIDING_SPEED, 0.};
    return (gm_power){v, law->sliding_ratio};
}

static gm_mesh_share share_by_schlenk(const gm_mesh_law *law, double F_bt, double v_t)
{
    gm_power v = sliding_speed(law, v_t);
    double force = fmax(F_bt, law->minimum_force);
    /* F^0.2 v^-0.2 by one power, small_force in the same measure. */
    gm_power load = gm_power_from_zero(force / v.value, exponent, small_force / v.value);
    double mu = law->factor * load.value;
    if (mu >= max_mu)
        return (gm_mesh_share){max_mu * law->H_V, 0., 0.};
    double d_force = law->factor * law->H_V * load.slope / v.value;
    double kappa = mu * law->H_V;
    return (gm_mesh_share){kappa, F_bt >= law->minimum_force ? d_force : 0.,
                           -exponent * kappa / v.value * v.slope};
}

/* 0 below a, 1 above b > a. */
static gm_power smoothstep(double x, double a, double b)
{
    double t = (x - a) / (b - a);
    if (t <= 0.)
        return (gm_power){0., 0.};
    if (t >= 1.)
        return (gm_power){1., 0.};
    return (gm_power){t * t * (3. - 2. * t), 6. * t * (1. - t) / (b - a)};
}

/* 1 from low to high, 0 below half of low and above twice high. */
static gm_power within(double x, double low, double high)
{
    gm_power up = smoothstep(x, 0.5 * low, low), down = smoothstep(x, high, 2. * high);
    return (gm_power){up.value - down.value, up.slope - down.slope};
}

/* *share moved towards ISO/TR 14179-1 as far as that is valid. */
static void blend_iso14179_1(const gm_mesh_law *law, double F_bt, double v_t,
                             gm_mesh_share *share)
{
    double K = law->K_per_force * F_bt;
    gm_power by_v = within(v_t, low_speed, high_speed), by_K = within(K, low_K, high_K);
    if (by_v.value * by_K.value == 0.)
        return;
    double kappa = law->share_1 * pow(K, -0.4) * pow(v_t, -0.7);
    double more = kappa - share->kappa, weight = by_v.value * by_K.value;
    share->kappa += weight * more;
    share->d_force += weight * (-0.4 * kappa / F_bt - share->d_force) +
                      by_v.value * by_K.slope * law->K_per_force * more;
    share->d_speed +=
        weight * (-0.7 * kappa / v_t - share->d_speed) + by_v.slope * by_K.value * more;
}

gm_mesh_share gm_mesh_loss_share(const gm_mesh_law *law, double F_bt, double v_t)
{
    if (law->model == GM_MESH_CONSTANT)
        return (gm_mesh_share){law->constant, 0., 0.};
    gm_mesh_share share = share_by_schlenk(law, F_bt, v_t);
    if (law->share_1 > 0.)
        blend_iso14179_1(law, F_bt, v_t, &share);
    return share;
}

/* With f the friction force, F + f/2 enters and F - f/2 leaves: a share kappa of what
 * enters is f = kappa F / (1 - kappa/2). */
gm_mesh_force gm_mesh_law_force(const gm_mesh_law *law, double F_bt, double v_t)
{
    if (law->model == GM_MESH_TORQUE_DEPENDENT) {
        double q = 2. / (2. - law->torque_share);
        return (gm_mesh_force){q * (law->idle_force + law->torque_share * F_bt),
                               q * law->torque_share, 0.};
    }
    gm_mesh_share s = gm_mesh_loss_share(law, F_bt, v_t);
    double q = 2. / (2. - s.kappa);
    return (gm_mesh_force){F_bt * s.kappa * q, s.kappa * q + F_bt * s.d_force * q * q,
                           F_bt * s.d_speed * q * q};
}
