/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The journal: records survive a kill, sweeps resume, places are checked.
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

static void same_map_gives_the_same_bytes(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    size_t size[2];
    unsigned char *bytes[2];
    for (int i = 0; i < 2; i++) {
        gm_journal *journal = file_journal(map);
        file_put(journal, 0, i ? 50 : 7);
        file_finish(journal, map);
        assert_true(file_only(file_path));
        bytes[i] = file_read_bytes(file_path, &size[i]);
    }
    assert_int_equal(size[0], size[1]);
    assert_memory_equal(bytes[0], bytes[1], size[0]);
    gm_free(bytes[0]);
    gm_free(bytes[1]);
    gm_map_destroy(map);
}

static void resumes_what_was_kept(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    gm_journal *journal = file_journal(map);
    file_expect_records(journal, 0);
    file_put(journal, 0, 100);
    gm_journal_close(journal, true);
    assert_true(file_only(file_part));
    journal = file_journal(map);
    file_expect_records(journal, 100);
    file_put(journal, 100, 1000);
    gm_journal_close(journal, true);
    journal = file_journal(map);
    file_expect_records(journal, 1000);
    file_finish(journal, map);
    assert_true(file_only(file_path));
    gm_map *copy = file_read_map(file_path);
    assert_true(fixture_equal(map, copy));
    gm_map_destroy(map);
    gm_map_destroy(copy);
}

/* A child puts blocks and tells each one when put returned; it is killed in the middle.
 *  Every block that it told of must be there, whole. */
static int kill_while_putting(const gm_map *map, int blocks_to_wait_for)
{
    int ends[2], told = 0;
    char byte;
    assert_int_equal(pipe(ends), 0);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        gm_journal *journal = file_journal(map);
        for (int n = 0;; n += 3) {
            file_put(journal, n, n + 3);
            if (write(ends[1], "b", 1) != 1)
                _exit(1);
        }
    }
    (void)close(ends[1]);
    while (told < blocks_to_wait_for && read(ends[0], &byte, 1) == 1)
        told++;
    assert_int_equal(kill(child, SIGKILL), 0);
    assert_int_equal(waitpid(child, NULL, 0), child);
    while (read(ends[0], &byte, 1) == 1)
        told++;
    (void)close(ends[0]);
    return told;
}

static void kill_loses_no_record(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    for (int wait = 1; wait < 3000; wait = 3 * wait + 1) {
        int told = kill_while_putting(map, wait);
        long count;
        gm_journal *journal = file_journal(map);
        (void)gm_journal_records(journal, &count);
        assert_true(count == 3 * told || count == 3 * told + 3); /* before telling */
        file_expect_records(journal, (int)count);
        gm_journal_close(journal, true);
        journal = file_journal(map);
        file_expect_records(journal, (int)count);
        gm_journal_close(journal, false);
        assert_true(file_only(NULL));
    }
    gm_map_destroy(map);
}

static void journal_of_another_sweep_is_replaced(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full), *other = fixture_frame(&fixture_full);
    char *texts[] = {other->options, other->input_sha256, other->tool_version,
                     other->paths[0].name};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        gm_journal *journal = file_journal(map);
        file_put(journal, 0, 9);
        gm_journal_close(journal, true);
        texts[i][0] ^= 1;
        for (int k = 0; k < 2; k++) {
            journal = file_journal(other);
            file_expect_records(journal, 0);
            gm_journal_close(journal, k == 0);
        }
        assert_true(file_only(NULL));
        texts[i][0] ^= 1;
    }
    gm_map_destroy(map);
    gm_map_destroy(other);
}

/* The axes are no part of it: points are what they are. The size of a record is. */
static void records_of_another_size_are_not_taken(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    gm_journal *journal = file_journal(map);
    long count = -1;
    file_put(journal, 0, 9);
    gm_journal_close(journal, true);
    assert_int_equal(gm_journal_open(file_path, map, 8, &journal, NULL), GM_OK);
    (void)gm_journal_records(journal, &count);
    assert_int_equal(count, 0);
    gm_journal_close(journal, false);
    assert_int_equal(gm_journal_open(file_path, map, 0, &journal, NULL), GM_ERR_ARGUMENT);
    assert_int_equal(gm_journal_open(file_path, map, 5000, &journal, NULL),
                     GM_ERR_ARGUMENT);
    assert_true(file_only(NULL));
    gm_map_destroy(map);
}

static void damaged_journal_is_begun_anew(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    uint64_t random = 5;
    size_t size;
    gm_journal *journal = file_journal(map);
    file_put(journal, 0, 4000);
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
        journal = file_journal(map);
        file_expect_records(journal, 0);
        file_put(journal, 0, 3);
        gm_journal_close(journal, true);
        journal = file_journal(map);
        file_expect_records(journal, 3);
        gm_journal_close(journal, false);
        assert_true(file_only(NULL));
        gm_free(bad);
    }
    gm_free(bytes);
    gm_map_destroy(map);
}

/* One wrong byte in a record is no damage that SQLite notices. */
static void a_flipped_bit_in_a_record_is_noticed(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    const file_record wanted = {700, 0.1 * 700.0};
    size_t size, at = 0;
    gm_journal *journal = file_journal(map);
    file_put(journal, 0, 1000);
    gm_journal_close(journal, true);
    unsigned char *bytes = file_read_bytes(file_part, &size);
    while (at + sizeof wanted <= size && memcmp(bytes + at, &wanted, sizeof wanted) != 0)
        at++;
    assert_true(at + sizeof wanted <= size);
    bytes[at + 9] ^= 4;
    file_write_bytes(file_part, bytes, size);
    journal = file_journal(map);
    file_expect_records(journal, 0);
    gm_journal_close(journal, false);
    gm_free(bytes);
    gm_map_destroy(map);
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
    assert_int_not_equal(
        gm_journal_open(file_path, map, sizeof(file_record), &journal, &error), GM_OK);
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
    assert_int_equal(
        gm_journal_open(file_path, map, sizeof(file_record), &journal, &error),
        GM_ERR_IO);
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
    file_put(journal, 0, 5);
    gm_error error = {0};
    assert_int_equal(
        gm_journal_open(file_path, other, sizeof(file_record), &second, &error),
        GM_ERR_IO);
    assert_non_null(strstr(error.message, "another sweep is writing it"));
    assert_null(second);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0)
        _exit(gm_journal_open(file_path, other, sizeof(file_record), &second, NULL) ==
                      GM_ERR_IO
                  ? 7
                  : 1);
    assert_int_equal(waitpid(child, &result, 0), child);
    assert_true(WIFEXITED(result) && WEXITSTATUS(result) == 7);
    file_put(journal, 5, 50); /* undisturbed */
    file_finish(journal, map);
    gm_map *copy = file_read_map(file_path);
    assert_true(fixture_equal(map, copy));
    gm_map_destroy(map);
    gm_map_destroy(other);
    gm_map_destroy(copy);
}

static void finish_needs_a_complete_map(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    gm_error error = {0};
    gm_journal *journal = file_journal(map);
    file_put(journal, 0, 20);
    map->paths[0].inertia = 0.0;
    assert_int_equal(gm_journal_finish(journal, map, &error), GM_ERR_FORMAT);
    assert_string_equal(map->content_hash, "");
    assert_true(file_only(file_part)); /* nothing is lost, nothing has the final name */
    map->paths[0].inertia = 0.1;
    journal = file_journal(map);
    file_expect_records(journal, 20);
    file_finish(journal, map);
    assert_true(file_only(file_path));
    gm_map_destroy(map);
}

static void closing_nothing_is_fine(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    gm_journal *journal = file_journal(map);
    assert_int_equal(gm_journal_put(journal, NULL, 0, NULL), GM_OK);
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
        assert_int_equal(
            gm_journal_open(places[i], map, sizeof(file_record), &journal, &error),
            GM_ERR_IO);
        assert_null(journal);
        assert_true(strlen(error.message) > 20);
        assert_true(file_only(file));
    }
    if (geteuid() != 0) { /* root may write anywhere */
        gm_journal *journal = NULL;
        assert_int_equal(unlink(file), 0);
        assert_int_equal(chmod(file_folder, 0500), 0);
        assert_int_equal(
            gm_journal_open(file_path, map, sizeof(file_record), &journal, NULL),
            GM_ERR_IO);
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
    file_put(journal, 0, 20);
    gm_map *copy = file_read_map(file_path);
    assert_true(fixture_equal(map, copy));
    gm_map_destroy(copy);
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
        gm_status opened =
            gm_journal_open(file_path, map, sizeof(file_record), &journal, &error);
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
    gm_journal *journal = NULL;
    gm_status status = GM_ERR_MEMORY;
    for (long k = 1; status == GM_ERR_MEMORY; k++) {
        gm_alloc_fail_after(k);
        status = gm_journal_open(file_path, map, sizeof(file_record), &journal, NULL);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || file_only(NULL));
    }
    assert_int_equal(status, GM_OK);
    file_put(journal, 0, 100);
    status = GM_ERR_MEMORY;
    for (long k = 1; status == GM_ERR_MEMORY; k++) {
        gm_alloc_fail_after(k);
        status = gm_journal_finish(journal, map, NULL);
        gm_alloc_fail_after(0);
        if (status == GM_OK)
            break;
        assert_int_equal(status, GM_ERR_MEMORY);
        assert_true(file_only(file_part)); /* all records are kept */
        journal = file_journal(map);
        file_expect_records(journal, 100);
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
        CASE(same_map_gives_the_same_bytes),
        CASE(resumes_what_was_kept),
        CASE(kill_loses_no_record),
        CASE(journal_of_another_sweep_is_replaced),
        CASE(records_of_another_size_are_not_taken),
        CASE(damaged_journal_is_begun_anew),
        CASE(a_flipped_bit_in_a_record_is_noticed),
        CASE(empty_journal_is_taken_and_foreign_file_left_alone),
        CASE(foreign_database_is_left_alone),
        CASE(second_sweep_is_refused),
        CASE(finish_needs_a_complete_map),
        CASE(closing_nothing_is_fine),
        CASE(unwritable_places_are_refused),
        CASE(old_map_stays_until_the_new_one_is_whole),
        CASE(sqlite_without_memory_is_a_status),
        CASE(allocation_failures_while_writing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
