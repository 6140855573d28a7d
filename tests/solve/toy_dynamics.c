/* SPDX-License-Identifier: BSD-2-Clause
 *
 * States: angle of body 0 (of the spring for the oscillator), speed of body 0, speed of
 * body 1.
 */
#include "toy_dynamics.h"

#include "base/alloc.h"

#include <math.h>
#include <string.h>

typedef struct toy_motion {
    const toy *t;
    int mode;         /* stick: -1, 0, 1 direction of sliding; clutch: 1 joined */
    double jump_loss; /* J */
} toy_motion;

static gm_status create(const void *plant, void **motion, gm_error *error)
{
    toy_motion *m = gm_calloc(1, sizeof *m);
    if (!m)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    m->t = plant;
    *motion = m;
    return GM_OK;
}

static void destroy(void *motion)
{
    gm_free(motion);
}

static int n_states(const void *motion)
{
    (void)motion;
    return 3;
}

static gm_status start(void *motion, const gm_motion_input *input, const double *speed,
                       double *x, gm_error *error)
{
    toy_motion *m = motion;
    (void)error;
    x[0] = m->t->kind == TOY_BALL ? 1.0 : 0.0;
    x[1] = speed[0];
    x[2] = speed[1];
    m->mode = m->t->kind == TOY_CLUTCH ? input->gear[0] == 1 : 0;
    return GM_OK;
}

static const char *state_name(const void *motion, int i)
{
    static const char *const name[] = {"twist", "body 0", "body 1"};
    (void)motion;
    return name[i];
}

static void tolerances(const void *motion, double relative, double *absolute)
{
    (void)motion;
    for (int i = 0; i < 3; i++)
        absolute[i] = relative;
}

static double friction(const toy_motion *m)
{
    return m->t->kind == TOY_STICK ? m->t->slide * m->mode : 0.0;
}

static double spring(const toy *t, const double *x)
{
    return t->kind == TOY_OSCILLATOR ? t->stiffness * x[0] + t->damping * (x[1] - x[2])
                                     : 0.0;
}

static int rates(void *motion, const gm_motion_input *input, const double *x, double *dx)
{
    const toy_motion *m = motion;
    const toy *t = m->t;
    double force = spring(t, x);
    if (t->kind == TOY_GIVES_UP && x[0] > 1.0)
        return -1;
    dx[0] = t->kind == TOY_OSCILLATOR ? x[1] - x[2] : x[1];
    dx[1] = input->torque[0] - t->drag * x[1] - t->gravity - force - friction(m);
    dx[1] /= t->inertia[0];
    dx[2] = (input->torque[1] + force) / t->inertia[1];
    if (t->kind == TOY_STICK && m->mode == 0)
        dx[0] = dx[1] = 0.0;
    if (t->kind == TOY_CLUTCH && m->mode == 1) {
        double sum = input->torque[0] + input->torque[1] - t->drag * x[1];
        dx[1] = dx[2] = sum / (t->inertia[0] + t->inertia[1]);
    }
    if (t->kind == TOY_NAN && x[0] > 1.0)
        dx[1] = (double)NAN;
    return 0;
}

static int entries(const void *motion)
{
    (void)motion;
    return 9;
}

static void pattern(const void *motion, int *column_start, int *row)
{
    (void)motion;
    for (int k = 0; k < 9; k++)
        row[k] = k % 3;
    for (int j = 0; j <= 3; j++)
        column_start[j] = 3 * j;
}

static int jacobian(void *motion, const gm_motion_input *input, const double *x,
                    double *value)
{
    const toy_motion *m = motion;
    const toy *t = m->t;
    (void)input, (void)x;
    memset(value, 0, 9 * sizeof *value);
    value[3] = 1.0;
    value[4] = -t->drag / t->inertia[0];
    if (t->kind == TOY_OSCILLATOR) {
        value[6] = -1.0;
        value[1] = -t->stiffness / t->inertia[0];
        value[4] -= t->damping / t->inertia[0];
        value[7] = t->damping / t->inertia[0];
        value[2] = t->stiffness / t->inertia[1];
        value[5] = t->damping / t->inertia[1];
        value[8] = -t->damping / t->inertia[1];
    }
    if (t->kind == TOY_STICK && m->mode == 0)
        value[3] = value[4] = 0.0;
    if (t->kind == TOY_CLUTCH && m->mode == 1)
        value[4] = value[5] = -t->drag / (t->inertia[0] + t->inertia[1]);
    return 0;
}

static int torque_column(void *motion, const gm_motion_input *input, const double *x,
                         int flange, double *column)
{
    const toy_motion *m = motion;
    const toy *t = m->t;
    (void)input, (void)x;
    memset(column, 0, 3 * sizeof *column);
    column[1 + flange] = 1.0 / t->inertia[flange];
    if (t->kind == TOY_CLUTCH && m->mode == 1)
        column[1] = column[2] = 1.0 / (t->inertia[0] + t->inertia[1]);
    return 0;
}

static int speed_state(const void *motion, int flange)
{
    (void)motion;
    return 1 + flange;
}

static int n_events(const void *motion)
{
    const toy_motion *m = motion;
    return m->t->kind == TOY_BALL || m->t->kind == TOY_STICK;
}

/* The ball meets the ground; what slides stops; what sticks breaks away. */
static int events(void *motion, const gm_motion_input *input, const double *x, double *g)
{
    const toy_motion *m = motion;
    if (m->t->kind == TOY_BALL)
        g[0] = x[0];
    else
        g[0] = m->mode ? x[1] : m->t->hold - fabs(input->torque[0]);
    return 0;
}

static void handle_stick(toy_motion *m, const gm_motion_input *input, double *x,
                         int *changed)
{
    double torque = input->torque[0];
    if (m->mode != 0 && x[1] * m->mode <= 0.0) {
        m->mode = 0;
        x[1] = 0.0;
        *changed = 1;
    }
    if (m->mode == 0 && fabs(torque) >= m->t->hold) {
        m->mode = torque > 0.0 ? 1 : -1;
        *changed = 1;
    }
}

static gm_status handle(void *motion, const gm_motion_input *input, double t, double *x,
                        int *changed, gm_error *error)
{
    toy_motion *m = motion;
    (void)t, (void)error;
    *changed = m->t->kind == TOY_RESTLESS;
    if (m->t->kind == TOY_BALL && x[0] <= 1e-9 && x[1] < 0.0) {
        double kept = m->t->restitution;
        m->jump_loss += 0.5 * m->t->inertia[0] * x[1] * x[1] * (1.0 - kept * kept);
        x[0] = 0.0;
        x[1] *= -kept;
        *changed = 1;
    }
    if (m->t->kind == TOY_STICK)
        handle_stick(m, input, x, changed);
    if (m->t->kind == TOY_CLUTCH && m->mode != (input->gear[0] == 1)) {
        m->mode = input->gear[0] == 1;
        *changed = 1;
        const double *J = m->t->inertia;
        if (m->mode)
            m->jump_loss +=
                0.5 * J[0] * J[1] / (J[0] + J[1]) * (x[1] - x[2]) * (x[1] - x[2]);
        if (m->mode)
            x[1] = x[2] = (J[0] * x[1] + J[1] * x[2]) / (J[0] + J[1]);
    }
    return GM_OK;
}

static void view(void *motion, const gm_motion_input *input, const double *x,
                 gm_motion_view *v)
{
    const toy_motion *m = motion;
    const toy *t = m->t;
    double dx[3], slip = x[1] - x[2];
    (void)rates(motion, input, x, dx);
    for (int f = 0; f < 2; f++) {
        v->speed[f] = x[1 + f];
        v->acceleration[f] = dx[1 + f];
    }
    v->loss_power = t->drag * x[1] * x[1] + friction(m) * x[1] +
                    (t->kind == TOY_OSCILLATOR ? t->damping * slip * slip : 0.0);
    v->jump_loss = m->jump_loss;
    v->stored_energy = 0.5 * t->inertia[0] * x[1] * x[1] +
                       0.5 * t->inertia[1] * x[2] * x[2] + t->gravity * x[0] +
                       (t->kind == TOY_OSCILLATOR ? 0.5 * t->stiffness * x[0] * x[0] : 0);
}

static int n_signals(const void *motion)
{
    (void)motion;
    return 1;
}

static gm_motion_signal signal(const void *motion, int i)
{
    (void)motion, (void)i;
    return (gm_motion_signal){"twist", "rad"};
}

static void observe(void *motion, const gm_motion_input *input, const double *x,
                    double *value)
{
    (void)motion, (void)input;
    value[0] = x[0];
}

#define TOY_CALLS                                                                        \
    .create = create, .destroy = destroy, .n_states = n_states, .start = start,          \
    .state_name = state_name, .tolerances = tolerances, .rates = rates,                  \
    .torque_column = torque_column, .speed_state = speed_state, .n_events = n_events,    \
    .events = events, .handle = handle, .view = view, .n_signals = n_signals,            \
    .signal = signal, .observe = observe

static const gm_dynamics_class with_jacobian = {TOY_CALLS, .entries = entries,
                                                .pattern = pattern, .jacobian = jacobian};
static const gm_dynamics_class without_jacobian = {TOY_CALLS};

gm_dynamics toy_dynamics(const toy *t)
{
    return (gm_dynamics){.is = t->no_jacobian ? &without_jacobian : &with_jacobian,
                         .plant = t,
                         .n_paths = 1};
}
