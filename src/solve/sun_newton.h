/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A nonlinear system solved by KINSOL with a sparse Jacobian (sun.h). One owner for every
 * SUNDIALS object; its messages are caught.
 */
#ifndef SUN_NEWTON_H
#define SUN_NEWTON_H

/** The system: callbacks get `user`. The Jacobian is in compressed columns; pattern is
 *  asked for again after gm_sun_newton_pattern_changed. */
typedef struct gm_sun_system {
    int n_max; /* largest number of unknowns */
    void *user;
    int (*size)(void *user);    /* present number of unknowns, <= n_max */
    int (*entries)(void *user); /* present number of Jacobian entries */
    void (*residual)(void *user, const double *x, double *f);
    void (*pattern)(void *user, int *column_start, int *row);
    void (*jacobian)(void *user, const double *x, double *value);
} gm_sun_system;

typedef struct gm_sun_newton gm_sun_newton;

/** NULL when there is no memory. */
gm_sun_newton *gm_sun_newton_create(const gm_sun_system *system);
void gm_sun_newton_destroy(gm_sun_newton *newton);

/** Call after size or pattern of the system changed. Non-zero: no memory. */
int gm_sun_newton_pattern_changed(gm_sun_newton *newton);

/** Damped Newton (line search) from x until the largest residual is below tolerance.
 *  x[n] is improved in place. Returns KINSOL's flag: >= 0 success. */
int gm_sun_newton_solve(gm_sun_newton *newton, double tolerance, double *x);

/** The last message of SUNDIALS, "" if there was none. */
const char *gm_sun_newton_message(const gm_sun_newton *newton);

#endif
