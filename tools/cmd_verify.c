/* SPDX-License-Identifier: BSD-2-Clause
 *
 * gearmap verify: the component as it ships against the detailed gearset.
 */
#include "commands.h"

#include "files.h"
#include "verified.h"

#include <math.h>
#include <string.h>

#define KELVIN 273.15
#define SAME_TEMPERATURE 1e-6 /* K: rounding when units are converted */

typedef struct arguments {
    const char *description, *fmu;
    int steady, points, seed, summary, json;
    double oil_temperature;
    gm_cycle_settings drive;
} arguments;

// clang-format off
static const gm_option options[] = {
    GM_DESCRIPTION_OPERAND(arguments),
    {.kind = GM_OPTION_OPERAND, .name = "FMU", .required = 1,
     .offset = offsetof(arguments, fmu),
     .help = "the component made from it"},
    {.kind = GM_OPTION_FLAG, .name = "steady", .offset = offsetof(arguments, steady),
     .help = "compare steady losses at random points off the grid"},
    GM_POINTS_OPTION(arguments),
    GM_SEED_OPTION(arguments),
    {.kind = GM_OPTION_TEXT, .name = "cycle", .value = "CYCLE",
     .offset = offsetof(arguments, drive.cycle),
     .help = "drive one vehicle over a cycle with both: ece15, urban (4 x ece15), eudc, "
             "nedc, wltc3b or FILE.csv with columns time_s, speed_km_h and optionally "
             "gear and grade_percent"},
    {.kind = GM_OPTION_TEXT, .name = "vehicle", .value = "FILE.yaml",
     .offset = offsetof(arguments, drive.vehicle),
     .help = "with --cycle: the vehicle; default: a C-segment car (see gearmap help "
             "vehicle)"},
    {.kind = GM_OPTION_TEXT, .name = "fidelity", .value = "NAME", .fallback = "both",
     .offset = offsetof(arguments, drive.fidelity),
     .help = "with --cycle: rigid, lash or both"},
    {.kind = GM_OPTION_QUANTITY, .name = "tolerance", .value = "NUMBER", .unit = "",
     .low = 1e-10, .high = 1e-2, .fallback = "1e-6",
     .offset = offsetof(arguments, drive.tolerance),
     .help = "with --cycle: relative error of a step of the solver"},
    {.kind = GM_OPTION_QUANTITY, .name = "communication-step", .value = "TIME",
     .unit = "s", .low = 1e-6, .high = 0.1,
     .offset = offsetof(arguments, drive.communication_step),
     .help = "with --cycle: drive in Co-Simulation too, in steps of this length (1ms)"},
    {.kind = GM_OPTION_FLAG, .name = "summary", .offset = offsetof(arguments, summary),
     .help = "with --cycle: print the small table alone, without gears, shifts and the "
             "places of the largest differences"},
    {.kind = GM_OPTION_TEXT, .name = "trace", .value = "FILE.csv",
     .offset = offsetof(arguments, drive.trace),
     .help = "with --cycle: write the drives over time"},
    GM_OIL_OPTION(offsetof(arguments, oil_temperature),
                  "oil temperature that the component must have been made for; default: "
                  "its own"),
    GM_JSON_OPTION(arguments),
};
// clang-format on

typedef struct comparison {
    const arguments *asked;
    gm_verify_stage steady;
    gm_cycle_stage cycle;
    gm_measured measured;
} comparison;

static void print_text(const void *result, FILE *out)
{
    const comparison *c = result;
    if (c->asked->steady)
        gm_verify_stage_print(&c->steady, out);
    if (c->asked->steady && c->asked->drive.cycle)
        fputc('\n', out);
    if (c->asked->drive.cycle && c->asked->summary)
        gm_cycle_stage_print_table(&c->cycle, out);
    else if (c->asked->drive.cycle)
        gm_cycle_stage_print(&c->cycle, out);
}

static void print_json(const void *result, gm_json *json)
{
    const comparison *c = result;
    const gm_verified verified = {.measured = c->measured,
                                  .steady = c->asked->steady ? &c->steady : NULL,
                                  .cycle = c->asked->drive.cycle ? &c->cycle : NULL};
    gm_verified_json(&verified, json);
}

static const gm_result_form form = {print_text, print_json};

/* A component with an oil axis is compared anywhere on it. */
static gm_status choose_on_axis(const arguments *a, const gm_fmu_origin *origin,
                                double *temperature, gm_error *error)
{
    const double low = origin->oil[0], high = origin->oil[origin->n_oil - 1];
    if (a->oil_temperature < low - SAME_TEMPERATURE ||
        a->oil_temperature > high + SAME_TEMPERATURE)
        return gm_fail(
            error, GM_ERR_MODEL,
            "%s: was made for oil temperatures from %g to %g degC, not %g degC", a->fmu,
            low - KELVIN, high - KELVIN, a->oil_temperature - KELVIN);
    if (a->drive.cycle &&
        fabs(a->oil_temperature - origin->oil_temperature) > SAME_TEMPERATURE)
        return gm_fail(error, GM_ERR_MODEL,
                       "%s: drives are compared at the oil temperature that it starts "
                       "with, %g degC, not %g degC",
                       a->fmu, origin->oil_temperature - KELVIN,
                       a->oil_temperature - KELVIN);
    *temperature = a->oil_temperature;
    return GM_OK;
}

/* The temperature to compare at: the component's, which must be the one that was asked
 * for. A component that does not say is believed. */
static gm_status choose_temperature(const arguments *a, const gm_fmu_origin *origin,
                                    double *temperature, gm_error *error)
{
    const double made_for = origin->oil_temperature;
    if (origin->n_oil > 0 && !isnan(a->oil_temperature))
        return choose_on_axis(a, origin, temperature, error);
    if (fabs(made_for - a->oil_temperature) > SAME_TEMPERATURE)
        return gm_fail(error, GM_ERR_MODEL,
                       "%s: was made for an oil temperature of %g degC, not %g degC",
                       a->fmu, made_for - KELVIN, a->oil_temperature - KELVIN);
    *temperature = isnan(made_for) ? a->oil_temperature : made_for;
    return GM_OK;
}

/* A description may have changed in a comment only: worth a note, no reason to refuse. */
static void note_another_description(const arguments *a, const gm_measured *measured)
{
    if (gm_measured_same(measured))
        return;
    fprintf(stderr,
            *measured->made_from_sha256
                ? "gearmap: note: %s was made from another description than %s, or from "
                  "another version of it\n"
                : "gearmap: note: %s does not say whether it was made from %s\n",
            a->fmu, a->description);
}

/* Longer steps run too, but do not follow all vibrations. */
static void note_long_steps(const arguments *a, const gm_cycle_stage *cycle)
{
    for (int i = 0; i < cycle->n_runs; i++) {
        const gm_cycle_run *run = &cycle->run[i];
        if (run->communication_step > run->recommended_step)
            fprintf(stderr,
                    "gearmap: note: %s recommends steps of %.4g ms at most in fidelity "
                    "%s, not %.4g ms\n",
                    a->fmu, 1e3 * run->recommended_step, gm_fidelity_name(run->fidelity),
                    1e3 * run->communication_step);
    }
}

static gm_status compare(const arguments *a, gm_fmu *fmu, const gm_gearset_file *file,
                         comparison *c, gm_error *error)
{
    gm_status status = gm_measured_read(fmu, file, &c->measured, error);
    if (status == GM_OK && a->steady)
        status = gm_stage_verify(file, fmu, !isnan(a->oil_temperature), a->points,
                                 a->seed, &c->steady, error);
    if (status == GM_OK && a->drive.cycle)
        status = gm_stage_cycle(file, a->fmu, &a->drive, &c->cycle, error);
    if (status == GM_OK && a->drive.trace)
        status = gm_cycle_stage_trace(&c->cycle, a->drive.trace, error);
    return status;
}

static gm_status verify_fmu(const arguments *a, gm_fmu *fmu, int *skipped,
                            gm_error *error)
{
    const gm_fmu_origin origin = gm_fmu_read_origin(fmu);
    gm_gearset_file file;
    comparison c = {.asked = a};
    double temperature = (double)NAN;
    gm_status status = choose_temperature(a, &origin, &temperature, error);
    if (status == GM_OK)
        status =
            gm_gearset_file_open_any(a->description, temperature, NULL, &file, error);
    if (status != GM_OK)
        return status;
    status = compare(a, fmu, &file, &c, error);
    if (status == GM_OK) {
        note_another_description(a, &c.measured);
        note_long_steps(a, &c.cycle);
        status = gm_command_print(&form, a->json, &c, error);
    }
    gm_stage_warn_left_out(&c.steady);
    *skipped = c.steady.result.n_skipped;
    gm_stage_cycle_clear(&c.cycle);
    gm_stage_verify_clear(&c.steady);
    gm_gearset_file_close(&file);
    return status;
}

static gm_status verify(const arguments *a, int *skipped, gm_error *error)
{
    gm_fmu *fmu = NULL;
    gm_status status = GM_OK;
    if (a->drive.trace)
        status = gm_file_check_output(a->drive.trace, a->description, error);
    if (status == GM_OK)
        status = gm_fmu_open(a->fmu, &fmu, error);
    if (status == GM_OK)
        status = verify_fmu(a, fmu, skipped, error);
    gm_fmu_close(fmu);
    return status;
}

static const char *usage_problem(const arguments *a)
{
    const char *fidelity = a->drive.fidelity;
    if (!a->steady && !a->drive.cycle)
        return "verify needs --steady, --cycle CYCLE or both";
    if (a->drive.trace && !a->drive.cycle)
        return "--trace needs --cycle";
    if (a->summary && !a->drive.cycle)
        return "--summary needs --cycle";
    if (!isnan(a->drive.communication_step) && !a->drive.cycle)
        return "--communication-step needs --cycle";
    if (a->drive.vehicle && !a->drive.cycle)
        return "--vehicle needs --cycle";
    if (strcmp(fidelity, "rigid") != 0 && strcmp(fidelity, "lash") != 0 &&
        strcmp(fidelity, "both") != 0)
        return "--fidelity is rigid, lash or both";
    return NULL;
}

static int run(const void *given)
{
    gm_error error = {0};
    const char *problem = usage_problem(given);
    if (problem) {
        fprintf(stderr, "gearmap: %s\n", problem);
        return GM_EXIT_USAGE;
    }
    int skipped = 0;
    int code = gm_command_end(verify(given, &skipped, &error), &error);
    return code == GM_EXIT_DONE && skipped > 0 ? GM_EXIT_SKIPPED : code;
}

const gm_command gm_command_verify = {
    .name = "verify",
    .summary = "compare a component with the detailed model it was made from",
    .details =
        "Errors are relative to the largest loss of each gear and direction. They do not "
        "change the exit code, however large: 1 means that there was nothing to compare, "
        "3 that a foreign model failed at some points, which are left out.",
    .options = options,
    .n_options = sizeof options / sizeof options[0],
    .size = sizeof(arguments),
    .run = run,
};
