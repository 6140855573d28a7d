/* SPDX-License-Identifier: BSD-2-Clause */
#include "plant/gm_moving_model.h"

#include "base/alloc.h"

#include <string.h>

/* Motions may change their modes after any step; x after such a change waits here until
   the solver asks for it. */
typedef struct model {
    const gm_dynamics *of;
    void *motion;
    int n;
    gm_motion_input input;
    double *after;
    int waits;
} model;

static void destroy(void *self)
{
    model *m = self;
    if (m->motion)
        m->of->is->destroy(m->motion);
    gm_free(m->after);
    gm_free(m);
}

static gm_status create(const void *self, void **made, gm_error *error)
{
    model *m = gm_calloc(1, sizeof *m);
    if (!m)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    m->of = self;
    gm_status status = m->of->is->create(m->of->plant, &m->motion, error);
    if (status == GM_OK) {
        m->n = m->of->is->n_states(m->motion);
        m->after = gm_calloc((size_t)m->n, sizeof *m->after);
        if (!m->after)
            status = gm_fail(error, GM_ERR_MEMORY, "out of memory");
    }
    if (status != GM_OK) {
        destroy(m);
        return status;
    }
    *made = m;
    return GM_OK;
}

static int n_states(const void *self)
{
    return ((const model *)self)->n;
}

static int n_events(const void *self)
{
    const model *m = self;
    return m->of->is->n_events(m->motion);
}

static void take(model *m, const gm_rig_command *command)
{
    memcpy(m->input.torque, command->value, sizeof m->input.torque);
    memcpy(m->input.gear, command->gear, sizeof m->input.gear);
}

static gm_status start(void *self, const gm_rig_command *command, double *x,
                       double *nominal, gm_error *error)
{
    static const double at_rest[GM_MAX_FLANGES] = {0.0};
    model *m = self;
    take(m, command);
    m->waits = 0;
    gm_status status = m->of->is->start(m->motion, &m->input, at_rest, x, error);
    if (status == GM_OK)
        m->of->is->tolerances(m->motion, 1.0, nominal);
    return status;
}

static gm_status event(void *self, double t, double *x, gm_error *error)
{
    model *m = self;
    int changed = 0;
    if (m->waits) {
        m->waits = 0;
        memcpy(x, m->after, (size_t)m->n * sizeof *x);
        return GM_OK;
    }
    return m->of->is->handle(m->motion, &m->input, t, x, &changed, error);
}

static gm_status command(void *self, const gm_rig_command *given, double t, double *x,
                         gm_error *error)
{
    take(self, given);
    ((model *)self)->waits = 0;
    return event(self, t, x, error);
}

static gm_status completed(void *self, double t, const double *x, int *due,
                           gm_error *error)
{
    model *m = self;
    memcpy(m->after, x, (size_t)m->n * sizeof *x);
    m->waits = 0;
    *due = 0;
    gm_status status = m->of->is->handle(m->motion, &m->input, t, m->after, due, error);
    m->waits = status == GM_OK && *due;
    return status;
}

static int rates(void *self, double t, const double *x, double *dx)
{
    model *m = self;
    (void)t;
    return m->of->is->rates(m->motion, &m->input, x, dx);
}

static int events(void *self, double t, const double *x, double *g)
{
    model *m = self;
    (void)t;
    return m->of->is->events(m->motion, &m->input, x, g);
}

static int entries(const void *self)
{
    const model *m = self;
    return m->of->is->entries(m->motion);
}

static void pattern(const void *self, int *column_start, int *row)
{
    const model *m = self;
    m->of->is->pattern(m->motion, column_start, row);
}

static int jacobian(void *self, double t, const double *x, double *value)
{
    model *m = self;
    (void)t;
    return m->of->is->jacobian(m->motion, &m->input, x, value);
}

static gm_status view(void *self, double t, const double *x, gm_rig_view *seen,
                      gm_error *error)
{
    model *m = self;
    gm_motion_view at;
    (void)t;
    (void)error;
    m->of->is->view(m->motion, &m->input, x, &at);
    memset(seen, 0, sizeof *seen);
    for (int f = 0; f <= m->of->n_paths; f++) {
        seen->speed[f] = at.speed[f];
        seen->torque[f] = m->input.torque[f];
    }
    return GM_OK;
}

static const char *why(const void *self)
{
    (void)self;
    return ""; /* the solver says it */
}

static const gm_continuous_class moving_class = {
    .create = create,
    .destroy = destroy,
    .n_states = n_states,
    .n_events = n_events,
    .start = start,
    .command = command,
    .rates = rates,
    .events = events,
    .completed = completed,
    .event = event,
    .view = view,
    .why = why,
    .entries = entries,
    .pattern = pattern,
    .jacobian = jacobian,
};

gm_continuous gm_moving_model(const gm_dynamics *dynamics, double step)
{
    return (gm_continuous){.is = &moving_class,
                           .self = dynamics,
                           .n_paths = dynamics->n_paths,
                           .step = step};
}
