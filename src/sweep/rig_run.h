/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A run on the test rig: the model with a dynamometer at every flange. Where the model
 * takes the quantity that a dynamometer is to hold, it is simply set; else it is
 * controlled, once in each period (dwell) of length h:
 *
 *   torque taken, speed held        y' = G (u - u0)   u torque, y speed, G = 1/inertia
 *   speed taken, torque held        y' = G (u - u0)   u speed, y torque, G = stiffness
 *   torque of a path whose speed is taken, held through the output's torque: y = y(u)
 *
 * From the change of y over a period follows the command u0 that would have held it,
 * and from that the next command: u = u0 + G^-1 (y_wanted - y) / h. u0 is what a torque
 * meter shows at constant speed, free of the inertia torque of what speed is left over.
 *
 * G is measured by a pulse in the configuration at hand. The period is doubled until the
 * pulse's answer is that of one inertia (vibrations and backlash are over) and whenever
 * control makes no progress.
 */
#ifndef RIG_RUN_H
#define RIG_RUN_H

#include "plant/gm_rig.h"

typedef struct gm_rig_scales {
    double speed;  /* rad/s: largest speed of the paths */
    double torque; /* N.m: largest torque of the paths */
} gm_rig_scales;

/** What is to be held: speeds of output and neutral paths, torques of engaged paths, as
 *  in gm_steady_point; ratio of engaged paths, as far as known (else 0). */
typedef struct gm_rig_target {
    gm_steady_point point;
    double ratio[GM_MAX_INPUT_PATHS];
} gm_rig_target;

/** What was found when everything stood still. */
typedef struct gm_rig_found {
    double speed[GM_MAX_FLANGES], torque[GM_MAX_FLANGES];
    double change[GM_MAX_FLANGES]; /* N.m: of the torques over the last periods */
} gm_rig_found;

typedef struct gm_rig_run gm_rig_run;

/** dwell [s]: period; 0: automatic. The rig outlives the run. GM_ERR_MEMORY, errors of
 *  the model. */
GM_NODISCARD gm_status gm_rig_run_create(const gm_rig *rig, const gm_rig_scales *scales,
                                         double dwell, gm_rig_run **run, gm_error *error);
void gm_rig_run_destroy(gm_rig_run *run);

/** The next target begins with the model at rest. */
void gm_rig_run_restart(gm_rig_run *run);

/** Hold the target until nothing changes any more. GM_ERR_SOLVE when that does not come
 *  about; GM_ERR_ARGUMENT for combinations that cannot be held; errors of the model. */
GM_NODISCARD gm_status gm_rig_run_hold(gm_rig_run *run, const gm_rig_target *target,
                                       gm_rig_found *found, gm_error *error);

/** The period at present, s; 0 before the first target. */
double gm_rig_run_period(const gm_rig_run *run);

int gm_rig_run_paths(const gm_rig_run *run);

#endif
