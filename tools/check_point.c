/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Where one operating point loses its power: the steady balance is solved, then read
 * element by element.
 */
#include "check.h"

#include "base/alloc.h"
#include "solve/gm_steady_solver.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LOADED 0.01 /* of the largest force; drag of what idles is far below */

static int has_gear(const gm_path_part *path, int number)
{
    for (int g = 0; g < path->n_gears; g++)
        if (path->gears[g].number == number)
            return 1;
    return 0;
}

/* Path of a gear, -1 when there is none. */
static int path_of(const gm_description *d, int number)
{
    for (int p = 0; p < d->n_paths; p++)
        if (has_gear(&d->paths[p], number))
            return p;
    return -1;
}

/* A gear can wait only on the path that does not drive. */
static gm_status check_preselected(const gm_description *d, int p,
                                   const gm_point_request *r, gm_error *error)
{
    if (r->preselected == 0 ||
        (d->n_paths > 1 && has_gear(&d->paths[1 - p], r->preselected)))
        return GM_OK;
    if (path_of(d, r->preselected) < 0)
        return gm_fail(error, GM_ERR_MODEL, "%s: there is no gear %d to preselect",
                       d->file, r->preselected);
    return gm_fail(error, GM_ERR_MODEL,
                   "%s: gear %d cannot be preselected while gear %d drives: both are on "
                   "path %s",
                   d->file, r->preselected, r->gear, d->paths[p].id.name);
}

/* Gears, speeds and torques of the point; *path receives the loaded path. */
static gm_status set_up(const gm_gearset_file *file, const gm_point_request *r,
                        gm_steady_point *point, int *path, gm_error *error)
{
    const gm_description *d = file->description;
    int p = path_of(d, r->gear), other = 1 - p;
    if (p < 0)
        return gm_fail(error, GM_ERR_MODEL, "%s: there is no gear %d", d->file, r->gear);
    gm_status status = check_preselected(d, p, r, error);
    if (status != GM_OK)
        return status;
    memset(point, 0, sizeof *point);
    point->gear[p] = r->gear;
    if (d->n_paths > 1)
        point->gear[other] =
            r->preselected != 0 ? r->preselected : gm_path_rest_gear(&d->paths[other]);
    gm_kinematics k;
    status = gm_gearset_kinematics(file->gearset, point->gear, &k, error);
    if (status != GM_OK)
        return status;
    point->speed[0] = r->speed / k.ratio[p];
    for (int i = 0; i < GM_MAX_FLANGES; i++)
        point->direction[i] = point->speed[0] < 0.0 ? -1.0 : 1.0;
    point->torque[1 + p] = r->torque;
    *path = p;
    return GM_OK;
}

static int larger_first(const void *a, const void *b)
{
    const gm_element_loss *x = a, *y = b;
    if (x->power != y->power)
        return x->power < y->power ? 1 : -1;
    return strcmp(x->name, y->name);
}

/* Losses are read from a balance at the same point and the solver's unknowns. */
static gm_status read_losses(const gm_gearset_file *file, const gm_steady_point *point,
                             const double *x, gm_checked_point *checked, gm_error *error)
{
    gm_balance *balance = NULL;
    int n = gm_gearset_element_count(file->gearset);
    gm_element_loss *losses = gm_calloc((size_t)n, sizeof *losses);
    if (!losses)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    gm_status status = gm_balance_create(file->gearset, &balance, error);
    if (status == GM_OK)
        status = gm_balance_set_point(balance, point, error);
    if (status == GM_OK) {
        gm_balance_losses(balance, x, losses);
        qsort(losses, (size_t)n, sizeof *losses, larger_first);
        checked->n_elements = n;
        checked->elements = losses;
        for (int i = 0; i < n; i++)
            checked->loss += losses[i].power;
    } else {
        gm_free(losses);
    }
    gm_balance_destroy(balance);
    return status;
}

/* Gear of path p, in neutral, whose parts turn with it at speed w of its input; 0: none.
 * Friction holds the path exactly there; 1e-9 is rounding. */
static gm_status find_gear_in_step(const gm_gearset_file *file, int p, double w,
                                   double output_speed, int *number, gm_error *error)
{
    const gm_path_part *path = &file->description->paths[p];
    gm_status status = GM_OK;
    *number = 0;
    for (int g = 0; g < path->n_gears && status == GM_OK; g++) {
        int gears[GM_MAX_INPUT_PATHS] = {0};
        gm_kinematics k;
        for (int i = 0; i < file->description->n_paths; i++)
            gears[i] = gm_path_rest_gear(&file->description->paths[i]);
        gears[p] = path->gears[g].number;
        status = gm_gearset_kinematics(file->gearset, gears, &k, error);
        if (status == GM_OK && fabs(k.ratio[p] * output_speed - w) <= 1e-9 * fabs(w))
            *number = gears[p];
    }
    return status;
}

static gm_status solve(const gm_gearset_file *file, int p, gm_steady_point *point,
                       gm_checked_point *checked, gm_error *error)
{
    const gm_description *d = file->description;
    const int other = d->n_paths > 1 ? 1 - p : p;
    gm_steady_solver *solver = NULL;
    gm_steady_result result;
    gm_status status = gm_steady_solver_create(file->plant, &solver, error);
    if (status != GM_OK)
        return status;
    if (other != p && point->gear[other] == 0) {
        gm_free_path free_path = {0};
        status = gm_steady_solve_free(solver, other, point, &free_path, &result, error);
        checked->other_sticks = free_path.sticks;
    } else {
        status = gm_steady_solve(solver, point, &result, error);
    }
    if (status == GM_OK) {
        const double *x = NULL;
        (void)gm_steady_solver_work(solver, &x);
        checked->path = d->paths[p].id.name;
        checked->other = other != p ? d->paths[other].id.name : NULL;
        checked->other_speed = result.speed[1 + other];
        checked->output_speed = result.speed[0];
        checked->output_torque = result.torque[0];
        status = read_losses(file, point, x, checked, error);
    }
    if (status == GM_OK && checked->other_sticks)
        status = find_gear_in_step(file, other, checked->other_speed,
                                   checked->output_speed, &checked->other_gear, error);
    if (status != GM_OK) {
        gm_free(checked->elements);
        checked->elements = NULL;
    }
    gm_steady_solver_destroy(solver);
    return status;
}

gm_status gm_check_point(const gm_gearset_file *file, const gm_point_request *request,
                         gm_checked_point *point, gm_error *error)
{
    gm_checked_point checked = {.request = *request,
                                .oil_temperature = file->oil_temperature};
    gm_steady_point steady;
    int path = 0;
    gm_status status = set_up(file, request, &steady, &path, error);
    if (status == GM_OK)
        status = solve(file, path, &steady, &checked, error);
    if (status == GM_OK)
        *point = checked;
    return status;
}

void gm_checked_point_clear(gm_checked_point *point)
{
    gm_free(point->elements);
    memset(point, 0, sizeof *point);
}

const gm_element_loss *gm_checked_point_element(const gm_checked_point *point,
                                                gm_loss_kind kind, const char *name)
{
    for (int i = 0; i < point->n_elements; i++)
        if (point->elements[i].kind == kind && !strcmp(point->elements[i].name, name))
            return &point->elements[i];
    return NULL;
}

int gm_checked_point_loads(const gm_checked_point *point, const char *mesh)
{
    const gm_element_loss *e = gm_checked_point_element(point, GM_LOSS_MESH, mesh);
    double largest = 0.0;
    for (int i = 0; i < point->n_elements; i++)
        if (point->elements[i].kind == GM_LOSS_MESH)
            largest = fmax(largest, point->elements[i].radial);
    return e && e->radial > LOADED * largest;
}

double gm_checked_point_power(const gm_checked_point *point, gm_loss_kind kind)
{
    double sum = 0.0;
    for (int i = 0; i < point->n_elements; i++)
        sum += point->elements[i].kind == kind ? point->elements[i].power : 0.0;
    return sum;
}

double gm_checked_point_efficiency(const gm_checked_point *point)
{
    double in = point->request.torque * point->request.speed;
    double out = point->output_torque * point->output_speed;
    double eta = in > 0.0 ? -out / in : -in / out;
    return eta > 0.0 && eta < 1.0 ? eta : (double)NAN;
}
