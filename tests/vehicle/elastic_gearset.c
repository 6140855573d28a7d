/* SPDX-License-Identifier: BSD-2-Clause */
#include "elastic_gearset.h"

#include "base/alloc.h"

#include <string.h>

enum { IN, OUT, TWIST, STATES };

typedef struct motion {
    const elastic_gearset *g;
} motion;

static gm_status create(const void *plant, void **made, gm_error *error)
{
    motion *m = gm_calloc(1, sizeof *m);
    if (!m)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    m->g = plant;
    *made = m;
    return GM_OK;
}

static void destroy(void *m)
{
    gm_free(m);
}

static int n_states(const void *m)
{
    (void)m;
    return STATES;
}

static gm_status start(void *user, const gm_motion_input *input, const double *speed,
                       double *x, gm_error *error)
{
    const motion *m = user;
    (void)input, (void)error;
    x[OUT] = speed[0];
    x[IN] = m->g->ratio * speed[0];
    x[TWIST] = 0.0;
    return GM_OK;
}

static void tolerances(const void *m, double relative, double *absolute)
{
    (void)m;
    absolute[IN] = absolute[OUT] = 100.0 * relative;
    absolute[TWIST] = 1e-2 * relative;
}

static double spring(const elastic_gearset *g, const double *x)
{
    return g->stiffness * x[TWIST] + g->damping * (x[IN] - g->ratio * x[OUT]);
}

static int rates(void *user, const gm_motion_input *input, const double *x, double *dx)
{
    const elastic_gearset *g = ((motion *)user)->g;
    double T = spring(g, x);
    dx[IN] = (input->torque[1] - T) / g->inertia_in;
    dx[OUT] = (input->torque[0] + g->ratio * T - g->drag * x[OUT]) / g->inertia_out;
    dx[TWIST] = x[IN] - g->ratio * x[OUT];
    return 0;
}

static int entries(const void *m)
{
    (void)m;
    return STATES * STATES;
}

static void pattern(const void *m, int *column_start, int *row)
{
    (void)m;
    for (int k = 0; k <= STATES; k++)
        column_start[k] = STATES * k;
    for (int i = 0; i < STATES * STATES; i++)
        row[i] = i % STATES;
}

static int jacobian(void *user, const gm_motion_input *input, const double *x,
                    double *value)
{
    const elastic_gearset *g = ((motion *)user)->g;
    double r = g->ratio, c = g->damping, k = g->stiffness;
    (void)input, (void)x;
    const double columns[STATES][STATES] = {
        {-c / g->inertia_in, r * c / g->inertia_out, 1.0},
        {r * c / g->inertia_in, -(r * r * c + g->drag) / g->inertia_out, -r},
        {-k / g->inertia_in, r * k / g->inertia_out, 0.0}};
    memcpy(value, columns, sizeof columns);
    return 0;
}

static int torque_column(void *user, const gm_motion_input *input, const double *x,
                         int flange, double *column)
{
    const elastic_gearset *g = ((motion *)user)->g;
    (void)input, (void)x;
    memset(column, 0, STATES * sizeof *column);
    column[flange == 0 ? OUT : IN] = 1.0 / (flange == 0 ? g->inertia_out : g->inertia_in);
    return 0;
}

static int speed_state(const void *m, int flange)
{
    (void)m;
    return flange == 0 ? OUT : IN;
}

static int n_events(const void *m)
{
    (void)m;
    return 0;
}

static int events(void *m, const gm_motion_input *input, const double *x, double *g)
{
    (void)m, (void)input, (void)x, (void)g;
    return 0;
}

static gm_status handle(void *m, const gm_motion_input *input, double t, double *x,
                        int *changed, gm_error *error)
{
    (void)m, (void)input, (void)t, (void)x, (void)error;
    *changed = 0;
    return GM_OK;
}

static void view(void *user, const gm_motion_input *input, const double *x,
                 gm_motion_view *seen)
{
    const elastic_gearset *g = ((motion *)user)->g;
    double dx[STATES], slip = x[IN] - g->ratio * x[OUT];
    rates(user, input, x, dx);
    *seen = (gm_motion_view){.speed = {x[OUT], x[IN]},
                             .acceleration = {dx[OUT], dx[IN]},
                             .loss_power =
                                 g->damping * slip * slip + g->drag * x[OUT] * x[OUT],
                             .stored_energy = 0.5 * (g->inertia_in * x[IN] * x[IN] +
                                                     g->inertia_out * x[OUT] * x[OUT] +
                                                     g->stiffness * x[TWIST] * x[TWIST]),
                             .state = {2}};
}

#define CALLS                                                                            \
    .create = create, .destroy = destroy, .n_states = n_states, .start = start,          \
    .tolerances = tolerances, .rates = rates, .torque_column = torque_column,            \
    .speed_state = speed_state, .n_events = n_events, .events = events,                  \
    .handle = handle, .view = view

static const gm_dynamics_class plain = {CALLS};
static const gm_dynamics_class with_jacobian = {CALLS, .entries = entries,
                                                .pattern = pattern, .jacobian = jacobian};

gm_dynamics elastic_gearset_dynamics(const elastic_gearset *gearset)
{
    return (gm_dynamics){.is = gearset->with_jacobian ? &with_jacobian : &plain,
                         .plant = gearset,
                         .n_paths = 1};
}
