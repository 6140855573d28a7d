/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The detailed gearset over a schedule: processor time and work for several tolerances,
 * and where in time the steps go. The best of three runs.
 *
 *   bench_transient [description.yaml schedule.csv]
 */
#include "plant/gm_builtin.h"
#include "solve/gm_schedule.h"

#include <stdio.h>

#define RUNS 3
#define PHASES 20

typedef struct bench {
    const gm_gearset *gearset;
    const gm_plant *plant;
    const gm_schedule *schedule;
} bench;

typedef struct outcome {
    gm_transient_statistics work;
    gm_transient_energy energy;
    long steps[PHASES + 1]; /* up to the end of each phase */
    double cpu[PHASES + 1]; /* s */
} outcome;

static gm_status integrate(gm_transient *transient, const gm_schedule *s, outcome *o,
                           gm_error *error)
{
    double from = s->rows[0].t, span = s->rows[s->n_rows - 1].t - from;
    gm_status status = gm_transient_start(transient, from, error);
    for (int i = 0; i <= PHASES && status == GM_OK; i++) {
        status = gm_transient_advance(transient, from + span * i / PHASES, error);
        o->work = gm_transient_work(transient);
        o->steps[i] = o->work.steps;
        o->cpu[i] = o->work.cpu;
    }
    o->energy = gm_transient_account(transient);
    return status;
}

static gm_status run(const bench *b, double tolerance, outcome *o, gm_error *error)
{
    const gm_dynamics dynamics = gm_builtin_dynamics(b->gearset);
    gm_schedule_reader reader = {.schedule = b->schedule};
    const gm_drive drive = gm_schedule_drive(&reader);
    const gm_transient_options options = {.tolerance = tolerance};
    double speed[GM_MAX_FLANGES];
    gm_driven *driven = NULL;
    gm_transient *transient = NULL;
    gm_status status = gm_schedule_start_speeds(b->schedule, b->plant, speed, error);
    if (status == GM_OK)
        status = gm_driven_create(&dynamics, &drive, b->schedule->rows[0].t, speed,
                                  &driven, error);
    if (status == GM_OK) {
        const gm_transient_system system = gm_driven_system(driven);
        status = gm_transient_create(&system, &options, &transient, error);
    }
    if (status == GM_OK)
        status = integrate(transient, b->schedule, o, error);
    gm_transient_destroy(transient);
    gm_driven_destroy(driven);
    return status;
}

static gm_status best_of(const bench *b, double tolerance, outcome *best, gm_error *error)
{
    for (int i = 0; i < RUNS; i++) {
        outcome o = {0};
        gm_status status = run(b, tolerance, &o, error);
        if (status != GM_OK)
            return status;
        if (i == 0 || o.work.cpu < best->work.cpu)
            *best = o;
    }
    return GM_OK;
}

static void print_phases(const bench *b, const outcome *o)
{
    const gm_schedule *s = b->schedule;
    double from = s->rows[0].t, span = s->rows[s->n_rows - 1].t - from;
    printf("\nup to [s]    steps   cpu [ms]\n");
    for (int i = 1; i <= PHASES; i++)
        printf("%9.3f %8ld %10.2f\n", from + span * i / PHASES,
               o->steps[i] - o->steps[i - 1], 1e3 * (o->cpu[i] - o->cpu[i - 1]));
}

static gm_status bench_all(const bench *b, gm_error *error)
{
    static const double tolerance[] = {1e-3, 1e-4, 1e-5, 1e-6};
    const gm_schedule *s = b->schedule;
    double span = s->rows[s->n_rows - 1].t - s->rows[0].t;
    outcome usual = {0};
    printf("%9s %8s %8s %8s %8s %8s %10s %12s %9s\n", "tolerance", "steps", "rates",
           "Jacob.", "too long", "cpu [s]", "us/step", "x real time", "open [J]");
    for (size_t i = 0; i < sizeof tolerance / sizeof tolerance[0]; i++) {
        outcome o = {0};
        gm_status status = best_of(b, tolerance[i], &o, error);
        if (status != GM_OK)
            return status;
        printf("%9.0e %8ld %8ld %8ld %8ld %8.3f %10.2f %12.1f %9.2g\n", tolerance[i],
               o.work.steps, o.work.rates, o.work.jacobians, o.work.error_failures,
               o.work.cpu, 1e6 * o.work.cpu / (double)o.work.steps, span / o.work.cpu,
               o.energy.residual);
        if (i == 1)
            usual = o;
    }
    print_phases(b, &usual);
    return GM_OK;
}

static gm_status bench_files(const char *description_file, const char *schedule_file,
                             gm_error *error)
{
    gm_description *description = NULL;
    gm_gearset *gearset = NULL;
    gm_plant *plant = NULL;
    gm_schedule *schedule = NULL;
    gm_status status = gm_description_read(description_file, &description, error);
    if (status == GM_OK)
        status =
            gm_gearset_create(description, description->oil.temperature, &gearset, error);
    if (status == GM_OK)
        status = gm_builtin_create(gearset, &plant, error);
    if (status == GM_OK)
        status = gm_schedule_read(schedule_file, &plant->info, &schedule, error);
    if (status == GM_OK) {
        const bench b = {gearset, plant, schedule};
        status = bench_all(&b, error);
    }
    gm_schedule_destroy(schedule);
    gm_builtin_destroy(plant);
    gm_gearset_destroy(gearset);
    gm_description_destroy(description);
    return status;
}

int main(int argc, char **argv)
{
    gm_error error = {0};
    const char *description = GM_SOURCE_DIR "/examples/dct7.yaml";
    const char *schedule = GM_SOURCE_DIR "/examples/dct7_shifts.csv";
    if (argc > 2) {
        description = argv[1];
        schedule = argv[2];
    }
    if (bench_files(description, schedule, &error) == GM_OK)
        return 0;
    fprintf(stderr, "%s\n", error.message);
    return 1;
}
