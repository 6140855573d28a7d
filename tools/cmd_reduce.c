/* SPDX-License-Identifier: BSD-2-Clause
 *
 * gearmap reduce: sweep, bake and verify in one go. The component gets its name only when
 * all three are done: until then it stands beside as OUTPUT.new.
 */
#include "commands.h"

#include "files.h"
#include "stages.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

typedef struct arguments {
    const char *description, *output, *map, *compiler;
    gm_sweep_settings sweep;
    int points, seed, json;
} arguments;

// clang-format off
static const gm_option options[] = {
    {.kind = GM_OPTION_OPERAND, .name = "FILE", .required = 1,
     .offset = offsetof(arguments, description),
     .help = "the description of the gearset"},
    {.kind = GM_OPTION_TEXT, .name = "output", .letter = 'o', .value = "FMU",
     .required = 1, .offset = offsetof(arguments, output),
     .help = "the component to write"},
    {.kind = GM_OPTION_TEXT, .name = "map", .value = "MAP",
     .offset = offsetof(arguments, map),
     .help = "keep the map, with the measured errors, in this file; default: in memory "
             "only"},
    GM_SWEEP_OPTIONS(arguments),
    {.kind = GM_OPTION_TEXT, .name = "compiler", .value = "COMMAND",
     .offset = offsetof(arguments, compiler),
     .help = "C compiler; default: $CC, else cc, gcc or clang"},
    {.kind = GM_OPTION_INTEGER, .name = "points", .value = "N", .low = 1, .high = 1e7,
     .fallback = "2000", .offset = offsetof(arguments, points),
     .help = "number of points of each kind to verify"},
    {.kind = GM_OPTION_INTEGER, .name = "seed", .value = "N", .low = 0,
     .high = 2147483647.0, .fallback = "1", .offset = offsetof(arguments, seed),
     .help = "start of the random numbers"},
    {.kind = GM_OPTION_FLAG, .name = "json", .offset = offsetof(arguments, json),
     .help = "print the result as JSON"},
};
// clang-format on

typedef struct reduction {
    gm_gearset_file file;
    gm_sweep_stage sweep;
    gm_bake_stage bake;
    gm_verify_stage verify;
    double start;
} reduction;

static void print_json(const arguments *a, const reduction *r, double elapsed)
{
    gm_json json;
    gm_json_start(&json, stdout);
    gm_json_object(&json, "sweep");
    gm_sweep_stage_json(&r->sweep, &json);
    gm_json_end(&json);
    gm_json_object(&json, "bake");
    gm_bake_stage_json(&r->bake, a->output, &json);
    gm_json_end(&json);
    gm_json_object(&json, "verify");
    gm_verify_stage_json(&r->verify, &json);
    gm_json_end(&json);
    gm_json_number(&json, "elapsed_s", elapsed);
    gm_json_finish(&json);
}

static void print_result(const arguments *a, const reduction *r)
{
    double elapsed = gm_stage_clock() - r->start;
    if (a->json) {
        print_json(a, r, elapsed);
        return;
    }
    gm_sweep_stage_print(&r->sweep, stdout);
    gm_bake_stage_print(&r->bake, a->output, stdout);
    gm_verify_stage_print_groups(&r->verify, stdout);
    printf("\ntotal   %8.2f s\n", elapsed);
}

/* Nothing is begun whose result could not be kept. */
static gm_status check_before(const arguments *a, gm_error *error)
{
    char share[GM_PATH_SIZE];
    gm_status status = gm_file_check_output(a->output, a->description, error);
    if (status == GM_OK && a->map)
        status = gm_file_check_output(a->map, a->description, error);
    if (status == GM_OK && a->map && strcmp(a->map, a->output) == 0)
        status = gm_fail(error, GM_ERR_IO, "%s: cannot be both the map and the component",
                         a->map);
    return status == GM_OK ? gm_file_find_share(share, error) : status;
}

static gm_status bake_and_verify(const arguments *a, reduction *r, const char *name,
                                 gm_error *error)
{
    gm_status status = gm_stage_bake(r->sweep.map, a->compiler, name, &r->bake, error);
    if (status != GM_OK)
        return status;
    status = gm_stage_verify(r->file.plant, name, a->points, a->seed, &r->verify, error);
    if (status == GM_OK && a->map)
        status =
            gm_stage_keep_errors(&r->verify, r->file.plant->info.n_paths, a->map, error);
    if (status == GM_OK && rename(name, a->output) != 0)
        status = gm_fail(error, GM_ERR_IO, "%s: cannot be written: %s", a->output,
                         strerror(errno));
    if (status != GM_OK)
        (void)unlink(name);
    return status;
}

static gm_status reduce(const arguments *a, reduction *r, gm_error *error)
{
    char name[GM_PATH_SIZE];
    gm_status status = check_before(a, error);
    if (status == GM_OK)
        status = gm_gearset_file_open(a->description, a->sweep.oil_temperature, &r->file,
                                      error);
    if (status == GM_OK)
        status = gm_stage_sweep(&r->file, &a->sweep, a->map, &r->sweep, error);
    (void)snprintf(name, sizeof name, "%s.new", a->output);
    if (status == GM_OK)
        status = bake_and_verify(a, r, name, error);
    if (status == GM_OK)
        print_result(a, r);
    return status;
}

static int run(const void *given)
{
    gm_error error = {0};
    reduction r;
    memset(&r, 0, sizeof r);
    r.start = gm_stage_clock();
    gm_status status = reduce(given, &r, &error);
    gm_stage_verify_clear(&r.verify);
    gm_stage_sweep_clear(&r.sweep);
    gm_gearset_file_close(&r.file);
    return gm_command_end(status, &error);
}

const gm_command gm_command_reduce = {
    .name = "reduce",
    .summary = "sweep, bake and verify: from a description to an FMU",
    .details =
        "Prints the time of each stage, the sizes and how far the component is from "
        "the detailed model at random points. Nothing is written when a stage fails.",
    .options = options,
    .n_options = sizeof options / sizeof options[0],
    .size = sizeof(arguments),
    .run = run,
};
