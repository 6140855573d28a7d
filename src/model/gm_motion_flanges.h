/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A gearset in motion in the terms of a reduced one: what its inner forces mean at the
 * flanges. By virtual work, with the kinematics of the present configuration:
 *
 *   twist of an engaged path   sum F_e x_e with the row forces F_e at 1 N.m on its
 *                              flange; its rate is w_p - r w_o
 *   loss torques               friction of all parts as torques on the independent
 *                              speeds: the output and every path that is not engaged
 *
 * What load adds to the friction (now, less friction at the same speeds without row
 * forces) is the loss torque of the engaged path, the rest stays at the output; of two
 * engaged paths each takes the share of its power. A path that synchronises counts as
 * neutral. Loss torques at the flanges times their speeds make the power of friction, but
 * for what elastic parts move against each other.
 */
#ifndef GM_MOTION_FLANGES_H
#define GM_MOTION_FLANGES_H

#include "model/gm_motion.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct gm_motion_flanges gm_motion_flanges;

/** For a motion, which must outlive it; knows nothing before gm_motion_flanges_update.
 *  GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_motion_flanges_create(gm_motion *motion,
                                                gm_motion_flanges **flanges,
                                                gm_error *error);
void gm_motion_flanges_destroy(gm_motion_flanges *flanges);

/** Take over the configuration that the motion is in now: after its start and after every
 *  change of its modes. GM_ERR_MODEL, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_motion_flanges_update(gm_motion_flanges *flanges,
                                                gm_error *error);

/** Speed of path p over that of the output; 0 when it is not engaged. */
double gm_motion_flanges_ratio(const gm_motion_flanges *flanges, int p);

/** Twist of path p [rad] at the states x, 0 when it is not engaged. */
double gm_motion_flanges_twist(const gm_motion_flanges *flanges, int p, const double *x);

/** Loss torques [N.m], flange by flange, positive against positive speed. */
void gm_motion_flanges_losses(gm_motion_flanges *flanges, const gm_motion_input *input,
                              const double *x, double torque[GM_MAX_FLANGES]);

/** Kinetic energy [J]; inertia of the part that a flange sits on [kg.m2]; the highest
 *  angular frequency [rad/s] of a row alone between the parts it joins. */
double gm_motion_flanges_kinetic_energy(const gm_motion_flanges *flanges,
                                        const double *x);
double gm_motion_flanges_inertia(const gm_motion_flanges *flanges, int flange);
double gm_motion_flanges_frequency(const gm_motion_flanges *flanges);

#ifdef __cplusplus
}
#endif
#endif
