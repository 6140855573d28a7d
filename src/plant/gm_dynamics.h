/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The motion of a plant over time: ordinary differential equations between events, as
 * the transient solver, the simulate command and the vehicle see them. The detailed
 * gearset is one such plant, a reduced gearset as an FMU another; none of its users knows
 * which.
 *
 *   dx/dt = rates(x, input)        input: torques at the flanges, commanded gears
 *
 * The number of states and the pattern of the Jacobian stay the same over a run; what a
 * shift or a held shaft changes are modes inside the motion, and a mode changes only in
 * start and handle. One motion belongs to one thread; its plant may be shared.
 */
#ifndef GM_DYNAMICS_H
#define GM_DYNAMICS_H

#include "base/gm_status.h"
#include "model/gm_moving.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Calls of a motion. `motion` is made by create and destroyed by its user. Calls that
 *  return int: 0 done, > 0 this state cannot be evaluated (the solver takes a smaller
 *  step), < 0 the plant failed for good. */
typedef struct gm_dynamics_class {
    gm_status (*create)(const void *plant, void **motion, gm_error *error);
    void (*destroy)(void *motion);

    int (*n_states)(const void *motion);
    /* Begin: gears of *input engaged, flanges at speed[n_flanges] (rad/s; where an
       engaged path disagrees with the output, the output wins), elastic parts unloaded.
       Fills x[n_states] and the modes. */
    gm_status (*start)(void *motion, const gm_motion_input *input, const double *speed,
                       double *x, gm_error *error);
    /* Name of state i for messages, such as "shaft input"; NULL: they have none. */
    const char *(*state_name)(const void *motion, int i);
    /* Absolute error of each state that matters as little as `relative` of a typical
       value. */
    void (*tolerances)(const void *motion, double relative, double *absolute);
    int (*rates)(void *motion, const gm_motion_input *input, const double *x, double *dx);

    /* d rates / d x, compressed columns: column_start[n_states + 1], row[entries],
       value[entries]. NULL where the plant has none: the solver takes differences. */
    int (*entries)(const void *motion);
    void (*pattern)(const void *motion, int *column_start, int *row);
    int (*jacobian)(void *motion, const gm_motion_input *input, const double *x,
                    double *value);
    /* d rates / d torque of a flange: column[n_states]. */
    int (*torque_column)(void *motion, const gm_motion_input *input, const double *x,
                         int flange, double *column);
    /* The only state whose rate a flange's torque changes; NULL: it may be any. */
    int (*torque_row)(const void *motion, int flange);
    /* Which state is the speed of a flange: the systems around couple to it. */
    int (*speed_state)(const void *motion, int flange);

    /* Event functions g[n_events]: the solver stops where one changes its sign. */
    int (*n_events)(const void *motion);
    int (*events)(void *motion, const gm_motion_input *input, const double *x, double *g);
    /* When the solver is to stop next in any case, t being the present time [s]; NULL:
       the plant has no times of its own. */
    double (*next)(const void *motion, double t);
    /* Called at such a stop, after a change of commanded gears, and after every accepted
       step: bring modes to what holds from now on, x may jump. *changed: the solver
       restarts. */
    gm_status (*handle)(void *motion, const gm_motion_input *input, double t, double *x,
                        int *changed, gm_error *error);

    void (*view)(void *motion, const gm_motion_input *input, const double *x,
                 gm_motion_view *view);
    int (*n_signals)(const void *motion);
    gm_motion_signal (*signal)(const void *motion, int i);
    void (*observe)(void *motion, const gm_motion_input *input, const double *x,
                    double *value); /* [n_signals] */
} gm_dynamics_class;

/** A plant that moves; constant, may be shared by threads. */
typedef struct gm_dynamics {
    const gm_dynamics_class *is;
    const void *plant;
    int n_paths;
} gm_dynamics;

#ifdef __cplusplus
}
#endif
#endif
