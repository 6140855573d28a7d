/* SPDX-License-Identifier: BSD-2-Clause */
#include "gm_component.h"

#include <stddef.h>

static gm_reduced_params params_of(const gm_component *c)
{
    gm_reduced_params params = {.fidelity = c->value[GM_FIDELITY][0].integer,
                                .loss_scale = c->value[GM_LOSS_SCALE][0].real};
    for (int p = 0; p < GM_MAX_PATHS; p++)
        params.sync_torque[p] = c->value[GM_PATH_SYNC_TORQUE][p].real;
    return params;
}

/* Inputs over the next h seconds; 0: at this instant. A torque that goes out is none. */
static gm_reduced_inputs inputs_of(const gm_reduced_map *map, const gm_component *c,
                                   gm_real h)
{
    gm_reduced_inputs inputs = {.oil_temperature = c->value[GM_OIL_TEMPERATURE][0].real};
    if (map->prescribed[GM_OUTPUT_FLANGE]) {
        inputs.w[GM_OUTPUT_FLANGE] = c->value[GM_OUTPUT_W][0].real;
        inputs.a[GM_OUTPUT_FLANGE] =
            c->value[GM_OUTPUT_A][0].real + h / 2 * c->output_rate;
    } else {
        inputs.output_tau = c->value[GM_OUTPUT_TAU][0].real;
        inputs.output_tau_rate = c->output_rate;
    }
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        inputs.gear[p] = c->value[GM_PATH_GEAR][p].integer;
        if (map->prescribed[p]) {
            inputs.w[p] = c->value[GM_PATH_W][p].real;
            inputs.a[p] = c->value[GM_PATH_A][p].real + h / 2 * c->path_rate[p];
        } else {
            inputs.path_tau[p] = c->value[GM_PATH_TAU][p].real;
            inputs.path_tau_rate[p] = c->path_rate[p];
        }
    }
    return inputs;
}

void gm_component_reset(const gm_reduced_map *map, gm_component *c)
{
    bool exchange = c->exchange;
    *c = (gm_component){
        .start_pending = true, .outputs_pending = true, .exchange = exchange};
    for (int id = 0; id < GM_VARIABLES; id++)
        for (int p = 0; p < GM_MAX_PATHS; p++)
            if (gm_variables[id].type == GM_TYPE_REAL)
                c->value[id][p].real = gm_variables[id].start;
            else
                c->value[id][p].integer = (int)gm_variables[id].start;
    c->value[GM_OIL_TEMPERATURE][0].real = map->oil_temperature;
    for (int p = 0; p < map->n_paths; p++) {
        gm_real torque = map->path[p].sync_torque;
        c->value[GM_PATH_SYNC_TORQUE][p].real =
            torque < GM_INFINITE ? torque : GM_INFINITE;
        if (!gm_reduced_has_neutral(map, p))
            c->value[GM_PATH_GEAR][p].integer = map->path[p].gears[0].number;
    }
}

/* Copy what the state says into the variables: no evaluation needed for these. */
static void publish(const gm_reduced_map *map, gm_component *c)
{
    static const int refused[GM_MAX_PATHS] = {GM_FLAG_GEAR_REFUSED_0,
                                              GM_FLAG_GEAR_REFUSED_1};
    const gm_reduced_state *s = &c->state;
    c->value[GM_OUTPUT_PHI][0].real = s->phi_o;
    c->value[GM_OUTPUT_W][0].real = s->w_o;
    c->value[GM_WORK][0].real = s->work;
    c->value[GM_LOSS_ENERGY][0].real = s->loss_energy;
    for (int p = 0; p < map->n_paths; p++) {
        c->value[GM_PATH_PHI][p].real = s->path[p].phi;
        c->value[GM_PATH_W][p].real = s->path[p].w;
        c->value[GM_PATH_TWIST][p].real = s->path[p].twist;
        c->value[GM_PATH_STATE][p].integer = s->path[p].mode;
        c->value[GM_PATH_GEAR_REFUSED][p].integer = (c->flags & refused[p]) != 0;
    }
    c->outputs_pending = true;
}

/* Angles have no influence on the motion: those that are prescribed go on from where they
 * were set. */
static void take_angles(const gm_reduced_map *map, gm_component *c)
{
    if (map->prescribed[GM_OUTPUT_FLANGE])
        c->state.phi_o = c->value[GM_OUTPUT_PHI][0].real;
    for (int p = 0; p < map->n_paths; p++)
        if (map->prescribed[p])
            c->state.path[p].phi = c->value[GM_PATH_PHI][p].real;
}

/* Flags of an update, which counts as a start or step. */
static int find_modes(const gm_reduced_map *map, gm_component *c, int *jumped)
{
    gm_reduced_params params = params_of(c);
    gm_reduced_inputs inputs = inputs_of(map, c, 0.0);
    take_angles(map, c);
    return gm_reduced_modes_update(map, &params, &inputs, &c->state, &c->modes, jumped);
}

int gm_component_start(const gm_reduced_map *map, gm_component *c)
{
    gm_reduced_inputs inputs = inputs_of(map, c, 0.0);
    gm_reduced_state state;
    gm_real w[GM_MAX_PATHS];
    for (int p = 0; p < GM_MAX_PATHS; p++)
        w[p] = c->value[GM_PATH_W_START][p].real;
    int flags =
        gm_reduced_start(map, &inputs, c->value[GM_OUTPUT_W_START][0].real, w, &state);
    if (flags & GM_FLAG_NOT_FINITE)
        return flags;
    state.phi_o = c->value[GM_OUTPUT_PHI][0].real;
    state.work = c->value[GM_WORK][0].real;
    state.loss_energy = c->value[GM_LOSS_ENERGY][0].real;
    for (int p = 0; p < map->n_paths; p++) {
        state.path[p].phi = c->value[GM_PATH_PHI][p].real;
        state.path[p].twist = c->value[GM_PATH_TWIST][p].real;
    }
    c->state = state;
    if (c->exchange) {
        int jumped;
        c->modes = (gm_reduced_modes){.outside = 0};
        flags |= find_modes(map, c, &jumped);
        if (flags & GM_FLAG_NOT_FINITE)
            return flags;
    }
    c->flags = flags;
    c->start_pending = false;
    publish(map, c);
    return flags;
}

/* Inputs with a slope, h seconds later. */
static void lead_inputs(const gm_reduced_map *map, gm_component *c, gm_real h)
{
    const bool given = map->prescribed[GM_OUTPUT_FLANGE] != 0;
    c->value[given ? GM_OUTPUT_A : GM_OUTPUT_TAU][0].real += c->output_rate * h;
    for (int p = 0; p < map->n_paths; p++)
        c->value[map->prescribed[p] ? GM_PATH_A : GM_PATH_TAU][p].real +=
            c->path_rate[p] * h;
}

int gm_component_step(const gm_reduced_map *map, gm_component *c, gm_real h)
{
    gm_reduced_params params = params_of(c);
    gm_reduced_inputs inputs = inputs_of(map, c, h);
    take_angles(map, c);
    int flags = gm_reduced_step(map, &params, &inputs, h, &c->state);
    if (flags & GM_FLAG_NOT_FINITE)
        return flags;
    c->flags = flags;
    lead_inputs(map, c, h);
    publish(map, c);
    return flags;
}

int gm_component_update(const gm_reduced_map *map, gm_component *c, bool *jumped)
{
    int moved = 0, flags = find_modes(map, c, &moved);
    if (flags & GM_FLAG_NOT_FINITE)
        return flags;
    c->flags = flags;
    *jumped = moved != 0;
    publish(map, c);
    return flags;
}

bool gm_component_indicators(const gm_reduced_map *map, gm_component *c, gm_real *z)
{
    gm_reduced_params params = params_of(c);
    gm_reduced_inputs inputs = inputs_of(map, c, 0.0);
    int flags =
        gm_reduced_modes_indicators(map, &params, &inputs, &c->modes, &c->state, z);
    return !(flags & GM_FLAG_NOT_FINITE);
}

bool gm_component_derivative(const gm_reduced_map *map, gm_component *c,
                             const gm_reduced_change *by, gm_reduced_outputs *derivative)
{
    gm_reduced_params params = params_of(c);
    gm_reduced_inputs inputs = inputs_of(map, c, 0.0);
    int flags = gm_reduced_derivative(
        map, &params, &inputs, c->exchange ? &c->modes : NULL, &c->state, by, derivative);
    return !(flags & GM_FLAG_NOT_FINITE);
}

void gm_component_move(const gm_reduced_map *map, gm_component *c)
{
    gm_reduced_state *s = &c->state;
    s->phi_o = c->value[GM_OUTPUT_PHI][0].real;
    s->w_o = c->value[GM_OUTPUT_W][0].real;
    s->work = c->value[GM_WORK][0].real;
    s->loss_energy = c->value[GM_LOSS_ENERGY][0].real;
    for (int p = 0; p < map->n_paths; p++) {
        s->path[p].phi = c->value[GM_PATH_PHI][p].real;
        s->path[p].w = c->value[GM_PATH_W][p].real;
        s->path[p].twist = c->value[GM_PATH_TWIST][p].real;
    }
    c->outputs_pending = true;
}

void gm_component_set(gm_component *c, gm_reference reference, gm_value value)
{
    c->value[reference.id][reference.path] = value;
    c->start_pending = true;
    c->outputs_pending = true;
}

void gm_component_set_rate(gm_component *c, gm_reference reference, gm_real rate)
{
    if (reference.id == GM_OUTPUT_TAU || reference.id == GM_OUTPUT_A)
        c->output_rate = rate;
    else if (reference.id == GM_PATH_TAU || reference.id == GM_PATH_A)
        c->path_rate[reference.path] = rate;
}

static int observe(const gm_reduced_map *map, gm_component *c, gm_reduced_outputs *out)
{
    gm_reduced_params params = params_of(c);
    gm_reduced_inputs inputs = inputs_of(map, c, 0.0);
    if (c->exchange)
        return gm_reduced_modes_outputs(map, &params, &inputs, &c->modes, &c->state, out);
    return gm_reduced_outputs_at(map, &params, &inputs, &c->state, out);
}

static gm_real flange_power(const gm_reduced_map *map, const gm_component *c)
{
    gm_real sum = c->value[GM_OUTPUT_TAU][0].real * c->value[GM_OUTPUT_W][0].real;
    for (int p = 0; p < map->n_paths; p++)
        sum += c->value[GM_PATH_TAU][p].real * c->value[GM_PATH_W][p].real;
    return sum;
}

/* Whether the map is left: in an exchange this changes at events only. */
static bool is_outside(const gm_component *c, int flags)
{
    return c->exchange ? c->modes.outside
                       : ((flags | c->flags) & GM_FLAG_OUT_OF_MAP) != 0;
}

/* What each flange tells beside its speed: the acceleration, or the torque that a
 * prescribed motion takes. */
static void take_flanges(const gm_reduced_map *map, const gm_reduced_outputs *out,
                         gm_component *c)
{
    if (map->prescribed[GM_OUTPUT_FLANGE])
        c->value[GM_OUTPUT_TAU][0].real = out->tau[GM_OUTPUT_FLANGE];
    else
        c->value[GM_OUTPUT_A][0].real = out->a_o;
    for (int p = 0; p < map->n_paths; p++)
        if (map->prescribed[p])
            c->value[GM_PATH_TAU][p].real = out->tau[p];
        else
            c->value[GM_PATH_A][p].real = out->a[p];
}

/* Accelerations, losses and energies of the state under the present inputs. */
static bool evaluate(const gm_reduced_map *map, gm_component *c)
{
    gm_reduced_outputs out;
    int flags = observe(map, c, &out);
    if (flags & GM_FLAG_NOT_FINITE)
        return false;
    take_flanges(map, &out, c);
    gm_real power = flange_power(map, c);
    if (power - power != 0.0)
        return false;
    c->value[GM_POWER][0].real = power;
    c->value[GM_OUTPUT_LOSS_TORQUE][0].real = out.output_loss_torque;
    c->value[GM_LOSS_POWER][0].real = out.loss_power;
    c->value[GM_KINETIC_ENERGY][0].real = out.kinetic_energy;
    c->value[GM_ELASTIC_ENERGY][0].real = out.elastic_energy;
    c->value[GM_OUTPUT_INERTIA][0].real = out.inertia_o;
    c->value[GM_RECOMMENDED_STEP][0].real = out.step;
    c->value[GM_OUT_OF_MAP][0].integer = is_outside(c, flags);
    for (int p = 0; p < map->n_paths; p++) {
        c->value[GM_PATH_TWIST_RATE][p].real = out.twist_rate[p];
        c->value[GM_PATH_INERTIA][p].real = out.inertia[p];
        c->value[GM_PATH_LOSS_TORQUE][p].real = out.path_loss_torque[p];
    }
    c->outputs_pending = false;
    return true;
}

/* Does the variable come from evaluate, not from the state? */
static bool is_evaluated(const gm_reduced_map *map, gm_reference reference)
{
    switch (reference.id) {
    case GM_OUTPUT_A:
    case GM_PATH_A:
        return !gm_interface_is_swapped(map, reference);
    case GM_OUTPUT_TAU:
    case GM_PATH_TAU:
        return gm_interface_is_swapped(map, reference);
    case GM_OUTPUT_LOSS_TORQUE:
    case GM_POWER:
    case GM_LOSS_POWER:
    case GM_KINETIC_ENERGY:
    case GM_ELASTIC_ENERGY:
    case GM_OUTPUT_INERTIA:
    case GM_RECOMMENDED_STEP:
    case GM_PATH_INERTIA:
    case GM_OUT_OF_MAP:
    case GM_PATH_TWIST_RATE:
    case GM_PATH_LOSS_TORQUE:
        return true;
    default:
        return false;
    }
}

bool gm_component_get(const gm_reduced_map *map, gm_component *c, gm_reference reference,
                      gm_value *value)
{
    if (is_evaluated(map, reference) && c->outputs_pending && !evaluate(map, c))
        return false;
    *value = c->value[reference.id][reference.path];
    return true;
}
