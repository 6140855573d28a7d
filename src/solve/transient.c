/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The loop around CVODE. Each round first settles what is due at the present time (a new
 * piece of the inputs, a change of modes, a restart), then takes one step. What is due
 * waits until a time beyond is asked for, so that the last step can be interpolated.
 */
#include "solve/gm_transient.h"

#include "base/alloc.h"
#include "solve/energy.h"
#include "solve/sun_ode.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#define TOLERANCE 3e-4
#define ORDER_MAX 2
/* Speeds of hundreds of rad/s matter by their differences, which are small: the error
 * relative to the value itself counts only where values are far beyond the usual. */
#define OF_LARGE_VALUES 0.01
/* So many rounds within so short a time: the modes do not settle. A mesh closes or opens
 * once in some 100 us. */
#define ROUNDS_MAX 1000
#define STANDSTILL 1e-9      /* s */
#define ROUNDS_PER_CLOCK 256 /* the processor's clock is read so often */

typedef enum due { DUE_NOTHING, DUE_MODES, DUE_PIECE } due;

struct gm_transient {
    gm_transient_system system;
    gm_transient_options options;
    gm_sun_ode *ode;
    double *x, *x_now; /* at t and at now */
    double t, now;     /* end of the last step, present time <= t */
    due due;           /* at t */
    double moved_at;   /* time when the clock last moved on, and rounds since */
    int rounds;
    double gave_up_at; /* time of the last solver's failure after which it began anew */
    gm_energy energy;
    gm_sun_ode_counts before;           /* work of earlier runs */
    gm_transient_statistics statistics; /* restarts, events, cpu */
};

static double cpu_clock(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static gm_transient_powers powers_at(const gm_transient *tr)
{
    gm_transient_powers powers = {0};
    tr->system.powers(tr->system.user, tr->t, tr->x, &powers);
    return powers;
}

/* ---- create ---- */

static gm_sun_ode *make_ode(const gm_transient *tr)
{
    const gm_transient_system *s = &tr->system;
    const gm_sun_ode_system system = {.n = s->n_states,
                                      .user = s->user,
                                      .rates = s->rates,
                                      .column_start = s->column_start,
                                      .row = s->row,
                                      .jacobian = s->jacobian,
                                      .n_events = s->n_events,
                                      .events = s->events};
    double *absolute = gm_calloc((size_t)s->n_states, sizeof *absolute);
    if (!absolute)
        return NULL;
    s->tolerances(s->user, tr->options.tolerance, absolute);
    gm_sun_ode *ode =
        gm_sun_ode_create(&system, OF_LARGE_VALUES * tr->options.tolerance, absolute,
                          tr->options.order_max > 0 ? tr->options.order_max : ORDER_MAX,
                          tr->options.step_max);
    gm_free(absolute);
    return ode;
}

gm_status gm_transient_create(const gm_transient_system *system,
                              const gm_transient_options *options,
                              gm_transient **transient, gm_error *error)
{
    gm_transient *tr = gm_calloc(1, sizeof *tr);
    if (!tr)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    size_t n = (size_t)system->n_states;
    tr->system = *system;
    tr->options = *options;
    if (!(tr->options.tolerance > 0.0))
        tr->options.tolerance = TOLERANCE;
    tr->x = gm_calloc(n, sizeof *tr->x);
    tr->x_now = gm_calloc(n, sizeof *tr->x_now);
    tr->ode = make_ode(tr);
    if (!tr->x || !tr->x_now || !tr->ode) {
        gm_transient_destroy(tr);
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    }
    *transient = tr;
    return GM_OK;
}

void gm_transient_destroy(gm_transient *tr)
{
    if (!tr)
        return;
    gm_sun_ode_destroy(tr->ode);
    gm_free(tr->x);
    gm_free(tr->x_now);
    gm_free(tr);
}

/* ---- what goes wrong ---- */

static const char *state_name(const gm_transient *tr, int i, char text[32])
{
    const gm_transient_system *s = &tr->system;
    const char *name = s->state_name ? s->state_name(s->user, i) : NULL;
    if (name)
        return name;
    (void)snprintf(text, 32, "state %d", i);
    return text;
}

static gm_status fail_at(const gm_transient *tr, gm_sun_ode_outcome outcome,
                         gm_error *error)
{
    char text[32];
    int nan = gm_sun_ode_nan_state(tr->ode);
    if (outcome == GM_ODE_NO_RATES && nan >= 0)
        return gm_fail(error, GM_ERR_SOLVE,
                       "no motion beyond t = %.9g s: the rate of %s is not a number",
                       tr->t, state_name(tr, nan, text));
    const char *why = outcome == GM_ODE_NO_RATES
                          ? "the plant cannot be evaluated"
                          : "its equations cannot be solved, however short the step";
    if (outcome == GM_ODE_BROKEN || outcome == GM_ODE_NO_RATES)
        return gm_fail(error, GM_ERR_SOLVE, "no motion beyond t = %.9g s: %s (%s)", tr->t,
                       why, gm_sun_ode_message(tr->ode));
    return gm_fail(error, GM_ERR_SOLVE,
                   "no motion beyond t = %.9g s: %s, and %s is farthest off", tr->t, why,
                   state_name(tr, gm_sun_ode_worst_state(tr->ode), text));
}

static gm_status check_limits(gm_transient *tr, double cpu_start, gm_error *error)
{
    char text[32];
    const gm_transient_options *o = &tr->options;
    if (tr->t > tr->moved_at + STANDSTILL) {
        tr->moved_at = tr->t;
        tr->rounds = 0;
    }
    if (++tr->rounds > ROUNDS_MAX)
        return gm_fail(error, GM_ERR_SOLVE,
                       "time stands still at t = %.9g s: %d steps and changes of mode "
                       "within a nanosecond, and %s changes most",
                       tr->t, ROUNDS_MAX,
                       state_name(tr, gm_sun_ode_worst_state(tr->ode), text));
    if (o->steps_max <= 0 && !(o->cpu_max > 0.0))
        return GM_OK;
    long steps = gm_sun_ode_work(tr->ode).steps;
    if (o->steps_max > 0 && steps >= o->steps_max)
        return gm_fail(error, GM_ERR_SOLVE,
                       "stopped at t = %.9g s: the limit of %ld steps is reached", tr->t,
                       o->steps_max);
    double cpu = tr->statistics.cpu + cpu_clock() - cpu_start;
    if (o->cpu_max > 0.0 && steps % ROUNDS_PER_CLOCK == 0 && cpu > o->cpu_max)
        return gm_fail(error, GM_ERR_SOLVE,
                       "stopped at t = %.9g s: the limit of %g s of processor time is "
                       "reached",
                       tr->t, o->cpu_max);
    return GM_OK;
}

/* ---- the loop ---- */

static gm_status broken(const gm_transient *tr, gm_error *error)
{
    return gm_fail(error, GM_ERR_SOLVE, "no motion beyond t = %.9g s: %s", tr->t,
                   gm_sun_ode_message(tr->ode));
}

static gm_status restart(gm_transient *tr, double work, gm_error *error)
{
    gm_transient_powers powers = powers_at(tr);
    gm_energy_jump(&tr->energy, work, &powers);
    tr->statistics.restarts++;
    return gm_sun_ode_start(tr->ode, tr->t, tr->x, 0.0) ? broken(tr, error) : GM_OK;
}

static gm_status enter_piece(gm_transient *tr, gm_error *error)
{
    gm_transient_piece piece = {.end = (double)INFINITY};
    const gm_transient_system *s = &tr->system;
    gm_status status = s->enter(s->user, tr->t, tr->x, &piece, error);
    if (status != GM_OK)
        return status;
    gm_energy_kink(&tr->energy);
    if (piece.restart)
        status = restart(tr, piece.work, error);
    if (status == GM_OK && isfinite(piece.end) && gm_sun_ode_stop_at(tr->ode, piece.end))
        return broken(tr, error);
    return status;
}

static gm_status settle(gm_transient *tr, gm_error *error)
{
    int changed = 0;
    due what = tr->due;
    tr->due = DUE_NOTHING;
    if (what == DUE_NOTHING)
        return GM_OK;
    if (what == DUE_PIECE)
        return enter_piece(tr, error);
    gm_status status = tr->system.handle(tr->system.user, tr->t, tr->x, &changed, error);
    if (status != GM_OK || !changed)
        return status;
    return restart(tr, 0.0, error);
}

/* Where steps of some order and a Jacobian of earlier do not get on, a new start often
 * does; the same place twice has no solution. */
static bool may_begin_anew(gm_transient *tr, gm_sun_ode_outcome outcome)
{
    bool stuck = outcome == GM_ODE_NO_CONVERGENCE || outcome == GM_ODE_ERROR_TOO_LARGE;
    bool first = tr->t > tr->gave_up_at;
    tr->gave_up_at = tr->t;
    return stuck && first;
}

static gm_status step(gm_transient *tr, gm_error *error)
{
    gm_sun_ode_outcome outcome = gm_sun_ode_step(tr->ode, &tr->t, tr->x);
    if (outcome > GM_ODE_EVENT)
        return may_begin_anew(tr, outcome) ? restart(tr, 0.0, error)
                                           : fail_at(tr, outcome, error);
    tr->due = outcome == GM_ODE_STOP ? DUE_PIECE : DUE_MODES;
    tr->statistics.events += outcome == GM_ODE_EVENT;
    gm_transient_powers powers = powers_at(tr);
    gm_energy_step(&tr->energy, tr->t, &powers);
    return GM_OK;
}

static gm_status advance(gm_transient *tr, double t, gm_error *error)
{
    if (tr->t >= t) /* the clock costs as much as a tenth of a step */
        return GM_OK;
    double cpu_start = cpu_clock();
    gm_status status = GM_OK;
    while (status == GM_OK && tr->t < t) {
        status = check_limits(tr, cpu_start, error);
        if (status == GM_OK)
            status = settle(tr, error);
        if (status == GM_OK)
            status = step(tr, error);
    }
    tr->statistics.cpu += cpu_clock() - cpu_start;
    return status;
}

gm_status gm_transient_start(gm_transient *tr, double t, gm_error *error)
{
    const gm_transient_system *s = &tr->system;
    gm_status status = s->start(s->user, t, tr->x, error);
    if (status != GM_OK)
        return status;
    tr->t = tr->now = tr->moved_at = t;
    tr->gave_up_at = -(double)INFINITY;
    tr->due = DUE_PIECE;
    tr->rounds = 0;
    memset(&tr->statistics, 0, sizeof tr->statistics);
    tr->before = gm_sun_ode_work(tr->ode);
    memcpy(tr->x_now, tr->x, (size_t)s->n_states * sizeof *tr->x);
    gm_transient_powers powers = powers_at(tr);
    gm_energy_start(&tr->energy, t, &powers);
    return gm_sun_ode_start(tr->ode, t, tr->x, 0.0) ? broken(tr, error) : GM_OK;
}

gm_status gm_transient_advance(gm_transient *tr, double t, gm_error *error)
{
    if (!(t >= tr->now))
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "t = %.9g s is before the present time, %.9g s", t, tr->now);
    gm_status status = advance(tr, t, error);
    tr->now = fmin(t, tr->t);
    if (tr->now == tr->t)
        memcpy(tr->x_now, tr->x, (size_t)tr->system.n_states * sizeof *tr->x);
    else if (gm_sun_ode_at(tr->ode, tr->now, tr->x_now) && status == GM_OK)
        return broken(tr, error);
    return status;
}

/* ---- what is seen ---- */

double gm_transient_time(const gm_transient *tr)
{
    return tr->now;
}

const double *gm_transient_state(const gm_transient *tr)
{
    return tr->x_now;
}

gm_transient_energy gm_transient_account(const gm_transient *tr)
{
    gm_transient_energy e = tr->energy.sum;
    e.residual = e.work - e.dissipated - e.impulses - (e.stored - e.stored_start);
    return e;
}

gm_transient_statistics gm_transient_work(const gm_transient *tr)
{
    gm_transient_statistics s = tr->statistics;
    gm_sun_ode_counts work = gm_sun_ode_work(tr->ode);
    s.steps = work.steps - tr->before.steps;
    s.rates = work.rates - tr->before.rates;
    s.jacobians = work.jacobians - tr->before.jacobians;
    s.error_failures = work.error_failures - tr->before.error_failures;
    s.convergence_failures = work.convergence_failures - tr->before.convergence_failures;
    return s;
}
