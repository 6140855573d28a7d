/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A small gearset as a map without a sweep, from formulas a reader can check. Two paths
 * (odd: 1, 3; even: -1, 2) or one (input: 1). Passive: P + D + X >= 0, N along w_n.
 *
 *   P = 2 + 0.012 w + 1e-5 w^2     D = 0.02 |tau| (1 + w / 2000)
 *   N = sgn (0.2 + 0.001 |w_n|)    with jumps of 0.05 and 0.03 N.m where w_n meets the
 *   R as the jumps demand           idling gears 3 and 2
 *   X = 1e-5 |tau_0| |tau_1|        C = 0.0005 (w_0 - w_1)
 *
 * J_out = 20 kg.m2 stands for a small vehicle on the output.
 */
#ifndef EXAMPLE_MAP_H
#define EXAMPLE_MAP_H

#include "map/gm_map.h"

/** New map of n_paths (1 or 2); stops the program when it cannot be made. */
gm_map *example_map(int n_paths);

#endif
