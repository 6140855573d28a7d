/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/rig_ramp.h"

#include "base/linear.h"
#include "sweep/rig_parts.h"

#include <math.h>
#include <string.h>

/* Samples of one ramp, of which the outer quarters are left out: vibrations after the
   change of slope. */
enum { SAMPLES = 80, FIRST = SAMPLES / 4, LAST = SAMPLES - SAMPLES / 4 };
/* Torque of a ramp as share of the largest, and how far it goes as share of the range,
   never through zero. */
static const double ramp_torque = 0.2, ramp_range = 0.2;
/* A ramp lasts this many periods at least: vibrations are over after one. */
enum { LEAST_PERIODS = 8 };

typedef struct ramp {
    gm_rig_run *r;
    const gm_rig_target *target;
    int flange;
    gm_rig_command still;         /* commands that hold the speed */
    double middle;                /* rad/s */
    double time;                  /* s, of a full ramp */
    double slope;                 /* rad/s2 where speed is taken, else N.m */
    double along[GM_MAX_FLANGES]; /* speed of each flange for that of the ramped one */
    double torque[SAMPLES + 1], speed[SAMPLES + 1];
} ramp;

static int by_speed(const ramp *p)
{
    return p->r->rig->drive[p->flange] == GM_RIG_SPEED_IN;
}

static double seen_torque(const ramp *p)
{
    const gm_rig_run *r = p->r;
    double sum = 0.0;
    for (int f = 0; f <= r->rig->n_paths; f++)
        sum += p->along[f] * (r->rig->drive[f] == GM_RIG_TORQUE_IN ? r->command.value[f]
                                                                   : r->mean_torque[f]);
    return sum;
}

static double seen_speed(const ramp *p)
{
    return by_speed(p) ? p->r->command.value[p->flange] : p->r->seen.speed[p->flange];
}

/* All that take speeds and turn with the flange go along. */
static void set_speed(const ramp *p, double speed, gm_rig_command *next)
{
    for (int f = 0; f <= p->r->rig->n_paths; f++)
        if (p->r->rig->drive[f] == GM_RIG_SPEED_IN)
            next->value[f] = p->still.value[f] + p->along[f] * (speed - p->middle);
}

/* One ramp of n samples, up (+1) or down (-1); what is seen goes into the arrays. */
static gm_status leg(ramp *p, double sign, int n, gm_error *error)
{
    double dt = p->time / SAMPLES;
    double from = seen_speed(p);
    for (int k = 0; k <= n; k++) {
        if (k > 0) {
            gm_rig_command next = p->still;
            if (by_speed(p))
                set_speed(p, from + sign * p->slope * dt * k, &next);
            else
                next.value[p->flange] += sign * p->slope;
            gm_status status = gm_rig_run_go(p->r, &next, dt, 1.0, error);
            if (status != GM_OK)
                return status;
        }
        p->torque[k] = seen_torque(p);
        p->speed[k] = seen_speed(p);
    }
    return GM_OK;
}

/* Parabola c0 + c1 s + c2 s^2 through y over the samples in the middle, s = -1 to 1. */
static void fit(const double *y, double c[3])
{
    double a[9] = {0.0}, b[3] = {0.0};
    int pivot[3];
    for (int k = FIRST; k <= LAST; k++) {
        double s = 2.0 * (k - FIRST) / (LAST - FIRST) - 1.0;
        double power[3] = {1.0, s, s * s};
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++)
                a[3 * i + j] += power[i] * power[j];
            b[i] += power[i] * y[k];
        }
    }
    (void)gm_lu_factor(3, a, pivot);
    gm_lu_solve(3, a, pivot, b);
    memcpy(c, b, sizeof b);
}

/* Torque and acceleration where the ramp passes the middle speed. */
static gm_status pass(const ramp *p, double *torque, double *acceleration,
                      gm_error *error)
{
    double w[3], t[3], s = 0.0;
    fit(p->speed, w);
    fit(p->torque, t);
    for (int i = 0; i < 20; i++)
        s -= (w[0] + s * (w[1] + s * w[2]) - p->middle) / (w[1] + 2.0 * s * w[2]);
    if (!(fabs(s) <= 1.0))
        return gm_fail(error, GM_ERR_SOLVE,
                       "gears (%d, %d): a ramp of %g s at flange %d does not pass %g "
                       "rad/s: the loss "
                       "changes faster; a shorter ramp time does",
                       p->still.gear[0], p->still.gear[1], p->time, p->flange, p->middle);
    *torque = t[0] + s * (t[1] + s * t[2]);
    *acceleration = (w[1] + 2.0 * s * w[2]) / (0.5 * (LAST - FIRST) * p->time / SAMPLES);
    return GM_OK;
}

/* Where two ramps pass the same speed. */
typedef struct passing {
    double torque[2], acceleration[2]; /* down, up */
} passing;

static gm_status run_ramps(ramp *p, passing *at, gm_error *error)
{
    static const double sign[] = {1.0, -1.0, 1.0, -1.0};
    static const int part[] = {2, 1, 1, 2};
    gm_status status = GM_OK;
    for (int i = 0; i < 4 && status == GM_OK; i++) {
        status = leg(p, sign[i], SAMPLES / part[i], error);
        if (status == GM_OK && part[i] == 1)
            status = pass(p, &at->torque[i - 1], &at->acceleration[i - 1], error);
    }
    return status;
}

static double inertia_of(const ramp *p, const passing *at)
{
    (void)p;
    return (at->torque[1] - at->torque[0]) / (at->acceleration[1] - at->acceleration[0]);
}

/* The sum of torques at constant speed, less those that the others give. */
static double torque_of(const ramp *p, const passing *at)
{
    double sum = at->torque[0] - at->acceleration[0] * inertia_of(p, at);
    for (int f = 0; f <= p->r->rig->n_paths; f++)
        if (f != p->flange)
            sum -= p->along[f] * p->still.value[f];
    return sum;
}

/* Which torque turns the flange by its range in the time: from the answer to the pulse,
   else two per cent of a second's worth. */
static double expected_inertia(const gm_rig_run *r, int f)
{
    double column[GM_RIG_HOLDS] = {0.0};
    for (int i = 0; i < r->n_holds; i++)
        if (r->hold[i].flange == f && r->hold[i].kind == GM_HOLD_SPEED) {
            column[i] = 1.0;
            gm_lu_solve(r->n_holds, r->g, r->pivot, column);
            return fabs(column[i]);
        }
    return 0.0;
}

static void set_along(ramp *p)
{
    const gm_rig_target *t = p->target;
    double own = p->flange == 0 ? 1.0 : t->ratio[p->flange - 1];
    int turns_alone = p->flange > 0 && t->point.gear[p->flange - 1] == 0;
    p->along[p->flange] = 1.0;
    if (turns_alone)
        return;
    p->along[0] = 1.0 / own;
    for (int q = 0; q < p->r->rig->n_paths; q++)
        if (t->point.gear[q] != 0)
            p->along[1 + q] = t->ratio[q] / own;
}

static void choose(ramp *p, double time)
{
    const gm_rig_run *r = p->r;
    double scale = p->flange == 0 ? r->ratio_max : 1.0;
    set_along(p);
    double range = fmin(ramp_range * r->scales.speed / scale, 0.8 * fabs(p->middle));
    double most = ramp_torque * r->scales.torque * scale;
    double least = LEAST_PERIODS * r->period;
    if (by_speed(p)) {
        p->time = fmax(time > 0.0 ? time : 0.5, least);
        p->slope = range / p->time;
        return;
    }
    double inertia = expected_inertia(r, p->flange);
    p->time = time > 0.0 ? time : fmax(inertia * range / most, least);
    p->slope = fmin(most, inertia * range / p->time);
}

/* Hold, ramp, and again at half the rate: two values of what a pair of ramps tells. */
static gm_status ramp_twice(ramp *p, double time,
                            double (*told)(const ramp *p, const passing *at),
                            gm_rig_found *found, double value[2], gm_error *error)
{
    gm_rig_run *run = p->r;
    gm_status status = GM_OK;
    for (int i = 0; i < 2 && status == GM_OK; i++) {
        passing at;
        status = gm_rig_run_hold(run, p->target, found, error);
        if (status != GM_OK)
            return status;
        p->still = run->command;
        for (int k = 0; k < run->n_holds; k++)
            p->still.value[run->hold[k].flange] = run->hold[k].u0;
        p->middle = found->speed[p->flange];
        if (i == 0)
            choose(p, time);
        status = run_ramps(p, &at, error);
        if (status == GM_OK)
            value[i] = told(p, &at);
        p->time *= 2.0;
        p->slope *= 0.5;
    }
    return status;
}

gm_status gm_rig_ramp_inertia(gm_rig_run *run, const gm_rig_target *target, int f,
                              double time, gm_rig_inertia *inertia, gm_error *error)
{
    ramp p = {.r = run, .target = target, .flange = f};
    gm_rig_found found;
    double value[2] = {0.0, 0.0};
    gm_status status = ramp_twice(&p, time, inertia_of, &found, value, error);
    if (status != GM_OK)
        return status;
    inertia->value = value[1];
    inertia->uncertainty = fabs(value[1] - value[0]);
    return GM_OK;
}

gm_status gm_rig_ramp_torque(gm_rig_run *run, const gm_rig_target *target, int f,
                             double time, gm_rig_found *found, gm_error *error)
{
    ramp p = {.r = run, .target = target, .flange = f};
    gm_rig_found held;
    double value[2] = {0.0, 0.0};
    if (run->rig->drive[f] == GM_RIG_SPEED_IN)
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "losses cannot be measured by ramps at flange %d: the model takes "
                       "its speed; use settle",
                       f);
    gm_status status = ramp_twice(&p, time, torque_of, &held, value, error);
    if (status != GM_OK)
        return status;
    held.torque[f] = 2.0 * value[1] - value[0];
    held.change[f] = fabs(value[1] - value[0]);
    *found = held;
    return GM_OK;
}
