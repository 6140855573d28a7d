/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A complete small map of two paths (odd: 1, 3; even: -1, 2) with numbers from a
 * generator, for the tests of this room.
 */
#ifndef MAP_FIXTURE_H
#define MAP_FIXTURE_H

#include "map/gm_map.h"

#include <stdbool.h>
#include <stdint.h>

/** Next number of the sequence in [0, 1). */
double fixture_random(uint64_t *state);

typedef struct fixture_options {
    int n_paths;         /* 1 or 2 */
    bool optional;       /* with X, C and drag jumps */
    bool reversed;       /* add the tables in the reversed order */
    gm_symbol leave_out; /* skip this symbol; GM_SYMBOLS: none */
} fixture_options;

extern const fixture_options fixture_full;

/** Frame, ratios, inertias and values. Stops the test when it cannot be made. */
gm_map *fixture_map(const fixture_options *options);

/** The same with values zero and without ratios and inertias: as a sweep begins. */
gm_map *fixture_frame(const fixture_options *options);

/** Copy ratios, inertias and values of *from, which has the same frame. */
void fixture_fill(gm_map *map, const gm_map *from);

/** True when both maps say the same, bit for bit; the tool's version apart. */
bool fixture_equal(const gm_map *a, const gm_map *b);

/** Ratios of the fixture's drag lines by path and gear (gear 2 has none). */
extern const double fixture_line[2][2];

#endif
