/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The component: one reduced gearset, its variables and its state. One plain struct
 * without pointers, so that to save it is to copy it. Knows nothing of FMI: phases, times
 * and messages are gm_run.h and fmi2*.c.
 *
 * A torque input u set with slope u' is the signal u + u' t from then on; after a step of
 * h it stands at u + u' h and keeps its slope until either is set again. Where motion is
 * prescribed the acceleration is such a signal, and speed and angle go on as it says.
 */
#ifndef GM_COMPONENT_H
#define GM_COMPONENT_H

#include "gm_interface.h"
#include "gm_reduced_gradient.h"

typedef union gm_value {
    gm_real real;
    int integer; /* also booleans and enumerations */
} gm_value;

typedef struct gm_component {
    gm_value value[GM_VARIABLES][GM_MAX_PATHS]; /* [id][path], path 0 where none */
    gm_real
        output_rate; /* slope of the flange's torque; of its acceleration where that is */
    gm_real path_rate[GM_MAX_PATHS]; /* prescribed */
    gm_reduced_state state;
    gm_reduced_modes modes; /* if exchange */
    bool exchange;          /* a solver outside moves the states */
    int flags;              /* of the last start or step, gm_reduced.h */
    bool start_pending;     /* a start value changed since gm_component_start */
    bool outputs_pending;   /* accelerations, losses and energies are of an older point */
} gm_component;

/** All variables at their start values; sync_torque from the map. `exchange` stays. */
void gm_component_reset(const gm_reduced_map *map, gm_component *c);

/** Engage the commanded gears and set speeds and angles from the start values. Returns
 *  flags; GM_FLAG_NOT_FINITE: no valid start, the state is not to be used. */
int gm_component_start(const gm_reduced_map *map, gm_component *c);

/** One step of h > 0 s. Returns flags; GM_FLAG_NOT_FINITE: nothing was changed. */
int gm_component_step(const gm_reduced_map *map, gm_component *c, gm_real h);

/** Treat an event of an exchange: gear commands, shafts at rest, synchronised paths.
 *  *jumped: speeds or energies changed. Returns flags; GM_FLAG_NOT_FINITE: nothing was
 *  changed. */
int gm_component_update(const gm_reduced_map *map, gm_component *c, bool *jumped);

/** Event indicators z[gm_reduced_indicators] of an exchange; false on overflow. */
bool gm_component_indicators(const gm_reduced_map *map, gm_component *c, gm_real *z);

/** Derivatives of the outputs at this instant along a direction; false on overflow. */
bool gm_component_derivative(const gm_reduced_map *map, gm_component *c,
                             const gm_reduced_change *by, gm_reduced_outputs *derivative);

/** Take the values of the variables that are states over into the state. */
void gm_component_move(const gm_reduced_map *map, gm_component *c);

/** Store a value; gm_run_set has checked that it may be set. */
void gm_component_set(gm_component *c, gm_reference reference, gm_value value);

/** Slope of an input [1/s of its unit]. Those of torques and accelerations count; angle
 *  and speed have the slopes that speed and acceleration say, and the oil temperature has
 *  no influence within a step. */
void gm_component_set_rate(gm_component *c, gm_reference reference, gm_real rate);

/** Value of a variable at this instant; false when it overflowed. */
bool gm_component_get(const gm_reduced_map *map, gm_component *c, gm_reference reference,
                      gm_value *value);

#endif
