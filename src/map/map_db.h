/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The few SQLite calls of this room, with statuses and sentences of ours.
 */
#ifndef MAP_DB_H
#define MAP_DB_H

#include "base/gm_status.h"

#include <sqlite3.h>
#include <stdbool.h>
#include <stddef.h>

/** An open database and its name for messages. */
typedef struct gm_db {
    sqlite3 *handle;
    char *path;
} gm_db;

/** Open for reading and writing, created when missing. On failure *db is empty. */
GM_NODISCARD gm_status gm_db_open(const char *path, gm_db *db, gm_error *error);

/** A new database that no file holds. */
GM_NODISCARD gm_status gm_db_open_memory(gm_db *db, gm_error *error);

/** Open read-only as a file that nobody changes: no lock, no file beside it. */
GM_NODISCARD gm_status gm_db_open_constant(const char *path, gm_db *db, gm_error *error);

/** Close; all statements must be finalised. An empty *db is fine. */
void gm_db_close(gm_db *db);

/** Status and sentence for the last SQLite error: GM_ERR_MEMORY; GM_ERR_FORMAT when the
 *  file is no database or damaged; else GM_ERR_IO. */
gm_status gm_db_fail(const gm_db *db, gm_error *error);

/** GM_ERR_FORMAT: "<path> is damaged: <what>". */
gm_status gm_db_damaged(const gm_db *db, const char *what, gm_error *error);

/** Run statements that give no rows (rows are ignored). */
GM_NODISCARD gm_status gm_db_run(const gm_db *db, const char *sql, gm_error *error);

/** Prepare one statement; finalise it with sqlite3_finalize. */
GM_NODISCARD gm_status gm_db_prepare(const gm_db *db, const char *sql,
                                     sqlite3_stmt **statement, gm_error *error);

/** Step a bound statement that gives no row, and reset it. */
GM_NODISCARD gm_status gm_db_step(const gm_db *db, sqlite3_stmt *statement,
                                  gm_error *error);

/** Next row: *row false at the end. */
GM_NODISCARD gm_status gm_db_next(const gm_db *db, sqlite3_stmt *statement, bool *row,
                                  gm_error *error);

/** The one integer that a statement such as a PRAGMA gives. */
GM_NODISCARD gm_status gm_db_integer(const gm_db *db, const char *sql,
                                     sqlite3_int64 *value, gm_error *error);

/** Columns, strictly: false unless the column has this type and fits. */
bool gm_column_int(sqlite3_stmt *statement, int column, int low, int high, int *value);
bool gm_column_real(sqlite3_stmt *statement, int column, double *value);
bool gm_column_text(sqlite3_stmt *statement, int column, size_t size, char *text);

#endif
