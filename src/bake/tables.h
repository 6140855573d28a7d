/* SPDX-License-Identifier: BSD-2-Clause
 *
 * gm_tables.h, the only generated C: a map as constant data for fmu/gm_model.c.
 *
 * Axes and values are static const arrays, each written once however many tables share
 * it, then the structs of core/gm_reduced.h with designated initialisers. Numbers read
 * back to the same bits. An infinite synchroniser capacity is written as 1e30.
 */
#ifndef TABLES_H
#define TABLES_H

#include "bake/buffer.h"
#include "map/gm_map.h"

/** Append the whole file. reduced: the view of map; guid: text for GM_TABLES_GUID.
 *  GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_tables_write(const gm_map *map, const gm_reduced_map *reduced,
                                       const char *guid, gm_buffer *buffer,
                                       gm_error *error);

#endif
