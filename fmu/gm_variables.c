/* SPDX-License-Identifier: BSD-2-Clause */
#include "gm_variables.h"

const gm_variable gm_variables[] = {
#define GM_VAR(id, scope_, name_, type_, causality_, variability_, initial_, unit,       \
               start_, min_, max_, nominal_, description)                                \
    [GM_##id] = {.name = name_,                                                          \
                 .scope = GM_SCOPE_##scope_,                                             \
                 .type = GM_TYPE_##type_,                                                \
                 .causality = GM_CAUSALITY_##causality_,                                 \
                 .variability = GM_VARIABILITY_##variability_,                           \
                 .initial = GM_INITIAL_##initial_,                                       \
                 .start = start_,                                                        \
                 .min = min_,                                                            \
                 .max = max_,                                                            \
                 .nominal = nominal_},
#include "gm_vars.def"
#undef GM_VAR
};

bool gm_variable_find(unsigned vr, int n_paths, gm_reference *reference)
{
    unsigned id = vr / GM_SLOTS, slot = vr % GM_SLOTS;
    if (id >= GM_VARIABLES)
        return false;
    if (gm_variables[id].scope == GM_SCOPE_ALL) {
        *reference = (gm_reference){(gm_variable_id)id, 0};
        return slot == 0;
    }
    *reference = (gm_reference){(gm_variable_id)id, (int)slot - 1};
    return slot >= 1 && slot <= (unsigned)n_paths;
}

gm_type gm_variable_carrier(gm_type type)
{
    return type == GM_TYPE_STATE || type == GM_TYPE_FIDELITY ? GM_TYPE_INTEGER : type;
}
