/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Load-dependent loss of a gear mesh as a share of the power that enters it.
 *
 *   P_VZP = |P_A| mu_mz H_V                                      ISO/TR 14179-2:2001
 *   mu_mz = 0.048 ((F_bt/b) / (v_SigmaC rho_redC))^0.2 eta^-0.05 Ra^0.25 X_L   (Schlenk)
 *   v_SigmaC = 2 v_t sin alpha_wt
 *
 * Mixed units of the standard: F_bt/b in N/mm, rho_redC in mm, eta in mPa.s, Ra in um.
 * Valid for v_t <= 50 m/s (higher speeds count as 50), Ra 0.1 to 2 um, and F_bt/b above
 * a minimum line load (150 N/mm in the standard) below which mu stays constant.
 * Towards standstill the film goes and mu would grow without bound: v_SigmaC counts as
 * at least 0.2 m/s and mu is at most 0.12, the coefficient of boundary friction.
 */
#include "model/mesh.h"

#include "model/power.h"

#include <math.h>

static const double exponent = 0.2;
static const double max_pitch_speed = 50.; /* m/s */
static const double max_mu = 0.12;
static const double small_force = 1.; /* N, see power.h */

double gm_schlenk_mu(double line_load, double v_sigma_c, double rho_red, double eta,
                     double Ra, double X_L)
{
    return 0.048 * pow(line_load / (v_sigma_c * rho_red), exponent) * pow(eta, -0.05) *
           pow(Ra, 0.25) * X_L;
}

gm_mesh_law gm_mesh_law_make(const gm_mesh *mesh, const gm_pair *pair, double roughness,
                             const gm_oil *oil)
{
    gm_mesh_law law = {.model = mesh->loss};
    if (mesh->loss == GM_MESH_CONSTANT) {
        law.constant = 1. - mesh->efficiency;
        return law;
    }
    law.H_V = gm_pair_loss_factor(pair);
    law.sliding_ratio = 2. * sin(pair->alpha_wt);
    law.minimum_force = mesh->minimum_line_load * pair->b;
    /* mu is a product of powers: its value at 1 N and 1 m/s is all that is constant. */
    law.factor =
        gm_schlenk_mu(1. / (1e3 * pair->b), 1., 1e3 * gm_pair_curvature(pair),
                      1e3 * oil->eta, 1e6 * roughness, oil->mesh_lubricant_factor);
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

gm_mesh_share gm_mesh_loss_share(const gm_mesh_law *law, double F_bt, double v_t)
{
    if (law->model == GM_MESH_CONSTANT)
        return (gm_mesh_share){law->constant, 0., 0.};
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
