/* SPDX-License-Identifier: BSD-2-Clause */
#include "base/alloc.h"
#include "map/map_frame.h"
#include "map/map_rules.h"

#include <string.h>

static void bind_or_null(sqlite3_stmt *put, int parameter, int number)
{
    if (number == GM_MAP_ANY)
        (void)sqlite3_bind_null(put, parameter);
    else
        (void)sqlite3_bind_int(put, parameter, number);
}

static gm_status write_path(const gm_db *db, sqlite3_stmt *put, const gm_map *map, int p,
                            gm_error *error)
{
    const gm_map_path *path = &map->paths[p];
    (void)sqlite3_bind_int(put, 1, p);
    (void)sqlite3_bind_text(put, 2, path->name, -1, SQLITE_STATIC);
    (void)sqlite3_bind_double(put, 3, path->inertia);
    (void)sqlite3_bind_double(put, 4, path->sync_torque);
    return gm_db_step(db, put, error);
}

static gm_status write_gear(const gm_db *db, sqlite3_stmt *put, int p,
                            const gm_map_gear *gear, gm_error *error)
{
    (void)sqlite3_bind_int(put, 1, p);
    (void)sqlite3_bind_int(put, 2, gear->number);
    (void)sqlite3_bind_double(put, 3, gear->ratio);
    (void)sqlite3_bind_double(put, 4, gear->ratio_given); /* NAN becomes NULL */
    (void)sqlite3_bind_double(put, 5, gear->stiffness);
    (void)sqlite3_bind_double(put, 6, gear->damping);
    (void)sqlite3_bind_double(put, 7, gear->loose_damping);
    (void)sqlite3_bind_double(put, 8, gear->lash);
    (void)sqlite3_bind_double(put, 9, gear->film);
    (void)sqlite3_bind_double(put, 10, gear->inertia_extra);
    return gm_db_step(db, put, error);
}

gm_status gm_frame_write_oil(const gm_db *db, const gm_map *map, gm_error *error)
{
    sqlite3_stmt *put = NULL;
    if (map->n_oil == 0)
        return GM_OK;
    gm_status status = gm_db_prepare(db, "INSERT INTO oil VALUES (?, ?, ?)", &put, error);
    for (int k = 0; status == GM_OK && k < map->n_oil; k++) {
        (void)sqlite3_bind_int(put, 1, k);
        (void)sqlite3_bind_double(put, 2, map->oil[k]);
        (void)sqlite3_bind_double(put, 3, map->oil_bend[k]);
        status = gm_db_step(db, put, error);
    }
    (void)sqlite3_finalize(put);
    return status;
}

gm_status gm_frame_write_paths(const gm_db *db, const gm_map *map, gm_error *error)
{
    sqlite3_stmt *put_path = NULL, *put_gear = NULL;
    gm_status status = gm_db_run(db, "DELETE FROM gear; DELETE FROM path", error);
    if (status == GM_OK)
        status =
            gm_db_prepare(db, "INSERT INTO path VALUES (?, ?, ?, ?)", &put_path, error);
    if (status == GM_OK)
        status =
            gm_db_prepare(db, "INSERT INTO gear VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                          &put_gear, error);
    for (int p = 0; status == GM_OK && p < map->n_paths; p++) {
        status = write_path(db, put_path, map, p, error);
        for (int g = 0; status == GM_OK && g < map->paths[p].n_gears; g++)
            status = write_gear(db, put_gear, p, &map->paths[p].gears[g], error);
    }
    (void)sqlite3_finalize(put_path);
    (void)sqlite3_finalize(put_gear);
    return status;
}

/* An axis that has been written; x is the first table's. */
typedef struct written_axis {
    const char *quantity;
    int n;
    const double *x;
} written_axis;

typedef struct axis_writer {
    const gm_db *db;
    sqlite3_stmt *put_axis, *put_node, *put_table;
    written_axis *axes;
    int n;
} axis_writer;

static gm_status write_axis(axis_writer *w, const gm_axis_rule *rule, int n,
                            const double *x, int *axis, gm_error *error)
{
    for (*axis = 0; *axis < w->n; ++*axis) {
        const written_axis *old = &w->axes[*axis];
        if (old->n == n && strcmp(old->quantity, rule->quantity) == 0 &&
            memcmp(old->x, x, (size_t)n * sizeof *x) == 0)
            return GM_OK;
    }
    w->axes[w->n++] = (written_axis){rule->quantity, n, x};
    (void)sqlite3_bind_int(w->put_axis, 1, *axis);
    (void)sqlite3_bind_text(w->put_axis, 2, rule->quantity, -1, SQLITE_STATIC);
    (void)sqlite3_bind_text(w->put_axis, 3, rule->unit, -1, SQLITE_STATIC);
    (void)sqlite3_bind_int(w->put_axis, 4, n);
    gm_status status = gm_db_step(w->db, w->put_axis, error);
    for (int i = 0; status == GM_OK && i < n; i++) {
        (void)sqlite3_bind_int(w->put_node, 1, *axis);
        (void)sqlite3_bind_int(w->put_node, 2, i);
        (void)sqlite3_bind_double(w->put_node, 3, x[i]);
        status = gm_db_step(w->db, w->put_node, error);
    }
    return status;
}

static void bind_direction(sqlite3_stmt *put, int parameter, int direction)
{
    static const char *const names[] = {"forward", "backward"};
    if (direction == GM_MAP_ANY)
        (void)sqlite3_bind_null(put, parameter);
    else
        (void)sqlite3_bind_text(put, parameter, names[direction], -1, SQLITE_STATIC);
}

static gm_status write_table(axis_writer *w, const gm_map *map, int t, gm_error *error)
{
    const gm_map_table *table = &map->tables[t];
    const gm_symbol_rule *rule = gm_symbol_rule_of(table->key.symbol);
    gm_status status = GM_OK;
    (void)sqlite3_clear_bindings(w->put_table);
    for (int a = 0; status == GM_OK && a < table->n_axes; a++) {
        int axis = 0;
        status = write_axis(w, &rule->axis[a], table->n[a], table->x[a], &axis, error);
        (void)sqlite3_bind_int(w->put_table, 9 + a, axis);
    }
    if (status != GM_OK)
        return status;
    (void)sqlite3_bind_int(w->put_table, 1, t);
    (void)sqlite3_bind_text(w->put_table, 2, rule->name, -1, SQLITE_STATIC);
    bind_or_null(w->put_table, 3, table->key.path);
    bind_or_null(w->put_table, 4, table->key.gear[0]);
    bind_or_null(w->put_table, 5, table->key.gear[1]);
    bind_direction(w->put_table, 6, table->key.direction[0]);
    bind_direction(w->put_table, 7, table->key.direction[1]);
    if (table->key.line != 0.0)
        (void)sqlite3_bind_double(w->put_table, 8, table->key.line);
    return gm_db_step(w->db, w->put_table, error);
}

static gm_status prepare(axis_writer *w, const gm_map *map, gm_error *error)
{
    w->axes = gm_calloc((size_t)map->n_tables * GM_MAX_AXES, sizeof *w->axes);
    if (!w->axes)
        return gm_fail(error, GM_ERR_MEMORY, "no memory to write the axes");
    gm_status status =
        gm_db_prepare(w->db, "INSERT INTO axis VALUES (?, ?, ?, ?)", &w->put_axis, error);
    if (status == GM_OK)
        status = gm_db_prepare(w->db, "INSERT INTO axis_value VALUES (?, ?, ?)",
                               &w->put_node, error);
    if (status == GM_OK)
        status = gm_db_prepare(w->db,
                               "INSERT INTO map_table VALUES "
                               "(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, 'N.m')",
                               &w->put_table, error);
    return status;
}

gm_status gm_frame_write_tables(const gm_db *db, const gm_map *map, gm_error *error)
{
    axis_writer w = {.db = db};
    gm_status status = prepare(&w, map, error);
    for (int t = 0; status == GM_OK && t < map->n_tables; t++)
        status = write_table(&w, map, t, error);
    (void)sqlite3_finalize(w.put_axis);
    (void)sqlite3_finalize(w.put_node);
    (void)sqlite3_finalize(w.put_table);
    gm_free(w.axes);
    return status;
}
