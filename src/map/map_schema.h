/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The schema of the map's file, format 4 with an oil axis, else format 3; docs/map.md
 * explains it.
 */
#ifndef MAP_SCHEMA_H
#define MAP_SCHEMA_H

#include "map/map_db.h"

/** "GmMp" in the header of the file, so that tools can tell a map from other databases.
 */
#define GM_MAP_APPLICATION 1198345584

/** Tables, views, application id and format version. To be called in a transaction. */
GM_NODISCARD gm_status gm_schema_create(const gm_db *db, int format, gm_error *error);

/** GM_ERR_FORMAT unless the file says that it is a map. */
GM_NODISCARD gm_status gm_schema_is_map(const gm_db *db, gm_error *error);

/** GM_ERR_FORMAT unless every table is there and declared as gm_schema_create does. What
 *  else is in the file (a user's own tables) does not matter. */
GM_NODISCARD gm_status gm_schema_check(const gm_db *db, int format, gm_error *error);

#endif
