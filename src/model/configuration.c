/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Kinematics of a configuration. The rows of all meshes and of the locked synchronisers
 * tie the speeds of the bodies; the output and every path in neutral stay independent.
 * The same matrix, transposed, balances torques: power does not depend on who writes it.
 *
 *   K w = [0; u]     K = [rows; unit rows of the independent bodies]
 *   A x + t = 0      A = K^T with the sign of the rows turned, x = [F; flange torques]
 */
#include "model/gearset.h"

#include "base/alloc.h"
#include "base/linear.h"

#include <math.h>
#include <string.h>

int gm_flange_body(const gm_gearset *gearset, int flange)
{
    const gm_description *d = gearset->description;
    return flange == 0 ? d->output : d->paths[flange - 1].shaft;
}

static const gm_path_gear *find_gear(const gm_path_part *path, int number)
{
    for (int i = 0; i < path->n_gears; i++)
        if (path->gears[i].number == number)
            return &path->gears[i];
    return NULL;
}

static gm_status collect(const gm_gearset *gearset, const int *gear,
                         gm_configuration_rows *rows, gm_error *error)
{
    const gm_description *d = gearset->description;
    rows->flange[rows->n_independent++] = 0;
    for (int p = 0; p < d->n_paths; p++) {
        if (gear[p] == 0) {
            rows->flange[rows->n_independent++] = 1 + p;
            continue;
        }
        const gm_path_gear *g = find_gear(&d->paths[p], gear[p]);
        if (!g)
            return gm_fail(error, GM_ERR_ARGUMENT, "%s: path '%s' has no gear %d",
                           d->file, d->paths[p].id.name, gear[p]);
        rows->lock[rows->n_locks++] =
            (gm_row){.n = 2,
                     .body = {gearset->wheel_body[g->wheel], d->wheels[g->wheel].shaft},
                     .g = {1.0, -1.0}};
    }
    rows->n_bodies = gearset->n_bodies;
    rows->n_rows = gearset->n_meshes + rows->n_locks;
    return GM_OK;
}

static const gm_row *row_at(const gm_gearset *gearset, const gm_configuration_rows *rows,
                            int e)
{
    return e < gearset->n_meshes ? &gearset->meshes[e].row
                                 : &rows->lock[e - gearset->n_meshes];
}

static void fill_balance(const gm_gearset *gearset, gm_configuration_rows *rows)
{
    int n = rows->n_bodies;
    for (int e = 0; e < rows->n_rows; e++) {
        const gm_row *row = row_at(gearset, rows, e);
        for (int k = 0; k < row->n; k++)
            rows->balance[row->body[k] * n + e] -= row->g[k];
    }
    for (int i = 0; i < rows->n_independent; i++)
        rows->balance[gm_flange_body(gearset, rows->flange[i]) * n + rows->n_rows + i] =
            1.0;
}

static gm_status invert(const gm_gearset *gearset, gm_configuration_rows *rows,
                        const int *gear, gm_error *error)
{
    int n = rows->n_bodies;
    double *lu = gm_calloc((size_t)n * (size_t)n, sizeof *lu);
    double *column = gm_calloc((size_t)n, sizeof *column);
    int *pivot = gm_calloc((size_t)n, sizeof *pivot);
    gm_status status = GM_OK;
    if (!lu || !column || !pivot) {
        status = gm_fail(error, GM_ERR_MEMORY, "out of memory");
        goto done;
    }
    memcpy(lu, rows->balance, (size_t)n * (size_t)n * sizeof *lu);
    if (rows->n_rows + rows->n_independent != n || !gm_lu_factor(n, lu, pivot)) {
        status = gm_fail(error, GM_ERR_MODEL,
                         "%s: gears (%d, %d) block each other or leave a part that no "
                         "flange drives: %d bodies, %d couplings, %d free flanges",
                         gearset->description->file, gear[0],
                         gearset->description->n_paths > 1 ? gear[1] : 0, n, rows->n_rows,
                         rows->n_independent);
        goto done;
    }
    for (int j = 0; j < n; j++) {
        memset(column, 0, (size_t)n * sizeof *column);
        column[j] = 1.0;
        gm_lu_solve(n, lu, pivot, column);
        for (int i = 0; i < n; i++)
            rows->inverse[i * n + j] = column[i];
    }
done:
    gm_free(lu);
    gm_free(column);
    gm_free(pivot);
    return status;
}

/* Speeds per unit of independent speed: rows of the inverse that belong to the flanges,
 * since K^-1 is the transpose of A^-1 up to the sign of the row forces. Rounding dust
 * would look like a sliding contact, so it is removed. */
static void fill_speeds(gm_configuration_rows *rows)
{
    int n = rows->n_bodies;
    for (int b = 0; b < n; b++)
        for (int i = 0; i < rows->n_independent; i++) {
            double s = rows->inverse[(rows->n_rows + i) * n + b];
            rows->speed_of[b * rows->n_independent + i] = fabs(s) > 1e-11 ? s : 0.0;
        }
}

gm_status gm_configuration_rows_make(const gm_gearset *gearset, const int *gear,
                                     gm_configuration_rows *rows, gm_error *error)
{
    memset(rows, 0, sizeof *rows);
    gm_status status = collect(gearset, gear, rows, error);
    if (status != GM_OK)
        return status;
    size_t n = (size_t)rows->n_bodies;
    rows->speed_of = gm_calloc(n * (size_t)rows->n_independent, sizeof *rows->speed_of);
    rows->balance = gm_calloc(n * n, sizeof *rows->balance);
    rows->inverse = gm_calloc(n * n, sizeof *rows->inverse);
    if (!rows->speed_of || !rows->balance || !rows->inverse)
        status = gm_fail(error, GM_ERR_MEMORY, "out of memory");
    if (status == GM_OK) {
        fill_balance(gearset, rows);
        status = invert(gearset, rows, gear, error);
    }
    if (status == GM_OK)
        fill_speeds(rows);
    else
        gm_configuration_rows_clear(rows);
    return status;
}

void gm_configuration_rows_clear(gm_configuration_rows *rows)
{
    gm_free(rows->speed_of);
    gm_free(rows->balance);
    gm_free(rows->inverse);
    memset(rows, 0, sizeof *rows);
}

int gm_flange_column(const gm_configuration_rows *rows, int flange)
{
    for (int i = 0; i < rows->n_independent; i++)
        if (rows->flange[i] == flange)
            return i;
    return -1;
}

/* Inertia that turns with one independent speed: sum of J (dw/du)^2. */
static double carried_inertia(const gm_gearset *gearset,
                              const gm_configuration_rows *rows, int column)
{
    double J = 0.0;
    for (int b = 0; b < rows->n_bodies; b++) {
        double s = rows->speed_of[b * rows->n_independent + column];
        J += gearset->bodies[b].inertia * s * s;
    }
    return J;
}

static gm_status neutral_inertias(const gm_gearset *gearset, gm_kinematics *kinematics,
                                  gm_error *error)
{
    const int neutral[GM_MAX_INPUT_PATHS] = {0};
    gm_configuration_rows rows;
    gm_status status = gm_configuration_rows_make(gearset, neutral, &rows, error);
    if (status != GM_OK)
        return status;
    kinematics->inertia_output = carried_inertia(gearset, &rows, 0);
    for (int p = 0; p < gearset->description->n_paths; p++)
        kinematics->inertia[p] =
            carried_inertia(gearset, &rows, gm_flange_column(&rows, 1 + p));
    gm_configuration_rows_clear(&rows);
    return GM_OK;
}

gm_status gm_gearset_kinematics(const gm_gearset *gearset, const int *gear,
                                gm_kinematics *kinematics, gm_error *error)
{
    gm_kinematics k = {{0.0}, 0.0, {0.0}};
    gm_configuration_rows rows;
    gm_status status = neutral_inertias(gearset, &k, error);
    if (status == GM_OK)
        status = gm_configuration_rows_make(gearset, gear, &rows, error);
    if (status != GM_OK)
        return status;
    for (int p = 0; p < gearset->description->n_paths; p++)
        if (gear[p] != 0)
            k.ratio[p] =
                rows.speed_of[gm_flange_body(gearset, 1 + p) * rows.n_independent];
    gm_configuration_rows_clear(&rows);
    *kinematics = k;
    return GM_OK;
}

static double cone_torque_of(const gm_description *d, int wheel)
{
    for (int s = 0; s < d->n_synchronisers; s++)
        for (int k = 0; k < d->synchronisers[s].n_wheels; k++)
            if (d->synchronisers[s].wheels[k] == wheel)
                return d->synchronisers[s].cone_torque;
    return (double)INFINITY;
}

double gm_gearset_sync_torque(const gm_gearset *gearset, int p)
{
    const gm_description *d = gearset->description;
    const int neutral[GM_MAX_INPUT_PATHS] = {0};
    gm_configuration_rows rows;
    if (gm_configuration_rows_make(gearset, neutral, &rows, NULL) != GM_OK)
        return (double)NAN;
    double smallest = (double)INFINITY;
    int column = gm_flange_column(&rows, 1 + p);
    for (int i = 0; i < d->paths[p].n_gears; i++) {
        int w = d->paths[p].gears[i].wheel;
        const double *wheel = rows.speed_of + gearset->wheel_body[w] * rows.n_independent;
        const double *shaft = rows.speed_of + d->wheels[w].shaft * rows.n_independent;
        smallest =
            fmin(smallest, cone_torque_of(d, w) * fabs(wheel[column] - shaft[column]));
    }
    gm_configuration_rows_clear(&rows);
    return smallest;
}
