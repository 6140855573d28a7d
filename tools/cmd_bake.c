/* SPDX-License-Identifier: BSD-2-Clause
 *
 * gearmap bake: map -> component.
 */
#include "commands.h"

#include "files.h"
#include "map/gm_map_file.h"
#include "stages.h"

#include <string.h>

typedef struct arguments {
    const char *map, *output, *format, *compiler;
    int json;
} arguments;

// clang-format off
static const gm_option options[] = {
    {.kind = GM_OPTION_OPERAND, .name = "MAP", .required = 1,
     .offset = offsetof(arguments, map),
     .help = "the map to bake"},
    {.kind = GM_OPTION_TEXT, .name = "output", .letter = 'o', .value = "FMU",
     .required = 1, .offset = offsetof(arguments, output),
     .help = "the file to write"},
    {.kind = GM_OPTION_TEXT, .name = "format", .value = "NAME", .fallback = "fmu2",
     .offset = offsetof(arguments, format),
     .help = "fmu2: FMI 2.0 Co-Simulation"},
    {.kind = GM_OPTION_TEXT, .name = "compiler", .value = "COMMAND",
     .offset = offsetof(arguments, compiler),
     .help = "C compiler; default: $CC, else cc, gcc or clang"},
    {.kind = GM_OPTION_FLAG, .name = "json", .offset = offsetof(arguments, json),
     .help = "print the result as JSON"},
};
// clang-format on

static void print_result(const arguments *a, const gm_bake_stage *stage)
{
    if (!a->json) {
        gm_bake_stage_print(stage, a->output, stdout);
        return;
    }
    gm_json json;
    gm_json_start(&json, stdout);
    gm_bake_stage_json(stage, a->output, &json);
    gm_json_finish(&json);
}

static gm_status bake(const arguments *a, gm_error *error)
{
    gm_map *map = NULL;
    gm_bake_stage stage;
    gm_status status = gm_file_check_output(a->output, a->map, error);
    if (status == GM_OK)
        status = gm_map_read(a->map, &map, error);
    if (status == GM_OK)
        status = gm_stage_bake(map, a->compiler, a->output, &stage, error);
    if (status == GM_OK)
        print_result(a, &stage);
    gm_map_destroy(map);
    return status;
}

static int run(const void *given)
{
    const arguments *a = given;
    gm_error error = {0};
    if (strcmp(a->format, "fmu2") != 0) {
        fprintf(stderr, "gearmap: bake knows no format '%s' (only fmu2)\n", a->format);
        return GM_EXIT_USAGE;
    }
    return gm_command_end(bake(a, &error), &error);
}

const gm_command gm_command_bake = {
    .name = "bake",
    .summary = "make the reduced component from a map",
    .details = "The same map, options and compiler give the same bytes.",
    .options = options,
    .n_options = sizeof options / sizeof options[0],
    .size = sizeof(arguments),
    .run = run,
};
