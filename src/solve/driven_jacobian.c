/* SPDX-License-Identifier: BSD-2-Clause */
#include "solve/driven_jacobian.h"

#include "base/alloc.h"
#include "base/linear.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* ---- pattern ---- */

/* One driven flange more: where its torque reaches, the row of its speed comes in. */
static void spread(const gm_driven *d, int flange, char *used)
{
    size_t n = (size_t)d->n, s = (size_t)d->speed_state[flange];
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < n && used[j * n + s]; i++)
            used[j * n + i] |= d->column[flange][i] != 0.0;
}

/* used[column][row] of the plant's own entries in start and row. */
static void mark(const gm_driven *d, const int *start, const int *row, char *used)
{
    size_t n = (size_t)d->n;
    if (!d->is->jacobian)
        memset(used, 1, n * n);
    for (size_t j = 0; j < n; j++) {
        used[j * n + j] = 1;
        for (int k = start[j]; k < start[j + 1]; k++)
            used[j * n + (size_t)row[k]] = 1;
    }
    for (int f = 0; f < d->n_driven; f++)
        spread(d, f, used);
}

static int find(const gm_driven *d, int column, int row)
{
    for (int k = d->column_start[column]; k < d->column_start[column + 1]; k++)
        if (d->row[k] == row)
            return k;
    return -1;
}

static int compress(gm_driven *d, const char *used)
{
    size_t n = (size_t)d->n, entries = 0;
    for (size_t k = 0; k < n * n; k++)
        entries += used[k] != 0;
    d->column_start = gm_calloc(n + 1, sizeof *d->column_start);
    d->row = gm_calloc(entries, sizeof *d->row);
    if (!d->column_start || !d->row)
        return 1;
    int k = 0;
    for (int j = 0; j < d->n; j++) {
        for (int i = 0; i < d->n; i++)
            if (used[(size_t)j * n + (size_t)i])
                d->row[k++] = i;
        d->column_start[j + 1] = k;
    }
    return 0;
}

static int make_pattern(gm_driven *d, int *start, int *row, char *used)
{
    if (!start || !row || !used || !d->place || !d->plant_value || !d->typical ||
        !d->x_moved || !d->dx_moved)
        return 1;
    if (d->is->jacobian)
        d->is->pattern(d->motion, start, row);
    mark(d, start, row, used);
    if (compress(d, used))
        return 1;
    for (int j = 0; j < d->n; j++)
        for (int k = start[j]; k < start[j + 1]; k++)
            d->place[k] = find(d, j, row[k]);
    d->is->tolerances(d->motion, 1.0, d->typical);
    return 0;
}

int gm_driven_pattern(gm_driven *d)
{
    size_t n = (size_t)d->n;
    size_t entries = d->is->jacobian ? (size_t)d->is->entries(d->motion) : 0;
    int *start = gm_calloc(n + 1, sizeof *start), *row = gm_calloc(entries, sizeof *row);
    char *used = gm_calloc(n * n, 1);
    d->place = gm_calloc(entries, sizeof *d->place);
    d->plant_value = gm_calloc(entries, sizeof *d->plant_value);
    d->typical = gm_calloc(n, sizeof *d->typical);
    d->x_moved = gm_calloc(n, sizeof *d->x_moved);
    d->dx_moved = gm_calloc(n, sizeof *d->dx_moved);
    int missing = make_pattern(d, start, row, used);
    gm_free(start);
    gm_free(row);
    gm_free(used);
    return missing;
}

void gm_driven_pattern_free(gm_driven *d)
{
    gm_free(d->column_start);
    gm_free(d->row);
    gm_free(d->place);
    gm_free(d->plant_value);
    gm_free(d->typical);
    gm_free(d->x_moved);
    gm_free(d->dx_moved);
}

/* ---- values ---- */

/* Column j of - B B_s^-1 J_s is added; its rows s come to zero. */
static void hold_speeds(const gm_driven *d, int j, double *value)
{
    double m[GM_MAX_FLANGES];
    int entry[GM_MAX_FLANGES], any = 0;
    for (int f = 0; f < d->n_driven; f++) {
        entry[f] = find(d, j, d->speed_state[f]);
        m[f] = entry[f] >= 0 ? -value[entry[f]] : 0.0;
        any |= m[f] != 0.0;
    }
    if (!any)
        return;
    gm_lu_solve(d->n_driven, d->lu, d->pivot, m);
    for (int k = d->column_start[j]; k < d->column_start[j + 1]; k++)
        for (int f = 0; f < d->n_driven; f++)
            value[k] += d->column[f][d->row[k]] * m[f];
    for (int f = 0; f < d->n_driven; f++)
        if (entry[f] >= 0)
            value[entry[f]] = 0.0;
}

int gm_driven_jacobian(gm_driven *d, const double *x, double *value)
{
    int entries = d->is->entries(d->motion);
    int flag = d->is->jacobian(d->motion, &d->input, x, d->plant_value);
    if (flag)
        return flag;
    memset(value, 0, (size_t)d->column_start[d->n] * sizeof *value);
    for (int k = 0; k < entries; k++)
        value[d->place[k]] += d->plant_value[k];
    for (int j = 0; j < d->n && d->n_driven > 0; j++)
        hold_speeds(d, j, value);
    return 0;
}

int gm_driven_differences(gm_driven *d, gm_driven_rates *rates, double t, const double *x,
                          double *value)
{
    size_t n = (size_t)d->n;
    int flag = rates(d, t, x, d->dx);
    memcpy(d->x_moved, x, n * sizeof *x);
    for (size_t j = 0; j < n && flag == 0; j++) {
        d->x_moved[j] += sqrt(DBL_EPSILON) * fmax(fabs(x[j]), d->typical[j]);
        double moved = d->x_moved[j] - x[j];
        flag = rates(d, t, d->x_moved, d->dx_moved);
        for (size_t i = 0; i < n; i++)
            value[j * n + i] = (d->dx_moved[i] - d->dx[i]) / moved;
        d->x_moved[j] = x[j];
    }
    return flag;
}
