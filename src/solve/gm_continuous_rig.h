/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A model in Model Exchange as a rig: integrated by CVODE from command to command.
 */
#ifndef GM_CONTINUOUS_RIG_H
#define GM_CONTINUOUS_RIG_H

#include "plant/gm_continuous.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct gm_continuous_rig {
    gm_rig rig; /* points back here: does not move */
    const gm_continuous *model;
    double tolerance;
} gm_continuous_rig;

/** tolerance: error of a step relative to the states and their nominal values. model must
 *  outlive the rig. */
void gm_continuous_rig_init(gm_continuous_rig *rig, const gm_continuous *model,
                            double tolerance);

#ifdef __cplusplus
}
#endif
#endif
