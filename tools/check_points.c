/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Many operating points at once: a table in, the losses of each by component out.
 */
#include "check.h"

#include "base/alloc.h"
#include "base/csv.h"

#include <math.h>
#include <string.h>

#define RPM_PER_RAD_S 9.549296585513721 /* 60 / (2 pi) */

enum { GEAR, SPEED, TORQUE, PRESELECTED, N_COLUMNS };
static const char *const columns[N_COLUMNS] = {"gear", "speed_rpm", "torque_Nm",
                                               "preselected"};

static gm_status read_gear(const gm_csv *csv, int i, double value, int *gear,
                           gm_error *error)
{
    if (value != rint(value) || fabs(value) > 99.0)
        return gm_csv_wrong(csv, i, "the number of a gear", error);
    *gear = (int)value;
    return GM_OK;
}

static gm_status read_cell(const gm_csv *csv, int i, gm_point_request *request,
                           gm_error *error)
{
    double value = 0.0;
    gm_status status = gm_csv_number(csv, i, &value, error);
    if (status != GM_OK)
        return status;
    switch (gm_csv_column(csv, i)) {
    case GEAR:
        return value == 0.0 ? gm_csv_wrong(csv, i, "a gear other than 0", error)
                            : read_gear(csv, i, value, &request->gear, error);
    case SPEED:
        request->speed = value / RPM_PER_RAD_S;
        return value == 0.0 ? gm_csv_wrong(csv, i, "a speed other than 0", error) : GM_OK;
    case TORQUE:
        request->torque = value;
        return GM_OK;
    default:
        return read_gear(csv, i, value, &request->preselected, error);
    }
}

static gm_status read_row(const gm_csv *csv, gm_point_request *request, gm_error *error)
{
    gm_status status = GM_OK;
    *request = (gm_point_request){0};
    for (int i = 0; i < gm_csv_n_columns(csv) && status == GM_OK; i++)
        status = read_cell(csv, i, request, error);
    return status;
}

static gm_status solve(const gm_gearset_file *file, const gm_point_request *request,
                       gm_point_losses *losses, gm_error *error)
{
    gm_checked_point point;
    gm_status status = gm_check_point(file, request, &point, error);
    if (status != GM_OK)
        return status;
    losses->request = *request;
    losses->output_speed = point.output_speed;
    losses->output_torque = point.output_torque;
    losses->loss = point.loss;
    losses->efficiency = gm_checked_point_efficiency(&point);
    for (int k = 0; k < GM_LOSS_KINDS; k++)
        losses->power[k] = gm_checked_point_power(&point, (gm_loss_kind)k);
    gm_checked_point_clear(&point);
    return GM_OK;
}

/* Room grows to the next power of two. */
static gm_status add(gm_checked_points *points, const gm_point_losses *losses,
                     gm_error *error)
{
    const int n = points->n;
    if ((n & (n - 1)) == 0) {
        gm_point_losses *grown =
            gm_resize(points->point, n ? 2 * (size_t)n : 1, sizeof *grown);
        if (!grown)
            return gm_fail(error, GM_ERR_MEMORY, "out of memory");
        points->point = grown;
    }
    points->point[points->n++] = *losses;
    return GM_OK;
}

static gm_status read_header(gm_csv *csv, const char *table, gm_error *error)
{
    gm_status status =
        gm_csv_read_header(csv, columns, N_COLUMNS, "gear, speed_rpm, torque_Nm", error);
    for (int c = 0; c < PRESELECTED && status == GM_OK; c++)
        if (!gm_csv_has(csv, c))
            status = gm_fail(error, GM_ERR_FORMAT, "%s: the column %s is missing", table,
                             columns[c]);
    return status;
}

static gm_status solve_all(const gm_gearset_file *file, gm_csv *csv,
                           gm_checked_points *points, gm_error *error)
{
    for (;;) {
        bool more = false;
        gm_point_request request;
        gm_point_losses losses;
        gm_status status = gm_csv_read_row(csv, &more, error);
        if (status != GM_OK || !more)
            return status;
        status = read_row(csv, &request, error);
        if (status == GM_OK)
            status = solve(file, &request, &losses, error);
        if (status == GM_OK)
            status = add(points, &losses, error);
        if (status != GM_OK)
            return status;
    }
}

gm_status gm_check_points(const gm_gearset_file *file, const char *table,
                          gm_checked_points *points, gm_error *error)
{
    gm_csv *csv = NULL;
    gm_checked_points made = {0};
    gm_status status = gm_csv_open(table, &csv, error);
    if (status == GM_OK)
        status = read_header(csv, table, error);
    if (status == GM_OK)
        status = solve_all(file, csv, &made, error);
    gm_csv_close(csv);
    if (status == GM_OK)
        *points = made;
    else
        gm_checked_points_clear(&made);
    return status;
}

void gm_checked_points_clear(gm_checked_points *points)
{
    gm_free(points->point);
    memset(points, 0, sizeof *points);
}

/* "open synchronisers" as a column: open_synchronisers_W */
static void print_column(int kind, FILE *out)
{
    fputc(',', out);
    for (const char *c = gm_loss_kind_name((gm_loss_kind)kind); *c != '\0'; c++)
        fputc(*c == ' ' ? '_' : *c, out);
    fputs("_W", out);
}

void gm_checked_points_print(const gm_checked_points *points, FILE *out)
{
    fputs("gear,speed_rpm,torque_Nm,preselected,output_speed_rpm,output_torque_Nm,loss_W,"
          "efficiency",
          out);
    for (int k = 0; k < GM_LOSS_KINDS; k++)
        print_column(k, out);
    fputc('\n', out);
    for (int i = 0; i < points->n; i++) {
        const gm_point_losses *p = &points->point[i];
        fprintf(out, "%d,%.9g,%.9g,%d,%.9g,%.9g,%.9g,", p->request.gear,
                p->request.speed * RPM_PER_RAD_S, p->request.torque,
                p->request.preselected, p->output_speed * RPM_PER_RAD_S,
                -p->output_torque, p->loss);
        if (!isnan(p->efficiency))
            fprintf(out, "%.9g", p->efficiency);
        for (int k = 0; k < GM_LOSS_KINDS; k++)
            fprintf(out, ",%.9g", p->power[k]);
        fputc('\n', out);
    }
}

static void losses_json(const gm_point_losses *p, gm_json *json)
{
    gm_json_object(json, NULL);
    gm_json_integer(json, "gear", p->request.gear);
    gm_json_integer(json, "preselected", p->request.preselected);
    gm_json_number(json, "speed_rpm", p->request.speed * RPM_PER_RAD_S);
    gm_json_number(json, "torque_Nm", p->request.torque);
    gm_json_number(json, "output_speed_rpm", p->output_speed * RPM_PER_RAD_S);
    gm_json_number(json, "output_torque_Nm", -p->output_torque);
    gm_json_number(json, "loss_W", p->loss);
    gm_json_number(json, "efficiency", p->efficiency);
    gm_json_object(json, "components_W");
    for (int k = 0; k < GM_LOSS_KINDS; k++)
        gm_json_number(json, gm_loss_kind_name((gm_loss_kind)k), p->power[k]);
    gm_json_end(json);
    gm_json_end(json);
}

void gm_checked_points_json(const gm_checked_points *points, gm_json *json)
{
    gm_json_array(json, "points");
    for (int i = 0; i < points->n; i++)
        losses_json(&points->point[i], json);
    gm_json_end(json);
}
