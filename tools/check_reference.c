/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Every gear at one speed and torque of the input, side by side: losses by component,
 * frequencies at which teeth meet, and the largest load of each bearing.
 */
#include "check.h"

#include "base/alloc.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define RPM_PER_RAD_S 9.549296585513721 /* 60 / (2 pi) */
#define COLUMNS 8                       /* gears beside each other */

static int ascending(const void *a, const void *b)
{
    const int *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

static int all_gears(const gm_description *d, int *numbers)
{
    int n = 0;
    for (int p = 0; p < d->n_paths; p++)
        for (int g = 0; g < d->paths[p].n_gears; g++)
            numbers[n++] = d->paths[p].gears[g].number;
    qsort(numbers, (size_t)n, sizeof *numbers, ascending);
    return n;
}

static gm_status solve_all(const gm_gearset_file *file, double speed, double torque,
                           int n, const int *numbers, gm_checked_reference *c,
                           gm_error *error)
{
    gm_status status = GM_OK;
    for (int i = 0; i < n && status == GM_OK; i++) {
        const gm_point_request request = {numbers[i], 0, speed, torque};
        status = gm_check_point(file, &request, &c->points[i], error);
        c->n_points += status == GM_OK;
    }
    return status;
}

gm_status gm_check_reference(const gm_gearset_file *file, double speed, double torque,
                             gm_checked_reference *reference, gm_error *error)
{
    const gm_description *d = file->description;
    gm_checked_reference c = {.description = d, .speed = speed, .torque = torque};
    gm_status status = GM_OK;
    int n = 0;
    for (int p = 0; p < d->n_paths; p++)
        n += d->paths[p].n_gears;
    int *numbers = gm_calloc((size_t)n, sizeof *numbers);
    c.points = gm_calloc((size_t)n, sizeof *c.points);
    if (!numbers || !c.points)
        status = gm_fail(error, GM_ERR_MEMORY, "%s: out of memory", d->file);
    else
        status =
            solve_all(file, speed, torque, all_gears(d, numbers), numbers, &c, error);
    gm_free(numbers);
    if (status == GM_OK)
        *reference = c;
    else
        gm_checked_reference_clear(&c);
    return status;
}

void gm_checked_reference_clear(gm_checked_reference *reference)
{
    for (int i = 0; i < reference->n_points; i++)
        gm_checked_point_clear(&reference->points[i]);
    gm_free(reference->points);
    memset(reference, 0, sizeof *reference);
}

/* ---- tables with a column per gear ---- */

typedef struct columns {
    const gm_checked_point *first;
    int n;
} columns;

static void print_heading(const char *title, columns gears, FILE *out)
{
    fprintf(out, "\n%-24s", title);
    for (int i = 0; i < gears.n; i++)
        fprintf(out, " %8d", gears.first[i].request.gear);
    fputc('\n', out);
}

static void print_component(gm_loss_kind kind, columns gears, FILE *out)
{
    double sum = 0.0;
    for (int i = 0; i < gears.n; i++)
        sum += gm_checked_point_power(&gears.first[i], kind);
    if (sum == 0.0)
        return;
    fprintf(out, "  %-22s", gm_loss_kind_name(kind));
    for (int i = 0; i < gears.n; i++)
        fprintf(out, " %8.1f", gm_checked_point_power(&gears.first[i], kind));
    fputc('\n', out);
}

static void print_total(columns gears, FILE *out)
{
    fprintf(out, "  %-22s", "total");
    for (int i = 0; i < gears.n; i++)
        fprintf(out, " %8.1f", gears.first[i].loss);
    fprintf(out, "\n  %-24s", "at the input [N·m]"); /* · has two bytes and no width */
    for (int i = 0; i < gears.n; i++)
        fprintf(out, "%s%8.3f", i > 0 ? " " : "",
                gears.first[i].loss / fabs(gears.first[i].request.speed));
    fprintf(out, "\n  %-22s", "efficiency [%]");
    for (int i = 0; i < gears.n; i++)
        fprintf(out, " %8.2f", 100.0 * gm_checked_point_efficiency(&gears.first[i]));
    fputc('\n', out);
}

static void print_losses(columns gears, FILE *out)
{
    print_heading("loss [W] in gear", gears, out);
    for (int k = 0; k < GM_LOSS_KINDS; k++)
        print_component((gm_loss_kind)k, gears, out);
    print_total(gears, out);
}

static void print_frequencies(const gm_description *d, columns gears, FILE *out)
{
    print_heading("teeth meet [Hz] in gear", gears, out);
    for (int m = 0; m < d->n_meshes; m++) {
        const char *name = d->meshes[m].id.name;
        fprintf(out, "  %-22s", name);
        for (int i = 0; i < gears.n; i++) {
            const gm_checked_point *point = &gears.first[i];
            if (gm_checked_point_loads(point, name))
                fprintf(out, " %8.1f",
                        gm_checked_point_element(point, GM_LOSS_MESH, name)->frequency);
            else
                fprintf(out, " %8s", "-");
        }
        fputc('\n', out);
    }
}

/* ---- bearings: the worst of all gears ---- */

typedef struct worst {
    double load;
    int gear;
} worst;

static void print_worst(worst w, double unit, FILE *out)
{
    if (w.load > 0.0)
        fprintf(out, " %9.0f (%2d)", w.load * unit, w.gear);
    else
        fprintf(out, " %9s %4s", "-", "");
}

static void print_bearing(const gm_checked_reference *c, const char *name, FILE *out)
{
    worst radial = {0.0, 0}, axial = {0.0, 0}, speed = {0.0, 0};
    for (int i = 0; i < c->n_points; i++) {
        const gm_element_loss *e =
            gm_checked_point_element(&c->points[i], GM_LOSS_BEARING, name);
        int gear = c->points[i].request.gear;
        if (e && e->radial > radial.load)
            radial = (worst){e->radial, gear};
        if (e && e->axial > axial.load)
            axial = (worst){e->axial, gear};
        if (e && e->speed > speed.load)
            speed = (worst){e->speed, gear};
    }
    fprintf(out, "  %-22s", name);
    print_worst(radial, 1.0, out);
    print_worst(axial, 1.0, out);
    print_worst(speed, RPM_PER_RAD_S, out);
    fputc('\n', out);
}

static void print_bearings(const gm_checked_reference *c, FILE *out)
{
    fprintf(out, "\n%-24s %14s %14s %14s\n", "largest (in gear)", "radial [N]",
            "axial [N]", "speed [rpm]");
    for (int i = 0; i < c->description->n_bearings; i++)
        print_bearing(c, c->description->bearings[i].id.name, out);
}

void gm_checked_reference_print(const gm_checked_reference *reference, FILE *out)
{
    fprintf(out, "\nat %.0f rpm and %.1f N·m of the input%s:\n",
            reference->speed * RPM_PER_RAD_S, reference->torque,
            reference->description->n_paths > 1 ? ", other path free" : "");
    for (int i = 0; i < reference->n_points; i += COLUMNS) {
        int left = reference->n_points - i;
        columns gears = {&reference->points[i], left < COLUMNS ? left : COLUMNS};
        print_losses(gears, out);
        print_frequencies(reference->description, gears, out);
    }
    print_bearings(reference, out);
}

void gm_checked_reference_json(const gm_checked_reference *reference, gm_json *json)
{
    gm_json_array(json, "points");
    for (int i = 0; i < reference->n_points; i++)
        gm_checked_point_json(&reference->points[i], NULL, json);
    gm_json_end(json);
}
