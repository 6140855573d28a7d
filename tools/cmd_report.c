/* SPDX-License-Identifier: BSD-2-Clause
 *
 * gearmap report: starts the page maker, a Python program among the command's share files
 * (tools/report), in place of this process. It calls back this very command (GEARMAP)
 * where it needs numbers of the detailed gearset.
 */
#include "commands.h"

#include "files.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_RESULTS = 6 };

typedef struct arguments {
    const char *map;
    const char *result[MAX_RESULTS];
    const char *output;
} arguments;

// clang-format off
#define FURTHER_RESULT(i)                                                                \
    {.kind = GM_OPTION_OPERAND, .name = "RESULT",                                        \
     .offset = offsetof(arguments, result[i])}

static const gm_option options[] = {
    {.kind = GM_OPTION_OPERAND, .name = "MAP", .required = 1,
     .offset = offsetof(arguments, map), .help = "the map to explain"},
    {.kind = GM_OPTION_OPERAND, .name = "RESULT...",
     .offset = offsetof(arguments, result[0]),
     .help = "what was measured of the component, up to six files: results of verify "
             "--json (.json), a drive of verify --trace (.csv), the component (.fmu)"},
    FURTHER_RESULT(1), FURTHER_RESULT(2), FURTHER_RESULT(3), FURTHER_RESULT(4),
    FURTHER_RESULT(5),
    {.kind = GM_OPTION_TEXT, .name = "output", .letter = 'o', .value = "HTML",
     .required = 1, .offset = offsetof(arguments, output),
     .help = "the page to write"},
};
// clang-format on

/* $GEARMAP_PYTHON, the Python of the build while it is there, or the one in the path. */
static const char *find_python(void)
{
    const char *given = getenv("GEARMAP_PYTHON");
    if (given && *given != '\0')
        return given;
    return access(GM_PYTHON, X_OK) == 0 ? GM_PYTHON : "python3";
}

static gm_status tell_program(gm_error *error)
{
    char program[GM_PATH_SIZE];
    ssize_t n = readlink("/proc/self/exe", program, sizeof program - 1);
    if (n <= 0)
        return gm_fail(error, GM_ERR_IO, "the command's own file is not to be found: %s",
                       strerror(errno));
    program[n] = '\0';
    return setenv("GEARMAP", program, 1) == 0
               ? GM_OK
               : gm_fail(error, GM_ERR_MEMORY, "out of memory");
}

/* Returns only when it fails. */
static gm_status start(const arguments *a, const char *share, gm_error *error)
{
    char page_maker[GM_PATH_SIZE + 16];
    const char *argv[MAX_RESULTS + 6];
    int n = 0;
    (void)snprintf(page_maker, sizeof page_maker, "%s/report", share);
    argv[n++] = find_python();
    argv[n++] = page_maker;
    argv[n++] = a->output;
    argv[n++] = a->map;
    for (int i = 0; i < MAX_RESULTS && a->result[i]; i++)
        argv[n++] = a->result[i];
    argv[n] = NULL;
    (void)execvp(argv[0], (char *const *)argv);
    return gm_fail(error, GM_ERR_TOOL,
                   "%s: cannot be started: %s; the report needs Python 3 with pandas and "
                   "plotly (GEARMAP_PYTHON can name it)",
                   argv[0], strerror(errno));
}

static gm_status report(const arguments *a, gm_error *error)
{
    char share[GM_PATH_SIZE];
    gm_status status = gm_file_check_output(a->output, a->map, error);
    for (int i = 0; i < MAX_RESULTS && a->result[i] && status == GM_OK; i++)
        status = gm_file_check_output(a->output, a->result[i], error);
    if (status == GM_OK)
        status = gm_file_find_share(share, error);
    if (status == GM_OK)
        status = tell_program(error);
    return status == GM_OK ? start(a, share, error) : status;
}

static int run(const void *given)
{
    gm_error error = {0};
    return gm_command_end(report(given, &error), &error);
}

const gm_command gm_command_report = {
    .name = "report",
    .summary = "explain a map and how good it is on one HTML page",
    .details =
        "The page needs nothing but a browser. Without results it shows the gearset and "
        "its losses; with those of verify also how much faster the component is and how "
        "far it is from the detailed gearset. Needs Python 3 with pandas and plotly: "
        "$GEARMAP_PYTHON, else the one of the build, else python3.",
    .options = options,
    .n_options = sizeof options / sizeof options[0],
    .size = sizeof(arguments),
    .run = run,
};
