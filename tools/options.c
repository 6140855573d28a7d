/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Reading a command's arguments by its table. Nothing is guessed: an unknown option, a
 * value missing, doubled or out of its range is refused with one sentence.
 */
#include "options.h"

#include "base/text.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#define RPM 0.10471975511965977 /* 2 pi / 60 rad/s */
#define MAX_OPTIONS 32

/* SI = scale * value + offset. The spellings of one kind stand together. */
typedef struct unit {
    const char *kind, *spelling;
    double scale, offset;
} unit;

static const unit units[] = {
    {"rpm", "rpm", RPM, 0.0},      {"rpm", "1/min", RPM, 0.0},
    {"rpm", "rad/s", 1.0, 0.0},    {"Nm", "Nm", 1.0, 0.0},
    {"Nm", "N.m", 1.0, 0.0},       {"Nm", "N·m", 1.0, 0.0},
    {"degC", "degC", 1.0, 273.15}, {"degC", "°C", 1.0, 273.15},
    {"degC", "K", 1.0, 0.0},       {"s", "s", 1.0, 0.0},
    {"s", "ms", 1e-3, 0.0},        {"s", "us", 1e-6, 0.0},
    {"s", "µs", 1e-6, 0.0},        {"", "", 1.0, 0.0},
};
enum { N_UNITS = sizeof units / sizeof units[0] };

typedef struct parser {
    const gm_command *command;
    char *arguments;
    bool given[MAX_OPTIONS];
    gm_error *error;
} parser;

static gm_status wrong(const parser *p, const char *what, const char *subject)
{
    return gm_fail(p->error, GM_ERR_ARGUMENT, what, p->command->name, subject);
}

/* How the user writes the option. */
static const char *spelled(const gm_option *o, char text[64])
{
    const char *dashes = o->kind == GM_OPTION_OPERAND ? "" : "--";
    (void)snprintf(text, 64, "%s%s", dashes, o->name);
    return text;
}

static gm_status out_of_range(const parser *p, const gm_option *o, const char *text)
{
    const char *name = o->unit ? o->unit : "";
    return gm_fail(p->error, GM_ERR_ARGUMENT,
                   "--%s %s is not between %.10g%s and %.10g%s", o->name, text, o->low,
                   name, o->high, name);
}

static gm_status read_integer(const parser *p, const gm_option *o, const char *text)
{
    int value;
    if (!gm_text_to_int(text, &value))
        return gm_fail(p->error, GM_ERR_ARGUMENT, "--%s needs a whole number, not '%s'",
                       o->name, text);
    if (value < o->low || value > o->high)
        return out_of_range(p, o, text);
    memcpy(p->arguments + o->offset, &value, sizeof value);
    return GM_OK;
}

/* The unit's own scale is the first of its kind. */
static const unit *unit_of_kind(const char *kind)
{
    for (int i = 0; i < N_UNITS; i++)
        if (strcmp(units[i].kind, kind) == 0)
            return &units[i];
    return NULL;
}

static bool to_si(const char *kind, const char *text, double *value)
{
    for (int i = 0; i < N_UNITS; i++)
        if (strcmp(units[i].kind, kind) == 0 &&
            gm_text_to_quantity(text, units[i].spelling, value)) {
            *value = units[i].scale * *value + units[i].offset;
            return true;
        }
    return false;
}

/* A quantity in the option's range. */
static gm_status take_quantity(const parser *p, const gm_option *o, const char *text,
                               double *quantity)
{
    const unit *u = unit_of_kind(o->unit);
    double value;
    if (u && *o->unit == '\0' && !to_si(o->unit, text, &value))
        return gm_fail(p->error, GM_ERR_ARGUMENT, "--%s needs a number, not '%s'",
                       o->name, text);
    if (!u || !to_si(o->unit, text, &value))
        return gm_fail(p->error, GM_ERR_ARGUMENT,
                       "--%s needs a number in %s (such as %g%s), not '%s'", o->name,
                       o->unit, fmax(o->low, fmin(100.0, o->high)), o->unit, text);
    /* a hair of room, so that a bound survives the conversion of units */
    double slack = 1e-9 * (fabs(o->low) + fabs(o->high));
    double shown = (value - u->offset) / u->scale;
    if (!(shown >= o->low - slack && shown <= o->high + slack))
        return out_of_range(p, o, text);
    *quantity = value;
    return GM_OK;
}

static gm_status read_quantity(const parser *p, const gm_option *o, const char *text)
{
    double value;
    gm_status status = take_quantity(p, o, text, &value);
    if (status == GM_OK)
        memcpy(p->arguments + o->offset, &value, sizeof value);
    return status;
}

static gm_status read_list(const parser *p, const gm_option *o, const char *text)
{
    gm_option_list list = {0, {0.0}};
    for (const char *from = text; from; from = strchr(from, ',')) {
        char part[64];
        from += from != text; /* the comma */
        size_t n = strcspn(from, ",");
        if (list.n == GM_OPTION_MOST)
            return gm_fail(p->error, GM_ERR_ARGUMENT, "--%s takes %d values, not more",
                           o->name, GM_OPTION_MOST);
        (void)snprintf(part, sizeof part, "%.*s", (int)(n < 63 ? n : 63), from);
        gm_status status = take_quantity(p, o, part, &list.value[list.n]);
        if (status != GM_OK)
            return status;
        if (list.n > 0 && !(list.value[list.n] > list.value[list.n - 1]))
            return gm_fail(p->error, GM_ERR_ARGUMENT,
                           "--%s needs values that increase; '%s' does not", o->name,
                           part);
        list.n++;
    }
    memcpy(p->arguments + o->offset, &list, sizeof list);
    return GM_OK;
}

/* One part of an error, as text of n characters: false when it is none or given
   already. */
static bool read_error_part(const char *text, size_t n, gm_option_error *e)
{
    char part[32];
    double value;
    if (n >= sizeof part)
        return false;
    memcpy(part, text, n);
    part[n] = '\0';
    if (n > 1 && part[n - 1] == '%' && gm_text_to_quantity(part, "%", &value) &&
        e->share == 0.0) {
        e->share = value / 100.0;
        return value > 0.0 && value < 100.0;
    }
    bool named = n > 0 && strchr("0123456789. ", part[n - 1]) == NULL;
    if (!named || !to_si("Nm", part, &value) || e->torque != 0.0)
        return false;
    e->torque = value;
    return value > 0.0;
}

static gm_status read_error(const parser *p, const gm_option *o, const char *text)
{
    gm_option_error e = {0.0, 0.0};
    size_t n = strcspn(text, ",");
    bool good = read_error_part(text, n, &e);
    if (good && text[n] == ',')
        good = read_error_part(text + n + 1, strlen(text + n + 1), &e);
    if (!good)
        return gm_fail(
            p->error, GM_ERR_ARGUMENT,
            "--%s needs an error such as 0.5%%, 0.1Nm or 0.5%%,0.1Nm, not '%s'", o->name,
            text);
    memcpy(p->arguments + o->offset, &e, sizeof e);
    return GM_OK;
}

static gm_status read_text(const parser *p, const gm_option *o, const char *text)
{
    char name[64];
    if (*text == '\0')
        return wrong(p, "%s: %s is empty", spelled(o, name));
    memcpy(p->arguments + o->offset, &text, sizeof text);
    return GM_OK;
}

static gm_status read_value(const parser *p, const gm_option *o, const char *text)
{
    switch (o->kind) {
    case GM_OPTION_INTEGER:
        return read_integer(p, o, text);
    case GM_OPTION_QUANTITY:
        return read_quantity(p, o, text);
    case GM_OPTION_LIST:
        return read_list(p, o, text);
    case GM_OPTION_ERROR:
        return read_error(p, o, text);
    case GM_OPTION_TEXT:
    case GM_OPTION_OPERAND:
        return read_text(p, o, text);
    case GM_OPTION_FLAG:
        break;
    }
    int yes = 1;
    memcpy(p->arguments + o->offset, &yes, sizeof yes);
    return GM_OK;
}

static gm_status set_defaults(const parser *p)
{
    memset(p->arguments, 0, p->command->size);
    for (int i = 0; i < p->command->n_options; i++) {
        const gm_option *o = &p->command->options[i];
        const int unset = GM_OPTION_UNSET;
        const double nothing = (double)NAN;
        if (o->kind == GM_OPTION_INTEGER)
            memcpy(p->arguments + o->offset, &unset, sizeof unset);
        if (o->kind == GM_OPTION_QUANTITY)
            memcpy(p->arguments + o->offset, &nothing, sizeof nothing);
        if (o->fallback && read_value(p, o, o->fallback) != GM_OK)
            return GM_ERR_ARGUMENT;
    }
    return GM_OK;
}

/* Index of the option with this long name (of n characters), or -1. */
static int find_long(const gm_command *command, const char *name, size_t n)
{
    for (int i = 0; i < command->n_options; i++) {
        const gm_option *o = &command->options[i];
        if (o->kind != GM_OPTION_OPERAND && strlen(o->name) == n &&
            strncmp(o->name, name, n) == 0)
            return i;
    }
    return -1;
}

static int find_letter(const gm_command *command, char letter)
{
    for (int i = 0; i < command->n_options; i++)
        if (command->options[i].letter == letter && letter != '\0')
            return i;
    return -1;
}

static int next_operand(const parser *p)
{
    for (int i = 0; i < p->command->n_options; i++)
        if (p->command->options[i].kind == GM_OPTION_OPERAND && !p->given[i])
            return i;
    return -1;
}

static gm_status unknown_option(const parser *p, const char *argument)
{
    char word[64];
    (void)snprintf(word, sizeof word, "%.*s", (int)strcspn(argument, "="), argument);
    const char *names[MAX_OPTIONS];
    int n = 0;
    for (int i = 0; i < p->command->n_options; i++)
        if (p->command->options[i].kind != GM_OPTION_OPERAND)
            names[n++] = p->command->options[i].name;
    int near = gm_text_nearest(word + strspn(word, "-"), names, n);
    if (near < 0)
        return gm_fail(p->error, GM_ERR_ARGUMENT,
                       "%s has no option %s (see gearmap help %s)", p->command->name,
                       word, p->command->name);
    return gm_fail(p->error, GM_ERR_ARGUMENT, "%s has no option %s, did you mean --%s?",
                   p->command->name, word, names[near]);
}

static gm_status take(parser *p, int index, const char *text)
{
    const gm_option *o = &p->command->options[index];
    if (p->given[index])
        return wrong(p, "%s: --%s is given twice", o->name);
    p->given[index] = true;
    return read_value(p, o, text);
}

/* An option with its value: "--name value", "--name=value", "-n value". *i is advanced.
 */
static gm_status take_option(parser *p, int argc, char **argv, int *i)
{
    const char *argument = argv[*i], *attached = NULL;
    int index;
    if (argument[1] == '-') {
        size_t n = strcspn(argument + 2, "=");
        index = find_long(p->command, argument + 2, n);
        attached = argument[2 + n] == '=' ? argument + 3 + n : NULL;
    } else {
        index = argument[2] == '\0' ? find_letter(p->command, argument[1]) : -1;
    }
    if (index < 0)
        return unknown_option(p, argument);
    const gm_option *o = &p->command->options[index];
    if (o->kind == GM_OPTION_FLAG)
        return attached ? wrong(p, "%s: --%s takes no value", o->name)
                        : take(p, index, "");
    if (!attached && *i + 1 >= argc)
        return wrong(p, "%s: --%s needs a value", o->name);
    return take(p, index, attached ? attached : argv[++*i]);
}

static gm_status take_operand(parser *p, const char *text)
{
    int index = next_operand(p);
    if (index < 0)
        return wrong(p, "%s has no use for the argument '%s'", text);
    return take(p, index, text);
}

static gm_status check_required(const parser *p)
{
    for (int i = 0; i < p->command->n_options; i++) {
        const gm_option *o = &p->command->options[i];
        char name[64];
        if (o->required && !p->given[i])
            return gm_fail(p->error, GM_ERR_ARGUMENT, "%s needs %s: %s", p->command->name,
                           spelled(o, name), o->help);
    }
    return GM_OK;
}

static bool asks_for_help(const char *argument)
{
    return strcmp(argument, "--help") == 0 || strcmp(argument, "-h") == 0;
}

/* Asked for anywhere, but not as the value of an option nor after "--". */
static bool wants_help(const gm_command *command, int argc, char **argv)
{
    for (int i = 0; i < argc && strcmp(argv[i], "--") != 0; i++) {
        const char *name = argv[i];
        int index = -1;
        if (asks_for_help(name))
            return true;
        if (name[0] == '-' && name[1] == '-')
            index = find_long(command, name + 2, strlen(name + 2));
        else if (name[0] == '-' && name[1] != '\0' && name[2] == '\0')
            index = find_letter(command, name[1]);
        if (index >= 0 && command->options[index].kind != GM_OPTION_FLAG)
            i++;
    }
    return false;
}

gm_parse_outcome gm_options_parse(const gm_command *command, int argc, char **argv,
                                  void *arguments, gm_error *error)
{
    parser p = {.command = command, .arguments = arguments, .error = error};
    bool operands_only = false;
    if (command->n_options > MAX_OPTIONS || set_defaults(&p) != GM_OK)
        return GM_PARSE_WRONG;
    if (wants_help(command, argc, argv))
        return GM_PARSE_HELP;
    for (int i = 0; i < argc; i++) {
        gm_status status = GM_OK;
        if (!operands_only && strcmp(argv[i], "--") == 0)
            operands_only = true;
        else if (!operands_only && argv[i][0] == '-' && argv[i][1] != '\0')
            status = take_option(&p, argc, argv, &i);
        else
            status = take_operand(&p, argv[i]);
        if (status != GM_OK)
            return GM_PARSE_WRONG;
    }
    return check_required(&p) == GM_OK ? GM_PARSE_RUN : GM_PARSE_WRONG;
}
