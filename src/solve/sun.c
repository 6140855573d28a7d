/* SPDX-License-Identifier: BSD-2-Clause */
#include "solve/sun.h"

#include "base/alloc.h"

#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <string.h>
#include <sundials/sundials_config.h>

#if defined(SUNDIALS_SUNLINSOL_KLU) || defined(SUNDIALS_KLU_ENABLED)
#define GM_SUN_KLU 1
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>
#else
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#endif

#if SUNDIALS_VERSION_MAJOR < 6
#define CONTEXT_ARG(newton)
#define FIRST_CONTEXT(newton) /* functions without any other argument */
#else
#define CONTEXT_ARG(newton) , (newton)->context
#define FIRST_CONTEXT(newton) (newton)->context
#endif

#define MAX_ITERATIONS 60

struct gm_sun_newton {
    gm_sun_system system;
    char message[256];
#if SUNDIALS_VERSION_MAJOR >= 6
    SUNContext context;
#endif
    int n; /* unknowns of the objects below */
    void *kinsol;
    N_Vector x, scale;
    SUNMatrix jacobian;
    SUNLinearSolver linear;
    int *column_start, *row; /* pattern, for the dense fallback and for filling */
    double *value;
};

/* ---- messages ---- */

#if SUNDIALS_VERSION_MAJOR >= 7
static void keep_message(int line, const char *function, const char *file,
                         const char *message, SUNErrCode code, void *user,
                         SUNContext context)
{
    gm_sun_newton *newton = user;
    (void)line, (void)file, (void)code, (void)context;
    (void)snprintf(newton->message, sizeof newton->message, "%s: %s", function,
                   message ? message : "");
}
#else
static void keep_message(int code, const char *module, const char *function,
                         char *message, void *user)
{
    gm_sun_newton *newton = user;
    (void)code, (void)module;
    (void)snprintf(newton->message, sizeof newton->message, "%s: %s", function, message);
}
#endif

static int catch_messages(gm_sun_newton *newton)
{
#if SUNDIALS_VERSION_MAJOR >= 7
    (void)newton;
    return 0;
#else
    return KINSetErrHandlerFn(newton->kinsol, keep_message, newton);
#endif
}

static int open_context(gm_sun_newton *newton)
{
#if SUNDIALS_VERSION_MAJOR >= 7
    return SUNContext_Create(SUN_COMM_NULL, &newton->context) ||
           SUNContext_ClearErrHandlers(newton->context) ||
           SUNContext_PushErrHandler(newton->context, keep_message, newton);
#elif SUNDIALS_VERSION_MAJOR == 6
    return SUNContext_Create(NULL, &newton->context);
#else
    (void)newton;
    return 0;
#endif
}

static void close_context(gm_sun_newton *newton)
{
#if SUNDIALS_VERSION_MAJOR >= 6
    if (newton->context)
        SUNContext_Free(&newton->context);
#else
    (void)newton;
#endif
}

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
#ifdef GM_SUN_KLU
    newton->system.jacobian(newton->system.user, N_VGetArrayPointer(x),
                            SUNSparseMatrix_Data(J));
    sunindextype *column_start = SUNSparseMatrix_IndexPointers(J);
    sunindextype *row = SUNSparseMatrix_IndexValues(J);
    for (int i = 0; i <= newton->n; i++)
        column_start[i] = newton->column_start[i];
    for (int k = 0; k < newton->column_start[newton->n]; k++)
        row[k] = newton->row[k];
#else
    newton->system.jacobian(newton->system.user, N_VGetArrayPointer(x), newton->value);
    SUNMatZero(J);
    for (int j = 0; j < newton->n; j++)
        for (int k = newton->column_start[j]; k < newton->column_start[j + 1]; k++)
            SM_ELEMENT_D(J, newton->row[k], j) = newton->value[k];
#endif
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
    newton->x = N_VNew_Serial(n CONTEXT_ARG(newton));
    newton->scale = N_VNew_Serial(n CONTEXT_ARG(newton));
#ifdef GM_SUN_KLU
    int entries = newton->system.entries(newton->system.user);
    newton->jacobian = SUNSparseMatrix(n, n, entries, CSC_MAT CONTEXT_ARG(newton));
    if (!newton->x || !newton->scale || !newton->jacobian)
        return 1;
    newton->linear = SUNLinSol_KLU(newton->x, newton->jacobian CONTEXT_ARG(newton));
#else
    newton->jacobian = SUNDenseMatrix(n, n CONTEXT_ARG(newton));
    if (!newton->x || !newton->scale || !newton->jacobian)
        return 1;
    newton->linear = SUNLinSol_Dense(newton->x, newton->jacobian CONTEXT_ARG(newton));
#endif
    return newton->linear == NULL;
}

static int make_kinsol(gm_sun_newton *newton)
{
    newton->kinsol = KINCreate(FIRST_CONTEXT(newton));
    if (!newton->kinsol)
        return 1;
    void *kinsol = newton->kinsol;
    return catch_messages(newton) || KINInit(kinsol, call_residual, newton->x) ||
           KINSetUserData(kinsol, newton) ||
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
    if (!newton->column_start || !newton->row || !newton->value || open_context(newton)) {
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
    close_context(newton);
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
    newton->message[0] = '\0';
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
    return newton->message;
}
