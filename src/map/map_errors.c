/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Measured errors beside the map they belong to: the table `verification` of a finished
 * map's file. It says how far the component is from the detailed gearset at points that
 * the sweep did not use; the map itself and its content hash do not change.
 */
#include "map/gm_map_file.h"
#include "map/map_db.h"
#include "map/map_place.h"
#include "map/map_schema.h"

static const char create[] = "CREATE TABLE IF NOT EXISTS verification (\n"
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
    const double rpm = 9.54929658551372; /* per rad/s */
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
    (void)sqlite3_bind_double(put, 11, e->worst_speed * rpm);
    (void)sqlite3_bind_double(put, 12, e->worst_torque);
    return gm_db_step(db, put, error);
}

static gm_status put_all(const gm_db *db, long long seed, int n,
                         const gm_map_error *errors, gm_error *error)
{
    sqlite3_stmt *put = NULL;
    gm_status status = gm_db_run(db, create, error);
    if (status == GM_OK)
        status = gm_db_prepare(db,
                               "INSERT INTO verification VALUES "
                               "(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                               &put, error);
    for (int i = 0; i < n && status == GM_OK; i++)
        status = put_one(db, put, seed, &errors[i], error);
    (void)sqlite3_finalize(put);
    return status;
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

gm_status gm_map_put_errors(const char *path, long long seed, int n,
                            const gm_map_error *errors, gm_error *error)
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
        status = put_all(&db, seed, n, errors, error);
        gm_status end = gm_db_run(&db, status == GM_OK ? "COMMIT" : "ROLLBACK",
                                  status == GM_OK ? error : NULL);
        status = status == GM_OK ? end : status;
    }
    gm_db_close(&db);
    return status;
}
