/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The detailed gearset in motion with the calls of a plant.
 */
#include "model/gm_motion.h"
#include "plant/gm_builtin.h"

#include <stddef.h>

static gm_status create(const void *plant, void **motion, gm_error *error)
{
    gm_motion *m = NULL;
    gm_status status = gm_motion_create(plant, &m, error);
    if (status == GM_OK)
        *motion = m;
    return status;
}

static void destroy(void *motion)
{
    gm_motion_destroy(motion);
}

static int n_states(const void *motion)
{
    return gm_motion_n_states(motion);
}

static gm_status start(void *motion, const gm_motion_input *input, const double *speed,
                       double *x, gm_error *error)
{
    return gm_motion_start(motion, input, speed, x, error);
}

static void tolerances(const void *motion, double relative, double *absolute)
{
    gm_motion_tolerances(motion, relative, absolute);
}

static int rates(void *motion, const gm_motion_input *input, const double *x, double *dx)
{
    return gm_motion_rates(motion, input, x, dx);
}

static int entries(const void *motion)
{
    return gm_motion_entries(motion);
}

static void pattern(const void *motion, int *column_start, int *row)
{
    gm_motion_pattern(motion, column_start, row);
}

static int jacobian(void *motion, const gm_motion_input *input, const double *x,
                    double *value)
{
    return gm_motion_jacobian(motion, input, x, value);
}

static int torque_column(void *motion, const gm_motion_input *input, const double *x,
                         int flange, double *column)
{
    return gm_motion_torque_column(motion, input, x, flange, column);
}

static int speed_state(const void *motion, int flange)
{
    return gm_motion_speed_state(motion, flange);
}

static int n_events(const void *motion)
{
    return gm_motion_n_events(motion);
}

static int events(void *motion, const gm_motion_input *input, const double *x, double *g)
{
    return gm_motion_events(motion, input, x, g);
}

static gm_status handle(void *motion, const gm_motion_input *input, double t, double *x,
                        int *changed, gm_error *error)
{
    (void)t;
    return gm_motion_handle(motion, input, x, changed, error);
}

static void view(void *motion, const gm_motion_input *input, const double *x,
                 gm_motion_view *v)
{
    gm_motion_view_at(motion, input, x, v);
}

static int n_signals(const void *motion)
{
    return gm_motion_n_signals(motion);
}

static gm_motion_signal signal_at(const void *motion, int i)
{
    return gm_motion_signal_at(motion, i);
}

static const char *state_name(const void *motion, int i)
{
    return gm_motion_state_name(motion, i);
}

static void observe(void *motion, const gm_motion_input *input, const double *x,
                    double *value)
{
    gm_motion_observe(motion, input, x, value);
}

static const gm_dynamics_class motion_class = {
    .create = create,
    .destroy = destroy,
    .n_states = n_states,
    .start = start,
    .tolerances = tolerances,
    .rates = rates,
    .entries = entries,
    .pattern = pattern,
    .jacobian = jacobian,
    .torque_column = torque_column,
    .torque_row = speed_state,
    .speed_state = speed_state,
    .n_events = n_events,
    .events = events,
    .handle = handle,
    .view = view,
    .n_signals = n_signals,
    .signal = signal_at,
    .state_name = state_name,
    .observe = observe,
};

gm_dynamics gm_builtin_dynamics(const gm_gearset *gearset)
{
    return (gm_dynamics){.is = &motion_class,
                         .plant = gearset,
                         .n_paths = gm_gearset_description(gearset)->n_paths};
}
