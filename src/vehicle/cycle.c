/* SPDX-License-Identifier: BSD-2-Clause */
#include "vehicle/gm_cycle.h"

#include "base/alloc.h"
#include "vehicle/cycle_data.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define KM_H (1.0 / 3.6) /* m/s */

/* ---- making one ---- */

void gm_cycle_destroy(gm_cycle *cycle)
{
    if (!cycle)
        return;
    gm_free(cycle->time);
    gm_free(cycle->speed);
    gm_free(cycle->distance);
    gm_free(cycle->grade);
    gm_free(cycle->grade_sum);
    gm_free(cycle->gears);
    gm_free(cycle);
}

static gm_status check_points(int n, const double *time, const double *speed,
                              gm_error *error)
{
    if (n < 2)
        return gm_fail(error, GM_ERR_ARGUMENT, "a cycle needs two points, found %d", n);
    if (time[0] != 0.0)
        return gm_fail(error, GM_ERR_ARGUMENT, "a cycle starts at 0 s, found %g s",
                       time[0]);
    for (int i = 0; i < n; i++) {
        if (i > 0 && !(time[i] > time[i - 1]))
            return gm_fail(error, GM_ERR_ARGUMENT,
                           "times of a cycle increase; found %g s after %g s", time[i],
                           time[i - 1]);
        if (!(speed[i] >= 0.0 && isfinite(speed[i])))
            return gm_fail(error, GM_ERR_ARGUMENT,
                           "speeds of a cycle are not negative; found %g m/s at %g s",
                           speed[i], time[i]);
    }
    return GM_OK;
}

/* Integral by the points of what is linear between them. */
static void sum_up(int n, const double *time, const double *value, double *sum)
{
    sum[0] = 0.0;
    for (int i = 1; i < n; i++)
        sum[i] = sum[i - 1] + 0.5 * (value[i] + value[i - 1]) * (time[i] - time[i - 1]);
}

static int allocate(gm_cycle *c, int n, int n_gears)
{
    c->time = gm_calloc((size_t)n, sizeof *c->time);
    c->speed = gm_calloc((size_t)n, sizeof *c->speed);
    c->distance = gm_calloc((size_t)n, sizeof *c->distance);
    c->gears = gm_calloc((size_t)(n_gears > 0 ? n_gears : 1), sizeof *c->gears);
    return c->time && c->speed && c->distance && c->gears;
}

gm_status gm_cycle_create(const char *name, int n, const double *time,
                          const double *speed, int n_gears, const gm_cycle_gear *gears,
                          gm_cycle **cycle, gm_error *error)
{
    gm_status status = check_points(n, time, speed, error);
    if (status != GM_OK)
        return status;
    gm_cycle *c = gm_calloc(1, sizeof *c);
    if (!c || !allocate(c, n, n_gears)) {
        gm_cycle_destroy(c);
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    }
    (void)snprintf(c->name, sizeof c->name, "%s", name);
    c->n = n;
    c->n_gears = n_gears;
    memcpy(c->time, time, (size_t)n * sizeof *time);
    memcpy(c->speed, speed, (size_t)n * sizeof *speed);
    if (n_gears > 0)
        memcpy(c->gears, gears, (size_t)n_gears * sizeof *gears);
    sum_up(n, time, speed, c->distance);
    *cycle = c;
    return GM_OK;
}

gm_status gm_cycle_set_grade(gm_cycle *cycle, const double *grade, gm_error *error)
{
    size_t n = (size_t)cycle->n;
    double *copy = gm_calloc(n, sizeof *copy), *sum = gm_calloc(n, sizeof *sum);
    if (!copy || !sum) {
        gm_free(copy);
        gm_free(sum);
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    }
    memcpy(copy, grade, n * sizeof *copy);
    sum_up(cycle->n, cycle->time, grade, sum);
    cycle->grade = copy;
    cycle->grade_sum = sum;
    return GM_OK;
}

/* ---- the built-in ones ---- */

enum { MAX_PARTS = 5 };

/* A cycle made of parts that follow each other: ECE-15 some times, EUDC or not. */
typedef struct recipe {
    const char *name;
    int n_urban, n_extra_urban;
} recipe;

static const recipe recipes[] = {
    {"ece15", 1, 0}, {"urban", 4, 0}, {"eudc", 0, 1}, {"nedc", 4, 1}};

/* Points and gears while a cycle is put together. */
typedef struct assembly {
    int n, n_gears;
    double time[MAX_PARTS * GM_ECE15_POINTS], speed[MAX_PARTS * GM_ECE15_POINTS];
    gm_cycle_gear gears[MAX_PARTS * GM_EUDC_GEARS];
} assembly;

static void append(assembly *a, const gm_trace_point *points, int n,
                   const gm_trace_gear *gears, int n_gears)
{
    double start = a->n > 0 ? a->time[a->n - 1] : 0.0;
    for (int i = a->n > 0; i < n; i++) { /* a part begins where the last one ends */
        a->time[a->n] = start + points[i].time;
        a->speed[a->n++] = points[i].speed * KM_H;
    }
    for (int i = 0; i < n_gears; i++)
        a->gears[a->n_gears++] = (gm_cycle_gear){start + gears[i].time, gears[i].gear};
}

static gm_status cook(const recipe *r, gm_cycle **cycle, gm_error *error)
{
    assembly a = {.n = 0};
    for (int i = 0; i < r->n_urban; i++)
        append(&a, gm_ece15, GM_ECE15_POINTS, gm_ece15_gears, GM_ECE15_GEARS);
    for (int i = 0; i < r->n_extra_urban; i++)
        append(&a, gm_eudc, GM_EUDC_POINTS, gm_eudc_gears, GM_EUDC_GEARS);
    return gm_cycle_create(r->name, a.n, a.time, a.speed, a.n_gears, a.gears, cycle,
                           error);
}

static gm_status wltc(gm_cycle **cycle, gm_error *error)
{
    double time[GM_WLTC_SAMPLES], speed[GM_WLTC_SAMPLES];
    for (int i = 0; i < GM_WLTC_SAMPLES; i++) {
        time[i] = i;
        speed[i] = 0.1 * gm_wltc_class3b[i] * KM_H;
    }
    return gm_cycle_create("wltc3b", GM_WLTC_SAMPLES, time, speed, 0, NULL, cycle, error);
}

gm_status gm_cycle_named(const char *name, gm_cycle **cycle, gm_error *error)
{
    for (size_t i = 0; i < sizeof recipes / sizeof recipes[0]; i++)
        if (strcmp(recipes[i].name, name) == 0)
            return cook(&recipes[i], cycle, error);
    if (strcmp(name, "wltc3b") == 0)
        return wltc(cycle, error);
    return gm_fail(
        error, GM_ERR_ARGUMENT,
        "there is no cycle '%s'; there are ece15, urban, eudc, nedc and wltc3b", name);
}

/* ---- reading one ---- */

double gm_cycle_duration(const gm_cycle *cycle)
{
    return cycle->time[cycle->n - 1];
}

double gm_cycle_distance(const gm_cycle *cycle)
{
    return cycle->distance[cycle->n - 1];
}

/* Index i with time[i] <= t < time[i + 1], t inside the trace. */
static int interval(const gm_cycle *c, double t)
{
    int low = 0, high = c->n - 1;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (c->time[middle] <= t)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Integral of a curve of the trace itself, and its value. */
static double trace(const gm_cycle *c, const double *curve, const double *sum, double t,
                    double *value)
{
    double inside = fmin(fmax(t, 0.0), gm_cycle_duration(c));
    int i = interval(c, inside);
    double dt = inside - c->time[i];
    double slope = (curve[i + 1] - curve[i]) / (c->time[i + 1] - c->time[i]);
    *value = curve[i] + slope * dt;
    return sum[i] + (curve[i] + 0.5 * slope * dt) * dt + *value * (t - inside);
}

/* Moving average, and its derivative. */
static double smooth(const gm_cycle *c, const double *curve, const double *sum, double t,
                     double *rate)
{
    double before, after;
    double s0 = trace(c, curve, sum, t - 0.5 * GM_CYCLE_SMOOTHING, &before);
    double s1 = trace(c, curve, sum, t + 0.5 * GM_CYCLE_SMOOTHING, &after);
    *rate = (after - before) / GM_CYCLE_SMOOTHING;
    return (s1 - s0) / GM_CYCLE_SMOOTHING;
}

double gm_cycle_speed(const gm_cycle *cycle, double t, double *acceleration)
{
    return smooth(cycle, cycle->speed, cycle->distance, t, acceleration);
}

double gm_cycle_grade(const gm_cycle *cycle, double t)
{
    double rate;
    return cycle->grade ? smooth(cycle, cycle->grade, cycle->grade_sum, t, &rate) : 0.0;
}

/* First time of the trace after t. */
static double next_point(const gm_cycle *c, double t)
{
    if (t < 0.0)
        return 0.0;
    if (t >= gm_cycle_duration(c))
        return (double)INFINITY;
    return c->time[interval(c, t) + 1];
}

double gm_cycle_next(const gm_cycle *cycle, double t)
{
    const double half = 0.5 * GM_CYCLE_SMOOTHING;
    return fmin(next_point(cycle, t + half) - half, next_point(cycle, t - half) + half);
}
