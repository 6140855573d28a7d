/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Paths, gears, axes and keys of the tables, to and from the map's file: all but values.
 */
#ifndef MAP_FRAME_H
#define MAP_FRAME_H

#include "map/gm_map.h"
#include "map/map_db.h"

/** Paths and gears, replacing those in the file. */
GM_NODISCARD gm_status gm_frame_write_paths(const gm_db *db, const gm_map *map,
                                            gm_error *error);

/** Axes (each one once, whatever number of tables use it) and keys of the tables. */
GM_NODISCARD gm_status gm_frame_write_tables(const gm_db *db, const gm_map *map,
                                             gm_error *error);

/** The oil axis, if there is one. */
GM_NODISCARD gm_status gm_frame_write_oil(const gm_db *db, const gm_map *map,
                                          gm_error *error);

/** What seals a finished map: provenance, meta data, paths and gears, the state. */
GM_NODISCARD gm_status gm_frame_write_head(const gm_db *db, const gm_map *map,
                                           gm_error *error);

/** Oil axis, paths, and axes with keys, into an empty *map, in this order. file_size
 *  bounds what may be allocated: each number takes more than a byte of the file.
 *  GM_ERR_FORMAT: damaged. */
GM_NODISCARD gm_status gm_frame_read_oil(const gm_db *db, gm_map *map, gm_error *error);
GM_NODISCARD gm_status gm_frame_read_paths(const gm_db *db, gm_map *map, gm_error *error);
GM_NODISCARD gm_status gm_frame_read_tables(const gm_db *db, long long file_size,
                                            gm_map *map, gm_error *error);

#endif
