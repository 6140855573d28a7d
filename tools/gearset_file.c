/* SPDX-License-Identifier: BSD-2-Clause */
#include "gearset_file.h"

#include <math.h>
#include <string.h>

gm_status gm_gearset_file_open(const char *path, double oil_temperature,
                               gm_gearset_file *file, gm_error *error)
{
    memset(file, 0, sizeof *file);
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

void gm_gearset_file_close(gm_gearset_file *file)
{
    gm_builtin_destroy(file->plant);
    gm_gearset_destroy(file->gearset);
    gm_description_destroy(file->description);
    memset(file, 0, sizeof *file);
}
