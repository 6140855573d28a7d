/* SPDX-License-Identifier: BSD-2-Clause
 *
 * gm_bake_fmu2: same bytes, and nothing left behind whatever fails.
 */
#include "bake/gm_bake.h"

#include "base/alloc.h"
#include "base/sha256.h"
#include "example_map.h"
#include "plant/gm_fmu.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

static const gm_bake_options usual = {.share = GM_BINARY_DIR "/share/gearmap"};

/* Each test has its own folder; temporary files go there too, so that leftovers show. */
typedef struct place {
    char folder[64], target[96];
    gm_map *map;
} place;

static int make_place(void **state)
{
    place *at = calloc(1, sizeof *at);
    assert_non_null(at);
    strcpy(at->folder, "/tmp/test_bake-XXXXXX");
    assert_non_null(mkdtemp(at->folder));
    assert_int_equal(setenv("TMPDIR", at->folder, 1), 0);
    unsetenv("CC");
    snprintf(at->target, sizeof at->target, "%s/example.fmu", at->folder);
    at->map = example_map(2);
    *state = at;
    return 0;
}

/* Number of entries in the folder; removes them when asked. */
static int entries(const place *at, int remove_them)
{
    DIR *directory = opendir(at->folder);
    struct dirent *entry;
    int n = 0;
    assert_non_null(directory);
    while ((entry = readdir(directory)) != NULL) {
        char path[512];
        if (entry->d_name[0] == '.' && strlen(entry->d_name) < 3)
            continue;
        n++;
        snprintf(path, sizeof path, "%s/%s", at->folder, entry->d_name);
        if (remove_them)
            assert_int_equal(remove(path), 0);
    }
    closedir(directory);
    return n;
}

static int remove_place(void **state)
{
    place *at = *state;
    entries(at, 1);
    assert_int_equal(rmdir(at->folder), 0);
    gm_map_destroy(at->map);
    free(at);
    return 0;
}

static void assert_fails(const place *at, const gm_bake_options *options,
                         gm_status expected, const char *word)
{
    gm_error error = {GM_OK, ""};
    gm_bake_summary summary = {.file_size = -7};
    gm_status status = gm_bake_fmu2(at->map, options, at->target, &summary, &error);
    assert_int_equal(status, expected);
    if (!strstr(error.message, word))
        fail_msg("\"%s\" does not say \"%s\"", error.message, word);
    assert_int_equal(summary.file_size, -7);
    assert_int_equal(entries(at, 0), 0);
}

static void the_same_map_gives_the_same_bytes(void **state)
{
    place *at = *state;
    char first[GM_SHA256_TEXT], second[GM_SHA256_TEXT];
    gm_bake_summary summary;
    gm_error error;
    struct stat info;
    assert_int_equal(gm_bake_fmu2(at->map, &usual, at->target, &summary, &error), GM_OK);
    assert_int_equal(gm_sha256_file(at->target, first, &error), GM_OK);
    assert_int_equal(stat(at->target, &info), 0);
    assert_int_equal(summary.file_size, info.st_size);
    assert_true(summary.file_size < 2 * 1024 * 1024);
    mode_t mask = umask(022);
    (void)umask(mask);
    assert_int_equal(info.st_mode & 0777, 0666 & ~mask);
    assert_int_equal(gm_bake_fmu2(at->map, &usual, at->target, NULL, &error), GM_OK);
    assert_int_equal(gm_sha256_file(at->target, second, &error), GM_OK);
    assert_string_equal(first, second);
    assert_int_equal(entries(at, 0), 1);
}

static void another_map_gives_another_guid(void **state)
{
    place *at = *state;
    gm_bake_summary before, after;
    gm_error error;
    assert_int_equal(gm_bake_fmu2(at->map, &usual, at->target, &before, &error), GM_OK);
    at->map->inertia_output = 0.1000000001;
    assert_int_equal(gm_bake_fmu2(at->map, &usual, at->target, &after, &error), GM_OK);
    assert_int_equal(strlen(after.guid), 38);
    assert_string_not_equal(before.guid, after.guid);
}

static void a_missing_compiler_is_named(void **state)
{
    gm_bake_options options = usual;
    options.compiler = "/nowhere/cc";
    assert_fails(*state, &options, GM_ERR_TOOL, "/nowhere/cc");
    assert_int_equal(setenv("CC", "no-such-compiler -O3", 1), 0);
    assert_fails(*state, &usual, GM_ERR_TOOL, "no-such-compiler -O3");
    unsetenv("CC");
}

static void without_any_compiler_the_tried_names_are_told(void **state)
{
    char *path = getenv("PATH"), *kept = path ? strdup(path) : NULL;
    assert_non_null(kept);
    setenv("PATH", "/nowhere:", 1);
    assert_fails(*state, &usual, GM_ERR_TOOL, "cc, gcc, clang");
    setenv("PATH", kept, 1);
    free(kept);
}

static void a_failing_compiler_is_quoted(void **state)
{
    gm_bake_options options = usual;
    options.compiler = "false";
    assert_fails(*state, &options, GM_ERR_TOOL, "failed with code 1 and said nothing");
    options.compiler = "true";
    assert_fails(*state, &options, GM_ERR_TOOL, "wrote no library");
    assert_int_equal(setenv("CC", "cc --no-such-option", 1), 0);
    assert_fails(*state, &usual, GM_ERR_TOOL, "no-such-option");
    unsetenv("CC");
}

static void arguments_of_the_environments_compiler_are_used(void **state)
{
    place *at = *state;
    gm_error error;
    assert_int_equal(setenv("CC", "  cc  -g0   -O1 ", 1), 0);
    assert_int_equal(gm_bake_fmu2(at->map, &usual, at->target, NULL, &error), GM_OK);
    unsetenv("CC");
}

static void arguments_of_the_given_compiler_are_used(void **state)
{
    place *at = *state;
    gm_bake_options options = usual;
    gm_error error;
    options.compiler = " cc -g0 ";
    assert_int_equal(gm_bake_fmu2(at->map, &options, at->target, NULL, &error), GM_OK);
    entries(at, 1);
    options.compiler = "cc --no-such-option";
    assert_fails(at, &options, GM_ERR_TOOL, "no-such-option");
    options.compiler = " ";
    assert_fails(at, &options, GM_ERR_TOOL, "not an executable program");
}

static void missing_sources_are_named(void **state)
{
    gm_bake_options options = {.share = "/nowhere/share"};
    assert_fails(*state, &options, GM_ERR_IO, "/nowhere/share/core");
    options.share = NULL;
    assert_fails(*state, &options, GM_ERR_ARGUMENT, "sources");
}

static void an_unwritable_target_is_refused_before_the_work(void **state)
{
    place *at = *state;
    gm_bake_options options = {.share = "/nowhere", .compiler = "/nowhere"};
    snprintf(at->target, sizeof at->target, "/nowhere/folder/a.fmu");
    assert_fails(at, &options, GM_ERR_IO, "/nowhere/folder/a.fmu");
    snprintf(at->target, sizeof at->target, "%s", at->folder);
    assert_fails(at, &options, GM_ERR_IO, "not a file");
}

static void names_that_are_no_words_are_refused(void **state)
{
    place *at = *state;
    strcpy(at->map->paths[1].name, "e\"; exit");
    assert_fails(at, &usual, GM_ERR_FORMAT, "lower-case word");
    strcpy(at->map->paths[1].name, "output");
    assert_fails(at, &usual, GM_ERR_FORMAT, "output");
}

static void an_incomplete_map_is_refused(void **state)
{
    place *at = *state;
    at->map->paths[0].inertia = -1;
    assert_fails(at, &usual, GM_ERR_FORMAT, "inertia");
}

static void foreign_texts_cannot_break_the_description(void **state)
{
    place *at = *state;
    gm_error error;
    memcpy(at->map->title, "\xff\xfe \x01 <&\"]]> */ \\", 17);
    memset(at->map->name, 'x', GM_MAP_TEXT - 1);
    memcpy(at->map->input_sha256, "*/ #error", 10);
    assert_int_equal(gm_bake_fmu2(at->map, &usual, at->target, NULL, &error), GM_OK);
    gm_fmu *fmu = NULL; /* reads the XML and loads what was compiled */
    if (gm_fmu_open(at->target, &fmu, &error) != GM_OK)
        fail_msg("%s", error.message);
    gm_fmu_close(fmu);
}

static gm_status bake_with_failure(const place *at, int k, const char *compiler)
{
    gm_bake_options options = usual;
    gm_error error;
    options.compiler = compiler;
    gm_alloc_fail_after(k);
    gm_status status = gm_bake_fmu2(at->map, &options, at->target, NULL, &error);
    gm_alloc_fail_after(0);
    assert_int_equal(entries(at, 0), status == GM_OK);
    return status;
}

/* The k-th allocation fails: all up to the compiler (one that makes no library, since
 * that is quick), and some after it. */
static void only_paths_with_springs_may_be_given(void **state)
{
    place *at = *state;
    gm_bake_options options = usual;
    options.speed_in = "odd";
    at->map->paths[0].gears[1].stiffness = 0.0;
    assert_fails(at, &options, GM_ERR_ARGUMENT, "odd can be no input: its gear 3");
    options.speed_in = "input";
    assert_fails(at, &options, GM_ERR_ARGUMENT, "only odd, even, output");
    options.speed_in = "";
    assert_fails(at, &options, GM_ERR_ARGUMENT, "no flange \"\"");
}

static void failed_allocations_leave_nothing(void **state)
{
    place *at = *state;
    gm_status status = GM_ERR_MEMORY;
    int k = 0;
    while (status == GM_ERR_MEMORY && k < 2000)
        status = bake_with_failure(at, ++k, "true");
    assert_int_equal(status, GM_ERR_TOOL);
    assert_true(k > 100);
    for (status = GM_ERR_MEMORY; status == GM_ERR_MEMORY && k < 2000; k += 6)
        status = bake_with_failure(at, k, NULL);
    assert_int_equal(status, GM_OK);
}

#define IN_PLACE(test) cmocka_unit_test_setup_teardown(test, make_place, remove_place)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_PLACE(the_same_map_gives_the_same_bytes),
        IN_PLACE(another_map_gives_another_guid),
        IN_PLACE(a_missing_compiler_is_named),
        IN_PLACE(without_any_compiler_the_tried_names_are_told),
        IN_PLACE(a_failing_compiler_is_quoted),
        IN_PLACE(arguments_of_the_environments_compiler_are_used),
        IN_PLACE(arguments_of_the_given_compiler_are_used),
        IN_PLACE(missing_sources_are_named),
        IN_PLACE(an_unwritable_target_is_refused_before_the_work),
        IN_PLACE(names_that_are_no_words_are_refused),
        IN_PLACE(an_incomplete_map_is_refused),
        IN_PLACE(foreign_texts_cannot_break_the_description),
        IN_PLACE(only_paths_with_springs_may_be_given),
        IN_PLACE(failed_allocations_leave_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
