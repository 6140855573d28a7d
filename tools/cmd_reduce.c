/* SPDX-License-Identifier: BSD-2-Clause
 *
 * gearmap reduce: sweep, bake and verify in one go. The component gets its name only when
 * all three are done: until then it stands beside under a name of this process.
 */
#include "commands.h"

#include "files.h"
#include "stages.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

typedef struct arguments {
    const char *description, *output, *map;
    gm_sweep_settings sweep;
    gm_bake_settings bake;
    int points, seed, json;
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
    GM_JSON_OPTION(arguments),
};
// clang-format on

typedef struct reduction {
    const char *output;
    gm_gearset_file file;
    gm_sweep_stage sweep;
    gm_bake_stage bake;
    gm_verify_stage verify;
    double start, elapsed; /* s */
} reduction;

static void print_text(const void *result, FILE *out)
{
    const reduction *r = result;
    gm_sweep_stage_print(&r->sweep, out);
    gm_bake_stage_print(&r->bake, r->output, out);
    gm_verify_stage_print_groups(&r->verify, out);
    fprintf(out, "\ntotal   %8.2f s\n", r->elapsed);
}

static void print_json(const void *result, gm_json *json)
{
    const reduction *r = result;
    gm_json_object(json, "sweep");
    gm_sweep_stage_json(&r->sweep, json);
    gm_json_end(json);
    gm_json_object(json, "bake");
    gm_bake_stage_json(&r->bake, r->output, json);
    gm_json_end(json);
    gm_json_object(json, "verify");
    gm_verify_stage_json(&r->verify, json);
    gm_json_end(json);
    gm_json_number(json, "elapsed_s", r->elapsed);
}

static const gm_result_form form = {print_text, print_json};

/* Nothing is begun whose result could not be kept. */
static gm_status check_before(const arguments *a, gm_error *error)
{
    char share[GM_PATH_SIZE];
    gm_status status = gm_file_check_output(a->output, a->description, error);
    if (status == GM_OK && a->map)
        status = gm_file_check_output(a->map, a->description, error);
    if (status == GM_OK && a->map && gm_file_is_same(a->map, a->output))
        status = gm_fail(error, GM_ERR_IO, "%s: cannot be both the map and the component",
                         a->map);
    return status == GM_OK ? gm_file_find_share(share, error) : status;
}

static gm_status verify(const arguments *a, reduction *r, const char *name,
                        gm_error *error)
{
    gm_fmu *fmu = NULL;
    gm_status status = gm_fmu_open(name, &fmu, error);
    if (status == GM_OK)
        status =
            gm_stage_verify(r->file.plant, fmu, a->points, a->seed, &r->verify, error);
    gm_fmu_close(fmu);
    if (status == GM_OK)
        status =
            gm_stage_keep_errors(&r->verify, &r->bake, r->sweep.map, name, a->map, error);
    if (status == GM_OK) /* the errors are in the archive now */
        r->bake.summary.file_size = gm_file_size(name);
    return status;
}

/* `name` is this process's own file; the last of several reductions wins. */
static gm_status bake_and_verify(const arguments *a, reduction *r, const char *name,
                                 gm_error *error)
{
    gm_status status =
        gm_stage_bake(r->sweep.map, 0, NULL, &a->bake, name, &r->bake, error);
    if (status != GM_OK)
        return status;
    status = verify(a, r, name, error);
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
        status = gm_file_own_name(a->output, name, error);
    if (status == GM_OK)
        status = gm_gearset_file_open(a->description, a->sweep.oil_temperature, &r->file,
                                      error);
    if (status == GM_OK)
        status = gm_stage_sweep(&r->file, &a->sweep, a->map, &r->sweep, error);
    if (status == GM_OK)
        status = bake_and_verify(a, r, name, error);
    r->elapsed = gm_stage_clock() - r->start;
    return status == GM_OK ? gm_command_print(&form, a->json, r, error) : status;
}

static int run(const void *given)
{
    const arguments *a = given;
    gm_error error = {0};
    reduction r;
    if (!gm_stage_knows_interpolation(a->bake.interpolation))
        return GM_EXIT_USAGE;
    memset(&r, 0, sizeof r);
    r.output = a->output;
    r.start = gm_stage_clock();
    gm_status status = reduce(a, &r, &error);
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
        "the detailed model at random points. A failed stage leaves no output; "
        "finished files stay when the result cannot be printed.",
    .options = options,
    .n_options = sizeof options / sizeof options[0],
    .size = sizeof(arguments),
    .run = run,
};
