/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The journal of a sweep: a map's file in the making.
 *
 * Each row is one transaction in SQLite's write-ahead log, so a row is there with all its
 * values or not at all, and a killed program loses none that was put: what write() took
 * belongs to the operating system. Nothing waits for the disk before the end (a power
 * failure may cost the last rows, never the file). The lock is exclusive and stays from
 * opening to the end, which also keeps the log's index in memory: no shared file, and a
 * second sweep on the same journal is refused.
 *
 * A journal belongs to a sweep by its hash (gm_meta_sweep). One of another sweep, or one
 * that is damaged, is emptied under the lock and begun anew; a file that is no journal is
 * left alone.
 */
#include "base/alloc.h"
#include "map/map_frame.h"
#include "map/map_journal.h"
#include "map/map_meta.h"
#include "map/map_place.h"
#include "map/map_rules.h"
#include "map/map_schema.h"

#include <math.h>
#include <string.h>

#define LOG_PAGES "8192" /* of 4 KiB, before the log is moved into the file */

static int row_count(const gm_map *map, int t)
{
    return map->tables[t].n[0];
}

static gm_status make_rows(gm_journal *journal, const gm_map *map, gm_error *error)
{
    journal->n_tables = map->n_tables;
    journal->first = gm_calloc((size_t)map->n_tables + 1, sizeof *journal->first);
    journal->size = gm_calloc((size_t)map->n_tables, sizeof *journal->size);
    if (!journal->first || !journal->size)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for the journal of the sweep");
    for (int t = 0; t < map->n_tables; t++) {
        journal->first[t + 1] = journal->first[t] + row_count(map, t);
        journal->size[t] = gm_map_row_size(&map->tables[t]);
    }
    journal->count =
        gm_calloc((size_t)journal->first[map->n_tables], sizeof *journal->count);
    if (!journal->count)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for the journal of the sweep");
    return GM_OK;
}

void gm_journal_destroy(gm_journal *journal)
{
    if (!journal)
        return;
    (void)sqlite3_finalize(journal->begin);
    (void)sqlite3_finalize(journal->commit);
    (void)sqlite3_finalize(journal->put);
    gm_db_close(&journal->db);
    gm_free(journal->path);
    gm_free(journal->part);
    gm_free(journal->first);
    gm_free(journal->size);
    gm_free(journal->count);
    gm_free(journal);
}

/* Take the lock for good. The file may have been renamed or removed by the sweep that
 * had it until now: then it is not the journal any more. */
static gm_status lock(gm_journal *journal, gm_error *error)
{
    int moved = 0;
    gm_status status = gm_db_run(
        &journal->db, "PRAGMA locking_mode = EXCLUSIVE; BEGIN EXCLUSIVE; COMMIT", error);
    (void)sqlite3_file_control(journal->db.handle, "main", SQLITE_FCNTL_HAS_MOVED,
                               &moved);
    if (moved || status == GM_ERR_IO)
        journal->fresh = false; /* it is another sweep's */
    if (status == GM_OK && moved)
        return gm_fail(error, GM_ERR_IO, "%s is in use: another sweep has just ended",
                       journal->part);
    return status;
}

typedef enum file_kind { FILE_EMPTY, FILE_JOURNAL, FILE_UNNAMED, FILE_OTHER } file_kind;

/* What the header says (16 bytes of text; application id at byte 68, big endian), read
 * past the database, which may be too damaged to be asked. Through SQLite's own handle:
 * closing another one would drop this process's locks on the file. */
static file_kind look(const gm_journal *journal)
{
    unsigned char head[100] = {0};
    sqlite3_file *file = NULL;
    sqlite3_int64 size = 0;
    (void)sqlite3_file_control(journal->db.handle, "main", SQLITE_FCNTL_FILE_POINTER,
                               &file);
    if (!file || !file->pMethods || file->pMethods->xFileSize(file, &size) != SQLITE_OK)
        return FILE_OTHER;
    if (size == 0)
        return FILE_EMPTY;
    (void)file->pMethods->xRead(file, head, sizeof head, 0); /* short: zeros follow */
    unsigned long application = (unsigned long)head[68] << 24 |
                                (unsigned long)head[69] << 16 |
                                (unsigned long)head[70] << 8 | head[71];
    if (memcmp(head, "SQLite format 3", 16) != 0)
        return FILE_OTHER;
    return application == GM_MAP_APPLICATION ? FILE_JOURNAL
           : application == 0                ? FILE_UNNAMED
                                             : FILE_OTHER;
}

/* Empty (new, or left by a program that was killed while it made it), a journal, or
 * somebody's file. */
static gm_status identify(const gm_journal *journal, bool *empty, gm_error *error)
{
    sqlite3_int64 objects = 0;
    file_kind kind = look(journal);
    if (kind == FILE_UNNAMED) {
        gm_status status = gm_db_integer(
            &journal->db, "SELECT count(*) FROM sqlite_master", &objects, error);
        if (status != GM_OK && status != GM_ERR_FORMAT)
            return status;
        kind = status == GM_OK && objects == 0 ? FILE_EMPTY : FILE_OTHER;
    }
    if (kind == FILE_OTHER)
        return gm_fail(error, GM_ERR_IO,
                       "%s is in the way: it is not the journal of a sweep; move or "
                       "remove it",
                       journal->part);
    *empty = kind == FILE_EMPTY;
    return GM_OK;
}

static gm_status write_frame(const gm_journal *journal, const gm_map *map,
                             gm_error *error)
{
    char sweep[65];
    const gm_db *db = &journal->db;
    gm_status status = gm_meta_sweep(map, sweep, error);
    if (status == GM_OK)
        status = gm_schema_create(db, error);
    if (status == GM_OK)
        status = gm_meta_put(db, GM_META_STATE, GM_META_SWEEPING, error);
    if (status == GM_OK)
        status = gm_meta_put(db, GM_META_SWEEP, sweep, error);
    if (status == GM_OK)
        status = gm_frame_write_tables(db, map, error);
    return status;
}

/* Tables, axes and keys in one transaction, in the file itself and not in a log. */
static gm_status begin_anew(const gm_journal *journal, const gm_map *map, gm_error *error)
{
    const gm_db *db = &journal->db;
    gm_status status = gm_db_run(db, "BEGIN", error);
    if (status == GM_OK)
        status = write_frame(journal, map, error);
    if (status == GM_OK)
        return gm_db_run(db, "COMMIT", error);
    (void)sqlite3_exec(db->handle, "ROLLBACK", NULL, NULL, NULL);
    return status;
}

/* Empty it, whatever its state, without letting go of the lock. */
static gm_status wipe(gm_journal *journal, gm_error *error)
{
    sqlite3 *handle = journal->db.handle;
    (void)sqlite3_db_config(handle, SQLITE_DBCONFIG_RESET_DATABASE, 1, NULL);
    gm_status status = lock(journal, error); /* damage may have prevented it so far */
    if (status == GM_OK)
        status = gm_db_run(&journal->db, "VACUUM", error);
    (void)sqlite3_db_config(handle, SQLITE_DBCONFIG_RESET_DATABASE, 0, NULL);
    return status;
}

bool gm_journal_place(sqlite3_stmt *rows, const gm_map *map, int *table, int *row,
                      int *index, double *value)
{
    int j, k;
    if (!gm_column_int(rows, 0, 0, map->n_tables - 1, table))
        return false;
    const int *n = map->tables[*table].n;
    if (!gm_column_int(rows, 1, 0, n[0] - 1, row) ||
        !gm_column_int(rows, 2, 0, n[1] - 1, &j) ||
        !gm_column_int(rows, 3, 0, n[2] - 1, &k) || !gm_column_real(rows, 4, value))
        return false;
    *index = (*row * n[1] + j) * n[2] + k;
    return isfinite(*value);
}

/* Undo a load that failed on its way. */
static void forget_values(gm_journal *journal, gm_map *map)
{
    for (int t = 0; t < map->n_tables; t++) {
        int *count = &journal->count[journal->first[t]], size = journal->size[t];
        for (int m = 0; m < gm_map_table_size(&map->tables[t]); m++)
            if (count[m / size] > 0)
                map->tables[t].value[m] = 0.0;
        memset(count, 0, (size_t)row_count(map, t) * sizeof *count);
    }
    journal->resumed = 0;
}

static gm_status load(gm_journal *journal, gm_map *map, gm_error *error)
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
        double value;
        if (!gm_journal_place(rows, map, &t, &i, &index, &value)) {
            status = gm_db_damaged(db, "it has a value of no table", error);
        } else {
            map->tables[t].value[index] = value;
            journal->count[journal->first[t] + i]++;
            status = gm_db_next(db, rows, &row, error);
        }
    }
    (void)sqlite3_finalize(rows);
    for (int t = 0; status == GM_OK && t < map->n_tables; t++)
        for (int i = 0; i < row_count(map, t); i++)
            journal->resumed += gm_journal_has(journal, t, i);
    return status;
}

/* GM_ERR_FORMAT when it is not, or not any more, a journal of this sweep. */
static gm_status resume(gm_journal *journal, gm_map *map, gm_error *error)
{
    char sweep[65] = "", stored[65] = "";
    sqlite3_int64 version = 0;
    const gm_db *db = &journal->db;
    gm_status status = gm_meta_sweep(map, sweep, error);
    if (status == GM_OK)
        status = gm_db_integer(db, "PRAGMA user_version", &version, error);
    if (status == GM_OK && version != GM_MAP_FORMAT)
        return gm_fail(error, GM_ERR_FORMAT, "another format");
    if (status == GM_OK)
        status = gm_schema_check(db, error);
    if (status == GM_OK)
        status = gm_meta_get(db, GM_META_SWEEP, sizeof stored, stored, error);
    if (status == GM_OK && strcmp(sweep, stored) != 0)
        return gm_fail(error, GM_ERR_FORMAT, "another sweep");
    return status == GM_OK ? load(journal, map, error) : status;
}

static gm_status prepare(gm_journal *journal, gm_error *error)
{
    const gm_db *db = &journal->db;
    gm_status status =
        gm_db_run(db,
                  "PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL; "
                  "PRAGMA wal_autocheckpoint = " LOG_PAGES,
                  error);
    if (status == GM_OK)
        status = gm_db_prepare(db, "BEGIN", &journal->begin, error);
    if (status == GM_OK)
        status = gm_db_prepare(db, "COMMIT", &journal->commit, error);
    if (status == GM_OK)
        status = gm_db_prepare(db,
                               "INSERT OR REPLACE INTO value (map_table, i, j, k, value) "
                               "VALUES (?, ?, ?, ?, ?)",
                               &journal->put, error);
    return status;
}

static gm_status open_locked(gm_journal *journal, gm_map *map, gm_error *error)
{
    bool empty = false;
    gm_error why;
    gm_status found = lock(journal, &why);
    gm_status status = GM_OK;
    if (found == GM_OK || found == GM_ERR_FORMAT)
        status = identify(journal, &empty, error);
    if (status != GM_OK)
        return status;
    journal->fresh = journal->fresh || empty;
    if (found == GM_OK && !empty)
        found = resume(journal, map, &why);
    if (found != GM_OK)
        forget_values(journal, map);
    if (found == GM_ERR_FORMAT) {
        status = wipe(journal, error);
        empty = true;
    } else if (found != GM_OK) {
        status = gm_fail(error, found, "%s", why.message);
    }
    if (status == GM_OK && empty)
        status = begin_anew(journal, map, error);
    return status == GM_OK ? prepare(journal, error) : status;
}

gm_status gm_journal_open(const char *path, gm_map *map, gm_journal **journal,
                          gm_error *error)
{
    gm_journal *made = gm_calloc(1, sizeof *made);
    gm_status status = GM_OK;
    if (made) {
        made->path = gm_strdup(path);
        made->part = gm_place_journal(path);
    }
    if (!made || !made->path || !made->part)
        status = gm_fail(error, GM_ERR_MEMORY, "no memory for the journal of the sweep");
    if (status == GM_OK)
        status = gm_map_check_frame(map, error);
    if (status == GM_OK)
        status = make_rows(made, map, error);
    if (status == GM_OK)
        status = gm_place_check(path, error);
    if (status == GM_OK)
        status = gm_place_check(made->part, error);
    if (status == GM_OK) {
        made->fresh = !gm_place_exists(made->part);
        status = gm_db_open(made->part, &made->db, error);
    }
    if (status == GM_OK)
        status = open_locked(made, map, error);
    if (status == GM_OK) {
        *journal = made;
        return GM_OK;
    }
    if (made && made->fresh)
        gm_place_remove(made->part);
    gm_journal_destroy(made);
    return status;
}

bool gm_journal_has(const gm_journal *journal, int table, int row)
{
    if (table < 0 || table >= journal->n_tables || row < 0)
        return false;
    int index = journal->first[table] + row;
    return index < journal->first[table + 1] &&
           journal->count[index] == journal->size[table];
}
