/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What was measured, beside the map it belongs to: the table `verification` of a finished
 * map's file says how far the component is from the detailed gearset at points that the
 * sweep did not use, the table `result` keeps the whole results, of which a passport is
 * made. The map itself and its content hash do not change.
 */
#include "base/alloc.h"
#include "map/gm_map_file.h"
#include "map/map_db.h"
#include "map/map_place.h"
#include "map/map_schema.h"

#include <string.h>

#define RPM 9.54929658551372 /* per rad/s */

static const char create[] = "CREATE TABLE IF NOT EXISTS result (json TEXT NOT NULL);\n"
                             "DELETE FROM result;\n"
                             "CREATE TABLE IF NOT EXISTS verification (\n"
                             "  kind TEXT NOT NULL,\n"
                             "  path TEXT NOT NULL,\n"
                             "  gear_0 INTEGER NOT NULL,\n"
                             "  gear_1 INTEGER,\n"
                             "  direction TEXT NOT NULL,\n"
                             "  points INTEGER NOT NULL,\n"
                             "  seed INTEGER NOT NULL,\n"
                             "  largest_Nm REAL NOT NULL,\n"
                             "  max_Nm REAL NOT NULL,\n"
                             "  rms_Nm REAL NOT NULL,\n"
                             "  worst_speed_rpm REAL NOT NULL,\n"
                             "  worst_torque_Nm REAL NOT NULL\n"
                             ");\n"
                             "DELETE FROM verification";

static gm_status put_one(const gm_db *db, sqlite3_stmt *put, long long seed,
                         const gm_map_error *e, gm_error *error)
{
    (void)sqlite3_clear_bindings(put);
    (void)sqlite3_bind_text(put, 1, e->kind, -1, SQLITE_STATIC);
    (void)sqlite3_bind_text(put, 2, e->path, -1, SQLITE_STATIC);
    (void)sqlite3_bind_int(put, 3, e->gear[0]);
    if (e->gear[1] != GM_MAP_ANY)
        (void)sqlite3_bind_int(put, 4, e->gear[1]);
    (void)sqlite3_bind_text(put, 5, e->direction < 0 ? "backward" : "forward", -1,
                            SQLITE_STATIC);
    (void)sqlite3_bind_int(put, 6, e->points);
    (void)sqlite3_bind_int64(put, 7, seed);
    (void)sqlite3_bind_double(put, 8, e->largest);
    (void)sqlite3_bind_double(put, 9, e->max);
    (void)sqlite3_bind_double(put, 10, e->rms);
    (void)sqlite3_bind_double(put, 11, e->worst_speed * RPM);
    (void)sqlite3_bind_double(put, 12, e->worst_torque);
    return gm_db_step(db, put, error);
}

static gm_status put_errors(const gm_db *db, const gm_map_verification *v,
                            gm_error *error)
{
    sqlite3_stmt *put = NULL;
    gm_status status = gm_db_prepare(db,
                                     "INSERT INTO verification VALUES "
                                     "(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                                     &put, error);
    for (int i = 0; i < v->n_errors && status == GM_OK; i++)
        status = put_one(db, put, v->seed, &v->errors[i], error);
    (void)sqlite3_finalize(put);
    return status;
}

static gm_status put_results(const gm_db *db, const gm_map_verification *v,
                             gm_error *error)
{
    sqlite3_stmt *put = NULL;
    gm_status status = gm_db_prepare(db, "INSERT INTO result VALUES (?)", &put, error);
    for (int i = 0; i < v->n_results && status == GM_OK; i++) {
        (void)sqlite3_bind_text(put, 1, v->results[i], -1, SQLITE_STATIC);
        status = gm_db_step(db, put, error);
    }
    (void)sqlite3_finalize(put);
    return status;
}

static gm_status put_all(const gm_db *db, const gm_map_verification *v, gm_error *error)
{
    gm_status status = gm_db_run(db, create, error);
    if (status == GM_OK)
        status = put_errors(db, v, error);
    return status == GM_OK ? put_results(db, v, error) : status;
}

static gm_status check_is_map(const gm_db *db, gm_error *error)
{
    sqlite3_int64 application = 0;
    gm_status status = gm_db_integer(db, "PRAGMA application_id", &application, error);
    if (status == GM_OK && application != GM_MAP_APPLICATION)
        status =
            gm_fail(error, GM_ERR_FORMAT,
                    "%s is not a map: it is an SQLite file of another kind", db->path);
    return status;
}

gm_status gm_map_put_verification(const char *path,
                                  const gm_map_verification *verification,
                                  gm_error *error)
{
    gm_db db = {0};
    if (!gm_place_exists(path))
        return gm_fail(error, GM_ERR_IO, "%s: there is no such file", path);
    gm_status status = gm_db_open(path, &db, error);
    if (status == GM_OK)
        status = check_is_map(&db, error);
    if (status == GM_OK)
        status = gm_db_run(&db, "BEGIN IMMEDIATE", error);
    if (status == GM_OK) {
        status = put_all(&db, verification, error);
        gm_status end = gm_db_run(&db, status == GM_OK ? "COMMIT" : "ROLLBACK",
                                  status == GM_OK ? error : NULL);
        status = status == GM_OK ? end : status;
    }
    gm_db_close(&db);
    return status;
}

/* ---- and back ---- */

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
        status = check_is_map(&db, error);
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
