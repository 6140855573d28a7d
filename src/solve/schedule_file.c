/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Reading a schedule. Nothing is guessed: an unknown column, a cell that is no number, a
 * time that runs back is refused with file, line, column, what was found and expected.
 */
#include "solve/gm_schedule.h"

#include "base/alloc.h"
#include "base/csv.h"
#include "base/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define RPM 0.10471975511965977 /* rad/s */
#define KELVIN 273.15
#define MAX_COLUMNS (3 + 4 * GM_MAX_FLANGES)
#define NAME_SIZE 72

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
    gm_csv *csv;
    const gm_plant_info *info;
    gm_error *error;
    column known[MAX_COLUMNS]; /* every column that this gearset may have */
    const char *names[MAX_COLUMNS];
    int n_known;
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

/* Is a column of this kind for this flange in the file? */
static int has(const reader *r, column_kind kind, int flange)
{
    for (int i = 0; i < r->n_known; i++)
        if (r->known[i].kind == kind && r->known[i].flange == flange)
            return gm_csv_has(r->csv, i);
    return 0;
}

/* ---- header ---- */

static gm_status check_header(const reader *r)
{
    int line = gm_csv_line(r->csv);
    if (!has(r, COLUMN_TIME, 0))
        return gm_fail(r->error, GM_ERR_FORMAT, "%s:%d: the column time_s is missing",
                       r->path, line);
    for (int f = 0; f < r->schedule->n_flanges; f++) {
        const char *name = f == 0 ? "output" : r->info->path[f - 1].name;
        if (has(r, COLUMN_SPEED, f) && has(r, COLUMN_TORQUE, f))
            return gm_fail(r->error, GM_ERR_FORMAT,
                           "%s:%d: columns %s.tau_Nm and %s.speed_rpm: a flange is given "
                           "its torque or its speed, not both",
                           r->path, line, name, name);
        if (has(r, COLUMN_SPEED, f) && has(r, COLUMN_START, f))
            return gm_fail(r->error, GM_ERR_FORMAT,
                           "%s:%d: columns %s.speed_rpm and %s.w_start_rpm: the speed "
                           "starts where its own column says",
                           r->path, line, name, name);
        r->schedule->driven[f] = has(r, COLUMN_SPEED, f);
    }
    return GM_OK;
}

static gm_status read_header(reader *r)
{
    const char *path = r->info->path[0].name;
    char usual[4 * NAME_SIZE + 64];
    for (int i = 0; i < r->n_known; i++)
        r->names[i] = r->known[i].name;
    (void)snprintf(usual, sizeof usual,
                   "time_s, output.tau_Nm, output.speed_rpm, %s.tau_Nm, %s.speed_rpm, "
                   "%s.gear and more",
                   path, path, path);
    gm_status status = gm_csv_read_header(r->csv, r->names, r->n_known, usual, r->error);
    return status == GM_OK ? check_header(r) : status;
}

/* ---- cells of a row ---- */

static gm_status take_gear(const reader *r, int i, const column *c, gm_schedule_row *row)
{
    const char *cell = gm_csv_cell(r->csv, i);
    const gm_plant_path *path = &r->info->path[c->flange - 1];
    char expected[256] = "a gear of this path: 0";
    int number, known;
    if (*cell == '\0')
        return GM_OK;
    known = gm_text_to_int(cell, &number) && number == 0;
    for (int g = 0; g < path->n_gears; g++) {
        size_t n = strlen(expected);
        (void)snprintf(expected + n, sizeof expected - n, ", %d", path->gears[g].number);
        known |= gm_text_to_int(cell, &number) && number == path->gears[g].number;
    }
    if (!known)
        return gm_csv_wrong(r->csv, i, expected, r->error);
    row->gear[c->flange - 1] = number;
    return GM_OK;
}

/* A value of the start: the first row says it, others may repeat it. */
static gm_status take_start(const reader *r, int i, double *kept, double value)
{
    if (r->schedule->n_rows == 0)
        *kept = value;
    else if (*kept != value)
        return gm_csv_wrong(r->csv, i,
                            "what the first row says or nothing: it belongs to the start",
                            r->error);
    return GM_OK;
}

static gm_status take_number(const reader *r, int i, const column *c,
                             gm_schedule_row *row)
{
    gm_schedule *s = r->schedule;
    double value;
    int at_start = c->kind == COLUMN_START || c->kind == COLUMN_OIL;
    if (at_start && *gm_csv_cell(r->csv, i) == '\0' && s->n_rows > 0)
        return GM_OK;
    gm_status status = gm_csv_number(r->csv, i, &value, r->error);
    if (status != GM_OK)
        return status;
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
        return take_start(r, i, &s->start_speed[c->flange], value * RPM);
    case COLUMN_OIL:
        return take_start(r, i, &s->oil_temperature, value + KELVIN);
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
                       r->path, gm_csv_line(r->csv), row->t, last->t);
    if (s->n_rows > 1 && row->t == last[-1].t)
        return gm_fail(r->error, GM_ERR_FORMAT,
                       "%s:%d: column time_s: found %.9g for the third time; twice makes "
                       "a step, from the first row's values to the second's",
                       r->path, gm_csv_line(r->csv), row->t);
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

static gm_status take_row(reader *r)
{
    const gm_schedule *s = r->schedule;
    gm_schedule_row row = {0};
    gm_status status = GM_OK;
    if (s->n_rows > 0)
        memcpy(row.gear, s->rows[s->n_rows - 1].gear, sizeof row.gear);
    for (int i = 0; i < gm_csv_n_columns(r->csv) && status == GM_OK; i++) {
        const column *c = &r->known[gm_csv_column(r->csv, i)];
        status = c->kind == COLUMN_GEAR ? take_gear(r, i, c, &row)
                                        : take_number(r, i, c, &row);
    }
    if (status == GM_OK)
        status = check_time(r, &row);
    return status == GM_OK ? add_row(r, &row) : status;
}

/* ---- the file ---- */

static gm_status read_all(reader *r)
{
    gm_schedule *s = r->schedule;
    bool more = true;
    know_all(r);
    gm_status status = read_header(r);
    while (status == GM_OK && more) {
        status = gm_csv_read_row(r->csv, &more, r->error);
        if (status == GM_OK && more)
            status = take_row(r);
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
    gm_schedule *s = empty_schedule(path, info->n_paths);
    reader r = {.path = path, .info = info, .error = error, .schedule = s};
    if (!s)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    gm_status status = gm_csv_open(path, &r.csv, error);
    if (status == GM_OK)
        status = read_all(&r);
    gm_csv_close(r.csv);
    if (status != GM_OK) {
        gm_schedule_destroy(s);
        return status;
    }
    *schedule = s;
    return GM_OK;
}
