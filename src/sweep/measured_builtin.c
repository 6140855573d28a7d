/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/gm_experiment_choice.h"

#include "base/alloc.h"
#include "plant/gm_moving_model.h"
#include "solve/gm_continuous_rig.h"
#include "sweep/mixed_plant.h"

#include <math.h>

/* Commands change no finer than this [s]. */
static const double step = 1e-3;
/* Relative error of a step: losses are about a hundredth of the torques and wanted to a
   thousandth. */
static const double tolerance = 1e-7;
/* rad/s: twenty times the band over which the motion rounds Coulomb friction. */
static const double creep = 0.2;
static const double time_limit = 600.0;

struct gm_measured_builtin {
    gm_dynamics dynamics;
    gm_continuous model;
    gm_continuous_rig continuous;
    gm_plant *measured, *mixed; /* mixed: NULL where all is measured */
    gm_rig_report report;
};

const char *gm_losses_name(gm_losses_by losses)
{
    static const char *const names[] = {"auto", "steady", "ramp", "settle"};
    return names[losses];
}

const char *gm_inertia_name(gm_inertia_by inertia)
{
    static const char *const names[] = {"auto", "mass-matrix", "ramps"};
    return names[inertia];
}

static gm_status check(const gm_experiment_choice *c, gm_error *error)
{
    int simulated = c->losses != GM_LOSSES_STEADY || c->inertia != GM_INERTIA_MATRIX;
    if (c->dwell > 0.0 && !simulated)
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "a dwell has no effect where points are solved: choose losses "
                       "ramp or settle");
    if (c->ramp_time > 0.0 && c->losses != GM_LOSSES_RAMP &&
        c->inertia != GM_INERTIA_RAMPS)
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "a ramp time has no effect where nothing is ramped: choose losses "
                       "ramp or inertia ramps");
    return GM_OK;
}

static gm_status measure(gm_measured_builtin *m, const gm_gearset *gearset,
                         const gm_plant *solved, const gm_experiment_choice *c,
                         gm_error *error)
{
    gm_rig_settings settings = {.dwell = c->dwell,
                                .ramp_time = c->ramp_time,
                                .creep = creep,
                                .time_limit = time_limit,
                                .losses_by_ramps = c->losses == GM_LOSSES_RAMP,
                                .known = c->inertia == GM_INERTIA_MATRIX ? solved : NULL};
    int rest[GM_MAX_INPUT_PATHS] = {0};
    gm_kinematics kinematics;
    for (int p = 0; p < solved->info.n_paths; p++)
        if (solved->info.path[p].always_engaged)
            rest[p] = solved->info.path[p].gears[0].number;
    gm_status status = solved->is->kinematics(solved->self, rest, &kinematics, error);
    if (status != GM_OK)
        return status;
    for (int p = 0; p < GM_MAX_INPUT_PATHS; p++)
        settings.inertia[p] = rest[p] != 0 ? kinematics.inertia[p] : (double)NAN;
    m->dynamics = gm_builtin_dynamics(gearset);
    m->model = gm_moving_model(&m->dynamics, step);
    gm_continuous_rig_init(&m->continuous, &m->model, tolerance);
    return gm_rig_plant_create(&m->continuous.rig, &solved->info, &settings, &m->measured,
                               &m->report, error);
}

static gm_status mix(gm_measured_builtin *m, const gm_plant *solved,
                     const gm_experiment_choice *c, gm_error *error)
{
    if (c->losses == GM_LOSSES_STEADY)
        return gm_mixed_plant_create(solved, m->measured, &m->mixed, error);
    if (c->inertia == GM_INERTIA_MATRIX)
        return gm_mixed_plant_create(m->measured, solved, &m->mixed, error);
    return GM_OK;
}

gm_status gm_measured_builtin_create(const gm_gearset *gearset, const gm_plant *solved,
                                     gm_experiment_choice *choice,
                                     gm_measured_builtin **measured, gm_error *error)
{
    gm_experiment_choice c = *choice;
    if (c.losses == GM_LOSSES_AUTO)
        c.losses = GM_LOSSES_STEADY;
    if (c.inertia == GM_INERTIA_AUTO)
        c.inertia = GM_INERTIA_MATRIX;
    gm_status status = check(&c, error);
    if (status != GM_OK)
        return status;
    gm_measured_builtin *m = NULL;
    if (c.losses != GM_LOSSES_STEADY || c.inertia != GM_INERTIA_MATRIX) {
        m = gm_calloc(1, sizeof *m);
        status = m ? measure(m, gearset, solved, &c, error)
                   : gm_fail(error, GM_ERR_MEMORY, "out of memory");
        if (status == GM_OK)
            status = mix(m, solved, &c, error);
    }
    if (status != GM_OK) {
        gm_measured_builtin_destroy(m);
        return status;
    }
    *choice = c;
    *measured = m;
    return GM_OK;
}

void gm_measured_builtin_destroy(gm_measured_builtin *m)
{
    if (!m)
        return;
    gm_free(m->mixed);
    gm_rig_plant_destroy(m->measured);
    gm_free(m);
}

const gm_plant *gm_measured_builtin_plant(const gm_measured_builtin *m)
{
    return m->mixed ? m->mixed : m->measured;
}

gm_rig_report gm_measured_builtin_report(const gm_measured_builtin *m)
{
    return m->report;
}
