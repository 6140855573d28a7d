/* SPDX-License-Identifier: BSD-2-Clause */
#include "gm_gearset.h"

#define LONGEST_STEP 1 /* s */

static int is_finite(gm_real x)
{
    return x - x == 0;
}

void gm_gearset_defaults(const gm_reduced_map *map, gm_gearset_start *start)
{
    static const gm_gearset_start zero = {{0, 0, {0}}, {0}, 0, {0}};
    *start = zero;
    gm_reduced_default_params(map, &start->params);
    for (int p = 0; p < map->n_paths; p++) {
        if (!gm_reduced_has_neutral(map, p)) {
            start->gear[p] = map->path[p].gears[0].number;
        }
    }
}

static int is_usable(const gm_reduced_map *map, const gm_gearset_start *start)
{
    const gm_reduced_params *params = &start->params;
    int usable = (params->fidelity == GM_RIGID || params->fidelity == GM_LASH) &&
                 params->loss_scale >= 0 && is_finite(params->loss_scale);
    for (int p = 0; p < map->n_paths; p++) {
        usable = usable && params->sync_torque[p] > 0;
    }
    return usable;
}

static void begin(const gm_gearset_start *start, gm_gearset *g)
{
    static const gm_gearset zero = {.flags = 0};
    *g = zero;
    g->params = start->params;
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        g->inputs.gear[p] = start->gear[p];
    }
}

int gm_gearset_init(const gm_reduced_map *map, const gm_gearset_start *start,
                    gm_gearset *g)
{
    gm_gearset_start rest;
    int flags = GM_FLAG_NOT_FINITE;
    begin(start, g);
    g->inputs.oil_temperature = map->oil_temperature;
    if (is_usable(map, start)) {
        flags = gm_reduced_start(map, &g->inputs, start->w_o, start->w, &g->state);
    }
    if (flags & GM_FLAG_NOT_FINITE) {
        gm_gearset_defaults(map, &rest);
        begin(&rest, g);
        g->inputs.oil_temperature = map->oil_temperature;
        flags |= gm_reduced_start(map, &g->inputs, rest.w_o, rest.w, &g->state);
    }
    g->flags = flags;
    return flags;
}

void gm_gearset_set(const gm_reduced_inputs *inputs, gm_gearset *g)
{
    g->inputs = *inputs;
}

/* What the step has added goes to the sums. */
static void collect(const gm_reduced_map *map, gm_gearset *g)
{
    gm_reduced_state *s = &g->state;
    g->phi_o = gm_sum_add(g->phi_o, s->phi_o);
    g->work = gm_sum_add(g->work, s->work);
    g->loss_energy = gm_sum_add(g->loss_energy, s->loss_energy);
    s->phi_o = s->work = s->loss_energy = 0;
    for (int p = 0; p < map->n_paths; p++) {
        g->phi[p] = gm_sum_add(g->phi[p], s->path[p].phi);
        s->path[p].phi = 0;
    }
}

int gm_gearset_step(const gm_reduced_map *map, gm_gearset *g, gm_real h)
{
    int flags = GM_FLAG_NOT_FINITE;
    if (h > 0 && h <= LONGEST_STEP) {
        flags = gm_reduced_step(map, &g->params, &g->inputs, h, &g->state);
    }
    if (!(flags & GM_FLAG_NOT_FINITE)) {
        collect(map, g);
    }
    g->flags = flags;
    return flags;
}

static gm_real flange_power(const gm_reduced_map *map, const gm_gearset *g)
{
    gm_real sum = g->inputs.output_tau * g->state.w_o;
    for (int p = 0; p < map->n_paths; p++) {
        sum += g->inputs.path_tau[p] * g->state.path[p].w;
    }
    return sum;
}

int gm_gearset_get(const gm_reduced_map *map, gm_gearset *g, gm_gearset_outputs *outputs)
{
    gm_reduced_outputs at;
    const gm_real power = flange_power(map, g);
    const int flags = gm_reduced_outputs_at(map, &g->params, &g->inputs, &g->state, &at);
    if ((flags & GM_FLAG_NOT_FINITE) || !is_finite(power)) {
        return flags | GM_FLAG_NOT_FINITE;
    }
    outputs->at = at;
    outputs->power = power;
    outputs->w_o = g->state.w_o;
    outputs->phi_o = g->phi_o;
    outputs->work = g->work;
    outputs->loss_energy = g->loss_energy;
    outputs->flags = flags | g->flags;
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        outputs->w[p] = g->state.path[p].w;
        outputs->phi[p] = g->phi[p];
        outputs->twist[p] = g->state.path[p].twist;
        outputs->mode[p] = g->state.path[p].mode;
    }
    return flags;
}
