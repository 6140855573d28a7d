/* SPDX-License-Identifier: BSD-2-Clause */
#include "stages.h"

#include "base/alloc.h"
#include "map/gm_map_file.h"

#include "files.h"
#include "fmu_probe.h"
#include "keep_description.h"
#include "oil_plants.h"
#include "sweep/gm_oil.h"
#include "options.h"
#include "progress.h"

#include <math.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

double gm_stage_clock(void)
{
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double or_zero(double value)
{
    return isnan(value) ? 0.0 : value;
}

static gm_status interrupted(const char *path, gm_error *error)
{
    if (!path)
        return gm_fail(
            error, GM_ERR_INTERRUPTED,
            "interrupted; nothing is kept (with --map FILE the finished points "
            "would be)");
    return gm_fail(
        error, GM_ERR_INTERRUPTED,
        "interrupted; %s.part keeps the finished points, the same command resumes", path);
}

/* A step beyond the maximum would leave nothing between the ends of the axis. */
static gm_status check_step(const char *option, double step, double max, double unit,
                            const char *name, gm_error *error)
{
    if (!(step > max * (1.0 + 1e-9)))
        return GM_OK;
    return gm_fail(error, GM_ERR_ARGUMENT,
                   "--%s %.6g %s is more than the maximum, %.6g %s", option, step / unit,
                   name, max / unit, name);
}

static gm_status check_steps(const gm_plant *plant, const gm_sweep_settings *s,
                             gm_error *error)
{
    const double rpm = 0.10471975511965977; /* rad/s */
    double speed_max = isnan(s->speed_max) ? plant->info.speed_max : s->speed_max;
    double torque_max = isnan(s->torque_max) ? plant->info.torque_max : s->torque_max;
    gm_status status =
        check_step("speed-step", s->speed_step, speed_max, rpm, "rpm", error);
    if (status == GM_OK)
        status = check_step("torque-step", s->torque_step, torque_max, 1.0, "Nm", error);
    return status;
}

static int index_of(const char *name, const char *(*name_of)(int), int n)
{
    for (int i = 0; i < n; i++)
        if (!name || strcmp(name, name_of(i)) == 0)
            return i;
    return -1;
}

static const char *losses_name(int i)
{
    return gm_losses_name((gm_losses_by)i);
}

static const char *inertia_name(int i)
{
    return gm_inertia_name((gm_inertia_by)i);
}

gm_status gm_stage_choose(const gm_sweep_settings *s, gm_experiment_choice *how,
                          gm_error *error)
{
    int losses = index_of(s->losses, losses_name, GM_LOSSES_SETTLE + 1);
    int inertia = index_of(s->inertia, inertia_name, GM_INERTIA_RAMPS + 1);
    if (losses < 0)
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "there is no experiment '%s' for losses (steady, ramp, settle)",
                       s->losses);
    if (inertia < 0)
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "there is no experiment '%s' for inertias (mass-matrix, ramps)",
                       s->inertia);
    *how = (gm_experiment_choice){(gm_losses_by)losses, (gm_inertia_by)inertia,
                                  or_zero(s->dwell), or_zero(s->ramp_time)};
    return GM_OK;
}

/* What tells this sweep from the usual one of the same file; empty: nothing. */
static void experiments_text(const gm_gearset_file *file, const gm_sweep_settings *s,
                             char text[80])
{
    const gm_experiment_choice *h = &file->how;
    int measured = s->losses || s->inertia || s->dwell > 0.0 || s->ramp_time > 0.0;
    text[0] = '\0';
    if (measured && (h->losses != GM_LOSSES_STEADY || h->inertia != GM_INERTIA_MATRIX))
        (void)snprintf(text, 80, "losses=%s inertia=%s dwell=%.9g ramp_time=%.9g",
                       gm_losses_name(h->losses), gm_inertia_name(h->inertia), h->dwell,
                       h->ramp_time);
}

/* Beside the map, as it is no part of what the map says. */
static gm_status keep_uncertainty(const gm_sweep_stage *stage, gm_error *error)
{
    const gm_map_experiments kept = {.losses = gm_losses_name(stage->how.losses),
                                     .inertia = gm_inertia_name(stage->how.inertia),
                                     .loss_uncertainty = stage->summary.uncertainty,
                                     .inertia_uncertainty = stage->inertia_uncertainty,
                                     .n_skipped = stage->summary.n_skipped};
    return gm_map_put_experiments(stage->path, &kept, error);
}

double gm_stage_temperature(const gm_sweep_settings *settings)
{
    return settings->oil.n == 1 ? settings->oil.value[0] : (double)NAN;
}

/* The temperatures of the axis, and the middles between them. */
static gm_status open_oil(const gm_gearset_file *file, int n, const double *oil,
                          gm_oil_plants *plants, gm_error *error)
{
    double temperature[2 * GM_MAP_MAX_OIL];
    for (int k = 0; k < n; k++)
        temperature[k] = oil[k];
    for (int k = 0; k + 1 < n; k++)
        temperature[n + k] = 0.5 * (oil[k] + oil[k + 1]);
    return gm_oil_plants_open(file, 2 * n - 1, temperature, plants, error);
}

/* With a tolerance temperatures are added; not of simulated models, which take their
   time for every one. */
static gm_status choose_oil(const gm_gearset_file *file, const gm_sweep_options *options,
                            int *n, double *oil, gm_error *error)
{
    const gm_plant_info *info = &file->plant->info;
    gm_oil_plant_list list = {.file = file};
    const gm_oil_source source = {gm_oil_plant_at, &list};
    if (file->rig || !(options->tolerance_share > 0.0 || options->tolerance_torque > 0.0))
        return GM_OK;
    gm_status status = gm_oil_choose(
        &source, options->speed_max > 0.0 ? options->speed_max : info->speed_max,
        options->torque_max > 0.0 ? options->torque_max : info->torque_max,
        options->tolerance_share, options->tolerance_torque, n, oil, error);
    gm_oil_plant_list_clear(&list);
    return status;
}

static gm_status add_oil(const gm_gearset_file *file, const gm_option_list *oil,
                         gm_sweep_options *options, gm_oil_plants *plants,
                         gm_error *error)
{
    double temperature[GM_MAP_MAX_OIL];
    int n = oil->n;
    if (n < 2)
        return GM_OK;
    memcpy(temperature, oil->value, (size_t)n * sizeof *temperature);
    gm_status status = choose_oil(file, options, &n, temperature, error);
    if (status == GM_OK)
        status = open_oil(file, n, temperature, plants, error);
    if (status != GM_OK)
        return status;
    options->n_oil = n;
    options->at_oil = plants->plant;
    options->between_oil = plants->plant + n;
    return GM_OK;
}

static gm_status run_sweep(const gm_gearset_file *file, gm_sweep_options *options,
                           const gm_option_list *oil, const char *path,
                           gm_sweep_stage *stage, gm_error *error)
{
    gm_oil_plants plants = {0};
    gm_progress progress;
    gm_progress_begin(&progress, "sweep", file->plant->info.name);
    gm_status status = add_oil(file, oil, options, &plants, error);
    if (status == GM_OK)
        status = gm_sweep_run(file->plant, options, path, gm_progress_report, &progress,
                              &stage->map, &stage->summary, error);
    gm_progress_end(&progress);
    gm_oil_plants_close(&plants);
    return status;
}

gm_status gm_stage_sweep(const gm_gearset_file *file, const gm_sweep_settings *settings,
                         const char *path, gm_sweep_stage *stage, gm_error *error)
{
    char experiments[80];
    experiments_text(file, settings, experiments);
    gm_sweep_options options = {
        .speed_step = or_zero(settings->speed_step),
        .torque_step = or_zero(settings->torque_step),
        .speed_max = or_zero(settings->speed_max),
        .torque_max = or_zero(settings->torque_max),
        .tolerance_share = settings->tolerance.share,
        .tolerance_torque = settings->tolerance.torque,
        .monotone = settings->monotone,
        .threads = settings->threads == GM_OPTION_UNSET ? 0 : settings->threads,
        .experiments = experiments[0] ? experiments : NULL,
    };
    memset(stage, 0, sizeof *stage);
    gm_status status = check_steps(file->plant, settings, error);
    if (status != GM_OK)
        return status;
    status = run_sweep(file, &options, &settings->oil, path, stage, error);
    stage->path = path;
    stage->tolerance = settings->tolerance;
    stage->how = file->how;
    stage->inertia_uncertainty = file->inertia_uncertainty;
    if (status == GM_OK && path)
        status = keep_uncertainty(stage, error);
    if (status == GM_OK && path && file->description)
        status = gm_keep_description(file->description, path, error);
    return status == GM_ERR_INTERRUPTED ? interrupted(path, error) : status;
}

void gm_stage_sweep_clear(gm_sweep_stage *stage)
{
    gm_map_destroy(stage->map);
    gm_sweep_summary_clear(&stage->summary);
    memset(stage, 0, sizeof *stage);
}

bool gm_stage_knows_interpolation(const char *name)
{
    if (strcmp(name, "linear") == 0 || strcmp(name, "monotone") == 0)
        return true;
    fprintf(stderr, "gearmap: there is no interpolation '%s' (only linear, monotone)\n",
            name);
    return false;
}

bool gm_stage_is_monotone(const char *name)
{
    return strcmp(name, "monotone") == 0;
}

static gm_bake_options options_of(const gm_bake_settings *settings, const char *share)
{
    return (gm_bake_options){.share = share,
                             .compiler = settings->compiler,
                             .interpolation =
                                 gm_stage_is_monotone(settings->interpolation)
                                     ? GM_INTERPOLATION_MONOTONE
                                     : GM_INTERPOLATION_LINEAR,
                             .speed_in = settings->speed_in};
}

gm_status gm_stage_guid(const gm_map *map, const gm_bake_settings *settings,
                        char guid[64], gm_error *error)
{
    char share[GM_PATH_SIZE];
    gm_status status = gm_file_find_share(share, error);
    if (status != GM_OK)
        return status;
    const gm_bake_options options = options_of(settings, share);
    return gm_bake_guid(map, &options, guid, error);
}

gm_status gm_stage_bake(const gm_map *map, const gm_results *results,
                        const gm_bake_settings *settings, const char *path,
                        gm_bake_stage *stage, gm_error *error)
{
    char share[GM_PATH_SIZE];
    double start = gm_stage_clock();
    memset(stage, 0, sizeof *stage);
    gm_status status = gm_file_find_share(share, error);
    if (status != GM_OK)
        return status;
    gm_bake_options options = options_of(settings, share);
    options.n_results = results->n;
    options.results = results->list;
    gm_progress progress;
    gm_progress_begin(&progress, "bake", map->name);
    status = gm_bake_fmu2(map, &options, path, &stage->summary, error);
    gm_progress_end(&progress);
    stage->elapsed = gm_stage_clock() - start;
    if (!gm_progress_interrupted())
        return status;
    if (status == GM_OK)
        (void)unlink(path);
    return gm_fail(error, GM_ERR_INTERRUPTED, "interrupted; no component was written");
}

static gm_status verify_probe(const gm_gearset_file *file, gm_fmu_probe *probe,
                              int points, int seed, gm_verify_stage *stage,
                              gm_error *error)
{
    const gm_reduced_probe interface = gm_fmu_probe_interface(probe);
    const gm_plant *single = file->solved ? file->solved : file->plant;
    gm_oil_plants held_out = {.n = 0};
    gm_progress progress;
    gm_progress_begin(&progress, "verify", file->plant->info.name);
    gm_status status = GM_OK;
    if (stage->n_oil > 0)
        status = gm_oil_plants_hold_out(file, stage->n_oil, stage->oil, seed, &held_out,
                                        error);
    if (status == GM_OK)
        status = gm_verify_plants(held_out.n > 0 ? held_out.n : 1,
                                  held_out.n > 0 ? held_out.plant : &single, &interface,
                                  points, (uint64_t)seed, &stage->result, error);
    gm_progress_end(&progress);
    gm_oil_plants_close(&held_out);
    return status;
}

static void take_axis(int n, const double *oil, gm_verify_stage *stage)
{
    stage->n_oil = n;
    for (int k = 0; k < n; k++)
        stage->oil[k] = oil[k];
}

gm_status gm_stage_verify(const gm_gearset_file *file, gm_fmu *fmu, int alone, int points,
                          int seed, gm_verify_stage *stage, gm_error *error)
{
    const gm_fmu_origin origin = gm_fmu_read_origin(fmu);
    gm_fmu_probe *probe = NULL;
    double start = gm_stage_clock();
    memset(stage, 0, sizeof *stage);
    take_axis(alone ? 0 : origin.n_oil, origin.oil, stage);
    gm_status status = gm_fmu_probe_create(fmu, file->plant, &probe, error);
    if (status != GM_OK)
        return status;
    status = verify_probe(file, probe, points, seed, stage, error);
    gm_fmu_probe_destroy(probe);
    stage->elapsed = gm_stage_clock() - start;
    if (gm_progress_interrupted())
        return gm_fail(error, GM_ERR_INTERRUPTED, "interrupted; nothing was verified");
    return status;
}

void gm_stage_verify_clear(gm_verify_stage *stage)
{
    gm_verify_result_clear(&stage->result);
    memset(stage, 0, sizeof *stage);
}

/* Kept one by one where one path carries load: these belong to the load loss tables. */
static void keep_points(gm_verify_group group, const gm_verify_case *c,
                        gm_map_error_point *point, gm_map_error *e)
{
    e->n_points = group == GM_VERIFY_SINGLE ? c->points : 0;
    e->point = point;
    for (int i = 0; i < e->n_points; i++)
        point[i] = (gm_map_error_point){.speed = c->point[i].speed,
                                        .torque = c->point[i].torque,
                                        .detailed = c->point[i].detailed,
                                        .reduced = c->point[i].reduced};
}

static void to_map_error(gm_verify_group group, const gm_verify_case *c, int n_paths,
                         gm_map_error *e)
{
    *e = (gm_map_error){.kind = gm_verify_group_name(group),
                        .path = c->path,
                        .gear = {c->gear[0], n_paths > 1 ? c->gear[1] : GM_MAP_ANY},
                        .direction = c->direction,
                        .points = c->points,
                        .largest = c->largest_loss,
                        .max = c->max,
                        .rms = c->rms,
                        .worst_speed = c->worst_speed,
                        .worst_torque = c->worst_torque};
}

/* points: room for those of a whole group */
static void collect_errors(const gm_verify_result *r, int n_paths,
                           gm_map_error_point *points, gm_map_error *errors)
{
    for (int g = 0; g < GM_VERIFY_GROUPS; g++)
        for (int i = 0; i < r->n_cases[g]; i++) {
            to_map_error((gm_verify_group)g, &r->cases[g][i], n_paths, errors);
            keep_points((gm_verify_group)g, &r->cases[g][i], points, errors);
            points += errors->n_points;
            errors++;
        }
}

gm_status gm_stage_keep(const gm_verify_stage *stage, const gm_map *map,
                        const char *result, const char *map_path, gm_error *error)
{
    const gm_verify_result *r = &stage->result;
    int n = 0;
    for (int g = 0; g < GM_VERIFY_GROUPS; g++)
        n += r->n_cases[g];
    gm_map_error *errors = gm_calloc((size_t)n, sizeof *errors);
    gm_map_error_point *points = gm_calloc((size_t)r->points, sizeof *points);
    gm_status status = GM_ERR_MEMORY;
    if (errors && points) {
        collect_errors(r, map->n_paths, points, errors);
        const gm_map_verification verification = {.seed = (long long)r->seed,
                                                  .n_errors = n,
                                                  .errors = errors,
                                                  .n_results = result ? 1 : 0,
                                                  .results = &result};
        status = gm_map_put_verification(map_path, &verification, error);
    } else {
        (void)gm_fail(error, status, "no memory for the measured errors");
    }
    gm_free(points);
    gm_free(errors);
    return status;
}

static gm_status measure(const gm_gearset_file *file, const gm_map *map, int monotone,
                         int points, int seed, gm_verify_stage *stage, gm_error *error)
{
    const gm_plant *single = file->solved ? file->solved : file->plant;
    gm_oil_plants held_out = {.n = 0};
    gm_status status = GM_OK;
    if (map->n_oil > 0)
        status =
            gm_oil_plants_hold_out(file, map->n_oil, map->oil, seed, &held_out, error);
    if (status == GM_OK)
        status = gm_verify_map(held_out.n > 0 ? held_out.n : 1,
                               held_out.n > 0 ? held_out.plant : &single, map, monotone,
                               points, (uint64_t)seed, &stage->result, error);
    gm_oil_plants_close(&held_out);
    return status;
}

gm_status gm_stage_measure(const gm_gearset_file *file, const gm_sweep_stage *sweep,
                           int monotone, int points, int seed, gm_verify_stage *stage,
                           gm_error *error)
{
    double start = gm_stage_clock();
    memset(stage, 0, sizeof *stage);
    take_axis(sweep->map->n_oil, sweep->map->oil, stage);
    gm_status status = measure(file, sweep->map, monotone, points, seed, stage, error);
    if (status != GM_OK)
        return status;
    stage->elapsed = gm_stage_clock() - start;
    status = gm_stage_keep(stage, sweep->map, NULL, sweep->path, error);
    if (status != GM_OK)
        gm_stage_verify_clear(stage);
    return status;
}
