/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The map in memory, its checks and its content hash.
 */
#include "map_fixture.h"

#include "base/alloc.h"
#include "map/map_rules.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static gm_table_key load_key(int path, int gear, int direction)
{
    gm_table_key key = gm_table_key_of(GM_LOAD_LOSS);
    key.path = path;
    key.gear[path] = gear;
    key.direction[0] = direction;
    return key;
}

static void finds_every_table_and_no_other(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    for (int t = 0; t < map->n_tables; t++)
        assert_ptr_equal(gm_map_find(map, &map->tables[t].key), &map->tables[t]);
    gm_table_key none = load_key(0, 5, GM_FORWARD);
    assert_null(gm_map_find(map, &none));
    gm_map_destroy(map);
    gm_map_destroy(NULL);
}

static void table_and_row_sizes(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    gm_table_key key = load_key(0, 3, GM_BACKWARD);
    const gm_map_table *t = gm_map_find(map, &key);
    assert_int_equal(gm_map_row_size(t), 7);
    assert_int_equal(gm_map_table_size(t), 42);
    key = gm_table_key_of(GM_COUPLING);
    assert_int_equal(gm_map_row_size(gm_map_find(map, &key)), 1);
    key = gm_table_key_of(GM_BOTH_LOADED);
    key.gear[0] = 1, key.gear[1] = 2, key.direction[0] = GM_FORWARD;
    assert_int_equal(gm_map_row_size(gm_map_find(map, &key)), 15);
    gm_map_destroy(map);
}

/* Adding with one argument wrong must fail and leave the map as it was. */
static void refuse(gm_map *map, gm_table_key key, int n_axes, int n0, const double *x0)
{
    static const double torque[] = {-1.0, 0.0, 1.0};
    const double *x[GM_MAX_AXES] = {x0, torque, torque};
    int n[GM_MAX_AXES] = {n0, 3, 3}, index = -5, before = map->n_tables;
    gm_error error = {0};
    assert_int_equal(gm_map_add_table(map, &key, n_axes, n, x, &index, &error),
                     GM_ERR_ARGUMENT);
    assert_true(strlen(error.message) > 20);
    assert_int_equal(index, -5);
    assert_int_equal(map->n_tables, before);
}

static void refuses_tables_that_do_not_fit(void **state)
{
    (void)state;
    static const double good[] = {0.0, 1.0, 2.0}, equal[] = {0.0, 1.0, 1.0},
                        falling[] = {0.0, 2.0, 1.0}, negative[] = {-1.0, 0.0, 1.0},
                        not_number[] = {0.0, (double)NAN, 1.0},
                        infinite[] = {0.0, 1.0, (double)INFINITY};
    gm_map *map = fixture_map(&fixture_full);
    gm_table_key key = load_key(0, 5, GM_FORWARD);
    refuse(map, key, 1, 3, good);
    refuse(map, key, 3, 3, good);
    refuse(map, key, 2, 0, good);
    refuse(map, key, 2, GM_MAP_MAX_NODES + 1, good);
    refuse(map, key, 2, 3, equal);
    refuse(map, key, 2, 3, falling);
    refuse(map, key, 2, 3, negative);
    refuse(map, key, 2, 3, not_number);
    refuse(map, key, 2, 3, infinite);
    refuse(map, load_key(0, 3, GM_FORWARD), 2, 3, good); /* there already */
    refuse(map, load_key(0, GM_NEUTRAL, GM_FORWARD), 2, 3, good);
    refuse(map, load_key(0, 5, GM_MAP_ANY), 2, 3, good);
    refuse(map, load_key(0, GM_MAP_ANY, GM_FORWARD), 2, 3, good);
    key.direction[1] = GM_FORWARD; /* load loss has one direction only */
    refuse(map, key, 2, 3, good);
    key = load_key(0, 5, GM_FORWARD);
    key.gear[1] = 2; /* and the gear of its own path only */
    refuse(map, key, 2, 3, good);
    key = load_key(0, 5, GM_FORWARD);
    key.path = 2;
    refuse(map, key, 2, 3, good);
    key.symbol = (gm_symbol)77;
    refuse(map, key, 2, 3, good);
    gm_map_destroy(map);
}

static void refuses_paths_that_cannot_be(void **state)
{
    (void)state;
    gm_error error;
    gm_map *map = gm_map_create();
    assert_non_null(map);
    assert_int_equal(gm_map_set_path(map, 1, "b", 1, &error), GM_ERR_ARGUMENT);
    assert_int_equal(gm_map_set_path(map, 0, "", 1, &error), GM_ERR_ARGUMENT);
    assert_int_equal(gm_map_set_path(map, 0, "sixteen_letters_", 1, &error),
                     GM_ERR_ARGUMENT);
    assert_int_equal(gm_map_set_path(map, 0, "a", -1, &error), GM_ERR_ARGUMENT);
    assert_int_equal(gm_map_set_path(map, 0, "a", 1000, &error), GM_ERR_ARGUMENT);
    assert_int_equal(map->n_paths, 0);
    assert_int_equal(gm_map_set_path(map, 0, "fifteen_letters", 2, &error), GM_OK);
    assert_int_equal(gm_map_set_path(map, 0, "again", 1, &error), GM_OK);
    assert_int_equal(map->n_paths, 1);
    assert_int_equal(map->paths[0].n_gears, 1);
    assert_int_equal(gm_map_set_path(map, 2, "c", 1, &error), GM_ERR_ARGUMENT);
    gm_map_destroy(map);
}

static void expect_refusal(gm_map *map, const char *word)
{
    gm_error error = {0};
    assert_int_equal(gm_map_check(map, &error), GM_ERR_FORMAT);
    if (!strstr(error.message, word))
        fail_msg("'%s' does not name '%s'", error.message, word);
}

static void check_names_what_is_wrong(void **state)
{
    (void)state;
    gm_error error;
    gm_map *map = fixture_map(&fixture_full);
    assert_int_equal(gm_map_check(map, &error), GM_OK);
    double *numbers[] = {&map->paths[0].inertia, &map->paths[1].sync_torque,
                         &map->inertia_output, &map->paths[1].gears[0].ratio,
                         &map->speed_max};
    static const char *const words[] = {"odd: inertia", "even: synchroniser", "output",
                                        "gear -1", "speed"};
    for (int i = 0; i < 5; i++) {
        double kept = *numbers[i];
        *numbers[i] = (double)NAN;
        expect_refusal(map, words[i]);
        *numbers[i] = 0.0;
        if (i < 4)
            expect_refusal(map, words[i]);
        *numbers[i] = kept;
    }
    map->paths[0].sync_torque = (double)INFINITY; /* engages at once */
    assert_int_equal(gm_map_check(map, &error), GM_OK);
    map->paths[0].gears[0].number = 4;
    expect_refusal(map, "gear 3 must come before gear 4");
    map->paths[0].gears[0].number = 0;
    expect_refusal(map, "0 is not the number of a gear");
    map->paths[0].gears[0].number = 2;
    expect_refusal(map, "no such gear"); /* the tables of gear 1 are left */
    map->paths[0].gears[0].number = 1;
    map->tables[7].value[1] = (double)NAN;
    expect_refusal(map, "value 1 is");
    strcpy(map->paths[1].name, "odd");
    expect_refusal(map, "both paths");
    gm_map_destroy(map);
}

static void hash_of(const gm_map *map, char text[65])
{
    gm_error error;
    if (gm_map_hash(map, text, &error) != GM_OK)
        fail_msg("%s", error.message);
    assert_int_equal(strlen(text), 64);
}

static void hash_ignores_order_and_version(void **state)
{
    (void)state;
    char first[65], second[65];
    fixture_options reversed = fixture_full;
    reversed.reversed = true;
    gm_map *a = fixture_map(&fixture_full), *b = fixture_map(&reversed);
    assert_true(gm_map_key_compare(&a->tables[0].key, &b->tables[0].key) != 0);
    assert_true(fixture_equal(a, b));
    strcpy(b->tool_version, "9.9");
    hash_of(a, first);
    hash_of(b, second);
    assert_string_equal(first, second);
    gm_map_destroy(a);
    gm_map_destroy(b);
}

static void expect_other_hash(const gm_map *map, const char *than)
{
    char text[65];
    hash_of(map, text);
    assert_string_not_equal(text, than);
}

static void hash_sees_every_number_and_text(void **state)
{
    (void)state;
    char before[65], after[65];
    gm_map *map = fixture_map(&fixture_full);
    gm_map_path *path = &map->paths[1];
    double *numbers[] = {&map->speed_max,
                         &map->torque_max,
                         &map->oil_temperature,
                         &map->inertia_output,
                         &path->inertia,
                         &path->sync_torque,
                         &path->gears[1].ratio,
                         &path->gears[1].ratio_given,
                         &path->gears[1].stiffness,
                         &path->gears[1].damping,
                         &path->gears[1].loose_damping,
                         &path->gears[1].lash,
                         &path->gears[1].film,
                         &path->gears[1].inertia_extra};
    char *texts[] = {map->name, map->title, map->input_sha256, map->options, path->name};
    hash_of(map, before);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        double kept = *numbers[i];
        *numbers[i] = nextafter(kept, HUGE_VAL);
        expect_other_hash(map, before);
        *numbers[i] = kept;
    }
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        texts[i][1] ^= 1;
        expect_other_hash(map, before);
        texts[i][1] ^= 1;
    }
    for (int t = 0; t < map->n_tables; t++) {
        double *value = &map->tables[t].value[gm_map_table_size(&map->tables[t]) - 1];
        double kept = *value;
        *value = nextafter(kept, HUGE_VAL);
        expect_other_hash(map, before);
        *value = kept;
        double *x = &map->tables[t].x[0][1];
        kept = *x;
        *x = nextafter(kept, HUGE_VAL);
        expect_other_hash(map, before);
        *x = kept;
    }
    hash_of(map, after);
    assert_string_equal(before, after);
    gm_map_destroy(map);
}

static void allocation_failures_leave_the_map_usable(void **state)
{
    (void)state;
    static const double x0[] = {0.0, 1.0};
    const double *x[] = {x0, x0};
    const int n[] = {2, 2};
    gm_map *map = fixture_map(&fixture_full);
    gm_table_key key = load_key(0, 5, GM_FORWARD);
    int failures = 0, index = -1, before = map->n_tables;
    char text[65] = "untouched";
    gm_status status = GM_ERR_MEMORY;
    for (long k = 1; status == GM_ERR_MEMORY; k++, failures++) {
        gm_alloc_fail_after(k);
        status = gm_map_hash(map, text, NULL);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || strcmp(text, "untouched") == 0);
    }
    assert_int_equal(status, GM_OK);
    assert_true(failures > 2);
    status = GM_ERR_MEMORY;
    for (long k = 1; status == GM_ERR_MEMORY; k++) {
        gm_alloc_fail_after(k);
        status = gm_map_add_table(map, &key, 2, n, x, &index, NULL);
        gm_alloc_fail_after(0);
        assert_int_equal(map->n_tables, before + (status == GM_OK));
    }
    assert_int_equal(status, GM_OK);
    gm_map_destroy(map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_every_table_and_no_other),
        cmocka_unit_test(table_and_row_sizes),
        cmocka_unit_test(refuses_tables_that_do_not_fit),
        cmocka_unit_test(refuses_paths_that_cannot_be),
        cmocka_unit_test(check_names_what_is_wrong),
        cmocka_unit_test(hash_ignores_order_and_version),
        cmocka_unit_test(hash_sees_every_number_and_text),
        cmocka_unit_test(allocation_failures_leave_the_map_usable),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
