/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Losses that do not depend on load: radial shaft seals, oil films in narrow gaps
 * (concentric shafts, open synchroniser cones), gears dipping into the oil.
 * Each law: torque >= 0 [N.m] at speed w >= 0 [rad/s], with its derivative.
 */
#ifndef DRAG_H
#define DRAG_H

#include "model/friction.h"
#include "model/oil.h"

/** Radial shaft seal of shaft diameter d [m]. ISO/TR 14179-2: P = 7.69e-6 d^2 n (W, mm,
 *  rpm); ISO/TR 14179-1: T = 3.737e-3 d (FPM) or 2.429e-3 d (NBR) (N.m, mm); Linke:
 *  depends on oil->temperature and oil->nu_40. None of them depends on speed. */
gm_speed_torque gm_seal_torque(gm_seal_model model, double d, const gm_oil *oil,
                               double w);

/** Petroff's law for a gap: radius r, length L, clearance c [m]: 2 pi eta w r^3 L / c. */
gm_speed_torque gm_petroff_torque(double r, double L, double c, const gm_oil *oil,
                                  double w);

/** Gaps of an open wet clutch or brake: n of them, radii r_i < r_o, clearance h [m], oil
 *  fed to all of them [m3/s; INFINITY: they stay full at any speed]. */
typedef struct gm_plates {
    int n;
    double r_i, r_o, h, feed;
} gm_plates;

/** Drag of the oil films at slip w, n pi eta w (r_e^4 - r_i^4) / (2 h): r_e = r_o while
 *  the feed fills the gaps, less when they throw out more than that. */
gm_speed_torque gm_plates_drag(const gm_plates *plates, const gm_oil *oil, double w);

/** Slip up to which the feed fills the gaps, where drag is largest [rad/s]; INFINITY when
 *  they stay full. */
double gm_plates_full_slip(const gm_plates *plates, const gm_oil *oil);

/** A gear in the oil bath: pitch radius R_p, face width b, immersion depth h, volume V_0
 *  of the bath [m, m3], R_p, b and V_0 > 0. */
typedef struct gm_dip {
    double R_p, b, h, V_0;
} gm_dip;

/** Churning torque by Changenet and Velex (2007): T = 1/2 rho w^2 R_p^3 S_m C_m.
 *  Blended over Re_c 6000 to 9000. Zero when h <= 0; h is limited to the diameter. */
gm_speed_torque gm_churning_torque(const gm_dip *dip, const gm_oil *oil, double w);

#endif
