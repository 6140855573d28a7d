/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A finished map as the bytes of its file, made in memory in one fixed order: unlike the
 * file of a sweep, in which rows lie as the threads finished them.
 */
#include "base/alloc.h"
#include "map/gm_map_file.h"
#include "map/map_frame.h"
#include "map/map_meta.h"
#include "map/map_rules.h"
#include "map/map_schema.h"

#include <string.h>

gm_status gm_frame_write_head(const gm_db *db, const gm_map *map, gm_error *error)
{
    char provenance[65];
    gm_status status = gm_meta_provenance(map, provenance, error);
    if (status == GM_OK)
        status = gm_meta_write(db, map, error);
    if (status == GM_OK)
        status = gm_meta_put(db, GM_META_PROVENANCE, provenance, error);
    if (status == GM_OK)
        status = gm_frame_write_paths(db, map, error);
    if (status == GM_OK)
        status = gm_meta_put(db, GM_META_STATE, GM_META_FINISHED, error);
    return status;
}

static gm_status write_values(const gm_db *db, sqlite3_stmt *put, const gm_map *map,
                              int t, gm_error *error)
{
    const gm_map_table *table = &map->tables[t];
    const int *n = table->n, size = gm_map_table_size(table);
    gm_status status = GM_OK;
    for (int m = 0; status == GM_OK && m < gm_map_value_count(table); m++) {
        (void)sqlite3_bind_int(put, 1, t);
        (void)sqlite3_bind_int(put, 2, m % size / (n[1] * n[2]));
        (void)sqlite3_bind_int(put, 3, m / n[2] % n[1]);
        (void)sqlite3_bind_int(put, 4, m % n[2]);
        (void)sqlite3_bind_double(put, 5, table->value[m]);
        if (map->n_oil > 0)
            (void)sqlite3_bind_int(put, 6, m / size);
        status = gm_db_step(db, put, error);
    }
    return status;
}

static gm_status write_all_values(const gm_db *db, const gm_map *map, gm_error *error)
{
    sqlite3_stmt *put = NULL;
    const char *sql =
        map->n_oil > 0
            ? "INSERT INTO value (map_table, i, j, k, value, oil) "
              "VALUES (?, ?, ?, ?, ?, ?)"
            : "INSERT INTO value (map_table, i, j, k, value) VALUES (?, ?, ?, ?, ?)";
    gm_status status = gm_db_prepare(db, sql, &put, error);
    for (int t = 0; status == GM_OK && t < map->n_tables; t++)
        status = write_values(db, put, map, t, error);
    (void)sqlite3_finalize(put);
    return status;
}

/* secure_delete: no page holds remains of another one. */
static gm_status write_all(const gm_db *db, const gm_map *map, gm_error *error)
{
    gm_status status = gm_db_run(db, "PRAGMA secure_delete = ON; BEGIN", error);
    if (status == GM_OK)
        status = gm_schema_create(db, gm_map_format(map), error);
    if (status == GM_OK)
        status = gm_frame_write_oil(db, map, error);
    if (status == GM_OK)
        status = gm_frame_write_tables(db, map, error);
    if (status == GM_OK)
        status = write_all_values(db, map, error);
    if (status == GM_OK)
        status = gm_frame_write_head(db, map, error);
    return status == GM_OK ? gm_db_run(db, "COMMIT", error) : status;
}

static gm_status copy_out(const gm_db *db, unsigned char **bytes, size_t *size,
                          gm_error *error)
{
    sqlite3_int64 n = 0;
    unsigned char *made = NULL, *image = sqlite3_serialize(db->handle, "main", &n, 0);
    if (image)
        made = gm_calloc((size_t)n, 1);
    if (made)
        memcpy(made, image, (size_t)n);
    sqlite3_free(image);
    if (!made)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for the file of the map");
    *bytes = made;
    *size = (size_t)n;
    return GM_OK;
}

gm_status gm_map_to_bytes(const gm_map *map, unsigned char **bytes, size_t *size,
                          gm_error *error)
{
    gm_db db = {0};
    gm_status status = gm_map_check(map, error);
    if (status == GM_OK)
        status = gm_db_open_memory(&db, error);
    if (status == GM_OK)
        status = write_all(&db, map, error);
    if (status == GM_OK)
        status = copy_out(&db, bytes, size, error);
    gm_db_close(&db);
    return status;
}
