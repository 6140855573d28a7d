/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A map as the bytes of its file, without a file.
 */
#include "file_fixture.h"
#include "map_fixture.h"

#include "base/alloc.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static void the_bytes_are_a_file_with_the_same_map(void **state)
{
    unsigned char *bytes = NULL;
    size_t size = 0;
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    assert_int_equal(gm_map_hash(map, map->content_hash, NULL), GM_OK);
    assert_int_equal(gm_map_to_bytes(map, &bytes, &size, NULL), GM_OK);
    file_write_bytes(file_path, bytes, size);
    gm_map *read = file_read_map(file_path);
    assert_true(fixture_equal(map, read));
    assert_string_equal(read->tool_version, map->tool_version);
    gm_free(bytes);
    gm_map_destroy(read);
    gm_map_destroy(map);
}

/* Also when it was read from a file. */
static void the_same_map_gives_the_same_bytes(void **state)
{
    unsigned char *first = NULL, *second = NULL;
    size_t size = 0, again = 0;
    (void)state;
    gm_map *map = fixture_map(&fixture_full), *copy = fixture_map(&fixture_full);
    file_write_map(copy);
    gm_map *read = file_read_map(file_path);
    memcpy(map->content_hash, read->content_hash, sizeof map->content_hash);
    assert_int_equal(gm_map_to_bytes(map, &first, &size, NULL), GM_OK);
    assert_int_equal(gm_map_to_bytes(read, &second, &again, NULL), GM_OK);
    assert_int_equal(size, again);
    assert_memory_equal(first, second, size);
    gm_free(first);
    gm_free(second);
    gm_map_destroy(read);
    gm_map_destroy(copy);
    gm_map_destroy(map);
}

static void without_memory_nothing_is_left(void **state)
{
    unsigned char *bytes = NULL;
    size_t size = 0;
    gm_status status = GM_ERR_MEMORY;
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    for (long k = 1; status == GM_ERR_MEMORY; k++) {
        gm_alloc_fail_after(k);
        status = gm_map_to_bytes(map, &bytes, &size, NULL);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || (status == GM_ERR_MEMORY && !bytes));
    }
    gm_free(bytes);
    gm_map_destroy(map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_bytes_are_a_file_with_the_same_map,
                                        file_setup, file_teardown),
        cmocka_unit_test_setup_teardown(the_same_map_gives_the_same_bytes, file_setup,
                                        file_teardown),
        cmocka_unit_test(without_memory_nothing_is_left),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
