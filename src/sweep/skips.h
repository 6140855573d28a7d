/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Values that a skipped point left open in the tables of a map: they come from their
 * neighbours, along the last axis by a straight line between the nearest two (the nearest
 * one at an end), and where a whole row is open, from the rows beside it.
 */
#ifndef SKIPS_H
#define SKIPS_H

#include "map/gm_map.h"

/** Fill what is not a number. GM_ERR_TOOL: a table has no number at all. */
GM_NODISCARD gm_status gm_skips_fill(gm_map *map, gm_error *error);

#endif
