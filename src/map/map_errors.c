/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What was measured, beside the map it belongs to: the tables `verification` and
 * `verification_point` of a finished map's file say how far the component is from the
 * detailed gearset at points that the sweep did not use, the table `result` keeps the
 * whole results, of which a passport is made. The map itself and its content hash do not
 * change.
 */
#include "base/alloc.h"
#include "map/gm_map_file.h"
#include "map/map_amend.h"
#include "map/map_db.h"
#include "map/map_place.h"
#include "map/map_schema.h"

#include <limits.h>
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
                             "CREATE TABLE IF NOT EXISTS verification_point (\n"
                             "  verification INTEGER NOT NULL,\n"
                             "  speed_rpm REAL NOT NULL,\n"
                             "  torque_Nm REAL NOT NULL,\n"
                             "  detailed_Nm REAL NOT NULL,\n"
                             "  reduced_Nm REAL NOT NULL\n"
                             ");\n"
                             "DELETE FROM verification; DELETE FROM verification_point";

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

/* Points go with the row of their case. */
static gm_status put_points(const gm_db *db, sqlite3_stmt *put, const gm_map_error *e,
                            gm_error *error)
{
    const sqlite3_int64 row = sqlite3_last_insert_rowid(db->handle);
    gm_status status = GM_OK;
    for (int i = 0; i < e->n_points && status == GM_OK; i++) {
        const gm_map_error_point *point = &e->point[i];
        (void)sqlite3_bind_int64(put, 1, row);
        (void)sqlite3_bind_double(put, 2, point->speed * RPM);
        (void)sqlite3_bind_double(put, 3, point->torque);
        (void)sqlite3_bind_double(put, 4, point->detailed);
        (void)sqlite3_bind_double(put, 5, point->reduced);
        status = gm_db_step(db, put, error);
    }
    return status;
}

static gm_status put_errors(const gm_db *db, const gm_map_verification *v,
                            gm_error *error)
{
    sqlite3_stmt *put = NULL, *put_point = NULL;
    gm_status status = gm_db_prepare(db,
                                     "INSERT INTO verification VALUES "
                                     "(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                                     &put, error);
    if (status == GM_OK)
        status =
            gm_db_prepare(db, "INSERT INTO verification_point VALUES (?, ?, ?, ?, ?)",
                          &put_point, error);
    for (int i = 0; i < v->n_errors && status == GM_OK; i++) {
        status = put_one(db, put, v->seed, &v->errors[i], error);
        if (status == GM_OK)
            status = put_points(db, put_point, &v->errors[i], error);
    }
    (void)sqlite3_finalize(put);
    (void)sqlite3_finalize(put_point);
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

static gm_status put_all(const gm_db *db, const void *what, gm_error *error)
{
    const gm_map_verification *v = what;
    gm_status status = gm_db_run(db, create, error);
    if (status == GM_OK)
        status = put_errors(db, v, error);
    return status == GM_OK ? put_results(db, v, error) : status;
}

gm_status gm_map_put_verification(const char *path,
                                  const gm_map_verification *verification,
                                  gm_error *error)
{
    return gm_amend(path, put_all, verification, error);
}

/* ---- and back ---- */

static gm_status read_one(const gm_db *db, sqlite3_stmt *rows, gm_map_error *e,
                          gm_error *error)
{
    char kind[64], path[64], direction[16];
    bool one_path = sqlite3_column_type(rows, 3) == SQLITE_NULL;
    if (!gm_column_text(rows, 0, sizeof kind, kind) ||
        !gm_column_text(rows, 1, sizeof path, path) ||
        !gm_column_int(rows, 2, -GM_MAP_ANY, GM_MAP_ANY, &e->gear[0]) ||
        (!one_path && !gm_column_int(rows, 3, -GM_MAP_ANY, GM_MAP_ANY, &e->gear[1])) ||
        !gm_column_text(rows, 4, sizeof direction, direction) ||
        !gm_column_int(rows, 5, 0, INT_MAX, &e->points) ||
        !gm_column_real(rows, 6, &e->largest) || !gm_column_real(rows, 7, &e->max) ||
        !gm_column_real(rows, 8, &e->rms) || !gm_column_real(rows, 9, &e->worst_speed) ||
        !gm_column_real(rows, 10, &e->worst_torque))
        return gm_db_damaged(db, "a measured error is wrong", error);
    e->gear[1] = one_path ? GM_MAP_ANY : e->gear[1];
    e->direction = strcmp(direction, "backward") == 0 ? -1 : 1;
    e->worst_speed /= RPM;
    e->kind = gm_strdup(kind);
    e->path = gm_strdup(path);
    return e->kind && e->path
               ? GM_OK
               : gm_fail(error, GM_ERR_MEMORY, "no memory for the measured errors");
}

static gm_status read_all(const gm_db *db, int n, gm_map_error *errors, gm_error *error)
{
    sqlite3_stmt *rows = NULL;
    gm_status status = gm_db_prepare(
        db,
        "SELECT kind, path, gear_0, gear_1, direction, points, largest_Nm, max_Nm, "
        "rms_Nm, worst_speed_rpm, worst_torque_Nm FROM verification ORDER BY rowid",
        &rows, error);
    for (int i = 0; status == GM_OK && i < n; i++) {
        bool row = false;
        status = gm_db_next(db, rows, &row, error);
        if (status == GM_OK)
            status = read_one(db, rows, &errors[i], error);
    }
    (void)sqlite3_finalize(rows);
    return status;
}

static gm_status read_table(const gm_db *db, int *n, gm_map_error **errors,
                            gm_error *error)
{
    sqlite3_int64 tables = 0, count = 0;
    gm_status status = gm_db_integer(
        db, "SELECT count(*) FROM sqlite_master WHERE name = 'verification'", &tables,
        error);
    if (status == GM_OK && tables > 0)
        status = gm_db_integer(db, "SELECT count(*) FROM verification", &count, error);
    if (status != GM_OK || count == 0)
        return status;
    if (count > GM_MAP_MAX_TABLES)
        return gm_db_damaged(db, "it has too many measured errors", error);
    gm_map_error *made = gm_calloc((size_t)count, sizeof *made);
    if (!made)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for the measured errors");
    status = read_all(db, (int)count, made, error);
    if (status != GM_OK) {
        gm_map_errors_free((int)count, made);
        return status;
    }
    *n = (int)count;
    *errors = made;
    return GM_OK;
}

gm_status gm_map_get_errors(const char *path, int *n, gm_map_error **errors,
                            gm_error *error)
{
    gm_db db = {0};
    gm_map_error *made = NULL;
    int count = 0;
    if (!gm_place_exists(path))
        return gm_fail(error, GM_ERR_IO, "%s: there is no such file", path);
    gm_status status = gm_db_open_constant(path, &db, error);
    if (status == GM_OK)
        status = gm_schema_is_map(&db, error);
    if (status == GM_OK)
        status = read_table(&db, &count, &made, error);
    gm_db_close(&db);
    if (status == GM_OK) {
        *n = count;
        *errors = made;
    }
    return status;
}

void gm_map_errors_free(int n, gm_map_error *errors)
{
    for (int i = 0; i < n; i++) {
        gm_free((void *)errors[i].kind);
        gm_free((void *)errors[i].path);
    }
    gm_free(errors);
}
