/* SPDX-License-Identifier: BSD-2-Clause */
#include "model/loose.h"

#include <math.h>

#define NO_FORCE 1e-9 /* of 1 N.m over a metre: rounding of statics */

static int touches(const gm_row *row, int body)
{
    for (int k = 0; k < row->n; k++)
        if (row->body[k] == body)
            return 1;
    return 0;
}

static int carries(const gm_gearset *gearset, const gm_configuration_rows *rows, int p,
                   int body)
{
    int input = gm_flange_body(gearset, 1 + p);
    for (int e = 0; e < rows->n_rows; e++) {
        const gm_row *row = e < gearset->n_meshes ? &gearset->meshes[e].row
                                                  : &rows->lock[e - gearset->n_meshes];
        double force = rows->inverse[e * rows->n_bodies + input];
        if (touches(row, body) && fabs(force) > NO_FORCE)
            return 1;
    }
    return 0;
}

gm_status gm_loose_inertia(const gm_gearset *gearset,
                           const gm_configuration_rows *engaged, int p, double *path,
                           double *loose, gm_error *error)
{
    int gear[GM_MAX_INPUT_PATHS];
    gm_configuration_rows neutral;
    gm_rest_gears(gearset->description, gear);
    gm_status status = gm_configuration_rows_make(gearset, gear, &neutral, error);
    if (status != GM_OK)
        return status;
    int column = gm_flange_column(&neutral, 1 + p);
    *path = *loose = 0.0;
    for (int b = 0; b < gearset->n_bodies && column >= 0; b++) {
        double speed = neutral.speed_of[b * neutral.n_independent + column];
        double inertia = gearset->bodies[b].inertia * speed * speed;
        *path += inertia;
        if (!carries(gearset, engaged, p, b))
            *loose += inertia;
    }
    gm_configuration_rows_clear(&neutral);
    return GM_OK;
}
