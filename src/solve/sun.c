/* SPDX-License-Identifier: BSD-2-Clause */
#include "solve/sun.h"

#include <stdio.h>
#include <string.h>

#if defined(SUNDIALS_SUNLINSOL_KLU) || defined(SUNDIALS_KLU_ENABLED)
#define GM_SUN_KLU 1
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>
#else
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#endif

/* ---- context and messages ---- */

#if SUNDIALS_VERSION_MAJOR >= 7
static void keep_message(int line, const char *function, const char *file,
                         const char *message, SUNErrCode code, void *user,
                         SUNContext context)
{
    gm_sun *sun = user;
    (void)line, (void)file, (void)code, (void)context;
    (void)snprintf(sun->message, sizeof sun->message, "%s: %s", function,
                   message ? message : "");
}
#else
void gm_sun_keep_message(int code, const char *module, const char *function,
                         char *message, void *user)
{
    gm_sun *sun = user;
    (void)code, (void)module;
    (void)snprintf(sun->message, sizeof sun->message, "%s: %s", function, message);
}
#endif

int gm_sun_open(gm_sun *sun)
{
    memset(sun, 0, sizeof *sun);
#if SUNDIALS_VERSION_MAJOR >= 7
    return SUNContext_Create(SUN_COMM_NULL, &sun->context) ||
           SUNContext_ClearErrHandlers(sun->context) ||
           SUNContext_PushErrHandler(sun->context, keep_message, sun);
#elif SUNDIALS_VERSION_MAJOR == 6
    return SUNContext_Create(NULL, &sun->context);
#else
    return 0;
#endif
}

void gm_sun_close(gm_sun *sun)
{
#if SUNDIALS_VERSION_MAJOR >= 6
    if (sun->context)
        SUNContext_Free(&sun->context);
#else
    (void)sun;
#endif
}

/* ---- matrix ---- */

SUNMatrix gm_sun_matrix(const gm_sun *sun, int n, int entries)
{
    (void)sun, (void)entries;
#ifdef GM_SUN_KLU
    return SUNSparseMatrix(n, n, entries, CSC_MAT GM_SUN_LAST(sun));
#else
    return SUNDenseMatrix(n, n GM_SUN_LAST(sun));
#endif
}

SUNLinearSolver gm_sun_linear(const gm_sun *sun, N_Vector x, SUNMatrix matrix)
{
    (void)sun;
#ifdef GM_SUN_KLU
    return SUNLinSol_KLU(x, matrix GM_SUN_LAST(sun));
#else
    return SUNLinSol_Dense(x, matrix GM_SUN_LAST(sun));
#endif
}

void gm_sun_matrix_fill(SUNMatrix matrix, int n, const int *column_start, const int *row,
                        const double *value)
{
#ifdef GM_SUN_KLU
    sunindextype *start = SUNSparseMatrix_IndexPointers(matrix);
    sunindextype *index = SUNSparseMatrix_IndexValues(matrix);
    for (int i = 0; i <= n; i++)
        start[i] = column_start[i];
    for (int k = 0; k < column_start[n]; k++)
        index[k] = row[k];
    memcpy(SUNSparseMatrix_Data(matrix), value, (size_t)column_start[n] * sizeof *value);
#else
    SUNMatZero(matrix);
    for (int j = 0; j < n; j++)
        for (int k = column_start[j]; k < column_start[j + 1]; k++)
            SM_ELEMENT_D(matrix, row[k], j) = value[k];
#endif
}
