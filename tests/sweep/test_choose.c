/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The choice of nodes against exhaustive search, and what it promises.
 */
#include "sweep/choose.h"

#include "base/alloc.h"
#include "sweep/verify_points.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#define N 12
#define CURVES 2

static double x[N], value[CURVES * N];
static char fixed[N], chosen[N];
static uint64_t dice;

/* A random axis and two random walks over it. */
static gm_curves random_curves(void)
{
    memset(fixed, 0, sizeof fixed);
    for (int i = 0; i < N; i++) {
        x[i] = (i ? x[i - 1] : 0.0) + gm_random_between(&dice, 0.1, 1.0);
        fixed[i] = gm_random_between(&dice, 0.0, 1.0) < 0.1;
        for (int k = 0; k < CURVES; k++)
            value[k * N + i] =
                (i ? value[k * N + i - 1] : 0.0) + gm_random_between(&dice, -1.0, 1.2);
    }
    return (gm_curves){N, x, CURVES, value, fixed, 0, 0};
}

/* Largest error of straight lines between the nodes of a mask (the ends belong to it). */
static double error_of(unsigned mask)
{
    double largest = 0.0;
    for (int i = 0, j; i + 1 < N; i = j) {
        for (j = i + 1; !(mask >> j & 1u); j++)
            ;
        for (int m = i + 1; m < j; m++)
            for (int k = 0; k < CURVES; k++) {
                const double *f = value + k * N;
                double line = f[i] + (f[j] - f[i]) * (x[m] - x[i]) / (x[j] - x[i]);
                largest = fmax(largest, fabs(line - f[m]));
            }
    }
    return largest;
}

static int count(unsigned mask)
{
    int n = 0;
    for (; mask; mask >>= 1)
        n += (int)(mask & 1u);
    return n;
}

static unsigned fixed_mask(void)
{
    unsigned mask = 1u | 1u << (N - 1);
    for (int i = 0; i < N; i++)
        mask |= (unsigned)(fixed[i] != 0) << i;
    return mask;
}

static unsigned chosen_mask(void)
{
    unsigned mask = 0;
    for (int i = 0; i < N; i++)
        mask |= (unsigned)(chosen[i] != 0) << i;
    return mask;
}

static void no_smaller_choice_is_good_enough(void **state)
{
    (void)state;
    for (dice = 1; dice < 400; dice++) {
        uint64_t seed = dice;
        gm_curves curves = random_curves();
        int n, least = N;
        double largest;
        assert_int_equal(gm_choose_nodes(&curves, N, chosen, &n, &largest, NULL), GM_OK);
        unsigned mask = chosen_mask(), must = fixed_mask();
        assert_int_equal(n, count(mask));
        assert_int_equal(mask & must, must);
        assert_true(error_of(mask) <= 1.0);
        assert_true(fabs(error_of(mask) - largest) < 1e-12); /* rounding of the lines */
        for (unsigned other = 0; other < 1u << N; other++)
            if ((other & must) == must && count(other) < least && error_of(other) <= 1.0)
                least = count(other);
        assert_int_equal(n, least);
        dice = seed;
    }
}

static void a_limit_is_kept_and_the_error_told(void **state)
{
    (void)state;
    for (dice = 1000; dice < 1200; dice++) {
        uint64_t seed = dice;
        gm_curves curves = random_curves();
        int n;
        double largest;
        memset(fixed, 0, sizeof fixed);
        for (int n_max = 2; n_max <= N; n_max++) {
            assert_int_equal(gm_choose_nodes(&curves, n_max, chosen, &n, &largest, NULL),
                             GM_OK);
            assert_true(n >= 2 && n <= n_max);
            assert_true(fabs(error_of(chosen_mask()) - largest) < 1e-12);
        }
        assert_true(largest <= 1.0);
        dice = seed;
    }
}

/* Cubics need fewer nodes for a smooth curve, and meet the same tolerance. */
static void cubics_need_fewer_nodes(void **state)
{
    (void)state;
    enum { MANY = 201 };
    static double at[MANY], f[MANY];
    static char none[MANY], taken[MANY];
    int n[2];
    for (int i = 0; i < MANY; i++) {
        at[i] = i / 200.0;
        f[i] = 100.0 * sin(6.0 * at[i]); /* tolerance 1 % */
    }
    for (int monotone = 0; monotone < 2; monotone++) {
        gm_curves curves = {MANY, at, 1, f, none, 1, monotone};
        double largest;
        assert_int_equal(
            gm_choose_nodes(&curves, MANY, taken, &n[monotone], &largest, NULL), GM_OK);
        assert_true(largest <= 1.0);
    }
    /* lines: h^2 f''/8 = 1 gives a mean of 6 * 6.4 / (2 pi) = 13 intervals or so */
    assert_true(n[0] >= 9 && n[0] <= 18);
    assert_true(n[1] < n[0]);
}

static void without_memory_there_is_a_status(void **state)
{
    (void)state;
    dice = 3;
    gm_curves curves = random_curves();
    for (int k = 1; k <= 3; k++) {
        int n;
        double largest;
        gm_alloc_fail_after(k);
        gm_status status = gm_choose_nodes(&curves, N, chosen, &n, &largest, NULL);
        gm_alloc_fail_after(0);
        assert_int_equal(status, GM_ERR_MEMORY);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_smaller_choice_is_good_enough),
        cmocka_unit_test(a_limit_is_kept_and_the_error_told),
        cmocka_unit_test(cubics_need_fewer_nodes),
        cmocka_unit_test(without_memory_there_is_a_status),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
