/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Using a journal: rows into it, and the map out of it. How it is kept and opened:
 * map_journal_open.c.
 */
#include "map/map_journal.h"

#include "map/map_frame.h"
#include "map/map_meta.h"
#include "map/map_place.h"
#include "map/map_rules.h"

#include <math.h>
#include <string.h>

int gm_journal_resumed(const gm_journal *journal)
{
    return journal->resumed;
}

static gm_status put_values(const gm_journal *journal, const gm_map_table *table, int t,
                            int row, gm_error *error)
{
    const double *values = &table->value[(size_t)row * (size_t)journal->size[t]];
    gm_status status = GM_OK;
    (void)sqlite3_bind_int(journal->put, 1, t);
    (void)sqlite3_bind_int(journal->put, 2, row);
    for (int m = 0; status == GM_OK && m < journal->size[t]; m++) {
        (void)sqlite3_bind_int(journal->put, 3, m / table->n[2]);
        (void)sqlite3_bind_int(journal->put, 4, m % table->n[2]);
        (void)sqlite3_bind_double(journal->put, 5, values[m]);
        status = gm_db_step(&journal->db, journal->put, error);
    }
    return status;
}

static gm_status check_row(const gm_journal *journal, const gm_map *map, int t, int row,
                           gm_error *error)
{
    if (t < 0 || t >= journal->n_tables || map->n_tables != journal->n_tables ||
        row < 0 || row >= map->tables[t].n[0])
        return gm_fail(error, GM_ERR_ARGUMENT, "the map has no row %d of table %d", row,
                       t);
    for (int m = 0; m < journal->size[t]; m++) {
        char words[GM_KEY_TEXT];
        double value = map->tables[t].value[row * journal->size[t] + m];
        if (isfinite(value))
            continue;
        gm_map_key_text(map, &map->tables[t].key, words);
        return gm_fail(error, GM_ERR_ARGUMENT, "%s, row %d: a value is %g", words, row,
                       value);
    }
    return GM_OK;
}

gm_status gm_journal_put(gm_journal *journal, const gm_map *map, int table, int row,
                         gm_error *error)
{
    const gm_db *db = &journal->db;
    gm_status status = check_row(journal, map, table, row, error);
    if (status != GM_OK)
        return status;
    status = gm_db_step(db, journal->begin, error);
    if (status == GM_OK)
        status = put_values(journal, &map->tables[table], table, row, error);
    if (status == GM_OK)
        status = gm_db_step(db, journal->commit, error);
    if (status == GM_OK)
        journal->count[journal->first[table] + row] = journal->size[table];
    else
        (void)sqlite3_exec(db->handle, "ROLLBACK", NULL, NULL, NULL);
    return status;
}

/* SQLite keeps no negative zero; the map in memory shall be what a reader gets. */
static void drop_negative_zeros(gm_map *map)
{
    for (int t = 0; t < map->n_tables; t++) {
        gm_map_table *table = &map->tables[t];
        for (int m = 0; m < gm_map_table_size(table); m++)
            if (table->value[m] == 0.0)
                table->value[m] = 0.0;
    }
}

/* Rows whose values changed in the map since they were put count as not stored. */
static gm_status find_changed(gm_journal *journal, const gm_map *map, gm_error *error)
{
    sqlite3_stmt *rows;
    bool row = true;
    const gm_db *db = &journal->db;
    gm_status status =
        gm_db_prepare(db, "SELECT map_table, i, j, k, value FROM value", &rows, error);
    if (status == GM_OK)
        status = gm_db_next(db, rows, &row, error);
    while (status == GM_OK && row) {
        int t, i, index;
        double stored;
        if (!gm_journal_place(rows, map, &t, &i, &index, &stored)) {
            status = gm_db_damaged(db, "it has a value of no table", error);
        } else {
            if (memcmp(&stored, &map->tables[t].value[index], sizeof stored) != 0)
                journal->count[journal->first[t] + i] = 0;
            status = gm_db_next(db, rows, &row, error);
        }
    }
    (void)sqlite3_finalize(rows);
    return status;
}

static gm_status put_changed(gm_journal *journal, const gm_map *map, gm_error *error)
{
    gm_status status = find_changed(journal, map, error);
    for (int t = 0; status == GM_OK && t < map->n_tables; t++)
        for (int i = 0; status == GM_OK && i < map->tables[t].n[0]; i++)
            if (!gm_journal_has(journal, t, i))
                status = gm_journal_put(journal, map, t, i, error);
    return status;
}

static gm_status check_complete(const gm_journal *journal, const gm_map *map,
                                gm_error *error)
{
    int missing = 0;
    if (map->n_tables != journal->n_tables)
        return gm_fail(error, GM_ERR_ARGUMENT, "the map is not the one of the journal");
    for (int t = 0; t < map->n_tables; t++)
        for (int i = 0; i < map->tables[t].n[0]; i++)
            missing += !gm_journal_has(journal, t, i);
    if (missing > 0)
        return gm_fail(error, GM_ERR_ARGUMENT, "%d rows of the sweep are missing",
                       missing);
    return gm_map_check(map, error);
}

/* Make the journal a map: all that was still missing, then no log beside it. */
static gm_status seal(gm_journal *journal, const gm_map *map, gm_error *error)
{
    const gm_db *db = &journal->db;
    gm_status status = put_changed(journal, map, error);
    if (status == GM_OK)
        status = gm_db_run(db, "BEGIN", error);
    if (status != GM_OK)
        return status;
    status = gm_frame_write_head(db, map, error);
    if (status == GM_OK)
        status = gm_db_run(db, "COMMIT", error);
    else
        (void)sqlite3_exec(db->handle, "ROLLBACK", NULL, NULL, NULL);
    if (status == GM_OK)
        status = gm_db_run(db,
                           "PRAGMA wal_checkpoint(TRUNCATE); "
                           "PRAGMA journal_mode = DELETE",
                           error);
    return status;
}

gm_status gm_journal_finish(gm_journal *journal, gm_map *map, gm_error *error)
{
    char before[sizeof map->content_hash], hash[65];
    memcpy(before, map->content_hash, sizeof before);
    gm_status status = check_complete(journal, map, error);
    if (status == GM_OK) {
        drop_negative_zeros(map);
        status = gm_map_hash(map, hash, error);
    }
    if (status == GM_OK) {
        memcpy(map->content_hash, hash, sizeof hash);
        status = seal(journal, map, error);
        /* renamed under the lock: no other sweep can get between */
        if (status == GM_OK)
            status = gm_place_rename(journal->part, journal->path, error);
        if (status != GM_OK)
            memcpy(map->content_hash, before, sizeof before);
    }
    gm_journal_destroy(journal);
    return status;
}

void gm_journal_close(gm_journal *journal, bool keep)
{
    if (journal && !keep) {
        (void)sqlite3_db_config(journal->db.handle, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1,
                                NULL);
        gm_place_remove(journal->part);
    }
    gm_journal_destroy(journal);
}
