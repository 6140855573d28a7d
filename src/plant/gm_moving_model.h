/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A plant in motion (gm_dynamics.h) as a model in continuous time for the test rig: the
 * built-in model measured as if it were somebody else's. All flanges take torque.
 */
#ifndef GM_MOVING_MODEL_H
#define GM_MOVING_MODEL_H

#include "plant/gm_continuous.h"
#include "plant/gm_dynamics.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The model; dynamics must outlive it. step [s]: as in gm_rig, > 0. */
gm_continuous gm_moving_model(const gm_dynamics *dynamics, double step);

#ifdef __cplusplus
}
#endif
#endif
