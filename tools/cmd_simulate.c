/* SPDX-License-Identifier: BSD-2-Clause
 *
 * gearmap simulate: the detailed gearset in motion over a schedule.
 */
#include "commands.h"

#include "solve/gm_schedule.h"

#include "files.h"
#include "gearset_file.h"
#include "progress.h"
#include "recording.h"
#include "stages.h"

#include <math.h>
#include <string.h>

#define KELVIN 273.15
#define SAME_TEMPERATURE 1e-6 /* K: rounding when units are converted */
#define SHOWN_EVERY 0.1       /* s, of the progress bar */

typedef struct arguments {
    const char *description, *schedule, *output, *signals;
    double output_step, tolerance, time_limit, oil_temperature;
    int json;
} arguments;

// clang-format off
static const gm_option options[] = {
    GM_DESCRIPTION_OPERAND(arguments),
    {.kind = GM_OPTION_TEXT, .name = "schedule", .letter = 's', .value = "FILE.csv",
     .required = 1, .offset = offsetof(arguments, schedule),
     .help = "what acts on it over time: columns time_s; for a flange (output, odd, even "
             "or input) FLANGE.tau_Nm, its torque, or FLANGE.speed_rpm, a speed that it "
             "is made to turn with; for a path PATH.gear, which holds until the next "
             "row; FLANGE.w_start_rpm, the speed at the start; oil_temperature_degC"},
    {.kind = GM_OPTION_TEXT, .name = "output", .letter = 'o', .value = "FILE.csv",
     .required = 1, .offset = offsetof(arguments, output),
     .help = "the file to write"},
    {.kind = GM_OPTION_QUANTITY, .name = "output-step", .value = "TIME", .unit = "s",
     .low = 1e-6, .high = 1e6, .fallback = "10ms",
     .offset = offsetof(arguments, output_step),
     .help = "time between two rows of the output"},
    {.kind = GM_OPTION_TEXT, .name = "signals", .value = "PATTERNS", .fallback = "*",
     .offset = offsetof(arguments, signals),
     .help = "which quantities of bodies, meshes and bearings are written beside those "
             "of the flanges: names separated by commas, * for any characters"},
    {.kind = GM_OPTION_QUANTITY, .name = "tolerance", .value = "NUMBER", .unit = "",
     .low = 1e-10, .high = 1e-2, .fallback = "3e-4",
     .offset = offsetof(arguments, tolerance),
     .help = "error of a step, relative to usual values of speeds and deflections"},
    {.kind = GM_OPTION_QUANTITY, .name = "time-limit", .value = "TIME", .unit = "s",
     .low = 1e-3, .high = 1e9, .offset = offsetof(arguments, time_limit),
     .help = "processor time after which to give up; default: none"},
    GM_OIL_OPTION(offsetof(arguments, oil_temperature),
                  "oil temperature; default: the schedule's, else the description's"),
    GM_JSON_OPTION(arguments),
};
// clang-format on

typedef struct simulated {
    const arguments *asked;
    const char *name;
    double duration, elapsed; /* s */
    long rows;
    int columns;
    gm_transient_statistics work;
    gm_transient_energy energy;
} simulated;

/* ---- the result ---- */

static double real_time_factor(const simulated *s)
{
    return s->duration / s->work.cpu;
}

/* What the account leaves open, relative to the energy that passed. */
static double open_part(const gm_transient_energy *e)
{
    double scale = fmax(e->through, fmax(e->stored_start, e->stored));
    return scale > 0.0 ? fabs(e->residual) / scale : 0.0;
}

static void print_text(const void *result, FILE *out)
{
    const simulated *s = result;
    const gm_transient_energy *e = &s->energy;
    fprintf(out, "simulate   %.6g s of %s in %.3g s, %.3g times faster than real time\n",
            s->duration, s->name, s->work.cpu, real_time_factor(s));
    fprintf(out,
            "solver     %ld steps, %ld evaluations, %ld Jacobians, %ld steps too long, "
            "%ld restarts\n",
            s->work.steps, s->work.rates, s->work.jacobians, s->work.error_failures,
            s->work.restarts);
    fprintf(out,
            "energy     work %.6g J = stored %.6g J + dissipated %.6g J + impulses %.6g "
            "J; open: %.2g J, %.1e of the %.6g J that passed\n",
            e->work, e->stored - e->stored_start, e->dissipated, e->impulses, e->residual,
            open_part(e), e->through);
    fprintf(out, "written    %s  %ld rows of %d columns\n", s->asked->output, s->rows,
            s->columns);
}

static void energy_json(const gm_transient_energy *e, gm_json *json)
{
    gm_json_object(json, "energy");
    gm_json_number(json, "work_J", e->work);
    gm_json_number(json, "stored_J", e->stored - e->stored_start);
    gm_json_number(json, "dissipated_J", e->dissipated);
    gm_json_number(json, "impulses_J", e->impulses);
    gm_json_number(json, "passed_J", e->through);
    gm_json_number(json, "open_J", e->residual);
    gm_json_number(json, "open_relative", open_part(e));
    gm_json_end(json);
}

static void print_json(const void *result, gm_json *json)
{
    const simulated *s = result;
    gm_json_text(json, "output", s->asked->output);
    gm_json_number(json, "duration_s", s->duration);
    gm_json_number(json, "tolerance", s->asked->tolerance);
    gm_json_integer(json, "rows", s->rows);
    gm_json_integer(json, "columns", s->columns);
    gm_json_integer(json, "steps", s->work.steps);
    gm_json_integer(json, "evaluations", s->work.rates);
    gm_json_integer(json, "jacobians", s->work.jacobians);
    gm_json_integer(json, "error_failures", s->work.error_failures);
    gm_json_integer(json, "convergence_failures", s->work.convergence_failures);
    gm_json_integer(json, "restarts", s->work.restarts);
    gm_json_integer(json, "events", s->work.events);
    gm_json_number(json, "cpu_s", s->work.cpu);
    gm_json_number(json, "elapsed_s", s->elapsed);
    gm_json_number(json, "real_time_factor", real_time_factor(s));
    energy_json(&s->energy, json);
}

static const gm_result_form form = {print_text, print_json};

/* ---- the run ---- */

/* i steps as a number that a schedule may hold too: 920 steps of 10 ms are 9.2 s, while
 * 920 times 0.01 is a hair more. */
static double multiple(long i, double step)
{
    double per_second = round(1.0 / step);
    return fabs(per_second * step - 1.0) < 1e-9 ? (double)i / per_second
                                                : (double)i * step;
}

static gm_status write_rows(gm_transient *transient, gm_recording *recording,
                            const simulated *s, double from, gm_error *error)
{
    gm_progress progress;
    double shown_at = 0.0, step = s->asked->output_step;
    long n = (long)ceil(s->duration / step - 1e-9);
    gm_status status = GM_OK;
    gm_progress_begin(&progress, "simulate", s->name);
    for (long i = 0; i <= n && status == GM_OK; i++) {
        double t = from + fmin(multiple(i, step), s->duration);
        status = gm_transient_advance(transient, t, error);
        if (status == GM_OK)
            status = gm_recording_row(recording, t, gm_transient_state(transient), error);
        if (gm_progress_interrupted())
            status =
                gm_fail(error, GM_ERR_INTERRUPTED, "interrupted; nothing was written");
        if (gm_stage_clock() > shown_at + SHOWN_EVERY) {
            char words[48];
            shown_at = gm_stage_clock();
            (void)snprintf(words, sizeof words, "%.3f of %.6g s", t - from, s->duration);
            gm_progress_show(&progress, (t - from) / s->duration, words);
        }
    }
    gm_progress_end(&progress);
    return status;
}

static gm_status integrate(const arguments *a, const gm_recording_source *source,
                           double from, simulated *s, gm_error *error)
{
    gm_transient_system system = gm_driven_system(source->driven);
    const gm_transient_options settings = {
        .tolerance = a->tolerance, .cpu_max = isnan(a->time_limit) ? 0.0 : a->time_limit};
    gm_transient *transient = NULL;
    gm_recording *recording = NULL;
    gm_status status = gm_transient_create(&system, &settings, &transient, error);
    if (status == GM_OK)
        status = gm_transient_start(transient, from, error);
    if (status == GM_OK)
        status = gm_recording_open(a->output, source, a->signals, &recording, error);
    if (status == GM_OK)
        status = write_rows(transient, recording, s, from, error);
    if (status == GM_OK)
        status = gm_recording_finish(recording, error);
    if (status == GM_OK) {
        s->work = gm_transient_work(transient);
        s->energy = gm_transient_account(transient);
        s->rows = gm_recording_rows(recording);
        s->columns = gm_recording_columns(recording);
    }
    gm_recording_close(recording);
    gm_transient_destroy(transient);
    return status;
}

static gm_status run_schedule(const arguments *a, const gm_gearset_file *file,
                              const gm_schedule *schedule, gm_error *error)
{
    const gm_dynamics dynamics = gm_builtin_dynamics(file->gearset);
    const double begun = gm_stage_clock(), from = schedule->rows[0].t;
    simulated s = {.asked = a,
                   .name = file->plant->info.name,
                   .duration = schedule->rows[schedule->n_rows - 1].t - from};
    gm_schedule_reader reader = {.schedule = schedule};
    const gm_drive drive = gm_schedule_drive(&reader);
    gm_recording_source source = {.dynamics = &dynamics, .info = &file->plant->info};
    double speed[GM_MAX_FLANGES];
    gm_status status = gm_schedule_start_speeds(schedule, file->plant, speed, error);
    if (status == GM_OK)
        status = gm_driven_create(&dynamics, &drive, from, speed, &source.driven, error);
    if (status == GM_OK)
        status = integrate(a, &source, from, &s, error);
    gm_driven_destroy(source.driven);
    s.elapsed = gm_stage_clock() - begun;
    return status == GM_OK ? gm_command_print(&form, a->json, &s, error) : status;
}

/* ---- what is asked for ---- */

/* The oil of the schedule, which an option may repeat but not contradict. NAN: none. */
static gm_status choose_oil(const arguments *a, const gm_schedule *schedule, double *oil,
                            gm_error *error)
{
    if (fabs(schedule->oil_temperature - a->oil_temperature) > SAME_TEMPERATURE)
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "%s: oil_temperature_degC is %g, but --oil-temperature is %g degC",
                       schedule->file, schedule->oil_temperature - KELVIN,
                       a->oil_temperature - KELVIN);
    *oil = isnan(a->oil_temperature) ? schedule->oil_temperature : a->oil_temperature;
    return GM_OK;
}

/* The schedule is read with the names and gears of the gearset; its oil temperature then
 * makes the gearset anew. */
static gm_status simulate_files(const arguments *a, gm_error *error)
{
    gm_gearset_file file;
    gm_schedule *schedule = NULL;
    double oil = (double)NAN;
    gm_status status =
        gm_gearset_file_open(a->description, a->oil_temperature, &file, error);
    if (status != GM_OK)
        return status;
    status = gm_schedule_read(a->schedule, &file.plant->info, &schedule, error);
    if (status == GM_OK)
        status = choose_oil(a, schedule, &oil, error);
    if (status == GM_OK && !isnan(oil) && oil != file.oil_temperature) {
        gm_gearset_file_close(&file);
        status = gm_gearset_file_open(a->description, oil, &file, error);
    }
    if (status == GM_OK)
        status = run_schedule(a, &file, schedule, error);
    gm_schedule_destroy(schedule);
    gm_gearset_file_close(&file);
    return status;
}

static gm_status simulate(const arguments *a, gm_error *error)
{
    gm_status status = gm_file_check_output(a->output, a->description, error);
    if (status == GM_OK)
        status = gm_file_check_output(a->output, a->schedule, error);
    return status == GM_OK ? simulate_files(a, error) : status;
}

static int run(const void *given)
{
    gm_error error = {0};
    return gm_command_end(simulate(given, &error), &error);
}

const gm_command gm_command_simulate = {
    .name = "simulate",
    .summary = "run the detailed gearset over time",
    .details =
        "Torques and speeds of the schedule run on straight lines between its rows, a "
        "time given twice is a step, and what has no column is zero: no torque, neutral. "
        "The oil temperature is constant over the run. Work at the flanges, stored "
        "energy "
        "and losses are accounted for on the way; what they leave open is shown.",
    .options = options,
    .n_options = sizeof options / sizeof options[0],
    .size = sizeof(arguments),
    .run = run,
};
