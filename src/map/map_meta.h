/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The table meta of the map's file: what describes the map as a whole.
 */
#ifndef MAP_META_H
#define MAP_META_H

#include "map/gm_map.h"
#include "map/map_db.h"

#define GM_META_STATE "state" /* one of: */
#define GM_META_SWEEPING "sweeping"
#define GM_META_FINISHED "finished"
#define GM_META_SWEEP "sweep_hash"           /* which sweep a journal belongs to */
#define GM_META_PROVENANCE "provenance_hash" /* over content hash and tool version */

/** Set one text. */
GM_NODISCARD gm_status gm_meta_put(const gm_db *db, const char *key, const char *text,
                                   gm_error *error);

/** Read one text of less than size bytes. GM_ERR_FORMAT when it is missing. */
GM_NODISCARD gm_status gm_meta_get(const gm_db *db, const char *key, size_t size,
                                   char *text, gm_error *error);

/** Every text and number of *map that is neither of a path nor of a table. */
GM_NODISCARD gm_status gm_meta_write(const gm_db *db, const gm_map *map, gm_error *error);
GM_NODISCARD gm_status gm_meta_read(const gm_db *db, gm_map *map, gm_error *error);

/** Hash that seals what the content hash leaves out: the tool's version. */
GM_NODISCARD gm_status gm_meta_provenance(const gm_map *map, char text[65],
                                          gm_error *error);

/** Hash of what makes a sweep the same: tool version, input, options, names and gears,
 *  and the size of the journal's records. */
GM_NODISCARD gm_status gm_meta_sweep(const gm_map *map, size_t record, char text[65],
                                     gm_error *error);

#endif
