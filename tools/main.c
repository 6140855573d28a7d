/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The `gearmap` command: finds the command, reads its arguments, runs it.
 */
#include "commands.h"

#include "base/text.h"
#include "model/gm_description.h"
#include "plant/gm_rig_file.h"
#include "vehicle/gm_vehicle.h"

#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define UNWRITABLE "the standard output could not be written"

static const gm_command *const commands[] = {
    &gm_command_check,  &gm_command_sweep,  &gm_command_bake,
    &gm_command_reduce, &gm_command_verify, &gm_command_simulate,
    &gm_command_report, &gm_command_batch,  &gm_command_rig,
};
enum { N_COMMANDS = sizeof commands / sizeof commands[0] };

static void print_overview(FILE *out)
{
    fputs("gearmap " GM_VERSION
          ": a detailed gearset model in, a small and fast component "
          "out\n\nusage: gearmap COMMAND ...\n\n",
          out);
    for (int i = 0; i < N_COMMANDS; i++)
        fprintf(out, "  %-10s%s\n", commands[i]->name, commands[i]->summary);
    fputs(
        "  help      print the help of a command (gearmap help COMMAND)\n"
        "            or a file: of descriptions (gearmap help format), of vehicles\n"
        "            (gearmap help vehicle), of rigs for foreign models (gearmap help "
        "rig-file)\n\n"
        "Results go to the standard output (--json for machines), words to the standard "
        "error.\nExit code: 0 done, 1 failed, 2 wrong usage, 3 done but a foreign\nmodel "
        "failed at some points.\n",
        out);
}

static int usage_error(const char *sentence)
{
    fprintf(stderr, "gearmap: %s\n", sentence);
    return GM_EXIT_USAGE;
}

int gm_command_end(gm_status status, const gm_error *error)
{
    if (status == GM_OK)
        return GM_EXIT_DONE;
    const char *sentence = error->message[0] ? error->message : gm_status_text(status);
    fprintf(stderr, "gearmap: %s\n", sentence);
    return GM_EXIT_FAILED;
}

gm_status gm_command_print(const gm_result_form *form, int as_json, const void *result,
                           gm_error *error)
{
    if (as_json) {
        gm_json json;
        gm_json_start(&json, stdout);
        form->json(result, &json);
        gm_json_finish(&json);
    } else {
        form->print(result, stdout);
    }
    if (fflush(stdout) == 0 && !ferror(stdout))
        return GM_OK;
    return gm_fail(error, GM_ERR_IO, UNWRITABLE);
}

static const gm_command *find_command(const char *name)
{
    for (int i = 0; i < N_COMMANDS; i++)
        if (strcmp(commands[i]->name, name) == 0)
            return commands[i];
    const char *names[N_COMMANDS];
    for (int i = 0; i < N_COMMANDS; i++)
        names[i] = commands[i]->name;
    int near = gm_text_nearest(name, names, N_COMMANDS);
    fprintf(stderr, "gearmap: there is no command '%s'", name);
    if (near >= 0)
        fprintf(stderr, ", did you mean %s?\n", names[near]);
    else
        fputs(" (see gearmap --help)\n", stderr);
    return NULL;
}

static int run_command(const char *name, int argc, char **argv)
{
    union {
        char bytes[GM_ARGUMENTS_SIZE];
        double number;
        void *pointer;
    } arguments;
    gm_error error = {0};
    const gm_command *command = find_command(name);
    if (!command)
        return GM_EXIT_USAGE;
    switch (gm_options_parse(command, argc, argv, &arguments, &error)) {
    case GM_PARSE_HELP:
        gm_options_help(command, stdout);
        return GM_EXIT_DONE;
    case GM_PARSE_WRONG:
        return usage_error(error.message);
    case GM_PARSE_RUN:
        break;
    }
    return command->run(&arguments);
}

static void write_text(void *out, const char *text)
{
    fputs(text, out);
}

static int help(int argc, char **argv)
{
    if (argc == 0) {
        print_overview(stdout);
        return GM_EXIT_DONE;
    }
    if (argc > 1) {
        fprintf(stderr, "gearmap: help has no use for the argument '%s'\n", argv[1]);
        return GM_EXIT_USAGE;
    }
    if (strcmp(argv[0], "format") == 0) {
        gm_description_help(write_text, stdout);
        return GM_EXIT_DONE;
    }
    if (strcmp(argv[0], "vehicle") == 0) {
        gm_vehicle_help(write_text, stdout);
        return GM_EXIT_DONE;
    }
    if (strcmp(argv[0], "rig-file") == 0) {
        gm_rig_file_help(write_text, stdout);
        return GM_EXIT_DONE;
    }
    const gm_command *command = find_command(argv[0]);
    if (!command)
        return GM_EXIT_USAGE;
    gm_options_help(command, stdout);
    return GM_EXIT_DONE;
}

static int dispatch(int argc, char **argv)
{
    if (argc < 2) {
        print_overview(stderr);
        return GM_EXIT_USAGE;
    }
    const char *word = argv[1];
    if (strcmp(word, "--version") == 0) {
        puts("gearmap " GM_VERSION);
        return GM_EXIT_DONE;
    }
    if (strcmp(word, "help") == 0 || strcmp(word, "--help") == 0 ||
        strcmp(word, "-h") == 0)
        return help(argc - 2, argv + 2);
    if (word[0] == '-')
        return usage_error("the command comes first (see gearmap --help)");
    return run_command(word, argc - 2, argv + 2);
}

/* A file that is opened must never take the place of a closed standard stream. What then
 * stands for the standard output can only be read: writing to it fails, as it should. */
static void fill_standard_streams(void)
{
    for (int stream = 0; stream <= 2; stream++)
        if (fcntl(stream, F_GETFD) < 0 &&
            open("/dev/null", stream == 1 ? O_RDONLY : O_RDWR) < 0)
            return;
}

/* A full disk or a closed pipe behind the standard output is a failure too. */
int main(int argc, char **argv)
{
    fill_standard_streams();
    int code = dispatch(argc, argv);
    if ((fflush(stdout) != 0 || ferror(stdout)) && code == GM_EXIT_DONE) {
        fputs("gearmap: " UNWRITABLE "\n", stderr);
        code = GM_EXIT_FAILED;
    }
    return code;
}
