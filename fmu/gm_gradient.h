/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Directional derivatives of the component's variables: how fast its outputs change when
 * inputs and states (at the start: inputs and start values) change at given rates.
 */
#ifndef GM_GRADIENT_H
#define GM_GRADIENT_H

#include "gm_states.h"

/** A rate for every variable, as gm_component.value; unused ones are zero. */
typedef struct gm_rates {
    gm_real of[GM_VARIABLES][GM_MAX_PATHS];
} gm_rates;

/** Whether the variable may change on its own: a Real input, a state; at the start
 *  (initial) a Real start value instead of a state. */
bool gm_gradient_is_known(const gm_reduced_map *map, gm_reference reference,
                          bool initial);

/** Rates of all Real outputs, from those of the knowns, exactly; false on overflow. The
 *  component has to be started. */
bool gm_gradient_follow(const gm_reduced_map *map, gm_component *c, bool initial,
                        const gm_rates *known, gm_rates *outputs);

#endif
