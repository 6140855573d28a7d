/* SPDX-License-Identifier: BSD-2-Clause
 *
 * gearmap verify: the component as it ships against the detailed gearset.
 */
#include "commands.h"

#include "stages.h"

#include <math.h>

typedef struct arguments {
    const char *description, *fmu;
    int steady, points, seed, json;
    double oil_temperature;
} arguments;

// clang-format off
static const gm_option options[] = {
    {.kind = GM_OPTION_OPERAND, .name = "FILE", .required = 1,
     .offset = offsetof(arguments, description),
     .help = "the description of the gearset"},
    {.kind = GM_OPTION_OPERAND, .name = "FMU", .required = 1,
     .offset = offsetof(arguments, fmu),
     .help = "the component made from it"},
    {.kind = GM_OPTION_FLAG, .name = "steady", .required = 1,
     .offset = offsetof(arguments, steady),
     .help = "compare steady losses at random points off the grid"},
    {.kind = GM_OPTION_INTEGER, .name = "points", .value = "N", .low = 1, .high = 1e7,
     .fallback = "2000", .offset = offsetof(arguments, points),
     .help = "number of points of each kind"},
    {.kind = GM_OPTION_INTEGER, .name = "seed", .value = "N", .low = 0,
     .high = 2147483647.0, .fallback = "1", .offset = offsetof(arguments, seed),
     .help = "start of the random numbers"},
    {.kind = GM_OPTION_QUANTITY, .name = "oil-temperature", .value = "TEMPERATURE",
     .unit = "degC", .low = -50, .high = 200,
     .offset = offsetof(arguments, oil_temperature),
     .help = "oil temperature at which the component was swept; default: the "
             "description's"},
    {.kind = GM_OPTION_FLAG, .name = "json", .offset = offsetof(arguments, json),
     .help = "print the result as JSON"},
};
// clang-format on

static gm_status verify(const arguments *a, gm_error *error)
{
    gm_gearset_file file;
    gm_verify_stage stage;
    gm_status status =
        gm_gearset_file_open(a->description, a->oil_temperature, &file, error);
    if (status != GM_OK)
        return status;
    status = gm_stage_verify(file.plant, a->fmu, a->points, a->seed, &stage, error);
    if (status == GM_OK && a->json) {
        gm_json json;
        gm_json_start(&json, stdout);
        gm_verify_stage_json(&stage, &json);
        gm_json_finish(&json);
    } else if (status == GM_OK) {
        gm_verify_stage_print(&stage, stdout);
    }
    gm_stage_verify_clear(&stage);
    gm_gearset_file_close(&file);
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
    .details = "Errors are relative to the largest loss of each gear and direction.",
    .options = options,
    .n_options = sizeof options / sizeof options[0],
    .size = sizeof(arguments),
    .run = run,
};
