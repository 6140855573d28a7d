/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Measured errors in a finished map's file.
 */
#include "file_fixture.h"
#include "map_fixture.h"

#include "base/alloc.h"

#include <setjmp.h>
#include <sqlite3.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static const gm_map_error_point points[] = {
    {100.0, 55.0, 6.5, 6.52},
    {200.0, -20.0, 1.5, 1.49},
};
static const gm_map_error errors[] = {
    {"single", "odd", {3, 0}, 1, 120, 6.5, 0.02, 0.004, 100.0, 55.0, 2, points},
    {"drag", "even", {0, 0}, -1, 80, 0.4, 0.001, 0.0002, -300.0, 0.0, 0, NULL},
};

static const char *const results[] = {"{\"points\": 3}", "{\"cycle\": \"ä\"}"};

static gm_status put(long long seed, int n, gm_error *error)
{
    const gm_map_verification verification = {seed, n, errors, n, results};
    return gm_map_put_verification(file_path, &verification, error);
}

static double number(const char *sql)
{
    sqlite3 *db;
    sqlite3_stmt *row;
    assert_int_equal(sqlite3_open(file_path, &db), SQLITE_OK);
    assert_int_equal(sqlite3_prepare_v2(db, sql, -1, &row, NULL), SQLITE_OK);
    assert_int_equal(sqlite3_step(row), SQLITE_ROW);
    double value = sqlite3_column_double(row, 0);
    sqlite3_finalize(row);
    sqlite3_close(db);
    return value;
}

static void errors_stand_beside_an_unchanged_map(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    file_write_map(map);
    assert_int_equal(put(7, 2, NULL), GM_OK);
    gm_map *read = file_read_map(file_path);
    assert_true(fixture_equal(map, read));
    assert_string_equal(map->content_hash, read->content_hash);
    assert_true(number("SELECT count(*) FROM verification") == 2.0);
    assert_true(number("SELECT max_Nm FROM verification WHERE kind = 'single'") == 0.02);
    assert_true(number("SELECT seed FROM verification WHERE direction = 'backward' AND "
                       "path = 'even'") == 7.0);
    assert_true(file_only(file_path));
    gm_map_destroy(read);
    gm_map_destroy(map);
}

static void points_belong_to_their_case(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    file_write_map(map);
    assert_int_equal(put(7, 2, NULL), GM_OK);
    assert_true(number("SELECT count(*) FROM verification_point p JOIN verification v "
                       "ON v.rowid = p.verification WHERE v.kind = 'single'") == 2.0);
    assert_true(number("SELECT reduced_Nm FROM verification_point "
                       "WHERE torque_Nm = -20") == 1.49);
    assert_int_equal(put(8, 0, NULL), GM_OK);
    assert_true(number("SELECT count(*) FROM verification_point") == 0.0);
    gm_map_destroy(map);
}

static void a_description_stands_beside_an_unchanged_map(void **state)
{
    const char text[] = "name: \xC3\xA9\n";
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    file_write_map(map);
    for (int i = 0; i < 2; i++) /* the second takes the place of the first */
        assert_int_equal(gm_map_put_description(file_path, text, strlen(text), NULL),
                         GM_OK);
    gm_map *read = file_read_map(file_path);
    assert_true(fixture_equal(map, read));
    assert_true(number("SELECT count(*) FROM description") == 1.0);
    assert_true(number("SELECT length(CAST(text AS BLOB)) FROM description") == 9.0);
    gm_map_destroy(read);
    gm_map_destroy(map);
}

static void a_description_needs_a_map(void **state)
{
    gm_error error = {0};
    (void)state;
    assert_int_equal(gm_map_put_description(file_path, "a", 1, &error), GM_ERR_IO);
    assert_true(strstr(error.message, "there is no such file") != NULL);
}

static void later_errors_take_the_place_of_earlier_ones(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    file_write_map(map);
    assert_int_equal(put(7, 2, NULL), GM_OK);
    assert_int_equal(put(8, 1, NULL), GM_OK);
    assert_true(number("SELECT count(*) FROM verification") == 1.0);
    assert_true(number("SELECT seed FROM verification") == 8.0);
    gm_map_destroy(map);
}

static void errors_are_read_back(void **state)
{
    gm_map_error *read = NULL;
    int n = 0;
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    file_write_map(map);
    assert_int_equal(gm_map_get_errors(file_path, &n, &read, NULL), GM_OK);
    assert_int_equal(n, 0);
    assert_null(read);
    assert_int_equal(put(7, 2, NULL), GM_OK);
    assert_int_equal(gm_map_get_errors(file_path, &n, &read, NULL), GM_OK);
    assert_int_equal(n, 2);
    for (int i = 0; i < n; i++) {
        assert_string_equal(read[i].kind, errors[i].kind);
        assert_string_equal(read[i].path, errors[i].path);
        assert_int_equal(read[i].gear[0], errors[i].gear[0]);
        assert_int_equal(read[i].gear[1], errors[i].gear[1]);
        assert_int_equal(read[i].direction, errors[i].direction);
        assert_int_equal(read[i].points, errors[i].points);
        assert_true(read[i].largest == errors[i].largest);
        assert_true(read[i].max == errors[i].max && read[i].rms == errors[i].rms);
        assert_true(read[i].worst_torque == errors[i].worst_torque);
    }
    gm_map_errors_free(n, read);
    gm_map_destroy(map);
}

static void reading_errors_without_memory_leaves_nothing(void **state)
{
    gm_map_error *read = NULL;
    int n = 0;
    gm_status status = GM_ERR_MEMORY;
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    file_write_map(map);
    gm_map_destroy(map);
    assert_int_equal(put(7, 2, NULL), GM_OK);
    for (long k = 1; status == GM_ERR_MEMORY; k++) {
        gm_alloc_fail_after(k);
        status = gm_map_get_errors(file_path, &n, &read, NULL);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || (status == GM_ERR_MEMORY && !read && n == 0));
    }
    gm_map_errors_free(n, read);
}

static void results_are_read_back(void **state)
{
    char **read = NULL;
    int n = 0;
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    file_write_map(map);
    assert_int_equal(gm_map_get_results(file_path, &n, &read, NULL), GM_OK);
    assert_int_equal(n, 0);
    assert_null(read);
    assert_int_equal(put(7, 2, NULL), GM_OK);
    assert_int_equal(gm_map_get_results(file_path, &n, &read, NULL), GM_OK);
    assert_int_equal(n, 2);
    for (int i = 0; i < n; i++)
        assert_string_equal(read[i], results[i]);
    gm_map_results_free(n, read);
    gm_map_destroy(map);
}

static void run(const char *sql)
{
    sqlite3 *db;
    assert_int_equal(sqlite3_open(file_path, &db), SQLITE_OK);
    assert_int_equal(sqlite3_exec(db, sql, NULL, NULL, NULL), SQLITE_OK);
    sqlite3_close(db);
}

static void a_result_that_is_no_text_is_damage(void **state)
{
    static const char many[] =
        "WITH RECURSIVE many (i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM many LIMIT "
        "100000) INSERT INTO result SELECT '{}' FROM many";
    static const char *const damage[] = {"UPDATE result SET json = x'7b7d'",
                                         "UPDATE result SET json = 'a' || char(0) || 'b'",
                                         many};
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    file_write_map(map);
    gm_map_destroy(map);
    for (size_t i = 0; i < sizeof damage / sizeof *damage; i++) {
        gm_error error = {GM_OK, ""};
        char **read = NULL;
        int n = 0;
        assert_int_equal(put(7, 2, NULL), GM_OK);
        run(damage[i]);
        assert_int_equal(gm_map_get_results(file_path, &n, &read, &error), GM_ERR_FORMAT);
        assert_non_null(strstr(error.message, "measured result"));
        assert_null(read);
    }
}

static void reading_results_without_memory_leaves_nothing(void **state)
{
    char **read = NULL;
    int n = 0;
    gm_status status = GM_ERR_MEMORY;
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    file_write_map(map);
    gm_map_destroy(map);
    assert_int_equal(put(7, 2, NULL), GM_OK);
    for (long k = 1; status == GM_ERR_MEMORY; k++) {
        gm_alloc_fail_after(k);
        status = gm_map_get_results(file_path, &n, &read, NULL);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || (status == GM_ERR_MEMORY && !read && n == 0));
    }
    gm_map_results_free(n, read);
}

static void what_is_no_map_is_left_alone(void **state)
{
    (void)state;
    gm_error error = {GM_OK, ""};
    assert_int_equal(put(1, 2, &error), GM_ERR_IO);
    assert_non_null(strstr(error.message, "there is no such file"));
    assert_true(file_only(NULL));
    file_write_bytes(file_path, "no database", 11);
    assert_int_equal(put(1, 2, &error), GM_ERR_FORMAT);
    size_t size;
    unsigned char *bytes = file_read_bytes(file_path, &size);
    assert_int_equal(size, 11);
    assert_memory_equal(bytes, "no database", 11);
    gm_free(bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(errors_stand_beside_an_unchanged_map, file_setup,
                                        file_teardown),
        cmocka_unit_test_setup_teardown(later_errors_take_the_place_of_earlier_ones,
                                        file_setup, file_teardown),
        cmocka_unit_test_setup_teardown(points_belong_to_their_case, file_setup,
                                        file_teardown),
        cmocka_unit_test_setup_teardown(a_description_stands_beside_an_unchanged_map,
                                        file_setup, file_teardown),
        cmocka_unit_test_setup_teardown(a_description_needs_a_map, file_setup,
                                        file_teardown),
        cmocka_unit_test_setup_teardown(errors_are_read_back, file_setup, file_teardown),
        cmocka_unit_test_setup_teardown(reading_errors_without_memory_leaves_nothing,
                                        file_setup, file_teardown),
        cmocka_unit_test_setup_teardown(results_are_read_back, file_setup, file_teardown),
        cmocka_unit_test_setup_teardown(a_result_that_is_no_text_is_damage, file_setup,
                                        file_teardown),
        cmocka_unit_test_setup_teardown(reading_results_without_memory_leaves_nothing,
                                        file_setup, file_teardown),
        cmocka_unit_test_setup_teardown(what_is_no_map_is_left_alone, file_setup,
                                        file_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
