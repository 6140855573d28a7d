/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Inertias by ramps on the test rig. A speed is ramped down and up through the same
 * speed w, at constant torques of the other flanges; what is the same at that speed (the
 * losses) falls out of the difference:
 *
 *   J = (S_up - S_down) / (a_up - a_down),   S: torque at the flange with those of all
 *                                            flanges that turn with it, referred to it
 *
 * Transmitted torque, and with it the load loss, changes along with the acceleration:
 * at fixed input torque the ramp sees J_out + r^2 J_p (1 -+ dD/dtau), which the mean of a
 * driving and a driven ramp frees of the slope. The ramp is repeated at half its rate;
 * the result is that of the slower one and the difference its uncertainty.
 */
#ifndef RIG_RAMP_H
#define RIG_RAMP_H

#include "sweep/rig_run.h"

typedef struct gm_rig_inertia {
    double value;       /* kg.m2, at the ramped flange */
    double uncertainty; /* kg.m2 */
} gm_rig_inertia;

/** Inertia that is felt at flange f when the target is held and the speed of f is ramped
 *  (an engaged path only where it takes speed). time [s] of one ramp; 0:
 *  automatic. Errors of gm_rig_run_hold. */
GM_NODISCARD gm_status gm_rig_ramp_inertia(gm_rig_run *run, const gm_rig_target *target,
                                           int f, double time, gm_rig_inertia *inertia,
                                           gm_error *error);

/** Torque at flange f when its speed passes that of the target, free of the inertia's:
 *  from ramps up and down through it, where the acceleration between them is zero. The
 *  other flanges as in gm_rig_run_hold, with which it begins; f takes torque and turns.
 *  From a rate and its half to none: where little torque is transmitted, its magnitude
 *  and with it the loss follows the acceleration. found->change[f]: difference between
 *  both rates. GM_ERR_ARGUMENT when f takes speed;
 *  errors of gm_rig_run_hold. */
GM_NODISCARD gm_status gm_rig_ramp_torque(gm_rig_run *run, const gm_rig_target *target,
                                          int f, double time, gm_rig_found *found,
                                          gm_error *error);

#endif
