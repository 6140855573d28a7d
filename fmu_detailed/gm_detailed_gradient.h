/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Directional derivatives. Rates of the states come from the exact Jacobian of the
 * motion; other outputs (losses, energies, forces of meshes and bearings), and everything
 * during initialisation, from central differences.
 */
#ifndef GM_DETAILED_GRADIENT_H
#define GM_DETAILED_GRADIENT_H

#include "gm_detailed.h"

/** A variable: of the flanges, or number `inner` >= 0 of the list. */
typedef struct gm_detailed_variable {
    gm_reference reference;
    int inner;
} gm_detailed_variable;

/** Value of any variable; false when it is not finite. */
bool gm_detailed_value_of(gm_detailed *detailed, gm_detailed_variable variable,
                          double *value);

/** Direction in which things change; all zero at first. */
typedef struct gm_detailed_direction {
    bool initial; /* inputs and start values change, else inputs and states */
    double value[GM_VARIABLES][GM_DETAILED_PATHS];
    double *x; /* [n_states], the caller's */
} gm_detailed_direction;

/** Let a known change at this rate too; false: it is none. */
bool gm_detailed_add_known(const gm_detailed *detailed, gm_detailed_variable known,
                           double rate, gm_detailed_direction *direction);

/** derivative[n] of the unknowns along the direction; false when something is not finite.
 *  The component is as before. */
bool gm_detailed_follow(gm_detailed *detailed, const gm_detailed_direction *direction,
                        int n, const gm_detailed_variable *unknown, double *derivative);

#endif
