/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Scheduling of a sweep: phase by phase, threads take items from a list (points that the
 * error control wants, units of it to advance, rows of the tables), each with a solver of
 * its own.
 */
#include "sweep/gm_sweep.h"

#include "base/alloc.h"
#include "base/team.h"
#include "sweep/checks.h"
#include "sweep/control.h"
#include "sweep/experiments.h"
#include "sweep/oil_bend.h"
#include "sweep/plan.h"
#include "sweep/points.h"
#include "sweep/skips.h"

#include <math.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

/* A row of the plan. */
typedef struct job {
    int unit, row;
} job;

typedef struct run {
    gm_sweep_plan *plan;
    gm_map *map;
    gm_points *points;
    gm_control *control; /* NULL: the axes are given */
    int threads;
    gm_sweep_report report;
    void *user;
    double started; /* s */
    int n_jobs;
    job *jobs;
    atomic_long outstanding; /* points that are wanted, as far as is known */
    double worst_error;
    atomic_int stop;
    int failed_item; /* of several that fail at once the first in the list is told */
    gm_status status;
    gm_error error;
} run;

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int by_error(const gm_sweep_options *o)
{
    return o->tolerance_share > 0.0 || o->tolerance_torque > 0.0;
}

static gm_status check_options(const gm_sweep_options *o, gm_error *error)
{
    const double value[] = {o->speed_step, o->torque_step,     o->speed_max,
                            o->torque_max, o->tolerance_share, o->tolerance_torque};
    static const char *const name[] = {"speed step",     "torque step",
                                       "largest speed",  "largest torque",
                                       "relative error", "error"};
    for (int i = 0; i < 6; i++)
        if (!(value[i] >= 0.0) || !isfinite(value[i]))
            return gm_fail(error, GM_ERR_ARGUMENT, "the %s is %g; it must be above zero",
                           name[i], value[i]);
    if (o->tolerance_share >= 1.0)
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "an error of %g of the largest loss is no tolerance",
                       o->tolerance_share);
    if (by_error(o) && (o->speed_step > 0.0 || o->torque_step > 0.0))
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "axes are chosen by their error or by steps, not by both");
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

/* The plant's own, or the end of the oil axis that is nearest to it. */
static double usual_temperature(double own, const gm_sweep_options *options)
{
    if (options->n_oil == 0)
        return own;
    double low = options->at_oil[0]->info.oil_temperature;
    double high = options->at_oil[options->n_oil - 1]->info.oil_temperature;
    return fmin(fmax(own, low), high);
}

static gm_status set_oil(const gm_sweep_options *options, gm_map *map, gm_error *error)
{
    double temperature[GM_MAP_MAX_OIL];
    if (options->n_oil == 0)
        return GM_OK;
    if (options->n_oil < 2 || options->n_oil > GM_MAP_MAX_OIL)
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "an oil axis has 2 to %d temperatures, not %d", GM_MAP_MAX_OIL,
                       options->n_oil);
    for (int k = 0; k < options->n_oil; k++)
        temperature[k] = options->at_oil[k]->info.oil_temperature;
    return gm_map_set_oil(map, options->n_oil, temperature, error);
}

/* Append to the text of the options. */
GM_PRINTF(2, 3)
static void add_option(gm_map *map, const char *format, ...)
{
    size_t used = strlen(map->options);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(map->options + used, sizeof map->options - used, format, arguments);
    va_end(arguments);
}

static void describe(const gm_plant *plant, const gm_sweep_options *options, gm_map *map)
{
    const gm_plant_info *info = &plant->info;
    char speed[32], torque[32];
    option_text(options->speed_step, speed);
    option_text(options->torque_step, torque);
    map->speed_max = options->speed_max > 0.0 ? options->speed_max : info->speed_max;
    map->torque_max = options->torque_max > 0.0 ? options->torque_max : info->torque_max;
    map->oil_temperature = usual_temperature(info->oil_temperature, options);
    snprintf(map->name, sizeof map->name, "%s", info->name);
    snprintf(map->title, sizeof map->title, "%s", info->title);
    snprintf(map->tool_version, sizeof map->tool_version, "%s", GM_VERSION);
    snprintf(map->input_sha256, sizeof map->input_sha256, "%s", info->source_sha256);
    map->options[0] = '\0';
    add_option(map,
               "speed_step=%s torque_step=%s speed_max=%.17g torque_max=%.17g "
               "oil_temperature=%.17g",
               speed, torque, map->speed_max, map->torque_max, map->oil_temperature);
    if (options->n_oil > 0)
        add_option(
            map, " oil_axis=%.9g..%.9g/%d", options->at_oil[0]->info.oil_temperature,
            options->at_oil[options->n_oil - 1]->info.oil_temperature, options->n_oil);
    if (by_error(options))
        add_option(map, " tolerance=%.17g,%.17gN.m interpolation=%s",
                   options->tolerance_share, options->tolerance_torque,
                   options->monotone ? "monotone" : "linear");
    if (options->experiments)
        add_option(map, " %s", options->experiments);
}

/* ---- threads ---- */

/* A kind of work: item i of it, with a thread's solver. */
typedef gm_status (*work)(run *r, int i, gm_point_solver *solver, gm_error *error);

typedef struct list {
    run *r;
    work what;
    int n;
    atomic_int next;
    pthread_mutex_t failure; /* of r's failed_item, status and error */
} list;

static void keep_failure(list *l, int item, gm_status status, const gm_error *error)
{
    run *r = l->r;
    (void)pthread_mutex_lock(&l->failure);
    if (r->status == GM_OK || item < r->failed_item) {
        r->failed_item = item;
        r->status = status;
        r->error = *error;
    }
    (void)pthread_mutex_unlock(&l->failure);
    atomic_store(&r->stop, 1);
}

static void do_items(list *l, gm_point_solver *solver)
{
    int i;
    while ((i = atomic_fetch_add(&l->next, 1)) < l->n && !atomic_load(&l->r->stop)) {
        gm_error error = {GM_OK, ""};
        gm_status status = l->what(l->r, i, solver, &error);
        if (status != GM_OK)
            keep_failure(l, i, status, &error);
    }
}

/* One thread's share of the items. */
static void do_share(void *user)
{
    list *l = user;
    gm_point_solver *solver = NULL;
    gm_error error = {GM_OK, ""};
    gm_status status = gm_point_solver_create(l->r->points, l->r->plan->n_plants,
                                              l->r->plan->plants, &solver, &error);
    if (status != GM_OK) {
        keep_failure(l, 0, status, &error);
        return;
    }
    do_items(l, solver);
    status = gm_point_solver_flush(solver, &error);
    if (status != GM_OK)
        keep_failure(l, l->n, status, &error);
    gm_point_solver_destroy(solver);
}

static gm_status do_all(run *r, work what, int n)
{
    list l = {.r = r, .what = what, .n = n};
    (void)pthread_mutex_init(&l.failure, NULL);
    gm_team_run(r->threads < n ? r->threads : n, do_share, &l);
    (void)pthread_mutex_destroy(&l.failure);
    return r->status;
}

/* ---- progress ---- */

static gm_sweep_progress progress_of(const run *r)
{
    long done = gm_points_count(r->points);
    return (gm_sweep_progress){
        .points_done = done,
        .points_total = done + atomic_load(&r->outstanding),
        .points_resumed = gm_points_resumed(r->points),
        .worst_error = r->worst_error,
        .elapsed = now() - r->started,
    };
}

static gm_status watch(void *user, gm_error *error)
{
    run *r = user;
    gm_sweep_progress progress = progress_of(r);
    if (!r->report || !r->report(r->user, &progress))
        return GM_OK;
    return gm_fail(error, GM_ERR_INTERRUPTED,
                   "the sweep was interrupted after %ld of %ld points",
                   progress.points_done, progress.points_total);
}

/* ---- error control ---- */

static gm_status sample_lot(run *r, int i, gm_point_solver *solver, gm_error *error)
{
    gm_status status = gm_control_sample(r->control, i, solver, error);
    atomic_fetch_sub(&r->outstanding, gm_control_lot_size(r->control, i));
    return status;
}

static gm_status advance_unit(run *r, int i, gm_point_solver *solver, gm_error *error)
{
    (void)solver;
    return gm_control_advance(r->control, i, error);
}

static gm_status choose_axes(run *r, int phase)
{
    int n = 0;
    gm_status status = gm_control_begin(r->control, phase, &r->error);
    if (status == GM_OK)
        status = gm_control_lots(r->control, &n, &r->error);
    while (status == GM_OK && n > 0) {
        long wanted = 0;
        for (int i = 0; i < n; i++)
            wanted += gm_control_lot_size(r->control, i);
        atomic_store(&r->outstanding, wanted);
        status = do_all(r, sample_lot, n);
        if (status == GM_OK)
            status = do_all(r, advance_unit, r->plan->n_units);
        r->worst_error = gm_control_worst(r->control);
        if (status == GM_OK)
            status = gm_control_lots(r->control, &n, &r->error);
    }
    if (status == GM_OK)
        status = gm_control_end(r->control, &r->error);
    r->status = status;
    return status;
}

/* ---- tables ---- */

static int points_of(const run *r, const job *j)
{
    return gm_unit_row_points(r->plan, &r->plan->units[j->unit]);
}

static gm_status do_row(run *r, int i, gm_point_solver *solver, gm_error *error)
{
    const job *j = &r->jobs[i];
    gm_status status =
        gm_experiment_row(r->plan, &r->plan->units[j->unit], j->row, solver, error);
    atomic_fetch_sub(&r->outstanding, points_of(r, j));
    return status;
}

static gm_status list_rows(run *r, int phase)
{
    const gm_sweep_plan *plan = r->plan;
    int rows = 0;
    for (int u = 0; u < plan->n_units; u++)
        rows += plan->units[u].phase == phase ? gm_unit_rows(plan, &plan->units[u]) : 0;
    job *jobs = gm_resize(r->jobs, (size_t)rows + 1, sizeof *jobs);
    if (!jobs)
        return gm_fail(&r->error, GM_ERR_MEMORY, "no memory for the rows of the sweep");
    r->jobs = jobs;
    r->n_jobs = 0;
    for (int u = 0; u < plan->n_units; u++)
        for (int i = 0; i < gm_unit_rows(plan, &plan->units[u]); i++)
            if (plan->units[u].phase == phase)
                jobs[r->n_jobs++] = (job){u, i};
    return GM_OK;
}

/* What the tables of a phase and those after it take; with axes by error only rows are
   known whose points were solved already. */
static void count_outstanding(run *r, int phase)
{
    long points = 0;
    const gm_sweep_plan *plan = r->plan;
    for (int u = 0; u < plan->n_units && !r->control; u++)
        if (plan->units[u].phase >= phase)
            points += (long)gm_unit_rows(plan, &plan->units[u]) *
                      gm_unit_row_points(plan, &plan->units[u]);
    atomic_store(&r->outstanding, points);
}

static gm_status fill_tables(run *r, int phase)
{
    r->status = list_rows(r, phase);
    if (r->status != GM_OK)
        return r->status;
    count_outstanding(r, phase);
    if (do_all(r, do_row, r->n_jobs) == GM_OK)
        r->status = gm_skips_fill(r->map, &r->error);
    return r->status;
}

static gm_status fit_bend(run *r, int i, gm_point_solver *solver, gm_error *error)
{
    return gm_oil_bend(r->plan, i, solver, &r->map->oil_bend[i], error);
}

static gm_status fit_bends(run *r)
{
    int measured = r->plan->n_plants > gm_map_slices(r->map);
    return measured ? do_all(r, fit_bend, r->map->n_oil - 1) : GM_OK;
}

static gm_status run_phases(run *r, gm_error *error)
{
    r->started = now();
    r->worst_error = (double)NAN;
    gm_points_set_watch(r->points, watch, r);
    for (int phase = 1; phase <= GM_SWEEP_PHASES && r->status == GM_OK; phase++) {
        if (r->control && choose_axes(r, phase) != GM_OK)
            break;
        (void)fill_tables(r, phase);
    }
    if (r->status == GM_OK)
        (void)fit_bends(r);
    atomic_store(&r->outstanding, 0);
    if (r->status == GM_OK && r->report) {
        gm_sweep_progress progress = progress_of(r);
        (void)r->report(r->user, &progress); /* it is too late to stop */
    }
    if (r->status != GM_OK && error)
        *error = r->error;
    return r->status;
}

/* ---- life ---- */

static gm_status prepare(run *r, const gm_plant *plant, const gm_sweep_options *options,
                         const char *path, double *deviation, gm_error *error)
{
    gm_status status = check_options(options, error);
    if (status != GM_OK)
        return status;
    r->threads = options->threads > 0 ? options->threads : gm_team_all();
    r->map = gm_map_create();
    if (!r->map)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for the map");
    status = set_oil(options, r->map, error);
    if (status != GM_OK)
        return status;
    describe(plant, options, r->map);
    status = check_range(r->map, error);
    if (status == GM_OK)
        status = gm_sweep_identify(plant, r->map, deviation, error);
    if (status == GM_OK)
        status = gm_sweep_plan_create(plant, options, r->map, &r->plan, error);
    if (status == GM_OK && by_error(options))
        status = gm_control_create(r->plan, options, &r->control, error);
    if (status == GM_OK)
        status = gm_points_open(path, r->map, &r->points, error);
    /* Error control has no use for a place without numbers. */
    if (status == GM_OK && plant->is->measure && !r->control)
        gm_points_allow_skips(r->points);
    return status;
}

static gm_status summarise(const run *r, double deviation, gm_sweep_summary *summary,
                           gm_error *error)
{
    const gm_skipped_point *skipped = NULL;
    long resumed = gm_points_resumed(r->points);
    *summary = (gm_sweep_summary){
        .points = gm_points_count(r->points) - resumed,
        .resumed = resumed,
        .elapsed = now() - r->started,
        .largest_ratio_deviation = deviation,
        .uncertainty = gm_points_uncertainty(r->points),
        .n_skipped = gm_points_skipped(r->points, &skipped),
    };
    if (r->control)
        gm_control_missed(r->control, summary->missed);
    size_t n = (size_t)summary->n_skipped;
    if (n == 0)
        return GM_OK;
    summary->skipped = gm_calloc(n, sizeof *skipped);
    if (!summary->skipped)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for what was skipped");
    memcpy(summary->skipped, skipped, n * sizeof *skipped);
    return GM_OK;
}

void gm_sweep_summary_clear(gm_sweep_summary *summary)
{
    gm_free(summary->skipped);
    summary->skipped = NULL;
    summary->n_skipped = 0;
}

gm_status gm_sweep_run(const gm_plant *plant, const gm_sweep_options *options,
                       const char *path, gm_sweep_report report, void *user, gm_map **map,
                       gm_sweep_summary *summary, gm_error *error)
{
    run r = {.report = report, .user = user};
    double deviation = 0.0;
    gm_status status = prepare(&r, plant, options, path, &deviation, error);
    if (status == GM_OK)
        status = run_phases(&r, error);
    if (status == GM_OK)
        status = gm_sweep_check_unique(r.map, error);
    if (status == GM_OK)
        status = gm_points_finish(r.points, r.map, error);
    if (status == GM_OK && summary)
        status = summarise(&r, deviation, summary, error);
    gm_points_close(r.points, status == GM_ERR_INTERRUPTED || status == GM_ERR_IO ||
                                  status == GM_ERR_MEMORY);
    gm_control_destroy(r.control);
    gm_sweep_plan_destroy(r.plan);
    gm_free(r.jobs);
    if (status == GM_OK)
        *map = r.map;
    else
        gm_map_destroy(r.map);
    return status;
}
