/* SPDX-License-Identifier: BSD-2-Clause */
#include "map/map_meta.h"

#include "base/sha256.h"
#include "map/map_rules.h"

#include <string.h>

typedef struct meta_item {
    const char *key;
    size_t offset;    /* in gm_map */
    size_t size;      /* of a text; 0: a number */
    const char *unit; /* NULL: none */
} meta_item;

#define TEXT(field)                                                                      \
    {                                                                                    \
#field, offsetof(gm_map, field), sizeof(((gm_map *)0)->field), NULL              \
    }
#define NUMBER(field, unit)                                                              \
    {                                                                                    \
#field, offsetof(gm_map, field), 0, unit                                         \
    }

// clang-format off
static const meta_item items[] = {
    TEXT(name),
    TEXT(title),
    TEXT(tool_version),
    TEXT(input_sha256),
    TEXT(options),
    TEXT(content_hash),
    NUMBER(speed_max, "rad/s"),
    NUMBER(torque_max, "N.m"),
    NUMBER(oil_temperature, "K"),
    NUMBER(inertia_output, "kg.m2"),
};
// clang-format on

#define N_ITEMS (sizeof items / sizeof *items)
#define PUT "INSERT OR REPLACE INTO meta (key, value, unit) VALUES (?, ?, ?)"
#define GET "SELECT value FROM meta WHERE key = ?"

gm_status gm_meta_put(const gm_db *db, const char *key, const char *text, gm_error *error)
{
    sqlite3_stmt *put;
    gm_status status = gm_db_prepare(db, PUT, &put, error);
    if (status == GM_OK) {
        (void)sqlite3_bind_text(put, 1, key, -1, SQLITE_STATIC);
        (void)sqlite3_bind_text(put, 2, text, -1, SQLITE_STATIC);
        status = gm_db_step(db, put, error);
    }
    (void)sqlite3_finalize(put);
    return status;
}

gm_status gm_meta_write(const gm_db *db, const gm_map *map, gm_error *error)
{
    sqlite3_stmt *put;
    gm_status status = gm_db_prepare(db, PUT, &put, error);
    for (size_t i = 0; status == GM_OK && i < N_ITEMS; i++) {
        const char *field = (const char *)map + items[i].offset;
        (void)sqlite3_bind_text(put, 1, items[i].key, -1, SQLITE_STATIC);
        if (items[i].size > 0) {
            (void)sqlite3_bind_text(put, 2, field, -1, SQLITE_STATIC);
        } else {
            double number;
            memcpy(&number, field, sizeof number);
            (void)sqlite3_bind_double(put, 2, number);
        }
        (void)sqlite3_bind_text(put, 3, items[i].unit, -1, SQLITE_STATIC);
        status = gm_db_step(db, put, error);
    }
    (void)sqlite3_finalize(put);
    return status;
}

static gm_status missing(const gm_db *db, const char *key, gm_error *error)
{
    return gm_fail(error, GM_ERR_FORMAT,
                   "%s is damaged: its entry '%s' is missing or wrong", db->path, key);
}

/* Read one entry: a text when size > 0, else a number. */
static gm_status get(const gm_db *db, sqlite3_stmt *find, const char *key, size_t size,
                     void *field, gm_error *error)
{
    bool row = false;
    double number = 0.0;
    (void)sqlite3_bind_text(find, 1, key, -1, SQLITE_STATIC);
    gm_status status = gm_db_next(db, find, &row, error);
    if (status == GM_OK && size > 0 && !(row && gm_column_text(find, 0, size, field)))
        status = missing(db, key, error);
    if (status == GM_OK && size == 0) {
        if (row && gm_column_real(find, 0, &number))
            memcpy(field, &number, sizeof number);
        else
            status = missing(db, key, error);
    }
    (void)sqlite3_reset(find);
    return status;
}

gm_status gm_meta_get(const gm_db *db, const char *key, size_t size, char *text,
                      gm_error *error)
{
    sqlite3_stmt *find;
    gm_status status = gm_db_prepare(db, GET, &find, error);
    if (status == GM_OK)
        status = get(db, find, key, size, text, error);
    (void)sqlite3_finalize(find);
    return status;
}

gm_status gm_meta_read(const gm_db *db, gm_map *map, gm_error *error)
{
    sqlite3_stmt *find;
    gm_status status = gm_db_prepare(db, GET, &find, error);
    for (size_t i = 0; status == GM_OK && i < N_ITEMS; i++)
        status = get(db, find, items[i].key, items[i].size, (char *)map + items[i].offset,
                     error);
    (void)sqlite3_finalize(find);
    return status;
}

gm_status gm_meta_provenance(const gm_map *map, char text[65], gm_error *error)
{
    gm_sha256 *sum = gm_sha256_create();
    if (!sum)
        return gm_fail(error, GM_ERR_MEMORY, "no memory to hash the map");
    gm_sha256_text(sum, map->content_hash);
    gm_sha256_text(sum, map->tool_version);
    gm_sha256_finish(sum, text);
    gm_sha256_destroy(sum);
    return GM_OK;
}

gm_status gm_meta_sweep(const gm_map *map, size_t record, char text[65], gm_error *error)
{
    gm_sha256 *sum = gm_sha256_create();
    if (!sum)
        return gm_fail(error, GM_ERR_MEMORY, "no memory to hash the sweep");
    gm_sha256_int(sum, gm_map_format(map));
    gm_sha256_text(sum, map->tool_version);
    gm_sha256_text(sum, map->input_sha256);
    gm_sha256_text(sum, map->options);
    gm_sha256_int(sum, map->n_paths);
    for (int p = 0; p < map->n_paths; p++) {
        gm_sha256_text(sum, map->paths[p].name);
        gm_sha256_int(sum, map->paths[p].n_gears);
        for (int g = 0; g < map->paths[p].n_gears; g++)
            gm_sha256_int(sum, map->paths[p].gears[g].number);
    }
    gm_sha256_int(sum, (long long)record);
    for (int k = 0; k < map->n_oil; k++)
        gm_sha256_double(sum, map->oil[k]);
    gm_sha256_finish(sum, text);
    gm_sha256_destroy(sum);
    return GM_OK;
}
