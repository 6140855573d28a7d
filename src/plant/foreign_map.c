/* SPDX-License-Identifier: BSD-2-Clause
 *
 * From names of a rig file to variables of an FMU.
 */
#include "plant/foreign_parts.h"

#include "base/alloc.h"
#include "plant/foreign_units.h"

static gm_status map_signal(const gm_foreign *foreign, const gm_rig_signal *signal,
                            const char *what, foreign_variable *to, gm_error *error)
{
    const fmu_description *d = &foreign->description;
    *to = (foreign_variable){.factor = 1.0, .sign = signal->sign < 0 ? -1.0 : 1.0};
    if (!signal->variable)
        return GM_OK;
    to->is = gm_fmu_description_find(d, signal->variable);
    if (!to->is || to->is->kind == FMU_OTHER)
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s: the FMU has no %s '%s', named as the %s",
                       foreign->file->model_path, to->is ? "number" : "variable",
                       signal->variable, what);
    const char *unit = signal->unit && signal->unit[0] ? signal->unit : to->is->unit;
    if (!unit || !unit[0] || gm_foreign_unit(d, unit, &to->factor, &to->offset))
        return GM_OK;
    return gm_fail(
        error, GM_ERR_FORMAT,
        "%s: variable '%s' has the unit '%s', which is not known; the rig file "
        "can say another",
        foreign->file->model_path, signal->variable, unit);
}

static gm_status needs(const gm_foreign *foreign, const foreign_variable *variable,
                       const char *name, const char *what, int input, gm_error *error)
{
    if (!variable->is)
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s: %s: the rig file names no variable for the %s",
                       foreign->file->model_path, name, what);
    int settable = variable->is->causality == FMU_INPUT || variable->is->settable;
    if (!input || settable)
        return GM_OK;
    return gm_fail(error, GM_ERR_FORMAT,
                   "%s: %s: variable '%s' is no input, but the model should take the %s "
                   "there",
                   foreign->file->model_path, name, variable->is->name, what);
}

static gm_status map_flange(gm_foreign *foreign, int f, const gm_rig_flange *from,
                            const char *name, gm_error *error)
{
    foreign_flange *to = &foreign->flange[f];
    int takes_speed = from->drive == GM_RIG_SPEED_IN;
    gm_status status =
        map_signal(foreign, &from->torque, "torque of a flange", &to->torque, error);
    if (status == GM_OK)
        status =
            map_signal(foreign, &from->speed, "speed of a flange", &to->speed, error);
    if (status == GM_OK)
        status =
            map_signal(foreign, &from->angle, "angle of a flange", &to->angle, error);
    if (status == GM_OK)
        status = needs(foreign, &to->torque, name, "torque", !takes_speed, error);
    if (status == GM_OK)
        status = needs(foreign, &to->speed, name, "speed", takes_speed, error);
    return status;
}

static gm_status map_parameters(gm_foreign *foreign, gm_error *error)
{
    const gm_rig_file *file = foreign->file;
    foreign->parameters =
        gm_calloc((size_t)file->n_parameters, sizeof *foreign->parameters);
    if (!foreign->parameters)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    for (int i = 0; i < file->n_parameters; i++) {
        const gm_rig_parameter *from = &file->parameters[i];
        const char *name = from->variable[0] ? from->variable : from->id.name;
        const fmu_variable *is = gm_fmu_description_find(&foreign->description, name);
        if (!is || is->kind == FMU_OTHER)
            return gm_fail(error, GM_ERR_FORMAT,
                           "%s: the FMU has no %s '%s' to set as a parameter",
                           file->model_path, is ? "number" : "variable", name);
        foreign->parameters[i] = (foreign_parameter){is, from->value};
    }
    return GM_OK;
}

gm_status gm_foreign_map(gm_foreign *foreign, gm_error *error)
{
    const gm_rig_file *file = foreign->file;
    gm_status status = map_flange(foreign, 0, &file->output, "output", error);
    for (int p = 0; p < file->n_paths && status == GM_OK; p++) {
        const gm_rig_path *path = &file->paths[p];
        status = map_flange(foreign, 1 + p, &path->flange, path->id.name, error);
        if (status == GM_OK)
            status = map_signal(foreign, &path->gear, "gear of a path", &foreign->gear[p],
                                error);
        if (status == GM_OK && !foreign->gear[p].is &&
            (path->neutral || path->n_gears > 1))
            status = gm_fail(error, GM_ERR_FORMAT,
                             "%s: path '%s' shifts, but the rig file names no variable "
                             "for its gear",
                             file->model_path, path->id.name);
    }
    if (status == GM_OK)
        status = map_signal(foreign, &file->oil, "oil temperature", &foreign->oil, error);
    return status == GM_OK ? map_parameters(foreign, error) : status;
}
