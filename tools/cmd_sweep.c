/* SPDX-License-Identifier: BSD-2-Clause
 *
 * gearmap sweep: experiments on a detailed gearset -> map.
 */
#include "commands.h"

#include "files.h"
#include "progress.h"
#include "stages.h"

typedef struct arguments {
    const char *description, *output;
    gm_sweep_settings sweep;
    const char *interpolation;
    const char *progress;
    int json;
} arguments;

// clang-format off
static const gm_option options[] = {
    GM_DESCRIPTION_OPERAND(arguments),
    {.kind = GM_OPTION_TEXT, .name = "output", .letter = 'o', .value = "MAP",
     .required = 1, .offset = offsetof(arguments, output),
     .help = "the map to write"},
    GM_SWEEP_OPTIONS(arguments),
    {.kind = GM_OPTION_TEXT, .name = "interpolation", .value = "NAME",
     .fallback = "linear", .offset = offsetof(arguments, interpolation),
     .help = "what the tolerance is for: linear, or monotone as in bake"},
    GM_PROGRESS_OPTION(arguments),
    GM_JSON_OPTION(arguments),
};
// clang-format on

/* Points at which a map with axes by error is measured, of each kind. */
#define MEASURED 2000
#define MEASURED_SEED 1

typedef struct outcome {
    gm_sweep_stage sweep;
    bool measured;
    gm_verify_stage verify;
} outcome;

static void print_text(const void *result, FILE *out)
{
    const outcome *o = result;
    gm_sweep_stage_print(&o->sweep, out);
    if (o->measured)
        gm_verify_stage_print_groups(&o->verify, out);
}

static void print_json(const void *result, gm_json *json)
{
    const outcome *o = result;
    gm_sweep_stage_json(&o->sweep, json);
    if (!o->measured)
        return;
    gm_json_object(json, "verify");
    gm_verify_stage_json(&o->verify, json);
    gm_json_end(json);
}

static const gm_result_form form = {print_text, print_json};

static gm_status sweep_file(const arguments *a, const gm_gearset_file *file, outcome *o,
                            gm_error *error)
{
    gm_sweep_settings settings = a->sweep;
    settings.monotone = gm_stage_is_monotone(a->interpolation);
    gm_status status = gm_stage_sweep(file, &settings, a->output, &o->sweep, error);
    o->measured = settings.tolerance.share > 0.0 || settings.tolerance.torque > 0.0;
    if (status != GM_OK || !o->measured)
        return status;
    status = gm_stage_measure(file, &o->sweep, settings.monotone, MEASURED, MEASURED_SEED,
                              &o->verify, error);
    if (status == GM_OK)
        gm_stage_warn(&o->sweep, &o->verify);
    return status;
}

static gm_status sweep(const arguments *a, int *skipped, gm_error *error)
{
    gm_gearset_file file;
    outcome o = {.measured = false};
    gm_status status = gm_file_check_output(a->output, a->description, error);
    gm_experiment_choice how;
    if (status == GM_OK)
        status = gm_stage_choose(&a->sweep, &how, error);
    if (status == GM_OK)
        status = gm_gearset_file_open_any(a->description, gm_stage_temperature(&a->sweep),
                                          &how, &file, error);
    if (status != GM_OK)
        return status;
    status = sweep_file(a, &file, &o, error);
    gm_stage_warn_skips(&o.sweep);
    *skipped = o.sweep.summary.n_skipped;
    if (status == GM_OK)
        status = gm_command_print(&form, a->json, &o, error);
    gm_stage_verify_clear(&o.verify);
    gm_stage_sweep_clear(&o.sweep);
    gm_gearset_file_close(&file);
    return status;
}

static int run(const void *given)
{
    const arguments *a = given;
    gm_error error = {0};
    if (!gm_stage_knows_interpolation(a->interpolation) ||
        !gm_progress_choose(a->progress))
        return GM_EXIT_USAGE;
    int skipped = 0;
    int code = gm_command_end(sweep(a, &skipped, &error), &error);
    return code == GM_EXIT_DONE && skipped > 0 ? GM_EXIT_SKIPPED : code;
}

const gm_command gm_command_sweep = {
    .name = "sweep",
    .summary = "run the experiments on a description, write a map",
    .details =
        "Every gear of every path, driving and driven, forward and backward, with "
        "preselected gears, both paths loaded and in neutral. An interrupted sweep "
        "leaves MAP.part; the same command resumes it. The map does not depend on "
        "the number of threads nor on interruptions. With --tolerance the nodes are "
        "chosen by the error at points held out; it is then measured at other points, "
        "printed and kept in the map, and tables that could not reach it are named. With "
        "several oil temperatures more of them are added until losses between any two "
        "are inside too.",
    .options = options,
    .n_options = sizeof options / sizeof options[0],
    .size = sizeof(arguments),
    .run = run,
};
