/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The command line. Each command has one table of options; reading the arguments and
 * printing the help both come from it, so that they cannot disagree. Quantities are read
 * in the unit that the table names (or in another unit of the same kind when it is
 * spelled out) and stored in SI.
 */
#ifndef OPTIONS_H
#define OPTIONS_H

#include "base/gm_status.h"

#include <stddef.h>
#include <stdio.h>

#define GM_OPTION_UNSET (-2147483647 - 1) /* an integer option that was not given */

typedef enum gm_option_kind {
    GM_OPTION_FLAG,     /* int: 1 when given */
    GM_OPTION_TEXT,     /* const char *: points into argv; NULL when not given */
    GM_OPTION_INTEGER,  /* int */
    GM_OPTION_QUANTITY, /* double, SI; NAN when not given */
    GM_OPTION_LIST,     /* gm_option_list; n 0 when not given */
    GM_OPTION_ERROR,    /* gm_option_error; both zero when not given */
    GM_OPTION_OPERAND   /* const char *: an argument without a name, in table order */
} gm_option_kind;

/** An error that is allowed, such as "0.5%", "0.1Nm" or "0.5%,0.1Nm". */
typedef struct gm_option_error {
    double share;  /* 0.5% is 0.005 */
    double torque; /* N.m */
} gm_option_error;

#define GM_OPTION_MOST 16

/** Quantities in ascending order, with commas between them; SI. */
typedef struct gm_option_list {
    int n;
    double value[GM_OPTION_MOST];
} gm_option_list;

typedef struct gm_option {
    gm_option_kind kind;
    const char *name; /* long name without dashes; of an operand what the help calls it */
    char letter;      /* short name, 0: none */
    const char *value; /* what the help calls the value, NULL for flags and operands */
    const char *unit;  /* of a quantity: a name from the table in options.c, else NULL */
    double low, high;  /* allowed range, in that unit */
    int required;
    const char *fallback; /* value when not given, as it would be written; or NULL */
    size_t offset;        /* of the field in the command's arguments */
    const char *help;     /* NULL: not listed, as the one before it says it all */
} gm_option;

typedef struct gm_command {
    const char *name;
    const char *summary; /* half a line */
    const char *details; /* a paragraph or NULL */
    const gm_option *options;
    int n_options;
    size_t size;                       /* of its arguments, at most GM_ARGUMENTS_SIZE */
    int (*run)(const void *arguments); /* returns the exit code */
} gm_command;

#define GM_ARGUMENTS_SIZE 512

typedef enum gm_parse_outcome {
    GM_PARSE_RUN,
    GM_PARSE_HELP,
    GM_PARSE_WRONG
} gm_parse_outcome;

/* Entries that the tables of several commands share. T: the type of the command's
 * arguments, which has the field that is named. */
// clang-format off
#define GM_DESCRIPTION_OPERAND(T)                                                        \
    {.kind = GM_OPTION_OPERAND, .name = "FILE", .required = 1,                           \
     .offset = offsetof(T, description), .help = "the description of the gearset"}
#define GM_OIL_OPTION(OFFSET, HELP)                                                      \
    {.kind = GM_OPTION_QUANTITY, .name = "oil-temperature", .value = "TEMPERATURE",      \
     .unit = "degC", .low = -50, .high = 200, .offset = OFFSET, .help = HELP}
#define GM_OIL_LIST_OPTION(OFFSET, HELP)                                                 \
    {.kind = GM_OPTION_LIST, .name = "oil-temperature", .value = "TEMPERATURE,...",      \
     .unit = "degC", .low = -50, .high = 200, .offset = OFFSET, .help = HELP}
#define GM_COMPILER_OPTION(place)                                                        \
    {.kind = GM_OPTION_TEXT, .name = "compiler", .value = "COMMAND",                     \
     .offset = (place),                                                                  \
     .help = "C compiler, with arguments after spaces: 'gcc -m64'; default: $CC, else "  \
             "cc, gcc or clang"}
#define GM_POINTS_OPTION(T)                                                              \
    {.kind = GM_OPTION_INTEGER, .name = "points", .value = "N", .low = 1, .high = 1e7,   \
     .fallback = "2000", .offset = offsetof(T, points),                                  \
     .help = "number of points of each kind to compare at"}
#define GM_SEED_OPTION(T)                                                                \
    {.kind = GM_OPTION_INTEGER, .name = "seed", .value = "N", .low = 0,                  \
     .high = 2147483647.0, .fallback = "1", .offset = offsetof(T, seed),                 \
     .help = "start of the random numbers"}
#define GM_JSON_OPTION(T)                                                                \
    {.kind = GM_OPTION_FLAG, .name = "json", .offset = offsetof(T, json),                \
     .help = "print the result as JSON"}
// clang-format on

/** Read argv[argc] (without program and command name) into *arguments, of
 *  command->size bytes. GM_PARSE_WRONG leaves the sentence in *error. */
gm_parse_outcome gm_options_parse(const gm_command *command, int argc, char **argv,
                                  void *arguments, gm_error *error);

/** Print the command's help. */
void gm_options_help(const gm_command *command, FILE *out);

/** Print text wrapped to 80 columns, every line after the first indented; column is where
 *  the first line starts. */
void gm_print_wrapped(FILE *out, const char *text, int indent, int column);

#endif
