/* SPDX-License-Identifier: BSD-2-Clause */
#include "vehicle/trip_jacobian.h"

#include "base/alloc.h"

#include <math.h>
#include <string.h>

/* ---- pattern ---- */

static int own_entries(const gm_trip *trip)
{
    return trip->is->jacobian ? trip->is->entries(trip->motion)
                              : trip->n_gearset * trip->n_gearset;
}

static int allocate(gm_trip *trip)
{
    size_t n = (size_t)trip->n, m = (size_t)trip->n_gearset;
    size_t entries = (size_t)own_entries(trip);
    trip->place = gm_calloc(n * n, sizeof *trip->place);
    trip->column_start = gm_calloc(n + 1, sizeof *trip->column_start);
    trip->own_start = gm_calloc(m + 1, sizeof *trip->own_start);
    trip->own_row = gm_calloc(entries, sizeof *trip->own_row);
    trip->own_value = gm_calloc(entries, sizeof *trip->own_value);
    trip->column = gm_calloc(m, sizeof *trip->column);
    trip->typical = gm_calloc(m, sizeof *trip->typical);
    trip->moved = gm_calloc(m, sizeof *trip->moved);
    trip->now = gm_calloc(m, sizeof *trip->now);
    trip->then = gm_calloc(m, sizeof *trip->then);
    return trip->place && trip->column_start && trip->own_start && trip->own_row &&
           trip->own_value && trip->column && trip->typical && trip->moved && trip->now &&
           trip->then;
}

void gm_trip_pattern_free(gm_trip *trip)
{
    gm_free(trip->place);
    gm_free(trip->column_start);
    gm_free(trip->row);
    gm_free(trip->own_start);
    gm_free(trip->own_row);
    gm_free(trip->own_value);
    gm_free(trip->column);
    gm_free(trip->typical);
    gm_free(trip->moved);
    gm_free(trip->now);
    gm_free(trip->then);
}

static void own_pattern(gm_trip *trip)
{
    int m = trip->n_gearset;
    if (trip->is->jacobian) {
        trip->is->pattern(trip->motion, trip->own_start, trip->own_row);
        return;
    }
    for (int k = 0; k <= m; k++)
        trip->own_start[k] = k * m;
    for (int i = 0; i < m * m; i++)
        trip->own_row[i] = i % m;
}

/* State that column k of the car's derivatives stands for. */
static int state_of_column(const gm_trip *trip, int k)
{
    return k < GM_CAR_DYNAMIC ? k : trip->speed_state[k - GM_CAR_DYNAMIC];
}

static int n_columns(const gm_trip *trip)
{
    return GM_CAR_DYNAMIC + 1 + trip->parts.gearset->n_paths;
}

static int *at(gm_trip *trip, int row, int column)
{
    return &trip->place[column * trip->n + row];
}

/* Rows of the gearset that a flange's torque acts on. */
static void torque_rows(const gm_trip *trip, int flange, int *first, int *end)
{
    const gm_dynamics_class *is = trip->is;
    *first = is->torque_row ? is->torque_row(trip->motion, flange) : 0;
    *end = is->torque_row ? *first + 1 : trip->n_gearset;
}

static void mark_torque(gm_trip *trip, int flange, int column)
{
    int first, end;
    torque_rows(trip, flange, &first, &end);
    for (int i = first; i < end; i++)
        *at(trip, GM_CAR_STATES + i, column) = 1;
}

/* First 1 where an entry may be, later its place. */
static void mark(gm_trip *trip)
{
    for (int i = 0; i < trip->n; i++)
        *at(trip, i, i) = 1;
    for (int k = 0; k < n_columns(trip); k++) {
        int column = state_of_column(trip, k);
        for (int i = 0; i < GM_CAR_DYNAMIC; i++)
            if (gm_car_rate_columns(i) >> k & 1u)
                *at(trip, i, column) = 1;
        for (int f = 0; f <= trip->parts.gearset->n_paths; f++)
            if (gm_car_torque_columns(f) >> k & 1u)
                mark_torque(trip, f, column);
    }
    for (int k = 0; k < trip->n_gearset; k++)
        for (int e = trip->own_start[k]; e < trip->own_start[k + 1]; e++)
            *at(trip, GM_CAR_STATES + trip->own_row[e], GM_CAR_STATES + k) = 1;
}

int gm_trip_pattern(gm_trip *trip)
{
    if (!allocate(trip))
        return 1;
    own_pattern(trip);
    mark(trip);
    int entries = 0, n = trip->n;
    for (int i = 0; i < n * n; i++)
        entries += trip->place[i];
    trip->row = gm_calloc((size_t)entries, sizeof *trip->row);
    if (!trip->row)
        return 1;
    entries = 0;
    for (int column = 0; column < n; column++) {
        trip->column_start[column] = entries;
        for (int i = 0; i < n; i++)
            if (*at(trip, i, column)) {
                *at(trip, i, column) = entries;
                trip->row[entries++] = i;
            }
    }
    trip->column_start[n] = entries;
    return 0;
}

/* ---- values ---- */

/* One-sided differences over a step that rounding and curvature share. */
static int own_differences(gm_trip *trip, const double *x)
{
    int m = trip->n_gearset;
    size_t size = (size_t)m * sizeof *x;
    trip->is->tolerances(trip->motion, 1.0, trip->typical);
    int flag = trip->is->rates(trip->motion, &trip->input, x, trip->now);
    memcpy(trip->moved, x, size);
    for (int k = 0; k < m && flag == 0; k++) {
        double h = 1e-7 * fmax(fabs(x[k]), trip->typical[k]);
        trip->moved[k] = x[k] + h;
        flag = trip->is->rates(trip->motion, &trip->input, trip->moved, trip->then);
        for (int i = 0; i < m; i++)
            trip->own_value[k * m + i] = (trip->then[i] - trip->now[i]) / h;
        trip->moved[k] = x[k];
    }
    return flag;
}

static int add_own(gm_trip *trip, const double *x, double *value)
{
    const double *own = x + GM_CAR_STATES;
    int flag = trip->is->jacobian
                   ? trip->is->jacobian(trip->motion, &trip->input, own, trip->own_value)
                   : own_differences(trip, x + GM_CAR_STATES);
    for (int k = 0; k < trip->n_gearset && flag == 0; k++)
        for (int e = trip->own_start[k]; e < trip->own_start[k + 1]; e++)
            value[*at(trip, GM_CAR_STATES + trip->own_row[e], GM_CAR_STATES + k)] +=
                trip->own_value[e];
    return flag;
}

static int add_torques(gm_trip *trip, const gm_car_point *point, const double *x,
                       double *value)
{
    int flag = 0;
    for (int f = 0; f <= trip->parts.gearset->n_paths && flag == 0; f++) {
        double by[GM_CAR_COLUMNS];
        gm_car_torque_by(&trip->parts, point, f, by);
        flag = trip->is->torque_column(trip->motion, &trip->input, x + GM_CAR_STATES, f,
                                       trip->column);
        int first, end;
        torque_rows(trip, f, &first, &end);
        for (int k = 0; k < n_columns(trip) && flag == 0; k++)
            for (int i = first; i < end && gm_car_torque_columns(f) >> k & 1u; i++)
                value[*at(trip, GM_CAR_STATES + i, state_of_column(trip, k))] +=
                    trip->column[i] * by[k];
    }
    return flag;
}

int gm_trip_jacobian(gm_trip *trip, const gm_car_point *point, const double *x,
                     double *value)
{
    double by[GM_CAR_DYNAMIC][GM_CAR_COLUMNS];
    memset(value, 0, (size_t)trip->column_start[trip->n] * sizeof *value);
    gm_car_rates_by(&trip->parts, point, by);
    for (int i = 0; i < GM_CAR_DYNAMIC; i++)
        for (int k = 0; k < n_columns(trip); k++)
            if (gm_car_rate_columns(i) >> k & 1u)
                value[*at(trip, i, state_of_column(trip, k))] += by[i][k];
    int flag = add_own(trip, x, value);
    return flag ? flag : add_torques(trip, point, x, value);
}
