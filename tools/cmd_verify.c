/* SPDX-License-Identifier: BSD-2-Clause
 *
 * gearmap verify: the component as it ships against the detailed gearset.
 */
#include "commands.h"

#include "stages.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#define KELVIN 273.15
#define SAME_TEMPERATURE 1e-6 /* K: rounding when units are converted */

typedef struct arguments {
    const char *description, *fmu;
    int steady, points, seed, json;
    double oil_temperature;
} arguments;

// clang-format off
static const gm_option options[] = {
    GM_DESCRIPTION_OPERAND(arguments),
    {.kind = GM_OPTION_OPERAND, .name = "FMU", .required = 1,
     .offset = offsetof(arguments, fmu),
     .help = "the component made from it"},
    {.kind = GM_OPTION_FLAG, .name = "steady", .required = 1,
     .offset = offsetof(arguments, steady),
     .help = "compare steady losses at random points off the grid"},
    GM_POINTS_OPTION(arguments),
    GM_SEED_OPTION(arguments),
    GM_OIL_OPTION(offsetof(arguments, oil_temperature),
                  "oil temperature that the component must have been made for; default: "
                  "its own"),
    GM_JSON_OPTION(arguments),
};
// clang-format on

typedef struct verified {
    gm_verify_stage stage;
    bool same_description;
} verified;

static void print_text(const void *result, FILE *out)
{
    const verified *v = result;
    gm_verify_stage_print(&v->stage, out);
}

static void print_json(const void *result, gm_json *json)
{
    const verified *v = result;
    gm_json_bool(json, "same_description", v->same_description);
    gm_verify_stage_json(&v->stage, json);
}

static const gm_result_form form = {print_text, print_json};

/* The temperature to compare at: the component's, which must be the one that was asked
 * for. A component that does not say is believed. */
static gm_status choose_temperature(const arguments *a, double made_for,
                                    double *temperature, gm_error *error)
{
    if (fabs(made_for - a->oil_temperature) > SAME_TEMPERATURE)
        return gm_fail(error, GM_ERR_MODEL,
                       "%s: was made for an oil temperature of %g degC, not %g degC",
                       a->fmu, made_for - KELVIN, a->oil_temperature - KELVIN);
    *temperature = isnan(made_for) ? a->oil_temperature : made_for;
    return GM_OK;
}

/* A description may have changed in a comment only: worth a note, no reason to refuse. */
static bool compare_descriptions(const arguments *a, const gm_fmu_origin *origin,
                                 const gm_gearset_file *file)
{
    const char *made_from = origin->description_sha256;
    if (made_from && strcmp(made_from, file->description->sha256) == 0)
        return true;
    fprintf(stderr,
            made_from
                ? "gearmap: note: %s was made from another description than %s, or from "
                  "another version of it\n"
                : "gearmap: note: %s does not say whether it was made from %s\n",
            a->fmu, a->description);
    return false;
}

static gm_status verify_fmu(const arguments *a, gm_fmu *fmu, gm_error *error)
{
    const gm_fmu_origin origin = gm_fmu_read_origin(fmu);
    gm_gearset_file file;
    verified result;
    double temperature = (double)NAN;
    gm_status status = choose_temperature(a, origin.oil_temperature, &temperature, error);
    if (status == GM_OK)
        status = gm_gearset_file_open(a->description, temperature, &file, error);
    if (status != GM_OK)
        return status;
    status = gm_stage_verify(file.plant, fmu, a->points, a->seed, &result.stage, error);
    if (status == GM_OK) {
        result.same_description = compare_descriptions(a, &origin, &file);
        status = gm_command_print(&form, a->json, &result, error);
    }
    gm_stage_verify_clear(&result.stage);
    gm_gearset_file_close(&file);
    return status;
}

static gm_status verify(const arguments *a, gm_error *error)
{
    gm_fmu *fmu = NULL;
    gm_status status = gm_fmu_open(a->fmu, &fmu, error);
    if (status == GM_OK)
        status = verify_fmu(a, fmu, error);
    gm_fmu_close(fmu);
    return status;
}

static int run(const void *given)
{
    gm_error error = {0};
    return gm_command_end(verify(given, &error), &error);
}

const gm_command gm_command_verify = {
    .name = "verify",
    .summary = "compare a component with the detailed model it was made from",
    .details =
        "Errors are relative to the largest loss of each gear and direction. They do not "
        "change the exit code, however large: 1 means that there was nothing to compare.",
    .options = options,
    .n_options = sizeof options / sizeof options[0],
    .size = sizeof(arguments),
    .run = run,
};
