/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Sums of many small increments, such as an angle or an energy over hours: the rounding
 * error of each addition is kept and added later (D. E. Knuth, The Art of Computer
 * Programming, vol. 2, section 4.2.2, theorem B). high + low is the sum with about twice
 * the digits of gm_real; high alone is it rounded. Needs a compiler that does not
 * reassociate (no -ffast-math).
 */
#ifndef GM_SUM_H
#define GM_SUM_H

#include "gm_real.h"

typedef struct gm_sum {
    gm_real high, low;
} gm_sum;

/** The sum with an increment added; unchanged if that would leave the range. */
static inline gm_sum gm_sum_add(gm_sum sum, gm_real increment)
{
    const gm_real x = sum.low + increment, high = sum.high + x;
    const gm_real part = high - sum.high;
    const gm_sum next = {high, (sum.high - (high - part)) + (x - part)};
    return high - high == 0 ? next : sum;
}

#endif
