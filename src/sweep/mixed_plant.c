/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/mixed_plant.h"

#include "base/alloc.h"

typedef struct mixed {
    gm_plant plant; /* first: points back here */
    gm_plant_class is;
    const gm_plant *losses, *inertias;
} mixed;

static gm_status kinematics(const void *self, const int *gear, gm_kinematics *k,
                            gm_error *error)
{
    const gm_plant *from = ((const mixed *)self)->inertias;
    return from->is->kinematics(from->self, gear, k, error);
}

static gm_status compliance(const void *self, int p, int number, gm_compliance *c,
                            gm_error *error)
{
    const gm_plant *from = ((const mixed *)self)->inertias;
    return from->is->compliance(from->self, p, number, c, error);
}

static int kink_speeds(const void *self, int p, int number, int n_max, double *speed)
{
    const gm_plant *from = ((const mixed *)self)->losses;
    return from->is->kink_speeds(from->self, p, number, n_max, speed);
}

static int kink_torques(const void *self, int p, int number, int n_max, double *torque)
{
    const gm_plant *from = ((const mixed *)self)->losses;
    return from->is->kink_torques(from->self, p, number, n_max, torque);
}

static int drag_lines(const void *self, int p, int n_max, double *ratio)
{
    const gm_plant *from = ((const mixed *)self)->losses;
    return from->is->drag_lines(from->self, p, n_max, ratio);
}

static gm_status work_create(const void *self, void **work, gm_error *error)
{
    const gm_plant *from = ((const mixed *)self)->losses;
    return from->is->work_create(from->self, work, error);
}

gm_status gm_mixed_plant_create(const gm_plant *losses, const gm_plant *inertias,
                                gm_plant **plant, gm_error *error)
{
    mixed *m = gm_calloc(1, sizeof *m);
    if (!m)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    m->losses = losses;
    m->inertias = inertias;
    m->is = *losses->is; /* what a workspace can do */
    m->is.kinematics = kinematics;
    m->is.compliance = inertias->is->compliance ? compliance : NULL;
    m->is.kink_speeds = kink_speeds;
    m->is.kink_torques = kink_torques;
    m->is.drag_lines = drag_lines;
    m->is.work_create = work_create;
    m->plant = (gm_plant){.is = &m->is, .self = m, .info = losses->info};
    *plant = &m->plant;
    return GM_OK;
}
