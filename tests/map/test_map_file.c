/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The map's file: round trip, journal and resume, damaged and foreign files.
 */
#include "map_fixture.h"

#include "base/alloc.h"
#include "map/gm_map_file.h"

#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <sqlite3.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

static char folder[64], path[96], part[104];

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/gm_map_XXXXXX");
    if (!mkdtemp(folder))
        return -1;
    (void)snprintf(path, sizeof path, "%s/a map?.map", folder);
    (void)snprintf(part, sizeof part, "%s.part", path);
    return 0;
}

static bool exists(const char *name)
{
    return access(name, F_OK) == 0;
}

/* True when nothing but the named file (NULL: nothing) is in the folder. */
static bool only(const char *name)
{
    char command[400];
    (void)snprintf(command, sizeof command, "test \"$(ls -A '%s' | wc -l)\" -eq %d",
                   folder, name ? 1 : 0);
    return (!name || exists(name)) && system(command) == 0;
}

static int remove_folder(void **state)
{
    (void)state;
    char command[128];
    (void)snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command);
}

static gm_journal *open_journal(gm_map *map)
{
    gm_error error;
    gm_journal *journal = NULL;
    if (gm_journal_open(path, map, &journal, &error) != GM_OK)
        fail_msg("%s", error.message);
    return journal;
}

static void put(gm_journal *journal, const gm_map *map, int t, int i)
{
    gm_error error;
    if (gm_journal_put(journal, map, t, i, &error) != GM_OK)
        fail_msg("%s", error.message);
}

static int total_rows(const gm_map *map)
{
    int n = 0;
    for (int t = 0; t < map->n_tables; t++)
        n += map->tables[t].n[0];
    return n;
}

/* Rows number first .. last - 1 of all, counted over the tables. */
static void put_rows(gm_journal *journal, const gm_map *map, int first, int last)
{
    for (int t = 0, n = 0; t < map->n_tables; t++)
        for (int i = 0; i < map->tables[t].n[0]; i++, n++)
            if (n >= first && n < last)
                put(journal, map, t, i);
}

static void finish(gm_journal *journal, gm_map *map)
{
    gm_error error;
    if (gm_journal_finish(journal, map, &error) != GM_OK)
        fail_msg("%s", error.message);
}

/* Write a finished map at path. */
static void write_map(gm_map *map)
{
    gm_journal *journal = open_journal(map);
    put_rows(journal, map, 0, total_rows(map));
    finish(journal, map);
}

static gm_map *read_map(const char *name)
{
    gm_error error;
    gm_map *map = NULL;
    if (gm_map_read(name, &map, &error) != GM_OK)
        fail_msg("%s", error.message);
    return map;
}

static void expect_refusal(const char *name, gm_status status, const char *words)
{
    gm_error error = {0};
    gm_map *map = NULL;
    assert_int_equal(gm_map_read(name, &map, &error), status);
    assert_null(map);
    if (!strstr(error.message, words) || !strstr(error.message, name))
        fail_msg("'%s' does not say '%s' of %s", error.message, words, name);
}

static void round_trip_gives_equal_bits(void **state)
{
    (void)state;
    const fixture_options one = {1, true, false, GM_SYMBOLS};
    for (int n_paths = 1; n_paths <= 2; n_paths++) {
        gm_map *map = fixture_map(n_paths == 1 ? &one : &fixture_full);
        map->tables[0].value[1] = 5e-324; /* smallest, largest, no negative zero */
        map->tables[0].value[2] = 1.7976931348623157e308;
        map->tables[0].value[3] = -0.0;
        map->paths[0].sync_torque = HUGE_VAL;
        write_map(map);
        assert_false(signbit(map->tables[0].value[3]));
        assert_true(only(path));
        gm_map *copy = read_map(path);
        assert_true(fixture_equal(map, copy));
        assert_string_equal(copy->tool_version, map->tool_version);
        assert_int_equal(strlen(map->content_hash), 64);
        assert_string_equal(copy->content_hash, map->content_hash);
        for (int t = 0; t < map->n_tables; t++) /* also in the same order */
            assert_memory_equal(&map->tables[t].key, &copy->tables[t].key,
                                sizeof map->tables[t].key);
        gm_map_destroy(map);
        gm_map_destroy(copy);
    }
}

static void order_of_rows_does_not_matter(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    char hash[65];
    write_map(map);
    memcpy(hash, map->content_hash, sizeof hash);
    gm_journal *journal = open_journal(map);
    for (int n = total_rows(map) - 1; n >= 0; n--)
        put_rows(journal, map, n, n + 1);
    finish(journal, map);
    assert_string_equal(hash, map->content_hash);
    gm_map *copy = read_map(path);
    assert_true(fixture_equal(map, copy));
    gm_map_destroy(map);
    gm_map_destroy(copy);
}

/* Open again with an empty frame: the first n rows, and only they, must be there. */
static gm_journal *expect_resumed(gm_map *frame, const gm_map *map, int n)
{
    gm_journal *journal = open_journal(frame);
    assert_int_equal(gm_journal_resumed(journal), n);
    for (int t = 0, m = 0; t < map->n_tables; t++) {
        int size = gm_map_row_size(&map->tables[t]);
        for (int i = 0; i < map->tables[t].n[0]; i++, m++) {
            assert_int_equal(gm_journal_has(journal, t, i), m < n);
            for (int v = i * size; v < (i + 1) * size; v++)
                assert_true(frame->tables[t].value[v] ==
                            (m < n ? map->tables[t].value[v] : 0.0));
        }
    }
    assert_false(gm_journal_has(journal, -1, 0));
    assert_false(gm_journal_has(journal, 0, map->tables[0].n[0]));
    assert_false(gm_journal_has(journal, map->n_tables, 0));
    return journal;
}

static void resumes_what_was_kept(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full), *frame = fixture_frame(&fixture_full);
    int n = total_rows(map);
    gm_journal *journal = open_journal(map);
    assert_int_equal(gm_journal_resumed(journal), 0);
    put_rows(journal, map, 0, n / 3);
    gm_journal_close(journal, true);
    assert_true(only(part));
    journal = expect_resumed(frame, map, n / 3);
    fixture_fill(frame, map);
    put_rows(journal, frame, n / 3, n);
    finish(journal, frame);
    assert_true(only(path));
    gm_map *copy = read_map(path);
    assert_true(fixture_equal(map, copy));
    gm_map_destroy(map);
    gm_map_destroy(frame);
    gm_map_destroy(copy);
}

/* A child puts rows and tells each one when put returned; it is killed in the middle.
 *  Every row that it told of must be there, whole. */
static int kill_while_putting(const gm_map *from, int rows_to_wait_for)
{
    int ends[2], told = 0;
    char byte;
    assert_int_equal(pipe(ends), 0);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        gm_map *map = fixture_frame(&fixture_full);
        gm_journal *journal;
        fixture_fill(map, from);
        if (gm_journal_open(path, map, &journal, NULL) != GM_OK)
            _exit(1);
        for (int t = 0; t < map->n_tables; t++)
            for (int i = 0; i < map->tables[t].n[0]; i++)
                if (gm_journal_put(journal, map, t, i, NULL) != GM_OK ||
                    write(ends[1], "r", 1) != 1)
                    _exit(1);
        _exit(0);
    }
    (void)close(ends[1]);
    while (told < rows_to_wait_for && read(ends[0], &byte, 1) == 1)
        told++;
    assert_int_equal(kill(child, SIGKILL), 0);
    assert_int_equal(waitpid(child, NULL, 0), child);
    while (read(ends[0], &byte, 1) == 1)
        told++;
    (void)close(ends[0]);
    return told;
}

static void kill_loses_no_finished_row(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    int n = total_rows(map);
    for (int wait = 1; wait < n; wait += n / 7) {
        gm_map *frame = fixture_frame(&fixture_full);
        int told = kill_while_putting(map, wait);
        gm_journal *journal = open_journal(frame);
        int resumed = gm_journal_resumed(journal);
        assert_true(resumed == told || resumed == told + 1); /* killed before telling */
        gm_journal_close(journal, true);
        gm_map_destroy(frame);
        frame = fixture_frame(&fixture_full);
        journal = expect_resumed(frame, map, resumed);
        gm_journal_close(journal, false);
        assert_true(only(NULL));
        gm_map_destroy(frame);
    }
    gm_map_destroy(map);
}

static void journal_of_another_sweep_is_replaced(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full), *frame = fixture_frame(&fixture_full);
    char *texts[] = {frame->options, frame->input_sha256, frame->tool_version,
                     frame->paths[0].name};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        gm_journal *journal = open_journal(map);
        put_rows(journal, map, 0, 9);
        gm_journal_close(journal, true);
        texts[i][0] ^= 1;
        journal = expect_resumed(frame, map, 0);
        gm_journal_close(journal, true);
        journal = expect_resumed(frame, map, 0);
        gm_journal_close(journal, false);
        assert_true(only(NULL));
        texts[i][0] ^= 1;
    }
    gm_map_destroy(map);
    gm_map_destroy(frame);
}

static void write_bytes(const char *name, const void *bytes, size_t size)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static unsigned char *read_bytes(const char *name, size_t *size)
{
    struct stat info;
    FILE *file = fopen(name, "rb");
    assert_non_null(file);
    assert_int_equal(fstat(fileno(file), &info), 0);
    *size = (size_t)info.st_size;
    unsigned char *bytes = gm_calloc(*size, 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *size, file), *size);
    (void)fclose(file);
    return bytes;
}

static void damaged_journal_is_begun_anew(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full), *frame = fixture_frame(&fixture_full);
    uint64_t random = 5;
    size_t size;
    gm_journal *journal = open_journal(map);
    put_rows(journal, map, 0, 40);
    gm_journal_close(journal, true);
    unsigned char *bytes = read_bytes(part, &size);
    for (int n = 0; n < 40; n++) {
        unsigned char *bad = gm_calloc(size, 1);
        size_t end =
            n % 2 ? size : 100 + (size_t)((double)size * fixture_random(&random));
        memcpy(bad, bytes, size);
        for (size_t i = 100; i < size; i += 1 + (size_t)(300.0 * fixture_random(&random)))
            bad[i] ^= 0x5a;
        write_bytes(part, bad, end < size ? end : size);
        journal = expect_resumed(frame, map, 0);
        put_rows(journal, map, 0, 3);
        gm_journal_close(journal, true);
        journal = expect_resumed(frame, map, 3);
        gm_journal_close(journal, false);
        for (int t = 0; t < frame->n_tables; t++)
            memset(frame->tables[t].value, 0,
                   (size_t)gm_map_table_size(&frame->tables[t]) * sizeof(double));
        assert_true(only(NULL));
        gm_free(bad);
    }
    gm_free(bytes);
    gm_map_destroy(map);
    gm_map_destroy(frame);
}

static void empty_journal_is_taken_and_foreign_file_left_alone(void **state)
{
    (void)state;
    static const char letter[] = "This is a letter, and not a journal of a sweep. It is "
                                 "long enough to have the header of a database in it.";
    gm_map *map = fixture_map(&fixture_full);
    gm_journal *journal = NULL;
    gm_error error = {0};
    size_t size;
    write_bytes(part, "", 0);
    journal = open_journal(map);
    gm_journal_close(journal, false);
    assert_true(only(NULL));
    write_bytes(part, letter, sizeof letter);
    assert_int_not_equal(gm_journal_open(path, map, &journal, &error), GM_OK);
    unsigned char *bytes = read_bytes(part, &size);
    assert_int_equal(size, sizeof letter);
    assert_memory_equal(bytes, letter, size);
    assert_non_null(strstr(error.message, part));
    assert_true(only(part));
    gm_free(bytes);
    gm_map_destroy(map);
}

static void foreign_database_is_left_alone(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    gm_journal *journal = NULL;
    gm_error error = {0};
    sqlite3 *db;
    assert_int_equal(sqlite3_open(part, &db), SQLITE_OK);
    assert_int_equal(sqlite3_exec(db, "CREATE TABLE letters (x)", NULL, NULL, NULL), 0);
    (void)sqlite3_close(db);
    expect_refusal(part, GM_ERR_FORMAT, "of another kind");
    assert_int_equal(gm_journal_open(path, map, &journal, &error), GM_ERR_IO);
    assert_non_null(strstr(error.message, "in the way"));
    assert_true(only(part));
    gm_map_destroy(map);
}

static void second_sweep_is_refused(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full), *other = fixture_map(&fixture_full);
    gm_journal *journal = open_journal(map), *second = NULL;
    int result = 0;
    put_rows(journal, map, 0, 5);
    gm_error error = {0};
    assert_int_equal(gm_journal_open(path, other, &second, &error), GM_ERR_IO);
    assert_non_null(strstr(error.message, "another sweep is writing it"));
    assert_null(second);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0)
        _exit(gm_journal_open(path, other, &second, NULL) == GM_ERR_IO ? 7 : 1);
    assert_int_equal(waitpid(child, &result, 0), child);
    assert_true(WIFEXITED(result) && WEXITSTATUS(result) == 7);
    put_rows(journal, map, 5, total_rows(map)); /* undisturbed */
    finish(journal, map);
    gm_map *copy = read_map(path);
    assert_true(fixture_equal(map, copy));
    gm_map_destroy(map);
    gm_map_destroy(other);
    gm_map_destroy(copy);
}

static void finish_needs_every_row_and_number(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    int n = total_rows(map);
    gm_error error = {0};
    gm_journal *journal = open_journal(map);
    put_rows(journal, map, 0, n - 2);
    assert_int_equal(gm_journal_finish(journal, map, &error), GM_ERR_ARGUMENT);
    assert_non_null(strstr(error.message, "2 rows"));
    assert_string_equal(map->content_hash, "");
    assert_true(only(part)); /* nothing is lost, nothing has the final name */
    journal = open_journal(map);
    assert_int_equal(gm_journal_resumed(journal), n - 2);
    put_rows(journal, map, n - 2, n);
    map->paths[0].inertia = 0.0;
    assert_int_equal(gm_journal_finish(journal, map, &error), GM_ERR_FORMAT);
    assert_true(only(part));
    map->paths[0].inertia = 0.1;
    journal = open_journal(map);
    assert_int_equal(gm_journal_resumed(journal), n);
    finish(journal, map);
    assert_true(only(path));
    gm_map_destroy(map);
}

static void finish_writes_what_changed_after_put(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    gm_journal *journal = open_journal(map);
    put_rows(journal, map, 0, total_rows(map));
    map->tables[5].value[3] += 1.0;
    map->tables[map->n_tables - 1].value[0] = 0.25;
    finish(journal, map);
    gm_map *copy = read_map(path);
    assert_true(fixture_equal(map, copy));
    gm_map_destroy(map);
    gm_map_destroy(copy);
}

static void put_refuses_what_is_no_row(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    gm_journal *journal = open_journal(map);
    assert_int_equal(gm_journal_put(journal, map, -1, 0, NULL), GM_ERR_ARGUMENT);
    assert_int_equal(gm_journal_put(journal, map, map->n_tables, 0, NULL),
                     GM_ERR_ARGUMENT);
    assert_int_equal(gm_journal_put(journal, map, 0, map->tables[0].n[0], NULL),
                     GM_ERR_ARGUMENT);
    map->tables[0].value[0] = (double)NAN;
    assert_int_equal(gm_journal_put(journal, map, 0, 0, NULL), GM_ERR_ARGUMENT);
    assert_false(gm_journal_has(journal, 0, 0));
    gm_journal_close(journal, false);
    gm_journal_close(NULL, true);
    assert_true(only(NULL));
    gm_map_destroy(map);
}

static void unwritable_places_are_refused(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    char file[128], below[200], missing[128];
    (void)snprintf(file, sizeof file, "%s/plain", folder);
    (void)snprintf(below, sizeof below, "%s/x.map", file);
    (void)snprintf(missing, sizeof missing, "%s/none/x.map", folder);
    write_bytes(file, "x", 1);
    const char *places[] = {folder, below, missing, "", "/dev/null", "/proc/x.map"};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        gm_journal *journal = NULL;
        gm_error error = {0};
        assert_int_equal(gm_journal_open(places[i], map, &journal, &error), GM_ERR_IO);
        assert_null(journal);
        assert_true(strlen(error.message) > 20);
        assert_true(only(file));
    }
    if (geteuid() != 0) { /* root may write anywhere */
        gm_journal *journal = NULL;
        assert_int_equal(unlink(file), 0);
        assert_int_equal(chmod(folder, 0500), 0);
        assert_int_equal(gm_journal_open(path, map, &journal, NULL), GM_ERR_IO);
        assert_int_equal(chmod(folder, 0700), 0);
        assert_true(only(NULL));
    }
    gm_map_destroy(map);
}

static void old_map_stays_until_the_new_one_is_whole(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    write_map(map);
    gm_map *next = fixture_map(&fixture_full);
    next->inertia_output = 0.5;
    strcpy(next->options, "other");
    gm_journal *journal = open_journal(next);
    put_rows(journal, next, 0, 20);
    gm_map *copy = read_map(path);
    assert_true(fixture_equal(map, copy));
    gm_map_destroy(copy);
    put_rows(journal, next, 20, total_rows(next));
    finish(journal, next);
    copy = read_map(path);
    assert_true(fixture_equal(next, copy));
    gm_map_destroy(map);
    gm_map_destroy(next);
    gm_map_destroy(copy);
}

static void files_that_are_no_maps_are_named(void **state)
{
    (void)state;
    static const char letter[] = "not a map at all, but a text of more than one hundred "
                                 "bytes, so that it could have the header of a database";
    char missing[128];
    gm_map *map = fixture_map(&fixture_full);
    gm_journal *journal = open_journal(map);
    put_rows(journal, map, 0, 30);
    gm_journal_close(journal, true);
    expect_refusal(part, GM_ERR_FORMAT,
                   "is an unfinished sweep: run the same sweep again");
    journal = open_journal(map); /* and while it is being written */
    put_rows(journal, map, 30, 31);
    pid_t child = fork();
    if (child == 0) {
        gm_map *none = NULL;
        gm_error error = {0};
        _exit(gm_map_read(part, &none, &error) == GM_ERR_FORMAT &&
                      strstr(error.message, "unfinished sweep")
                  ? 7
                  : 1);
    }
    int result = 0;
    assert_int_equal(waitpid(child, &result, 0), child);
    assert_true(WIFEXITED(result) && WEXITSTATUS(result) == 7);
    gm_journal_close(journal, false);
    (void)snprintf(missing, sizeof missing, "%s/none.map", folder);
    expect_refusal(missing, GM_ERR_IO, "there is no such file");
    expect_refusal(folder, GM_ERR_IO, "is not a file");
    write_bytes(path, "", 0);
    expect_refusal(path, GM_ERR_FORMAT, "it is empty");
    write_bytes(path, letter, sizeof letter);
    expect_refusal(path, GM_ERR_FORMAT, "is not an SQLite file");
    gm_map_destroy(map);
}

/* Change the finished map by SQL and expect a refusal that says the words. */
static void expect_refusal_after(const char *sql, const char *words)
{
    sqlite3 *db;
    gm_map *map = fixture_map(&fixture_full);
    write_map(map);
    assert_int_equal(sqlite3_open(path, &db), SQLITE_OK);
    (void)sqlite3_exec(db, "PRAGMA ignore_check_constraints = 1", NULL, NULL, NULL);
    if (sqlite3_exec(db, sql, NULL, NULL, NULL) != SQLITE_OK)
        fail_msg("%s: %s", sql, sqlite3_errmsg(db));
    (void)sqlite3_close(db);
    expect_refusal(path, GM_ERR_FORMAT, words);
    gm_map_destroy(map);
}

static void changed_content_is_refused(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"PRAGMA user_version = 2", "is a map of format 2, but this version of Gearmap "
                                    "reads format 1"},
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
    write_map(map);
    assert_int_equal(sqlite3_open(path, &db), SQLITE_OK);
    assert_int_equal(sqlite3_exec(db,
                                  "CREATE TABLE my_notes (x); INSERT INTO my_notes "
                                  "VALUES (1); DROP VIEW v_drag",
                                  NULL, NULL, NULL),
                     SQLITE_OK);
    (void)sqlite3_close(db);
    gm_map *copy = read_map(path);
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
    gm_status status = gm_map_read(path, &copy, &error);
    if (status == GM_OK) {
        assert_true(fixture_equal(map, copy));
        assert_string_equal(map->tool_version, copy->tool_version);
    } else {
        assert_null(copy);
        assert_non_null(strstr(error.message, path));
    }
    gm_map_destroy(copy);
    return status == GM_OK;
}

static void truncated_map_is_refused(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    size_t size;
    write_map(map);
    unsigned char *bytes = read_bytes(path, &size);
    for (int n = 0; n < 300; n++) {
        size_t length =
            n < 100 ? (size_t)n + 1 : size - 1 - (size - 1) * (size_t)(n - 100) / 200;
        write_bytes(path, bytes, length);
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
    write_map(map);
    unsigned char *bytes = read_bytes(path, &size);
    for (int n = 0; n < flips; n++) {
        /* one bit; every tenth time a damaged block */
        size_t at = (size_t)((double)size * fixture_random(&random));
        size_t end = n % 10 == 0 ? at + 40 : at + 1;
        FILE *file = NULL;
        if (n == 0)
            write_bytes(path, bytes, size);
        file = fopen(path, "r+b");
        assert_non_null(file);
        for (size_t i = at; i < end && i < size; i++) {
            int bit = 1 << (int)(8.0 * fixture_random(&random));
            assert_int_equal(fseek(file, (long)i, SEEK_SET), 0);
            assert_true(fputc(bytes[i] ^ bit, file) != EOF);
        }
        assert_int_equal(fclose(file), 0);
        read += read_damaged(map);
        file = fopen(path, "r+b");
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
    write_map(map);
    unsigned char *bytes = read_bytes(path, &size), number[8];
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
            write_bytes(path, bytes, size);
            assert_int_equal(gm_map_read(path, &copy, NULL), GM_ERR_FORMAT);
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
    write_map(map);
    for (long k = 1; status == GM_ERR_MEMORY; k++, failures++) {
        assert_null(copy);
        gm_alloc_fail_after(k);
        status = gm_map_read(path, &copy, NULL);
        gm_alloc_fail_after(0);
    }
    assert_int_equal(status, GM_OK);
    assert_true(failures > map->n_tables);
    assert_true(fixture_equal(map, copy));
    gm_map_destroy(map);
    gm_map_destroy(copy);
}

/* SQLite's own memory: under each limit the map is read or the answer is a status. */
static void sqlite_without_memory_is_a_status(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full), *copy = NULL;
    int failures = 0;
    write_map(map);
    for (sqlite3_int64 limit = 1000; !copy && limit < 4000000; limit += limit / 20) {
        gm_journal *journal = NULL;
        (void)sqlite3_hard_heap_limit64(sqlite3_memory_used() + limit);
        gm_status status = gm_map_read(path, &copy, NULL);
        gm_error error = {0};
        gm_status opened = gm_journal_open(path, map, &journal, &error);
        (void)sqlite3_hard_heap_limit64(0);
        assert_true(status == GM_OK || status == GM_ERR_MEMORY);
        if (opened != GM_OK && opened != GM_ERR_MEMORY)
            fail_msg("%d: %s", (int)opened, error.message);
        failures += status != GM_OK;
        gm_journal_close(journal, false);
        assert_true(only(path));
    }
    assert_true(failures > 5);
    assert_non_null(copy);
    assert_true(fixture_equal(map, copy));
    gm_map_destroy(map);
    gm_map_destroy(copy);
}

static void allocation_failures_while_writing(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    int rows = total_rows(map);
    gm_journal *journal = NULL;
    gm_status status = GM_ERR_MEMORY;
    for (long k = 1; status == GM_ERR_MEMORY; k++) {
        gm_alloc_fail_after(k);
        status = gm_journal_open(path, map, &journal, NULL);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || only(NULL));
    }
    assert_int_equal(status, GM_OK);
    put_rows(journal, map, 0, rows);
    status = GM_ERR_MEMORY;
    for (long k = 1; status == GM_ERR_MEMORY; k++) {
        gm_alloc_fail_after(k);
        status = gm_journal_finish(journal, map, NULL);
        gm_alloc_fail_after(0);
        if (status == GM_OK)
            break;
        assert_int_equal(status, GM_ERR_MEMORY);
        assert_true(only(part)); /* all rows are kept */
        journal = open_journal(map);
        assert_int_equal(gm_journal_resumed(journal), rows);
    }
    gm_map *copy = read_map(path);
    assert_true(fixture_equal(map, copy));
    gm_map_destroy(map);
    gm_map_destroy(copy);
}

#define CASE(name) cmocka_unit_test_setup_teardown(name, make_folder, remove_folder)

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(round_trip_gives_equal_bits),
        CASE(order_of_rows_does_not_matter),
        CASE(resumes_what_was_kept),
        CASE(kill_loses_no_finished_row),
        CASE(journal_of_another_sweep_is_replaced),
        CASE(damaged_journal_is_begun_anew),
        CASE(empty_journal_is_taken_and_foreign_file_left_alone),
        CASE(foreign_database_is_left_alone),
        CASE(second_sweep_is_refused),
        CASE(finish_needs_every_row_and_number),
        CASE(finish_writes_what_changed_after_put),
        CASE(put_refuses_what_is_no_row),
        CASE(unwritable_places_are_refused),
        CASE(old_map_stays_until_the_new_one_is_whole),
        CASE(files_that_are_no_maps_are_named),
        CASE(changed_content_is_refused),
        CASE(tables_of_a_user_do_not_matter),
        CASE(truncated_map_is_refused),
        CASE(flipped_bits_never_give_another_map),
        CASE(every_bit_of_a_value_counts),
        CASE(allocation_failures_while_reading),
        CASE(sqlite_without_memory_is_a_status),
        CASE(allocation_failures_while_writing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
