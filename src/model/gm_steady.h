/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What a steady operating point of any gearset is: given speeds and torques at the
 * flanges, and what is found. Flange 0 is the output, flange 1 + p is path p.
 */
#ifndef GM_STEADY_H
#define GM_STEADY_H

#define GM_MAX_INPUT_PATHS 2
#define GM_MAX_FLANGES (1 + GM_MAX_INPUT_PATHS)

/** One operating point. The speeds of the output and of the paths in neutral are
 *  independent and given; the torques of the engaged paths are given. */
typedef struct gm_steady_point {
    int gear[GM_MAX_INPUT_PATHS];     /* gear numbers, 0 neutral */
    double speed[GM_MAX_FLANGES];     /* rad/s: output and neutral paths */
    double direction[GM_MAX_FLANGES]; /* same flanges: where a relative speed is zero,
                                      friction takes the limit for flanges that start to
                                      move along this vector (any scale; 0: not moving) */
    double torque[GM_MAX_FLANGES];    /* N.m: engaged paths */
} gm_steady_point;

typedef struct gm_steady_result {
    double torque[GM_MAX_FLANGES];      /* N.m into the gearset, given or found */
    double speed[GM_MAX_FLANGES];       /* rad/s, given or found */
    double uncertainty[GM_MAX_FLANGES]; /* N.m, of the torques: where they were measured
                                           on a simulated plant, else 0 */
} gm_steady_result;

/** Kinematics of a configuration. */
typedef struct gm_kinematics {
    double ratio[GM_MAX_INPUT_PATHS]; /* w_path / w_output of engaged paths, else 0 */
    double inertia_output; /* turns with the output, all in neutral, kg.m2; what else
                              turns with a path without neutral belongs to it */
    double inertia[GM_MAX_INPUT_PATHS]; /* turns with path p, all in neutral, kg.m2; of a
                                           path without neutral its flange's body alone */
    double inertia_total; /* turns with the output in this configuration, kg.m2 */
} gm_kinematics;

/** What the gears of a configuration add to the inertia at the output beyond J_out and
 *  r^2 J_p of the engaged paths [kg.m2]; exactly 0 where that is rounding. */
double gm_extra_inertia(const gm_kinematics *kinematics);

/** How a path gives way between its flange and the held output, in one gear. */
typedef struct gm_compliance {
    double stiffness;     /* N.m/rad at the path's flange, flanks in contact, > 0 */
    double damping;       /* N.m.s/rad, in parallel with it */
    double loose_damping; /* N.m.s/rad, of what idles along, of small vibrations */
    double lash;          /* rad at the path's flange, from flank to flank, >= 0 */
    double film; /* rad, depth before contact in which the damping sets in, >= 0 */
} gm_compliance;

#endif
