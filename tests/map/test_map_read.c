/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Reading: damaged, truncated, foreign and unfinished files are refused with a sentence.
 */
#include "file_fixture.h"
#include "map_fixture.h"

#include "base/alloc.h"

#include <setjmp.h>
#include <sqlite3.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

static void files_that_are_no_maps_are_named(void **state)
{
    (void)state;
    static const char letter[] = "not a map at all, but a text of more than one hundred "
                                 "bytes, so that it could have the header of a database";
    char missing[128];
    gm_map *map = fixture_map(&fixture_full);
    gm_journal *journal = file_journal(map);
    file_put(journal, 0, 30);
    gm_journal_close(journal, true);
    file_expect_refusal(file_part, GM_ERR_FORMAT,
                        "is an unfinished sweep: run the same sweep again");
    journal = file_journal(map); /* and while it is being written */
    file_put(journal, 30, 31);
    pid_t child = fork();
    if (child == 0) {
        gm_map *none = NULL;
        gm_error error = {0};
        _exit(gm_map_read(file_part, &none, &error) == GM_ERR_FORMAT &&
                      strstr(error.message, "unfinished sweep")
                  ? 7
                  : 1);
    }
    int result = 0;
    assert_int_equal(waitpid(child, &result, 0), child);
    assert_true(WIFEXITED(result) && WEXITSTATUS(result) == 7);
    gm_journal_close(journal, false);
    (void)snprintf(missing, sizeof missing, "%s/none.map", file_folder);
    file_expect_refusal(missing, GM_ERR_IO, "there is no such file");
    file_expect_refusal(file_folder, GM_ERR_IO, "is not a file");
    file_write_bytes(file_path, "", 0);
    file_expect_refusal(file_path, GM_ERR_FORMAT, "it is empty");
    file_write_bytes(file_path, letter, sizeof letter);
    file_expect_refusal(file_path, GM_ERR_FORMAT, "is not an SQLite file");
    gm_map_destroy(map);
}

/* Change the finished map by SQL and expect a refusal that says the words. */
static void expect_refusal_after(const char *sql, const char *words)
{
    sqlite3 *db;
    gm_map *map = fixture_map(&fixture_full);
    file_write_map(map);
    assert_int_equal(sqlite3_open(file_path, &db), SQLITE_OK);
    (void)sqlite3_exec(db, "PRAGMA ignore_check_constraints = 1", NULL, NULL, NULL);
    if (sqlite3_exec(db, sql, NULL, NULL, NULL) != SQLITE_OK)
        fail_msg("%s: %s", sql, sqlite3_errmsg(db));
    (void)sqlite3_close(db);
    file_expect_refusal(file_path, GM_ERR_FORMAT, words);
    gm_map_destroy(map);
}

static void changed_content_is_refused(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"PRAGMA user_version = 5", "is a map of format 5, but this version of Gearmap "
                                    "reads formats 3 and 4"},
        {"PRAGMA user_version = 4", "its table oil is missing"},
        {"PRAGMA application_id = 7", "of another kind"},
        {"DROP TABLE value", "value is missing"},
        {"DROP TABLE gear; CREATE VIEW gear AS SELECT 0 path", "gear is missing"},
        {"ALTER TABLE value ADD COLUMN more", "not declared as in a map"},
        {"UPDATE meta SET value = 'half' WHERE key = 'state'", "state"},
        {"DELETE FROM meta WHERE key = 'options'", "'options'"},
        {"UPDATE meta SET value = 'fast' WHERE key = 'speed_max'", "'speed_max'"},
        {"UPDATE meta SET value = 2.5 WHERE key = 'name'", "'name'"},
        {"UPDATE meta SET value = '9.9' WHERE key = 'tool_version'", "tool version"},
        {"UPDATE meta SET value = 'other' WHERE key = 'title'", "content hash"},
        {"UPDATE meta SET value = printf('%.300c', 'x') WHERE key = 'title'", "'title'"},
        {"UPDATE gear SET ratio = ratio * 1.01 WHERE gear = 3", "content hash"},
        {"UPDATE gear SET lash = 2 * lash WHERE gear = 3", "content hash"},
        {"UPDATE gear SET inertia_extra = 0.01 WHERE gear = 3", "content hash"},
        {"DELETE FROM gear WHERE gear = 3", "damaged"},
        {"DELETE FROM path WHERE path = 1", "damaged"},
        {"DELETE FROM path", "damaged"},
        {"UPDATE path SET name = 'sixteen_letters_' WHERE path = 1", "path"},
        {"INSERT INTO path VALUES (2, 'third', 1.0, 1.0)", "path"},
        {"UPDATE gear SET gear = 99 WHERE gear = 3", "gear"},
        {"UPDATE axis SET n = 100000000 WHERE axis = 0", "axis"},
        {"UPDATE axis SET n = 99999 WHERE axis = 0", "axis"},
        {"UPDATE axis SET n = n - 1 WHERE axis = 1", "axis_value"},
        {"UPDATE axis SET axis = 100 WHERE axis = 1", "axis"},
        {"UPDATE axis SET quantity = 'torque' WHERE axis = 0", "map_table"},
        {"UPDATE axis_value SET x = 1e300 WHERE axis = 0 AND i = 0", "damaged"},
        {"DELETE FROM axis_value WHERE axis = 0 AND i = 1", "axis_value"},
        {"UPDATE map_table SET axis_0 = 77 WHERE id = 3", "map_table"},
        {"UPDATE map_table SET symbol = 'drug' WHERE id = 3", "map_table"},
        {"UPDATE map_table SET direction_0 = 'up' WHERE id = 3", "map_table"},
        {"UPDATE map_table SET direction_0 = NULL WHERE id = 3", "damaged"},
        {"UPDATE map_table SET gear_0 = 4 WHERE id = 3", "content hash"},
        {"UPDATE map_table SET id = 1000 WHERE id = 3", "map_table"},
        {"DELETE FROM map_table", "value"},
        {"UPDATE value SET value = 0.5 WHERE map_table = 8 AND i = 1", "content hash"},
        {"UPDATE value SET value = 'x' WHERE map_table = 8 AND i = 1", "value"},
        {"UPDATE value SET value = 9e999 WHERE map_table = 8 AND i = 1", "damaged"},
        {"DELETE FROM value WHERE map_table = 8 AND i = 1", "value"},
        {"INSERT INTO value VALUES (1000, 0, 0, 0, 1.0)", "values of no table"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect_refusal_after(cases[i][0], cases[i][1]);
}

static void tables_of_a_user_do_not_matter(void **state)
{
    (void)state;
    sqlite3 *db;
    gm_map *map = fixture_map(&fixture_full);
    file_write_map(map);
    assert_int_equal(sqlite3_open(file_path, &db), SQLITE_OK);
    assert_int_equal(sqlite3_exec(db,
                                  "CREATE TABLE my_notes (x); INSERT INTO my_notes "
                                  "VALUES (1); DROP VIEW v_drag",
                                  NULL, NULL, NULL),
                     SQLITE_OK);
    (void)sqlite3_close(db);
    gm_map *copy = file_read_map(file_path);
    assert_true(fixture_equal(map, copy));
    gm_map_destroy(map);
    gm_map_destroy(copy);
}

/* The bytes at path are damaged: reading must not crash, and what is read must be the
 *  map. Returns true when it was read. */
static bool read_damaged(const gm_map *map)
{
    gm_map *copy = NULL;
    gm_error error = {0};
    gm_status status = gm_map_read(file_path, &copy, &error);
    if (status == GM_OK) {
        assert_true(fixture_equal(map, copy));
        assert_string_equal(map->tool_version, copy->tool_version);
    } else {
        assert_null(copy);
        assert_non_null(strstr(error.message, file_path));
    }
    gm_map_destroy(copy);
    return status == GM_OK;
}

static void truncated_map_is_refused(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    size_t size;
    file_write_map(map);
    unsigned char *bytes = file_read_bytes(file_path, &size);
    for (int n = 0; n < 300; n++) {
        size_t length =
            n < 100 ? (size_t)n + 1 : size - 1 - (size - 1) * (size_t)(n - 100) / 200;
        file_write_bytes(file_path, bytes, length);
        assert_false(read_damaged(map));
    }
    gm_free(bytes);
    gm_map_destroy(map);
}

static void flipped_bits_never_give_another_map(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    uint64_t random = 2026;
    size_t size;
    int read = 0;
    const int flips = 2500;
    file_write_map(map);
    unsigned char *bytes = file_read_bytes(file_path, &size);
    for (int n = 0; n < flips; n++) {
        /* one bit; every tenth time a damaged block */
        size_t at = (size_t)((double)size * fixture_random(&random));
        size_t end = n % 10 == 0 ? at + 40 : at + 1;
        FILE *file = NULL;
        if (n == 0)
            file_write_bytes(file_path, bytes, size);
        file = fopen(file_path, "r+b");
        assert_non_null(file);
        for (size_t i = at; i < end && i < size; i++) {
            int bit = 1 << (int)(8.0 * fixture_random(&random));
            assert_int_equal(fseek(file, (long)i, SEEK_SET), 0);
            assert_true(fputc(bytes[i] ^ bit, file) != EOF);
        }
        assert_int_equal(fclose(file), 0);
        read += read_damaged(map);
        file = fopen(file_path, "r+b");
        assert_non_null(file);
        assert_int_equal(fseek(file, (long)at, SEEK_SET), 0);
        size_t length = (end < size ? end : size) - at;
        assert_int_equal(fwrite(bytes + at, 1, length, file), length);
        assert_int_equal(fclose(file), 0);
    }
    /* many flips hit free space and the text of views, which say nothing of the map */
    assert_true(read > 0 && read < flips);
    assert_true(read_damaged(map)); /* and undamaged it is still read */
    gm_free(bytes);
    gm_map_destroy(map);
}

/* The file holds numbers as 8 bytes, big endian. */
static void big_endian(double value, unsigned char bytes[8])
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 7; i >= 0; i--, bits >>= 8)
        bytes[i] = (unsigned char)(bits & 0xff);
}

static void every_bit_of_a_value_counts(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full), *copy = NULL;
    size_t size;
    int found = 0;
    file_write_map(map);
    unsigned char *bytes = file_read_bytes(file_path, &size), number[8];
    for (int t = 0; t < map->n_tables; t += 15) {
        size_t at = 0;
        big_endian(map->tables[t].value[1], number);
        while (at + 8 <= size && memcmp(bytes + at, number, 8) != 0)
            at++;
        if (at + 8 > size)
            continue;
        found++;
        for (int bit = 0; bit < 64; bit++) {
            bytes[at + (size_t)bit / 8] ^= (unsigned char)(1 << bit % 8);
            file_write_bytes(file_path, bytes, size);
            assert_int_equal(gm_map_read(file_path, &copy, NULL), GM_ERR_FORMAT);
            bytes[at + (size_t)bit / 8] ^= (unsigned char)(1 << bit % 8);
        }
    }
    assert_true(found >= map->n_tables / 15);
    gm_free(bytes);
    gm_map_destroy(map);
}

static void allocation_failures_while_reading(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full), *copy = NULL;
    gm_status status = GM_ERR_MEMORY;
    int failures = 0;
    file_write_map(map);
    for (long k = 1; status == GM_ERR_MEMORY; k++, failures++) {
        assert_null(copy);
        gm_alloc_fail_after(k);
        status = gm_map_read(file_path, &copy, NULL);
        gm_alloc_fail_after(0);
    }
    assert_int_equal(status, GM_OK);
    assert_true(failures > map->n_tables);
    assert_true(fixture_equal(map, copy));
    gm_map_destroy(map);
    gm_map_destroy(copy);
}

#define CASE(name) cmocka_unit_test_setup_teardown(name, file_setup, file_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(files_that_are_no_maps_are_named),    CASE(changed_content_is_refused),
        CASE(tables_of_a_user_do_not_matter),      CASE(truncated_map_is_refused),
        CASE(flipped_bits_never_give_another_map), CASE(every_bit_of_a_value_counts),
        CASE(allocation_failures_while_reading),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
