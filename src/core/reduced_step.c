/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Sub-steps of the reduced gearset and the events between them.
 *
 * A step is one implicit-midpoint sub-step as long as no shaft comes to rest and no
 * synchroniser closes. Otherwise the sub-step is shortened to its first such event, by
 * one step of regula falsi: accelerations hardly change within a step. What that leaves
 * of the speed is taken by the friction that is acting, if it is strong enough, as an
 * impulse with its energy in the account; then the speed is exactly zero. What it leaves
 * of a slip goes by the impulse of engagement. The rest of the step goes on from there.
 * The last of GM_SUBSTEPS is not shortened: events in it are treated at its end.
 *
 * Friction never drives: where a shaft turns round so early that its mean speed has
 * another sign than at the start, its friction is turned as well, and if that turns the
 * mean speed back, friction holds it at zero. So a passive map gives a loss energy that
 * never falls. Bounds: GM_SUBSTEPS sub-steps, three solutions for each beside GM_TURNS
 * that turn friction, GM_STEP_PASSES passes for all of them together; once they are used
 * up a solution takes one pass and lets no shaft go.
 *
 * Account on every sub-step: work = sum tau_mean h m, loss = sum T h m over the very
 * torques T of the momentum balance, m the mean speeds. Hence work = change of kinetic
 * and elastic energy + loss to rounding.
 */
#include "reduced_parts.h"

#include <stddef.h>

enum { GM_TURNS = 3 }; /* solutions to turn friction */

/* Changes of a spring's torque, relative and in N.m, that need not be followed. */
#define CALM GM_NUM(0.02)
#define CALM_NM GM_NUM(0.2)

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

/* Shorten the sub-step, d->h long and solved in *solution, to end about at its first
 * event. start, end: event speeds at its start and end (updated). Returns the event. */
static int locate(const gm_reduced_inputs *in, gm_real t, const gm_real start[GM_EVENTS],
                  gm_real end[GM_EVENTS], gm_drive *d, gm_solution *solution)
{
    gm_real w[GM_SHAFTS];
    const int event = first_event(start, end);
    gm_set_span(in, t, d->h * (start[event] / (start[event] - end[event])), d);
    gm_solve(d, solution);
    end_speeds(d, solution, w);
    event_speeds(d, w, end);
    const int passed = first_event(start, end);
    return passed >= 0 ? passed : event;
}

/* ---- mean speeds against their friction ---- */

/* One shaft that turns round so early that its mean speed has another sign than its
 * friction: friction turns round as well, then it holds the mean speed at zero. */
static int turn_friction(gm_drive *d, gm_solution *s, int k, int hold)
{
    if (d->w[k] == 0 || !gm_moves(d, s, k) || !(s->point.m[k] * s->sign[k] < 0)) {
        return 0;
    }
    s->held[k] = hold || s->sign[k] * d->w[k] < 0;
    s->sign[k] = -s->sign[k];
    d->given[k] = s->held[k] ? -d->w[k] / d->mean : 0;
    return 1;
}

/* A cone whose slip does lets go: what is left of the slip goes when it closes. */
static int turn_cone(gm_drive *d, const gm_solution *s, int p)
{
    if (!(d->cone[p] * gm_slip(d, &s->point, p) < 0)) {
        return 0;
    }
    d->cone[p] = 0;
    return 1;
}

/* No friction of the solution drives. */
static void turn_frictions(gm_drive *d, gm_solution *s)
{
    for (int round = 1; round <= GM_TURNS; round++) {
        int turned = turn_friction(d, s, GM_OUT, round == GM_TURNS);
        for (int p = 0; p < d->n_paths; p++) {
            turned |= d->own[p] && turn_friction(d, s, p, round == GM_TURNS);
            turned |= turn_cone(d, s, p);
        }
        if (!turned) {
            return;
        }
        gm_solve_given(d, s);
    }
}

/* Whether friction has taken what is left of the speed of shaft k. If it could not, the
 * shaft turns on with it. */
static int is_stopped(const gm_drive *d, const gm_solution *solution, int k, gm_real end)
{
    const gm_terms *t = &solution->terms;
    gm_real friction = k == GM_OUT ? t->out : t->path[k].drag;
    for (int p = 0; k == GM_OUT && p < d->n_paths; p++) {
        friction += d->engaged[p] ? d->ratio[p] * t->path[p].load : 0;
    }
    return solution->held[k] || d->inertia[k] * gm_abs(end) <= d->h * gm_abs(friction);
}

/* Treat an event, and what else was passed together with it. */
static void treat_events(const gm_reduced_map *map, const gm_reduced_params *params,
                         const gm_drive *d, const gm_solution *solution, int event,
                         const gm_real start[GM_EVENTS], const gm_real end[GM_EVENTS],
                         gm_motion *s)
{
    for (int i = 0; i < GM_EVENTS; i++) {
        const int passed = (start[i] > 0 && end[i] < 0) || (start[i] < 0 && end[i] > 0);
        if (i != event && !passed) {
            continue;
        }
        if (i >= GM_CLOSES) {
            gm_engage(map, params, i - GM_CLOSES, s);
        } else if (is_stopped(d, solution, i, end[i])) {
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
    turn_frictions(d, solution);
    end_speeds(d, solution, w);
    event_speeds(d, w, end);
    advance(d, solution, s);
    if (event >= 0) {
        treat_events(map, params, d, solution, event, start, end, s);
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
                   gm_reduced_cache *cache, gm_motion *s, gm_solution *solution)
{
    gm_drive d;
    gm_make_drive(map, params, s, cache, &d);
    solve_part(in, span, part_of(&d, span), &d, solution);
    if (passes_event(&d, solution)) {
        stop_at_event(map, params, in, span, &d, solution, s);
    } else {
        advance(&d, solution, s);
    }
    return d.h;
}
