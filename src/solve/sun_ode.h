/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Ordinary differential equations solved by CVODE, step by step: backward differences,
 * Newton's method with the sparse Jacobian of the system (sun.h).
 */
#ifndef SUN_ODE_H
#define SUN_ODE_H

/** The system dx/dt = rates(t, x). Callbacks get `user` and return 0 done, > 0 not at
 *  this x (a smaller step is taken), < 0 never. */
typedef struct gm_sun_ode_system {
    int n;
    void *user;
    int (*rates)(void *user, double t, const double *x, double *dx);
    /* d rates / d x, compressed columns that contain the diagonal; outlive the solver. */
    const int *column_start, *row;
    int (*jacobian)(void *user, double t, const double *x, double *value);
    int n_events;
    int (*events)(void *user, double t, const double *x, double *g);
} gm_sun_ode_system;

typedef enum gm_sun_ode_outcome {
    GM_ODE_STEP,  /* one step was taken */
    GM_ODE_STOP,  /* the time to stop at is reached */
    GM_ODE_EVENT, /* an event function changes its sign here */
    GM_ODE_ERROR_TOO_LARGE,
    GM_ODE_NO_CONVERGENCE,
    GM_ODE_NO_RATES, /* rates, Jacobian or event functions failed, for good or at the
                        first point */
    GM_ODE_BROKEN    /* no memory, singular matrix: see the message */
} gm_sun_ode_outcome;

/** Work of all runs so far. */
typedef struct gm_sun_ode_counts {
    long steps, rates, jacobians, error_failures, convergence_failures;
} gm_sun_ode_counts;

typedef struct gm_sun_ode gm_sun_ode;

/** relative error of a step, absolute[n] error of each state, highest order (1 to 5; a
 *  lightly damped mesh lies where orders three to five are unstable), longest step [s]
 *  (0: any). NULL when there is no memory. */
gm_sun_ode *gm_sun_ode_create(const gm_sun_ode_system *system, double relative,
                              const double *absolute, int order_max, double step_max);
void gm_sun_ode_destroy(gm_sun_ode *ode);

/** Begin at t from x[n] with a first step [s], 0: its own guess. Non-zero: failed. */
int gm_sun_ode_start(gm_sun_ode *ode, double t, const double *x, double step);

/** The next steps end at this time at the latest and evaluate nothing beyond it. */
int gm_sun_ode_stop_at(gm_sun_ode *ode, double t);

/** One step of the solver's own length. *t is where it arrived; x[n] (not NULL) the state
 *  there. */
gm_sun_ode_outcome gm_sun_ode_step(gm_sun_ode *ode, double *t, double *x);

/** x[n] at a time within the last step. Non-zero: failed. */
int gm_sun_ode_at(gm_sun_ode *ode, double t, double *x);

/** Length of the last step [s]. */
double gm_sun_ode_last_step(const gm_sun_ode *ode);

gm_sun_ode_counts gm_sun_ode_work(const gm_sun_ode *ode);

/** The state whose error weighed most in the last step. */
int gm_sun_ode_worst_state(gm_sun_ode *ode);

/** The state whose rate was last found not to be a number since the start, or -1. */
int gm_sun_ode_nan_state(const gm_sun_ode *ode);

/** The last message of SUNDIALS, "" if there was none. */
const char *gm_sun_ode_message(const gm_sun_ode *ode);

#endif
