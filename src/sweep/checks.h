/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What a sweep checks before it starts and when it is done.
 */
#ifndef CHECKS_H
#define CHECKS_H

#include "map/gm_map.h"
#include "plant/gm_plant.h"

#define GM_RATIO_TOLERANCE 1e-3 /* relative, of tooth numbers against a rounded ratio */

/** Put paths, ratios and inertias of the plant into the empty map; *deviation receives
 *  the largest relative difference of a ratio from the one given. GM_ERR_MODEL: a ratio
 *  is more than GM_RATIO_TOLERANCE away, has the other sign or is zero. */
GM_NODISCARD gm_status gm_sweep_identify(const gm_plant *plant, gm_map *map,
                                         double *deviation, gm_error *error);

/** The balance has one solution while |dD/dtau| + |dX/dtau| / |r| < 1 (the loss grows
 *  less than the torque that causes it). GM_ERR_MODEL with gear and slope where it does
 *  not. */
GM_NODISCARD gm_status gm_sweep_check_unique(const gm_map *map, gm_error *error);

#endif
