/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Holding a target on the test rig until nothing changes any more (rig_run.h).
 */
#include "sweep/rig_parts.h"

#include "base/linear.h"

#include <math.h>
#include <string.h>

/* Periods that must agree, periods before a longer one is tried, and how many of the last
   ones tell how far the torques still move. */
enum { CALM_PERIODS = 3, PERIODS = 60, SPREAD_PERIODS = 12 };

/* Torques count as constant at this share of the largest torque: losses are about a
   hundredth of it and wanted to a thousandth. What noise of the model leaves above is
   accepted up to the second number, and told. */
static const double calm_torque = 5e-8, accepted_torque = 1e-4;
/* Speeds are where they should be at this share of the largest; losses change by about as
   little. */
static const double calm_speed = 2e-6, still_speed = 1e-5;
/* Of the range, that a speed is moved over one period. */
static const double largest_move = 0.05;

typedef struct search {
    gm_rig_run *r;
    const gm_rig_target *target;
    double part[GM_RIG_HOLDS]; /* of the computed correction that is applied */
    double off[GM_RIG_HOLDS];  /* what is missing, after the last period */
    double error;              /* the largest of them, in ranges */
    double torque[GM_MAX_FLANGES], change[GM_MAX_FLANGES]; /* as found, last change */
    double low[GM_MAX_FLANGES], high[GM_MAX_FLANGES];      /* over the last periods */
    int calm;
} search;

static double clamp(double x, double limit)
{
    return fmax(-limit, fmin(limit, x));
}

static double wanted(const search *s, const gm_rig_hold *hold)
{
    const gm_steady_point *point = &s->target->point;
    return hold->kind == GM_HOLD_SPEED ? point->speed[hold->seen_at]
                                       : point->torque[hold->seen_at];
}

static double towards(double now, double goal, double range)
{
    return now + clamp(goal - now, fmax(largest_move * range, 0.2 * fabs(now)));
}

/* ---- commands of the next period ---- */

static double given_speed(const search *s, int f)
{
    const gm_steady_point *point = &s->target->point;
    if (f > 0 && point->gear[f - 1] != 0)
        return s->target->ratio[f - 1] * point->speed[0];
    return point->speed[f];
}

static int is_held(const gm_rig_run *r, int f)
{
    for (int i = 0; i < r->n_holds; i++)
        if (r->hold[i].flange == f)
            return 1;
    return 0;
}

static void set_given(const search *s, gm_rig_command *next)
{
    const gm_rig_run *r = s->r;
    for (int f = 0; f <= r->rig->n_paths; f++) {
        double range = r->scales.speed / (f == 0 ? r->ratio_max : 1.0);
        if (is_held(r, f))
            continue;
        if (r->rig->drive[f] == GM_RIG_SPEED_IN)
            next->value[f] = towards(r->command.value[f], given_speed(s, f), range);
        else if (f > 0 && next->gear[f - 1] != 0)
            next->value[f] = s->target->point.torque[f];
    }
}

/* What the torques of engaged paths change is known before it happens. */
static void feed_forward(search *s)
{
    gm_rig_run *r = s->r;
    double counter = gm_rig_run_counter_torque(r, s->target);
    for (int i = 0; i < r->n_holds; i++)
        if (r->hold[i].flange == 0)
            r->hold[i].u0 += counter - r->counter;
    r->counter = counter;
}

static void set_held(search *s, gm_rig_command *next)
{
    gm_rig_run *r = s->r;
    double step[GM_RIG_HOLDS];
    for (int i = 0; i < r->n_holds; i++) {
        const gm_rig_hold *h = &r->hold[i];
        double off = wanted(s, h) - gm_rig_run_seen(r, h);
        double most = fmax(largest_move * h->y_scale, 0.2 * fabs(gm_rig_run_seen(r, h)));
        step[i] = h->kind == GM_HOLD_THROUGH ? 0.0 : clamp(off, most) / r->period;
    }
    gm_lu_solve(r->n_holds, r->g, r->pivot, step);
    for (int i = 0; i < r->n_holds; i++)
        next->value[r->hold[i].flange] = r->hold[i].u0 + s->part[i] * step[i];
}

/* ---- what a period told ---- */

static void learn_holding(search *s, const double *before)
{
    gm_rig_run *r = s->r;
    double rate[GM_RIG_HOLDS];
    for (int i = 0; i < r->n_holds; i++) {
        const gm_rig_hold *h = &r->hold[i];
        rate[i] = h->kind == GM_HOLD_THROUGH
                      ? 0.0
                      : (gm_rig_run_seen(r, h) - before[i]) / r->period;
    }
    gm_lu_solve(r->n_holds, r->g, r->pivot, rate);
    for (int i = 0; i < r->n_holds; i++) {
        gm_rig_hold *h = &r->hold[i];
        double found = r->command.value[h->flange] - rate[i];
        if (h->kind == GM_HOLD_THROUGH)
            found -=
                s->target->ratio[h->seen_at - 1] * (wanted(s, h) - gm_rig_run_seen(r, h));
        h->change = found - h->u0;
        h->u0 += fmin(1.0, s->part[i]) * h->change;
    }
}

/* A flange that stands: friction holds it, with any torque inside its band. */
static int stands(const search *s, int f)
{
    const gm_steady_point *point = &s->target->point;
    int engaged = f > 0 && point->gear[f - 1] != 0;
    return !engaged && point->speed[f] == 0.0 && point->direction[f] == 0.0;
}

/* Overshoot says that the inertia is smaller than the pulse made believe (backlash), a
   flange at rest that hardly answers that friction holds it. */
static double adapted_part(const search *s, int i, double off)
{
    const gm_rig_hold *h = &s->r->hold[i];
    double before = s->off[i], part = s->part[i];
    int stays = fabs(off) > 0.5 * fabs(before);
    if (fabs(off) > largest_move * h->y_scale || before == 0.0)
        return fmin(1.0, part);
    if (stays && off * before < 0.0)
        return fmax(0.25 * fmin(part, 2.0), 1.0 / 16.0);
    if (h->kind == GM_HOLD_SPEED && stands(s, h->flange))
        return stays && fabs(off) > 0.5 * still_speed * h->y_scale
                   ? fmin(2.0 * part, 16.0)
                   : part;
    return fmin(1.0, 1.3 * part);
}

static void adapt(search *s)
{
    s->error = 0.0;
    for (int i = 0; i < s->r->n_holds; i++) {
        const gm_rig_hold *h = &s->r->hold[i];
        double off = wanted(s, h) - gm_rig_run_seen(s->r, h);
        s->part[i] = adapted_part(s, i, off);
        s->off[i] = off;
        s->error = fmax(s->error, fabs(off) / h->y_scale);
    }
}

static double found_torque(const search *s, int f)
{
    const gm_rig_run *r = s->r;
    for (int i = 0; i < r->n_holds; i++)
        if (r->hold[i].flange == f && r->hold[i].kind != GM_HOLD_TORQUE)
            return r->hold[i].u0;
    return r->rig->drive[f] == GM_RIG_TORQUE_IN ? r->command.value[f] : r->seen.torque[f];
}

static double torque_scale(const search *s, int f)
{
    return s->r->scales.torque * (f == 0 ? s->r->ratio_max : 1.0);
}

static int is_there(const search *s)
{
    const gm_rig_run *r = s->r;
    for (int i = 0; i < r->n_holds; i++) {
        const gm_rig_hold *h = &r->hold[i];
        double limit = h->kind != GM_HOLD_SPEED ? calm_torque
                       : stands(s, h->flange)   ? still_speed
                                                : calm_speed;
        if (!(fabs(wanted(s, h) - gm_rig_run_seen(r, h)) <= limit * h->y_scale))
            return 0;
    }
    for (int f = 0; f <= r->rig->n_paths; f++)
        if (r->rig->drive[f] == GM_RIG_SPEED_IN && !is_held(r, f) &&
            r->command.value[f] != given_speed(s, f))
            return 0;
    return 1;
}

static void compare(search *s, int first)
{
    int calm = 1;
    for (int f = 0; f <= s->r->rig->n_paths; f++) {
        double torque = found_torque(s, f);
        s->change[f] = first ? HUGE_VAL : fabs(torque - s->torque[f]);
        s->torque[f] = torque;
        calm = calm && (s->change[f] <= calm_torque * torque_scale(s, f) || stands(s, f));
    }
    for (int i = 0; i < s->r->n_holds; i++) {
        const gm_rig_hold *h = &s->r->hold[i];
        calm = calm && (h->kind == GM_HOLD_TORQUE || stands(s, h->flange) ||
                        fabs(h->change) <= calm_torque * torque_scale(s, h->flange));
    }
    s->calm = calm && is_there(s) ? s->calm + 1 : 0;
}

/* ---- the search ---- */

static gm_status one_period(search *s, gm_error *error)
{
    gm_rig_run *r = s->r;
    gm_rig_command next = r->command;
    double before[GM_RIG_HOLDS];
    for (int i = 0; i < r->n_holds; i++)
        before[i] = gm_rig_run_seen(r, &r->hold[i]);
    set_held(s, &next);
    set_given(s, &next);
    gm_status status = gm_rig_run_go(r, &next, r->period, 0.5, error);
    if (status != GM_OK)
        return status;
    learn_holding(s, before);
    adapt(s);
    return GM_OK;
}

/* Up to PERIODS beyond those that bring the speeds there. */
static gm_status try_period(search *s, gm_error *error)
{
    gm_status status = GM_OK;
    for (int i = 0; i < GM_RIG_HOLDS; i++) {
        s->part[i] = 1.0;
        s->off[i] = 0.0;
    }
    s->calm = 0;
    for (int k = 0, moves = 0; k < PERIODS && s->calm < CALM_PERIODS; k++) {
        status = one_period(s, error);
        if (status != GM_OK)
            return status;
        if (s->error > 2.0 * largest_move && moves++ < 10 * PERIODS)
            k = 0;
        compare(s, k == 0);
        for (int f = 0; f <= s->r->rig->n_paths; f++) {
            int fresh = k <= PERIODS - SPREAD_PERIODS;
            s->low[f] = fresh ? s->torque[f] : fmin(s->low[f], s->torque[f]);
            s->high[f] = fresh ? s->torque[f] : fmax(s->high[f], s->torque[f]);
        }
    }
    return GM_OK;
}

static int nearly_calm(const search *s)
{
    for (int f = 0; f <= s->r->rig->n_paths; f++)
        if (!(s->high[f] - s->low[f] <= accepted_torque * torque_scale(s, f)) &&
            !stands(s, f))
            return 0;
    return s->error < 1e-3;
}

static void fill(const search *s, gm_rig_found *found)
{
    for (int f = 0; f <= s->r->rig->n_paths; f++) {
        int calm = s->calm >= CALM_PERIODS;
        found->torque[f] = calm ? s->torque[f] : 0.5 * (s->low[f] + s->high[f]);
        found->change[f] = calm ? s->change[f] : s->high[f] - s->low[f];
        found->speed[f] = s->r->rig->drive[f] == GM_RIG_SPEED_IN ? s->r->command.value[f]
                                                                 : s->r->seen.speed[f];
    }
}

static gm_status restless(const search *s, gm_error *error)
{
    s->r->started = 0;
    return gm_fail(
        error, GM_ERR_SOLVE,
        "the model does not become steady: after periods of %g s its torque at "
        "the output still varies by %.3g N.m",
        s->r->period, s->high[0] - s->low[0]);
}

gm_status gm_rig_run_hold(gm_rig_run *run, const gm_rig_target *target,
                          gm_rig_found *found, gm_error *error)
{
    search s = {.r = run, .target = target};
    gm_status status = gm_rig_run_begin(run, target, error);
    if (status == GM_OK)
        feed_forward(&s);
    while (status == GM_OK) {
        status = try_period(&s, error);
        if (status != GM_OK || s.calm >= CALM_PERIODS)
            break;
        if (run->period > 0.75 * run->longest_period)
            break;
        run->period *= 2.0;
    }
    if (status == GM_OK && s.calm < CALM_PERIODS && !nearly_calm(&s))
        status = restless(&s, error);
    if (status == GM_OK)
        fill(&s, found);
    return status;
}
