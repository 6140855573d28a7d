/* SPDX-License-Identifier: BSD-2-Clause */
#include "vehicle/gm_compare.h"

#include "base/alloc.h"
#include "vehicle/low_pass.h"

#include <math.h>
#include <string.h>

#define APART 2.0         /* s between two of the worst places */
#define BEFORE_SHIFT 1.6  /* s, the gear that is to come is engaged in this time */
#define AFTER_SHIFT 1.0   /* s */
#define NEAR_REVERSAL 0.5 /* s */
#define STANDS 1.0        /* m/s */

const char *gm_cause_name(gm_cause cause)
{
    switch (cause) {
    case GM_CAUSE_STANDS:
        return "standstill";
    case GM_CAUSE_SHIFT:
        return "shift";
    case GM_CAUSE_REVERSAL:
        return "torque reversal";
    case GM_CAUSE_TABLES:
        return "tables";
    case GM_CAUSES:
        break;
    }
    return "unknown";
}

/* ---- one quantity ---- */

/* Signals as columns: the detailed one, and the reduced one's difference from it. */
typedef struct signals {
    int n;
    double step;
    double *detailed, *difference;
} signals;

typedef double (*quantity)(const gm_trip_view *view, int p);

static double engine_speed(const gm_trip_view *v, int p)
{
    (void)p;
    return v->engine_speed;
}

static double engine_torque(const gm_trip_view *v, int p)
{
    (void)p;
    return v->engine_torque;
}

static double vehicle_speed(const gm_trip_view *v, int p)
{
    (void)p;
    return v->speed;
}

static double output_torque(const gm_trip_view *v, int p)
{
    (void)p;
    return v->output_torque;
}

static double input_torque(const gm_trip_view *v, int p)
{
    return v->input_torque[p];
}

static void fill(const gm_record *detailed, const gm_record *reduced, quantity what,
                 int p, signals *pair)
{
    for (int i = 0; i < pair->n; i++) {
        pair->detailed[i] = what(&detailed->sample[i].view, p);
        pair->difference[i] = what(&reduced->sample[i].view, p) - pair->detailed[i];
    }
}

static gm_difference measure(const signals *pair)
{
    gm_difference d = {0.0, 0.0, 0.0, 0.0};
    double sum = 0.0, square = 0.0;
    for (int i = 0; i < pair->n; i++) {
        double e = fabs(pair->difference[i]);
        sum += e * e;
        square += pair->detailed[i] * pair->detailed[i];
        if (e > d.largest) {
            d.largest = e;
            d.at = i * pair->step;
        }
    }
    d.rms = sqrt(sum / pair->n);
    d.relative = square > 0.0 ? sqrt(sum / square) : 0.0;
    return d;
}

/* What stays of both below the cut-off. */
static void smooth(signals *pair)
{
    gm_low_pass(GM_COMPARE_CUT_OFF, pair->step, pair->n, pair->detailed);
    gm_low_pass(GM_COMPARE_CUT_OFF, pair->step, pair->n, pair->difference);
}

/* ---- where and why ---- */

static int in_shift(const gm_gear_plan *plan, double t)
{
    for (int i = 0; i < plan->n_shifts; i++)
        if (t > plan->shifts[i].start - BEFORE_SHIFT &&
            t < plan->shifts[i].end + AFTER_SHIFT)
            return 1;
    return 0;
}

static int reverses(const signals *pair, int i)
{
    int reach = (int)(NEAR_REVERSAL / pair->step);
    int low = i > reach ? i - reach : 0;
    int high = i + reach < pair->n ? i + reach : pair->n - 1;
    for (int k = low; k < high; k++)
        if (pair->detailed[k] * pair->detailed[k + 1] <= 0.0)
            return 1;
    return 0;
}

static gm_cause cause_of(const gm_record *detailed, const gm_gear_plan *plan,
                         const signals *torque, int i)
{
    if (detailed->sample[i].view.speed < STANDS)
        return GM_CAUSE_STANDS;
    if (in_shift(plan, i * torque->step))
        return GM_CAUSE_SHIFT;
    return reverses(torque, i) ? GM_CAUSE_REVERSAL : GM_CAUSE_TABLES;
}

static int near_a_worse_one(const gm_comparison *c, double t)
{
    for (int k = 0; k < c->n_worst; k++)
        if (fabs(t - c->worst[k].time) < APART)
            return 1;
    return 0;
}

static void find_worst(const gm_record *detailed, const gm_gear_plan *plan,
                       const signals *torque, gm_comparison *c)
{
    while (c->n_worst < GM_COMPARE_WORST) {
        int worst = -1;
        for (int i = 0; i < torque->n; i++)
            if ((worst < 0 ||
                 fabs(torque->difference[i]) > fabs(torque->difference[worst])) &&
                !near_a_worse_one(c, i * torque->step))
                worst = i;
        if (worst < 0)
            return;
        c->worst[c->n_worst++] =
            (gm_worst){worst * torque->step, torque->difference[worst],
                       cause_of(detailed, plan, torque, worst)};
    }
}

/* ---- gears and shifts ---- */

static gm_gear_loss *row_of(gm_comparison *c, int gear)
{
    for (int i = 0; i < c->n_gears; i++)
        if (c->gear[i].gear == gear)
            return &c->gear[i];
    if (c->n_gears == GM_PLAN_MAX_GEARS)
        return NULL;
    c->gear[c->n_gears] = (gm_gear_loss){gear, 0.0, 0.0, 0.0};
    return &c->gear[c->n_gears++];
}

static void losses(const gm_record *detailed, const gm_record *reduced,
                   const gm_gear_plan *plan, gm_comparison *c)
{
    for (int i = 1; i < detailed->n; i++) {
        gm_gear_loss *row =
            row_of(c, gm_gear_plan_driving(plan, (i - 0.5) * detailed->step));
        if (!row)
            continue;
        row->time += detailed->step;
        row->detailed += gm_record_loss(detailed, i) - gm_record_loss(detailed, i - 1);
        row->reduced += gm_record_loss(reduced, i) - gm_record_loss(reduced, i - 1);
    }
    c->loss_detailed = gm_record_loss(detailed, detailed->n - 1);
    c->loss_reduced = gm_record_loss(reduced, reduced->n - 1);
    c->loss_relative =
        c->loss_detailed != 0.0 ? c->loss_reduced / c->loss_detailed - 1.0 : 0.0;
}

/* When the path of a shift was locked in its new gear. */
static double engaged(const gm_record *r, const gm_plan_shift *s)
{
    enum { ENGAGED = 2 };
    int first = (int)fmax(0.0, (s->start - BEFORE_SHIFT) / r->step);
    int last = (int)fmin(r->n - 1, (s->end + AFTER_SHIFT) / r->step);
    for (int i = first; i <= last; i++)
        if (r->sample[i].view.gear[s->path] == s->to &&
            r->sample[i].view.state[s->path] == ENGAGED)
            return i * r->step;
    return (double)NAN;
}

static double rms_between(const signals *torque, double from, double to)
{
    double sum = 0.0;
    int n = 0;
    for (int i = (int)fmax(0.0, from / torque->step);
         i < torque->n && i * torque->step <= to; i++, n++)
        sum += torque->difference[i] * torque->difference[i];
    return n > 0 ? sqrt(sum / n) : 0.0;
}

static gm_status shifts(const gm_record *detailed, const gm_record *reduced,
                        const gm_gear_plan *plan, const signals *torque, gm_comparison *c,
                        gm_error *error)
{
    c->shift = gm_calloc((size_t)plan->n_shifts + 1, sizeof *c->shift);
    if (!c->shift)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    for (int i = 0; i < plan->n_shifts; i++) {
        const gm_plan_shift *s = &plan->shifts[i];
        c->shift[c->n_shifts++] = (gm_shift){
            .time = s->start,
            .from = s->from,
            .to = s->to,
            .engaged_detailed = engaged(detailed, s),
            .engaged_reduced = engaged(reduced, s),
            .rms = rms_between(torque, s->start - 0.5, s->end + AFTER_SHIFT),
        };
    }
    return GM_OK;
}

/* ---- the whole ---- */

static void quantities(const gm_record *detailed, const gm_record *reduced, signals *pair,
                       gm_comparison *c)
{
    fill(detailed, reduced, engine_speed, 0, pair);
    c->engine_speed = measure(pair);
    fill(detailed, reduced, engine_torque, 0, pair);
    c->engine_torque = measure(pair);
    fill(detailed, reduced, vehicle_speed, 0, pair);
    c->vehicle_speed = measure(pair);
    for (int p = 0; p < GM_MAX_INPUT_PATHS; p++) {
        fill(detailed, reduced, input_torque, p, pair);
        smooth(pair);
        c->input_torque[p] = measure(pair);
    }
    fill(detailed, reduced, output_torque, 0, pair);
    smooth(pair);
    c->output_torque = measure(pair);
}

gm_status gm_compare(const gm_record *detailed, const gm_record *reduced,
                     const gm_gear_plan *plan, gm_comparison *comparison, gm_error *error)
{
    if (detailed->n != reduced->n || detailed->step != reduced->step)
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "the two drives have %d and %d samples, must have the same",
                       detailed->n, reduced->n);
    gm_comparison c;
    memset(&c, 0, sizeof c);
    signals pair = {.n = detailed->n, .step = detailed->step};
    pair.detailed = gm_calloc((size_t)pair.n, sizeof *pair.detailed);
    pair.difference = gm_calloc((size_t)pair.n, sizeof *pair.difference);
    gm_status status = GM_OK;
    if (!pair.detailed || !pair.difference) {
        status = gm_fail(error, GM_ERR_MEMORY, "out of memory");
    } else {
        quantities(detailed, reduced, &pair, &c); /* leaves the output torque in pair */
        find_worst(detailed, plan, &pair, &c);
        losses(detailed, reduced, plan, &c);
        if (detailed->work.cpu > 0.0)
            c.cpu_saved = 1.0 - reduced->work.cpu / detailed->work.cpu;
        status = shifts(detailed, reduced, plan, &pair, &c, error);
    }
    gm_free(pair.detailed);
    gm_free(pair.difference);
    if (status == GM_OK)
        *comparison = c;
    else
        gm_comparison_clear(&c);
    return status;
}

void gm_comparison_clear(gm_comparison *comparison)
{
    gm_free(comparison->shift);
    memset(comparison, 0, sizeof *comparison);
}
