/* SPDX-License-Identifier: BSD-2-Clause */
#include "gm_interface.h"

static bool is_prescribed(const gm_reduced_map *map, gm_reference r)
{
    const bool of_a_path = gm_variables[r.id].scope == GM_SCOPE_PATH;
    return map->prescribed[of_a_path ? r.path : GM_OUTPUT_FLANGE] != 0;
}

bool gm_interface_find(const gm_reduced_map *map, unsigned vr, gm_reference *reference)
{
    if (!gm_variable_find(vr, map->n_paths, reference))
        return false;
    const bool is_start =
        reference->id == GM_PATH_W_START || reference->id == GM_OUTPUT_W_START;
    return !(is_start && is_prescribed(map, *reference));
}

bool gm_interface_is_swapped(const gm_reduced_map *map, gm_reference reference)
{
    switch (reference.id) {
    case GM_PATH_TAU:
    case GM_PATH_PHI:
    case GM_PATH_W:
    case GM_PATH_A:
    case GM_OUTPUT_TAU:
    case GM_OUTPUT_PHI:
    case GM_OUTPUT_W:
    case GM_OUTPUT_A:
        return is_prescribed(map, reference);
    default:
        return false;
    }
}

gm_causality gm_interface_causality(const gm_reduced_map *map, gm_reference reference)
{
    const gm_causality usual = gm_variables[reference.id].causality;
    if (!gm_interface_is_swapped(map, reference))
        return usual;
    return usual == GM_CAUSALITY_INPUT ? GM_CAUSALITY_OUTPUT : GM_CAUSALITY_INPUT;
}

gm_initial gm_interface_initial(const gm_reduced_map *map, gm_reference reference)
{
    if (!gm_interface_is_swapped(map, reference))
        return gm_variables[reference.id].initial;
    return gm_interface_causality(map, reference) == GM_CAUSALITY_INPUT
               ? GM_INITIAL_NONE
               : GM_INITIAL_CALCULATED;
}

gm_real gm_interface_min(const gm_reduced_map *map, gm_reference reference)
{
    bool path = false;
    for (int p = 0; p < map->n_paths; p++)
        path = path || map->prescribed[p];
    return reference.id == GM_FIDELITY && path ? GM_LASH : gm_variables[reference.id].min;
}
