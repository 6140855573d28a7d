/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A gearset in motion as seen from outside: what acts on it, what it shows. Flange 0 is
 * the output, flange 1 + p is path p.
 */
#ifndef GM_MOVING_H
#define GM_MOVING_H

#include "model/gm_steady.h"

/** What acts from outside. */
typedef struct gm_motion_input {
    double torque[GM_MAX_FLANGES]; /* N.m, into the gearset */
    int gear[GM_MAX_INPUT_PATHS];  /* commanded gear numbers, 0 neutral */
} gm_motion_input;

/** What is seen at the flanges and in the accounts at one instant. */
typedef struct gm_motion_view {
    double speed[GM_MAX_FLANGES];        /* rad/s */
    double acceleration[GM_MAX_FLANGES]; /* rad/s2 */
    double loss_power;                   /* W, >= 0 */
    double stored_energy;                /* J: kinetic and elastic */
    double jump_loss; /* J, >= 0: given up by stored energy where x jumped, since start */
    int state[GM_MAX_INPUT_PATHS]; /* gm_path_mode of core/gm_reduced.h */
} gm_motion_view;

/** One quantity inside the plant that can be recorded: of a body, a mesh, a bearing. */
typedef struct gm_motion_signal {
    const char *name; /* such as "mesh.g1.force" */
    const char *unit; /* such as "N" */
} gm_motion_signal;

#endif
