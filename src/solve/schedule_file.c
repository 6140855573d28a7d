/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Reading a schedule. Nothing is guessed: an unknown column, a cell that is no number, a
 * time that runs back is refused with file, line, column, what was found and expected.
 */
#include "solve/gm_schedule.h"

#include "base/alloc.h"
#include "base/text.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define RPM 0.10471975511965977 /* rad/s */
#define KELVIN 273.15
#define MAX_LINE 4096
#define MAX_COLUMNS (3 + 4 * GM_MAX_FLANGES)
#define NAME_SIZE 72
#define SHOWN 40 /* characters of a cell in a sentence */

typedef enum column_kind {
    COLUMN_TIME,
    COLUMN_OIL,
    COLUMN_TORQUE,
    COLUMN_SPEED,
    COLUMN_START,
    COLUMN_GEAR
} column_kind;

typedef struct column {
    char name[NAME_SIZE];
    column_kind kind;
    int flange;
} column;

typedef struct reader {
    const char *path;
    FILE *file;
    const gm_plant_info *info;
    gm_error *error;
    int line;
    char text[MAX_LINE];
    column known[MAX_COLUMNS]; /* every column that this gearset may have */
    int n_known;
    int present[MAX_COLUMNS]; /* columns of the file, as indices of known */
    int n_present;
    gm_schedule *schedule;
    int room; /* for rows */
} reader;

/* ---- the columns that there may be ---- */

static void know(reader *r, const char *prefix, const char *name, column_kind kind,
                 int flange)
{
    column *c = &r->known[r->n_known++];
    (void)snprintf(c->name, sizeof c->name, "%s%s", prefix, name);
    c->kind = kind;
    c->flange = flange;
}

static void know_flange(reader *r, const char *flange_name, int flange)
{
    char prefix[NAME_SIZE - 16];
    (void)snprintf(prefix, sizeof prefix, "%s.", flange_name);
    know(r, prefix, "tau_Nm", COLUMN_TORQUE, flange);
    know(r, prefix, "speed_rpm", COLUMN_SPEED, flange);
    know(r, prefix, "w_start_rpm", COLUMN_START, flange);
    if (flange > 0)
        know(r, prefix, "gear", COLUMN_GEAR, flange);
}

static void know_all(reader *r)
{
    know(r, "", "time_s", COLUMN_TIME, 0);
    know(r, "", "oil_temperature_degC", COLUMN_OIL, 0);
    know_flange(r, "output", 0);
    for (int p = 0; p < r->info->n_paths; p++)
        know_flange(r, r->info->path[p].name, 1 + p);
}

static int find_known(const reader *r, const char *name)
{
    for (int i = 0; i < r->n_known; i++)
        if (strcmp(r->known[i].name, name) == 0)
            return i;
    return -1;
}

/* Is a column of this kind for this flange in the file? */
static int has(const reader *r, column_kind kind, int flange)
{
    for (int i = 0; i < r->n_present; i++) {
        const column *c = &r->known[r->present[i]];
        if (c->kind == kind && c->flange == flange)
            return 1;
    }
    return 0;
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
static gm_status next_line(reader *r, char **content)
{
    *content = NULL;
    while (fgets(r->text, sizeof r->text, r->file)) {
        r->line++;
        if (strlen(r->text) + 1 >= sizeof r->text)
            return gm_fail(r->error, GM_ERR_FORMAT,
                           "%s:%d: the line has more than %d characters", r->path,
                           r->line, MAX_LINE - 2);
        char *text = r->text;
        if (r->line == 1 && strncmp(text, "\xEF\xBB\xBF", 3) == 0)
            text += 3;
        text = trim(text);
        if (*text != '\0' && *text != '#') {
            *content = text;
            return GM_OK;
        }
    }
    if (ferror(r->file))
        return gm_fail(r->error, GM_ERR_IO, "%s: cannot be read: %s", r->path,
                       strerror(errno));
    return GM_OK;
}

/* Cuts the first cell off; *rest is what follows its comma, NULL after the last. */
static char *cut_cell(char *text, char **rest)
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

static gm_status wrong_cell(const reader *r, const column *c, const char *cell,
                            const char *expected)
{
    char text[SHOWN + 4];
    return gm_fail(r->error, GM_ERR_FORMAT, "%s:%d: column %s: found '%s', expected %s",
                   r->path, r->line, c->name, shown(cell, text), expected);
}

/* ---- header ---- */

static gm_status unknown_column(const reader *r, const char *name)
{
    char text[SHOWN + 4];
    const char *names[MAX_COLUMNS];
    for (int i = 0; i < r->n_known; i++)
        names[i] = r->known[i].name;
    if (strpbrk(name, ";\t"))
        return gm_fail(r->error, GM_ERR_FORMAT,
                       "%s:%d: found '%s'; columns are separated by commas", r->path,
                       r->line, shown(name, text));
    int near = gm_text_nearest(name, names, r->n_known);
    if (near >= 0)
        return gm_fail(r->error, GM_ERR_FORMAT,
                       "%s:%d: there is no column '%s', did you mean %s?", r->path,
                       r->line, shown(name, text), names[near]);
    return gm_fail(r->error, GM_ERR_FORMAT,
                   "%s:%d: there is no column '%s'; there are time_s, output.tau_Nm, "
                   "output.speed_rpm, %s.tau_Nm, %s.speed_rpm, %s.gear and more",
                   r->path, r->line, shown(name, text), r->info->path[0].name,
                   r->info->path[0].name, r->info->path[0].name);
}

static gm_status check_header(const reader *r)
{
    if (!has(r, COLUMN_TIME, 0))
        return gm_fail(r->error, GM_ERR_FORMAT, "%s:%d: the column time_s is missing",
                       r->path, r->line);
    for (int f = 0; f < r->schedule->n_flanges; f++) {
        const char *name = f == 0 ? "output" : r->info->path[f - 1].name;
        if (has(r, COLUMN_SPEED, f) && has(r, COLUMN_TORQUE, f))
            return gm_fail(r->error, GM_ERR_FORMAT,
                           "%s:%d: columns %s.tau_Nm and %s.speed_rpm: a flange is given "
                           "its torque or its speed, not both",
                           r->path, r->line, name, name);
        if (has(r, COLUMN_SPEED, f) && has(r, COLUMN_START, f))
            return gm_fail(r->error, GM_ERR_FORMAT,
                           "%s:%d: columns %s.speed_rpm and %s.w_start_rpm: the speed "
                           "starts where its own column says",
                           r->path, r->line, name, name);
        r->schedule->driven[f] = has(r, COLUMN_SPEED, f);
    }
    return GM_OK;
}

static gm_status read_header(reader *r)
{
    char *rest;
    gm_status status = next_line(r, &rest);
    if (status != GM_OK)
        return status;
    if (!rest)
        return gm_fail(r->error, GM_ERR_FORMAT,
                       "%s: found no line with names of columns, such as time_s",
                       r->path);
    while (rest) {
        const char *name = cut_cell(rest, &rest);
        int index = find_known(r, name);
        if (index < 0)
            return unknown_column(r, name);
        if (has(r, r->known[index].kind, r->known[index].flange))
            return gm_fail(r->error, GM_ERR_FORMAT, "%s:%d: the column %s stands twice",
                           r->path, r->line, name);
        r->present[r->n_present++] = index;
    }
    return check_header(r);
}

/* ---- cells of a row ---- */

static gm_status take_gear(const reader *r, const column *c, const char *cell,
                           gm_schedule_row *row)
{
    const gm_plant_path *path = &r->info->path[c->flange - 1];
    char expected[256] = "a gear of this path: 0";
    int number, known;
    if (*cell == '\0')
        return GM_OK;
    known = gm_text_to_int(cell, &number) && number == 0;
    for (int i = 0; i < path->n_gears; i++) {
        size_t n = strlen(expected);
        (void)snprintf(expected + n, sizeof expected - n, ", %d", path->gears[i].number);
        known |= gm_text_to_int(cell, &number) && number == path->gears[i].number;
    }
    if (!known)
        return wrong_cell(r, c, cell, expected);
    row->gear[c->flange - 1] = number;
    return GM_OK;
}

/* A value of the start: the first row says it, others may repeat it. */
static gm_status take_start(const reader *r, const column *c, const char *cell,
                            double *kept, double value)
{
    char expected[96];
    if (r->schedule->n_rows == 0)
        *kept = value;
    else if (*kept != value) {
        (void)snprintf(expected, sizeof expected,
                       "what the first row says or nothing: it belongs to the start");
        return wrong_cell(r, c, cell, expected);
    }
    return GM_OK;
}

static gm_status take_number(const reader *r, const column *c, const char *cell,
                             gm_schedule_row *row)
{
    gm_schedule *s = r->schedule;
    double value;
    int at_start = c->kind == COLUMN_START || c->kind == COLUMN_OIL;
    if (at_start && *cell == '\0' && s->n_rows > 0)
        return GM_OK;
    if (!gm_text_to_double(cell, &value))
        return wrong_cell(r, c, cell, "a number");
    switch (c->kind) {
    case COLUMN_TIME:
        row->t = value;
        break;
    case COLUMN_TORQUE:
        row->value[c->flange] = value;
        break;
    case COLUMN_SPEED:
        row->value[c->flange] = value * RPM;
        break;
    case COLUMN_START:
        return take_start(r, c, cell, &s->start_speed[c->flange], value * RPM);
    case COLUMN_OIL:
        return take_start(r, c, cell, &s->oil_temperature, value + KELVIN);
    case COLUMN_GEAR:
        break;
    }
    return GM_OK;
}

static gm_status check_time(const reader *r, const gm_schedule_row *row)
{
    const gm_schedule *s = r->schedule;
    const gm_schedule_row *last = s->n_rows > 0 ? &s->rows[s->n_rows - 1] : NULL;
    if (last && row->t < last->t)
        return gm_fail(r->error, GM_ERR_FORMAT,
                       "%s:%d: column time_s: found %.9g, expected at least %.9g, the "
                       "time of the row before",
                       r->path, r->line, row->t, last->t);
    if (s->n_rows > 1 && row->t == last[-1].t)
        return gm_fail(r->error, GM_ERR_FORMAT,
                       "%s:%d: column time_s: found %.9g for the third time; twice makes "
                       "a step, from the first row's values to the second's",
                       r->path, r->line, row->t);
    return GM_OK;
}

static gm_status add_row(reader *r, const gm_schedule_row *row)
{
    gm_schedule *s = r->schedule;
    if (s->n_rows == r->room) {
        int room = r->room ? 2 * r->room : 64;
        gm_schedule_row *rows = gm_resize(s->rows, (size_t)room, sizeof *rows);
        if (!rows)
            return gm_fail(r->error, GM_ERR_MEMORY, "out of memory");
        s->rows = rows;
        r->room = room;
    }
    s->rows[s->n_rows++] = *row;
    return GM_OK;
}

static gm_status read_row(reader *r, char *text)
{
    const gm_schedule *s = r->schedule;
    gm_schedule_row row = {0};
    char *rest = text;
    int n = 0;
    if (s->n_rows > 0)
        memcpy(row.gear, s->rows[s->n_rows - 1].gear, sizeof row.gear);
    while (rest && n < r->n_present) {
        const column *c = &r->known[r->present[n++]];
        const char *cell = cut_cell(rest, &rest);
        gm_status status = c->kind == COLUMN_GEAR ? take_gear(r, c, cell, &row)
                                                  : take_number(r, c, cell, &row);
        if (status != GM_OK)
            return status;
    }
    for (; rest; n++)
        (void)cut_cell(rest, &rest);
    if (n != r->n_present)
        return gm_fail(r->error, GM_ERR_FORMAT,
                       "%s:%d: found %d values, expected %d, one for each column",
                       r->path, r->line, n, r->n_present);
    gm_status status = check_time(r, &row);
    return status == GM_OK ? add_row(r, &row) : status;
}

/* ---- the file ---- */

static gm_status read_all(reader *r)
{
    gm_schedule *s = r->schedule;
    char *text;
    know_all(r);
    gm_status status = read_header(r);
    while (status == GM_OK) {
        status = next_line(r, &text);
        if (status != GM_OK || !text)
            break;
        status = read_row(r, text);
    }
    if (status == GM_OK && (s->n_rows < 2 || !(s->rows[s->n_rows - 1].t > s->rows[0].t)))
        return gm_fail(r->error, GM_ERR_FORMAT,
                       "%s: found no two rows with different times; a schedule has a "
                       "start and an end",
                       r->path);
    return status;
}

static gm_schedule *empty_schedule(const char *path, int n_paths)
{
    gm_schedule *s = gm_calloc(1, sizeof *s);
    if (!s)
        return NULL;
    s->n_flanges = 1 + n_paths;
    s->oil_temperature = (double)NAN;
    for (int f = 0; f < GM_MAX_FLANGES; f++)
        s->start_speed[f] = (double)NAN;
    s->file = gm_strdup(path);
    if (s->file)
        return s;
    gm_schedule_destroy(s);
    return NULL;
}

gm_status gm_schedule_read(const char *path, const gm_plant_info *info,
                           gm_schedule **schedule, gm_error *error)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return gm_fail(error, GM_ERR_IO, "%s: cannot be opened: %s", path,
                       strerror(errno));
    reader *r = gm_calloc(1, sizeof *r);
    gm_schedule *s = empty_schedule(path, info->n_paths);
    gm_status status = GM_ERR_MEMORY;
    if (r && s) {
        r->path = path;
        r->file = file;
        r->info = info;
        r->error = error;
        r->schedule = s;
        status = read_all(r);
    } else {
        (void)gm_fail(error, status, "out of memory");
    }
    (void)fclose(file);
    gm_free(r);
    if (status != GM_OK) {
        gm_schedule_destroy(s);
        return status;
    }
    *schedule = s;
    return GM_OK;
}
