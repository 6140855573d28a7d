/* SPDX-License-Identifier: BSD-2-Clause */
#include "cycle_stage.h"

#include "base/sha256.h"
#include "plant/gm_fmu_steps.h"
#include "progress.h"

#include <math.h>
#include <string.h>

#define SAMPLE_STEP 5e-3  /* s: 40 samples in a period of the 5 Hz that torques keep */
#define SHOWN_EVERY 0.005 /* of the cycle, of the progress bar */

/* Without meshes and springs inside there is no vibration that forbids order three, and
 * it takes half the steps. With them, and with the kinks of Co-Simulation, it takes more
 * steps than order two. */
#define ORDER_RIGID 3

const char *gm_fidelity_name(gm_fmu_fidelity fidelity)
{
    return fidelity == GM_FMU_RIGID ? "rigid" : "lash";
}

void gm_cycle_run_name(const gm_cycle_run *run, char name[GM_RUN_NAME])
{
    const char *fidelity = gm_fidelity_name(run->fidelity);
    if (isnan(run->communication_step))
        (void)snprintf(name, GM_RUN_NAME, "%s", fidelity);
    else
        (void)snprintf(name, GM_RUN_NAME, "%s (CS, %.4g ms)", fidelity,
                       1e3 * run->communication_step);
}

void gm_stage_cycle_clear(gm_cycle_stage *stage)
{
    for (int i = 0; i < stage->n_runs; i++) {
        gm_record_destroy(stage->run[i].record);
        gm_comparison_clear(&stage->run[i].comparison);
    }
    gm_record_destroy(stage->detailed);
    gm_gear_plan_destroy(stage->plan);
    gm_cycle_destroy(stage->cycle);
    memset(stage, 0, sizeof *stage);
}

/* ---- what the control must know of the gearset ---- */

static gm_status add_gear(const gm_plant *plant, int p, int number, gm_transmission *t,
                          double *forward, gm_error *error)
{
    int gear[GM_MAX_INPUT_PATHS] = {0};
    gm_kinematics kinematics;
    gear[p] = number;
    gm_status status = plant->is->kinematics(plant->self, gear, &kinematics, error);
    if (status != GM_OK || t->n_gears == GM_PLAN_MAX_GEARS)
        return status;
    double ratio = kinematics.ratio[p];
    int i = t->n_gears++;
    for (; i > 0 && t->gear[i - 1].number > number; i--)
        t->gear[i] = t->gear[i - 1];
    t->gear[i] = (gm_plan_gear){number, p, fabs(ratio)};
    if (i == 0)
        *forward = ratio > 0.0 ? 1.0 : -1.0;
    return GM_OK;
}

static gm_status list_gears(const gm_plant *plant, gm_transmission *t, double *forward,
                            gm_error *error)
{
    gm_status status = GM_OK;
    *t = (gm_transmission){.n_paths = plant->info.n_paths};
    for (int p = 0; p < plant->info.n_paths; p++)
        for (int i = 0; i < plant->info.path[p].n_gears && status == GM_OK; i++)
            if (plant->info.path[p].gears[i].number > 0)
                status = add_gear(plant, p, plant->info.path[p].gears[i].number, t,
                                  forward, error);
    return status;
}

/* ---- driving ---- */

typedef struct watch {
    gm_progress bar;
    const char *what;
    double shown;
} watch;

static int show(void *context, double done)
{
    watch *w = context;
    if (done - w->shown >= SHOWN_EVERY) {
        gm_progress_show(&w->bar, done, w->what);
        w->shown = done;
    }
    return gm_progress_interrupted();
}

static gm_status drive(const gm_trip_parts *parts, double tolerance, int order_max,
                       const char *what, gm_record **record, gm_error *error)
{
    watch w = {.what = what, .shown = -1.0};
    const gm_record_progress progress = {show, &w};
    const gm_transient_options options = {.tolerance = tolerance, .order_max = order_max};
    gm_progress_begin(&w.bar, "drive", NULL);
    gm_status status =
        gm_record_create(parts, &options, SAMPLE_STEP, &progress, record, error);
    gm_progress_end(&w.bar);
    return status;
}

static int order_of(const gm_cycle_run *run)
{
    return run->fidelity == GM_FMU_RIGID && isnan(run->communication_step) ? ORDER_RIGID
                                                                           : 0;
}

/* Drive with the gearset of the plant and compare; the run has its kind already. */
static gm_status drive_run(const gm_trip_parts *common, const gm_dynamics *gearset,
                           const char *fmu, gm_cycle_stage *stage, gm_error *error)
{
    gm_cycle_run *run = &stage->run[stage->n_runs];
    gm_trip_parts parts = *common;
    char name[GM_RUN_NAME];
    parts.gearset = gearset;
    gm_cycle_run_name(run, name);
    if (gearset->n_paths != stage->n_paths)
        return gm_fail(error, GM_ERR_MODEL, "%s: has %d input flanges, not %d", fmu,
                       gearset->n_paths, stage->n_paths);
    gm_status status =
        drive(&parts, stage->tolerance, order_of(run), name, &run->record, error);
    if (status != GM_OK)
        return status;
    stage->n_runs++;
    return gm_compare(stage->detailed, run->record, stage->plan, &run->comparison, error);
}

static gm_status drive_exchange(const gm_trip_parts *common, const char *fmu,
                                gm_fmu_fidelity fidelity, gm_cycle_stage *stage,
                                gm_error *error)
{
    gm_fmu_plant *plant = NULL;
    gm_status status = gm_fmu_plant_create(fmu, fidelity, &plant, error);
    if (status != GM_OK)
        return status;
    const gm_dynamics dynamics = gm_fmu_plant_dynamics(plant);
    stage->run[stage->n_runs] = (gm_cycle_run){.fidelity = fidelity,
                                               .communication_step = (double)NAN,
                                               .recommended_step = (double)NAN};
    status = drive_run(common, &dynamics, fmu, stage, error);
    gm_fmu_plant_destroy(plant);
    return status;
}

/* Over the gears of the cycle's plan, each with its path alone. */
static gm_status shortest_step(const gm_fmu_steps_plant *plant,
                               const gm_transmission *transmission, double *shortest,
                               gm_error *error)
{
    gm_status status = GM_OK;
    *shortest = (double)INFINITY;
    for (int i = 0; i < transmission->n_gears && status == GM_OK; i++) {
        int gear[GM_MAX_INPUT_PATHS] = {0};
        double step = 0.0;
        gear[transmission->gear[i].path] = transmission->gear[i].number;
        status = gm_fmu_steps_recommended(plant, gear, &step, error);
        *shortest = fmin(*shortest, step);
    }
    return status;
}

static gm_status drive_in_steps(const gm_trip_parts *common, const char *fmu,
                                const gm_transmission *transmission,
                                gm_fmu_fidelity fidelity, double step,
                                gm_cycle_stage *stage, gm_error *error)
{
    gm_fmu_steps_plant *plant = NULL;
    gm_cycle_run *run = &stage->run[stage->n_runs];
    gm_status status = gm_fmu_steps_create(fmu, fidelity, step, &plant, error);
    if (status != GM_OK)
        return status;
    const gm_dynamics dynamics = gm_fmu_steps_dynamics(plant);
    *run = (gm_cycle_run){.fidelity = fidelity, .communication_step = step};
    status = shortest_step(plant, transmission, &run->recommended_step, error);
    if (status == GM_OK)
        status = drive_run(common, &dynamics, fmu, stage, error);
    gm_fmu_steps_destroy(plant);
    return status;
}

static int wants(const gm_cycle_settings *settings, gm_fmu_fidelity fidelity)
{
    return strcmp(settings->fidelity, GM_CYCLE_BOTH) == 0 ||
           strcmp(settings->fidelity, gm_fidelity_name(fidelity)) == 0;
}

static gm_status drive_components(const gm_trip_parts *parts, const char *fmu,
                                  const gm_transmission *transmission,
                                  const gm_cycle_settings *settings,
                                  gm_cycle_stage *stage, gm_error *error)
{
    static const gm_fmu_fidelity fidelities[] = {GM_FMU_RIGID, GM_FMU_LASH};
    const double step = settings->communication_step;
    gm_status status = GM_OK;
    for (int i = 0; i < 2 && status == GM_OK; i++)
        if (wants(settings, fidelities[i]))
            status = drive_exchange(parts, fmu, fidelities[i], stage, error);
    for (int i = 0; i < 2 && status == GM_OK && !isnan(step); i++)
        if (wants(settings, fidelities[i]))
            status = drive_in_steps(parts, fmu, transmission, fidelities[i], step, stage,
                                    error);
    return status;
}

static gm_status drive_all(const gm_gearset_file *file, const char *fmu,
                           const gm_vehicle *vehicle, const gm_cycle_settings *settings,
                           gm_cycle_stage *stage, gm_error *error)
{
    gm_dynamics detailed = gm_builtin_dynamics(file->gearset);
    gm_transmission transmission;
    gm_trip_parts parts = {
        .vehicle = vehicle, .cycle = stage->cycle, .gearset = &detailed, .forward = 1.0};
    gm_status status = list_gears(file->plant, &transmission, &parts.forward, error);
    if (status == GM_OK)
        status = gm_gear_plan_create(stage->cycle, vehicle, &transmission, &stage->plan,
                                     error);
    parts.plan = stage->plan;
    if (status == GM_OK)
        status = drive(&parts, stage->tolerance, 0, "detailed", &stage->detailed, error);
    return status == GM_OK
               ? drive_components(&parts, fmu, &transmission, settings, stage, error)
               : status;
}

/* A file or one of the built-in ones. */
static gm_status open_cycle(const char *name, gm_cycle **cycle, gm_error *error)
{
    const char *end = strrchr(name, '.');
    return end && strcmp(end, ".csv") == 0 ? gm_cycle_read(name, cycle, error)
                                           : gm_cycle_named(name, cycle, error);
}

static gm_status open_vehicle(const char *name, gm_vehicle *vehicle, char sha256[65],
                              gm_error *error)
{
    *vehicle = gm_vehicle_reference();
    gm_status status = name ? gm_vehicle_read(name, vehicle, error) : GM_OK;
    return status == GM_OK && name ? gm_sha256_file(name, sha256, error) : status;
}

gm_status gm_stage_cycle_check(const gm_cycle_settings *settings, gm_error *error)
{
    gm_cycle *cycle = NULL;
    gm_vehicle vehicle;
    char sha256[65];
    gm_status status = open_cycle(settings->cycle, &cycle, error);
    if (status == GM_OK)
        status = open_vehicle(settings->vehicle, &vehicle, sha256, error);
    gm_cycle_destroy(cycle);
    return status;
}

gm_status gm_stage_cycle(const gm_gearset_file *file, const char *fmu,
                         const gm_cycle_settings *settings, gm_cycle_stage *stage,
                         gm_error *error)
{
    gm_vehicle vehicle;
    memset(stage, 0, sizeof *stage);
    stage->tolerance = settings->tolerance;
    stage->n_paths = file->plant->info.n_paths;
    for (int p = 0; p < stage->n_paths; p++)
        stage->path_name[p] = file->plant->info.path[p].name;
    if (!file->gearset)
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "a model on the test rig cannot drive a cycle; --cycle needs the "
                       "description of a gearset");
    gm_status status = open_cycle(settings->cycle, &stage->cycle, error);
    if (status == GM_OK)
        status = open_vehicle(settings->vehicle, &vehicle, stage->vehicle_sha256, error);
    if (status == GM_OK)
        status = drive_all(file, fmu, &vehicle, settings, stage, error);
    if (status != GM_OK)
        gm_stage_cycle_clear(stage);
    return status;
}
