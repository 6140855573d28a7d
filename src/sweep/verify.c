/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/gm_verify.h"

#include "base/alloc.h"
#include "map/gm_map.h"
#include "sweep/plan.h"
#include "sweep/verify_points.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define MAX_GEARS 32
#define MAX_LINES 32

typedef struct run {
    const gm_plant *plant; /* the first of: */
    int n_plants;
    const gm_plant *const *plants;
    gm_steady_solver **solvers; /* [n_plants], each made when it is wanted */
    gm_verify_result *result;
    gm_error *error;
    double ratio[GM_MAX_INPUT_PATHS][MAX_GEARS]; /* of every gear */
    int n_lines[GM_MAX_INPUT_PATHS];
    double line[GM_MAX_INPUT_PATHS][MAX_LINES]; /* ratios where the drag jumps */
    double output_max;
    int n_draws[GM_VERIFY_GROUPS];
    gm_verify_draw *draws[GM_VERIFY_GROUPS];
} run;

const char *gm_verify_group_name(gm_verify_group group)
{
    static const char *const names[GM_VERIFY_GROUPS] = {
        "single", "preselected", "both_loaded", "drag", "reaction"};
    return (int)group >= 0 && group < GM_VERIFY_GROUPS ? names[group] : "unknown";
}

/* ---- cases ---- */

static gm_status find_ratios(run *r)
{
    const gm_plant_info *info = &r->plant->info;
    double smallest = HUGE_VAL;
    for (int p = 0; p < info->n_paths; p++)
        for (int g = 0; g < info->path[p].n_gears; g++) {
            int gear[GM_MAX_INPUT_PATHS];
            gm_kinematics kinematics;
            for (int q = 0; q < GM_MAX_INPUT_PATHS; q++)
                gear[q] = gm_sweep_rest_gear(r->plant, q);
            if (g >= MAX_GEARS)
                return gm_fail(r->error, GM_ERR_ARGUMENT, "more than %d gears on a path",
                               MAX_GEARS);
            gear[p] = info->path[p].gears[g].number;
            gm_status status =
                r->plant->is->kinematics(r->plant->self, gear, &kinematics, r->error);
            if (status != GM_OK)
                return status;
            r->ratio[p][g] = kinematics.ratio[p];
            smallest = fmin(smallest, fabs(kinematics.ratio[p]));
        }
    r->output_max = info->speed_max / smallest;
    for (int p = 0; p < info->n_paths; p++)
        r->n_lines[p] =
            r->plant->is->drag_lines(r->plant->self, p, MAX_LINES, r->line[p]);
    return GM_OK;
}

/* Cases of a group for both directions of the output. gear[]: index of the gear of each
   path, -1 neutral. */
static gm_status add_case(run *r, gm_verify_group group, int path, const int *gear)
{
    const gm_plant_info *info = &r->plant->info;
    int n = r->n_draws[group];
    gm_verify_draw *draws = gm_resize(r->draws[group], (size_t)n + 2, sizeof *draws);
    if (!draws)
        return gm_fail(r->error, GM_ERR_MEMORY, "no memory to verify");
    r->draws[group] = draws;
    r->n_draws[group] = n + 2;
    for (int d = 0; d < 2; d++) {
        gm_verify_draw *draw = &draws[n + d];
        *draw = (gm_verify_draw){.group = group,
                                 .path = path,
                                 .direction = d ? -1 : 1,
                                 .output_max = r->output_max};
        for (int p = 0; p < info->n_paths; p++) {
            draw->line[p] = r->line[p];
            draw->n_lines[p] = r->n_lines[p];
            if (gear[p] < 0)
                continue;
            draw->gear[p] = info->path[p].gears[gear[p]].number;
            draw->ratio[p] = r->ratio[p][gear[p]];
        }
    }
    return GM_OK;
}

static gm_status add_path_cases(run *r, int p)
{
    const gm_plant_info *info = &r->plant->info;
    int gear[GM_MAX_INPUT_PATHS] = {-1, -1}, free = !info->path[p].always_engaged;
    gm_status status = GM_OK;
    for (int q = 0; q < info->n_paths; q++)
        gear[q] = info->path[q].always_engaged ? 0 : -1;
    if (free)
        status = add_case(r, GM_VERIFY_DRAG, p, gear);
    if (free && status == GM_OK)
        status = add_case(r, GM_VERIFY_REACTION, p, gear);
    for (int g = 0; g < r->plant->info.path[p].n_gears && status == GM_OK; g++) {
        gear[p] = g;
        status = add_case(r, GM_VERIFY_SINGLE, p, gear);
    }
    return status;
}

static gm_status add_cases(run *r)
{
    const gm_plant_info *info = &r->plant->info;
    gm_status status = find_ratios(r);
    for (int p = 0; p < info->n_paths && status == GM_OK; p++)
        status = add_path_cases(r, p);
    if (info->n_paths < 2)
        return status;
    int n_0 = info->path[0].n_gears, n_1 = info->path[1].n_gears;
    for (int i = 0; i < n_0 * n_1 && status == GM_OK; i++) {
        int gear[GM_MAX_INPUT_PATHS] = {i / n_1, i % n_1};
        for (int p = 0; p < 2 && status == GM_OK; p++)
            status = add_case(r, GM_VERIFY_PRESELECTED, p, gear);
        if (status == GM_OK)
            status = add_case(r, GM_VERIFY_BOTH_LOADED, -1, gear);
    }
    return status;
}

/* ---- statistics ---- */

/* Room grows to the next power of two. */
static gm_status keep_point(gm_verify_case *c, const gm_verify_sample *sample,
                            gm_error *error)
{
    const int n = c->points;
    if ((n & (n - 1)) == 0) {
        gm_verify_point *points =
            gm_resize(c->point, n ? 2 * (size_t)n : 1, sizeof *points);
        if (!points)
            return gm_fail(error, GM_ERR_MEMORY, "no memory to verify");
        c->point = points;
    }
    c->point[n] = (gm_verify_point){.speed = sample->speed,
                                    .torque = sample->torque,
                                    .detailed = sample->detailed,
                                    .reduced = sample->reduced,
                                    .oil = sample->oil};
    return GM_OK;
}

/* .rms and .rms_relative hold sums of squares until the group is finished. */
static void add_sample(gm_verify_case *c, const gm_verify_sample *sample)
{
    double error = fabs(sample->reduced - sample->detailed);
    c->points++;
    c->largest_loss = fmax(c->largest_loss, fabs(sample->detailed));
    c->rms += error * error;
    if (!(error > c->max) && c->points > 1)
        return;
    c->max = error;
    c->worst_speed = sample->speed;
    c->worst_torque = sample->torque;
    c->worst_output_speed = sample->output_speed;
    c->worst_oil = sample->oil;
}

static void finish_group(gm_verify_result *result, gm_verify_group group)
{
    double sum = 0.0, largest = 0.0;
    int points = 0;
    for (int i = 0; i < result->n_cases[group]; i++) {
        gm_verify_case *c = &result->cases[group][i];
        if (c->points == 0)
            continue;
        double scale = c->largest_loss > 0.0 ? 1.0 / c->largest_loss : 0.0;
        sum += c->rms * scale * scale;
        points += c->points;
        c->rms = sqrt(c->rms / c->points);
        c->max_relative = c->max * scale;
        c->rms_relative = c->rms * scale;
        largest = fmax(largest, c->max_relative);
    }
    result->max_relative[group] = largest;
    result->rms_relative[group] = points ? sqrt(sum / points) : 0.0;
}

static void label_case(const run *r, const gm_verify_draw *draw, gm_verify_case *c)
{
    c->path = draw->path < 0 ? "both" : r->plant->info.path[draw->path].name;
    c->direction = draw->direction;
    memcpy(c->gear, draw->gear, sizeof c->gear);
}

/* One plant of several; a single one takes no random number. */
static gm_status draw_plant(run *r, uint64_t *random, gm_steady_solver **solver)
{
    int i = r->n_plants > 1 ? (int)(gm_random_next(random) % (uint64_t)r->n_plants) : 0;
    gm_status status = GM_OK;
    if (!r->solvers[i])
        status = gm_steady_solver_create(r->plants[i], &r->solvers[i], r->error);
    *solver = r->solvers[i];
    return status;
}

static gm_status compare_one(run *r, const gm_verify_draw *draw,
                             const gm_reduced_probe *probe, uint64_t *random,
                             gm_verify_sample *sample)
{
    gm_steady_solver *solver;
    gm_status status = draw_plant(r, random, &solver);
    if (status == GM_OK)
        status = gm_verify_compare(draw, solver, gm_steady_solver_plant(solver), probe,
                                   random, sample, r->error);
    if (status == GM_OK && !isfinite(sample->reduced))
        return gm_fail(r->error, GM_ERR_MODEL,
                       "the reduced component answers %g at %g rad/s, %g N.m",
                       sample->reduced, sample->speed, sample->torque);
    return status;
}

static void leave_out(gm_verify_result *result, const gm_error *why)
{
    if (result->n_skipped++ == 0)
        (void)snprintf(result->skipped, sizeof result->skipped, "%.*s",
                       (int)sizeof result->skipped - 1, why->message);
}

static gm_status run_group(run *r, gm_verify_group group, const gm_reduced_probe *probe)
{
    gm_verify_result *result = r->result;
    int n = r->n_draws[group];
    /* Each group has a sequence of its own: it does not change with the others. */
    uint64_t random = result->seed + (uint64_t)group * 0x632be59bd9b4e019u;
    if (n == 0)
        return GM_OK;
    result->cases[group] = gm_calloc((size_t)n, sizeof *result->cases[group]);
    if (!result->cases[group])
        return gm_fail(r->error, GM_ERR_MEMORY, "no memory to verify");
    result->n_cases[group] = n;
    for (int i = 0; i < n; i++)
        label_case(r, &r->draws[group][i], &result->cases[group][i]);
    for (int k = 0; k < result->points; k++) {
        int i = (int)(gm_random_next(&random) % (uint64_t)n);
        gm_verify_sample sample = {.failed = 0};
        gm_status status = compare_one(r, &r->draws[group][i], probe, &random, &sample);
        if (sample.failed) {
            leave_out(result, r->error);
            continue;
        }
        if (status != GM_OK)
            return status;
        status = keep_point(&result->cases[group][i], &sample, r->error);
        if (status != GM_OK)
            return status;
        add_sample(&result->cases[group][i], &sample);
    }
    finish_group(result, group);
    return GM_OK;
}

static gm_status run_groups(run *r, const gm_reduced_probe *probe)
{
    r->solvers = gm_calloc((size_t)r->n_plants, sizeof *r->solvers);
    if (!r->solvers)
        return gm_fail(r->error, GM_ERR_MEMORY, "no memory to verify");
    gm_status status = add_cases(r);
    for (int group = 0; group < GM_VERIFY_GROUPS && status == GM_OK; group++)
        status = run_group(r, (gm_verify_group)group, probe);
    return status;
}

static void clear_run(run *r)
{
    for (int i = 0; r->solvers && i < r->n_plants; i++)
        gm_steady_solver_destroy(r->solvers[i]);
    gm_free(r->solvers);
    for (int group = 0; group < GM_VERIFY_GROUPS; group++)
        gm_free(r->draws[group]);
}

gm_status gm_verify_plants(int n, const gm_plant *const *plants,
                           const gm_reduced_probe *probe, int points, uint64_t seed,
                           gm_verify_result *result, gm_error *error)
{
    gm_verify_result made = {.points = points, .seed = seed};
    run r = {.plant = plants[0],
             .n_plants = n,
             .plants = plants,
             .result = &made,
             .error = error};
    if (points < 1)
        return gm_fail(error, GM_ERR_ARGUMENT, "%d points cannot be verified", points);
    gm_status status = run_groups(&r, probe);
    clear_run(&r);
    if (status == GM_OK)
        *result = made;
    else
        gm_verify_result_clear(&made);
    return status;
}

gm_status gm_verify_steady(const gm_plant *plant, const gm_reduced_probe *probe,
                           int points, uint64_t seed, gm_verify_result *result,
                           gm_error *error)
{
    return gm_verify_plants(1, &plant, probe, points, seed, result, error);
}

static int is_between(const gm_verify_point *p, double low, double high)
{
    return p->oil >= low && p->oil < high;
}

void gm_verify_between(const gm_verify_result *result, gm_verify_group group, double low,
                       double high, int *points, double *max_relative,
                       double *rms_relative)
{
    double max = 0.0, sum = 0.0;
    *points = 0;
    for (int i = 0; i < result->n_cases[group]; i++) {
        const gm_verify_case *c = &result->cases[group][i];
        double largest = 0.0;
        for (int k = 0; k < c->points; k++)
            if (is_between(&c->point[k], low, high))
                largest = fmax(largest, fabs(c->point[k].detailed));
        for (int k = 0; k < c->points && largest > 0.0; k++) {
            const gm_verify_point *p = &c->point[k];
            double error = fabs(p->reduced - p->detailed) / largest;
            if (!is_between(p, low, high))
                continue;
            max = fmax(max, error);
            sum += error * error;
            ++*points;
        }
    }
    *max_relative = max;
    *rms_relative = *points > 0 ? sqrt(sum / *points) : 0.0;
}

void gm_verify_result_clear(gm_verify_result *result)
{
    for (int group = 0; group < GM_VERIFY_GROUPS; group++) {
        for (int i = 0; i < result->n_cases[group]; i++)
            gm_free(result->cases[group][i].point);
        gm_free(result->cases[group]);
        result->cases[group] = NULL;
        result->n_cases[group] = 0;
    }
}
