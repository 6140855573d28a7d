/* SPDX-License-Identifier: BSD-2-Clause
 *
 * gearmap bake: map -> component, or description -> component of the detailed gearset.
 */
#include "commands.h"

#include "bake_c.h"
#include "files.h"
#include "map/gm_map_file.h"
#include "stages.h"

#include <string.h>

typedef struct arguments {
    const char *map, *output, *format, *passport;
    gm_bake_settings bake;
    gm_bake_c_settings c;
    int detailed, json;
} arguments;

// clang-format off
static const gm_option options[] = {
    {.kind = GM_OPTION_OPERAND, .name = "MAP", .required = 1,
     .offset = offsetof(arguments, map),
     .help = "the map to bake; with --detailed the description"},
    {.kind = GM_OPTION_TEXT, .name = "output", .letter = 'o', .value = "FMU",
     .required = 1, .offset = offsetof(arguments, output),
     .help = "the file to write; for plain C the folder"},
    {.kind = GM_OPTION_TEXT, .name = "format", .value = "NAME", .fallback = "fmu2",
     .offset = offsetof(arguments, format),
     .help = "fmu2: FMI 2.0, Model Exchange and Co-Simulation; c: a folder of plain C "
             "for controllers and real-time rigs"},
    {.kind = GM_OPTION_TEXT, .name = "passport", .value = "RESULTS.json[,...]",
     .offset = offsetof(arguments, passport),
     .help = "what gearmap verify --json printed about this component, for its accuracy "
             "passport; default: what the map keeps"},
    {.kind = GM_OPTION_FLAG, .name = "detailed",
     .offset = offsetof(arguments, detailed),
     .help = "the detailed gearset itself as an FMU for Model Exchange, with the "
             "variables of the reduced one and its own behind them; nothing is compiled"},
    {.kind = GM_OPTION_TEXT, .name = "speed-in", .value = "FLANGE[,...]",
     .offset = GM_BAKE_OPTION(arguments, speed_in),
     .help = "flanges (such as output, or odd) where phi, w and a are inputs and tau is "
             "an output, as in Modelica's GeneralAngleToTorqueAdaptor; default: torque "
             "in, speed out at all"},
    GM_BAKE_OPTIONS(arguments),
    GM_BAKE_C_OPTIONS(arguments),
    GM_JSON_OPTION(arguments),
};
// clang-format on

typedef struct baked {
    gm_bake_stage stage;
    const char *output;
} baked;

static void print_text(const void *result, FILE *out)
{
    const baked *b = result;
    gm_bake_stage_print(&b->stage, b->output, out);
}

static void print_json(const void *result, gm_json *json)
{
    const baked *b = result;
    gm_bake_stage_json(&b->stage, b->output, json);
}

static const gm_result_form form = {print_text, print_json};

/* Given results must fit; of those in the map the ones that fit are taken. */
static gm_status get_results(const arguments *a, const gm_map *map, gm_results *results,
                             gm_error *error)
{
    char guid[64];
    if (a->passport)
        return gm_results_read(a->passport, results, error);
    gm_status status = gm_results_of_map(a->map, results, error);
    if (status != GM_OK || results->n == 0)
        return status;
    status = gm_stage_guid(map, &a->bake, guid, error);
    return status == GM_OK ? gm_results_keep_fitting(results, map, guid, error) : status;
}

static gm_status bake(const arguments *a, gm_error *error)
{
    gm_map *map = NULL;
    gm_results results = {0, NULL};
    baked result = {.output = a->output};
    gm_status status = gm_file_check_output(a->output, a->map, error);
    if (status == GM_OK)
        status = gm_map_read(a->map, &map, error);
    if (status == GM_OK)
        status = get_results(a, map, &results, error);
    if (status == GM_OK)
        status = gm_stage_bake(map, &results, &a->bake, a->output, &result.stage, error);
    if (status == GM_OK)
        status = gm_command_print(&form, a->json, &result, error);
    gm_results_clear(&results);
    gm_map_destroy(map);
    return status;
}

static gm_status bake_detailed(const arguments *a, gm_error *error)
{
    char share[GM_PATH_SIZE];
    baked result = {.output = a->output};
    double start = gm_stage_clock();
    gm_status status = gm_file_check_output(a->output, a->map, error);
    if (status == GM_OK)
        status = gm_file_find_share(share, error);
    if (status == GM_OK)
        status = gm_bake_detailed(a->map, share, a->output, &result.stage.summary, error);
    result.stage.elapsed = gm_stage_clock() - start;
    return status == GM_OK ? gm_command_print(&form, a->json, &result, error) : status;
}

static int run(const void *given)
{
    const arguments *a = given;
    gm_error error = {0};
    const int is_c = strcmp(a->format, "c") == 0;
    if (!is_c && strcmp(a->format, "fmu2") != 0) {
        fprintf(stderr, "gearmap: bake knows no format '%s' (only fmu2, c)\n", a->format);
        return GM_EXIT_USAGE;
    }
    if (is_c && a->detailed) {
        fputs("gearmap: --detailed is for FMUs\n", stderr);
        return GM_EXIT_USAGE;
    }
    if ((is_c || a->detailed) && a->bake.speed_in) {
        fputs("gearmap: --speed-in is for FMUs of maps\n", stderr);
        return GM_EXIT_USAGE;
    }
    if ((is_c || a->detailed) && a->passport) {
        fputs("gearmap: --passport is for FMUs of maps\n", stderr);
        return GM_EXIT_USAGE;
    }
    if (!gm_stage_knows_interpolation(a->bake.interpolation) ||
        !gm_bake_c_accepts(&a->c, is_c))
        return GM_EXIT_USAGE;
    if (is_c)
        return gm_command_end(gm_bake_c_run(a->map, a->bake.interpolation, &a->c,
                                            a->output, a->json, &error),
                              &error);
    return gm_command_end(a->detailed ? bake_detailed(a, &error) : bake(a, &error),
                          &error);
}

const gm_command gm_command_bake = {
    .name = "bake",
    .summary = "make the reduced component from a map, or the detailed one",
    .details =
        "The same map, options and compiler give the same bytes. Measured results go "
        "into extra/gearmap/passport.json and the documentation, and change nothing "
        "else; those of another map or component are refused.",
    .options = options,
    .n_options = sizeof options / sizeof options[0],
    .size = sizeof(arguments),
    .run = run,
};
