/* SPDX-License-Identifier: BSD-2-Clause */
#include "gm_detailed.h"

#include "base/alloc.h"

#include <math.h>
#include <string.h>

/* Within this the viscosity changes by less than half a per cent. */
#define SAME_OIL 0.1 /* K */

/* ---- life ---- */

/* The parts that belong to one temperature. */
typedef struct assembly {
    gm_gearset *gearset;
    gm_motion *motion;
    gm_motion_flanges *flanges;
} assembly;

static void take_apart(assembly *a)
{
    gm_motion_flanges_destroy(a->flanges);
    gm_motion_destroy(a->motion);
    gm_gearset_destroy(a->gearset);
}

static gm_status assemble(const gm_description *description, double oil, assembly *a,
                          gm_error *error)
{
    *a = (assembly){NULL, NULL, NULL};
    gm_status status = gm_gearset_create(description, oil, &a->gearset, error);
    if (status == GM_OK)
        status = gm_motion_create(a->gearset, &a->motion, error);
    if (status == GM_OK)
        status = gm_motion_flanges_create(a->motion, &a->flanges, error);
    if (status != GM_OK)
        take_apart(a);
    return status;
}

void gm_detailed_destroy(gm_detailed *d)
{
    if (!d)
        return;
    take_apart(&(assembly){d->gearset, d->motion, d->flanges});
    gm_motion_variables_clear(&d->variables);
    gm_description_destroy(d->description);
    gm_free(d->column_start);
    gm_free(d->row);
    gm_free(d->entry);
    gm_free(d->nominal);
    gm_free(d->column);
    gm_free(d->changed);
    gm_free(d->x);
    gm_free(d->rates);
    gm_free(d->signals);
    gm_free(d);
}

static gm_status make_room(gm_detailed *d, gm_error *error)
{
    size_t n = (size_t)d->n_states, n_entries = (size_t)d->n_entries;
    d->column_start = gm_calloc((size_t)d->n_motion + 1, sizeof *d->column_start);
    d->row = gm_calloc(n_entries, sizeof *d->row);
    d->entry = gm_calloc(n_entries, sizeof *d->entry);
    d->nominal = gm_calloc(n, sizeof *d->nominal);
    d->column = gm_calloc(n, sizeof *d->column);
    d->changed = gm_calloc(n, sizeof *d->changed);
    d->x = gm_calloc(n, sizeof *d->x);
    d->rates = gm_calloc(n, sizeof *d->rates);
    d->signals = gm_calloc((size_t)gm_motion_n_signals(d->motion), sizeof *d->signals);
    if (!d->column_start || !d->row || !d->entry || !d->nominal || !d->column ||
        !d->changed || !d->x || !d->rates || !d->signals)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    return GM_OK;
}

/* Numbers that stay: sizes, the pattern, usual values of the states. */
static gm_status prepare(gm_detailed *d, gm_error *error)
{
    d->n_paths = d->description->n_paths;
    d->n_motion = gm_motion_n_states(d->motion);
    d->n_states = d->n_motion + d->n_paths + 3;
    d->n_events = gm_motion_n_events(d->motion);
    d->n_entries = gm_motion_entries(d->motion);
    gm_status status = make_room(d, error);
    if (status == GM_OK)
        status = gm_motion_variables_make(d->motion, &d->variables, error);
    if (status == GM_OK)
        status = gm_motion_guid(d->motion, &d->variables, d->guid, error);
    if (status != GM_OK)
        return status;
    gm_motion_pattern(d->motion, d->column_start, d->row);
    gm_motion_tolerances(d->motion, 1.0, d->nominal);
    for (int f = 0; f <= d->n_paths; f++)
        d->nominal[d->n_motion + f] = gm_variables[GM_OUTPUT_PHI].nominal;
    d->nominal[d->n_states - 2] = gm_variables[GM_WORK].nominal;
    d->nominal[d->n_states - 1] = gm_variables[GM_LOSS_ENERGY].nominal;
    return GM_OK;
}

gm_status gm_detailed_create(const char *path, gm_detailed **detailed, gm_error *error)
{
    assembly made = {NULL, NULL, NULL};
    gm_detailed *d = gm_calloc(1, sizeof *d);
    if (!d)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    gm_status status = gm_description_read(path, &d->description, error);
    if (status == GM_OK)
        status = assemble(d->description, d->description->oil.temperature, &made, error);
    if (status == GM_OK) {
        d->gearset = made.gearset;
        d->motion = made.motion;
        d->flanges = made.flanges;
        status = prepare(d, error);
    }
    if (status != GM_OK) {
        gm_detailed_destroy(d);
        return status;
    }
    gm_detailed_reset(d);
    *detailed = d;
    return GM_OK;
}

/* ---- what is set ---- */

double gm_detailed_start_value(const gm_detailed *d, gm_reference reference)
{
    if (reference.id == GM_OIL_TEMPERATURE)
        return d->description->oil.temperature;
    if (reference.id == GM_PATH_GEAR)
        return gm_path_rest_gear(&d->description->paths[reference.path]);
    if (reference.id == GM_PATH_SYNC_TORQUE)
        return fmin(gm_gearset_sync_torque(d->gearset, reference.path), GM_INFINITE);
    return gm_variables[reference.id].start;
}

static void forget(gm_detailed *d)
{
    d->rates_known = d->signals_known = d->losses_known = false;
}

void gm_detailed_reset(gm_detailed *d)
{
    for (int id = 0; id < GM_VARIABLES; id++)
        for (int p = 0; p < d->n_paths; p++)
            d->value[id][p] =
                gm_detailed_start_value(d, (gm_reference){(gm_variable_id)id, p});
    memset(d->refused, 0, sizeof d->refused);
    memset(&d->input, 0, sizeof d->input);
    for (int p = 0; p < d->n_paths; p++)
        d->input.gear[p] = gm_path_rest_gear(&d->description->paths[p]);
    memset(d->x, 0, (size_t)d->n_states * sizeof *d->x);
    d->start_pending = true;
    forget(d);
}

void gm_detailed_set(gm_detailed *d, gm_reference reference, double value)
{
    d->value[reference.id][reference.path] = value;
    if (reference.id == GM_OUTPUT_TAU)
        d->input.torque[0] = value;
    if (reference.id == GM_PATH_TAU)
        d->input.torque[1 + reference.path] = value;
    d->start_pending = true;
    forget(d);
}

void gm_detailed_set_states(gm_detailed *d, const double *x)
{
    memcpy(d->x, x, (size_t)d->n_states * sizeof *d->x);
    forget(d);
}

/* ---- start and events ---- */

gm_status gm_detailed_take_oil(gm_detailed *d, double oil, gm_error *error)
{
    if (oil == gm_gearset_oil_temperature(d->gearset))
        return GM_OK;
    assembly made;
    double *modes = gm_calloc((size_t)gm_motion_n_modes(d->motion), sizeof *modes);
    if (!modes)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    gm_motion_get_modes(d->motion, modes);
    gm_status status = assemble(d->description, oil, &made, error);
    if (status == GM_OK) {
        take_apart(&(assembly){d->gearset, d->motion, d->flanges});
        d->gearset = made.gearset;
        d->motion = made.motion;
        d->flanges = made.flanges;
        (void)gm_motion_set_modes(d->motion, modes); /* they are its own */
    }
    gm_free(modes);
    return status;
}

void gm_detailed_take_parameters(gm_detailed *d)
{
    gm_motion_scale_losses(d->motion, d->value[GM_LOSS_SCALE][0]);
    for (int p = 0; p < d->n_paths; p++) {
        double usual = gm_gearset_sync_torque(d->gearset, p);
        double wanted = d->value[GM_PATH_SYNC_TORQUE][p];
        gm_motion_scale_cones(d->motion, p, usual < GM_INFINITE ? wanted / usual : 1.0);
    }
}

/* Unknown gears leave the one that was. */
static void take_gears(gm_detailed *d)
{
    for (int p = 0; p < d->n_paths; p++) {
        int gear = (int)d->value[GM_PATH_GEAR][p];
        d->refused[p] = !gm_path_gear_of(&d->description->paths[p], gear);
        if (!d->refused[p])
            d->input.gear[p] = gear;
    }
}

gm_status gm_detailed_start(gm_detailed *d, gm_error *error)
{
    double speed[GM_MAX_FLANGES];
    if (!d->start_pending)
        return GM_OK;
    gm_status status = gm_detailed_take_oil(d, d->value[GM_OIL_TEMPERATURE][0], error);
    if (status != GM_OK)
        return status;
    gm_detailed_take_parameters(d);
    take_gears(d);
    speed[0] = d->value[GM_OUTPUT_W_START][0];
    d->x[d->n_motion] = d->value[GM_OUTPUT_PHI][0];
    for (int p = 0; p < d->n_paths; p++) {
        speed[1 + p] = d->value[GM_PATH_W_START][p];
        d->x[d->n_motion + 1 + p] = d->value[GM_PATH_PHI][p];
    }
    d->x[d->n_states - 2] = d->value[GM_WORK][0];
    d->x[d->n_states - 1] = d->value[GM_LOSS_ENERGY][0];
    status = gm_motion_start(d->motion, &d->input, speed, d->x, error);
    if (status == GM_OK)
        status = gm_motion_flanges_update(d->flanges, error);
    d->jump_loss = 0.0;
    d->start_pending = status != GM_OK;
    forget(d);
    return status;
}

gm_status gm_detailed_update(gm_detailed *d, bool *jumped, gm_error *error)
{
    int changed = 0;
    size_t size = (size_t)d->n_states * sizeof *d->x;
    gm_status status = gm_detailed_take_oil(d, d->value[GM_OIL_TEMPERATURE][0], error);
    if (status != GM_OK)
        return status;
    gm_detailed_take_parameters(d);
    take_gears(d);
    forget(d);
    memcpy(d->changed, d->x, size);
    status = gm_motion_handle(d->motion, &d->input, d->x, &changed, error);
    if (status == GM_OK)
        status = gm_motion_flanges_update(d->flanges, error);
    if (status != GM_OK)
        return status;
    gm_motion_view_at(d->motion, &d->input, d->x, &d->view);
    d->x[d->n_states - 1] += d->view.jump_loss - d->jump_loss;
    d->jump_loss = d->view.jump_loss;
    *jumped = memcmp(d->changed, d->x, size) != 0;
    return GM_OK;
}

bool gm_detailed_is_due(gm_detailed *d)
{
    bool due = fabs(d->value[GM_OIL_TEMPERATURE][0] -
                    gm_gearset_oil_temperature(d->gearset)) > SAME_OIL;
    gm_detailed_events(d, d->changed);
    for (int i = 0; i < d->n_events; i++)
        due = due || d->changed[i] <= 0.0;
    return due;
}
