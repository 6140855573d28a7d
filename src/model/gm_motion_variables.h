/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A gearset in motion as a component shows it: beyond the flanges' own variables, its
 * states, their rates and the other signals that can be recorded, in a fixed order and
 * with names of FMI's structured convention:
 *
 *   body.NAME.w, mesh.NAME.deflection         states that are signals
 *   lock.NAME.deflection, bearing.NAME.bristle, shaft.NAME[1].deflection
 *   der(STATE)                                their rates
 *   mesh.NAME.force, bearing.NAME.radial ...  the other signals of gm_motion_observe
 *
 * Speeds of flanges are variables of the flanges and not in the list, nor are signals
 * that repeat a state.
 */
#ifndef GM_MOTION_VARIABLES_H
#define GM_MOTION_VARIABLES_H

#include "model/gm_motion.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum gm_motion_variable_kind {
    GM_MOTION_STATE,
    GM_MOTION_RATE,
    GM_MOTION_SIGNAL
} gm_motion_variable_kind;

typedef struct gm_motion_variable {
    gm_motion_variable_kind kind;
    int index; /* of the state, or of the signal */
    char *name;
    const char *unit;
    double nominal; /* states: a usual value; else 0 */
    int shown;      /* 1: an output; 0: of interest to the solver alone */
} gm_motion_variable;

/** Value references of a component: those of the flanges' variables (core/gm_vars.def)
 *  lie below, here follows the list. */
#define GM_MOTION_REFERENCES 4096u

typedef struct gm_motion_variables {
    int n;
    gm_motion_variable *all; /* [n]: states, rates, signals */
} gm_motion_variables;

/** The list. GM_ERR_MEMORY. Free with gm_motion_variables_clear. */
GM_NODISCARD gm_status gm_motion_variables_make(const gm_motion *motion,
                                                gm_motion_variables *list,
                                                gm_error *error);
void gm_motion_variables_clear(gm_motion_variables *list);

/** What tells components of different gearsets or interfaces apart, in the shape of a
 *  UUID in braces: a hash of the description, of the list and of the program's version.
 *  GM_ERR_MEMORY. */
#define GM_MOTION_GUID_SIZE 48
GM_NODISCARD gm_status gm_motion_guid(const gm_motion *motion,
                                      const gm_motion_variables *list,
                                      char guid[GM_MOTION_GUID_SIZE], gm_error *error);

/** Flange whose speed state i is: 0 the output, 1 + p path p; -1: none. */
int gm_motion_flange_of_state(const gm_motion *motion, int i);

/** The number of a motion's modes; they, its gears and its account of jumps as numbers:
 *  with the states all that a motion remembers. set: of a motion of the same description;
 *  1 when the numbers are not modes, nothing is changed then. */
int gm_motion_n_modes(const gm_motion *motion);
void gm_motion_get_modes(const gm_motion *motion, double *modes);
int gm_motion_set_modes(gm_motion *motion, const double *modes);

/** Factor on every friction torque, and on the cones' capacity of every lock of path p; a
 *  lock with GM_MOTION_AT_ONCE [N.m] and more locks at any difference of speeds. Both
 *  >= 0; 1 at first. */
#define GM_MOTION_AT_ONCE 1e20
void gm_motion_scale_losses(gm_motion *motion, double factor);
void gm_motion_scale_cones(gm_motion *motion, int p, double factor);

#ifdef __cplusplus
}
#endif
#endif
