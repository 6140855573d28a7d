/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The component's variables with what a model description says of them: core/gm_vars.def
 * expanded for the generators, with units, types and dependencies.
 */
#ifndef VARIABLES_H
#define VARIABLES_H

#include "bake/gm_bake.h"

#include <stdbool.h>

#define GM_FREE 1e300 /* min or max: no limit on this side */

enum { SCOPE_ALL, SCOPE_PATH };
enum { TYPE_REAL, TYPE_INTEGER, TYPE_BOOLEAN, TYPE_STATE, TYPE_FIDELITY };
enum { CAUSALITY_INPUT, CAUSALITY_OUTPUT, CAUSALITY_PARAMETER };
enum {
    VARIABILITY_CONTINUOUS,
    VARIABILITY_DISCRETE,
    VARIABILITY_FIXED,
    VARIABILITY_TUNABLE
};
enum { INITIAL_NONE, INITIAL_EXACT, INITIAL_CALCULATED };

typedef enum variable_id {
#define GM_VAR(id, scope, name, type, causality, variability, initial, unit, start, min, \
               max, nominal, description)                                                \
    VARIABLE_##id,
#include "core/gm_vars.def"
#undef GM_VAR
    N_VARIABLES
} variable_id;

typedef struct variable {
    const char *name; /* without the path's name */
    int scope, type, causality, variability, initial;
    const char *unit;
    double start, min, max, nominal;
    const char *description;
} variable;

/** [N_VARIABLES], in the order of the list. */
extern const variable gm_bake_variables[];

/** One entry of the list of scalar variables: list order, a path's copies side by side.
 */
typedef struct scalar {
    variable_id id;
    int path; /* -1 for variables that belong to no path */
} scalar;

/** Number of scalars of a gearset of n_paths, at most 2 N_VARIABLES; fills all[]. Flanges
 *  whose speed is an input have no w_start. */
int gm_bake_scalars(int n_paths, const gm_speed_in *speed_in, scalar *all);

/** Whether the scalar is one that changes its place at a flange whose speed is an input:
 *  phi, w, a are inputs there, tau is an output. */
bool gm_bake_is_swapped(const gm_speed_in *speed_in, scalar s);

/** What the list says of a scalar, with what speeds that are inputs change of it. */
variable gm_bake_variable(const gm_speed_in *speed_in, scalar s);

/** Value reference of a scalar. */
unsigned gm_bake_reference(scalar s);

/** Position of a scalar in all[n], counted from 1: its index in ModelVariables. */
int gm_bake_index(const scalar *all, int n, scalar s);

/** The continuous states of core/gm_states.def and their derivatives, in that order;
 *  returns their number, at most that of the scalars. */
int gm_bake_states(int n_paths, const gm_speed_in *speed_in, scalar *states,
                   scalar *derivatives);

/** Whether a scalar is the derivative of a state, and of which. */
bool gm_bake_integral(const gm_speed_in *speed_in, scalar derivative, scalar *state);

/** Number of event indicators: core/gm_reduced_modes.h. */
int gm_bake_indicators(int n_paths);

typedef enum dependency {
    DEPENDENCY_NONE,
    DEPENDENCY_DEPENDENT, /* in any way */
    DEPENDENCY_CONSTANT,  /* by a constant factor */
    DEPENDENCY_DISCRETE   /* by a factor that changes at events only */
} dependency;

/** How output `of` depends directly on scalar `on` (at communication points and between
 *  events: on inputs and states; during initialisation: on inputs and start values). */
dependency gm_bake_depends(const gm_speed_in *speed_in, scalar of, scalar on);
dependency gm_bake_depends_initially(const gm_speed_in *speed_in, scalar of, scalar on);

/** Whether an output follows the oil temperature, where the map has an oil axis. */
bool gm_bake_follows_oil(const gm_speed_in *speed_in, scalar of);

typedef struct display_unit {
    const char *name;
    double factor, offset; /* displayed = factor * value + offset */
} display_unit;

/** One unit and the type of the variables that have it. */
typedef struct unit_type {
    const char *unit, *type, *quantity;
    int kg, m, s, K, rad; /* exponents of the base units */
    display_unit display; /* name NULL: none */
} unit_type;

/** Number of units; all[] in the order of definition. */
int gm_bake_units(const unit_type **all);

/** Unit of a Real variable. */
const unit_type *gm_bake_unit(const char *unit);

#endif
