/* SPDX-License-Identifier: BSD-2-Clause
 *
 * gearmap sweep: experiments on a detailed gearset -> map.
 */
#include "commands.h"

#include "files.h"
#include "stages.h"

typedef struct arguments {
    const char *description, *output;
    gm_sweep_settings sweep;
    int json;
} arguments;

// clang-format off
static const gm_option options[] = {
    GM_DESCRIPTION_OPERAND(arguments),
    {.kind = GM_OPTION_TEXT, .name = "output", .letter = 'o', .value = "MAP",
     .required = 1, .offset = offsetof(arguments, output),
     .help = "the map to write"},
    GM_SWEEP_OPTIONS(arguments),
    GM_JSON_OPTION(arguments),
};
// clang-format on

static void print_text(const void *result, FILE *out)
{
    gm_sweep_stage_print(result, out);
}

static void print_json(const void *result, gm_json *json)
{
    gm_sweep_stage_json(result, json);
}

static const gm_result_form form = {print_text, print_json};

static gm_status sweep(const arguments *a, gm_error *error)
{
    gm_gearset_file file;
    gm_sweep_stage stage;
    gm_status status = gm_file_check_output(a->output, a->description, error);
    if (status == GM_OK)
        status =
            gm_gearset_file_open(a->description, a->sweep.oil_temperature, &file, error);
    if (status != GM_OK)
        return status;
    status = gm_stage_sweep(&file, &a->sweep, a->output, &stage, error);
    if (status == GM_OK)
        status = gm_command_print(&form, a->json, &stage, error);
    gm_stage_sweep_clear(&stage);
    gm_gearset_file_close(&file);
    return status;
}

static int run(const void *given)
{
    gm_error error = {0};
    return gm_command_end(sweep(given, &error), &error);
}

const gm_command gm_command_sweep = {
    .name = "sweep",
    .summary = "run the experiments on a description, write a map",
    .details =
        "Every gear of every path, driving and driven, forward and backward, with "
        "preselected gears, both paths loaded and in neutral. An interrupted sweep "
        "leaves MAP.part; the same command resumes it. The map does not depend on "
        "the number of threads nor on interruptions.",
    .options = options,
    .n_options = sizeof options / sizeof options[0],
    .size = sizeof(arguments),
    .run = run,
};
