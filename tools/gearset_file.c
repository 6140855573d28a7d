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
        status = gm_builtin_create(file->gearset, &file->plant, error);
    if (status != GM_OK)
        gm_gearset_file_close(file);
    return status;
}

gm_status gm_gearset_file_open_any(const char *path, double oil_temperature,
                                   gm_gearset_file *file, gm_error *error)
{
    if (!gm_rig_file_is_one(path))
        return gm_gearset_file_open(path, oil_temperature, file, error);
    memset(file, 0, sizeof *file);
    file->path = path;
    gm_status status = gm_rig_source_open(path, oil_temperature, &file->rig, error);
    if (status != GM_OK)
        return status;
    file->plant = file->rig->plant;
    file->oil_temperature = file->plant->info.oil_temperature;
    return GM_OK;
}

void gm_gearset_file_close(gm_gearset_file *file)
{
    if (file->rig)
        gm_rig_source_close(file->rig);
    else
        gm_builtin_destroy(file->plant);
    gm_gearset_destroy(file->gearset);
    gm_description_destroy(file->description);
    memset(file, 0, sizeof *file);
}
