/* SPDX-License-Identifier: BSD-2-Clause */
#include "gm_gradient.h"

bool gm_gradient_is_known(const gm_reduced_map *map, gm_reference reference, bool initial)
{
    const gm_variable *v = &gm_variables[reference.id];
    gm_reference unused;
    if (v->type != GM_TYPE_REAL)
        return false;
    if (gm_interface_causality(map, reference) == GM_CAUSALITY_INPUT)
        return true;
    return initial ? gm_interface_initial(map, reference) == GM_INITIAL_EXACT
                   : gm_states_derivative_of(map, reference, &unused);
}

/* Ratio of the gear that path p is in; 0 in neutral. */
static gm_real ratio_of(const gm_reduced_map *map, const gm_component *c, int p)
{
    const gm_path_state *path = &c->state.path[p];
    return path->mode == GM_PATH_ENGAGED ? map->path[p].gears[path->gear].ratio : 0.0;
}

/* At the start the output's speed is given, or follows the first engaged path that is. */
static gm_real start_output(const gm_reduced_map *map, const gm_component *c,
                            const gm_rates *known)
{
    if (map->prescribed[GM_OUTPUT_FLANGE])
        return known->of[GM_OUTPUT_W][0];
    for (int p = 0; p < map->n_paths; p++)
        if (map->prescribed[p] && ratio_of(map, c, p) != 0.0)
            return known->of[GM_PATH_W][p] / ratio_of(map, c, p);
    return known->of[GM_OUTPUT_W_START][0];
}

/* At the start the states follow the start values: engaged paths turn with the output. */
static void start_states(const gm_reduced_map *map, const gm_component *c,
                         const gm_rates *known, gm_rates *r)
{
    gm_real w_o = start_output(map, c, known);
    r->of[GM_OUTPUT_W][0] = w_o;
    for (int p = 0; p < map->n_paths; p++) {
        const gm_real ratio = ratio_of(map, c, p);
        if (!map->prescribed[p])
            r->of[GM_PATH_W][p] =
                ratio != 0.0 ? ratio * w_o : known->of[GM_PATH_W_START][p];
    }
}

static gm_reduced_change change_of(const gm_reduced_map *map, const gm_rates *r)
{
    gm_reduced_change by = {
        .w_o = r->of[GM_OUTPUT_W][0],
        .output_tau = r->of[GM_OUTPUT_TAU][0],
        .loss_scale = r->of[GM_LOSS_SCALE][0],
        .oil_temperature = r->of[GM_OIL_TEMPERATURE][0],
        .a[GM_OUTPUT_FLANGE] = r->of[GM_OUTPUT_A][0],
    };
    for (int p = 0; p < map->n_paths; p++) {
        by.w[p] = r->of[GM_PATH_W][p];
        by.twist[p] = r->of[GM_PATH_TWIST][p];
        by.path_tau[p] = r->of[GM_PATH_TAU][p];
        by.a[p] = r->of[GM_PATH_A][p];
    }
    return by;
}

static gm_real power_rate(const gm_reduced_map *map, const gm_component *c,
                          const gm_rates *r)
{
    gm_real sum = r->of[GM_OUTPUT_TAU][0] * c->value[GM_OUTPUT_W][0].real +
                  c->value[GM_OUTPUT_TAU][0].real * r->of[GM_OUTPUT_W][0];
    for (int p = 0; p < map->n_paths; p++)
        sum += r->of[GM_PATH_TAU][p] * c->value[GM_PATH_W][p].real +
               c->value[GM_PATH_TAU][p].real * r->of[GM_PATH_W][p];
    return sum;
}

/* What each flange tells: its acceleration, or the torque that a prescribed motion takes.
 */
static void follow_flanges(const gm_reduced_map *map, const gm_reduced_outputs *o,
                           gm_rates *r)
{
    if (map->prescribed[GM_OUTPUT_FLANGE])
        r->of[GM_OUTPUT_TAU][0] = o->tau[GM_OUTPUT_FLANGE];
    else
        r->of[GM_OUTPUT_A][0] = o->a_o;
    for (int p = 0; p < map->n_paths; p++)
        if (map->prescribed[p])
            r->of[GM_PATH_TAU][p] = o->tau[p];
        else
            r->of[GM_PATH_A][p] = o->a[p];
}

/* The torques that are outputs, at this instant: power follows speeds by them. */
static bool are_torques_known(const gm_reduced_map *map, gm_component *c)
{
    gm_value power;
    return gm_component_get(map, c, (gm_reference){GM_POWER, 0}, &power);
}

bool gm_gradient_follow(const gm_reduced_map *map, gm_component *c, bool initial,
                        const gm_rates *known, gm_rates *outputs)
{
    gm_rates r = *known; /* states follow themselves */
    gm_reduced_outputs o;
    if (initial)
        start_states(map, c, known, &r);
    gm_reduced_change by = change_of(map, &r);
    if (!are_torques_known(map, c) || !gm_component_derivative(map, c, &by, &o))
        return false;
    follow_flanges(map, &o, &r);
    r.of[GM_OUTPUT_LOSS_TORQUE][0] = o.output_loss_torque;
    r.of[GM_POWER][0] = power_rate(map, c, &r);
    r.of[GM_LOSS_POWER][0] = o.loss_power;
    r.of[GM_KINETIC_ENERGY][0] = o.kinetic_energy;
    r.of[GM_ELASTIC_ENERGY][0] = o.elastic_energy;
    for (int p = 0; p < map->n_paths; p++) {
        r.of[GM_PATH_TWIST_RATE][p] = o.twist_rate[p];
        r.of[GM_PATH_LOSS_TORQUE][p] = o.path_loss_torque[p];
    }
    *outputs = r;
    return true;
}
