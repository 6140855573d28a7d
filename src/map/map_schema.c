/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Tables hold SI units and strict types; the v_ views show the same in rpm, N.m and
 * degrees Celsius. 9.54929658551372 is 30/pi. Efficiency is derived from the loss:
 * driving 1 - D/|tau|, driven |tau|/(|tau| + D), none at zero torque.
 */
#include "map/map_schema.h"

#include "map/gm_map.h"

#include <stdio.h>
#include <string.h>

typedef struct schema_table {
    const char *name, *sql;
} schema_table;

#define IS_REAL(x) "CHECK (typeof(" x ") = 'real')"
#define IS_INDEX(x) "CHECK (typeof(" x ") = 'integer' AND " x " >= 0)"
#define IS_DIRECTION(x) "CHECK (" x " IN ('forward', 'backward'))"

// clang-format off
static const schema_table tables[] = {
    {"meta", "CREATE TABLE meta (\n"
             "  key TEXT NOT NULL PRIMARY KEY,\n"
             "  value NOT NULL CHECK (typeof(value) IN ('text', 'real')),\n"
             "  unit TEXT\n"
             ") WITHOUT ROWID"},
    {"path", "CREATE TABLE path (\n"
             "  path INTEGER PRIMARY KEY CHECK (path IN (0, 1)),\n"
             "  name TEXT NOT NULL UNIQUE,\n"
             "  inertia REAL NOT NULL CHECK (typeof(inertia) = 'real' AND inertia > 0),\n"
             "  sync_torque REAL NOT NULL\n"
             "    CHECK (typeof(sync_torque) = 'real' AND sync_torque > 0)\n"
             ")"},
    {"gear", "CREATE TABLE gear (\n"
             "  path INTEGER NOT NULL REFERENCES path,\n"
             "  gear INTEGER NOT NULL CHECK (typeof(gear) = 'integer' AND gear <> 0),\n"
             "  ratio REAL NOT NULL CHECK (typeof(ratio) = 'real' AND ratio <> 0),\n"
             "  ratio_given REAL CHECK (typeof(ratio_given) IN ('real', 'null')),\n"
             "  stiffness REAL NOT NULL " IS_REAL("stiffness") ",\n"
             "  damping REAL NOT NULL " IS_REAL("damping") ",\n"
             "  loose_damping REAL NOT NULL " IS_REAL("loose_damping") ",\n"
             "  lash REAL NOT NULL " IS_REAL("lash") ",\n"
             "  film REAL NOT NULL " IS_REAL("film") ",\n"
             "  inertia_extra REAL NOT NULL " IS_REAL("inertia_extra") ",\n"
             "  PRIMARY KEY (path, gear)\n"
             ") WITHOUT ROWID"},
    {"axis", "CREATE TABLE axis (\n"
             "  axis INTEGER PRIMARY KEY,\n"
             "  quantity TEXT NOT NULL CHECK (quantity IN ('path_speed',\n"
             "    'output_speed', 'relative_speed', 'torque', 'torque_0', 'torque_1')),\n"
             "  unit TEXT NOT NULL CHECK (unit IN ('rad/s', 'N.m')),\n"
             "  n INTEGER NOT NULL CHECK (typeof(n) = 'integer' AND n > 0)\n"
             ")"},
    {"axis_value", "CREATE TABLE axis_value (\n"
             "  axis INTEGER NOT NULL REFERENCES axis,\n"
             "  i INTEGER NOT NULL " IS_INDEX("i") ",\n"
             "  x REAL NOT NULL " IS_REAL("x") ",\n"
             "  PRIMARY KEY (axis, i)\n"
             ") WITHOUT ROWID"},
    {"map_table", "CREATE TABLE map_table (\n"
             "  id INTEGER PRIMARY KEY,\n"
             "  symbol TEXT NOT NULL CHECK (symbol IN ('parasitic_loss', 'load_loss',\n"
             "    'both_loaded', 'drag', 'reaction', 'line_jump', 'coupling')),\n"
             "  path INTEGER REFERENCES path,\n"
             "  gear_0 INTEGER,\n"
             "  gear_1 INTEGER,\n"
             "  direction_0 TEXT " IS_DIRECTION("direction_0") ",\n"
             "  direction_1 TEXT " IS_DIRECTION("direction_1") ",\n"
             "  line_ratio REAL CHECK (typeof(line_ratio) IN ('real', 'null')),\n"
             "  axis_0 INTEGER NOT NULL REFERENCES axis,\n"
             "  axis_1 INTEGER REFERENCES axis,\n"
             "  axis_2 INTEGER REFERENCES axis,\n"
             "  unit TEXT NOT NULL CHECK (unit = 'N.m')\n"
             ")"},
};

/* Values of format 3; and those of format 4, with the temperatures of their slices. */
static const schema_table one_oil[] = {
    {"value", "CREATE TABLE value (\n"
             "  map_table INTEGER NOT NULL REFERENCES map_table,\n"
             "  i INTEGER NOT NULL " IS_INDEX("i") ",\n"
             "  j INTEGER NOT NULL " IS_INDEX("j") ",\n"
             "  k INTEGER NOT NULL " IS_INDEX("k") ",\n"
             "  value REAL NOT NULL " IS_REAL("value") ",\n"
             "  PRIMARY KEY (map_table, i, j, k)\n"
             ") WITHOUT ROWID"},
};

static const schema_table oil_axis[] = {
    {"oil", "CREATE TABLE oil (\n"
             "  oil INTEGER PRIMARY KEY,\n"
             "  temperature REAL NOT NULL CHECK (typeof(temperature) = 'real'\n"
             "    AND temperature > 0),\n"
             "  bend REAL NOT NULL CHECK (typeof(bend) = 'real' AND bend > -1)\n"
             ")"},
    {"value", "CREATE TABLE value (\n"
             "  map_table INTEGER NOT NULL REFERENCES map_table,\n"
             "  oil INTEGER NOT NULL REFERENCES oil,\n"
             "  i INTEGER NOT NULL " IS_INDEX("i") ",\n"
             "  j INTEGER NOT NULL " IS_INDEX("j") ",\n"
             "  k INTEGER NOT NULL " IS_INDEX("k") ",\n"
             "  value REAL NOT NULL " IS_REAL("value") ",\n"
             "  PRIMARY KEY (map_table, oil, i, j, k)\n"
             ") WITHOUT ROWID"},
};

#define RPM(x) x ".x * 9.54929658551372"
#define VALUES "FROM map_table t JOIN v_value v ON v.map_table = t.id"
#define AXIS(a, axis, index) \
    " JOIN axis_value " a " ON " a ".axis = t." axis " AND " a ".i = v." index
#define PATH " JOIN path p ON p.path = t.path"
#define GEAR "CASE t.path WHEN 0 THEN t.gear_0 ELSE t.gear_1 END AS gear"
#define SYMBOL(s) " WHERE t.symbol = '" s "'"
#define META(key) "(SELECT value FROM meta WHERE key = '" key "')"
#define OIL "v.oil_degC"
#define DRAG_VIEW(view, symbol, column) \
    "CREATE VIEW " view " AS SELECT p.name AS path,\n" \
    "  t.direction_0 AS path_direction, t.direction_1 AS output_direction,\n" \
    "  " RPM("a") " AS path_speed_rpm, " RPM("b") " AS output_speed_rpm,\n" \
    "  v.value AS " column ", " OIL "\n" \
    VALUES PATH AXIS("a", "axis_0", "i") AXIS("b", "axis_1", "j") SYMBOL(symbol)

static const char one_oil_values[] =
    "CREATE VIEW v_value AS SELECT map_table, i, j, k, value,\n"
    "  " META("oil_temperature") " - 273.15 AS oil_degC FROM value";
static const char oil_axis_values[] =
    "CREATE VIEW v_value AS SELECT v.map_table, v.i, v.j, v.k, v.value,\n"
    "  o.temperature - 273.15 AS oil_degC FROM value v JOIN oil o ON o.oil = v.oil";

static const char *const views[] = {
    "CREATE VIEW v_map AS SELECT " META("name") " AS name, " META("title") " AS title,\n"
    "  " META("speed_max") " * 9.54929658551372 AS speed_max_rpm,\n"
    "  " META("torque_max") " AS torque_max_Nm,\n"
    "  " META("oil_temperature") " - 273.15 AS oil_degC,\n"
    "  " META("inertia_output") " AS inertia_output_kgm2,\n"
    "  " META("options") " AS options, " META("input_sha256") " AS input_sha256,\n"
    "  " META("tool_version") " AS tool_version,\n"
    "  " META("content_hash") " AS content_hash",

    "CREATE VIEW v_gear AS SELECT p.name AS path, g.gear, g.ratio, g.ratio_given,\n"
    "  g.ratio / g.ratio_given - 1 AS relative_deviation,\n"
    "  g.stiffness AS stiffness_Nm_rad, g.damping AS damping_Nms_rad,\n"
    "  g.loose_damping AS loose_damping_Nms_rad,\n"
    "  g.lash * 57.2957795130823 AS lash_deg, g.film * 57.2957795130823 AS film_deg,\n"
    "  p.inertia AS path_inertia_kgm2, g.inertia_extra AS inertia_extra_kgm2,\n"
    "  p.sync_torque AS sync_torque_Nm\n"
    "FROM gear g JOIN path p ON p.path = g.path",

    "CREATE VIEW v_configuration AS SELECT t.gear_0, t.gear_1,\n"
    "  " META("inertia_output") "\n"
    "  + COALESCE((SELECT g.ratio * g.ratio * p.inertia + g.inertia_extra\n"
    "      FROM gear g JOIN path p\n"
    "      ON p.path = g.path WHERE g.path = 0 AND g.gear = t.gear_0), 0)\n"
    "  + COALESCE((SELECT g.ratio * g.ratio * p.inertia + g.inertia_extra\n"
    "      FROM gear g JOIN path p\n"
    "      ON p.path = g.path WHERE g.path = 1 AND g.gear = t.gear_1), 0)\n"
    "  AS inertia_at_output_kgm2\n"
    "FROM map_table t WHERE t.symbol = 'parasitic_loss' AND t.direction_0 = 'forward'",

    "CREATE VIEW v_parasitic_loss AS SELECT t.gear_0, t.gear_1,\n"
    "  t.direction_0 AS output_direction, " RPM("a") " AS output_speed_rpm,\n"
    "  v.value AS loss_torque_Nm, " OIL "\n"
    VALUES AXIS("a", "axis_0", "i") SYMBOL("parasitic_loss"),

    "CREATE VIEW v_load_loss AS SELECT p.name AS path, " GEAR ",\n"
    "  t.direction_0 AS path_direction, " RPM("a") " AS speed_rpm, b.x AS torque_Nm,\n"
    "  v.value AS loss_torque_Nm,\n"
    "  CASE WHEN b.x > 0 THEN 'driving' WHEN b.x < 0 THEN 'driven' END AS power_flow,\n"
    "  CASE WHEN b.x > 0 THEN 1 - v.value / b.x\n"
    "       WHEN b.x < 0 THEN b.x / (b.x - v.value) END AS efficiency, " OIL "\n"
    VALUES PATH AXIS("a", "axis_0", "i") AXIS("b", "axis_1", "j") SYMBOL("load_loss"),

    "CREATE VIEW v_both_loaded AS SELECT t.gear_0, t.gear_1,\n"
    "  t.direction_0 AS output_direction, " RPM("a") " AS output_speed_rpm,\n"
    "  b.x AS torque_0_Nm, c.x AS torque_1_Nm, v.value AS correction_torque_Nm, " OIL "\n"
    VALUES AXIS("a", "axis_0", "i") AXIS("b", "axis_1", "j") AXIS("c", "axis_2", "k")
    SYMBOL("both_loaded"),

    DRAG_VIEW("v_drag", "drag", "drag_torque_Nm"),
    DRAG_VIEW("v_reaction", "reaction", "reaction_torque_Nm"),

    "CREATE VIEW v_line_jump AS SELECT p.name AS path, t.line_ratio,\n"
    "  t.direction_0 AS output_direction, " RPM("a") " AS output_speed_rpm,\n"
    "  v.value AS jump_torque_Nm, " OIL "\n"
    VALUES PATH AXIS("a", "axis_0", "i") SYMBOL("line_jump"),

    "CREATE VIEW v_coupling AS SELECT " RPM("a") " AS relative_speed_rpm,\n"
    "  v.value AS coupling_torque_Nm, " OIL "\n"
    VALUES AXIS("a", "axis_0", "i") SYMBOL("coupling"),
};
// clang-format on

#define N_TABLES (sizeof tables / sizeof *tables)
#define N_VIEWS (sizeof views / sizeof *views)

/* What a format has of its own. */
typedef struct own_parts {
    int n;
    const schema_table *tables; /* [n] */
    const char *values;         /* the view of all values */
} own_parts;

static own_parts parts_of(int format)
{
    return format == GM_MAP_FORMAT_ONE_OIL
               ? (own_parts){sizeof one_oil / sizeof *one_oil, one_oil, one_oil_values}
               : (own_parts){sizeof oil_axis / sizeof *oil_axis, oil_axis,
                             oil_axis_values};
}

gm_status gm_schema_create(const gm_db *db, int format, gm_error *error)
{
    const own_parts own = parts_of(format);
    char pragma[96];
    (void)snprintf(pragma, sizeof pragma,
                   "PRAGMA application_id = %d; PRAGMA user_version = %d",
                   GM_MAP_APPLICATION, format);
    gm_status status = gm_db_run(db, pragma, error);
    for (size_t t = 0; status == GM_OK && t < N_TABLES; t++)
        status = gm_db_run(db, tables[t].sql, error);
    for (int t = 0; status == GM_OK && t < own.n; t++)
        status = gm_db_run(db, own.tables[t].sql, error);
    if (status == GM_OK)
        status = gm_db_run(db, own.values, error);
    for (size_t v = 0; status == GM_OK && v < N_VIEWS; v++)
        status = gm_db_run(db, views[v], error);
    return status;
}

static gm_status check_table(const gm_db *db, sqlite3_stmt *find,
                             const schema_table *table, gm_error *error)
{
    bool row = false;
    (void)sqlite3_bind_text(find, 1, table->name, -1, SQLITE_STATIC);
    gm_status status = gm_db_next(db, find, &row, error);
    if (status == GM_OK) {
        const unsigned char *sql = row ? sqlite3_column_text(find, 0) : NULL;
        if (!sql || strcmp((const char *)sql, table->sql) != 0)
            status = gm_fail(error, GM_ERR_FORMAT, "%s is damaged: its table %s is %s",
                             db->path, table->name,
                             row ? "not declared as in a map" : "missing");
    }
    (void)sqlite3_reset(find);
    return status;
}

gm_status gm_schema_check(const gm_db *db, int format, gm_error *error)
{
    const own_parts own = parts_of(format);
    sqlite3_stmt *find;
    gm_status status = gm_db_prepare(
        db, "SELECT sql FROM sqlite_master WHERE type = 'table' AND name = ?", &find,
        error);
    for (size_t t = 0; status == GM_OK && t < N_TABLES; t++)
        status = check_table(db, find, &tables[t], error);
    for (int t = 0; status == GM_OK && t < own.n; t++)
        status = check_table(db, find, &own.tables[t], error);
    (void)sqlite3_finalize(find);
    return status;
}

gm_status gm_schema_is_map(const gm_db *db, gm_error *error)
{
    sqlite3_int64 application = 0;
    gm_status status = gm_db_integer(db, "PRAGMA application_id", &application, error);
    if (status == GM_OK && application != GM_MAP_APPLICATION)
        status =
            gm_fail(error, GM_ERR_FORMAT,
                    "%s is not a map: it is an SQLite file of another kind", db->path);
    return status;
}
