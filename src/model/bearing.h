/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Rolling bearing friction: one entry for the two models, SKF (bearing_skf.c) and
 * Palmgren (bearing_palmgren.c). What depends on speed alone is computed once per speed
 * and used for every load.
 */
#ifndef BEARING_H
#define BEARING_H

#include "model/friction.h"
#include "model/oil.h"

/** Constants of the SKF model for one bearing (General Catalogue; mixed units, mm). */
typedef struct gm_skf {
    double R1, R2, R3, S1, S2, S3;
    double K_Z;
    double mu_EHL;
    /* powers of d_m and the like that never change, filled once */
    double rr, sl_0, sl_a, d_m; /* meaning per type: see bearing_skf.c */
} gm_skf;

/** A bearing ready for evaluation: its data, its constants and its oil. */
typedef struct gm_bearing_law {
    gm_bearing_data data;
    gm_skf skf;
    double f0, f1_factor, f1_exponent, C0;
    double nu; /* mm2/s */
} gm_bearing_law;

/** Factors at one speed. */
typedef struct gm_bearing_speed {
    double w;             /* rad/s, >= 0 */
    double rolling, d_rolling; /* SKF: phi_ish phi_rs (nu n)^0.6; Palmgren: M_0 [N.m] */
    double sliding, d_sliding; /* SKF: mu_sl */
    double n;             /* rpm */
} gm_bearing_speed;

/** Look up designation and series constants, defaults of the type. GM_ERR_MODEL with a
 *  sentence (without file and line: the caller adds them) when the designation or series
 *  is unknown. mu_ehl as in gm_oil. */
GM_NODISCARD gm_status gm_bearing_law_make(const gm_bearing_data *data, const gm_oil *oil,
                                           gm_bearing_law *law, gm_error *error);

/** Fill d, D, B, C0, f0 and series of a bearing from its designation (deep groove ball
 *  bearings of bearing_catalogue.c). GM_ERR_MODEL when it is not in the catalogue. */
GM_NODISCARD gm_status gm_bearing_data_complete(gm_bearing_data *data, gm_error *error);

/** Factors at speed w >= 0 [rad/s]; w = 0 is the one-sided limit w -> 0+. */
gm_bearing_speed gm_bearing_at_speed(const gm_bearing_law *law, double w);

/** Friction torque at that speed under loads [N] >= 0, with derivatives. */
gm_bearing_torque gm_bearing_friction(const gm_bearing_law *law,
                                      const gm_bearing_speed *speed, double F_r, double F_a);

#endif
