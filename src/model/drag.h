/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Losses that do not depend on load: radial shaft seals, oil films in narrow gaps
 * (concentric shafts, open synchroniser cones) and between plates (drag.c), gears dipping
 * into the oil (churning.c), gears in air and under oil jets (windage.c).
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

/** Film in a gap of radius r, length L, clearance c [m]: Petroff's 2 pi eta w r^3 L / c,
 *  more where the flow has Taylor's vortices. eta and nu of the oil. */
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

/** A gear in the oil bath; h <= 0 is dry. Lengths in m. */
typedef struct gm_dip {
    double R_p, b, h, V_0; /* pitch radius, width, depth of the tip, volume of the bath */
    double R_a, m_t, beta; /* tip radius, transverse module, helix >= 0: 14179-1 only */
} gm_dip;

/** Churning torque by Changenet and Velex (2007): T = 1/2 rho w^2 R_p^3 S_m C_m.
 *  Blended over Re_c 6000 to 9000. Zero when h <= 0; h is limited to the diameter. */
gm_speed_torque gm_churning_torque(const gm_dip *dip, const gm_oil *oil, double w);

/** ISO/TR 14179-1: torque of both sides and of the teeth per w^2 [N.m.s2]. */
typedef struct gm_iso_churning {
    double sides, teeth;
} gm_iso_churning;
gm_iso_churning gm_churning_iso14179_1(const gm_dip *dip, const gm_oil *oil);

/** Their sum as a torque, quadratic up to a pitch line speed of 10 m/s, then linear. */
gm_speed_torque gm_churning_torque_iso14179_1(const gm_dip *dip, const gm_oil *oil,
                                              double w);

/** A mesh that splashes, ISO/TR 14179-2. */
typedef struct gm_splash {
    double depth;    /* e_1 + e_2, immersion depths of both gears, m */
    double b;        /* common face width, m */
    double r_w;      /* working pitch radius of the pinion, m */
    double guidance; /* C_Sp; 1: no guidance of the splash oil */
} gm_splash;

/** Hydraulic torque at the pinion turning at w. Zero when depth <= 0. */
gm_speed_torque gm_splash_torque(const gm_splash *splash, double w);

/** A gear in air: pitch diameter, width, normal module [m]. */
typedef struct gm_windage {
    double d, b, m_n;
} gm_windage;

/** Windage by Maurer. */
gm_speed_torque gm_windage_torque(const gm_windage *gear, double w);

/** An oil jet on a gear. */
typedef struct gm_jet_law {
    double radius; /* pitch radius of the gear, m */
    double flow;   /* Q, m3/s */
    double speed;  /* v_jet against the teeth, m/s */
    double factor; /* C */
} gm_jet_law;

/** Impulse loss of an oil jet. */
gm_speed_torque gm_jet_torque(const gm_jet_law *jet, const gm_oil *oil, double w);

#endif
