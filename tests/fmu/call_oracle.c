/* SPDX-License-Identifier: BSD-2-Clause */
#include "call_oracle.h"

#include <stddef.h>

bool oracle_is_number(double x)
{
    return x - x == 0;
}

const gm_variable *oracle_variable(unsigned vr)
{
    unsigned id = vr / GM_SLOTS, slot = vr % GM_SLOTS;
    if (id >= GM_VARIABLES || slot > 2)
        return NULL;
    bool of_a_path = gm_variables[id].scope == GM_SCOPE_PATH;
    return of_a_path == (slot > 0) ? &gm_variables[id] : NULL;
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
