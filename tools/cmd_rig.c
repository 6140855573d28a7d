/* SPDX-License-Identifier: BSD-2-Clause
 *
 * gearmap rig: an FMU of somebody else -> a first rig file.
 */
#include "commands.h"

#include "files.h"
#include "plant/gm_rig_guess.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

typedef struct arguments {
    const char *fmu, *output;
    double speed_max, torque_max;
    int json;
} arguments;

// clang-format off
static const gm_option options[] = {
    {.kind = GM_OPTION_OPERAND, .name = "FILE.fmu", .required = 1,
     .offset = offsetof(arguments, fmu), .help = "the model, FMI 2.0 or 3.0"},
    {.kind = GM_OPTION_TEXT, .name = "output", .letter = 'o', .value = "RIG.yaml",
     .offset = offsetof(arguments, output),
     .help = "the rig file to write; default: the standard output"},
    {.kind = GM_OPTION_QUANTITY, .name = "speed-max", .value = "SPEED", .unit = "rpm",
     .low = 10, .high = 1e5, .offset = offsetof(arguments, speed_max),
     .help = "largest speed at the input; default: what the FMU says"},
    {.kind = GM_OPTION_QUANTITY, .name = "torque-max", .value = "TORQUE", .unit = "Nm",
     .low = 0.1, .high = 1e5, .offset = offsetof(arguments, torque_max),
     .help = "largest torque at the input; default: what the FMU says"},
    GM_JSON_OPTION(arguments),
};
// clang-format on

static void put(void *out, const char *text)
{
    (void)fputs(text, out);
}

/* The rig file names the FMU from its own folder; from another one in full. */
static gm_status model_name(const arguments *a, char name[GM_PATH_SIZE], gm_error *error)
{
    const char *end = a->output ? strrchr(a->output, '/') : NULL;
    const char *slash = strrchr(a->fmu, '/');
    size_t folder = slash ? (size_t)(slash - a->fmu) + 1 : 0;
    size_t length = end ? (size_t)(end - a->output) + 1 : 0;
    char here[GM_PATH_SIZE] = "";
    if (folder == length && (length == 0 || !memcmp(a->fmu, a->output, length))) {
        (void)snprintf(name, GM_PATH_SIZE, "%s", a->fmu + folder);
        return GM_OK;
    }
    if (a->fmu[0] != '/' && !getcwd(here, sizeof here))
        return gm_fail(error, GM_ERR_IO, "%s: cannot be found: %s", a->fmu,
                       strerror(errno));
    int n = snprintf(name, GM_PATH_SIZE, "%s%s%s", here, here[0] ? "/" : "", a->fmu);
    return n < GM_PATH_SIZE
               ? GM_OK
               : gm_fail(error, GM_ERR_IO, "%s: the path is too long", a->fmu);
}

static gm_status write_rig(const arguments *a, const gm_rig_hints *hints,
                           gm_rig_guess_summary *summary, gm_error *error)
{
    if (!a->output)
        return gm_rig_guess(a->fmu, hints, put, stdout, summary, error);
    char name[GM_PATH_SIZE];
    gm_status status = gm_file_own_name(a->output, name, error);
    FILE *file = status == GM_OK ? fopen(name, "wb") : NULL;
    if (!file)
        return status != GM_OK ? status
                               : gm_fail(error, GM_ERR_IO, "%s: cannot be written: %s",
                                         a->output, strerror(errno));
    status = gm_rig_guess(a->fmu, hints, put, file, summary, error);
    int bad = ferror(file);
    bad |= fclose(file) != 0;
    if (status == GM_OK && (bad || rename(name, a->output) != 0))
        status = gm_fail(error, GM_ERR_IO, "%s: cannot be written", a->output);
    if (status != GM_OK)
        (void)remove(name);
    return status;
}

typedef struct outcome {
    const char *output;
    gm_rig_guess_summary summary;
} outcome;

static void print_text(const void *result, FILE *out)
{
    const outcome *o = result;
    fprintf(out, "rig         %s, %d guessed", o->output, o->summary.guessed);
    if (o->summary.missing)
        fprintf(out, ", %d to be filled in (TODO) before it can be used",
                o->summary.missing);
    fputc('\n', out);
}

static void print_json(const void *result, gm_json *json)
{
    const outcome *o = result;
    gm_json_text(json, "rig", o->output);
    gm_json_integer(json, "guessed", o->summary.guessed);
    gm_json_integer(json, "missing", o->summary.missing);
}

static const gm_result_form form = {print_text, print_json};

static gm_status rig(const arguments *a, gm_error *error)
{
    char model[GM_PATH_SIZE];
    gm_rig_hints hints = {a->speed_max, a->torque_max, model};
    outcome o = {.output = a->output};
    gm_status status = a->output ? gm_file_check_output(a->output, a->fmu, error) : GM_OK;
    if (status == GM_OK)
        status = model_name(a, model, error);
    if (status == GM_OK)
        status = write_rig(a, &hints, &o.summary, error);
    return status == GM_OK && a->output ? gm_command_print(&form, a->json, &o, error)
                                        : status;
}

static int run(const void *given)
{
    const arguments *a = given;
    gm_error error = {0};
    if (a->json && !a->output) {
        fputs("gearmap: --json needs --output: the rig file itself is no JSON\n", stderr);
        return GM_EXIT_USAGE;
    }
    return gm_command_end(rig(a, &error), &error);
}

const gm_command gm_command_rig = {
    .name = "rig",
    .summary = "write a first rig file for an FMU of somebody else",
    .details =
        "Looks at the names, units, causalities and ranges in the FMU; nothing of it "
        "runs. The file has a comment wherever something was guessed, and TODO where "
        "something could not be found: gearmap sweep and the others say which field "
        "is to be filled in. All fields: gearmap help rig-file.",
    .options = options,
    .n_options = sizeof options / sizeof options[0],
    .size = sizeof(arguments),
    .run = run,
};
