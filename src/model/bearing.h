/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Bearing friction: one entry for all models, SKF (bearing_skf.c), Palmgren
 * (bearing_palmgren.c), and those by given numbers, Coulomb, elastic and hydrodynamic
 * (bearing_sliding.c). What depends on speed alone is computed once per speed and used
 * for every load.
 *
 * SKF adds the contact seals of a capped bearing and the drag of one that dips into the
 * oil (bearing_bath.c). Radial shaft seals are parts of their own (drag.h).
 */
#ifndef BEARING_H
#define BEARING_H

#include "model/bristle.h"
#include "model/friction.h"
#include "model/oil.h"

/** What the SKF model needs of one bearing in one oil, powers taken; mixed units of the
 *  catalogue (N, mm, rpm, mm2/s). Fields of other types are 0. */
typedef struct gm_skf {
    double k_rr;       /* R_1 d_m^p */
    double k_rr_axial; /* weight of F_a in the rolling load: R_2, tapered R_2 Y */
    double k_sl;       /* S_1 d_m^p; deep groove ball: at F_a = 0 */
    double
        k_sl_axial; /* weight of F_a in the sliding load; deep groove ball: S_2 d_m^1.5 */
    double k_sl_both; /* deep groove ball: S_1 d_m^-0.145, at F_a > 0 */
    double F_g_rr;    /* angular contact: R_3 d_m^4, centrifugal load by n^2 */
    double F_g_sl;    /* angular contact: S_3 d_m^4 */
    double F_small;   /* deep groove ball: below, F_a / sin alpha_F is a parabola ... */
    double small[2];  /* ... small[0] F_a + small[1] F_a^2 */
    double ish;       /* inlet shear heating: 1.84e-9 d_m^1.28 nu^0.64 */
    double rs;        /* starvation: K_rs nu (d + D) sqrt(K_Z / (2 (D - d))) */
    double bl;        /* boundary lubrication: 2.6e-8 d_m nu^1.4 */
    double mu_EHL;
    double seals;    /* contact seals of a capped bearing, N.mm */
    double K_Z, K_L; /* geometry constants of the drag in the oil bath */
} gm_skf;

/** SKF drag in the oil bath: M = flow n^2 + viscous n^0.621 [N.mm, n in rpm]. */
typedef struct gm_skf_bath {
    double flow, viscous;
} gm_skf_bath;

/** What the Palmgren model needs, in N, N.mm, mm2/s, rpm. */
typedef struct gm_palmgren {
    double viscous;        /* 1e-7 f_0 d_m^3 */
    double load, exponent; /* M_1 = load P_1 (P_0 / C_0)^exponent */
    double axial;          /* f_2 d_m */
} gm_palmgren;

/** What the models by given numbers need (bearing_sliding.c). */
typedef struct gm_sliding {
    double torque, lever;                 /* while sliding: torque + lever F, N.m, m */
    double torque_at_rest, lever_at_rest; /* at rest */
    double stribeck;                      /* w_s, rad/s */
    double viscous;                       /* N.m.s/rad */
} gm_sliding;

/** A bearing ready for evaluation: its data, its constants and its oil. Constants of
 *  other models are 0. */
typedef struct gm_bearing_law {
    gm_bearing_data data;
    double nu; /* mm2/s */
    gm_skf skf;
    gm_palmgren palmgren;
    gm_skf_bath bath; /* zero: above the oil */
    gm_sliding sliding;
    gm_bristle_law bristle; /* elastic */
} gm_bearing_law;

/** Factors at one speed w [rad/s]; d_ are derivatives by w. */
typedef struct gm_bearing_speed {
    double w;                  /* >= 0 */
    double rolling, d_rolling; /* SKF: phi_ish phi_rs (nu n)^0.6; Palmgren: M_0 [N.mm];
                                  hydrodynamic, elastic: viscous torque, Coulomb: that
                                  of its table [N.m] */
    double sliding, d_sliding; /* SKF: mu_sl; hydrodynamic, elastic: Stribeck share */
    double drag, d_drag;       /* SKF: in the oil bath [N.mm] */
    double F_g_rr, d_F_g_rr;   /* SKF angular contact: centrifugal load [N], rolling */
    double F_g_sl, d_F_g_sl;   /* and sliding */
} gm_bearing_speed;

/** Look up designation and series constants, defaults of the type. A designation, where
 *  given, decides over the dimensions. GM_ERR_MODEL with a sentence (without file and
 *  line: the caller adds them) when the designation or series is unknown or a number
 *  that the friction model needs is missing; *law is untouched then. oil: nu, and
 *  bearing_mu_ehl for ball bearings. */
GM_NODISCARD gm_status gm_bearing_law_make(const gm_bearing_data *data, const gm_oil *oil,
                                           gm_bearing_law *law, gm_error *error);

/** The bearing runs in the oil bath: H [m] is the level above the lowest contact of the
 *  outer raceway (bearing_bath.c). Nothing for H <= 0, nor for Palmgren, whose f_0 is
 *  that of an oil bath already. */
void gm_bearing_immerse(gm_bearing_law *law, double H);

/** Fill d, D, B, C0 and series of a bearing from its designation (deep groove ball
 *  bearings of bearing_catalogue.c). GM_ERR_MODEL when it is not in the catalogue; *data
 *  is untouched then. */
GM_NODISCARD gm_status gm_bearing_data_complete(gm_bearing_data *data, gm_error *error);

/** Name of a type, such as "deep groove ball bearing", and of a friction model as the
 *  file has it, such as "skf". */
const char *gm_bearing_type_name(gm_bearing_type type);
const char *gm_bearing_friction_name(gm_bearing_friction_model friction);

/** Factors at speed w >= 0 [rad/s]; w = 0 is the one-sided limit w -> 0+. */
gm_bearing_speed gm_bearing_at_speed(const gm_bearing_law *law, double w);

/** Friction torque at that speed under loads [N] >= 0, with derivatives. Continuous and
 *  finite for all arguments, exact derivatives between the kinks the sources have. */
gm_bearing_torque gm_bearing_friction(const gm_bearing_law *law,
                                      const gm_bearing_speed *speed, double F_r,
                                      double F_a);

/** An elastic bearing in motion: rate of its state z [rad] and torque against w [N.m],
 *  signed, with their derivatives by z, w, F_r and F_a. */
typedef struct gm_bearing_state {
    double rate, rate_state, rate_speed, rate_radial, rate_axial;
    double torque, torque_state, torque_speed, torque_radial, torque_axial;
    double stored; /* J */
    double loss;   /* torque w - d stored/dt, >= 0, W */
} gm_bearing_state;

/** For a law with GM_FRICTION_ELASTIC: at relative speed w and state z of any sign;
 *  `speed` is that of |w|, loads >= 0 [N]. Steady sliding gives gm_bearing_friction. */
gm_bearing_state gm_bearing_elastic(const gm_bearing_law *law,
                                    const gm_bearing_speed *speed, double w, double z,
                                    double F_r, double F_a);

#endif
