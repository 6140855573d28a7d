/* SPDX-License-Identifier: BSD-2-Clause */
#include "solve/sun_newton.h"

#include "base/alloc.h"
#include "solve/sun.h"

#include <kinsol/kinsol.h>
#include <string.h>

#define MAX_ITERATIONS 60

struct gm_sun_newton {
    gm_sun_system system;
    gm_sun sun;
    int n; /* unknowns of the objects below */
    void *kinsol;
    N_Vector x, scale;
    SUNMatrix jacobian;
    SUNLinearSolver linear;
    int *column_start, *row; /* pattern */
    double *value;
};

/* ---- callbacks ---- */

static int call_residual(N_Vector x, N_Vector f, void *user)
{
    gm_sun_newton *newton = user;
    newton->system.residual(newton->system.user, N_VGetArrayPointer(x),
                            N_VGetArrayPointer(f));
    return 0;
}

static int call_jacobian(N_Vector x, N_Vector f, SUNMatrix J, void *user, N_Vector work_1,
                         N_Vector work_2)
{
    gm_sun_newton *newton = user;
    (void)f, (void)work_1, (void)work_2;
    newton->system.jacobian(newton->system.user, N_VGetArrayPointer(x), newton->value);
    gm_sun_matrix_fill(J, newton->n, newton->column_start, newton->row, newton->value);
    return 0;
}

/* ---- objects of one size ---- */

static void free_objects(gm_sun_newton *newton)
{
    if (newton->kinsol)
        KINFree(&newton->kinsol);
    if (newton->linear)
        SUNLinSolFree(newton->linear);
    if (newton->jacobian)
        SUNMatDestroy(newton->jacobian);
    if (newton->x)
        N_VDestroy(newton->x);
    if (newton->scale)
        N_VDestroy(newton->scale);
    newton->kinsol = NULL;
    newton->linear = NULL;
    newton->jacobian = NULL;
    newton->x = newton->scale = NULL;
}

static int make_vectors_and_matrix(gm_sun_newton *newton)
{
    int n = newton->n;
    newton->x = N_VNew_Serial(n GM_SUN_LAST(&newton->sun));
    newton->scale = N_VNew_Serial(n GM_SUN_LAST(&newton->sun));
    newton->jacobian =
        gm_sun_matrix(&newton->sun, n, newton->system.entries(newton->system.user));
    if (!newton->x || !newton->scale || !newton->jacobian)
        return 1;
    newton->linear = gm_sun_linear(&newton->sun, newton->x, newton->jacobian);
    return newton->linear == NULL;
}

static int make_kinsol(gm_sun_newton *newton)
{
    newton->kinsol = KINCreate(GM_SUN_ONLY(&newton->sun));
    if (!newton->kinsol)
        return 1;
    void *kinsol = newton->kinsol;
    return GM_SUN_CATCH(KINSetErrHandlerFn, kinsol, &newton->sun) ||
           KINInit(kinsol, call_residual, newton->x) || KINSetUserData(kinsol, newton) ||
           KINSetLinearSolver(kinsol, newton->linear, newton->jacobian) ||
           KINSetJacFn(kinsol, call_jacobian) || KINSetMaxSetupCalls(kinsol, 1) ||
           KINSetNumMaxIters(kinsol, MAX_ITERATIONS) ||
           /* forces reach 1e5 N from a start at zero: never cut a Newton step short */
           KINSetMaxNewtonStep(kinsol, 1e12) || KINSetScaledStepTol(kinsol, 1e-16);
}

/* ---- public ---- */

gm_sun_newton *gm_sun_newton_create(const gm_sun_system *system)
{
    gm_sun_newton *newton = gm_calloc(1, sizeof *newton);
    if (!newton)
        return NULL;
    size_t n = (size_t)system->n_max;
    newton->system = *system;
    newton->column_start = gm_calloc(n + 1, sizeof *newton->column_start);
    newton->row = gm_calloc(n * n, sizeof *newton->row);
    newton->value = gm_calloc(n * n, sizeof *newton->value);
    if (!newton->column_start || !newton->row || !newton->value ||
        gm_sun_open(&newton->sun)) {
        gm_sun_newton_destroy(newton);
        return NULL;
    }
    return newton;
}

void gm_sun_newton_destroy(gm_sun_newton *newton)
{
    if (!newton)
        return;
    free_objects(newton);
    gm_sun_close(&newton->sun);
    gm_free(newton->column_start);
    gm_free(newton->row);
    gm_free(newton->value);
    gm_free(newton);
}

int gm_sun_newton_pattern_changed(gm_sun_newton *newton)
{
    free_objects(newton);
    newton->n = newton->system.size(newton->system.user);
    newton->system.pattern(newton->system.user, newton->column_start, newton->row);
    if (make_vectors_and_matrix(newton) || make_kinsol(newton)) {
        free_objects(newton);
        return 1;
    }
    N_VConst(1.0, newton->scale);
    return 0;
}

int gm_sun_newton_solve(gm_sun_newton *newton, double tolerance, double *x)
{
    size_t bytes = (size_t)newton->n * sizeof *x;
    double *array = N_VGetArrayPointer(newton->x);
    newton->sun.message[0] = '\0';
    memcpy(array, x, bytes);
    if (KINSetFuncNormTol(newton->kinsol, tolerance))
        return -1;
    int flag =
        KINSol(newton->kinsol, newton->x, KIN_LINESEARCH, newton->scale, newton->scale);
    memcpy(x, array, bytes);
    return flag;
}

const char *gm_sun_newton_message(const gm_sun_newton *newton)
{
    return newton->sun.message;
}
