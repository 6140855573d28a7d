/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The component's continuous states as a vector, in the order of gm_states.def: for
 * solvers outside. Like the variables, the same for every version of FMI. Angle and speed
 * of a flange whose motion is prescribed are inputs and no states.
 */
#ifndef GM_STATES_H
#define GM_STATES_H

#include "gm_component.h"

enum { GM_MAX_STATES = 7 * GM_MAX_PATHS };

/** The variables that are states, in order; returns their number. */
int gm_states_list(const gm_reduced_map *map, gm_reference states[GM_MAX_STATES]);

/** Number of states. */
int gm_states_count(const gm_reduced_map *map);

/** Whether a variable is a state, and the one that is its derivative then. */
bool gm_states_derivative_of(const gm_reduced_map *map, gm_reference state,
                             gm_reference *derivative);

/** x[gm_states_count] */
void gm_states_get(const gm_reduced_map *map, const gm_component *c, gm_real *x);

/** All of x has to be finite. */
void gm_states_set(const gm_reduced_map *map, gm_component *c, const gm_real *x);

/** Derivatives of the states at this instant; false when one overflowed. */
bool gm_states_rates(const gm_reduced_map *map, gm_component *c, gm_real *rates);

/** Orders of magnitude, all > 0. */
void gm_states_nominals(const gm_reduced_map *map, gm_real *nominals);

#endif
