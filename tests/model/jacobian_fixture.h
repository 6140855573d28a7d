/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The Jacobian of a motion against central differences in random gears and random states:
 * flanks in the gap, in their soft entry and in contact, speeds of any sign, at rest
 * within the band of Coulomb friction, locks in every mode.
 */
#ifndef JACOBIAN_FIXTURE_H
#define JACOBIAN_FIXTURE_H

#include "motion_fixture.h"

#include <stdint.h>

/** Compressed columns with the motion's pattern. */
typedef struct sparse {
    int n, entries, *column_start, *row;
    double *value;
} sparse;

void sparse_make(sparse *s, gm_motion *motion);
void sparse_clear(sparse *s);

/** What was compared; beside a kink differences say nothing. */
typedef struct tally {
    long compared, kinks;
} tally;

/** Compare every derivative in so many random states; fails the test where one
 *  disagrees. */
tally compare_jacobian(moving *m, uint64_t *seed, int states);

#endif
