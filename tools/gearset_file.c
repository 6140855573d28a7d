/* SPDX-License-Identifier: BSD-2-Clause */
#include "gearset_file.h"

#include "rig_source.h"

#include <math.h>
#include <string.h>

gm_status gm_gearset_file_open(const char *path, double oil_temperature,
                               gm_gearset_file *file, gm_error *error)
{
    memset(file, 0, sizeof *file);
    if (gm_rig_file_is_one(path))
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s: is a rig file; this needs the description of a gearset",
                       path);
    file->path = path;
    gm_status status = gm_description_read(path, &file->description, error);
    if (status != GM_OK)
        return status;
    file->oil_temperature =
        isnan(oil_temperature) ? file->description->oil.temperature : oil_temperature;
    status = gm_gearset_create(file->description, file->oil_temperature, &file->gearset,
                               error);
    if (status == GM_OK)
        status = gm_builtin_create(file->gearset, &file->solved, error);
    if (status != GM_OK)
        gm_gearset_file_close(file);
    file->plant = file->solved;
    file->how = (gm_experiment_choice){GM_LOSSES_STEADY, GM_INERTIA_MATRIX, 0.0, 0.0};
    return status;
}

static gm_status open_measured(const char *path, double oil_temperature,
                               const gm_experiment_choice *how, gm_gearset_file *file,
                               gm_error *error)
{
    gm_error why = {GM_OK, ""};
    gm_status status = gm_gearset_file_open(path, oil_temperature, file, error);
    if (status != GM_OK || !how)
        return status;
    file->how = *how;
    status = gm_measured_builtin_create(file->gearset, file->solved, &file->how,
                                        &file->measured, &why);
    if (status != GM_OK) {
        gm_gearset_file_close(file);
        return gm_fail(error, status, "%s: %s", path, why.message);
    }
    if (file->measured) {
        file->plant = gm_measured_builtin_plant(file->measured);
        file->inertia_uncertainty =
            gm_measured_builtin_report(file->measured).inertia_uncertainty;
    }
    return GM_OK;
}

gm_status gm_gearset_file_open_any(const char *path, double oil_temperature,
                                   const gm_experiment_choice *how, gm_gearset_file *file,
                                   gm_error *error)
{
    if (!gm_rig_file_is_one(path))
        return open_measured(path, oil_temperature, how, file, error);
    memset(file, 0, sizeof *file);
    file->path = path;
    gm_status status = gm_rig_source_open(path, oil_temperature, how, &file->rig, error);
    if (status != GM_OK)
        return status;
    file->plant = file->rig->plant;
    file->how = file->rig->how;
    file->inertia_uncertainty = file->rig->report.inertia_uncertainty;
    file->oil_temperature = file->plant->info.oil_temperature;
    return GM_OK;
}

void gm_gearset_file_close(gm_gearset_file *file)
{
    gm_rig_source_close(file->rig);
    gm_measured_builtin_destroy(file->measured);
    gm_builtin_destroy(file->solved);
    gm_gearset_destroy(file->gearset);
    gm_description_destroy(file->description);
    memset(file, 0, sizeof *file);
}
