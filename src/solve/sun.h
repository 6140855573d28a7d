/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What the solvers of SUNDIALS share, and the only place where its versions differ (5.8
 * has no context, 6.x has one made from void *, 7.x from SUNComm and with error handlers
 * on the context): context, caught messages, the matrix in compressed columns and its
 * linear solver (KLU when SUNDIALS has it, else dense). Only sun*.c include it.
 */
#ifndef SUN_H
#define SUN_H

#include <nvector/nvector_serial.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

typedef struct gm_sun {
    char message[256]; /* the last one of SUNDIALS, "" if there was none */
#if SUNDIALS_VERSION_MAJOR >= 6
    SUNContext context;
#endif
} gm_sun;

/* The context as the last and as the only argument; versions 5 have none. */
#if SUNDIALS_VERSION_MAJOR >= 6
#define GM_SUN_LAST(sun) , (sun)->context
#define GM_SUN_ONLY(sun) (sun)->context
#else
#define GM_SUN_LAST(sun)
#define GM_SUN_ONLY(sun)
#endif

/* Catch the messages of a solver, set being its function for that; 0 done. From version 7
 * on the context catches them. */
#if SUNDIALS_VERSION_MAJOR >= 7
#define GM_SUN_CATCH(set, solver, sun) 0
#else
#define GM_SUN_CATCH(set, solver, sun) set(solver, gm_sun_keep_message, sun)
void gm_sun_keep_message(int code, const char *module, const char *function,
                         char *message, void *user);
#endif

/** Non-zero: no memory. gm_sun_close may be called either way. */
int gm_sun_open(gm_sun *sun);
void gm_sun_close(gm_sun *sun);

/** Square matrix with room for entries, and a solver for it; NULL without memory. */
SUNMatrix gm_sun_matrix(const gm_sun *sun, int n, int entries);
SUNLinearSolver gm_sun_linear(const gm_sun *sun, N_Vector x, SUNMatrix matrix);

/** Put a matrix in compressed columns into the form of SUNDIALS. */
void gm_sun_matrix_fill(SUNMatrix matrix, int n, const int *column_start, const int *row,
                        const double *value);

#endif
