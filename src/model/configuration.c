/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Kinematics of a configuration. The rows of all meshes and of what the gears lock tie
 * the speeds of the bodies; the output and every path in neutral stay independent.
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

gm_row gm_lock_row(const gm_gearset *gearset, const gm_lock *lock)
{
    const gm_description *d = gearset->description;
    if (!lock->is_clutch)
        return (gm_row){
            .n = 2,
            .body = {gearset->wheel_body[lock->index], d->wheels[lock->index].shaft},
            .g = {1.0, -1.0}};
    const gm_clutch *clutch = &d->clutches[lock->index];
    return (gm_row){.n = clutch->on == GM_HOUSING ? 1 : 2,
                    .body = {clutch->shaft, clutch->on},
                    .g = {1.0, -1.0}};
}

/* What two paths both lock is locked once. */
static void add_locks(const gm_gearset *gearset, const gm_path_gear *gear,
                      gm_configuration_rows *rows)
{
    for (int i = 0; i < gear->n_locks; i++) {
        gm_row row = gm_lock_row(gearset, &gear->locks[i]);
        int known = 0;
        for (int k = 0; k < rows->n_locks; k++)
            known |= rows->lock[k].n == row.n && rows->lock[k].body[0] == row.body[0] &&
                     rows->lock[k].body[1] == row.body[1];
        if (known)
            continue;
        rows->locked[rows->n_locks] = &gear->locks[i];
        rows->lock[rows->n_locks++] = row;
    }
}

/* The locks and the independent speeds. */
static gm_status collect(const gm_gearset *gearset, const int *gear,
                         gm_configuration_rows *rows, gm_error *error)
{
    const gm_description *d = gearset->description;
    int n_elements = d->n_wheels + d->n_clutches;
    rows->lock = gm_calloc((size_t)n_elements, sizeof *rows->lock);
    rows->locked = gm_calloc((size_t)n_elements, sizeof *rows->locked);
    if (!rows->lock || !rows->locked)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    rows->flange[rows->n_independent++] = 0;
    for (int p = 0; p < d->n_paths; p++) {
        const gm_path_part *path = &d->paths[p];
        const gm_path_gear *g = gm_path_gear_of(path, gear[p]);
        if (!g)
            return gm_fail(error, GM_ERR_ARGUMENT, "%s: path '%s' has no gear %d",
                           d->file, path->id.name, gear[p]);
        if (g == &path->neutral)
            rows->flange[rows->n_independent++] = 1 + p;
        add_locks(gearset, g, rows);
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
    if (status != GM_OK) {
        gm_configuration_rows_clear(rows);
        return status;
    }
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
    gm_free(rows->lock);
    gm_free(rows->locked);
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

double gm_coupled_inertia(const gm_gearset *gearset, const gm_configuration_rows *rows,
                          int i, int k)
{
    double J = 0.0;
    for (int b = 0; b < rows->n_bodies; b++) {
        const double *s = rows->speed_of + b * rows->n_independent;
        J += gearset->bodies[b].inertia * s[i] * s[k];
    }
    return J;
}

/* A path without neutral always turns with the output; of its inertia only the body of
 * its flange counts as the path's. */
static void neutral_inertias(const gm_gearset *gearset, const gm_configuration_rows *rows,
                             gm_kinematics *k)
{
    k->inertia_output = gm_coupled_inertia(gearset, rows, 0, 0);
    for (int p = 0; p < gearset->description->n_paths; p++) {
        int column = gm_flange_column(rows, 1 + p), body = gm_flange_body(gearset, 1 + p);
        double r = rows->speed_of[body * rows->n_independent];
        if (column >= 0) {
            k->inertia[p] = gm_coupled_inertia(gearset, rows, column, column);
            continue;
        }
        k->inertia[p] = gearset->bodies[body].inertia;
        k->inertia_output -= r * r * k->inertia[p];
    }
}

void gm_rest_gears(const gm_description *description, int gear[GM_MAX_INPUT_PATHS])
{
    for (int p = 0; p < GM_MAX_INPUT_PATHS; p++)
        gear[p] =
            p < description->n_paths ? gm_path_rest_gear(&description->paths[p]) : 0;
}

gm_status gm_gearset_kinematics(const gm_gearset *gearset, const int *gear,
                                gm_kinematics *kinematics, gm_error *error)
{
    const gm_description *d = gearset->description;
    gm_kinematics k = {{0.0}, 0.0, {0.0}, 0.0};
    gm_configuration_rows rows;
    int rest[GM_MAX_INPUT_PATHS];
    gm_rest_gears(d, rest);
    gm_status status = gm_configuration_rows_make(gearset, rest, &rows, error);
    if (status != GM_OK)
        return status;
    neutral_inertias(gearset, &rows, &k);
    gm_configuration_rows_clear(&rows);
    status = gm_configuration_rows_make(gearset, gear, &rows, error);
    if (status != GM_OK)
        return status;
    for (int p = 0; p < d->n_paths; p++)
        if (gear[p] != 0)
            k.ratio[p] =
                rows.speed_of[gm_flange_body(gearset, 1 + p) * rows.n_independent];
    k.inertia_total = gm_coupled_inertia(gearset, &rows, 0, 0);
    gm_configuration_rows_clear(&rows);
    *kinematics = k;
    return GM_OK;
}

/* Smallest capacity of a gear's locks at the input flange. A lock whose parts do not turn
 * with the input in neutral has nothing to synchronise. */
static double gear_capacity(const gm_gearset *gearset, const gm_configuration_rows *rows,
                            const gm_path_gear *gear, int column)
{
    double smallest = (double)INFINITY;
    for (int i = 0; i < gear->n_locks; i++) {
        const gm_row row = gm_lock_row(gearset, &gear->locks[i]);
        double slip = 0.0;
        for (int k = 0; k < row.n; k++)
            slip += row.g[k] * rows->speed_of[row.body[k] * rows->n_independent + column];
        if (fabs(slip) > 1e-9)
            smallest =
                fmin(smallest, gm_lock_capacity(gearset->description, &gear->locks[i]) *
                                   fabs(slip));
    }
    return smallest;
}

double gm_gearset_sync_torque(const gm_gearset *gearset, int p)
{
    const gm_path_part *path = &gearset->description->paths[p];
    int rest[GM_MAX_INPUT_PATHS];
    gm_configuration_rows rows;
    gm_rest_gears(gearset->description, rest);
    if (gm_configuration_rows_make(gearset, rest, &rows, NULL) != GM_OK)
        return (double)NAN;
    double smallest = (double)INFINITY;
    for (int i = 0; i < path->n_gears && path->has_neutral; i++)
        smallest = fmin(smallest, gear_capacity(gearset, &rows, &path->gears[i],
                                                gm_flange_column(&rows, 1 + p)));
    gm_configuration_rows_clear(&rows);
    return smallest;
}
