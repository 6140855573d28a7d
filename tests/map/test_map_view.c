/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The view: the numbers the reduced gearset reads are those of the tables.
 */
#include "map_fixture.h"

#include "base/alloc.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static gm_map_view *view_of(const gm_map *map)
{
    gm_error error;
    gm_map_view *view = NULL;
    if (gm_map_view_create(map, &view, &error) != GM_OK)
        fail_msg("%s", error.message);
    return view;
}

static void assert_table2(const gm_map *map, const gm_table_key *key, const gm_table2 *t)
{
    const gm_map_table *from = gm_map_find(map, key);
    assert_non_null(from);
    assert_ptr_equal(t->value, from->value);
    assert_ptr_equal(t->x.x, from->x[0]);
    assert_ptr_equal(t->y.x, from->x[1]);
    assert_int_equal(t->x.n, from->n[0]);
    assert_int_equal(t->y.n, from->n[1]);
}

static void shows_gears_with_ratios_and_load_losses(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    gm_map_view *view = view_of(map);
    const gm_reduced_map *reduced = gm_map_view_reduced(view);
    assert_int_equal(reduced->n_paths, 2);
    assert_true(reduced->inertia_output == map->inertia_output);
    assert_true(reduced->oil_temperature == map->oil_temperature);
    for (int p = 0; p < 2; p++) {
        const gm_path *path = &reduced->path[p];
        assert_int_equal(path->n_gears, 2);
        assert_true(path->inertia == map->paths[p].inertia);
        assert_true(path->sync_torque == map->paths[p].sync_torque);
        for (int i = 0; i < 4; i++) {
            const gm_gear *gear = &path->gears[i / 2];
            gm_table_key key = gm_table_key_of(GM_LOAD_LOSS);
            key.path = p;
            key.gear[p] = map->paths[p].gears[i / 2].number;
            key.direction[0] = i % 2;
            assert_int_equal(gear->number, key.gear[p]);
            assert_true(gear->ratio == map->paths[p].gears[i / 2].ratio);
            assert_table2(map, &key, &gear->load_loss[i % 2]);
        }
    }
    gm_map_view_destroy(view);
    gm_map_destroy(map);
    gm_map_view_destroy(NULL);
}

static void shows_drag_and_reaction_by_both_directions(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    gm_map_view *view = view_of(map);
    for (int i = 0; i < 8; i++) {
        const gm_path *path = &gm_map_view_reduced(view)->path[i / 4];
        gm_table_key key = gm_table_key_of(GM_DRAG);
        key.path = i / 4;
        key.direction[0] = i / 2 % 2;
        key.direction[1] = i % 2;
        assert_table2(map, &key, &path->drag[i / 2 % 2][i % 2]);
        key.symbol = GM_REACTION;
        assert_table2(map, &key, &path->reaction[i / 2 % 2][i % 2]);
    }
    gm_map_view_destroy(view);
    gm_map_destroy(map);
}

static void shows_lines_that_jump(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    gm_map_view *view = view_of(map);
    const gm_path *odd = &gm_map_view_reduced(view)->path[0];
    const gm_path *even = &gm_map_view_reduced(view)->path[1];
    assert_int_equal(odd->n_lines, 2);
    assert_int_equal(even->n_lines, 1); /* one of two has no table */
    assert_true(odd->lines[0].ratio == fixture_line[0][0]);
    assert_true(odd->lines[1].ratio == fixture_line[0][1]);
    assert_true(even->lines[0].ratio == fixture_line[1][0]);
    gm_table_key key = gm_table_key_of(GM_LINE_JUMP);
    key.path = 0;
    key.line = odd->lines[1].ratio;
    key.direction[0] = GM_FORWARD;
    assert_ptr_equal(odd->lines[1].jump[GM_FORWARD].value, gm_map_find(map, &key)->value);
    /* no table backward: a constant zero that has no range to leave */
    assert_int_equal(odd->lines[1].jump[GM_BACKWARD].x.n, 1);
    assert_true(odd->lines[1].jump[GM_BACKWARD].value[0] == 0.0);
    gm_map_view_destroy(view);
    gm_map_destroy(map);
}

/* N of a law that the tables hold exactly: dry friction, and one that follows the
 * slip. */
static double law_of_drag(double w, double w_o)
{
    return (w < 0 ? -0.4 : 0.4) + 1e-3 * (w - 2.0 * w_o);
}

/* parasitic: P, the same everywhere */
static void set_drag_by_law(gm_map *map, double parasitic)
{
    for (int t = 0; t < map->n_tables; t++) {
        gm_map_table *table = &map->tables[t];
        const int *dir = table->key.direction;
        if (table->key.symbol == GM_PARASITIC)
            for (int i = 0; i < gm_map_table_size(table); i++)
                table->value[i] = parasitic;
        if (table->key.path != 0)
            continue;
        for (int i = 0; i < gm_map_table_size(table); i++)
            if (table->key.symbol == GM_LINE_JUMP)
                table->value[i] = 0.06;
            else if (table->key.symbol == GM_DRAG) {
                double w = table->x[0][i / table->n[1]],
                       w_o = table->x[1][i % table->n[1]];
                double s = dir[0] ? -1.0 : 1.0;
                table->value[i] = law_of_drag(s * (w + 1e-300), dir[1] ? -w_o : w_o);
            }
    }
}

static void what_brakes_the_input_side_follows_from_the_drag(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    set_drag_by_law(map, 1e3);
    map->paths[0].gears[1].ratio = fixture_line[0][0] * (1 + 1e-13);
    gm_map_view *view = view_of(map);
    const gm_path *path = &gm_map_view_reduced(view)->path[0];
    for (int g = 0; g < path->n_gears; g++)
        for (int d = 0; d < 2; d++) {
            const gm_gear *gear = &path->gears[g];
            double s = d ? -1.0 : 1.0, jumps = 0.0;
            for (int l = 0; l < path->n_lines; l++) {
                bool jumps_here =
                    path->lines[l].jump[gear->ratio < 0 ? 1 - d : d].x.n > 1;
                double ahead = 1.0 - path->lines[l].ratio / gear->ratio;
                if (jumps_here && fabs(ahead) > 1e-6)
                    jumps += ahead > 0 ? 0.03 : -0.03;
            }
            assert_int_equal(gear->pin[d].x.n, path->drag[d][d].x.n);
            for (int i = 1; i < gear->pin[d].x.n; i++) {
                double w = s * gear->pin[d].x.x[i];
                if (fabs(w / gear->ratio) >
                    path->drag[d][d].y.x[path->drag[d][d].y.n - 1])
                    continue; /* N is clamped there */
                assert_true(fabs(gear->pin[d].value[i] -
                                 (s * law_of_drag(w, w / gear->ratio) + jumps)) < 1e-12);
            }
        }
    gm_map_view_destroy(view);
    gm_map_destroy(map);
}

/* A map may hold less than |r| pin as P: the output must be left a loss. */
static void what_brakes_the_input_side_leaves_the_output_a_loss(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    set_drag_by_law(map, 0.5);
    gm_map_view *view = view_of(map);
    const gm_reduced_map *reduced = gm_map_view_reduced(view);
    for (int c = 0; c < reduced->n_configurations; c++) {
        double sum = 0.0;
        for (int p = 0; p < 2; p++) {
            int g = reduced->configurations[c].gear[p];
            if (g >= 0) {
                const gm_gear *gear = &reduced->path[p].gears[g];
                sum += fabs(gear->ratio) * gear->pin[gear->ratio < 0].value[0];
            }
        }
        assert_true(sum <= 0.5 * (1 + 1e-12));
    }
    gm_map_view_destroy(view);
    gm_map_destroy(map);
}

static void numbers_configurations_by_both_gears(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    gm_map_view *view = view_of(map);
    const gm_reduced_map *reduced = gm_map_view_reduced(view);
    assert_int_equal(reduced->n_configurations, 9);
    for (int i = 0; i < 18; i++) {
        int g0 = i / 6 - 1, g1 = i / 2 % 3 - 1, d = i % 2;
        const gm_configuration *c = &reduced->configurations[(g0 + 1) * 3 + g1 + 1];
        gm_table_key key = gm_table_key_of(GM_PARASITIC);
        assert_int_equal(c->gear[0], g0);
        assert_int_equal(c->gear[1], g1);
        key.gear[0] = g0 < 0 ? 0 : map->paths[0].gears[g0].number;
        key.gear[1] = g1 < 0 ? 0 : map->paths[1].gears[g1].number;
        key.direction[0] = d;
        assert_ptr_equal(c->parasitic[d].value, gm_map_find(map, &key)->value);
        key.symbol = GM_BOTH_LOADED;
        const gm_map_table *x = gm_map_find(map, &key);
        assert_int_equal(x != NULL, g0 >= 0 && g1 >= 0);
        assert_ptr_equal(c->both_loaded[d].value, x ? x->value : NULL);
        assert_int_equal(c->both_loaded[d].z.n, x ? x->n[2] : 0);
    }
    assert_ptr_equal(reduced->coupling.value,
                     map->tables[map->n_tables - 1].value); /* added last */
    gm_map_view_destroy(view);
    gm_map_destroy(map);
}

static void optional_tables_may_be_missing(void **state)
{
    (void)state;
    const fixture_options bare = {2, false, false, GM_SYMBOLS},
                          one = {1, true, false, GM_SYMBOLS};
    gm_map *map = fixture_map(&bare);
    gm_map_view *view = view_of(map);
    const gm_reduced_map *reduced = gm_map_view_reduced(view);
    assert_null(reduced->coupling.value);
    assert_null(reduced->configurations[8].both_loaded[0].value);
    assert_int_equal(reduced->path[0].n_lines, 0);
    gm_map_view_destroy(view);
    gm_map_destroy(map);
    map = fixture_map(&one);
    view = view_of(map);
    reduced = gm_map_view_reduced(view);
    assert_int_equal(reduced->n_paths, 1);
    assert_int_equal(reduced->n_configurations, 3);
    assert_int_equal(reduced->configurations[0].gear[0], -1);
    assert_int_equal(reduced->configurations[2].gear[0], 1);
    assert_int_equal(reduced->configurations[2].gear[1], -1);
    gm_map_view_destroy(view);
    gm_map_destroy(map);
}

static void missing_table_is_named(void **state)
{
    (void)state;
    static const gm_symbol required[] = {GM_PARASITIC, GM_LOAD_LOSS, GM_DRAG,
                                         GM_REACTION};
    static const char *const words[] = {
        "parasitic loss (gear 0, gear 0, forward)",
        "load loss (path odd, gear 1, forward)", "drag (path odd, forward, forward)",
        "reaction of the drag (path odd, forward, forward)"};
    for (int i = 0; i < 4; i++) {
        fixture_options options = fixture_full;
        options.leave_out = required[i];
        gm_error error = {0};
        gm_map_view *view = NULL;
        gm_map *map = fixture_map(&options);
        assert_int_equal(gm_map_view_create(map, &view, &error), GM_ERR_FORMAT);
        if (!strstr(error.message, words[i]))
            fail_msg("'%s' does not name '%s'", error.message, words[i]);
        assert_null(view);
        gm_map_destroy(map);
    }
}

static void wrong_numbers_are_refused(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    gm_map_view *view = NULL;
    gm_error error;
    map->paths[0].gears[1].ratio = 0.0;
    assert_int_equal(gm_map_view_create(map, &view, &error), GM_ERR_FORMAT);
    map->paths[0].gears[1].ratio = 4.0;
    map->tables[3].x[0][1] = -1.0;
    assert_int_equal(gm_map_view_create(map, &view, &error), GM_ERR_FORMAT);
    assert_null(view);
    gm_map_destroy(map);
}

static void allocation_failures_leak_nothing(void **state)
{
    (void)state;
    gm_map *map = fixture_map(&fixture_full);
    gm_map_view *view = NULL;
    gm_status status = GM_ERR_MEMORY;
    int failures = -1;
    for (long k = 1; status == GM_ERR_MEMORY; k++, failures++) {
        assert_null(view);
        gm_alloc_fail_after(k);
        status = gm_map_view_create(map, &view, NULL);
        gm_alloc_fail_after(0);
    }
    assert_int_equal(status, GM_OK);
    assert_int_equal(failures,
                     8); /* view; gears, lines and pins of two paths; configurations */
    gm_map_view_destroy(view);
    gm_map_destroy(map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shows_gears_with_ratios_and_load_losses),
        cmocka_unit_test(shows_drag_and_reaction_by_both_directions),
        cmocka_unit_test(shows_lines_that_jump),
        cmocka_unit_test(what_brakes_the_input_side_follows_from_the_drag),
        cmocka_unit_test(what_brakes_the_input_side_leaves_the_output_a_loss),
        cmocka_unit_test(numbers_configurations_by_both_gears),
        cmocka_unit_test(optional_tables_may_be_missing),
        cmocka_unit_test(missing_table_is_named),
        cmocka_unit_test(wrong_numbers_are_refused),
        cmocka_unit_test(allocation_failures_leak_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
