/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The journal: rows survive a kill, sweeps resume, places are checked.
 */
#include "file_fixture.h"
#include "map_fixture.h"

#include "base/alloc.h"

#include <math.h>
#include <setjmp.h>
#include <signal.h>
#include <sqlite3.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

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
        file_write_map(map);
        assert_false(signbit(map->tables[0].value[3]));
        assert_true(file_only(file_path));
        gm_map *copy = file_read_map(file_path);
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
    file_write_map(map);
    memcpy(hash, map->content_hash, sizeof hash);
    gm_journal *journal = file_journal(map);
    for (int n = file_rows(map) - 1; n >= 0; n--)
        file_put_rows(journal, map, n, n + 1);
    file_finish(journal, map);
    assert_string_equal(hash, map->content_hash);
    gm_map *copy = file_read_map(file_path);
    assert_true(fixture_equal(map, copy));
    gm_map_destroy(map);
    gm_map_destroy(copy);
}

/* Open again with an empty frame: the first n rows, and only they, must be there. */
static gm_journal *expect_resumed(gm_map *frame, const gm_map *map, int n)
{
    gm_journal *journal = file_journal(frame);
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
    int n = file_rows(map);
    gm_journal *journal = file_journal(map);
    assert_int_equal(gm_journal_resumed(journal), 0);
    file_put_rows(journal, map, 0, n / 3);
    gm_journal_close(journal, true);
    assert_true(file_only(file_part));
    journal = expect_resumed(frame, map, n / 3);
    fixture_fill(frame, map);
    file_put_rows(journal, frame, n / 3, n);
    file_finish(journal, frame);
    assert_true(file_only(file_path));
    gm_map *copy = file_read_map(file_path);
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
        if (gm_journal_open(file_path, map, &journal, NULL) != GM_OK)
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
    int n = file_rows(map);
    for (int wait = 1; wait < n; wait += n / 7) {
        gm_map *frame = fixture_frame(&fixture_full);
        int told = kill_while_putting(map, wait);
        gm_journal *journal = file_journal(frame);
        int resumed = gm_journal_resumed(journal);
        assert_true(resumed == told || resumed == told + 1); /* killed before telling */
        gm_journal_close(journal, true);
        gm_map_destroy(frame);
        frame = fixture_frame(&fixture_full);
        journal = expect_resumed(frame, map, resumed);
        gm_journal_close(journal, false);
        assert_true(file_only(NULL));
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
        gm_journal *journal = file_journal(map);
        file_put_rows(journal, map, 0, 9);
        gm_journal_close(journal, true);
        texts[i][0] ^= 1;
        journal = expect_resumed(frame, map, 0);
        gm_journal_close(journal, true);
        journal = expect_resumed(frame, map, 0);
        gm_journal_close(journal, false);
        assert_true(file_only(NULL));
        texts[i][0] ^= 1;
    }
    gm_map_destroy(map);
    gm_map_destroy(frame);
}

static void damaged_journal_is_begun_anew(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full), *frame = fixture_frame(&fixture_full);
    uint64_t random = 5;
    size_t size;
    gm_journal *journal = file_journal(map);
    file_put_rows(journal, map, 0, 40);
    gm_journal_close(journal, true);
    unsigned char *bytes = file_read_bytes(file_part, &size);
    for (int n = 0; n < 40; n++) {
        unsigned char *bad = gm_calloc(size, 1);
        size_t end =
            n % 2 ? size : 100 + (size_t)((double)size * fixture_random(&random));
        memcpy(bad, bytes, size);
        for (size_t i = 100; i < size; i += 1 + (size_t)(300.0 * fixture_random(&random)))
            bad[i] ^= 0x5a;
        file_write_bytes(file_part, bad, end < size ? end : size);
        journal = expect_resumed(frame, map, 0);
        file_put_rows(journal, map, 0, 3);
        gm_journal_close(journal, true);
        journal = expect_resumed(frame, map, 3);
        gm_journal_close(journal, false);
        for (int t = 0; t < frame->n_tables; t++)
            memset(frame->tables[t].value, 0,
                   (size_t)gm_map_table_size(&frame->tables[t]) * sizeof(double));
        assert_true(file_only(NULL));
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
    file_write_bytes(file_part, "", 0);
    journal = file_journal(map);
    gm_journal_close(journal, false);
    assert_true(file_only(NULL));
    file_write_bytes(file_part, letter, sizeof letter);
    assert_int_not_equal(gm_journal_open(file_path, map, &journal, &error), GM_OK);
    unsigned char *bytes = file_read_bytes(file_part, &size);
    assert_int_equal(size, sizeof letter);
    assert_memory_equal(bytes, letter, size);
    assert_non_null(strstr(error.message, file_part));
    assert_true(file_only(file_part));
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
    assert_int_equal(sqlite3_open(file_part, &db), SQLITE_OK);
    assert_int_equal(sqlite3_exec(db, "CREATE TABLE letters (x)", NULL, NULL, NULL), 0);
    (void)sqlite3_close(db);
    file_expect_refusal(file_part, GM_ERR_FORMAT, "of another kind");
    assert_int_equal(gm_journal_open(file_path, map, &journal, &error), GM_ERR_IO);
    assert_non_null(strstr(error.message, "in the way"));
    assert_true(file_only(file_part));
    gm_map_destroy(map);
}

static void second_sweep_is_refused(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full), *other = fixture_map(&fixture_full);
    gm_journal *journal = file_journal(map), *second = NULL;
    int result = 0;
    file_put_rows(journal, map, 0, 5);
    gm_error error = {0};
    assert_int_equal(gm_journal_open(file_path, other, &second, &error), GM_ERR_IO);
    assert_non_null(strstr(error.message, "another sweep is writing it"));
    assert_null(second);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0)
        _exit(gm_journal_open(file_path, other, &second, NULL) == GM_ERR_IO ? 7 : 1);
    assert_int_equal(waitpid(child, &result, 0), child);
    assert_true(WIFEXITED(result) && WEXITSTATUS(result) == 7);
    file_put_rows(journal, map, 5, file_rows(map)); /* undisturbed */
    file_finish(journal, map);
    gm_map *copy = file_read_map(file_path);
    assert_true(fixture_equal(map, copy));
    gm_map_destroy(map);
    gm_map_destroy(other);
    gm_map_destroy(copy);
}

static void finish_needs_every_row_and_number(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    int n = file_rows(map);
    gm_error error = {0};
    gm_journal *journal = file_journal(map);
    file_put_rows(journal, map, 0, n - 2);
    assert_int_equal(gm_journal_finish(journal, map, &error), GM_ERR_ARGUMENT);
    assert_non_null(strstr(error.message, "2 rows"));
    assert_string_equal(map->content_hash, "");
    assert_true(file_only(file_part)); /* nothing is lost, nothing has the final name */
    journal = file_journal(map);
    assert_int_equal(gm_journal_resumed(journal), n - 2);
    file_put_rows(journal, map, n - 2, n);
    map->paths[0].inertia = 0.0;
    assert_int_equal(gm_journal_finish(journal, map, &error), GM_ERR_FORMAT);
    assert_true(file_only(file_part));
    map->paths[0].inertia = 0.1;
    journal = file_journal(map);
    assert_int_equal(gm_journal_resumed(journal), n);
    file_finish(journal, map);
    assert_true(file_only(file_path));
    gm_map_destroy(map);
}

static void finish_writes_what_changed_after_put(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    gm_journal *journal = file_journal(map);
    file_put_rows(journal, map, 0, file_rows(map));
    map->tables[5].value[3] += 1.0;
    map->tables[map->n_tables - 1].value[0] = 0.25;
    file_finish(journal, map);
    gm_map *copy = file_read_map(file_path);
    assert_true(fixture_equal(map, copy));
    gm_map_destroy(map);
    gm_map_destroy(copy);
}

static void put_refuses_what_is_no_row(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    gm_journal *journal = file_journal(map);
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
    assert_true(file_only(NULL));
    gm_map_destroy(map);
}

static void unwritable_places_are_refused(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    char file[128], below[200], missing[128];
    (void)snprintf(file, sizeof file, "%s/plain", file_folder);
    (void)snprintf(below, sizeof below, "%s/x.map", file);
    (void)snprintf(missing, sizeof missing, "%s/none/x.map", file_folder);
    file_write_bytes(file, "x", 1);
    const char *places[] = {file_folder, below, missing, "", "/dev/null", "/proc/x.map"};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        gm_journal *journal = NULL;
        gm_error error = {0};
        assert_int_equal(gm_journal_open(places[i], map, &journal, &error), GM_ERR_IO);
        assert_null(journal);
        assert_true(strlen(error.message) > 20);
        assert_true(file_only(file));
    }
    if (geteuid() != 0) { /* root may write anywhere */
        gm_journal *journal = NULL;
        assert_int_equal(unlink(file), 0);
        assert_int_equal(chmod(file_folder, 0500), 0);
        assert_int_equal(gm_journal_open(file_path, map, &journal, NULL), GM_ERR_IO);
        assert_int_equal(chmod(file_folder, 0700), 0);
        assert_true(file_only(NULL));
    }
    gm_map_destroy(map);
}

static void old_map_stays_until_the_new_one_is_whole(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    file_write_map(map);
    gm_map *next = fixture_map(&fixture_full);
    next->inertia_output = 0.5;
    strcpy(next->options, "other");
    gm_journal *journal = file_journal(next);
    file_put_rows(journal, next, 0, 20);
    gm_map *copy = file_read_map(file_path);
    assert_true(fixture_equal(map, copy));
    gm_map_destroy(copy);
    file_put_rows(journal, next, 20, file_rows(next));
    file_finish(journal, next);
    copy = file_read_map(file_path);
    assert_true(fixture_equal(next, copy));
    gm_map_destroy(map);
    gm_map_destroy(next);
    gm_map_destroy(copy);
}

/* SQLite's own memory: under each limit the map is read or the answer is a status. */
static void sqlite_without_memory_is_a_status(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full), *copy = NULL;
    int failures = 0;
    file_write_map(map);
    for (sqlite3_int64 limit = 1000; !copy && limit < 4000000; limit += limit / 20) {
        gm_journal *journal = NULL;
        (void)sqlite3_hard_heap_limit64(sqlite3_memory_used() + limit);
        gm_status status = gm_map_read(file_path, &copy, NULL);
        gm_error error = {0};
        gm_status opened = gm_journal_open(file_path, map, &journal, &error);
        (void)sqlite3_hard_heap_limit64(0);
        assert_true(status == GM_OK || status == GM_ERR_MEMORY);
        if (opened != GM_OK && opened != GM_ERR_MEMORY)
            fail_msg("%d: %s", (int)opened, error.message);
        failures += status != GM_OK;
        gm_journal_close(journal, false);
        assert_true(file_only(file_path));
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
    int rows = file_rows(map);
    gm_journal *journal = NULL;
    gm_status status = GM_ERR_MEMORY;
    for (long k = 1; status == GM_ERR_MEMORY; k++) {
        gm_alloc_fail_after(k);
        status = gm_journal_open(file_path, map, &journal, NULL);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || file_only(NULL));
    }
    assert_int_equal(status, GM_OK);
    file_put_rows(journal, map, 0, rows);
    status = GM_ERR_MEMORY;
    for (long k = 1; status == GM_ERR_MEMORY; k++) {
        gm_alloc_fail_after(k);
        status = gm_journal_finish(journal, map, NULL);
        gm_alloc_fail_after(0);
        if (status == GM_OK)
            break;
        assert_int_equal(status, GM_ERR_MEMORY);
        assert_true(file_only(file_part)); /* all rows are kept */
        journal = file_journal(map);
        assert_int_equal(gm_journal_resumed(journal), rows);
    }
    gm_map *copy = file_read_map(file_path);
    assert_true(fixture_equal(map, copy));
    gm_map_destroy(map);
    gm_map_destroy(copy);
}

#define CASE(name) cmocka_unit_test_setup_teardown(name, file_setup, file_teardown)

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
        CASE(sqlite_without_memory_is_a_status),
        CASE(allocation_failures_while_writing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
