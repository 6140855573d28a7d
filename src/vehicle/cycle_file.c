/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A cycle from a file of comma-separated values:
 *
 *   time_s         from 0, increasing
 *   speed_km_h     linear between rows
 *   gear           optional: driven from this time on, or waited in; empty: as before.
 *                  0, a car in neutral, waits in the lowest gear
 *   grade_percent  optional: 100 times rise over run, linear between rows
 */
#include "vehicle/gm_cycle.h"

#include "base/alloc.h"
#include "base/csv.h"
#include "base/text.h"

#include <string.h>

#define KM_H (1.0 / 3.6) /* m/s */
#define SPEED_MAX 500.0  /* km/h: beyond it is another unit */
#define GRADE_MAX 50.0   /* % */
#define GEAR_MAX 99
#define MAX_ROWS 1000000

enum { TIME, SPEED, GEAR, GRADE, N_KNOWN };
static const char *const known[N_KNOWN] = {"time_s", "speed_km_h", "gear",
                                           "grade_percent"};

typedef struct table {
    int n, n_gears, room;
    double *time, *speed, *grade; /* [room] */
    gm_cycle_gear *gears;         /* [room] */
} table;

static void clear(table *t)
{
    gm_free(t->time);
    gm_free(t->speed);
    gm_free(t->grade);
    gm_free(t->gears);
}

static bool enlarge(void *array, size_t n, size_t size)
{
    void **place = array;
    void *larger = gm_resize(*place, n, size);
    if (larger)
        *place = larger;
    return larger != NULL;
}

static gm_status make_room(table *t, gm_error *error)
{
    if (t->n < t->room)
        return GM_OK;
    int room = t->room ? 2 * t->room : 256;
    size_t n = (size_t)room;
    if (!enlarge(&t->time, n, sizeof *t->time) ||
        !enlarge(&t->speed, n, sizeof *t->speed) ||
        !enlarge(&t->grade, n, sizeof *t->grade) ||
        !enlarge(&t->gears, n, sizeof *t->gears))
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    t->room = room;
    return GM_OK;
}

/* ---- cells ---- */

static gm_status take_time(const gm_csv *csv, int i, table *t, gm_error *error)
{
    gm_status status = gm_csv_number(csv, i, &t->time[t->n], error);
    if (status != GM_OK)
        return status;
    if (t->n == 0 && t->time[0] != 0.0)
        return gm_csv_wrong(csv, i, "0: a cycle starts there", error);
    if (t->n > 0 && !(t->time[t->n] > t->time[t->n - 1]))
        return gm_csv_wrong(csv, i, "more than in the row before", error);
    return GM_OK;
}

static gm_status take_speed(const gm_csv *csv, int i, table *t, gm_error *error)
{
    double value = 0.0;
    gm_status status = gm_csv_number(csv, i, &value, error);
    if (status == GM_OK && !(value >= 0.0 && value <= SPEED_MAX))
        status = gm_csv_wrong(csv, i, "0 to 500 km/h", error);
    t->speed[t->n] = value * KM_H;
    return status;
}

static gm_status take_grade(const gm_csv *csv, int i, table *t, gm_error *error)
{
    double value = 0.0;
    gm_status status = gm_csv_number(csv, i, &value, error);
    if (status == GM_OK && !(value >= -GRADE_MAX && value <= GRADE_MAX))
        status = gm_csv_wrong(csv, i, "-50 to 50 %", error);
    t->grade[t->n] = 0.01 * value;
    return status;
}

static gm_status take_gear(const gm_csv *csv, int i, table *t, gm_error *error)
{
    int gear;
    if (*gm_csv_cell(csv, i) == '\0' && t->n > 0)
        return GM_OK;
    if (!gm_text_to_int(gm_csv_cell(csv, i), &gear) || gear < 0 || gear > GEAR_MAX)
        return gm_csv_wrong(csv, i, "the number of a forward gear, or 0", error);
    if (t->n_gears == 0 || t->gears[t->n_gears - 1].gear != gear)
        t->gears[t->n_gears++].gear = gear;
    return GM_OK;
}

static gm_status take_row(const gm_csv *csv, table *t, gm_error *error)
{
    typedef gm_status taker(const gm_csv *csv, int i, table *t, gm_error *error);
    static taker *const take[N_KNOWN] = {take_time, take_speed, take_gear, take_grade};
    int n_gears = t->n_gears;
    gm_status status = make_room(t, error);
    if (status == GM_OK && t->n >= MAX_ROWS)
        status = gm_fail(error, GM_ERR_FORMAT, "a cycle has at most %d rows", MAX_ROWS);
    for (int i = 0; i < gm_csv_n_columns(csv) && status == GM_OK; i++)
        status = take[gm_csv_column(csv, i)](csv, i, t, error);
    if (status == GM_OK && t->n_gears > n_gears)
        t->gears[n_gears].time = t->time[t->n];
    t->n++;
    return status;
}

/* ---- the file ---- */

static gm_status check_header(const gm_csv *csv, const char *path, gm_error *error)
{
    for (int k = TIME; k <= SPEED; k++)
        if (!gm_csv_has(csv, k))
            return gm_fail(error, GM_ERR_FORMAT, "%s:%d: the column %s is missing", path,
                           gm_csv_line(csv), known[k]);
    return GM_OK;
}

static gm_status read_table(gm_csv *csv, const char *path, table *t, gm_error *error)
{
    bool more = true;
    gm_status status = gm_csv_read_header(
        csv, known, N_KNOWN, "time_s, speed_km_h, gear and grade_percent", error);
    if (status == GM_OK)
        status = check_header(csv, path, error);
    while (status == GM_OK && more) {
        status = gm_csv_read_row(csv, &more, error);
        if (status == GM_OK && more)
            status = take_row(csv, t, error);
    }
    if (status == GM_OK && t->n < 2)
        status = gm_fail(error, GM_ERR_FORMAT,
                         "%s: found %d rows; a cycle has a start and an end", path, t->n);
    return status;
}

/* The file's name without folder and ending. */
static void name_of(const char *path, char name[GM_CYCLE_NAME])
{
    const char *slash = strrchr(path, '/'), *start = slash ? slash + 1 : path;
    const char *dot = strrchr(start, '.');
    size_t n = dot && dot > start ? (size_t)(dot - start) : strlen(start);
    if (n >= GM_CYCLE_NAME)
        n = GM_CYCLE_NAME - 1;
    memcpy(name, start, n);
    name[n] = '\0';
}

gm_status gm_cycle_read(const char *path, gm_cycle **cycle, gm_error *error)
{
    gm_csv *csv = NULL;
    gm_cycle *made = NULL;
    table t = {0};
    char name[GM_CYCLE_NAME];
    gm_status status = gm_csv_open(path, &csv, error);
    if (status == GM_OK)
        status = read_table(csv, path, &t, error);
    name_of(path, name);
    if (status == GM_OK)
        status =
            gm_cycle_create(name, t.n, t.time, t.speed, t.n_gears, t.gears, &made, error);
    if (status == GM_OK && gm_csv_has(csv, GRADE))
        status = gm_cycle_set_grade(made, t.grade, error);
    gm_csv_close(csv);
    clear(&t);
    if (status != GM_OK) {
        gm_cycle_destroy(made);
        return status;
    }
    *cycle = made;
    return GM_OK;
}
