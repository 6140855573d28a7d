/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Adding to the file of a finished map, beside its tables: all or nothing.
 */
#ifndef MAP_AMEND_H
#define MAP_AMEND_H

#include "map/map_db.h"

/** Run put(db, what, error) on the file at path in one transaction. GM_ERR_IO when there
 *  is no such file, GM_ERR_FORMAT when it is no map, what put returns. */
GM_NODISCARD gm_status gm_amend(const char *path,
                                gm_status (*put)(const gm_db *db, const void *what,
                                                 gm_error *error),
                                const void *what, gm_error *error);

#endif
