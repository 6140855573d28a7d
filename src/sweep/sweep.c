/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Scheduling of a sweep: threads take the jobs of a phase from its list, each with a
 * solver of its own; a finished row goes into the journal and the progress report one at
 * a time. Built without OpenMP the same code runs on one thread.
 */
#include "sweep/gm_sweep.h"

#include "base/alloc.h"
#include "map/gm_map_file.h"
#include "sweep/checks.h"
#include "sweep/experiments.h"
#include "sweep/plan.h"

#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#define REPORT_INTERVAL 0.1 /* s */

typedef struct run {
    gm_sweep_plan *plan;
    gm_map *map;
    gm_journal *journal;
    gm_sweep_report report;
    void *user;
    gm_sweep_progress progress;
    double started, reported; /* s */
    int phase;
    atomic_int stop;
    int failed_job; /* of several that fail at once the first in the list is told */
    gm_status status;
    gm_error error;
} run;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static gm_status check_options(const gm_sweep_options *o, gm_error *error)
{
    const double value[] = {o->speed_step, o->torque_step, o->speed_max, o->torque_max};
    static const char *const name[] = {"speed step", "torque step", "largest speed",
                                       "largest torque"};
    for (int i = 0; i < 4; i++)
        if (!(value[i] >= 0.0) || !isfinite(value[i]))
            return gm_fail(error, GM_ERR_ARGUMENT, "the %s is %g; it must be above zero",
                           name[i], value[i]);
    if (o->threads < 0)
        return gm_fail(error, GM_ERR_ARGUMENT, "%d threads are not possible", o->threads);
    return GM_OK;
}

static gm_status check_range(const gm_map *map, gm_error *error)
{
    if (map->speed_max > 0.0 && map->torque_max > 0.0 && isfinite(map->speed_max) &&
        isfinite(map->torque_max))
        return GM_OK;
    return gm_fail(
        error, GM_ERR_ARGUMENT,
        "a sweep needs a largest speed and torque above zero, not %g rad/s and "
        "%g N.m",
        map->speed_max, map->torque_max);
}

/* "auto" or the number with all its digits. */
static void option_text(double value, char text[32])
{
    if (value > 0.0)
        snprintf(text, 32, "%.17g", value);
    else
        snprintf(text, 32, "auto");
}

static void describe(const gm_plant *plant, const gm_sweep_options *options, gm_map *map)
{
    const gm_plant_info *info = &plant->info;
    char speed[32], torque[32];
    option_text(options->speed_step, speed);
    option_text(options->torque_step, torque);
    map->speed_max = options->speed_max > 0.0 ? options->speed_max : info->speed_max;
    map->torque_max = options->torque_max > 0.0 ? options->torque_max : info->torque_max;
    map->oil_temperature = info->oil_temperature;
    snprintf(map->name, sizeof map->name, "%s", info->name);
    snprintf(map->title, sizeof map->title, "%s", info->title);
    snprintf(map->tool_version, sizeof map->tool_version, "%s", GM_VERSION);
    snprintf(map->input_sha256, sizeof map->input_sha256, "%s", info->source_sha256);
    snprintf(map->options, sizeof map->options,
             "speed_step=%s torque_step=%s speed_max=%.17g torque_max=%.17g "
             "oil_temperature=%.17g",
             speed, torque, map->speed_max, map->torque_max, map->oil_temperature);
}

/* ---- threads ---- */

static void keep_failure(run *r, int job, gm_status status, const gm_error *error)
{
    if (r->status == GM_OK || job < r->failed_job) {
        r->failed_job = job;
        r->status = status;
        r->error = *error;
    }
    atomic_store(&r->stop, 1);
}

static int is_done(const run *r, const gm_job *job)
{
    if (!r->journal || job->kind == GM_JOB_REFERENCE)
        return 0;
    return gm_journal_has(r->journal, job->table, job->row) &&
           (job->companion < 0 || gm_journal_has(r->journal, job->companion, job->row));
}

static gm_status put_row(run *r, const gm_job *job, gm_error *error)
{
    if (!r->journal || job->kind == GM_JOB_REFERENCE)
        return GM_OK;
    gm_status status = gm_journal_put(r->journal, r->map, job->table, job->row, error);
    if (status == GM_OK && job->companion >= 0)
        status = gm_journal_put(r->journal, r->map, job->companion, job->row, error);
    return status;
}

/* One thread at a time. */
static void finish_job(run *r, int index)
{
    const gm_job *job = &r->plan->jobs[index];
    gm_error error = {GM_OK, ""};
    gm_status status = put_row(r, job, &error);
    double t = now();
    r->progress.points_done += job->points;
    r->progress.elapsed = t - r->started;
    if (status == GM_OK && r->report && t - r->reported >= REPORT_INTERVAL) {
        r->reported = t;
        if (r->report(r->user, &r->progress))
            status = gm_fail(&error, GM_ERR_INTERRUPTED,
                             "the sweep was interrupted after %ld of %ld points",
                             r->progress.points_done, r->progress.points_total);
    }
    if (status != GM_OK)
        keep_failure(r, index, status, &error);
}

static void do_job(run *r, int index, gm_steady_solver *solver)
{
    const gm_job *job = &r->plan->jobs[index];
    gm_error error = {GM_OK, ""};
    if (job->phase != r->phase || atomic_load(&r->stop) || is_done(r, job))
        return;
    gm_status status = gm_experiment_row(r->plan, job, solver, &error);
#pragma omp critical(gm_sweep_row)
    {
        if (status != GM_OK)
            keep_failure(r, index, status, &error);
        else
            finish_job(r, index);
    }
}

/* One thread's share of a phase. */
static void work(run *r)
{
    gm_steady_solver *solver = NULL;
    gm_error error = {GM_OK, ""};
    gm_status status = gm_steady_solver_create(r->plan->plant, &solver, &error);
    if (status != GM_OK) {
#pragma omp critical(gm_sweep_row)
        keep_failure(r, 0, status, &error);
    }
#pragma omp for schedule(dynamic, 1)
    for (int i = 0; i < r->plan->n_jobs; i++)
        do_job(r, i, solver);
    gm_steady_solver_destroy(solver);
}

static void run_phase(run *r, int threads)
{
    if (threads > 0) {
#pragma omp parallel num_threads(threads)
        work(r);
    } else {
#pragma omp parallel
        work(r);
    }
}

static void count_points(run *r)
{
    for (int i = 0; i < r->plan->n_jobs; i++) {
        const gm_job *job = &r->plan->jobs[i];
        r->progress.points_total += job->points;
        if (is_done(r, job))
            r->progress.points_resumed += job->points;
    }
    r->progress.points_done = r->progress.points_resumed;
}

static gm_status run_jobs(run *r, int threads, gm_error *error)
{
    r->started = r->reported = now();
    count_points(r);
    for (r->phase = 1; r->phase <= GM_SWEEP_PHASES && r->status == GM_OK; r->phase++)
        run_phase(r, threads);
    r->progress.elapsed = now() - r->started;
    if (r->status == GM_OK && r->report)
        (void)r->report(r->user, &r->progress); /* it is too late to stop */
    if (r->status != GM_OK && error)
        *error = r->error;
    return r->status;
}

/* ---- life ---- */

static gm_status finish(run *r, gm_error *error)
{
    gm_status status = gm_sweep_check_unique(r->map, error);
    if (status != GM_OK)
        return status;
    if (!r->journal)
        return gm_map_hash(r->map, r->map->content_hash, error);
    status = gm_journal_finish(r->journal, r->map, error);
    r->journal = NULL;
    return status;
}

static gm_status prepare(run *r, const gm_plant *plant, const gm_sweep_options *options,
                         const char *path, double *deviation, gm_error *error)
{
    gm_status status = check_options(options, error);
    if (status != GM_OK)
        return status;
    r->map = gm_map_create();
    if (!r->map)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for the map");
    describe(plant, options, r->map);
    status = check_range(r->map, error);
    if (status == GM_OK)
        status = gm_sweep_identify(plant, r->map, deviation, error);
    if (status == GM_OK)
        status = gm_sweep_plan_create(plant, options, r->map, &r->plan, error);
    if (status == GM_OK && path)
        status = gm_journal_open(path, r->map, &r->journal, error);
    return status;
}

gm_status gm_sweep_run(const gm_plant *plant, const gm_sweep_options *options,
                       const char *path, gm_sweep_report report, void *user, gm_map **map,
                       gm_sweep_summary *summary, gm_error *error)
{
    run r = {.report = report, .user = user};
    double deviation = 0.0;
    gm_status status = prepare(&r, plant, options, path, &deviation, error);
    if (status == GM_OK)
        status = run_jobs(&r, options->threads, error);
    if (status == GM_OK)
        status = finish(&r, error);
    gm_journal_close(r.journal, status == GM_ERR_INTERRUPTED);
    gm_sweep_plan_destroy(r.plan);
    if (status != GM_OK) {
        gm_map_destroy(r.map);
        return status;
    }
    *map = r.map;
    if (summary)
        *summary = (gm_sweep_summary){
            .points = r.progress.points_total - r.progress.points_resumed,
            .resumed = r.progress.points_resumed,
            .elapsed = r.progress.elapsed,
            .largest_ratio_deviation = deviation,
        };
    return GM_OK;
}
