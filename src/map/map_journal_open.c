/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The journal of a sweep: a map's file in the making.
 *
 * Records come in blocks. Each block is one transaction in SQLite's write-ahead log, so
 * it is there as a whole or not at all, and a killed program loses none that was put:
 * what write() took belongs to the operating system. Nothing waits for the disk (a power
 * failure may cost the last blocks, never the file). The lock is exclusive and stays from
 * opening to the end, which also keeps the log's index in memory: no shared file, and a
 * second sweep on the same journal is refused.
 *
 * A journal belongs to a sweep by its hash (gm_meta_sweep). One of another sweep, or one
 * that is damaged, is emptied under the lock and begun anew; a file that is no journal is
 * left alone.
 */
#include "base/alloc.h"
#include "map/map_journal.h"
#include "map/map_meta.h"
#include "map/map_place.h"
#include "map/map_rules.h"
#include "map/map_schema.h"

#include <string.h>

#define LOG_PAGES "8192" /* of 4 KiB, before the log is moved into the file */
#define MAX_RECORD 4096

/* Beside the tables of a map, which stay empty. */
static const char block_table[] = "CREATE TABLE block (\n"
                                  "  id INTEGER PRIMARY KEY,\n"
                                  "  sum INTEGER NOT NULL,\n"
                                  "  records BLOB NOT NULL\n"
                                  ")";

void gm_journal_destroy(gm_journal *journal)
{
    if (!journal)
        return;
    (void)sqlite3_finalize(journal->put);
    gm_db_close(&journal->db);
    gm_free(journal->path);
    gm_free(journal->part);
    gm_free(journal->records);
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
    gm_status status = gm_meta_sweep(map, journal->record, sweep, error);
    if (status == GM_OK)
        status = gm_schema_create(db, gm_map_format(map), error);
    if (status == GM_OK)
        status = gm_db_run(db, block_table, error);
    if (status == GM_OK)
        status = gm_meta_put(db, GM_META_STATE, GM_META_SWEEPING, error);
    if (status == GM_OK)
        status = gm_meta_put(db, GM_META_SWEEP, sweep, error);
    return status;
}

/* In one transaction, in the file itself and not in a log. */
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

/* A block after those before it, of which `used` bytes are taken. */
static gm_status take_block(const gm_journal *journal, sqlite3_stmt *rows, size_t room,
                            size_t *used, gm_error *error)
{
    const void *bytes = sqlite3_column_blob(rows, 1);
    size_t size = (size_t)sqlite3_column_bytes(rows, 1);
    if (!bytes || size % journal->record != 0 || size > room - *used ||
        sqlite3_column_int64(rows, 0) != gm_journal_sum(bytes, size))
        return gm_db_damaged(&journal->db, "it has a wrong block", error);
    memcpy(journal->records + *used, bytes, size);
    *used += size;
    return GM_OK;
}

static gm_status read_blocks(gm_journal *journal, size_t room, gm_error *error)
{
    sqlite3_stmt *rows;
    bool row = true;
    size_t used = 0;
    const gm_db *db = &journal->db;
    gm_status status =
        gm_db_prepare(db, "SELECT sum, records FROM block ORDER BY id", &rows, error);
    if (status == GM_OK)
        status = gm_db_next(db, rows, &row, error);
    while (status == GM_OK && row) {
        status = take_block(journal, rows, room, &used, error);
        if (status == GM_OK)
            status = gm_db_next(db, rows, &row, error);
    }
    (void)sqlite3_finalize(rows);
    journal->count = status == GM_OK ? (long)(used / journal->record) : 0;
    return status;
}

static gm_status load(gm_journal *journal, gm_error *error)
{
    sqlite3_int64 room = 0, pages = 0, page_size = 0;
    const gm_db *db = &journal->db;
    gm_status status =
        gm_db_integer(db, "SELECT total(length(records)) FROM block", &room, error);
    if (status == GM_OK)
        status = gm_db_integer(db, "PRAGMA page_count", &pages, error);
    if (status == GM_OK)
        status = gm_db_integer(db, "PRAGMA page_size", &page_size, error);
    if (status == GM_OK && (room < 0 || room > pages * page_size))
        return gm_db_damaged(db, "its blocks are larger than it", error);
    if (status != GM_OK || room == 0)
        return status;
    journal->records = gm_calloc((size_t)room, 1);
    if (!journal->records)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for the journal of the sweep");
    return read_blocks(journal, (size_t)room, error);
}

/* GM_ERR_FORMAT when it is not, or not any more, a journal of this sweep. */
static gm_status resume(gm_journal *journal, const gm_map *map, gm_error *error)
{
    char sweep[65] = "", stored[65] = "";
    sqlite3_int64 version = 0;
    const gm_db *db = &journal->db;
    gm_status status = gm_meta_sweep(map, journal->record, sweep, error);
    if (status == GM_OK)
        status = gm_db_integer(db, "PRAGMA user_version", &version, error);
    if (status == GM_OK && version != gm_map_format(map))
        return gm_fail(error, GM_ERR_FORMAT, "another format");
    if (status == GM_OK)
        status = gm_schema_check(db, gm_map_format(map), error);
    if (status == GM_OK)
        status = gm_meta_get(db, GM_META_SWEEP, sizeof stored, stored, error);
    if (status == GM_OK && strcmp(sweep, stored) != 0)
        return gm_fail(error, GM_ERR_FORMAT, "another sweep");
    return status == GM_OK ? load(journal, error) : status;
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
        status = gm_db_prepare(db, "INSERT INTO block (sum, records) VALUES (?, ?)",
                               &journal->put, error);
    return status;
}

static gm_status open_locked(gm_journal *journal, const gm_map *map, gm_error *error)
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

gm_status gm_journal_open(const char *path, const gm_map *map, size_t record,
                          gm_journal **journal, gm_error *error)
{
    gm_journal *made = gm_calloc(1, sizeof *made);
    gm_status status = GM_OK;
    if (record < 1 || record > MAX_RECORD)
        status = gm_fail(error, GM_ERR_ARGUMENT, "a journal has no records of %zu bytes",
                         record);
    if (made) {
        made->record = record;
        made->path = gm_strdup(path);
        made->part = gm_place_journal(path);
    }
    if (status == GM_OK && (!made || !made->path || !made->part))
        status = gm_fail(error, GM_ERR_MEMORY, "no memory for the journal of the sweep");
    if (status == GM_OK)
        status = gm_map_check_frame(map, error);
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
