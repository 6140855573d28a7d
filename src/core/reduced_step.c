/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Sub-steps of the reduced gearset and the events between them.
 *
 * A step is one implicit-midpoint sub-step as long as no shaft comes to rest and no
 * synchroniser closes. Otherwise the first such event is located (secant with brackets),
 * the sub-step ends there, the speed or speed difference becomes exactly zero, and the
 * rest of the step goes on from there: friction never acts along the motion, so a passive
 * map gives a loss energy that never falls, and events cost no order of accuracy. What
 * the location leaves of the speed (1e-8 of it) is removed as an impulse of the friction
 * that is acting, with its energy in the account. Bounds: GM_SUBSTEPS events in a step
 * (those beyond are treated at the end of the step), GM_LOCATE solutions for each.
 *
 * Account on every sub-step: work = sum tau_mean h m, loss = sum T h m over the very
 * torques T of the momentum balance, m the mean speeds. Hence work = change of kinetic
 * and elastic energy + loss to rounding.
 */
#include "reduced_parts.h"

#include <stddef.h>

enum { GM_LOCATE = 16 }; /* solutions to locate one event */

/* Changes of a spring's torque, relative and in N.m, that need not be followed. */
#define CALM GM_NUM(0.02)
#define CALM_NM GM_NUM(0.2)

/* Of the speed at the start of the sub-step. */
/* Of the speed at the start of the sub-step. */
#define GM_EVENT_TOLERANCE GM_BY_TYPE(1e-8, 1e-4)

/* Events: shafts 0, 1, GM_OUT come to rest, then synchronisers 0, 1 close. */
enum { GM_CLOSES = GM_SHAFTS, GM_EVENTS = GM_SHAFTS + GM_MAX_PATHS };

/* Speed w after a change. In float a change may be no larger than the last digit of the
 * speed, and to drop always the same part of it would be a torque: what rounding leaves
 * over waits in *rest. At rest nothing waits. */
static gm_real changed(gm_real w, gm_real change, gm_real *rest)
{
    if (!GM_REAL_IS_FLOAT) {
        return w + change;
    }
    const gm_real x = change + (w != 0 ? *rest : 0), next = w + x, part = next - w;
    *rest = (w - (next - part)) + (x - part);
    return next;
}

static void advance(gm_drive *d, const gm_solution *solution, gm_motion *s)
{
    gm_complete_torques(d, solution);
    const gm_real h = d->h;
    const gm_point *at = &solution->point;
    gm_real power = d->tau[GM_OUT] * at->m[GM_OUT];
    s->w_o = changed(d->w[GM_OUT], h * at->a[GM_OUT], &s->rest_o);
    s->brake = gm_brake(d, solution);
    s->phi_o += h * at->m[GM_OUT];
    for (int p = 0; p < d->n_paths; p++) {
        power += d->tau[p] * at->m[p];
        s->path[p].w = d->own[p] ? changed(d->w[p], h * at->a[p], &s->path[p].rest)
                                 : d->ratio[p] * s->w_o;
        s->path[p].phi += h * at->m[p];
        s->path[p].twist += d->elastic[p] ? h * gm_slip(d, at, p) : 0;
    }
    s->work += h * power;
    s->loss_energy += h * gm_loss_power(d, solution);
}

/* ---- events ---- */

/* Speeds that may become zero: shafts, then slips; 0 where there is no event to come. */
static void event_speeds(const gm_drive *d, const gm_real w[GM_SHAFTS],
                         gm_real e[GM_EVENTS])
{
    e[GM_OUT] = d->prescribed[GM_OUT] ? 0 : w[GM_OUT];
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        e[p] = d->own[p] && !d->prescribed[p] ? w[p] : 0;
        e[GM_CLOSES + p] = d->free[p] && d->gear[p] ? w[p] - d->ratio[p] * w[GM_OUT] : 0;
    }
}

static void end_speeds(const gm_drive *d, const gm_solution *s, gm_real w[GM_SHAFTS])
{
    for (int k = 0; k < GM_SHAFTS; k++) {
        w[k] = d->w[k] + d->h * s->point.a[k];
    }
}

/* First event that is passed between two sets of speeds, by the straight line between
 * them; -1: none. */
static int first_event(const gm_real from[GM_EVENTS], const gm_real to[GM_EVENTS])
{
    int first = -1;
    gm_real earliest = 2;
    for (int i = 0; i < GM_EVENTS; i++) {
        if ((from[i] > 0 && to[i] < 0) || (from[i] < 0 && to[i] > 0)) {
            const gm_real when = from[i] / (from[i] - to[i]);
            if (when < earliest) {
                earliest = when;
                first = i;
            }
        }
    }
    return first;
}

/* Secant search for the end of the sub-step at its first event. */
typedef struct search {
    int event;
    gm_real low, high;        /* lengths: no event is passed by, the event is passed by */
    gm_real e_low[GM_EVENTS]; /* event speeds at low */
    gm_real f_low, f_high;    /* weighted speeds of the event (Illinois) */
    int side;                 /* bound that moved last: -1, +1; 0: none */
} search;

/* The event was passed at length h: it is the new upper bound. */
static void lower_high(int event, gm_real h, const gm_real end[GM_EVENTS], search *s)
{
    const int again = s->side == 1 && event == s->event;
    s->f_low = again ? s->f_low / 2 : s->e_low[event];
    s->event = event;
    s->high = h;
    s->f_high = end[event];
    s->side = 1;
}

static void raise_low(gm_real h, const gm_real end[GM_EVENTS], search *s)
{
    for (int i = 0; i < GM_EVENTS; i++) {
        s->e_low[i] = end[i];
    }
    s->low = h;
    s->f_low = end[s->event];
    s->f_high = s->side == -1 ? s->f_high / 2 : s->f_high;
    s->side = -1;
}

/* Shorten the sub-step, d->h long and solved in *solution, to end at its first event.
 * start, end: event speeds at its start and end (updated). Returns the event. */
static int locate(const gm_reduced_inputs *in, gm_real t, const gm_real start[GM_EVENTS],
                  gm_real end[GM_EVENTS], gm_drive *d, gm_solution *solution)
{
    search s = {0, 0, 0, {0}, 0, 0, 0};
    for (int i = 0; i < GM_EVENTS; i++) {
        s.e_low[i] = start[i];
    }
    lower_high(first_event(start, end), d->h, end, &s);
    for (int trial = 0; trial < GM_LOCATE; trial++) {
        gm_real w[GM_SHAFTS];
        gm_set_span(in, t, s.low + (s.high - s.low) * (s.f_low / (s.f_low - s.f_high)),
                    d);
        gm_solve(d, solution);
        end_speeds(d, solution, w);
        event_speeds(d, w, end);
        const int passed = first_event(s.e_low, end);
        const gm_real close = GM_EVENT_TOLERANCE * gm_abs(start[s.event]);
        if ((passed < 0 || passed == s.event) && gm_abs(end[s.event]) <= close) {
            break;
        }
        if (passed >= 0) {
            lower_high(passed, d->h, end, &s);
        } else {
            raise_low(d->h, end, &s);
        }
    }
    return s.event;
}

/* Treat an event, and what else was passed together with it. */
static void treat_events(const gm_reduced_map *map, const gm_reduced_params *params,
                         const gm_drive *d, int event, const gm_real start[GM_EVENTS],
                         const gm_real end[GM_EVENTS], gm_motion *s)
{
    for (int i = 0; i < GM_EVENTS; i++) {
        const int passed = (start[i] > 0 && end[i] < 0) || (start[i] < 0 && end[i] > 0);
        if (i != event && !passed) {
            continue;
        }
        if (i >= GM_CLOSES) {
            gm_engage(map, params, i - GM_CLOSES, s);
        } else if (i == GM_OUT || d->own[i]) {
            gm_bring_to_rest(map, params, i, s);
        }
    }
}

/* Whether a shaft turns round, or a synchroniser's slip does. */
static int passes_event(const gm_drive *d, const gm_solution *s)
{
    const gm_real w_o = d->w[GM_OUT] + d->h * s->point.a[GM_OUT];
    int passed = !d->prescribed[GM_OUT] && d->w[GM_OUT] * w_o < 0;
    for (int p = 0; p < d->n_paths; p++) {
        if (d->own[p]) {
            const gm_real w = d->w[p] + d->h * s->point.a[p];
            passed |= (!d->prescribed[p] && d->w[p] * w < 0) ||
                      d->cone[p] * (w - d->ratio[p] * w_o) < 0;
        }
    }
    return passed;
}

/* The sub-step, solved in *solution, no further than to its first event. */
static void stop_at_event(const gm_reduced_map *map, const gm_reduced_params *params,
                          const gm_reduced_inputs *in, const gm_span *span, gm_drive *d,
                          gm_solution *solution, gm_motion *s)
{
    gm_real start[GM_EVENTS], end[GM_EVENTS], w[GM_SHAFTS];
    event_speeds(d, d->w, start);
    end_speeds(d, solution, w);
    event_speeds(d, w, end);
    int event = first_event(start, end);
    if (event >= 0 && !span->last) {
        event = locate(in, span->start, start, end, d, solution);
    }
    advance(d, solution, s);
    if (event >= 0) {
        treat_events(map, params, d, event, start, end, s);
    }
}

/* Length of a sub-step: all that is left, or an equal part of it while an elastic path
 * vibrates so fast that the step needs up to GM_PARTS of them. */
static gm_real part_of(const gm_drive *d, const gm_span *span)
{
    int parts = 1, left = 1;
    if (span->last || d->stiff == 0) {
        return span->rest;
    }
    while (parts < GM_PARTS && !gm_is_followed(d, span->step, parts)) {
        parts++;
    }
    while (left < parts &&
           span->rest * (gm_real)parts > GM_NUM(1.001) * span->step * (gm_real)left) {
        left++;
    }
    return span->rest / (gm_real)left;
}

/* Whether a spring's torque stays nearly what it is: there is no vibration that would be
 * worth following in parts of the step. */
static int stays_calm(const gm_drive *d, int p, gm_real torque)
{
    const gm_real now = gm_spring_rest_torque(d->gear[p], d->twist[p]);
    return gm_abs(torque - now) <= CALM * gm_abs(now) + CALM_NM;
}

/* Judged by the slips that there are, over half of the rest of the step. */
static int may_be_calm(const gm_drive *d, gm_real rest)
{
    for (int p = 0; p < d->n_paths; p++) {
        if (d->elastic[p]) {
            const gm_real slip = d->w[p] - d->ratio[p] * d->w[GM_OUT];
            const gm_real twist = d->twist[p] + rest / 2 * slip;
            if (!stays_calm(d, p, gm_spring_rest_torque(d->gear[p], twist))) {
                return 0;
            }
        }
    }
    return 1;
}

static int is_calm(const gm_drive *d, const gm_solution *s)
{
    for (int p = 0; p < d->n_paths; p++) {
        if (d->elastic[p] && !stays_calm(d, p, s->point.spring[p])) {
            return 0;
        }
    }
    return 1;
}

/* A step begins with an attempt to be done in one. */
static void solve_part(const gm_reduced_inputs *in, const gm_span *span, gm_real part,
                       gm_drive *d, gm_solution *solution)
{
    if (part < span->rest && span->start == 0 && may_be_calm(d, span->rest)) {
        gm_set_span(in, 0, span->rest, d);
        gm_solve(d, solution);
        if (is_calm(d, solution)) {
            return;
        }
    }
    gm_set_span(in, span->start, part, d);
    gm_solve(d, solution);
}

gm_real gm_substep(const gm_reduced_map *map, const gm_reduced_params *params,
                   const gm_reduced_inputs *in, const gm_span *span,
                   gm_reduced_cache *cache, gm_motion *s, int *outside)
{
    gm_drive d;
    gm_solution solution;
    gm_make_drive(map, params, s, cache, &d);
    solve_part(in, span, part_of(&d, span), &d, &solution);
    if (passes_event(&d, &solution)) {
        stop_at_event(map, params, in, span, &d, &solution, s);
    } else {
        advance(&d, &solution, s);
    }
    *outside |= solution.terms.outside;
    return d.h;
}
