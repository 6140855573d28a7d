/* SPDX-License-Identifier: BSD-2-Clause
 *
 * gearmap reduce: sweep, bake and verify in one go. The component gets its name only when
 * all three are done: until then it stands beside under a name of this process.
 */
#include "commands.h"

#include "base/alloc.h"
#include "files.h"
#include "verified.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

typedef struct arguments {
    const char *description, *output, *map;
    gm_sweep_settings sweep;
    gm_bake_settings bake;
    int points, seed, json;
    const char *cycle, *vehicle, *trace;
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
    GM_JSON_OPTION(arguments),
};
// clang-format on

typedef struct reduction {
    const char *output;
    gm_gearset_file file;
    gm_sweep_stage sweep;
    gm_bake_stage bake;
    gm_verify_stage verify;
    int drives; /* over a cycle, too */
    gm_cycle_stage cycle;
    double start, elapsed, driving; /* s; driving: in the cycle alone */
} reduction;

static void print_text(const void *result, FILE *out)
{
    const reduction *r = result;
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
    if (r->drives) {
        gm_json_object(json, "cycle");
        gm_cycle_stage_json(&r->cycle, json);
        gm_json_end(json);
    }
    gm_json_number(json, "elapsed_s", r->elapsed);
}

static const gm_result_form form = {print_text, print_json};

static gm_cycle_settings drive_of(const arguments *a)
{
    return (gm_cycle_settings){.cycle = a->cycle,
                               .vehicle = a->vehicle,
                               .fidelity = GM_CYCLE_BOTH,
                               .tolerance = GM_CYCLE_TOLERANCE,
                               .communication_step = (double)NAN};
}

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
    if (status == GM_OK && a->trace)
        status = gm_file_check_output(a->trace, a->description, error);
    if (status == GM_OK && a->cycle) {
        const gm_cycle_settings drive = drive_of(a);
        status = gm_stage_cycle_check(&drive, error);
    }
    return status == GM_OK ? gm_file_find_share(share, error) : status;
}

/* What was measured, into the component's passport and the map. */
static gm_status keep(const arguments *a, reduction *r, const gm_measured *measured,
                      const char *name, gm_error *error)
{
    const gm_verified verified = {.measured = *measured,
                                  .steady = &r->verify,
                                  .cycle = r->drives ? &r->cycle : NULL};
    char *text = NULL;
    gm_status status = gm_verified_text(&verified, &text, error);
    if (status != GM_OK)
        return status;
    const gm_bake_result result = {"the verification", text};
    status = gm_bake_document(name, r->sweep.map, &r->bake.summary, 1, &result, error);
    if (status == GM_OK && a->map)
        status = gm_stage_keep(&r->verify, r->sweep.map, text, a->map, error);
    gm_free(text);
    if (status == GM_OK) /* the errors are in the archive now */
        r->bake.summary.file_size = gm_file_size(name);
    return status;
}

static gm_status verify(const arguments *a, reduction *r, const char *name,
                        gm_error *error)
{
    gm_fmu *fmu = NULL;
    gm_measured measured;
    gm_status status = gm_fmu_open(name, &fmu, error);
    if (status == GM_OK)
        status = gm_measured_read(fmu, &r->file, &measured, error);
    if (status == GM_OK)
        status =
            gm_stage_verify(r->file.plant, fmu, a->points, a->seed, &r->verify, error);
    gm_fmu_close(fmu);
    if (status == GM_OK && a->cycle) {
        const gm_cycle_settings drive = drive_of(a);
        const double start = gm_stage_clock();
        status = gm_stage_cycle(&r->file, name, &drive, &r->cycle, error);
        r->drives = status == GM_OK;
        r->driving = gm_stage_clock() - start;
    }
    if (status == GM_OK && a->trace)
        status = gm_cycle_stage_trace(&r->cycle, a->trace, error);
    return status == GM_OK ? keep(a, r, &measured, name, error) : status;
}

/* `name` is this process's own file; the last of several reductions wins. */
static gm_status bake_and_verify(const arguments *a, reduction *r, const char *name,
                                 gm_error *error)
{
    const gm_results none = {0, NULL};
    gm_status status =
        gm_stage_bake(r->sweep.map, &none, &a->bake, name, &r->bake, error);
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
    gm_sweep_settings settings = a->sweep;
    settings.monotone = gm_stage_is_monotone(a->bake.interpolation);
    gm_status status = check_before(a, error);
    if (status == GM_OK)
        status = gm_file_own_name(a->output, name, error);
    if (status == GM_OK)
        status = gm_gearset_file_open_any(a->description, a->sweep.oil_temperature,
                                          &r->file, error);
    if (status == GM_OK)
        status = gm_stage_sweep(&r->file, &settings, a->map, &r->sweep, error);
    if (status == GM_OK)
        status = bake_and_verify(a, r, name, error);
    r->elapsed = gm_stage_clock() - r->start;
    if (status == GM_OK)
        gm_stage_warn(&r->sweep, &r->verify);
    return status == GM_OK ? gm_command_print(&form, a->json, r, error) : status;
}

static int run(const void *given)
{
    const arguments *a = given;
    gm_error error = {0};
    reduction r;
    if (!gm_stage_knows_interpolation(a->bake.interpolation))
        return GM_EXIT_USAGE;
    if ((a->vehicle || a->trace) && !a->cycle) {
        fprintf(stderr, "gearmap: --%s needs --cycle\n",
                a->vehicle ? "vehicle" : "trace");
        return GM_EXIT_USAGE;
    }
    memset(&r, 0, sizeof r);
    r.output = a->output;
    r.start = gm_stage_clock();
    gm_status status = reduce(a, &r, &error);
    gm_stage_cycle_clear(&r.cycle);
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
        "the detailed model at random points, and puts the errors into the component's "
        "accuracy passport. A failed stage leaves no output; "
        "finished files stay when the result cannot be printed.",
    .options = options,
    .n_options = sizeof options / sizeof options[0],
    .size = sizeof(arguments),
    .run = run,
};
