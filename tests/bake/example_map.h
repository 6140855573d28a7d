/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A small gearset as a map without a sweep, from formulas a reader can check. Two paths
 * (odd: 1, 3; even: -1, 2) or one (input: 1). Passive: P + D + X >= 0, N along w_n.
 *
 *   P = 2 + 0.012 w + 1e-5 w^2     D = 0.02 |tau| (1 + w / 2000)
 *   N = sgn (0.2 + 0.001 |w_n|)    with a jump of 0.05 N.m at w_n = 6 w_o (gear 3)
 *   R as the jump demands           X = 1e-4 |tau_0| |tau_1| / 10     C = 0.0005 dw
 */
#ifndef EXAMPLE_MAP_H
#define EXAMPLE_MAP_H

#include "map/gm_map.h"

/** New map of n_paths (1 or 2); stops the program when it cannot be made. */
gm_map *example_map(int n_paths);

#endif
