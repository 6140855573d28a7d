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

static int copies(const pair *p, int n_paths)
{
    return gm_variables[p->state].scope == GM_SCOPE_PATH ? n_paths : 1;
}

int gm_states_count(int n_paths)
{
    int n = 0;
    for (int i = 0; i < N_PAIRS; i++)
        n += copies(&pairs[i], n_paths);
    return n;
}

/* Pair that state i belongs to; *path receives which copy. */
static const pair *find(int n_paths, int i, int *path)
{
    const pair *p = pairs;
    for (; i >= copies(p, n_paths); p++)
        i -= copies(p, n_paths);
    *path = i;
    return p;
}

gm_reference gm_states_variable(int n_paths, int i)
{
    gm_reference r;
    r.id = find(n_paths, i, &r.path)->state;
    return r;
}

gm_reference gm_states_derivative(int n_paths, int i)
{
    gm_reference r;
    r.id = find(n_paths, i, &r.path)->derivative;
    return r;
}

bool gm_states_derivative_of(gm_reference state, gm_reference *derivative)
{
    for (int i = 0; i < N_PAIRS; i++)
        if (pairs[i].state == state.id) {
            *derivative = (gm_reference){pairs[i].derivative, state.path};
            return true;
        }
    return false;
}

void gm_states_get(const gm_reduced_map *map, const gm_component *c, gm_real *x)
{
    for (int i = 0, n = gm_states_count(map->n_paths); i < n; i++) {
        gm_reference r = gm_states_variable(map->n_paths, i);
        x[i] = c->value[r.id][r.path].real;
    }
}

void gm_states_set(const gm_reduced_map *map, gm_component *c, const gm_real *x)
{
    for (int i = 0, n = gm_states_count(map->n_paths); i < n; i++) {
        gm_reference r = gm_states_variable(map->n_paths, i);
        c->value[r.id][r.path].real = x[i];
    }
    gm_component_move(map, c);
}

bool gm_states_rates(const gm_reduced_map *map, gm_component *c, gm_real *rates)
{
    for (int i = 0, n = gm_states_count(map->n_paths); i < n; i++) {
        gm_value value;
        if (!gm_component_get(map, c, gm_states_derivative(map->n_paths, i), &value))
            return false;
        rates[i] = value.real;
    }
    return true;
}

void gm_states_nominals(int n_paths, gm_real *nominals)
{
    for (int i = 0, n = gm_states_count(n_paths); i < n; i++)
        nominals[i] = gm_variables[gm_states_variable(n_paths, i).id].nominal;
}
