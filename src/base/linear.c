/* SPDX-License-Identifier: BSD-2-Clause */
#include "base/linear.h"

#include <math.h>

static double largest_entry(int n, const double *a)
{
    double largest = 0.0;
    for (int i = 0; i < n * n; i++)
        largest = fmax(largest, fabs(a[i]));
    return largest;
}

static int pivot_row(int n, const double *a, int column)
{
    int best = column;
    for (int i = column + 1; i < n; i++)
        if (fabs(a[i * n + column]) > fabs(a[best * n + column]))
            best = i;
    return best;
}

static void swap_rows(int n, double *a, int i, int j)
{
    for (int k = 0; i != j && k < n; k++) {
        double t = a[i * n + k];
        a[i * n + k] = a[j * n + k];
        a[j * n + k] = t;
    }
}

static void eliminate(int n, double *a, int column)
{
    for (int i = column + 1; i < n; i++) {
        double factor = a[i * n + column] / a[column * n + column];
        a[i * n + column] = factor;
        for (int k = column + 1; factor != 0.0 && k < n; k++)
            a[i * n + k] -= factor * a[column * n + k];
    }
}

bool gm_lu_factor(int n, double *a, int *pivot)
{
    double limit = 1e-12 * largest_entry(n, a);
    for (int c = 0; c < n; c++) {
        pivot[c] = pivot_row(n, a, c);
        if (!(fabs(a[pivot[c] * n + c]) > limit))
            return false;
        swap_rows(n, a, c, pivot[c]);
        eliminate(n, a, c);
    }
    return true;
}

void gm_lu_solve(int n, const double *lu, const int *pivot, double *b)
{
    for (int i = 0; i < n; i++) {
        double t = b[pivot[i]];
        b[pivot[i]] = b[i];
        b[i] = t;
    }
    for (int i = 1; i < n; i++)
        for (int k = 0; k < i; k++)
            b[i] -= lu[i * n + k] * b[k];
    for (int i = n - 1; i >= 0; i--) {
        for (int k = i + 1; k < n; k++)
            b[i] -= lu[i * n + k] * b[k];
        b[i] /= lu[i * n + i];
    }
}
