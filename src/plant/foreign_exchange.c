/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A foreign FMU in Model Exchange: its rates, events and what is seen.
 */
#include "plant/foreign_parts.h"

#include "base/alloc.h"

#include <string.h>

enum { EVENT_ROUNDS = 100 };

typedef struct model {
    const gm_foreign *of;
    fmi_instance *it;
    gm_rig_command command;
    double angle[GM_MAX_FLANGES], angle_since; /* of flanges that take speed; s */
    gm_error error;
} model;

static void destroy(void *self)
{
    model *m = self;
    gm_fmi_close(m->it);
    gm_free(m);
}

static gm_status create(const void *self, void **made, gm_error *error)
{
    model *m = gm_calloc(1, sizeof *m);
    if (!m)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    m->of = self;
    gm_status status =
        gm_fmi_open(&m->of->description, m->of->folder, FMI_EXCHANGE, &m->it, error);
    if (status != GM_OK) {
        destroy(m);
        return status;
    }
    *made = m;
    return GM_OK;
}

static int n_states(const void *self)
{
    return ((const model *)self)->of->description.n_states;
}

static int n_events(const void *self)
{
    return ((const model *)self)->of->description.n_indicators;
}

/* From event mode to continuous time. */
static gm_status settle(model *m, double *x, gm_error *error)
{
    int again = 1;
    gm_status status = GM_OK;
    for (int i = 0; i < EVENT_ROUNDS && again && status == GM_OK; i++)
        status = gm_fmi_check(m->it, "NewDiscreteStates",
                              m->it->is->update(m->it, &again), error);
    if (status == GM_OK && again)
        status = gm_fail(error, GM_ERR_TOOL, "an event of the FMU does not end");
    if (status == GM_OK)
        status = gm_fmi_check(m->it, "EnterContinuousTimeMode",
                              m->it->is->to_continuous(m->it), error);
    if (status == GM_OK && n_states(m) > 0)
        status = gm_fmi_check(m->it, "GetContinuousStates",
                              m->it->is->get_states(m->it, x, n_states(m)), error);
    return status;
}

static gm_status start(void *self, const gm_rig_command *command, double *x,
                       double *nominal, gm_error *error)
{
    model *m = self;
    m->command = *command;
    m->angle_since = 0.0;
    memset(m->angle, 0, sizeof m->angle);
    gm_status status = gm_foreign_begin(m->of, m->it, command, error);
    if (status == GM_OK)
        status = settle(m, x, error);
    if (status == GM_OK && n_states(m) > 0)
        status = gm_fmi_check(m->it, "GetNominalsOfContinuousStates",
                              m->it->is->nominals(m->it, nominal, n_states(m)), error);
    return status;
}

static int failed(model *m, const char *called, fmi_answer answer)
{
    if (gm_fmi_check(m->it, called, answer, &m->error) == GM_OK)
        return 0;
    return answer == FMI_DISCARD ? 1 : -1;
}

/* Speeds that are taken carry their angles along. */
static gm_status put_angles(model *m, double t, gm_error *error)
{
    double angle[GM_MAX_FLANGES];
    for (int f = 0; f < GM_MAX_FLANGES; f++)
        angle[f] = m->angle[f] + (t - m->angle_since) * m->command.value[f];
    int any = 0;
    for (int f = 0; f <= m->of->file->n_paths; f++)
        any |= m->of->flange[f].angle.is != NULL;
    return any ? gm_foreign_put(m->of, m->it, &m->command, angle, error) : GM_OK;
}

static int put(model *m, double t, const double *x)
{
    int flag = failed(m, "SetTime", m->it->is->set_time(m->it, t));
    if (!flag && n_states(m) > 0)
        flag = failed(m, "SetContinuousStates",
                      m->it->is->set_states(m->it, x, n_states(m)));
    if (!flag && put_angles(m, t, &m->error) != GM_OK)
        flag = -1;
    return flag;
}

static gm_status said(const model *m, int flag, gm_error *error)
{
    if (flag == 0)
        return GM_OK;
    if (error)
        *error = m->error;
    return m->error.status;
}

static gm_status event(void *self, double t, double *x, gm_error *error)
{
    model *m = self;
    gm_status status = said(m, put(m, t, x), error);
    if (status == GM_OK)
        status =
            gm_fmi_check(m->it, "EnterEventMode", m->it->is->to_events(m->it), error);
    return status == GM_OK ? settle(m, x, error) : status;
}

static gm_status command(void *self, const gm_rig_command *next, double t, double *x,
                         gm_error *error)
{
    model *m = self;
    gm_status status = said(m, put(m, t, x), error);
    for (int f = 0; f < GM_MAX_FLANGES; f++)
        m->angle[f] += (t - m->angle_since) * m->command.value[f];
    m->angle_since = t;
    m->command = *next;
    return status == GM_OK ? gm_foreign_put(m->of, m->it, next, m->angle, error) : status;
}

static int rates(void *self, double t, const double *x, double *dx)
{
    model *m = self;
    int flag = put(m, t, x);
    return flag ? flag
                : failed(m, "GetDerivatives", m->it->is->rates(m->it, dx, n_states(m)));
}

static int events(void *self, double t, const double *x, double *g)
{
    model *m = self;
    int flag = put(m, t, x);
    return flag ? flag
                : failed(m, "GetEventIndicators",
                         m->it->is->indicators(m->it, g, n_events(m)));
}

static gm_status completed(void *self, double t, const double *x, int *due,
                           gm_error *error)
{
    model *m = self;
    gm_status status = said(m, put(m, t, x), error);
    if (status != GM_OK)
        return status;
    return gm_fmi_check(m->it, "CompletedIntegratorStep",
                        m->it->is->completed(m->it, due), error);
}

static gm_status view(void *self, double t, const double *x, gm_rig_view *seen,
                      gm_error *error)
{
    model *m = self;
    gm_status status = said(m, put(m, t, x), error);
    return status == GM_OK ? gm_foreign_view(m->of, m->it, &m->command, seen, error)
                           : status;
}

static const char *why(const void *self)
{
    return ((const model *)self)->error.message;
}

const gm_continuous_class gm_foreign_continuous_class = {
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
};
