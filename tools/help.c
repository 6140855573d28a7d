/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Help texts, printed from the same tables that the arguments are read by.
 */
#include "options.h"

#include <stdbool.h>
#include <string.h>

#define COLUMNS 80
#define OPTION_COLUMN 28

/* Characters, not bytes: text may hold UTF-8. */
static int width_of(const char *word, size_t bytes)
{
    int n = 0;
    for (size_t i = 0; i < bytes; i++)
        n += ((unsigned char)word[i] & 0xC0u) != 0x80u;
    return n;
}

void gm_print_wrapped(FILE *out, const char *text, int indent, int column)
{
    bool first = true;
    while (*(text += strspn(text, " ")) != '\0') {
        size_t bytes = strcspn(text, " ");
        int width = width_of(text, bytes);
        if (!first && column + 1 + width > COLUMNS) {
            fprintf(out, "\n%*s", indent, "");
            column = indent;
        } else if (!first) {
            fputc(' ', out);
            column++;
        }
        fwrite(text, 1, bytes, out);
        column += width;
        text += bytes;
        first = false;
    }
    fputc('\n', out);
}

static void print_usage(const gm_command *command, FILE *out)
{
    fprintf(out, "usage: gearmap %s", command->name);
    for (int i = 0; i < command->n_options; i++) {
        const gm_option *o = &command->options[i];
        if (!o->help)
            continue;
        if (o->kind == GM_OPTION_OPERAND)
            fprintf(out, o->required ? " %s" : " [%s]", o->name);
        else if (o->required && o->letter)
            fprintf(out, " -%c %s", o->letter, o->value);
        else if (o->required)
            fprintf(out, o->value ? " --%s %s" : " --%s", o->name, o->value);
    }
    fprintf(out, " [options]\n\n");
}

/* The option's left column: "  -o, --output FILE". */
static void print_option(const gm_option *o, FILE *out)
{
    char left[80], help[512];
    bool named = o->kind != GM_OPTION_OPERAND;
    const char *value = o->value ? o->value : "";
    const char *unit = o->unit ? o->unit : "";
    if (!named)
        (void)snprintf(left, sizeof left, "  %s", o->name);
    else if (o->letter)
        (void)snprintf(left, sizeof left, "  -%c, --%s %s", o->letter, o->name, value);
    else
        (void)snprintf(left, sizeof left, "      --%s %s", o->name, value);
    (void)snprintf(help, sizeof help, "%s%s%s%s%s%s%s", o->help, *unit ? " [" : "", unit,
                   *unit ? "]" : "", o->fallback ? " (default " : "",
                   o->fallback ? o->fallback : "", o->fallback ? ")" : "");
    int width = (int)strlen(left);
    fputs(left, out);
    if (width > OPTION_COLUMN - 2) {
        fputc('\n', out);
        width = 0;
    }
    fprintf(out, "%*s", OPTION_COLUMN - width, "");
    gm_print_wrapped(out, help, OPTION_COLUMN, OPTION_COLUMN);
}

void gm_options_help(const gm_command *command, FILE *out)
{
    print_usage(command, out);
    gm_print_wrapped(out, command->summary, 0, 0);
    if (command->details) {
        fputc('\n', out);
        gm_print_wrapped(out, command->details, 0, 0);
    }
    fputc('\n', out);
    for (int i = 0; i < command->n_options; i++)
        if (command->options[i].help)
            print_option(&command->options[i], out);
    fprintf(out, "  -h, --help%*sprint this\n", OPTION_COLUMN - 12, "");
}
