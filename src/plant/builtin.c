/* SPDX-License-Identifier: BSD-2-Clause */
#include "plant/gm_builtin.h"

#include "base/alloc.h"

#include <math.h>

/* ---- the gearset's calls with the plant's signatures ---- */

static gm_status kinematics(const void *self, const int *gear, gm_kinematics *k,
                            gm_error *error)
{
    return gm_gearset_kinematics(self, gear, k, error);
}

static gm_status compliance(const void *self, int p, int number, gm_compliance *c,
                            gm_error *error)
{
    return gm_gearset_compliance(self, p, number, c, error);
}

static int kink_speeds(const void *self, int p, int number, int n_max, double *speed)
{
    return gm_gearset_kink_speeds(self, p, number, n_max, speed);
}

static int kink_torques(const void *self, int p, int number, int n_max, double *torque)
{
    return gm_gearset_kink_torques(self, p, number, n_max, torque);
}

static int drag_lines(const void *self, int p, int n_max, double *ratio)
{
    return gm_gearset_drag_lines(self, p, n_max, ratio);
}

static gm_status work_create(const void *self, void **work, gm_error *error)
{
    gm_balance *balance;
    gm_status status = gm_balance_create(self, &balance, error);
    if (status == GM_OK)
        *work = balance;
    return status;
}

static void work_destroy(void *work)
{
    gm_balance_destroy(work);
}

static gm_status set_point(void *work, const gm_steady_point *point, gm_error *error)
{
    return gm_balance_set_point(work, point, error);
}

static int size(const void *work)
{
    return gm_balance_size(work);
}

static int entries(const void *work)
{
    return gm_balance_entries(work);
}

static double pass(void *work, double *x)
{
    return gm_balance_pass(work, x);
}

static void residual(void *work, const double *x, double *f)
{
    gm_balance_residual(work, x, f);
}

static void pattern(const void *work, int *column_start, int *row)
{
    gm_balance_pattern(work, column_start, row);
}

static void jacobian(void *work, const double *x, double *value)
{
    gm_balance_jacobian(work, x, value);
}

static void result(const void *work, const double *x, gm_steady_result *r)
{
    gm_balance_result(work, x, r);
}

static const gm_plant_class builtin_class = {
    .kinematics = kinematics,
    .compliance = compliance,
    .kink_speeds = kink_speeds,
    .kink_torques = kink_torques,
    .drag_lines = drag_lines,
    .work_create = work_create,
    .work_destroy = work_destroy,
    .set_point = set_point,
    .size = size,
    .entries = entries,
    .pass = pass,
    .residual = residual,
    .pattern = pattern,
    .jacobian = jacobian,
    .result = result,
};

/* ---- what is known of it ---- */

static gm_status fill_path(const gm_gearset *gearset, int p, gm_plant_path *path,
                           gm_error *error)
{
    const gm_path_part *part = &gm_gearset_description(gearset)->paths[p];
    gm_plant_gear *gears = gm_calloc((size_t)part->n_gears, sizeof *gears);
    if (!gears)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    for (int i = 0; i < part->n_gears; i++)
        gears[i] = (gm_plant_gear){part->gears[i].number, part->gears[i].ratio};
    *path = (gm_plant_path){.name = part->id.name,
                            .n_gears = part->n_gears,
                            .always_engaged = !part->has_neutral,
                            .gears = gears,
                            .sync_torque = gm_gearset_sync_torque(gearset, p)};
    return isnan(path->sync_torque) ? gm_fail(error, GM_ERR_MEMORY, "out of memory")
                                    : GM_OK;
}

static int joins_inputs(const gm_description *d, int a, int b)
{
    return d->n_paths == 2 && ((a == d->paths[0].shaft && b == d->paths[1].shaft) ||
                               (a == d->paths[1].shaft && b == d->paths[0].shaft));
}

/* Two input shafts drag on each other when any part sits between them. */
static int inputs_coupled(const gm_description *d)
{
    int coupled = 0;
    for (int i = 0; i < d->n_gaps; i++)
        coupled |= joins_inputs(d, d->gaps[i].inner, d->gaps[i].outer);
    for (int i = 0; i < d->n_bearings; i++)
        coupled |= joins_inputs(d, d->bearings[i].shaft, d->bearings[i].on);
    for (int i = 0; i < d->n_seals; i++)
        coupled |= joins_inputs(d, d->seals[i].shaft, d->seals[i].on);
    return coupled;
}

gm_status gm_builtin_create(const gm_gearset *gearset, gm_plant **plant, gm_error *error)
{
    const gm_description *d = gm_gearset_description(gearset);
    gm_plant *p = gm_calloc(1, sizeof *p);
    if (!p)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    p->is = &builtin_class;
    p->self = gearset;
    p->info = (gm_plant_info){.name = d->name,
                              .title = d->title,
                              .source_sha256 = d->sha256,
                              .n_paths = d->n_paths,
                              .speed_max = d->speed_max,
                              .torque_max = d->torque_max,
                              .oil_temperature = gm_gearset_oil_temperature(gearset),
                              .coupled = inputs_coupled(d)};
    gm_status status = GM_OK;
    for (int i = 0; i < d->n_paths && status == GM_OK; i++)
        status = fill_path(gearset, i, &p->info.path[i], error);
    if (status != GM_OK) {
        gm_builtin_destroy(p);
        return status;
    }
    *plant = p;
    return GM_OK;
}

void gm_builtin_destroy(gm_plant *plant)
{
    if (!plant)
        return;
    for (int i = 0; i < plant->info.n_paths; i++)
        gm_free((void *)plant->info.path[i].gears);
    gm_free(plant);
}
