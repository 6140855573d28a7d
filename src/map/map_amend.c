/* SPDX-License-Identifier: BSD-2-Clause */
#include "map/map_amend.h"

#include "map/map_place.h"
#include "map/map_schema.h"

gm_status gm_amend(const char *path,
                   gm_status (*put)(const gm_db *db, const void *what, gm_error *error),
                   const void *what, gm_error *error)
{
    gm_db db = {0};
    if (!gm_place_exists(path))
        return gm_fail(error, GM_ERR_IO, "%s: there is no such file", path);
    gm_status status = gm_db_open(path, &db, error);
    if (status == GM_OK)
        status = gm_schema_is_map(&db, error);
    if (status == GM_OK)
        status = gm_db_run(&db, "BEGIN IMMEDIATE", error);
    if (status == GM_OK) {
        status = put(&db, what, error);
        gm_status end = gm_db_run(&db, status == GM_OK ? "COMMIT" : "ROLLBACK",
                                  status == GM_OK ? error : NULL);
        status = status == GM_OK ? end : status;
    }
    gm_db_close(&db);
    return status;
}
