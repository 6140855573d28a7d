/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A reduced gearset in Co-Simulation as a plant in motion: the baked FMU takes steps of
 * one length, and between them the flanges move as a master can know them.
 *
 * Torques go in and speeds come out at t_k = k h. Between t_k and t_k + h the flanges are
 * integrated with all that is around them, as inertias J that the FMU tells ("inertia"):
 *
 *     dw/dt = a_k + (tau - tau_k) / J + (w_k - w(t_k)) / h
 *
 * with speed w_k and acceleration a_k that the FMU gave at t_k under the torque tau_k of
 * the step before. At t_k + h the FMU takes its step under the mean torque, so that it
 * gets the whole impulse; it follows from how far w has come. What the speeds were off is
 * made up over the next step, which keeps them and all torques around continuous.
 *
 * So what a flange does under its own torque is solved with the system around it. A
 * master that holds speeds over the step is stable only for h < 2 J / c beside a clutch
 * of damping c, some 0.01 ms; this one is not limited by it (compare Sicklinger et al.,
 * "Interface Jacobian-based co-simulation", Int. J. Numer. Meth. Engng 98 (2014)
 * 418-444, whose Jacobian is here its diagonal). A commanded gear reaches the FMU with
 * the step that begins at or after the command.
 */
#ifndef GM_FMU_STEPS_H
#define GM_FMU_STEPS_H

#include "plant/gm_fmu_motion.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct gm_fmu_steps_plant gm_fmu_steps_plant;

/** step: h [s], > 0. Looks into the file once; each motion opens it again.
 *  GM_ERR_ARGUMENT, GM_ERR_FORMAT when it does not have the interface; errors of
 *  gm_fmu_open. */
GM_NODISCARD gm_status gm_fmu_steps_create(const char *path, gm_fmu_fidelity fidelity,
                                           double step, gm_fmu_steps_plant **plant,
                                           gm_error *error);
void gm_fmu_steps_destroy(gm_fmu_steps_plant *plant);

/** The plant must outlive the dynamics and its motions. */
gm_dynamics gm_fmu_steps_dynamics(const gm_fmu_steps_plant *plant);

/** The step that the component recommends for these commanded gears [s]. Errors of
 *  gm_fmu_open. */
GM_NODISCARD gm_status gm_fmu_steps_recommended(const gm_fmu_steps_plant *plant,
                                                const int gear[GM_MAX_INPUT_PATHS],
                                                double *step, gm_error *error);

#ifdef __cplusplus
}
#endif
#endif
