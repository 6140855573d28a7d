/* SPDX-License-Identifier: BSD-2-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/linear.h"

#include <math.h>
#include <string.h>

#define N_MAX 30

static double random_unit(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 9007199254740992.0 * 2.0 - 1.0;
}

static void solves_random_systems(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int trial = 0; trial < 200; trial++) {
        int n = 1 + trial % N_MAX, pivot[N_MAX];
        double a[N_MAX * N_MAX], lu[N_MAX * N_MAX], x[N_MAX], b[N_MAX] = {0.0};
        for (int i = 0; i < n * n; i++)
            a[i] = random_unit(&seed);
        for (int i = 0; i < n; i++)
            x[i] = random_unit(&seed);
        for (int i = 0; i < n; i++)
            for (int k = 0; k < n; k++)
                b[i] += a[i * n + k] * x[k];
        memcpy(lu, a, sizeof lu);
        if (!gm_lu_factor(n, lu, pivot))
            continue;
        gm_lu_solve(n, lu, pivot, b);
        for (int i = 0; i < n; i++) /* condition numbers stay below 1e5 at this size */
            assert_true(fabs(b[i] - x[i]) < 1e-9);
    }
}

static void needs_row_exchanges(void **state)
{
    (void)state;
    double a[4] = {0.0, 2.0, 3.0, 1.0}, b[2] = {4.0, 5.0};
    int pivot[2];
    assert_true(gm_lu_factor(2, a, pivot));
    gm_lu_solve(2, a, pivot, b);
    assert_true(fabs(b[0] - 1.0) < 1e-15 && fabs(b[1] - 2.0) < 1e-15);
}

static void tells_singular_matrices(void **state)
{
    (void)state;
    double dependent[4] = {1.0, 2.0, 2.0, 4.0}, zero[1] = {0.0}, nan[1] = {(double)NAN};
    int pivot[2];
    assert_false(gm_lu_factor(2, dependent, pivot));
    assert_false(gm_lu_factor(1, zero, pivot));
    assert_false(gm_lu_factor(1, nan, pivot));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solves_random_systems),
        cmocka_unit_test(needs_row_exchanges),
        cmocka_unit_test(tells_singular_matrices),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
