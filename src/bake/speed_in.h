/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Flanges whose speed is an input, from their names to the tables.
 */
#ifndef SPEED_IN_H
#define SPEED_IN_H

#include "bake/gm_bake.h"

/** Read names of flanges with commas between (NULL: none) and mark them in *reduced, the
 *  view of the map. GM_ERR_ARGUMENT: there is no such flange, it is named twice, or it is
 *  a path with a gear that has no stiffness. */
GM_NODISCARD gm_status gm_speed_in_read(const gm_map *map, const char *names,
                                        gm_reduced_map *reduced, gm_speed_in *speed_in,
                                        gm_error *error);

#endif
