/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Hand maps of one gearset at several oil temperatures, put together into one map with an
 * oil axis.
 */
#ifndef OIL_MAP_H
#define OIL_MAP_H

#include "hand_map.h"

enum { OIL_SLICES = 3 };

extern const double oil_temperatures[OIL_SLICES]; /* K */

typedef struct oil_map {
    hand_map frame;             /* its map reads the stack */
    hand_map slice[OIL_SLICES]; /* each with a map of its own */
    double stack[OIL_SLICES * sizeof(hand_map) / sizeof(double)];
    int used; /* of the stack */
    double bend[OIL_SLICES - 1];
} oil_map;

/** The specification with all losses times a factor. */
hand_spec oil_scaled(const hand_spec *spec, double factor);

/** Slices are the specifications [OIL_SLICES]. Pointers point into *m. */
void oil_build(const hand_spec *specs, const double *bend, oil_map *m);

#endif
