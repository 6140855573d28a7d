/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Reading a finished map. The file may come from anywhere and be anything: it is opened
 * read-only, checked from the outside in, and believed only when its content gives its
 * content hash.
 */
#include "base/alloc.h"
#include "map/gm_map_file.h"
#include "map/map_frame.h"
#include "map/map_meta.h"
#include "map/map_rules.h"
#include "map/map_schema.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

static gm_status check_file(const char *path, long long *size, gm_error *error)
{
    struct stat info;
    if (stat(path, &info) != 0)
        return errno == ENOENT
                   ? gm_fail(error, GM_ERR_IO, "%s: there is no such file", path)
                   : gm_fail(error, GM_ERR_IO, "%s cannot be read: %s", path,
                             strerror(errno));
    if (!S_ISREG(info.st_mode))
        return gm_fail(error, GM_ERR_IO, "%s is not a file", path);
    if (info.st_size == 0)
        return gm_fail(error, GM_ERR_FORMAT, "%s is not a map: it is empty", path);
    *size = info.st_size;
    return GM_OK;
}

/* Whose file is it, of which version, and is all of it there? */
static gm_status check_header(const gm_db *db, long long size, int *format,
                              gm_error *error)
{
    sqlite3_int64 application = 0, version = 0, pages = 0, page_size = 0;
    gm_status status = gm_db_integer(db, "PRAGMA application_id", &application, error);
    if (status == GM_OK)
        status = gm_db_integer(db, "PRAGMA user_version", &version, error);
    if (status == GM_OK && application != GM_MAP_APPLICATION)
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s is not a map: it is an SQLite file of another kind", db->path);
    if (status == GM_OK && version != GM_MAP_FORMAT && version != GM_MAP_FORMAT_ONE_OIL)
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s is a map of format %d, but this version of Gearmap reads "
                       "formats %d and %d",
                       db->path, (int)version, GM_MAP_FORMAT_ONE_OIL, GM_MAP_FORMAT);
    *format = (int)version;
    if (status == GM_OK)
        status = gm_db_integer(db, "PRAGMA page_size", &page_size, error);
    if (status == GM_OK)
        status = gm_db_integer(db, "PRAGMA page_count", &pages, error);
    if (status == GM_OK && pages * page_size != size)
        status = gm_fail(error, GM_ERR_FORMAT,
                         "%s is damaged: it has %lld bytes instead of %lld", db->path,
                         size, (long long)(pages * page_size));
    return status;
}

static gm_status check_state(const gm_db *db, gm_error *error)
{
    char state[16] = "";
    gm_status status = gm_meta_get(db, GM_META_STATE, sizeof state, state, error);
    if (status != GM_OK || strcmp(state, GM_META_FINISHED) == 0)
        return status;
    if (strcmp(state, GM_META_SWEEPING) == 0)
        return gm_fail(error, GM_ERR_FORMAT,
                       "%s is an unfinished sweep: run the same sweep again to finish it",
                       db->path);
    return gm_db_damaged(db, "its state is unknown", error);
}

/* Values come in the order of their key; the k-th row must be the k-th value. */
static gm_status read_values(const gm_db *db, sqlite3_stmt *rows, int t,
                             gm_map_table *table, gm_error *error)
{
    int size = gm_map_table_size(table), row_size = gm_map_row_size(table);
    gm_status status = GM_OK;
    for (int m = 0; status == GM_OK && m < gm_map_value_count(table); m++) {
        int oil = m / size, i = m % size / row_size, j = m % row_size / table->n[2],
            k = m % table->n[2], any;
        bool row = false;
        status = gm_db_next(db, rows, &row, error);
        if (status == GM_OK &&
            !(row && gm_column_int(rows, 0, t, t, &any) &&
              gm_column_int(rows, 1, i, i, &any) && gm_column_int(rows, 2, j, j, &any) &&
              gm_column_int(rows, 3, k, k, &any) &&
              gm_column_real(rows, 4, &table->value[m]) &&
              gm_column_int(rows, 5, oil, oil, &any)))
            status = gm_db_damaged(db, "a value is missing or wrong", error);
    }
    return status;
}

static gm_status read_all_values(const gm_db *db, gm_map *map, gm_error *error)
{
    sqlite3_stmt *rows;
    bool more = false;
    const char *sql = map->n_oil > 0 ? "SELECT map_table, i, j, k, value, oil FROM value "
                                       "ORDER BY map_table, oil, i, j, k"
                                     : "SELECT map_table, i, j, k, value, 0 FROM value "
                                       "ORDER BY map_table, i, j, k";
    gm_status status = gm_db_prepare(db, sql, &rows, error);
    for (int t = 0; status == GM_OK && t < map->n_tables; t++)
        status = read_values(db, rows, t, &map->tables[t], error);
    if (status == GM_OK)
        status = gm_db_next(db, rows, &more, error);
    if (status == GM_OK && more)
        status = gm_db_damaged(db, "it has values of no table", error);
    (void)sqlite3_finalize(rows);
    return status;
}

/* The numbers are those that were written: the hashes say so. */
static gm_status check_hashes(const gm_db *db, const gm_map *map, gm_error *error)
{
    char content[65], written[65], provenance[65];
    gm_status status = gm_map_hash(map, content, error);
    if (status == GM_OK && strcmp(content, map->content_hash) != 0)
        return gm_db_damaged(db, "its content does not give its content hash", error);
    if (status == GM_OK)
        status = gm_meta_get(db, GM_META_PROVENANCE, sizeof written, written, error);
    if (status == GM_OK)
        status = gm_meta_provenance(map, provenance, error);
    if (status == GM_OK && strcmp(provenance, written) != 0)
        return gm_db_damaged(db, "its tool version is not the one written", error);
    return status;
}

static gm_status read_content(const gm_db *db, long long size, gm_map *map,
                              gm_error *error)
{
    gm_error detail = {0};
    int format = 0;
    gm_status status = check_header(db, size, &format, error);
    if (status == GM_OK)
        status = gm_schema_check(db, format, error);
    if (status == GM_OK)
        status = check_state(db, error);
    if (status == GM_OK)
        status = gm_meta_read(db, map, error);
    if (status == GM_OK && format != GM_MAP_FORMAT_ONE_OIL)
        status = gm_frame_read_oil(db, map, error);
    if (status == GM_OK)
        status = gm_frame_read_paths(db, map, error);
    if (status == GM_OK)
        status = gm_frame_read_tables(db, size, map, error);
    if (status == GM_OK)
        status = read_all_values(db, map, error);
    if (status == GM_OK)
        status = check_hashes(db, map, error);
    if (status == GM_OK && gm_map_check(map, &detail) != GM_OK)
        status = gm_fail(error, GM_ERR_FORMAT, "%s: %.400s", db->path, detail.message);
    return status;
}

gm_status gm_map_read(const char *path, gm_map **map, gm_error *error)
{
    long long size = 0;
    gm_db db = {0};
    gm_map *made = NULL;
    gm_status status = check_file(path, &size, error);
    if (status == GM_OK)
        status = gm_db_open_constant(path, &db, error);
    if (status == GM_OK) {
        made = gm_map_create();
        if (made)
            status = read_content(&db, size, made, error);
        else
            status = gm_fail(error, GM_ERR_MEMORY, "no memory to read %s", path);
    }
    gm_db_close(&db);
    if (status == GM_OK)
        *map = made;
    else
        gm_map_destroy(made);
    return status;
}
