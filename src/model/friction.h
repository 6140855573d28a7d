/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What every friction law answers: a torque (or force) >= 0 and its partial derivatives.
 * Signs are the assembly's business; here speeds and loads are magnitudes.
 */
#ifndef FRICTION_H
#define FRICTION_H

/** Bearing friction torque M(w, F_r, F_a) [N.m], w >= 0 [rad/s], loads >= 0 [N]. */
typedef struct gm_bearing_torque {
    double value;
    double d_speed;  /* dM/dw, N.m.s */
    double d_radial; /* dM/dF_r, m */
    double d_axial;  /* dM/dF_a, m */
} gm_bearing_torque;

/** A law of speed alone: seals, gaps, churning [N.m]. */
typedef struct gm_speed_torque {
    double value;
    double d_speed;
} gm_speed_torque;

#endif
