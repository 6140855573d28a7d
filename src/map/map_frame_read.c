/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Nothing in the file is believed: ids must follow each other from 0, types, ranges and
 * counts must fit, and no size is allocated that the file is too small to hold.
 */
#include "base/alloc.h"
#include "map/map_frame.h"
#include "map/map_rules.h"

#include <math.h>
#include <string.h>

static gm_status wrong(const gm_db *db, const char *table, gm_error *error)
{
    return gm_fail(error, GM_ERR_FORMAT,
                   "%s is damaged: its table %s has a wrong or missing row", db->path,
                   table);
}

/* A gear as its row in the file. */
static bool column_gear(sqlite3_stmt *rows, int *path, gm_map_gear *gear)
{
    gear->ratio_given = (double)NAN;
    bool given = sqlite3_column_type(rows, 3) != SQLITE_NULL;
    return gm_column_int(rows, 0, 0, GM_MAX_PATHS - 1, path) &&
           gm_column_int(rows, 1, -1, GM_MAP_ANY - 1, &gear->number) &&
           gm_column_real(rows, 2, &gear->ratio) &&
           (!given || gm_column_real(rows, 3, &gear->ratio_given)) &&
           gm_column_real(rows, 4, &gear->stiffness) &&
           gm_column_real(rows, 5, &gear->damping) &&
           gm_column_real(rows, 6, &gear->loose_damping) &&
           gm_column_real(rows, 7, &gear->lash) && gm_column_real(rows, 8, &gear->film) &&
           gm_column_real(rows, 9, &gear->inertia_extra);
}

static gm_status read_gears(const gm_db *db, gm_map *map, gm_error *error)
{
    sqlite3_stmt *rows;
    bool row = true;
    int filled[GM_MAX_PATHS] = {0};
    gm_status status = gm_db_prepare(
        db,
        "SELECT path, gear, ratio, ratio_given, stiffness, damping, "
        "loose_damping, lash, film, inertia_extra FROM gear ORDER BY path, gear",
        &rows, error);
    if (status == GM_OK)
        status = gm_db_next(db, rows, &row, error);
    while (status == GM_OK && row) {
        int p;
        gm_map_gear gear;
        if (!column_gear(rows, &p, &gear) || filled[p] >= map->paths[p].n_gears) {
            status = wrong(db, "gear", error);
        } else {
            map->paths[p].gears[filled[p]++] = gear;
            status = gm_db_next(db, rows, &row, error);
        }
    }
    (void)sqlite3_finalize(rows);
    for (int p = 0; status == GM_OK && p < map->n_paths; p++)
        if (filled[p] != map->paths[p].n_gears)
            status = wrong(db, "gear", error);
    return status;
}

static gm_status read_path(const gm_db *db, sqlite3_stmt *rows, gm_map *map,
                           gm_error *error)
{
    int p, n_gears, next = map->n_paths;
    char name[sizeof map->paths[0].name];
    double inertia, sync_torque;
    if (next >= GM_MAX_PATHS || !gm_column_int(rows, 0, next, next, &p) ||
        !gm_column_text(rows, 1, sizeof name, name) || name[0] == '\0' ||
        !gm_column_real(rows, 2, &inertia) || !gm_column_real(rows, 3, &sync_torque) ||
        !gm_column_int(rows, 4, 0, GM_MAP_MAX_GEARS, &n_gears))
        return wrong(db, "path", error);
    gm_status status = gm_map_set_path(map, p, name, n_gears, error);
    map->paths[p].inertia = inertia;
    map->paths[p].sync_torque = sync_torque;
    return status;
}

gm_status gm_frame_read_oil(const gm_db *db, gm_map *map, gm_error *error)
{
    sqlite3_stmt *rows;
    bool row = true;
    int n = 0;
    double at[GM_MAP_MAX_OIL], bend[GM_MAP_MAX_OIL];
    gm_status status = gm_db_prepare(
        db, "SELECT oil, temperature, bend FROM oil ORDER BY oil", &rows, error);
    if (status == GM_OK)
        status = gm_db_next(db, rows, &row, error);
    while (status == GM_OK && row) {
        int k;
        if (n >= GM_MAP_MAX_OIL || !gm_column_int(rows, 0, n, n, &k) ||
            !gm_column_real(rows, 1, &at[n]) || !gm_column_real(rows, 2, &bend[n])) {
            status = wrong(db, "oil", error);
        } else {
            n++;
            status = gm_db_next(db, rows, &row, error);
        }
    }
    (void)sqlite3_finalize(rows);
    if (status == GM_OK && gm_map_set_oil(map, n, at, NULL) != GM_OK)
        status = wrong(db, "oil", error);
    if (status == GM_OK)
        memcpy(map->oil_bend, bend, (size_t)n * sizeof *bend);
    return status;
}

gm_status gm_frame_read_paths(const gm_db *db, gm_map *map, gm_error *error)
{
    sqlite3_stmt *rows;
    bool row = true;
    gm_status status = gm_db_prepare(
        db,
        "SELECT path, name, inertia, sync_torque, (SELECT count(*) FROM gear "
        "WHERE gear.path = path.path) FROM path ORDER BY path",
        &rows, error);
    if (status == GM_OK)
        status = gm_db_next(db, rows, &row, error);
    while (status == GM_OK && row) {
        status = read_path(db, rows, map, error);
        if (status == GM_OK)
            status = gm_db_next(db, rows, &row, error);
    }
    (void)sqlite3_finalize(rows);
    return status == GM_OK ? read_gears(db, map, error) : status;
}

typedef struct read_axis {
    char quantity[24];
    int n;
    double *x;
} read_axis;

typedef struct axis_list {
    const gm_db *db;
    long long budget; /* bytes of the file not yet accounted for */
    read_axis *axes;
    int n;
} axis_list;

static gm_status read_nodes(const axis_list *list, sqlite3_stmt *rows, int axis,
                            gm_error *error)
{
    read_axis *a = &list->axes[axis];
    gm_status status = GM_OK;
    (void)sqlite3_bind_int(rows, 1, axis);
    for (int i = 0; status == GM_OK && i <= a->n; i++) {
        bool row = false;
        int index;
        status = gm_db_next(list->db, rows, &row, error);
        if (status != GM_OK)
            break;
        if (row != (i < a->n) || (row && (!gm_column_int(rows, 0, i, i, &index) ||
                                          !gm_column_real(rows, 1, &a->x[i]))))
            status = wrong(list->db, "axis_value", error);
    }
    (void)sqlite3_reset(rows);
    return status;
}

static gm_status read_axis_row(axis_list *list, sqlite3_stmt *rows, sqlite3_stmt *nodes,
                               gm_error *error)
{
    int id, axis = list->n;
    read_axis made = {0};
    if (!gm_column_int(rows, 0, axis, axis, &id) ||
        !gm_column_text(rows, 1, sizeof made.quantity, made.quantity) ||
        !gm_column_int(rows, 2, 1, GM_MAP_MAX_NODES, &made.n) || made.n > list->budget)
        return wrong(list->db, "axis", error);
    list->budget -= made.n;
    read_axis *axes = gm_resize(list->axes, (size_t)axis + 1, sizeof *axes);
    if (axes)
        list->axes = axes;
    made.x = axes ? gm_calloc((size_t)made.n, sizeof *made.x) : NULL;
    if (!made.x)
        return gm_fail(error, GM_ERR_MEMORY, "no memory to read %s", list->db->path);
    axes[axis] = made;
    list->n = axis + 1;
    return read_nodes(list, nodes, axis, error);
}

static gm_status read_axes(axis_list *list, gm_error *error)
{
    sqlite3_stmt *rows, *nodes = NULL;
    bool row = true;
    gm_status status = gm_db_prepare(
        list->db, "SELECT axis, quantity, n FROM axis ORDER BY axis", &rows, error);
    if (status == GM_OK)
        status = gm_db_prepare(list->db,
                               "SELECT i, x FROM axis_value WHERE axis = ? ORDER BY i",
                               &nodes, error);
    if (status == GM_OK)
        status = gm_db_next(list->db, rows, &row, error);
    while (status == GM_OK && row) {
        status = read_axis_row(list, rows, nodes, error);
        if (status == GM_OK)
            status = gm_db_next(list->db, rows, &row, error);
    }
    (void)sqlite3_finalize(rows);
    (void)sqlite3_finalize(nodes);
    return status;
}

static bool column_or_any(sqlite3_stmt *rows, int column, int low, int *number)
{
    *number = GM_MAP_ANY;
    return sqlite3_column_type(rows, column) == SQLITE_NULL ||
           gm_column_int(rows, column, low, GM_MAP_ANY - 1, number);
}

static bool column_direction(sqlite3_stmt *rows, int column, int *direction)
{
    char name[16];
    *direction = GM_MAP_ANY;
    if (sqlite3_column_type(rows, column) == SQLITE_NULL)
        return true;
    if (!gm_column_text(rows, column, sizeof name, name))
        return false;
    *direction = strcmp(name, "forward") == 0    ? GM_FORWARD
                 : strcmp(name, "backward") == 0 ? GM_BACKWARD
                                                 : GM_MAP_ANY;
    return *direction != GM_MAP_ANY;
}

static bool column_line(sqlite3_stmt *rows, int column, double *line)
{
    *line = 0.0;
    return sqlite3_column_type(rows, column) == SQLITE_NULL ||
           (gm_column_real(rows, column, line) && *line != 0.0);
}

static bool column_key(sqlite3_stmt *rows, gm_table_key *key)
{
    char symbol[24];
    if (!gm_column_text(rows, 1, sizeof symbol, symbol))
        return false;
    key->symbol = gm_symbol_named(symbol);
    return key->symbol != GM_SYMBOLS && column_or_any(rows, 2, 0, &key->path) &&
           column_or_any(rows, 3, -1, &key->gear[0]) &&
           column_or_any(rows, 4, -1, &key->gear[1]) &&
           column_direction(rows, 5, &key->direction[0]) &&
           column_direction(rows, 6, &key->direction[1]) &&
           column_line(rows, 7, &key->line);
}

/* The axes a row of map_table names: number, nodes and whether they may be. */
static bool column_axes(const axis_list *list, sqlite3_stmt *rows, int slices,
                        const gm_symbol_rule *rule, int n[GM_MAX_AXES],
                        const double *x[GM_MAX_AXES])
{
    long long size = slices;
    for (int a = 0; a < GM_MAX_AXES; a++) {
        int axis;
        if (a >= rule->n_axes) {
            if (sqlite3_column_type(rows, 8 + a) != SQLITE_NULL)
                return false;
            continue;
        }
        if (!gm_column_int(rows, 8 + a, 0, list->n - 1, &axis) ||
            strcmp(list->axes[axis].quantity, rule->axis[a].quantity) != 0)
            return false;
        n[a] = list->axes[axis].n;
        x[a] = list->axes[axis].x;
        size *= n[a];
        if (size > list->budget)
            return false;
    }
    return true;
}

static gm_status read_table(axis_list *list, sqlite3_stmt *rows, gm_map *map,
                            gm_error *error)
{
    int id, n[GM_MAX_AXES], index, next = map->n_tables;
    const double *x[GM_MAX_AXES];
    gm_table_key key;
    gm_error detail = {0};
    if (!gm_column_int(rows, 0, next, next, &id) || !column_key(rows, &key) ||
        !column_axes(list, rows, gm_map_slices(map), gm_symbol_rule_of(key.symbol), n, x))
        return wrong(list->db, "map_table", error);
    gm_status status = gm_map_add_table(map, &key, gm_symbol_rule_of(key.symbol)->n_axes,
                                        n, x, &index, &detail);
    if (status == GM_OK)
        list->budget -= gm_map_value_count(&map->tables[index]);
    else if (status == GM_ERR_MEMORY)
        status = gm_fail(error, status, "no memory to read %s", list->db->path);
    else
        status = gm_db_damaged(list->db, detail.message, error);
    return status;
}

gm_status gm_frame_read_tables(const gm_db *db, long long file_size, gm_map *map,
                               gm_error *error)
{
    axis_list list = {.db = db, .budget = file_size};
    sqlite3_stmt *rows = NULL;
    bool row = true;
    gm_status status = read_axes(&list, error);
    if (status == GM_OK)
        status = gm_db_prepare(db,
                               "SELECT id, symbol, path, gear_0, gear_1, direction_0, "
                               "direction_1, line_ratio, axis_0, axis_1, axis_2 "
                               "FROM map_table "
                               "ORDER BY id",
                               &rows, error);
    if (status == GM_OK)
        status = gm_db_next(db, rows, &row, error);
    while (status == GM_OK && row) {
        status = read_table(&list, rows, map, error);
        if (status == GM_OK)
            status = gm_db_next(db, rows, &row, error);
    }
    (void)sqlite3_finalize(rows);
    for (int a = 0; a < list.n; a++)
        gm_free(list.axes[a].x);
    gm_free(list.axes);
    return status;
}
