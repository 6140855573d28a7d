/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Motion over time: integrates a system of ordinary differential equations with modes by
 * CVODE (backward differences, by default of order one and two, sparse Jacobian) and
 * keeps its account of energy.
 *
 * Inputs may depend on time. They are smooth over pieces; where a piece ends, the solver
 * stops exactly, so that no step runs over a jump. Between the ends of pieces it stops at
 * the system's events. After each step the system may change its modes; then the solver
 * starts again from where it is. A mode holds up to and including the instant at which it
 * ends: what is seen there is what was before the change.
 */
#ifndef GM_TRANSIENT_H
#define GM_TRANSIENT_H

#include "base/gm_status.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What begins at one instant. */
typedef struct gm_transient_piece {
    double end; /* s, later than now: the inputs are smooth up to here; may be infinite */
    int restart; /* 1: x or the rates jump here; 0: a kink of the rates at most */
    double work; /* J put in by a jump of prescribed speeds */
} gm_transient_piece;

/** Powers of the account at one instant. */
typedef struct gm_transient_powers {
    double in;      /* W, net power of all that acts from outside */
    double through; /* W >= 0, how much passes: the larger of what flows in and out */
    double loss;    /* W >= 0 */
    double stored;  /* J */
    double lost;    /* J >= 0, given up in jumps of x since the start */
} gm_transient_powers;

/** A system. Calls that return int: 0 done, > 0 this x cannot be evaluated (the solver
 *  takes a smaller step), < 0 it failed for good. The pattern outlives the solver. */
typedef struct gm_transient_system {
    void *user;
    int n_states, n_events;
    /* Pattern of d rates / d x in compressed columns; contains the diagonal. */
    const int *column_start, *row;
    /* State at the start. */
    gm_status (*start)(void *user, double t, double *x, gm_error *error);
    /* Absolute error of each state as unimportant as `relative` of a usual value. */
    void (*tolerances)(void *user, double relative, double *absolute);
    int (*rates)(void *user, double t, const double *x, double *dx);
    int (*jacobian)(void *user, double t, const double *x, double *value);
    int (*events)(void *user, double t, const double *x, double *g);
    /* The piece of the inputs that begins at t begins; x may jump. */
    gm_status (*enter)(void *user, double t, double *x, gm_transient_piece *piece,
                       gm_error *error);
    /* After an event and after every accepted step: bring the modes to what holds from
       now on. *changed: the solver restarts. x may change only then. */
    gm_status (*handle)(void *user, double t, double *x, int *changed, gm_error *error);
    void (*powers)(void *user, double t, const double *x, gm_transient_powers *powers);
    /* Name of state i for messages; NULL: they have none. */
    const char *(*state_name)(void *user, int i);
} gm_transient_system;

typedef struct gm_transient_options {
    double tolerance; /* error of a step relative to usual values of each state
                         (tolerances); to larger values: a hundredth; 0: 3e-4 */
    double step_max;  /* s; 0: any */
    int order_max;    /* of the backward differences, 1 to 5; 0: 2, since lightly damped
                         meshes lie where higher orders are unstable */
    long steps_max;   /* 0: any number */
    double cpu_max;   /* s of processor time; 0: any */
} gm_transient_options;

/** Since the start. work + (stored at the start) = stored + dissipated + impulses, but
 *  for the error of the solution. */
typedef struct gm_transient_energy {
    double work;         /* J, of all that acts from outside */
    double through;      /* J, how much passed */
    double dissipated;   /* J, integral of the loss power */
    double impulses;     /* J, lost where x jumped in a change of mode */
    double stored_start; /* J */
    double stored;       /* J, at the end of the last step */
    double residual;     /* J: work - dissipated - impulses - (stored - stored_start) */
} gm_transient_energy;

typedef struct gm_transient_statistics {
    long steps, rates, jacobians;
    long error_failures, convergence_failures; /* steps taken again, shorter */
    long restarts, events;
    double cpu; /* s of processor time spent inside gm_transient_advance */
} gm_transient_statistics;

typedef struct gm_transient gm_transient;

/** The system (copied) and what it points to outlive the solver. GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_transient_create(const gm_transient_system *system,
                                           const gm_transient_options *options,
                                           gm_transient **transient, gm_error *error);
void gm_transient_destroy(gm_transient *transient);

/** Go to time t [s], at first the start; account and statistics begin. Errors of the
 *  system's start. */
GM_NODISCARD gm_status gm_transient_start(gm_transient *transient, double t,
                                          gm_error *error);

/** Integrate up to t [s], not before the present time. The solver may step beyond it and
 *  interpolate. GM_ERR_SOLVE with time and state in the sentence: no solution beyond, or
 *  a limit of the options is reached. The state then stays at the last time that was
 *  reached. */
GM_NODISCARD gm_status gm_transient_advance(gm_transient *transient, double t,
                                            gm_error *error);

/** Present time, and x[n_states] there: valid until the next call. */
double gm_transient_time(const gm_transient *transient);
const double *gm_transient_state(const gm_transient *transient);

gm_transient_energy gm_transient_account(const gm_transient *transient);
gm_transient_statistics gm_transient_work(const gm_transient *transient);

#ifdef __cplusplus
}
#endif
#endif
