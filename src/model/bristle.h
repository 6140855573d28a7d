/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Presliding: friction that holds like a spring before it slips, with one state, the mean
 * deflection z of the asperities ("bristles").
 */
#ifndef BRISTLE_H
#define BRISTLE_H

/** Bristles; all > 0. Passive (loss >= 0) where damping * speed < 9 g. */
typedef struct gm_bristle_law {
    double stiffness; /* sigma_0, N.m/rad */
    double damping;   /* sigma_1 at rest, N.m.s/rad */
    double speed;     /* w_s over which the damping fades, rad/s */
} gm_bristle_law;

/** The friction torque while sliding steadily, g > 0 [N.m], and its derivative by the
 *  speed's magnitude. */
typedef struct gm_bristle_level {
    double g;
    double d_speed; /* dg/d|w| */
} gm_bristle_level;

/** Rate of z and torque at (w, z), and their derivatives; signed. The torque acts against
 *  w. Loads enter through g: d/dF = d_level dg/dF. */
typedef struct gm_bristle {
    double rate;       /* dz/dt [rad/s] */
    double rate_state; /* by z */
    double rate_speed; /* by w, at given g plus through g(|w|) */
    double rate_level; /* by g */
    double torque;     /* sigma_0 z + sigma_1(w) dz/dt [N.m] */
    double torque_state, torque_speed, torque_level;
    double stored; /* sigma_0 z^2 / 2 [J] */
    double loss;   /* power that does not go into `stored`: torque w - d stored/dt [W] */
} gm_bristle;

/** At relative speed w [rad/s] and state z [rad], any sign and size. The derivatives are
 *  exact; at w = 0 they are those of motion in the direction of z. */
gm_bristle gm_bristle_at(const gm_bristle_law *law, const gm_bristle_level *level,
                         double w, double z);

/** z that steady sliding at speed w != 0 settles on: sgn(w) g / sigma_0. */
double gm_bristle_steady(const gm_bristle_law *law, const gm_bristle_level *level,
                         double w);

/** Share of g below which the deflection is purely elastic: a load below it does not
 *  drift, however it oscillates. */
#define GM_BRISTLE_ELASTIC 0.9

#endif
