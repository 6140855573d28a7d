/* SPDX-License-Identifier: BSD-2-Clause */
#include "map/map_db.h"

#include "base/alloc.h"

#include <string.h>

#define LONGEST_CELL 1000000 /* bytes; no text of a map comes near */

/* "file:" name for SQLite: all but plain characters as %XX. NULL: no memory. */
static char *uri_of(const char *path, const char *query)
{
    static const char hex[] = "0123456789ABCDEF";
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                "0123456789/-_.";
    const char *scheme = path[0] == '/' ? "file://" : "file:";
    char *uri = gm_calloc(strlen(scheme) + 3 * strlen(path) + strlen(query) + 1, 1);
    if (!uri)
        return NULL;
    char *end = uri + strlen(scheme);
    memcpy(uri, scheme, strlen(scheme));
    for (const char *s = path; *s; s++) {
        unsigned char c = (unsigned char)*s;
        if (strchr(plain, c)) {
            *end++ = (char)c;
        } else {
            *end++ = '%';
            *end++ = hex[c >> 4];
            *end++ = hex[c & 15];
        }
    }
    memcpy(end, query, strlen(query) + 1);
    return uri;
}

/* name: what SQLite opens; path: what messages show. */
static gm_status open_as(const char *name, const char *path, int flags, gm_db *db,
                         gm_error *error)
{
    gm_status status;
    gm_db made = {NULL, gm_strdup(path)};
    if (!made.path)
        return gm_fail(error, GM_ERR_MEMORY, "no memory to open %s", path);
    if (sqlite3_open_v2(name, &made.handle, flags | SQLITE_OPEN_NOMUTEX, NULL)) {
        status = gm_db_fail(&made, error);
        gm_db_close(&made);
        return status;
    }
    (void)sqlite3_extended_result_codes(made.handle, 0);
    (void)sqlite3_limit(made.handle, SQLITE_LIMIT_LENGTH, LONGEST_CELL);
    /* a file may come from anywhere: no tricks through its schema */
    (void)sqlite3_db_config(made.handle, SQLITE_DBCONFIG_DEFENSIVE, 1, NULL);
    (void)sqlite3_db_config(made.handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, NULL);
    (void)sqlite3_db_config(made.handle, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, NULL);
    *db = made;
    return GM_OK;
}

gm_status gm_db_open(const char *path, gm_db *db, gm_error *error)
{
    char *uri = uri_of(path, "");
    if (!uri)
        return gm_fail(error, GM_ERR_MEMORY, "no memory to open %s", path);
    gm_status status =
        open_as(uri, path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_URI,
                db, error);
    gm_free(uri);
    return status;
}

gm_status gm_db_open_memory(gm_db *db, gm_error *error)
{
    return open_as(":memory:", "the map in memory",
                   SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, db, error);
}

gm_status gm_db_open_constant(const char *path, gm_db *db, gm_error *error)
{
    char *uri = uri_of(path, "?immutable=1");
    if (!uri)
        return gm_fail(error, GM_ERR_MEMORY, "no memory to open %s", path);
    gm_status status =
        open_as(uri, path, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, db, error);
    gm_free(uri);
    return status;
}

void gm_db_close(gm_db *db)
{
    (void)sqlite3_close(db->handle);
    gm_free(db->path);
    *db = (gm_db){0};
}

/* The last error's primary code; SQLite calls some lacks of memory an I/O error. */
static int code_of(const gm_db *db)
{
    int code = db->handle ? sqlite3_extended_errcode(db->handle) : SQLITE_NOMEM;
    return code == SQLITE_IOERR_NOMEM ? SQLITE_NOMEM : code & 0xff;
}

gm_status gm_db_fail(const gm_db *db, gm_error *error)
{
    switch (code_of(db)) {
    case SQLITE_NOMEM:
        return gm_fail(error, GM_ERR_MEMORY, "no memory to work on %s", db->path);
    case SQLITE_NOTADB:
        return gm_fail(error, GM_ERR_FORMAT, "%s is not a map: it is not an SQLite file",
                       db->path);
    case SQLITE_CORRUPT:
    case SQLITE_SCHEMA:
    case SQLITE_ERROR: /* our statements are right: it is the schema that is not */
    case SQLITE_CONSTRAINT:
    case SQLITE_TOOBIG:
    case SQLITE_MISMATCH:
        return gm_db_damaged(db, sqlite3_errmsg(db->handle), error);
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
        return gm_fail(error, GM_ERR_IO, "%s is in use: another sweep is writing it",
                       db->path);
    case SQLITE_FULL:
        return gm_fail(error, GM_ERR_IO, "%s cannot be written: no space is left",
                       db->path);
    default:
        return gm_fail(error, GM_ERR_IO, "%s cannot be read or written: %s", db->path,
                       sqlite3_errmsg(db->handle));
    }
}

gm_status gm_db_damaged(const gm_db *db, const char *what, gm_error *error)
{
    return gm_fail(error, GM_ERR_FORMAT, "%s is damaged: %.300s", db->path, what);
}

gm_status gm_db_run(const gm_db *db, const char *sql, gm_error *error)
{
    if (sqlite3_exec(db->handle, sql, NULL, NULL, NULL) == SQLITE_OK)
        return GM_OK;
    return gm_db_fail(db, error);
}

gm_status gm_db_prepare(const gm_db *db, const char *sql, sqlite3_stmt **statement,
                        gm_error *error)
{
    *statement = NULL;
    if (sqlite3_prepare_v2(db->handle, sql, -1, statement, NULL) == SQLITE_OK)
        return GM_OK;
    return gm_db_fail(db, error);
}

gm_status gm_db_step(const gm_db *db, sqlite3_stmt *statement, gm_error *error)
{
    gm_status status = GM_OK;
    if (sqlite3_step(statement) != SQLITE_DONE)
        status = gm_db_fail(db, error);
    (void)sqlite3_reset(statement);
    return status;
}

gm_status gm_db_next(const gm_db *db, sqlite3_stmt *statement, bool *row, gm_error *error)
{
    int code = sqlite3_step(statement);
    *row = code == SQLITE_ROW;
    return *row || code == SQLITE_DONE ? GM_OK : gm_db_fail(db, error);
}

gm_status gm_db_integer(const gm_db *db, const char *sql, sqlite3_int64 *value,
                        gm_error *error)
{
    sqlite3_stmt *statement;
    bool row = false;
    gm_status status = gm_db_prepare(db, sql, &statement, error);
    if (status == GM_OK)
        status = gm_db_next(db, statement, &row, error);
    if (status == GM_OK)
        *value = row ? sqlite3_column_int64(statement, 0) : 0;
    (void)sqlite3_finalize(statement);
    return status;
}

bool gm_column_int(sqlite3_stmt *statement, int column, int low, int high, int *value)
{
    if (sqlite3_column_type(statement, column) != SQLITE_INTEGER)
        return false;
    sqlite3_int64 v = sqlite3_column_int64(statement, column);
    if (v < low || v > high)
        return false;
    *value = (int)v;
    return true;
}

bool gm_column_real(sqlite3_stmt *statement, int column, double *value)
{
    if (sqlite3_column_type(statement, column) != SQLITE_FLOAT)
        return false;
    *value = sqlite3_column_double(statement, column);
    return true;
}

bool gm_column_text(sqlite3_stmt *statement, int column, size_t size, char *text)
{
    if (sqlite3_column_type(statement, column) != SQLITE_TEXT)
        return false;
    const unsigned char *from = sqlite3_column_text(statement, column);
    size_t length = (size_t)sqlite3_column_bytes(statement, column);
    if (!from || length >= size || memchr(from, 0, length))
        return false;
    memcpy(text, from, length);
    text[length] = '\0';
    return true;
}
