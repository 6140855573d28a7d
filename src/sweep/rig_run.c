/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/rig_run.h"

#include "base/alloc.h"
#include "base/linear.h"
#include "sweep/rig_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The first automatic period in steps of the rig, and how often it may be doubled. */
enum { FIRST_STEPS = 10, DOUBLINGS = 9, PULSE_DOUBLINGS = 30 };
/* Of the largest torque, on engaged paths while the answer to pulses is learned: it keeps
   flanks together. */
static const double learning_torque = 0.1;
/* Steps of one stair of a speed that moves, an even number. */
enum { STAIR = 8 };

/* ---- life ---- */

gm_status gm_rig_run_create(const gm_rig *rig, const gm_rig_scales *scales, double dwell,
                            gm_rig_run **run, gm_error *error)
{
    gm_rig_run *r = gm_calloc(1, sizeof *r);
    if (!r)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    r->rig = rig;
    r->scales = *scales;
    r->first_period = dwell > 0.0 ? dwell : FIRST_STEPS * rig->step;
    r->longest_period = dwell > 0.0 ? dwell : ldexp(r->first_period, DOUBLINGS);
    gm_status status = rig->is->create(rig->self, &r->model, error);
    if (status != GM_OK) {
        gm_free(r);
        return status;
    }
    *run = r;
    return GM_OK;
}

void gm_rig_run_destroy(gm_rig_run *run)
{
    if (!run)
        return;
    run->rig->is->destroy(run->model);
    gm_free(run);
}

void gm_rig_run_restart(gm_rig_run *run)
{
    run->started = 0;
}

double gm_rig_run_period(const gm_rig_run *run)
{
    return run->period;
}

int gm_rig_run_paths(const gm_rig_run *run)
{
    return run->rig->n_paths;
}

/* ---- time ---- */

/* Commands at a share of the way from one to the next: only speeds go gradually. */
static gm_rig_command on_the_way(const gm_rig_run *r, const gm_rig_command *next,
                                 double share)
{
    gm_rig_command part = *next;
    for (int f = 0; f <= r->rig->n_paths; f++)
        if (r->rig->drive[f] == GM_RIG_SPEED_IN)
            part.value[f] =
                r->command.value[f] + share * (next->value[f] - r->command.value[f]);
    return part;
}

static gm_status step(gm_rig_run *r, const gm_rig_command *part, double h,
                      gm_error *error)
{
    gm_status status = r->rig->is->step(r->model, part, h, &r->seen, error);
    if (status != GM_OK)
        r->started = 0;
    return status;
}

/* Mean of what changes smoothly after a jump at the start of a stair: Simpson's rule, the
   value just after the jump from the parabola through the first three. */
static double mean_of(const double y[STAIR + 1])
{
    double sum = 3.0 * (y[1] - y[2]) + y[3] + y[STAIR];
    for (int k = 1; k < STAIR; k++)
        sum += (k % 2 ? 4.0 : 2.0) * y[k];
    return sum / (3.0 * STAIR);
}

/* One stair of a moving speed, and the mean torques over it: at its end alone they are
   those of a model that has been left behind by half a stair. */
static gm_status stair(gm_rig_run *r, const gm_rig_command *part, double h,
                       gm_error *error)
{
    double torque[GM_MAX_FLANGES][STAIR + 1];
    for (int k = 1; k <= STAIR; k++) {
        gm_status status = step(r, part, h / STAIR, error);
        if (status != GM_OK)
            return status;
        for (int f = 0; f <= r->rig->n_paths; f++)
            torque[f][k] = r->seen.torque[f];
    }
    for (int f = 0; f <= r->rig->n_paths; f++)
        r->mean_torque[f] = mean_of(torque[f]);
    return GM_OK;
}

static int moves_speeds(const gm_rig_run *r, const gm_rig_command *next)
{
    int moves = 0;
    for (int f = 0; f <= r->rig->n_paths; f++)
        moves |=
            r->rig->drive[f] == GM_RIG_SPEED_IN && next->value[f] != r->command.value[f];
    return moves;
}

gm_status gm_rig_run_go(gm_rig_run *r, const gm_rig_command *next, double time,
                        double rise, gm_error *error)
{
    int by_stairs = moves_speeds(r, next);
    int n = (int)ceil(time / r->rig->step / (by_stairs ? 2.0 : 1.0) - 1e-9);
    gm_status status = GM_OK;
    for (int k = 1; k <= n && status == GM_OK; k++) {
        gm_rig_command part = on_the_way(r, next, fmin(1.0, k / (rise * n)));
        status = by_stairs ? stair(r, &part, time / n, error)
                           : step(r, &part, time / n, error);
    }
    if (status == GM_OK)
        r->command = *next;
    return status;
}

/* ---- which flange is held how ---- */

static void hold_by(gm_rig_run *r, gm_rig_hold_kind kind, int flange, int seen_at)
{
    gm_rig_hold *h = &r->hold[r->n_holds++];
    *h = (gm_rig_hold){.kind = kind, .flange = flange, .seen_at = seen_at};
    h->u_scale = kind == GM_HOLD_TORQUE ? r->scales.speed : r->scales.torque;
    h->y_scale = kind == GM_HOLD_SPEED ? r->scales.speed : r->scales.torque;
    if (kind == GM_HOLD_SPEED && flange == 0)
        h->y_scale /= r->ratio_max;
    if (kind != GM_HOLD_TORQUE && flange == 0)
        h->u_scale *= r->ratio_max;
}

/* Largest |ratio| of the engaged paths, 1 where none is known. */
static double largest_ratio(const gm_rig_run *r, const gm_rig_target *target)
{
    double largest = 0.0;
    for (int p = 0; p < r->rig->n_paths; p++)
        if (target->point.gear[p] != 0)
            largest = fmax(largest, fabs(target->ratio[p]));
    return largest > 0.0 ? largest : 1.0;
}

static gm_status hold_path(gm_rig_run *r, const gm_rig_target *target, int p,
                           gm_error *error)
{
    gm_rig_drive drive = r->rig->drive[1 + p];
    int engaged = target->point.gear[p] != 0;
    if (!engaged && drive == GM_RIG_TORQUE_IN)
        hold_by(r, GM_HOLD_SPEED, 1 + p, 1 + p);
    if (!engaged || drive == GM_RIG_TORQUE_IN)
        return GM_OK;
    if (target->ratio[p] == 0.0)
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "path %d, gear %d: the model takes the speed of this flange, so "
                       "the gear's ratio must be given",
                       p, target->point.gear[p]);
    if (r->rig->drive[0] == GM_RIG_SPEED_IN) {
        hold_by(r, GM_HOLD_TORQUE, 1 + p, 1 + p);
        return GM_OK;
    }
    for (int i = 0; i < r->n_holds; i++)
        if (r->hold[i].kind == GM_HOLD_THROUGH)
            return gm_fail(error, GM_ERR_ARGUMENT,
                           "gears %d and %d: two engaged paths cannot both take speeds "
                           "while the output takes torque",
                           target->point.gear[0], target->point.gear[1]);
    hold_by(r, GM_HOLD_THROUGH, 0, 1 + p);
    return GM_OK;
}

/* The output's torque holds its speed unless an engaged path that takes speeds does. */
static gm_status choose_holds(gm_rig_run *r, const gm_rig_target *target, gm_error *error)
{
    gm_status status = GM_OK;
    int through = 0;
    r->n_holds = 0;
    r->ratio_max = largest_ratio(r, target);
    for (int p = 0; p < r->rig->n_paths && status == GM_OK; p++)
        status = hold_path(r, target, p, error);
    for (int i = 0; i < r->n_holds; i++)
        through |= r->hold[i].kind == GM_HOLD_THROUGH;
    if (r->rig->drive[0] == GM_RIG_TORQUE_IN && !through)
        hold_by(r, GM_HOLD_SPEED, 0, 0);
    return status;
}

/* ---- answer to a pulse ---- */

double gm_rig_run_seen(const gm_rig_run *r, const gm_rig_hold *hold)
{
    return hold->kind == GM_HOLD_SPEED ? r->seen.speed[hold->seen_at]
                                       : r->seen.torque[hold->seen_at];
}

static void note(const gm_rig_run *r, double *y)
{
    for (int i = 0; i < r->n_holds; i++)
        y[i] = gm_rig_run_seen(r, &r->hold[i]);
}

/* One period with `pulse` on top at hold i; change[n_holds] of what is held. */
static gm_status answer(gm_rig_run *r, int i, double pulse, double *change,
                        gm_error *error)
{
    gm_rig_command next = r->command;
    double before[GM_MAX_FLANGES], after[GM_MAX_FLANGES];
    next.value[r->hold[i].flange] = r->base.value[r->hold[i].flange] + pulse;
    note(r, before);
    gm_status status = gm_rig_run_go(r, &next, r->period, 0.5, error);
    note(r, after);
    for (int k = 0; k < r->n_holds; k++)
        change[k] = after[k] - before[k];
    return status;
}

static gm_status not_moved(const gm_rig_run *r, const gm_rig_hold *hold, double change,
                           gm_error *error)
{
    int f = hold->flange;
    char name[32] = "output";
    if (f > 0)
        (void)snprintf(name, sizeof name, "input path %d", f);
    if (hold->kind == GM_HOLD_SPEED && change < -0.01 * hold->y_scale)
        return gm_fail(error, GM_ERR_MODEL,
                       "gears (%d, %d): a torque into the %s turns it backward; does the "
                       "model count its torque the other way (sign: minus)?",
                       r->command.gear[0], r->command.gear[1], name);
    return gm_fail(error, GM_ERR_SOLVE,
                   "gears (%d, %d): the %s does not move with any %s", r->command.gear[0],
                   r->command.gear[1], name,
                   hold->kind == GM_HOLD_TORQUE ? "speed" : "torque");
}

/* A pulse that moves what is held by a hundredth of its range, speeds forward: friction
   at rest holds smaller ones. */
static gm_status find_pulse(gm_rig_run *r, int i, double *pulse, gm_error *error)
{
    const gm_rig_hold *hold = &r->hold[i];
    double size = *pulse, change[GM_MAX_FLANGES];
    for (int n = 0; n < PULSE_DOUBLINGS; n++, size *= 2.0) {
        gm_status status = answer(r, i, size, change, error);
        if (status != GM_OK)
            return status;
        int forward = hold->kind == GM_HOLD_TORQUE || gm_rig_run_seen(r, hold) > 0.0;
        if (forward && fabs(change[i]) > 0.01 * hold->y_scale) {
            *pulse = size;
            return GM_OK;
        }
    }
    return not_moved(r, hold, change[i], error);
}

/* Column i of G: twice the pulse in motion against none, in the same direction. */
static gm_status measure_column(gm_rig_run *r, int i, double *column, gm_error *error)
{
    const gm_rig_hold *hold = &r->hold[i];
    double pulse = (hold->kind == GM_HOLD_TORQUE ? 1e-7 : 1e-3) * hold->u_scale;
    double with[GM_MAX_FLANGES], without[GM_MAX_FLANGES];
    for (int n = 0; n < PULSE_DOUBLINGS; n++, pulse *= 2.0) {
        gm_status status = find_pulse(r, i, &pulse, error);
        if (status == GM_OK)
            status = answer(r, i, 2.0 * pulse, with, error);
        if (status == GM_OK)
            status = answer(r, i, 0.0, without, error);
        if (status != GM_OK)
            return status;
        if (hold->kind == GM_HOLD_TORQUE || gm_rig_run_seen(r, hold) > 0.0)
            break;
    }
    for (int k = 0; k < r->n_holds; k++)
        column[k] = (with[k] - without[k]) / (2.0 * pulse * r->period);
    return GM_OK;
}

static int integrates(const gm_rig_hold *hold)
{
    return hold->kind != GM_HOLD_THROUGH;
}

static gm_status measure_all(gm_rig_run *r, double g[GM_RIG_HOLDS][GM_RIG_HOLDS],
                             gm_error *error)
{
    gm_status status = GM_OK;
    memset(g, 0, sizeof(double) * GM_RIG_HOLDS * GM_RIG_HOLDS);
    for (int i = 0; i < r->n_holds && status == GM_OK; i++) {
        double column[GM_MAX_FLANGES] = {0.0};
        if (!integrates(&r->hold[i])) {
            g[i][i] = 1.0;
            continue;
        }
        status = measure_column(r, i, column, error);
        for (int k = 0; k < r->n_holds; k++)
            if (integrates(&r->hold[k]))
                g[k][i] = column[k];
    }
    return status;
}

/* Do two measurements agree that one inertia answers? */
static int agree(const gm_rig_run *r, double a[GM_RIG_HOLDS][GM_RIG_HOLDS],
                 double b[GM_RIG_HOLDS][GM_RIG_HOLDS])
{
    for (int i = 0; i < r->n_holds; i++)
        if (!(fabs(a[i][i] - b[i][i]) <= 0.1 * fabs(b[i][i])))
            return 0;
    return 1;
}

static int factor(gm_rig_run *r, double g[GM_RIG_HOLDS][GM_RIG_HOLDS])
{
    for (int i = 0; i < r->n_holds; i++)
        for (int k = 0; k < r->n_holds; k++)
            r->g[i * r->n_holds + k] = g[i][k];
    return gm_lu_factor(r->n_holds, r->g, r->pivot);
}

gm_status gm_rig_run_learn(gm_rig_run *r, gm_error *error)
{
    double once[GM_RIG_HOLDS][GM_RIG_HOLDS], again[GM_RIG_HOLDS][GM_RIG_HOLDS];
    if (r->n_holds == 0)
        return GM_OK;
    gm_status status = measure_all(r, once, error);
    while (status == GM_OK && r->period < 0.75 * r->longest_period) {
        r->period *= 2.0;
        status = measure_all(r, again, error);
        if (status == GM_OK && agree(r, once, again))
            break;
        memcpy(once, again, sizeof once);
    }
    if (status != GM_OK)
        return status;
    if (!factor(r, once))
        return gm_fail(error, GM_ERR_SOLVE, "the flanges do not move independently");
    return GM_OK;
}

/* ---- beginning ---- */

double gm_rig_run_counter_torque(const gm_rig_run *r, const gm_rig_target *target)
{
    double sum = 0.0;
    for (int p = 0; p < r->rig->n_paths; p++)
        if (target->point.gear[p] != 0)
            sum -= target->ratio[p] * target->point.torque[1 + p];
    return sum;
}

static int same_gears(const gm_rig_run *r, const gm_rig_command *command,
                      const gm_rig_target *target)
{
    for (int p = 0; p < r->rig->n_paths; p++)
        if (command->gear[p] != target->point.gear[p])
            return 0;
    return 1;
}

static int is_learned(const gm_rig_run *r, const gm_rig_target *target)
{
    for (int p = 0; p < r->rig->n_paths; p++)
        if (r->learned_ratio[p] != target->ratio[p])
            return 0;
    return r->learned && same_gears(r, &r->base, target);
}

/* At rest, the torques of engaged paths as in the target, balanced at the output. */
static gm_status start(gm_rig_run *r, const gm_rig_target *target, gm_error *error)
{
    memset(&r->command, 0, sizeof r->command);
    memcpy(r->command.gear, target->point.gear, sizeof r->command.gear);
    for (int p = 0; p < r->rig->n_paths; p++)
        if (r->rig->drive[1 + p] == GM_RIG_TORQUE_IN && target->point.gear[p] != 0)
            r->command.value[1 + p] = target->point.torque[1 + p];
    if (r->rig->drive[0] == GM_RIG_TORQUE_IN)
        r->command.value[0] = gm_rig_run_counter_torque(r, target);
    r->base = r->command;
    gm_status status = r->rig->is->start(r->model, &r->command, &r->seen, error);
    return status == GM_OK ? gm_rig_run_go(r, &r->command, r->period, 0.5, error)
                           : status;
}

/* With one torque for all, so that what is learned does not depend on the target. */
static gm_status learn_configuration(gm_rig_run *r, const gm_rig_target *target,
                                     gm_error *error)
{
    gm_rig_target usual = *target;
    for (int p = 0; p < r->rig->n_paths; p++)
        usual.point.torque[1 + p] = learning_torque * r->scales.torque;
    r->learned = 0;
    r->period = r->first_period;
    gm_status status = choose_holds(r, &usual, error);
    if (status == GM_OK)
        status = start(r, &usual, error);
    if (status == GM_OK)
        status = gm_rig_run_learn(r, error);
    r->learned = status == GM_OK;
    r->learned_period = r->period;
    memcpy(r->learned_ratio, target->ratio, sizeof r->learned_ratio);
    return status;
}

gm_status gm_rig_run_begin(gm_rig_run *r, const gm_rig_target *target, gm_error *error)
{
    gm_status status = GM_OK;
    if (r->started && same_gears(r, &r->command, target) && is_learned(r, target))
        return GM_OK;
    if (!is_learned(r, target))
        status = learn_configuration(r, target, error);
    r->period = r->learned_period;
    if (status == GM_OK)
        status = start(r, target, error);
    for (int i = 0; i < r->n_holds; i++)
        r->hold[i].u0 = r->base.value[r->hold[i].flange];
    r->counter = gm_rig_run_counter_torque(r, target);
    r->started = status == GM_OK;
    return status;
}
