/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Inputs and outputs of a foreign FMU in SI, and its run in Co-Simulation.
 */
#include "plant/foreign_parts.h"

#include "base/alloc.h"

#include <math.h>
#include <string.h>

static gm_status set(fmi_instance *it, const foreign_variable *to, double value,
                     gm_error *error)
{
    if (!to->is)
        return GM_OK;
    double raw = (to->sign * value - to->offset) / to->factor;
    if (to->is->kind != FMU_REAL && to->is->kind != FMU_FLOAT32)
        raw = floor(raw + 0.5);
    gm_error why = {GM_OK, ""};
    fmi_answer answer = it->is->set(it, to->is->kind, to->is->reference, raw);
    gm_status status = gm_fmi_check(it, "Set", answer, &why);
    return status == GM_OK ? status
                           : gm_fail(error, status, "%.100s = %g: %.400s", to->is->name,
                                     raw, why.message);
}

static gm_status get(fmi_instance *it, const foreign_variable *from, double *value,
                     gm_error *error)
{
    double raw = (double)NAN;
    fmi_answer answer = it->is->get(it, from->is->kind, from->is->reference, &raw);
    gm_status status = gm_fmi_check(it, "Get", answer, error);
    if (status != GM_OK)
        return status;
    if (!isfinite(raw))
        return gm_fail(error, GM_ERR_SOLVE, "%s is not a number", from->is->name);
    *value = from->sign * (from->factor * raw + from->offset);
    return GM_OK;
}

gm_status gm_foreign_put(const gm_foreign *foreign, fmi_instance *it,
                         const gm_rig_command *command, const double *angle,
                         gm_error *error)
{
    gm_status status = GM_OK;
    for (int f = 0; f <= foreign->file->n_paths && status == GM_OK; f++) {
        const foreign_flange *flange = &foreign->flange[f];
        int takes_speed = foreign->rig.drive[f] == GM_RIG_SPEED_IN;
        status = set(it, takes_speed ? &flange->speed : &flange->torque,
                     command->value[f], error);
        if (status == GM_OK && takes_speed)
            status = set(it, &flange->angle, angle[f], error);
    }
    return status;
}

static double gear_command(const gm_rig_path *path, int number)
{
    if (number == 0)
        return path->neutral_command;
    for (int g = 0; g < path->n_gears; g++)
        if (path->gears[g].number == number && !isnan(path->gears[g].command))
            return path->gears[g].command;
    return number;
}

gm_status gm_foreign_begin(const gm_foreign *foreign, fmi_instance *it,
                           const gm_rig_command *command, gm_error *error)
{
    const gm_rig_file *file = foreign->file;
    const double angle[GM_MAX_FLANGES] = {0.0};
    gm_status status = gm_fmi_renew(it, foreign->folder, error);
    for (int i = 0; i < file->n_parameters && status == GM_OK; i++) {
        const foreign_variable to = {foreign->parameters[i].is, 1.0, 0.0, 1.0};
        status = set(it, &to, foreign->parameters[i].value, error);
    }
    if (status == GM_OK)
        status = set(it, &foreign->oil, file->oil_temperature, error);
    if (status == GM_OK)
        status =
            gm_fmi_check(it, "EnterInitializationMode", it->is->initialise(it), error);
    for (int p = 0; p < file->n_paths && status == GM_OK; p++)
        status = set(it, &foreign->gear[p],
                     gear_command(&file->paths[p], command->gear[p]), error);
    if (status == GM_OK)
        status = gm_foreign_put(foreign, it, command, angle, error);
    if (status == GM_OK)
        status = gm_fmi_check(it, "ExitInitializationMode", it->is->begin(it), error);
    return status;
}

gm_status gm_foreign_view(const gm_foreign *foreign, fmi_instance *it,
                          const gm_rig_command *command, gm_rig_view *view,
                          gm_error *error)
{
    gm_status status = GM_OK;
    for (int f = 0; f <= foreign->file->n_paths && status == GM_OK; f++) {
        const foreign_flange *flange = &foreign->flange[f];
        if (foreign->rig.drive[f] == GM_RIG_SPEED_IN) {
            view->speed[f] = command->value[f];
            status = get(it, &flange->torque, &view->torque[f], error);
        } else {
            view->torque[f] = command->value[f];
            status = get(it, &flange->speed, &view->speed[f], error);
        }
    }
    return status;
}

/* ---- Co-Simulation ---- */

typedef struct run {
    const gm_foreign *of;
    fmi_instance *it;
    double t;
    double angle[GM_MAX_FLANGES];
} run;

static void destroy(void *self)
{
    run *r = self;
    gm_fmi_close(r->it);
    gm_free(r);
}

static gm_status create(const void *self, void **made, gm_error *error)
{
    run *r = gm_calloc(1, sizeof *r);
    if (!r)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    r->of = self;
    gm_status status =
        gm_fmi_open(&r->of->description, r->of->folder, FMI_STEPS, &r->it, error);
    if (status != GM_OK) {
        destroy(r);
        return status;
    }
    *made = r;
    return GM_OK;
}

static gm_status start(void *self, const gm_rig_command *command, gm_rig_view *view,
                       gm_error *error)
{
    run *r = self;
    r->t = 0.0;
    memset(r->angle, 0, sizeof r->angle);
    gm_status status = gm_foreign_begin(r->of, r->it, command, error);
    return status == GM_OK ? gm_foreign_view(r->of, r->it, command, view, error) : status;
}

static gm_status step(void *self, const gm_rig_command *command, double h,
                      gm_rig_view *view, gm_error *error)
{
    run *r = self;
    for (int f = 0; f <= r->of->file->n_paths; f++)
        if (r->of->rig.drive[f] == GM_RIG_SPEED_IN)
            r->angle[f] += h * command->value[f];
    gm_status status = gm_foreign_put(r->of, r->it, command, r->angle, error);
    if (status == GM_OK)
        status = gm_fmi_check(r->it, "DoStep", r->it->is->step(r->it, r->t, h), error);
    r->t += h;
    return status == GM_OK ? gm_foreign_view(r->of, r->it, command, view, error) : status;
}

const gm_rig_class gm_foreign_rig_class = {create, destroy, start, step};
