/* SPDX-License-Identifier: BSD-2-Clause */
#include "gm_states.h"

typedef struct pair {
    gm_variable_id state, derivative;
} pair;

static const pair pairs[] = {
#define GM_STATE(state_, derivative_)                                                    \
    {.state = GM_##state_, .derivative = GM_##derivative_},
#include "gm_states.def"
#undef GM_STATE
};
enum { N_PAIRS = sizeof pairs / sizeof *pairs };

int gm_states_list(const gm_reduced_map *map, gm_reference states[GM_MAX_STATES])
{
    int n = 0;
    for (int i = 0; i < N_PAIRS; i++) {
        const gm_variable_id id = pairs[i].state;
        const int copies = gm_variables[id].scope == GM_SCOPE_PATH ? map->n_paths : 1;
        for (int p = 0; p < copies; p++) {
            const gm_reference r = {id, p};
            if (!gm_interface_is_swapped(map, r))
                states[n++] = r;
        }
    }
    return n;
}

int gm_states_count(const gm_reduced_map *map)
{
    gm_reference states[GM_MAX_STATES];
    return gm_states_list(map, states);
}

bool gm_states_derivative_of(const gm_reduced_map *map, gm_reference state,
                             gm_reference *derivative)
{
    for (int i = 0; i < N_PAIRS; i++)
        if (pairs[i].state == state.id && !gm_interface_is_swapped(map, state)) {
            *derivative = (gm_reference){pairs[i].derivative, state.path};
            return true;
        }
    return false;
}

void gm_states_get(const gm_reduced_map *map, const gm_component *c, gm_real *x)
{
    gm_reference states[GM_MAX_STATES];
    for (int i = 0, n = gm_states_list(map, states); i < n; i++)
        x[i] = c->value[states[i].id][states[i].path].real;
}

void gm_states_set(const gm_reduced_map *map, gm_component *c, const gm_real *x)
{
    gm_reference states[GM_MAX_STATES];
    for (int i = 0, n = gm_states_list(map, states); i < n; i++)
        c->value[states[i].id][states[i].path].real = x[i];
    gm_component_move(map, c);
}

bool gm_states_rates(const gm_reduced_map *map, gm_component *c, gm_real *rates)
{
    gm_reference states[GM_MAX_STATES], rate;
    for (int i = 0, n = gm_states_list(map, states); i < n; i++) {
        gm_value value;
        if (!gm_states_derivative_of(map, states[i], &rate) ||
            !gm_component_get(map, c, rate, &value))
            return false;
        rates[i] = value.real;
    }
    return true;
}

void gm_states_nominals(const gm_reduced_map *map, gm_real *nominals)
{
    gm_reference states[GM_MAX_STATES];
    for (int i = 0, n = gm_states_list(map, states); i < n; i++)
        nominals[i] = gm_variables[states[i].id].nominal;
}
