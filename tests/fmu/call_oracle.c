/* SPDX-License-Identifier: BSD-2-Clause */
#include "call_oracle.h"

#include "gm_model.h"

#include <stddef.h>
#include <string.h>

bool oracle_is_number(double x)
{
    return x - x == 0;
}

/* Where motion is prescribed, by the last part of a variable's name: what comes in
 * elsewhere goes out, and there is nothing to start from. */
static const gm_variable *at_prescribed(const gm_variable *v, gm_variable *swapped)
{
    const char *dot = strrchr(v->name, '.'), *name = dot ? dot + 1 : v->name;
    *swapped = *v;
    if (strcmp(name, "w_start") == 0)
        return NULL;
    if (strcmp(name, "tau") == 0) {
        swapped->causality = GM_CAUSALITY_OUTPUT;
        swapped->initial = GM_INITIAL_CALCULATED;
    } else if (strcmp(name, "phi") == 0 || strcmp(name, "w") == 0 ||
               strcmp(name, "a") == 0) {
        swapped->causality = GM_CAUSALITY_INPUT;
        swapped->initial = GM_INITIAL_NONE;
    }
    return swapped;
}

/* The list as it is for the example's flanges: a path is lash where its motion is
 * prescribed. */
const gm_variable *oracle_variable(unsigned vr)
{
    static gm_variable swapped[GM_VARIABLES];
    const int *prescribed = gm_model_map()->prescribed;
    unsigned id = vr / GM_SLOTS, slot = vr % GM_SLOTS;
    if (id >= GM_VARIABLES || slot > 2)
        return NULL;
    const gm_variable *v = &gm_variables[id];
    if ((v->scope == GM_SCOPE_PATH) != (slot > 0))
        return NULL;
    if (v->type == GM_TYPE_FIDELITY && (prescribed[0] || prescribed[1])) {
        swapped[id] = *v;
        swapped[id].min = GM_LASH;
        return &swapped[id];
    }
    return prescribed[slot > 0 ? slot - 1 : GM_MAX_PATHS] ? at_prescribed(v, &swapped[id])
                                                          : v;
}

/* Enumerations are carried by the functions for integers. */
static bool is_carried_by(const gm_variable *v, gm_type type)
{
    switch (v->type) {
    case GM_TYPE_REAL:
    case GM_TYPE_BOOLEAN:
        return v->type == type;
    default:
        return type == GM_TYPE_INTEGER;
    }
}

bool oracle_may_get(unsigned vr, gm_type type)
{
    const gm_variable *v = oracle_variable(vr);
    return v && is_carried_by(v, type);
}

bool oracle_may_set(const oracle *o, unsigned vr, gm_type type, double value)
{
    const gm_variable *v = oracle_variable(vr);
    if (!v || !is_carried_by(v, type) || !oracle_is_number(value))
        return false;
    if ((v->min > -GM_FREE && value < v->min) || (v->max < GM_FREE && value > v->max))
        return false;
    if (v->causality == GM_CAUSALITY_INPUT)
        return true;
    if (o->state & BEFORE_START)
        return v->initial == GM_INITIAL_EXACT;
    return v->causality == GM_CAUSALITY_PARAMETER &&
           v->variability == GM_VARIABILITY_TUNABLE;
}
