/* SPDX-License-Identifier: BSD-2-Clause
 *
 * gearmap batch: many reductions.
 */
#include "commands.h"

#include "batch.h"
#include "progress.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct arguments {
    const char *source, *folder, *progress;
    gm_sweep_settings sweep;
    gm_bake_settings bake;
    int points, seed, json;
} arguments;

// clang-format off
static const gm_option options[] = {
    {.kind = GM_OPTION_OPERAND, .name = "FOLDER|LIST", .required = 1,
     .offset = offsetof(arguments, source),
     .help = "a folder with descriptions, or a text file that names one in each line"},
    {.kind = GM_OPTION_TEXT, .name = "output", .letter = 'o', .value = "FOLDER",
     .required = 1, .offset = offsetof(arguments, folder),
     .help = "where components, maps and the table batch.csv go; it is made if need be"},
    GM_SWEEP_OPTIONS(arguments),
    GM_BAKE_OPTIONS(arguments),
    GM_POINTS_OPTION(arguments),
    GM_SEED_OPTION(arguments),
    GM_PROGRESS_OPTION(arguments),
    GM_JSON_OPTION(arguments),
};
// clang-format on

/* ---- the result ---- */

static int count(const gm_batch *batch, gm_variant_state state)
{
    int n = 0;
    for (int i = 0; i < batch->n; i++)
        n += batch->variants[i].state == state;
    return n;
}

static int count_skipped(const gm_batch *batch)
{
    int n = 0;
    for (int i = 0; i < batch->n; i++)
        n += batch->variants[i].outcome.skipped;
    return n;
}

static int name_width(const gm_batch *batch)
{
    int width = 7;
    for (int i = 0; i < batch->n; i++) {
        int n = (int)strlen(batch->variants[i].name);
        width = n > width ? n : width;
    }
    return width < 40 ? width : 40;
}

static void print_variant(const gm_batch *batch, const gm_variant *v, int width,
                          FILE *out)
{
    const gm_variant_outcome *o = &v->outcome;
    fprintf(out, "%-*s  %-6s", width, v->name, gm_variant_state_name(v->state));
    if (v->state == GM_VARIANT_FAILED) {
        fprintf(out, "  %s\n", o->message);
        return;
    }
    fprintf(out, "  %8ld  %7.2f s  %7.3f %%  %7.3f %%  %s/%s.fmu", o->points, o->elapsed,
            100.0 * o->max_error, 100.0 * o->rms_error, batch->folder, v->name);
    if (o->missed > 0)
        fprintf(out, " (%d tables miss the tolerance)", o->missed);
    if (o->skipped > 0)
        fprintf(out, " (its model failed at %d points)", o->skipped);
    fputc('\n', out);
}

static void print_text(const void *result, FILE *out)
{
    const gm_batch *batch = result;
    int width = name_width(batch);
    fprintf(out, "%-*s  %-6s  %8s  %9s  %9s  %9s  %s\n", width, "variant", "state",
            "points", "time", "max", "RMS", "component");
    for (int i = 0; i < batch->n; i++)
        print_variant(batch, &batch->variants[i], width, out);
    for (int i = 0; i < batch->n_passed_over; i++)
        fprintf(out, "passed over: %s has no shafts\n", batch->passed_over[i]);
    fprintf(out, "\n%d done, %d kept, %d failed in %.2f s on %d cores; %s/batch.csv\n",
            count(batch, GM_VARIANT_DONE), count(batch, GM_VARIANT_KEPT),
            count(batch, GM_VARIANT_FAILED), batch->elapsed, batch->cores, batch->folder);
}

static void variant_json(const gm_batch *batch, const gm_variant *v, gm_json *json)
{
    const gm_variant_outcome *o = &v->outcome;
    char path[GM_PATH_SIZE];
    bool good = v->state != GM_VARIANT_FAILED;
    gm_json_object(json, NULL);
    gm_json_text(json, "name", v->name);
    gm_json_text(json, "description", v->description);
    gm_json_text(json, "state", gm_variant_state_name(v->state));
    gm_json_text(json, "message", good ? NULL : o->message);
    if (good) {
        gm_json_integer(json, "points", o->points);
        gm_json_number(json, "elapsed_s", o->elapsed);
        gm_json_number(json, "max_relative", o->max_error);
        gm_json_number(json, "rms_relative", o->rms_error);
        gm_json_integer(json, "missed_tables", o->missed);
        gm_json_integer(json, "skipped_points", o->skipped);
        (void)snprintf(path, sizeof path, "%s/%s.fmu", batch->folder, v->name);
        gm_json_text(json, "fmu", path);
        (void)snprintf(path, sizeof path, "%s/%s.map", batch->folder, v->name);
        gm_json_text(json, "map", path);
    }
    gm_json_end(json);
}

static void print_json(const void *result, gm_json *json)
{
    const gm_batch *batch = result;
    gm_json_array(json, "variants");
    for (int i = 0; i < batch->n; i++)
        variant_json(batch, &batch->variants[i], json);
    gm_json_end(json);
    gm_json_array(json, "passed_over");
    for (int i = 0; i < batch->n_passed_over; i++)
        gm_json_text(json, NULL, batch->passed_over[i]);
    gm_json_end(json);
    gm_json_integer(json, "done", count(batch, GM_VARIANT_DONE));
    gm_json_integer(json, "kept", count(batch, GM_VARIANT_KEPT));
    gm_json_integer(json, "failed", count(batch, GM_VARIANT_FAILED));
    gm_json_integer(json, "cores", batch->cores);
    gm_json_number(json, "elapsed_s", batch->elapsed);
}

static const gm_result_form form = {print_text, print_json};

/* ---- the work ---- */

static gm_status make_folder(const gm_batch *batch, const char *source, gm_error *error)
{
    char table[GM_PATH_SIZE];
    if (mkdir(batch->folder, 0777) != 0 && errno != EEXIST)
        return gm_fail(error, GM_ERR_IO, "%s: the folder cannot be made: %s",
                       batch->folder, strerror(errno));
    if (snprintf(table, sizeof table, "%s/batch.csv", batch->folder) >= (int)sizeof table)
        return gm_fail(error, GM_ERR_IO, "%.60s...: the path is too long", batch->folder);
    return gm_file_check_output(table, source, error);
}

static int cores_of(const arguments *a)
{
    long n = sysconf(_SC_NPROCESSORS_ONLN);
    if (a->sweep.threads != GM_OPTION_UNSET)
        n = a->sweep.threads;
    return n > 1024 ? 1024 : n < 1 ? 1 : (int)n;
}

static gm_status reduce_all(const arguments *a, gm_batch *batch, gm_error *error)
{
    const gm_reduce_settings common = {
        .sweep = a->sweep, .bake = a->bake, .points = a->points, .seed = a->seed};
    char share[GM_PATH_SIZE];
    gm_status status = gm_batch_find(a->source, batch, error);
    if (status == GM_OK)
        status = gm_file_find_share(share, error);
    if (status == GM_OK)
        status = make_folder(batch, a->source, error);
    if (status == GM_OK)
        status = gm_batch_resume(batch, &common, error);
    if (status == GM_OK)
        status = gm_batch_run(batch, &common, error);
    if (status == GM_OK)
        status = gm_batch_write_table(batch, error);
    if (status == GM_OK)
        status = gm_command_print(&form, a->json, batch, error);
    int failed = count(batch, GM_VARIANT_FAILED);
    if (status == GM_OK && failed > 0)
        status =
            gm_fail(error, GM_ERR_TOOL, "%d of %d variants failed", failed, batch->n);
    return status;
}

static int run(const void *given)
{
    const arguments *a = given;
    gm_error error = {0};
    gm_batch batch = {.folder = a->folder};
    if (!gm_stage_knows_interpolation(a->bake.interpolation) ||
        !gm_progress_choose(a->progress))
        return GM_EXIT_USAGE;
    batch.cores = cores_of(a);
    gm_status status = reduce_all(a, &batch, &error);
    int skipped = count_skipped(&batch), code;
    gm_batch_clear(&batch);
    code = gm_command_end(status, &error);
    return code == GM_EXIT_DONE && skipped > 0 ? GM_EXIT_SKIPPED : code;
}

const gm_command gm_command_batch = {
    .name = "batch",
    .summary = "reduce a list or folder of descriptions, on all cores",
    .details =
        "Each variant is reduced in a process of its own, one on every core. A variant "
        "that fails does not stop the others; then the exit code is 1. It is 3 when all "
        "are done but a foreign model failed at some points. Finished variants "
        "whose description and options (and this program) have not changed are not done "
        "again, interrupted ones resume. Names are those of the files, with folders "
        "before them where two would be the same.",
    .options = options,
    .n_options = sizeof options / sizeof options[0],
    .size = sizeof(arguments),
    .run = run,
};
