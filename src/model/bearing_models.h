/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The friction models behind bearing.h, and the tables they read. For bearing*.c and
 * their tests only. Mixed units of the sources: N, mm, N.mm, rpm, mm2/s.
 */
#ifndef BEARING_MODELS_H
#define BEARING_MODELS_H

#include "model/bearing.h"

#include <stdbool.h>

/** A row of the SKF friction constants, and K_Z and K_L, which depend on the same choice.
 */
typedef struct gm_skf_row {
    const char *series;
    double R1, R2, R3, S1, S2, S3, K_Z, K_L;
} gm_skf_row;

/** Rows of a type; *n receives their number. */
const gm_skf_row *gm_skf_rows(gm_bearing_type type, int *n);

/** Row of a series, compared without case and blanks. The series of needle roller
 *  bearings is not asked for: SKF has no row, a full complement cylindrical roller
 *  bearing stands in. GM_ERR_MODEL with a sentence when there is no such series. */
GM_NODISCARD gm_status gm_skf_find(gm_bearing_type type, const char *series,
                                   const gm_skf_row **row, gm_error *error);

/** Fill law->skf; law->data and law->nu are set. mu_EHL of ball bearings from the oil. */
void gm_skf_make(gm_bearing_law *law, const gm_skf_row *row, double mu_EHL_ball);

/** V_M of the drag in the oil bath at the level H over d_m (0 to 1.2). */
double gm_skf_drag_variable(const gm_bearing_data *data, double H_share);

/** Drag of law's bearing at level H > 0 [mm] with that V_M. */
gm_skf_bath gm_skf_bath_at(const gm_bearing_law *law, double H, double V_M);

/** Factors that depend on speed, at n >= 0 [rpm]; d_ are derivatives by n. */
typedef struct gm_skf_phi {
    double ish, d_ish; /* inlet shear heating */
    double rs, d_rs;   /* starvation */
    double bl, d_bl;   /* share of boundary lubrication */
} gm_skf_phi;

/** Torque of both contact seals of a capped bearing [N.mm] by SKF, D and the seals'
 *  diameter in mm; 0 without. NAN: SKF has no constants for that seal at this D. */
double gm_skf_seals(gm_bearing_cap cap, double D, double diameter);

gm_skf_phi gm_skf_factors(const gm_bearing_law *law, double n);
gm_bearing_speed gm_skf_at_speed(const gm_bearing_law *law, double w);

/** G_rr and G_sl with their derivatives by F_r, F_a and the centrifugal load F_g. */
typedef struct gm_skf_loads {
    double G_rr, rr_r, rr_a, rr_g;
    double G_sl, sl_r, sl_a, sl_g;
} gm_skf_loads;

gm_skf_loads gm_skf_at_loads(const gm_bearing_law *law, const gm_bearing_speed *speed,
                             double F_r, double F_a);
gm_bearing_torque gm_skf_friction(const gm_bearing_law *law,
                                  const gm_bearing_speed *speed, double F_r, double F_a);

/** Fill law->palmgren; law->data and law->nu are set. */
void gm_palmgren_make(gm_bearing_law *law);
gm_bearing_speed gm_palmgren_at_speed(const gm_bearing_law *law, double w);
gm_bearing_torque gm_palmgren_friction(const gm_bearing_law *law,
                                       const gm_bearing_speed *speed, double F_r,
                                       double F_a);

/** What a model by given numbers needs of *data, one sentence otherwise. */
GM_NODISCARD gm_status gm_sliding_check(const gm_bearing_data *data, gm_error *error);

/** Fill law->sliding and law->bristle; law->data is set and checked. eta [Pa.s]. */
void gm_sliding_make(gm_bearing_law *law, double eta);
gm_bearing_speed gm_sliding_at_speed(const gm_bearing_law *law, double w);
gm_bearing_torque gm_sliding_friction(const gm_bearing_law *law,
                                      const gm_bearing_speed *speed, double F_r,
                                      double F_a);

#endif
