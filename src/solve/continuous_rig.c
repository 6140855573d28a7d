/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Backward differences up to order two (elastic gearsets are lightly damped), with the
 * model's Jacobian or a dense one from differences.
 */
#include "solve/gm_continuous_rig.h"

#include "base/alloc.h"
#include "solve/sun_ode.h"

#include <math.h>
#include <string.h>

enum { ORDER = 2, MOST_STEPS = 1000000 };

typedef struct run {
    const gm_continuous_rig *of;
    void *model;
    gm_sun_ode *ode;
    int n, n_events;
    int fresh; /* 1: the solver must start anew from x */
    double t;
    double *x, *nominal, *rate, *moved, *absolute;
    int *column_start, *row;
    gm_rig_command command;
} run;

static const gm_continuous_class *calls(const run *r)
{
    return r->of->model->is;
}

/* ---- the equations ---- */

static int rates(void *user, double t, const double *x, double *dx)
{
    run *r = user;
    return calls(r)->rates(r->model, t, x, dx);
}

static int events(void *user, double t, const double *x, double *g)
{
    run *r = user;
    return calls(r)->events(r->model, t, x, g);
}

/* A foreign model tells no pattern: all entries, column by column. */
static int differences(void *user, double t, const double *x, double *value)
{
    run *r = user;
    int flag = rates(r, t, x, r->rate);
    memcpy(r->moved, x, (size_t)r->n * sizeof *x);
    for (int k = 0; k < r->n && !flag; k++) {
        double *column = value + (long)k * r->n;
        double step = 1e-7 * fmax(fabs(x[k]), r->nominal[k]);
        r->moved[k] = x[k] + step;
        flag = rates(r, t, r->moved, column);
        step = r->moved[k] - x[k];
        r->moved[k] = x[k];
        for (int i = 0; i < r->n; i++)
            column[i] = (column[i] - r->rate[i]) / step;
    }
    return flag;
}

static int own(void *user, double t, const double *x, double *value)
{
    run *r = user;
    return calls(r)->jacobian(r->model, t, x, value);
}

/* ---- life ---- */

static void destroy(void *self)
{
    run *r = self;
    gm_sun_ode_destroy(r->ode);
    if (r->model)
        calls(r)->destroy(r->model);
    gm_free(r->x);
    gm_free(r->nominal);
    gm_free(r->rate);
    gm_free(r->moved);
    gm_free(r->absolute);
    gm_free(r->column_start);
    gm_free(r->row);
    gm_free(r);
}

static gm_status make_room(run *r, gm_error *error)
{
    size_t n = (size_t)r->n;
    r->x = gm_calloc(n, sizeof *r->x);
    r->nominal = gm_calloc(n, sizeof *r->nominal);
    r->rate = gm_calloc(n, sizeof *r->rate);
    r->moved = gm_calloc(n, sizeof *r->moved);
    r->absolute = gm_calloc(n, sizeof *r->absolute);
    r->column_start = gm_calloc(n + 1, sizeof *r->column_start);
    size_t entries = calls(r)->jacobian ? (size_t)calls(r)->entries(r->model) : n * n;
    r->row = gm_calloc(entries, sizeof *r->row);
    if (!r->x || !r->nominal || !r->rate || !r->moved || !r->absolute ||
        !r->column_start || !r->row)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    if (calls(r)->jacobian) {
        calls(r)->pattern(r->model, r->column_start, r->row);
        return GM_OK;
    }
    for (int k = 0; k <= r->n; k++)
        r->column_start[k] = k * r->n;
    for (int k = 0; k < r->n * r->n; k++)
        r->row[k] = k % r->n;
    return GM_OK;
}

static gm_status create(const void *self, void **made, gm_error *error)
{
    run *r = gm_calloc(1, sizeof *r);
    if (!r)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    r->of = self;
    gm_status status = calls(r)->create(r->of->model->self, &r->model, error);
    if (status == GM_OK) {
        r->n = calls(r)->n_states(r->model);
        r->n_events = calls(r)->n_events(r->model);
        status = make_room(r, error);
    }
    if (status != GM_OK) {
        destroy(r);
        return status;
    }
    *made = r;
    return GM_OK;
}

/* ---- time ---- */

/* The solver takes its tolerances at birth, and nominal values are known after the start
   only. */
static gm_status make_solver(run *r, gm_error *error)
{
    const gm_sun_ode_system system = {.n = r->n,
                                      .user = r,
                                      .rates = rates,
                                      .column_start = r->column_start,
                                      .row = r->row,
                                      .jacobian = calls(r)->jacobian ? own : differences,
                                      .n_events = r->n_events,
                                      .events = events};
    for (int k = 0; k < r->n; k++) {
        if (!(r->nominal[k] > 0.0))
            r->nominal[k] = 1.0;
        r->absolute[k] = r->of->tolerance * r->nominal[k];
    }
    gm_sun_ode_destroy(r->ode);
    r->ode = gm_sun_ode_create(&system, r->of->tolerance, r->absolute, ORDER, 0.0);
    return r->ode ? GM_OK : gm_fail(error, GM_ERR_MEMORY, "out of memory");
}

static gm_status start(void *self, const gm_rig_command *command, gm_rig_view *view,
                       gm_error *error)
{
    run *r = self;
    r->t = 0.0;
    r->command = *command;
    r->fresh = 1;
    gm_status status = calls(r)->start(r->model, command, r->x, r->nominal, error);
    if (status == GM_OK && r->n > 0)
        status = make_solver(r, error);
    return status == GM_OK ? calls(r)->view(r->model, r->t, r->x, view, error) : status;
}

static gm_status no_solution(run *r, gm_error *error)
{
    const char *why = calls(r)->why(r->model);
    r->fresh = 1;
    return gm_fail(error, GM_ERR_TOOL, "no motion beyond %.9g s: %s", r->t,
                   why[0] ? why : gm_sun_ode_message(r->ode));
}

static gm_status handle(run *r, int due, gm_error *error)
{
    gm_status status = GM_OK;
    if (!due)
        status = calls(r)->completed(r->model, r->t, r->x, &due, error);
    if (status != GM_OK || !due)
        return status;
    r->fresh = 1;
    return calls(r)->event(r->model, r->t, r->x, error);
}

static gm_status advance(run *r, double end, gm_error *error)
{
    gm_status status = GM_OK;
    for (long k = 0; k < MOST_STEPS && r->t < end && status == GM_OK; k++) {
        if (r->fresh && gm_sun_ode_start(r->ode, r->t, r->x, 0.0))
            return no_solution(r, error);
        r->fresh = 0;
        if (gm_sun_ode_stop_at(r->ode, end))
            return no_solution(r, error);
        gm_sun_ode_outcome outcome = gm_sun_ode_step(r->ode, &r->t, r->x);
        if (outcome > GM_ODE_EVENT)
            return no_solution(r, error);
        status = handle(r, outcome == GM_ODE_EVENT, error);
        if (outcome == GM_ODE_STOP)
            r->t = end;
    }
    if (status == GM_OK && r->t < end)
        status =
            gm_fail(error, GM_ERR_TOOL, "too many steps of the solver at %.9g s", r->t);
    return status;
}

static gm_status step(void *self, const gm_rig_command *command, double h,
                      gm_rig_view *view, gm_error *error)
{
    run *r = self;
    gm_status status = GM_OK;
    double end = r->t + h;
    if (memcmp(command, &r->command, sizeof *command) != 0) {
        r->command = *command;
        r->fresh = 1;
        status = calls(r)->command(r->model, command, r->t, r->x, error);
    }
    if (status == GM_OK && r->n > 0)
        status = advance(r, end, error);
    r->t = end;
    return status == GM_OK ? calls(r)->view(r->model, r->t, r->x, view, error) : status;
}

static const gm_rig_class continuous_class = {create, destroy, start, step};

void gm_continuous_rig_init(gm_continuous_rig *rig, const gm_continuous *model,
                            double tolerance)
{
    *rig = (gm_continuous_rig){.rig = {.is = &continuous_class,
                                       .self = rig,
                                       .n_paths = model->n_paths,
                                       .step = model->step},
                               .model = model,
                               .tolerance = tolerance};
    memcpy(rig->rig.drive, model->drive, sizeof model->drive);
}
