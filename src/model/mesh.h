/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Involute gear pair: geometry in the transverse plane (pair.c) and load-dependent loss
 * (mesh.c).
 */
#ifndef MESH_H
#define MESH_H

#include "model/oil.h"

/** One pair of cylindrical gears; lengths in m, angles in rad. Index 0 and 1 as given.
 *  All diameters and the centre distance are magnitudes, also those of a ring; z and x
 *  keep the signs of ISO 21771 (a ring has z < 0). */
typedef struct gm_pair {
    int z[2];
    double m_n, alpha_n, beta; /* beta >= 0 here: the magnitude */
    double x[2];
    double b; /* common face width */
    double m_t, alpha_t, beta_b;
    double d[2], d_b[2], d_w[2], d_a[2];
    double a_w; /* working centre distance */
    double alpha_wt;
    double eps[2], eps_alpha, eps_beta; /* tip contact ratios, ISO/TR 14179-2 notation */
} gm_pair;

/** Geometry of a pair. a_w <= 0: from the profile shifts; else the given working centre
 *  distance. Tip height factor 1, no tip shortening. One z may be < 0: internal ring.
 *  Where the flanks cannot meet (a_w shorter than the base circles allow, or profile
 *  shifts that leave no working pressure angle), a_w computed, alpha_wt, d_w and eps are
 *  NAN. z[0] + z[1] must not be 0. */
gm_pair gm_pair_make(const int z[2], double m_n, double alpha_n, double beta,
                     const double x[2], double b, double a_w);

/** Ohlendorf's loss factor H_V, the same whichever gear drives. Exact for constant mu and
 *  1 <= eps_alpha <= 2; > 0 for every pair that meets. */
double gm_pair_loss_factor(const gm_pair *pair);

/** Equivalent radius of curvature at the pitch point rho_redC [m], ISO/TR 14179-2. */
double gm_pair_curvature(const gm_pair *pair);

/** ISO/TR 14179-1: mesh mechanical advantage M over cos^2 beta_w, > 0. */
double gm_pair_advantage(const gm_pair *pair);

/** A mesh's loss law, ready for evaluation. Fields of other models are 0. */
typedef struct gm_mesh_law {
    gm_mesh_loss_model model;
    double constant;      /* constant: loss share 1 - eta */
    double idle_force;    /* torque dependent: idle torque / base radius, N */
    double torque_share;  /* torque dependent: of the force that enters */
    double H_V;           /* temperature dependent, Schlenk and Ohlendorf: */
    double factor;        /* mu at F_bt = 1 N and v_SigmaC = 1 m/s */
    double sliding_ratio; /* v_SigmaC / v_t = 2 sin(alpha_wt) */
    double minimum_force; /* F_bt below which mu stays constant, N */
    double share_1;       /* ISO/TR 14179-1: share at K = 1 N/mm2, v_t = 1 m/s; 0: not
                             chosen */
    double K_per_force;   /* K factor per newton of F_bt, 1/mm2 */
} gm_mesh_law;

/** roughness: mean Ra of both flanks [m], 0.1e-6 to 2e-6. The pair must be one that
 *  meets, with b > 0. */
gm_mesh_law gm_mesh_law_make(const gm_mesh *mesh, const gm_pair *pair, double roughness,
                             const gm_oil *oil);

/** Below this sum speed v_SigmaC friction is that of the boundary regime: a kink of the
 *  loss over speed [m/s]. */
#define GM_MESH_MIN_SLIDING_SPEED 0.2

/** Friction force along the line of action [N], >= 0: half of it adds to the force F_bt
 *  on the driving gear, half is missing at the driven one. */
typedef struct gm_mesh_force {
    double value;
    double d_force; /* by F_bt */
    double d_speed; /* by v_t, N.s/m */
} gm_mesh_force;

/** Friction at transverse base-tangent force F_bt >= 0 [N], the mean of what enters and
 *  leaves, and pitch-line speed v_t >= 0 [m/s]. The loss power is its value times
 *  v_t cos(alpha_wt). */
gm_mesh_force gm_mesh_law_force(const gm_mesh_law *law, double F_bt, double v_t);

typedef struct gm_mesh_share {
    double kappa; /* loss as a share of the power that enters the mesh, 0 <= kappa < 1 */
    double d_force; /* d kappa / dF_bt, 1/N */
    double d_speed; /* d kappa / d v_t, s/m */
} gm_mesh_share;

/** Loss share of the constant and temperature dependent models at F_bt >= 0 [N] and
 *  v_t >= 0 [m/s]. iso14179_2: mu H_V with Schlenk's mu; v_SigmaC >= 0.2 m/s and
 *  mu <= 0.12: boundary friction at standstill; v_t <= 50 m/s; F_bt/b >= minimum line
 *  load. Continuous; the derivatives are exact on each side of the limits. */
gm_mesh_share gm_mesh_loss_share(const gm_mesh_law *law, double F_bt, double v_t);

/** Schlenk's coefficient of friction alone, in the standard's units: F_bt/b [N/mm],
 *  v_sigma_c [m/s], rho_red [mm], eta [mPa.s], Ra [um]. No limits applied. */
double gm_schlenk_mu(double line_load, double v_sigma_c, double rho_red, double eta,
                     double Ra, double X_L);

/** Mesh coefficient of friction f_m of ISO/TR 14179-1: nu [mm2/s], K [N/mm2], v_t [m/s].
 *  No limits applied. */
double gm_iso14179_1_f_m(double nu, double K, double v_t);

#endif
