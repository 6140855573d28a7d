/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The file as other programs see it: strict types, and views in engineering units that
 * show the numbers of the map.
 */
#include "map_fixture.h"

#include "map/gm_map_file.h"

#include <math.h>
#include <setjmp.h>
#include <sqlite3.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

/* Conversion by the 15 digits of 30/pi in the views and the rounding of one product. */
#define NEAR 1e-14
static const double pi = 3.14159265358979323846;

static char path[] = "/tmp/gm_schema_XXXXXX";
static gm_map *map;
static sqlite3 *db;

static int write_map(void **state)
{
    (void)state;
    gm_journal *journal = NULL;
    gm_error error;
    int descriptor = mkstemp(path);
    if (descriptor < 0 || close(descriptor) != 0)
        return -1;
    map = fixture_map(&fixture_full);
    if (gm_journal_open(path, map, 8, &journal, &error) != GM_OK)
        fail_msg("%s", error.message);
    assert_int_equal(gm_journal_finish(journal, map, &error), GM_OK);
    return sqlite3_open(path, &db);
}

static int remove_map(void **state)
{
    (void)state;
    gm_map_destroy(map);
    (void)sqlite3_close(db);
    return unlink(path);
}

static sqlite3_stmt *query(const char *sql)
{
    sqlite3_stmt *rows;
    if (sqlite3_prepare_v2(db, sql, -1, &rows, NULL) != SQLITE_OK)
        fail_msg("%s: %s", sql, sqlite3_errmsg(db));
    return rows;
}

static double number(const char *sql)
{
    sqlite3_stmt *rows = query(sql);
    assert_int_equal(sqlite3_step(rows), SQLITE_ROW);
    double value = sqlite3_column_double(rows, 0);
    (void)sqlite3_finalize(rows);
    return value;
}

static void assert_near(double a, double b)
{
    if (!(fabs(a - b) <= NEAR * fabs(b)))
        fail_msg("%.17g is not %.17g", a, b);
}

static int direction_of(sqlite3_stmt *rows, int column)
{
    const unsigned char *name = sqlite3_column_text(rows, column);
    assert_non_null(name);
    return strcmp((const char *)name, "backward") == 0 ? GM_BACKWARD : GM_FORWARD;
}

static void every_view_shows_every_value_once(void **state)
{
    (void)state;
    static const char *const views[GM_SYMBOLS] = {
        "v_parasitic_loss", "v_load_loss", "v_both_loaded", "v_drag",
        "v_reaction",       "v_line_jump", "v_coupling"};
    for (int s = 0; s < GM_SYMBOLS; s++) {
        char sql[64];
        int values = 0;
        for (int t = 0; t < map->n_tables; t++)
            if (map->tables[t].key.symbol == (gm_symbol)s)
                values += gm_map_table_size(&map->tables[t]);
        (void)snprintf(sql, sizeof sql, "SELECT count(*) FROM %s", views[s]);
        assert_true(values > 0);
        assert_int_equal((int)number(sql), values);
    }
}

static void load_losses_in_rpm_with_efficiency(void **state)
{
    (void)state;
    sqlite3_stmt *rows =
        query("SELECT path, gear, path_direction, speed_rpm, torque_Nm, loss_torque_Nm, "
              "efficiency, power_flow FROM v_load_loss WHERE path = 'even' AND gear = -1 "
              "ORDER BY path_direction DESC, speed_rpm, torque_Nm");
    for (int d = 0; d < 2; d++) {
        gm_table_key key = gm_table_key_of(GM_LOAD_LOSS);
        key.path = 1, key.gear[1] = -1, key.direction[0] = d;
        const gm_map_table *t = gm_map_find(map, &key);
        for (int m = 0; m < gm_map_table_size(t); m++) {
            double tau = t->x[1][m % t->n[1]], loss = t->value[m];
            assert_int_equal(sqlite3_step(rows), SQLITE_ROW);
            assert_int_equal(direction_of(rows, 2), d);
            assert_near(sqlite3_column_double(rows, 3), t->x[0][m / t->n[1]] * 30.0 / pi);
            assert_true(sqlite3_column_double(rows, 4) == tau);
            assert_true(sqlite3_column_double(rows, 5) == loss);
            if (tau == 0.0) {
                assert_int_equal(sqlite3_column_type(rows, 6), SQLITE_NULL);
                assert_int_equal(sqlite3_column_type(rows, 7), SQLITE_NULL);
                continue;
            }
            /* in = |tau| and out = |tau| - D; driven: out = |tau| and in = |tau| + D */
            assert_near(sqlite3_column_double(rows, 6),
                        tau > 0.0 ? 1.0 - loss / tau : -tau / (-tau + loss));
            assert_string_equal((const char *)sqlite3_column_text(rows, 7),
                                tau > 0.0 ? "driving" : "driven");
        }
    }
    assert_int_equal(sqlite3_step(rows), SQLITE_DONE);
    (void)sqlite3_finalize(rows);
}

static void drags_by_both_directions(void **state)
{
    (void)state;
    sqlite3_stmt *rows = query(
        "SELECT path_direction, output_direction, path_speed_rpm, output_speed_rpm, "
        "drag_torque_Nm FROM v_drag WHERE path = 'odd' ORDER BY path_direction DESC, "
        "output_direction DESC, path_speed_rpm, output_speed_rpm");
    for (int i = 0; i < 4; i++) {
        gm_table_key key = gm_table_key_of(GM_DRAG);
        key.path = 0, key.direction[0] = i / 2, key.direction[1] = i % 2;
        const gm_map_table *t = gm_map_find(map, &key);
        for (int m = 0; m < gm_map_table_size(t); m++) {
            assert_int_equal(sqlite3_step(rows), SQLITE_ROW);
            assert_int_equal(direction_of(rows, 0), i / 2);
            assert_int_equal(direction_of(rows, 1), i % 2);
            assert_near(sqlite3_column_double(rows, 2), t->x[0][m / t->n[1]] * 30.0 / pi);
            assert_near(sqlite3_column_double(rows, 3), t->x[1][m % t->n[1]] * 30.0 / pi);
            assert_true(sqlite3_column_double(rows, 4) == t->value[m]);
        }
    }
    (void)sqlite3_finalize(rows);
}

static void corrections_over_three_axes(void **state)
{
    (void)state;
    sqlite3_stmt *rows =
        query("SELECT torque_0_Nm, torque_1_Nm, correction_torque_Nm FROM v_both_loaded "
              "WHERE gear_0 = 3 AND gear_1 = 2 AND output_direction = 'forward' "
              "ORDER BY output_speed_rpm, torque_0_Nm, torque_1_Nm");
    gm_table_key key = gm_table_key_of(GM_BOTH_LOADED);
    key.gear[0] = 3, key.gear[1] = 2, key.direction[0] = GM_FORWARD;
    const gm_map_table *t = gm_map_find(map, &key);
    for (int m = 0; m < gm_map_table_size(t); m++) {
        assert_int_equal(sqlite3_step(rows), SQLITE_ROW);
        assert_true(sqlite3_column_double(rows, 0) == t->x[1][m / t->n[2] % t->n[1]]);
        assert_true(sqlite3_column_double(rows, 1) == t->x[2][m % t->n[2]]);
        assert_true(sqlite3_column_double(rows, 2) == t->value[m]);
    }
    (void)sqlite3_finalize(rows);
}

static void gears_configurations_and_the_whole(void **state)
{
    (void)state;
    double r = map->paths[0].gears[1].ratio, s = map->paths[1].gears[0].ratio;
    double given = map->paths[1].gears[0].ratio_given;
    assert_true(number("SELECT ratio FROM v_gear WHERE path = 'odd' AND gear = 3") == r);
    /* a difference of nearly equal numbers: absolute rounding of the quotient */
    assert_true(fabs(number("SELECT relative_deviation FROM v_gear WHERE gear = -1") -
                     (s / given - 1.0)) < 1e-15);
    assert_int_equal((int)number("SELECT count(*) FROM v_gear WHERE ratio_given IS NULL"),
                     1);
    assert_int_equal((int)number("SELECT count(*) FROM v_configuration"), 9);
    assert_near(number("SELECT inertia_at_output_kgm2 FROM v_configuration "
                       "WHERE gear_0 = 3 AND gear_1 = -1"),
                map->inertia_output + r * r * map->paths[0].inertia +
                    s * s * map->paths[1].inertia + map->paths[0].gears[1].inertia_extra +
                    map->paths[1].gears[0].inertia_extra);
    assert_near(number("SELECT inertia_at_output_kgm2 FROM v_configuration "
                       "WHERE gear_0 = 0 AND gear_1 = 0"),
                map->inertia_output);
    assert_near(number("SELECT oil_degC FROM v_map"), map->oil_temperature - 273.15);
    assert_near(number("SELECT speed_max_rpm FROM v_map"), 6450.0);
    sqlite3_stmt *rows = query("SELECT content_hash, title FROM v_map");
    assert_int_equal(sqlite3_step(rows), SQLITE_ROW);
    assert_string_equal((const char *)sqlite3_column_text(rows, 0), map->content_hash);
    assert_string_equal((const char *)sqlite3_column_text(rows, 1), map->title);
    (void)sqlite3_finalize(rows);
}

static void equal_axes_are_stored_once(void **state)
{
    (void)state;
    assert_int_equal((int)number("SELECT count(*) - count(DISTINCT d) FROM (SELECT "
                                 "quantity || group_concat(x) AS d FROM axis JOIN "
                                 "axis_value USING (axis) GROUP BY axis)"),
                     0);
    assert_int_equal((int)number("SELECT count(*) FROM axis WHERE n <> (SELECT count(*) "
                                 "FROM axis_value v WHERE v.axis = axis.axis)"),
                     0);
}

static void wrong_types_are_refused(void **state)
{
    (void)state;
    static const char *const wrong[] = {
        "INSERT INTO value VALUES (0, 0, 0, 'x', 1.0)",
        "INSERT INTO value VALUES (900, 0, 0, 0, 'much')",
        "INSERT INTO value VALUES (900, 0, 0, 0, NULL)",
        "INSERT INTO value VALUES (900, -1, 0, 0, 1.0)",
        "UPDATE value SET value = x'00'",
        "UPDATE axis_value SET x = 'far'",
        "UPDATE map_table SET direction_0 = 'up'",
        "UPDATE map_table SET symbol = 'lift'",
        "UPDATE gear SET ratio = 0",
        "UPDATE path SET inertia = -1",
        "INSERT INTO meta VALUES ('key', NULL, NULL)",
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_int_equal(sqlite3_exec(db, wrong[i], NULL, NULL, NULL), SQLITE_CONSTRAINT);
}

static void other_programs_find_a_sound_database(void **state)
{
    (void)state;
    sqlite3_stmt *rows = query("PRAGMA integrity_check");
    assert_int_equal(sqlite3_step(rows), SQLITE_ROW);
    assert_string_equal((const char *)sqlite3_column_text(rows, 0), "ok");
    (void)sqlite3_finalize(rows);
    rows = query("PRAGMA foreign_key_check");
    assert_int_equal(sqlite3_step(rows), SQLITE_DONE);
    (void)sqlite3_finalize(rows);
    rows = query("PRAGMA journal_mode"); /* no log that would need to be written beside */
    assert_int_equal(sqlite3_step(rows), SQLITE_ROW);
    assert_string_equal((const char *)sqlite3_column_text(rows, 0), "delete");
    (void)sqlite3_finalize(rows);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_view_shows_every_value_once),
        cmocka_unit_test(load_losses_in_rpm_with_efficiency),
        cmocka_unit_test(drags_by_both_directions),
        cmocka_unit_test(corrections_over_three_axes),
        cmocka_unit_test(gears_configurations_and_the_whole),
        cmocka_unit_test(equal_axes_are_stored_once),
        cmocka_unit_test(wrong_types_are_refused),
        cmocka_unit_test(other_programs_find_a_sound_database),
    };
    return cmocka_run_group_tests(tests, write_map, remove_map);
}
