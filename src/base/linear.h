/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Small dense linear systems: LU with partial pivoting, for the matrices of a gearset
 * (some tens of rows), where a library call costs more than the arithmetic.
 */
#ifndef LINEAR_H
#define LINEAR_H

#include <stdbool.h>

/** Factor a[n][n] (row-major) in place; pivot[n] receives the row exchanges.
 *  False when a pivot is smaller than 1e-12 of the largest entry: singular. */
bool gm_lu_factor(int n, double *a, int *pivot);

/** Solve with the factors: b[n] in, x[n] out in the same place. */
void gm_lu_solve(int n, const double *lu, const int *pivot, double *b);

#endif
