/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What the property tests of the friction laws share: repeatable random numbers,
 * comparisons by relative tolerance, and derivatives by central differences.
 */
#ifndef PROPERTY_H
#define PROPERTY_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

/* Published numbers are printed with five to seven digits. */
#define PRINTED 1e-5

/* Knuth's 64-bit linear congruential generator (MMIX); upper bits are used. */
static inline double random_unit(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.;
}

static inline double random_between(uint64_t *state, double low, double high)
{
    return low + (high - low) * random_unit(state);
}

/* Evenly spread in the logarithm. */
static inline double random_scale(uint64_t *state, double low, double high)
{
    return low * pow(high / low, random_unit(state));
}

static inline void check_close(const char *what, double value, double expected,
                               double relative)
{
    if (!(fabs(value - expected) <= relative * fabs(expected)))
        fail_msg("%s: %.12g, expected %.12g", what, value, expected);
}

/* Derivative of f by its argument at x > 0 by central differences with relative step
 * 1e-5: error about 1e-10 of f''' x^2 and 1e-11 of f/x by rounding. Those two bound the
 * tolerance: 1e-6 of the slope itself, and 1e-9 of the chord f/x. */
typedef double (*property_law)(const void *data, double x);

static inline void check_slope(const char *what, property_law f, const void *data,
                               double x, double slope)
{
    double h = 1e-5 * x;
    double numeric = (f(data, x + h) - f(data, x - h)) / (2. * h);
    double tolerance = 1e-6 * fabs(slope) + 1e-9 * fabs(f(data, x)) / x;
    if (!(fabs(numeric - slope) <= tolerance))
        fail_msg("%s at %.9g: slope %.12g, by differences %.12g", what, x, slope,
                 numeric);
}

/* No jump: over a fine grid of a range the law never changes by more than its slope
 * bound allows. Scans geometrically from low to high and compares each step with the
 * step halved: in a continuous law the change shrinks, at a jump it stays. */
static inline void check_continuous(const char *what, property_law f, const void *data,
                                    double low, double high)
{
    const int n = 4000;
    double ratio = pow(high / low, 1. / n);
    for (int i = 0; i < n; i++) {
        double a = low * pow(ratio, i), b = a * ratio;
        double f_a = f(data, a), f_b = f(data, b);
        for (int k = 0; k < 40 && fabs(f_b - f_a) > 1e-9 * fabs(f_a); k++) {
            double m = 0.5 * (a + b), f_m = f(data, m);
            if (fabs(f_m - f_a) > fabs(f_b - f_m))
                b = m, f_b = f_m;
            else
                a = m, f_a = f_m;
        }
        if (!(fabs(f_b - f_a) <= 1e-6 * fabs(f_a) + 1e-12))
            fail_msg("%s jumps near %.9g: %.9g to %.9g", what, a, f_a, f_b);
    }
}

#endif
