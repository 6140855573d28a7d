/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Whole results of verifications, as a map's file keeps them (see map_errors.c).
 */
#include "base/alloc.h"
#include "map/gm_map_file.h"
#include "map/map_db.h"
#include "map/map_place.h"
#include "map/map_schema.h"

#include <string.h>

static gm_status read_one(const gm_db *db, sqlite3_stmt *rows, char **result,
                          gm_error *error)
{
    const char *text = sqlite3_column_type(rows, 0) == SQLITE_TEXT
                           ? (const char *)sqlite3_column_text(rows, 0)
                           : NULL;
    if (!text || strlen(text) != (size_t)sqlite3_column_bytes(rows, 0))
        return gm_db_damaged(db, "a measured result is wrong", error);
    *result = gm_strdup(text);
    return *result ? GM_OK
                   : gm_fail(error, GM_ERR_MEMORY, "no memory for the measured results");
}

static gm_status read_all(const gm_db *db, int n, char **results, gm_error *error)
{
    sqlite3_stmt *rows = NULL;
    gm_status status =
        gm_db_prepare(db, "SELECT json FROM result ORDER BY rowid", &rows, error);
    for (int i = 0; status == GM_OK && i < n; i++) {
        bool row = false;
        status = gm_db_next(db, rows, &row, error);
        if (status == GM_OK)
            status = read_one(db, rows, &results[i], error);
    }
    (void)sqlite3_finalize(rows);
    return status;
}

/* Made: *n is its length as soon as it is not NULL. */
static gm_status read_table(const gm_db *db, int *n, char ***made, gm_error *error)
{
    sqlite3_int64 tables = 0, count = 0;
    gm_status status = gm_db_integer(
        db, "SELECT count(*) FROM sqlite_master WHERE name = 'result'", &tables, error);
    if (status == GM_OK && tables > 0)
        status = gm_db_integer(db, "SELECT count(*) FROM result", &count, error);
    if (status != GM_OK || count == 0)
        return status;
    if (count > GM_MAP_MAX_TABLES)
        return gm_db_damaged(db, "it has too many measured results", error);
    *made = gm_calloc((size_t)count, sizeof **made);
    if (!*made)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for the measured results");
    *n = (int)count;
    return read_all(db, *n, *made, error);
}

gm_status gm_map_get_results(const char *path, int *n, char ***results, gm_error *error)
{
    gm_db db = {0};
    char **made = NULL;
    int count = 0;
    if (!gm_place_exists(path))
        return gm_fail(error, GM_ERR_IO, "%s: there is no such file", path);
    gm_status status = gm_db_open_constant(path, &db, error);
    if (status == GM_OK)
        status = gm_schema_is_map(&db, error);
    if (status == GM_OK)
        status = read_table(&db, &count, &made, error);
    gm_db_close(&db);
    if (status != GM_OK) {
        gm_map_results_free(count, made);
        return status;
    }
    *n = count;
    *results = made;
    return GM_OK;
}

void gm_map_results_free(int n, char **results)
{
    for (int i = 0; i < n; i++)
        gm_free(results[i]);
    gm_free(results);
}
