/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The detailed gearset in motion:
 *
 *   J dw/dt = - sum_e g_e F_e(x_e, g_e . w) + tau_friction(F, w) + tau_flange
 *   dx_e/dt = g_e . w           for every mesh, closed lock and compliant piece of shaft
 *   dz/dt                       for every bearing with presliding friction
 *
 * State: speeds w of all bodies, deflections x_e of all rows (not angles: those grow, and
 * a relative error of them would swamp micrometres), bristles z. A lock that is open
 * keeps its deflection at zero, so that the number of states never changes.
 *
 * Coulomb friction is the law's one-sided limit times s(v) of the relative speed v,
 * s = u (3 - u^2) / 2 with u = v / GM_COULOMB_SPEED (bearings, seals, drags) or
 * v / GM_COULOMB_ROLLING (meshes), +-1 beyond: outside that band friction is that of the
 * steady balance exactly. Bearings with elastic friction hold without creep.
 *
 * A lock closes in two steps: its cones rub with their full capacity against the relative
 * speed until that is zero, then its dogs hold. The room knows no solver: see
 * plant/gm_dynamics.h for how these calls are used.
 */
#ifndef GM_MOTION_H
#define GM_MOTION_H

#include "model/gm_gearset.h"
#include "model/gm_moving.h"

#ifdef __cplusplus
extern "C" {
#endif

#define GM_COULOMB_SPEED 0.1     /* rad/s */
#define GM_COULOMB_ROLLING 0.003 /* m/s */

typedef struct gm_motion gm_motion;

/** A motion of the gearset, which must outlive it. GM_ERR_MODEL: a part without inertia;
 *  GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_motion_create(const gm_gearset *gearset, gm_motion **motion,
                                        gm_error *error);
void gm_motion_destroy(gm_motion *motion);

int gm_motion_n_states(const gm_motion *motion);

/** Begin with the gears of *input engaged, flanges at speed[n_flanges] [rad/s] (where an
 *  engaged path disagrees with the output, the output wins) and elastic parts unloaded.
 *  GM_ERR_ARGUMENT: no such gear; GM_ERR_MODEL; GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_motion_start(gm_motion *motion, const gm_motion_input *input,
                                       const double *speed, double *x, gm_error *error);

/** Absolute errors that matter as little as `relative` of a usual value. */
void gm_motion_tolerances(const gm_motion *motion, double relative, double *absolute);

/** Right side dx[n_states]; 1 when x is not finite, else 0. */
int gm_motion_rates(gm_motion *motion, const gm_motion_input *input, const double *x,
                    double *dx);

/** Exact derivative of the right side in compressed columns; the pattern holds in every
 *  mode and contains the diagonal. */
int gm_motion_entries(const gm_motion *motion);
void gm_motion_pattern(const gm_motion *motion, int *column_start, int *row);
int gm_motion_jacobian(gm_motion *motion, const gm_motion_input *input, const double *x,
                       double *value);
int gm_motion_torque_column(gm_motion *motion, const gm_motion_input *input,
                            const double *x, int flange, double *column);
int gm_motion_speed_state(const gm_motion *motion, int flange);

/** One event for every lock: its relative speed against the sense in which it began to
 *  synchronise; 1 while it does not. */
int gm_motion_n_events(const gm_motion *motion);
int gm_motion_events(gm_motion *motion, const gm_motion_input *input, const double *x,
                     double *g);

/** Open and close locks as the gears of *input command, hold those whose cones have
 *  brought the speeds together. GM_ERR_ARGUMENT: no such gear; nothing changes then. */
GM_NODISCARD gm_status gm_motion_handle(gm_motion *motion, const gm_motion_input *input,
                                        double *x, int *changed, gm_error *error);

void gm_motion_view_at(gm_motion *motion, const gm_motion_input *input, const double *x,
                       gm_motion_view *view);

/** What can be recorded; names are the motion's. */
int gm_motion_n_signals(const gm_motion *motion);
gm_motion_signal gm_motion_signal_at(const gm_motion *motion, int i);

/** Name of the signal that shows state i: a speed or a deflection of a mesh by itself,
 *  other deflections by the torque that they cause. The motion's. */
const char *gm_motion_state_name(const gm_motion *motion, int i);
void gm_motion_observe(gm_motion *motion, const gm_motion_input *input, const double *x,
                       double *value);

#ifdef __cplusplus
}
#endif
#endif
