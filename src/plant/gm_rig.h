/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A gearset that can only be simulated, on a test rig: time goes on in steps, commands
 * are constant over a step, speeds and torques are seen at its end. A foreign FMU, a
 * compiled model and the built-in model in motion are rigs; experiments (sweep) make
 * steady points, ratios and inertias out of it and know nothing else.
 *
 * Flange 0 is the output, flange 1 + p is path p. At each flange the model takes either
 * the torque and answers the speed, or the other way round. SI throughout; torque counts
 * into the gearset.
 *
 * A rig is constant and may be shared by threads; each thread (or process) makes its own
 * run.
 */
#ifndef GM_RIG_H
#define GM_RIG_H

#include "base/gm_status.h"
#include "model/gm_steady.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What the model takes at a flange. */
typedef enum gm_rig_drive { GM_RIG_TORQUE_IN, GM_RIG_SPEED_IN } gm_rig_drive;

/** What acts over a step: N.m or rad/s, as each flange takes it. */
typedef struct gm_rig_command {
    double value[GM_MAX_FLANGES];
    int gear[GM_MAX_INPUT_PATHS]; /* commanded gear numbers, 0 neutral */
} gm_rig_command;

/** What is seen at the end of a step; of what a flange takes the command itself. */
typedef struct gm_rig_view {
    double speed[GM_MAX_FLANGES];  /* rad/s */
    double torque[GM_MAX_FLANGES]; /* N.m, into the gearset */
} gm_rig_view;

typedef struct gm_rig_class {
    /* A run of the model, not started. GM_ERR_TOOL with what the model said. */
    gm_status (*create)(const void *self, void **run, gm_error *error);
    void (*destroy)(void *run);
    /* Begin at t = 0 with the gears of *command, at the speeds that the model starts
       with; may be called again at any time. */
    gm_status (*start)(void *run, const gm_rig_command *command, gm_rig_view *view,
                       gm_error *error);
    /* Go on by h > 0 [s]. GM_ERR_TOOL: the model failed or refused; GM_ERR_SOLVE: it
       answered something that is not a number. A run that failed is started again. */
    gm_status (*step)(void *run, const gm_rig_command *command, double h,
                      gm_rig_view *view, gm_error *error);
} gm_rig_class;

typedef struct gm_rig {
    const gm_rig_class *is;
    const void *self;
    int n_paths;
    gm_rig_drive drive[GM_MAX_FLANGES];
    double step; /* s: commands change and are seen no finer than this, > 0 */
} gm_rig;

#ifdef __cplusplus
}
#endif
#endif
