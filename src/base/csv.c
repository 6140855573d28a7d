/* SPDX-License-Identifier: BSD-2-Clause */
#include "base/csv.h"

#include "base/alloc.h"
#include "base/text.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#define SHOWN 40 /* characters of a cell in a sentence */

struct gm_csv {
    const char *path;
    FILE *file;
    int line;
    char text[GM_CSV_LINE];
    const char *const *known;
    int n_columns;
    int column[GM_CSV_COLUMNS]; /* of the file, as indices of known */
    const char *cell[GM_CSV_COLUMNS];
};

gm_status gm_csv_open(const char *path, gm_csv **csv, gm_error *error)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return gm_fail(error, GM_ERR_IO, "%s: cannot be opened: %s", path,
                       strerror(errno));
    gm_csv *made = gm_calloc(1, sizeof *made);
    if (!made) {
        (void)fclose(file);
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    }
    made->path = path;
    made->file = file;
    *csv = made;
    return GM_OK;
}

void gm_csv_close(gm_csv *csv)
{
    if (!csv)
        return;
    (void)fclose(csv->file);
    gm_free(csv);
}

/* ---- lines and cells ---- */

static char *trim(char *text)
{
    text += strspn(text, " \t");
    size_t n = strlen(text);
    while (n > 0 && strchr(" \t\r\n", text[n - 1]))
        text[--n] = '\0';
    return text;
}

/* The next line with content in *content, NULL at the end of the file. */
static gm_status next_line(gm_csv *csv, char **content, gm_error *error)
{
    *content = NULL;
    while (fgets(csv->text, sizeof csv->text, csv->file)) {
        csv->line++;
        if (strlen(csv->text) + 1 >= sizeof csv->text)
            return gm_fail(error, GM_ERR_FORMAT,
                           "%s:%d: the line has more than %d characters", csv->path,
                           csv->line, GM_CSV_LINE - 2);
        char *text = csv->text;
        if (csv->line == 1 && strncmp(text, "\xEF\xBB\xBF", 3) == 0)
            text += 3;
        text = trim(text);
        if (*text != '\0' && *text != '#') {
            *content = text;
            return GM_OK;
        }
    }
    if (ferror(csv->file))
        return gm_fail(error, GM_ERR_IO, "%s: cannot be read: %s", csv->path,
                       strerror(errno));
    return GM_OK;
}

/* Cuts the first cell off; *rest is what follows its comma, NULL after the last. */
static const char *cut_cell(char *text, char **rest)
{
    char *comma = strchr(text, ',');
    *rest = comma ? comma + 1 : NULL;
    if (comma)
        *comma = '\0';
    return trim(text);
}

/* Shown in a sentence: a piece of the cell, without what no terminal should get. */
static const char *shown(const char *cell, char text[SHOWN + 4])
{
    size_t n = 0;
    while (cell[n] && n < SHOWN) {
        unsigned char byte = (unsigned char)cell[n];
        text[n++] = byte < 0x20 || byte >= 0x7F ? '?' : (char)byte;
    }
    strcpy(text + n, cell[n] ? "..." : "");
    return text;
}

/* ---- header ---- */

static int find(const char *name, const char *const *known, int n_known)
{
    for (int i = 0; i < n_known; i++)
        if (strcmp(known[i], name) == 0)
            return i;
    return -1;
}

static gm_status unknown_column(const gm_csv *csv, const char *name, int n_known,
                                const char *usual, gm_error *error)
{
    char text[SHOWN + 4];
    if (strpbrk(name, ";\t"))
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s:%d: found '%s'; columns are separated by commas", csv->path,
                       csv->line, shown(name, text));
    int near = gm_text_nearest(name, csv->known, n_known);
    if (near >= 0)
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s:%d: there is no column '%s', did you mean %s?", csv->path,
                       csv->line, shown(name, text), csv->known[near]);
    return gm_fail(error, GM_ERR_FORMAT, "%s:%d: there is no column '%s'; there are %s",
                   csv->path, csv->line, shown(name, text), usual);
}

gm_status gm_csv_read_header(gm_csv *csv, const char *const *known, int n_known,
                             const char *usual, gm_error *error)
{
    char *rest;
    csv->known = known;
    gm_status status = next_line(csv, &rest, error);
    if (status != GM_OK)
        return status;
    if (!rest)
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s: found no line with names of columns, such as %s", csv->path,
                       known[0]);
    while (rest) {
        const char *name = cut_cell(rest, &rest);
        int index = find(name, known, n_known);
        if (index < 0)
            return unknown_column(csv, name, n_known, usual, error);
        if (gm_csv_has(csv, index))
            return gm_fail(error, GM_ERR_FORMAT, "%s:%d: the column %s stands twice",
                           csv->path, csv->line, name);
        csv->column[csv->n_columns++] = index;
    }
    return GM_OK;
}

bool gm_csv_has(const gm_csv *csv, int known)
{
    for (int i = 0; i < csv->n_columns; i++)
        if (csv->column[i] == known)
            return true;
    return false;
}

int gm_csv_n_columns(const gm_csv *csv)
{
    return csv->n_columns;
}

int gm_csv_column(const gm_csv *csv, int i)
{
    return csv->column[i];
}

int gm_csv_line(const gm_csv *csv)
{
    return csv->line;
}

/* ---- rows ---- */

gm_status gm_csv_read_row(gm_csv *csv, bool *more, gm_error *error)
{
    char *rest;
    int n = 0;
    gm_status status = next_line(csv, &rest, error);
    *more = status == GM_OK && rest;
    if (!*more)
        return status;
    for (; rest; n++) {
        const char *cell = cut_cell(rest, &rest);
        if (n < csv->n_columns)
            csv->cell[n] = cell;
    }
    if (n != csv->n_columns)
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s:%d: found %d values, expected %d, one for each column",
                       csv->path, csv->line, n, csv->n_columns);
    return GM_OK;
}

const char *gm_csv_cell(const gm_csv *csv, int i)
{
    return csv->cell[i];
}

gm_status gm_csv_number(const gm_csv *csv, int i, double *value, gm_error *error)
{
    return gm_text_to_double(csv->cell[i], value)
               ? GM_OK
               : gm_csv_wrong(csv, i, "a number", error);
}

gm_status gm_csv_wrong(const gm_csv *csv, int i, const char *expected, gm_error *error)
{
    char text[SHOWN + 4];
    return gm_fail(error, GM_ERR_FORMAT, "%s:%d: column %s: found '%s', expected %s",
                   csv->path, csv->line, csv->known[csv->column[i]],
                   shown(csv->cell[i], text), expected);
}
