/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The component's variables as a table, expanded from gm_vars.def. Nothing here knows a
 * version of FMI: getters and setters of every version are loops over this table.
 */
#ifndef GM_VARIABLES_H
#define GM_VARIABLES_H

#include <stdbool.h>

#include "gm_real.h"

#define GM_FREE 1e300    /* no limit on this side */
#define GM_INFINITE 1e30 /* a cone capacity from here on engages at once */
#define GM_SLOTS 8       /* value references per entry of the list */

typedef enum gm_variable_id {
#define GM_VAR(id, scope, name, type, causality, variability, initial, unit, start, min, \
               max, nominal, description)                                                \
    GM_##id,
#include "gm_vars.def"
#undef GM_VAR
    GM_VARIABLES
} gm_variable_id;

typedef enum gm_scope { GM_SCOPE_ALL, GM_SCOPE_PATH } gm_scope;
typedef enum gm_type {
    GM_TYPE_REAL,
    GM_TYPE_INTEGER,
    GM_TYPE_BOOLEAN,
    GM_TYPE_STATE,
    GM_TYPE_FIDELITY
} gm_type;
typedef enum gm_causality {
    GM_CAUSALITY_INPUT,
    GM_CAUSALITY_OUTPUT,
    GM_CAUSALITY_PARAMETER
} gm_causality;
typedef enum gm_variability {
    GM_VARIABILITY_CONTINUOUS,
    GM_VARIABILITY_DISCRETE,
    GM_VARIABILITY_FIXED,
    GM_VARIABILITY_TUNABLE
} gm_variability;
typedef enum gm_initial {
    GM_INITIAL_NONE,
    GM_INITIAL_EXACT,
    GM_INITIAL_CALCULATED
} gm_initial;

typedef struct gm_variable {
    const char *name; /* without the path's name */
    gm_scope scope;
    gm_type type;
    gm_causality causality;
    gm_variability variability;
    gm_initial initial;
    gm_real start, min, max, nominal;
} gm_variable;

/** [GM_VARIABLES], in the order of the list. */
extern const gm_variable gm_variables[];

/** One variable of one flange: what a value reference means. */
typedef struct gm_reference {
    gm_variable_id id;
    int path; /* 0 for variables that belong to no path */
} gm_reference;

/** Find value reference vr in a gearset of n_paths; false when it means nothing. */
bool gm_variable_find(unsigned vr, int n_paths, gm_reference *reference);

/** The kind of value that carries the type: enumerations are integers. */
gm_type gm_variable_carrier(gm_type type);

#endif
