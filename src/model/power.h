/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Two functions that the friction laws share: pi, and powers that a Newton solver can
 * live with.
 *
 * Many empirical laws contain x^p with 0 < p < 1, whose slope is infinite at x = 0. Below
 * a small x_0 the power is replaced by the parabola through the origin that meets it at
 * x_0 with equal value and slope:  x_0^(p-2) x ((2 - p) x_0 + (p - 1) x).  It rises
 * monotonically, and its slope at 0 is (2 - p) x_0^(p-1). From x_0 on, x^p is untouched.
 */
#ifndef POWER_H
#define POWER_H

#include <math.h>

#define GM_PI 3.14159265358979323846

/** A value and its derivative. */
typedef struct gm_power {
    double value;
    double slope;
} gm_power;

/** x^p for x >= 0 and 0 < p < 1, a parabola below x_0 > 0. */
static inline gm_power gm_power_from_zero(double x, double p, double x_0)
{
    if (x >= x_0) {
        double value = pow(x, p);
        return (gm_power){value, p * value / x};
    }
    double at_x_0 = pow(x_0, p), t = x / x_0;
    return (gm_power){at_x_0 * t * (2. - p + (p - 1.) * t),
                      at_x_0 / x_0 * (2. - p + 2. * (p - 1.) * t)};
}

#endif
