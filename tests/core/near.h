/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Comparison of doubles with an absolute tolerance; NaN is never near. cmocka's own
 * compares floats. Include after cmocka.h.
 */
#ifndef NEAR_H
#define NEAR_H

static inline void check_near(double a, double b, double tolerance, const char *file,
                              int line)
{
    const double difference = a > b ? a - b : b - a;
    if (!(difference <= tolerance)) {
        print_error("%.17g != %.17g, difference %g > %g\n", a, b, difference, tolerance);
        _fail(file, line);
    }
}

#define assert_near(a, b, tolerance) check_near(a, b, tolerance, __FILE__, __LINE__)

#endif
