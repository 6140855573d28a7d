/* SPDX-License-Identifier: BSD-2-Clause
 *
 * gearmap reduce: sweep, bake and verify in one go.
 */
#include "commands.h"

#include "progress.h"
#include "reduction.h"

typedef struct arguments {
    const char *description, *output, *map;
    gm_sweep_settings sweep;
    gm_bake_settings bake;
    int points, seed, json;
    const char *cycle, *vehicle, *trace;
    const char *progress;
} arguments;

// clang-format off
static const gm_option options[] = {
    GM_DESCRIPTION_OPERAND(arguments),
    {.kind = GM_OPTION_TEXT, .name = "output", .letter = 'o', .value = "FMU",
     .required = 1, .offset = offsetof(arguments, output),
     .help = "the component to write"},
    {.kind = GM_OPTION_TEXT, .name = "map", .value = "MAP",
     .offset = offsetof(arguments, map),
     .help = "keep the map, with the measured errors, in this file; default: in memory "
             "only"},
    GM_SWEEP_OPTIONS(arguments),
    GM_BAKE_OPTIONS(arguments),
    GM_POINTS_OPTION(arguments),
    GM_SEED_OPTION(arguments),
    {.kind = GM_OPTION_TEXT, .name = "cycle", .value = "CYCLE",
     .offset = offsetof(arguments, cycle),
     .help = "drive a car over this cycle too, with both gearsets (see gearmap verify "
             "--cycle); it takes some seconds per cycle"},
    {.kind = GM_OPTION_TEXT, .name = "vehicle", .value = "FILE.yaml",
     .offset = offsetof(arguments, vehicle),
     .help = "with --cycle: the vehicle; default: a C-segment car"},
    {.kind = GM_OPTION_TEXT, .name = "trace", .value = "FILE.csv",
     .offset = offsetof(arguments, trace),
     .help = "with --cycle: write the drives over time, as gearmap report shows them"},
    GM_PROGRESS_OPTION(arguments),
    GM_JSON_OPTION(arguments),
};
// clang-format on

static void print_text(const void *result, FILE *out)
{
    const gm_reduction *r = result;
    gm_sweep_stage_print(&r->sweep, out);
    gm_bake_stage_print(&r->bake, r->output, out);
    gm_verify_stage_print_groups(&r->verify, out);
    fprintf(out, "\ntotal   %8.2f s\n", r->elapsed - r->driving);
    if (r->drives) {
        fputc('\n', out);
        gm_cycle_stage_print_table(&r->cycle, out);
    }
}

static void print_json(const void *result, gm_json *json)
{
    const gm_reduction *r = result;
    gm_json_object(json, "sweep");
    gm_sweep_stage_json(&r->sweep, json);
    gm_json_end(json);
    gm_json_object(json, "bake");
    gm_bake_stage_json(&r->bake, r->output, json);
    gm_json_end(json);
    gm_json_object(json, "verify");
    gm_verify_stage_json(&r->verify, json);
    gm_json_end(json);
    if (r->drives) {
        gm_json_object(json, "cycle");
        gm_cycle_stage_json(&r->cycle, json);
        gm_json_end(json);
    }
    gm_json_number(json, "elapsed_s", r->elapsed);
}

static const gm_result_form form = {print_text, print_json};

static int run(const void *given)
{
    const arguments *a = given;
    gm_error error = {0};
    gm_reduction r;
    if (!gm_stage_knows_interpolation(a->bake.interpolation) ||
        !gm_progress_choose(a->progress))
        return GM_EXIT_USAGE;
    if ((a->vehicle || a->trace) && !a->cycle) {
        fprintf(stderr, "gearmap: --%s needs --cycle\n",
                a->vehicle ? "vehicle" : "trace");
        return GM_EXIT_USAGE;
    }
    const gm_reduce_settings settings = {.description = a->description,
                                         .output = a->output,
                                         .map = a->map,
                                         .sweep = a->sweep,
                                         .bake = a->bake,
                                         .points = a->points,
                                         .seed = a->seed,
                                         .cycle = a->cycle,
                                         .vehicle = a->vehicle,
                                         .trace = a->trace};
    gm_status status = gm_reduce(&settings, &r, &error);
    if (status == GM_OK)
        status = gm_command_print(&form, a->json, &r, &error);
    int skipped = r.sweep.summary.n_skipped + r.verify.result.n_skipped;
    gm_stage_warn_skips(&r.sweep);
    gm_stage_warn_left_out(&r.verify);
    gm_reduction_clear(&r);
    int code = gm_command_end(status, &error);
    return code == GM_EXIT_DONE && skipped > 0 ? GM_EXIT_SKIPPED : code;
}

const gm_command gm_command_reduce = {
    .name = "reduce",
    .summary = "sweep, bake and verify: from a description to an FMU",
    .details =
        "Prints the time of each stage, the sizes and how far the component is from "
        "the detailed model at random points, and puts the errors into the component's "
        "accuracy passport. A failed stage leaves no output; "
        "finished files stay when the result cannot be printed.",
    .options = options,
    .n_options = sizeof options / sizeof options[0],
    .size = sizeof(arguments),
    .run = run,
};
