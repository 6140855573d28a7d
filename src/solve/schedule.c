/* SPDX-License-Identifier: BSD-2-Clause */
#include "solve/gm_schedule.h"

#include "base/alloc.h"

#include <math.h>

#define RPM 0.10471975511965977 /* rad/s */
/* Printed ratios and speeds have some six digits. */
#define SAME_SPEED 1e-5

void gm_schedule_destroy(gm_schedule *s)
{
    if (!s)
        return;
    gm_free(s->file);
    gm_free(s->rows);
    gm_free(s);
}

/* ---- as a drive ---- */

static double slope(const gm_schedule *s, int row, int flange)
{
    if (row < 0 || row + 1 >= s->n_rows)
        return 0.0;
    const gm_schedule_row *a = &s->rows[row], *b = a + 1;
    return b->t > a->t ? (b->value[flange] - a->value[flange]) / (b->t - a->t) : 0.0;
}

static int gears_differ(const gm_schedule *s, const gm_schedule_row *a,
                        const gm_schedule_row *b)
{
    int differ = 0;
    for (int p = 0; p + 1 < s->n_flanges; p++)
        differ |= a->gear[p] != b->gear[p];
    return differ;
}

static int values_differ(const gm_schedule *s, const gm_schedule_row *a,
                         const gm_schedule_row *b)
{
    int differ = 0;
    for (int f = 0; f < s->n_flanges; f++)
        differ |= a->value[f] != b->value[f];
    return differ;
}

static int has_kink(const gm_schedule *s, int row)
{
    int kink = 0;
    for (int f = 0; f < s->n_flanges; f++)
        kink |= slope(s, row, f) != slope(s, row - 1, f);
    return kink;
}

/* Does row (not the first) continue what was before as if it were not there? */
static int is_plain(const gm_schedule *s, int row)
{
    const gm_schedule_row *before = &s->rows[row - 1], *here = &s->rows[row];
    return here->t > before->t && !gears_differ(s, before, here) && !has_kink(s, row) &&
           (row + 1 >= s->n_rows || s->rows[row + 1].t > here->t);
}

static int row_at(const gm_schedule *s, double t)
{
    int low = 0, high = s->n_rows - 1;
    while (low < high) {
        int middle = (low + high + 1) / 2;
        if (s->rows[middle].t <= t)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

static double enter(void *user, double t, int *jump)
{
    gm_schedule_reader *r = user;
    const gm_schedule *s = r->schedule;
    int from = r->row, row = row_at(s, t);
    *jump = 0;
    if (from >= 0 && from != row) {
        const gm_schedule_row *here = &s->rows[row];
        *jump = gears_differ(s, &s->rows[from], here) ||
                (here[-1].t == here->t && values_differ(s, here - 1, here));
    }
    r->row = row;
    for (int next = row + 1; next < s->n_rows; next++)
        if (!is_plain(s, next))
            return s->rows[next].t;
    return (double)INFINITY;
}

static void at(void *user, double t, gm_drive_point *point)
{
    const gm_schedule_reader *r = user;
    const gm_schedule *s = r->schedule;
    const gm_schedule_row *row = &s->rows[r->row];
    for (int f = 0; f < s->n_flanges; f++) {
        double rise = slope(s, r->row, f), value = row->value[f] + rise * (t - row->t);
        if (s->driven[f]) {
            point->speed[f] = value;
            point->acceleration[f] = rise;
        } else {
            point->input.torque[f] = value;
        }
    }
    for (int p = 0; p + 1 < s->n_flanges; p++)
        point->input.gear[p] = row->gear[p];
}

gm_drive gm_schedule_drive(gm_schedule_reader *reader)
{
    gm_drive drive = {.user = reader, .enter = enter, .at = at};
    for (int f = 0; f < reader->schedule->n_flanges; f++)
        drive.driven[f] = reader->schedule->driven[f];
    reader->row = -1;
    return drive;
}

/* ---- the start ---- */

static double given_speed(const gm_schedule *s, int f)
{
    return s->driven[f] ? s->rows[0].value[f] : s->start_speed[f];
}

/* Speed of the output: given, or that of the first engaged path with a given speed. */
static double output_speed(const gm_schedule *s, const gm_kinematics *k)
{
    double speed = given_speed(s, 0);
    for (int p = 0; p + 1 < s->n_flanges && isnan(speed); p++)
        if (k->ratio[p] != 0.0)
            speed = given_speed(s, 1 + p) / k->ratio[p];
    return isnan(speed) ? 0.0 : speed;
}

gm_status gm_schedule_start_speeds(const gm_schedule *s, const gm_plant *plant,
                                   double *speed, gm_error *error)
{
    gm_kinematics k = {.ratio = {0.0}};
    const gm_schedule_row *first = &s->rows[0];
    gm_status status = plant->is->kinematics(plant->self, first->gear, &k, error);
    if (status != GM_OK)
        return status;
    double found[GM_MAX_FLANGES] = {output_speed(s, &k)};
    for (int p = 0; p + 1 < s->n_flanges; p++) {
        double given = given_speed(s, 1 + p), turned = k.ratio[p] * found[0];
        found[1 + p] = isnan(given) ? turned : given;
        if (k.ratio[p] != 0.0 && fabs(found[1 + p] - turned) >
                                     SAME_SPEED * (fabs(turned) + fabs(found[1 + p])))
            return gm_fail(error, GM_ERR_MODEL,
                           "%s: %s starts with %.6g rpm, but in gear %d it turns with "
                           "%.6g rpm while the output turns with %.6g rpm",
                           s->file, plant->info.path[p].name, given / RPM, first->gear[p],
                           turned / RPM, found[0] / RPM);
    }
    for (int f = 0; f < s->n_flanges; f++)
        speed[f] = found[f];
    return GM_OK;
}
