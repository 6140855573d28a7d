/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Sweeps with an oil axis: each slice is what a sweep at its temperature alone finds;
 * what is read between them is compared with gearsets whose losses follow known laws of
 * the temperature.
 */
#include "sweep/gm_oil.h"
#include "sweep/gm_sweep.h"
#include "sweep/gm_verify.h"

#include "base/alloc.h"
#include "map/gm_map_file.h"
#include "synthetic.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SLICES = 3, PLANTS = 2 * SLICES - 1 };

static const double axis[SLICES] = {263.15, 303.15, 363.15};

typedef double law(double temperature);

static synthetic source[PLANTS];
static const gm_plant *plants[PLANTS];
static gm_error error;

static double straight(double temperature)
{
    return 2.0 - 0.01 * (temperature - 263.15);
}

static double falling(double temperature)
{
    return 0.5 + 2.0 * exp(-(temperature - 263.15) / 25.0);
}

static double constant(double temperature)
{
    (void)temperature;
    return 1.3;
}

/* Load losses follow the law; what else is lost does not change. */
static void make_plant(synthetic *s, law *of, double temperature)
{
    synthetic_init(s, 2);
    s->load_factor = of(temperature);
    s->plant.info.oil_temperature = temperature;
}

static void make_plants(law *of, const double *at)
{
    for (int i = 0; i < PLANTS; i++) {
        const int k = i - SLICES;
        make_plant(&source[i], of, k < 0 ? at[i] : 0.5 * (at[k] + at[k + 1]));
        plants[i] = &source[i].plant;
    }
}

static gm_sweep_options options_for(int n)
{
    return (gm_sweep_options){.speed_step = 125.0,
                              .torque_step = 20.0,
                              .n_oil = n,
                              .at_oil = plants,
                              .between_oil = plants + SLICES};
}

static gm_map *sweep_at(const gm_sweep_options *options, const char *path,
                        gm_sweep_report report, void *user)
{
    gm_map *map = NULL;
    if (gm_sweep_run(plants[1], options, path, report, user, &map, NULL, &error) != GM_OK)
        fail_msg("%s", error.message);
    return map;
}

static gm_map *sweep(law *of)
{
    make_plants(of, axis);
    const gm_sweep_options options = options_for(SLICES);
    return sweep_at(&options, NULL, NULL, NULL);
}

static gm_map *sweep_alone(law *of, double temperature)
{
    synthetic alone;
    gm_map *map = NULL;
    const gm_sweep_options options = {.speed_step = 125.0, .torque_step = 20.0};
    make_plant(&alone, of, temperature);
    if (gm_sweep_run(&alone.plant, &options, NULL, NULL, NULL, &map, NULL, &error) !=
        GM_OK)
        fail_msg("%s", error.message);
    return map;
}

static void a_slice_is_what_a_sweep_at_its_temperature_finds(void **state)
{
    (void)state;
    gm_map *map = sweep(falling);
    assert_int_equal(map->n_oil, SLICES);
    assert_memory_equal(map->oil, axis, sizeof axis);
    for (int k = 0; k < SLICES; k++) {
        gm_map *alone = sweep_alone(falling, axis[k]);
        assert_int_equal(alone->n_tables, map->n_tables);
        for (int t = 0; t < map->n_tables; t++) {
            const gm_map_table *of = &map->tables[t];
            const gm_map_table *is = gm_map_find(alone, &of->key);
            const size_t n = (size_t)gm_map_table_size(of);
            assert_non_null(is);
            assert_int_equal(of->slices, SLICES);
            assert_memory_equal(of->value + (size_t)k * n, is->value, n * sizeof(double));
        }
        gm_map_destroy(alone);
    }
    gm_map_destroy(map);
}

/* Largest difference between the map at a temperature and a sweep there, of losses at
 * the nodes, over the largest. */
static double error_at(const gm_map *map, law *of, double temperature)
{
    gm_map *alone = sweep_alone(of, temperature);
    const int k = temperature >= axis[1];
    const double u = (temperature - axis[k]) / (axis[k + 1] - axis[k]);
    const double bend = map->oil_bend[k], share = u * (1 + bend) / (1 + bend * u);
    double largest = 0.0, off = 0.0;
    for (int t = 0; t < map->n_tables; t++) {
        const gm_map_table *table = &map->tables[t];
        const gm_map_table *is = gm_map_find(alone, &table->key);
        const int n = gm_map_table_size(table);
        for (int i = 0; i < n && table->key.symbol == GM_LOAD_LOSS; i++) {
            const double *near = table->value + k * n + i, *far = near + n;
            off = fmax(off, fabs(*near + share * (*far - *near) - is->value[i]));
            largest = fmax(largest, fabs(is->value[i]));
        }
    }
    gm_map_destroy(alone);
    return off / largest;
}

static void losses_linear_in_temperature_are_exact_everywhere(void **state)
{
    (void)state;
    gm_map *map = sweep(straight);
    for (int k = 0; k < SLICES; k++)
        assert_true(map->oil_bend[k] == 0.0);
    for (double temperature = 263.15; temperature < 363.0; temperature += 9.7)
        /* points are solved to 1e-12 of the largest torque */
        assert_true(error_at(map, straight, temperature) < 1e-10);
    gm_map_destroy(map);
}

static void the_bend_follows_losses_that_fall_steeply(void **state)
{
    (void)state;
    gm_map *map = sweep(falling);
    assert_true(map->oil_bend[0] > 1.0 && map->oil_bend[1] > 1.0);
    /* all losses that change do so alike: exact where the bend was found */
    assert_true(error_at(map, falling, 283.15) < 1e-9);
    assert_true(error_at(map, falling, 333.15) < 1e-9);
    double bent = fmax(error_at(map, falling, 273.15), error_at(map, falling, 293.15));
    map->oil_bend[0] = 0.0;
    double line = fmax(error_at(map, falling, 273.15), error_at(map, falling, 293.15));
    assert_true(bent < 0.15 * line && line > 0.1);
    gm_map_destroy(map);
}

static void losses_that_do_not_change_have_no_bend(void **state)
{
    (void)state;
    gm_map *map = sweep(constant);
    assert_true(map->oil_bend[0] == 0.0 && map->oil_bend[1] == 0.0);
    gm_map_destroy(map);
}

static void the_reduced_gearset_reads_it_between(void **state)
{
    (void)state;
    gm_map *map = sweep(straight);
    synthetic between[3];
    const gm_plant *held_out[3];
    gm_verify_result result;
    for (int i = 0; i < 3; i++) {
        make_plant(&between[i], straight, 270.0 + 40.0 * i);
        held_out[i] = &between[i].plant;
    }
    assert_int_equal(gm_verify_map(3, held_out, map, 0, 3000, 1, &result, &error), GM_OK);
    /* what the coarse steps of speed and torque cost is the same at one temperature */
    gm_verify_result one;
    gm_map *alone = sweep_alone(straight, 310.0);
    assert_int_equal(gm_verify_map(1, &held_out[1], alone, 0, 3000, 1, &one, &error),
                     GM_OK);
    for (int g = 0; g < GM_VERIFY_GROUPS; g++) {
        int points, all = 0;
        for (int i = 0; i < 3; i++) {
            double max, rms;
            gm_verify_between(&result, (gm_verify_group)g, 260.0 + 40.0 * i,
                              300.0 + 40.0 * i, &points, &max, &rms);
            assert_true(points > 800 && rms <= max);
            assert_true(max <= 2.0 * one.max_relative[g]);
            all += points;
        }
        assert_int_equal(all, 3000);
        assert_true(result.max_relative[g] <= 2.0 * one.max_relative[g]);
    }
    gm_verify_result_clear(&one);
    gm_verify_result_clear(&result);
    gm_map_destroy(alone);
    gm_map_destroy(map);
}

/* ---- nothing is lost ---- */

static int stop_after(void *user, const gm_sweep_progress *progress)
{
    return progress->points_done - progress->points_resumed > *(long *)user;
}

static void an_interrupted_sweep_goes_on_to_the_same_map(void **state)
{
    char folder[] = "/tmp/gm_oil_XXXXXX", path[64];
    (void)state;
    assert_non_null(mkdtemp(folder));
    (void)snprintf(path, sizeof path, "%s/oil.map", folder);
    gm_map *whole = sweep(falling), *map = NULL;
    gm_sweep_options options = options_for(SLICES);
    for (int i = 0; i < PLANTS; i++)
        source[i].pause = 20000; /* ns, so that the watch sees it running */
    long some = 200;
    int stops = 0;
    gm_status status;
    do {
        options.threads = 1 + stops % 3;
        status = gm_sweep_run(plants[1], &options, path, stop_after, &some, &map, NULL,
                              &error);
        some *= 4;
    } while (status == GM_ERR_INTERRUPTED && ++stops < 20);
    assert_int_equal(status, GM_OK);
    assert_true(stops >= 2);
    assert_string_equal(map->content_hash, whole->content_hash);
    gm_map_destroy(map);
    assert_int_equal(gm_map_read(path, &map, &error), GM_OK);
    assert_string_equal(map->content_hash, whole->content_hash);
    assert_memory_equal(map->oil_bend, whole->oil_bend, sizeof map->oil_bend);
    gm_map_destroy(map);
    gm_map_destroy(whole);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(rmdir(folder), 0);
}

static void another_temperature_is_another_map(void **state)
{
    static const double other[SLICES] = {263.15, 304.15, 363.15};
    (void)state;
    gm_map *one = sweep(constant);
    make_plants(constant, other);
    const gm_sweep_options options = options_for(SLICES);
    gm_map *two = sweep_at(&options, NULL, NULL, NULL);
    assert_string_not_equal(one->content_hash, two->content_hash);
    gm_map_destroy(one);
    gm_map_destroy(two);
}

static void temperatures_that_are_no_axis_are_refused(void **state)
{
    static const struct {
        double at[SLICES];
        int n;
        const char *words;
    } cases[] = {
        {{263.15, 303.15, 363.15}, 1, "2 to 32 temperatures, not 1"},
        {{263.15, 303.15, 363.15}, 33, "2 to 32 temperatures, not 33"},
        {{303.15, 263.15, 363.15}, 3, "must increase"},
        {{263.15, 263.15, 363.15}, 3, "must increase"},
        {{263.15, (double)NAN, 363.15}, 3, "must increase"},
        {{0.0, 263.15, 363.15}, 3, "above 0 K"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        gm_map *map = NULL;
        make_plants(constant, cases[i].at);
        const gm_sweep_options options = options_for(cases[i].n);
        assert_int_equal(
            gm_sweep_run(plants[1], &options, NULL, NULL, NULL, &map, NULL, &error),
            GM_ERR_ARGUMENT);
        assert_non_null(strstr(error.message, cases[i].words));
        assert_null(map);
    }
}

/* ---- temperatures by error ---- */

static synthetic sources[128];
static int n_sources;
static law *chosen_law;

static gm_status source_at(void *self, double temperature, const gm_plant **plant,
                           gm_error *e)
{
    (void)self;
    if (n_sources == 128)
        return gm_fail(e, GM_ERR_TOOL, "asked once too often");
    make_plant(&sources[n_sources], chosen_law, temperature);
    *plant = &sources[n_sources++].plant;
    return GM_OK;
}

static int choose(law *of, double share, double *at)
{
    const gm_oil_source oil = {source_at, NULL};
    int n = 2;
    at[0] = 263.15;
    at[1] = 363.15;
    chosen_law = of;
    n_sources = 0;
    assert_int_equal(gm_oil_choose(&oil, SYNTHETIC_SPEED_MAX, SYNTHETIC_TORQUE_MAX, share,
                                   0.0, &n, at, &error),
                     GM_OK);
    return n;
}

static double waves(double temperature)
{
    return 2.0 + sin(temperature / 7.0);
}

static void temperatures_are_added_where_losses_bend(void **state)
{
    double at[GM_MAP_MAX_OIL];
    (void)state;
    assert_int_equal(choose(straight, 0.001, at), 2);
    assert_int_equal(choose(constant, 0.001, at), 2);
    int coarse = choose(waves, 0.2, at), n = choose(waves, 0.05, at);
    assert_true(2 < coarse && coarse < n && n < GM_MAP_MAX_OIL);
    assert_true(at[0] == 263.15 && at[n - 1] == 363.15);
    for (int k = 1; k < n; k++)
        assert_true(at[k] > at[k - 1]);
    /* never more than a map may have, whatever is asked for */
    assert_true(choose(falling, 1e-9, at) <= GM_MAP_MAX_OIL);
}

static void failures_while_choosing_leave_nothing_behind(void **state)
{
    double at[GM_MAP_MAX_OIL] = {263.15, 363.15};
    const gm_oil_source oil = {source_at, NULL};
    gm_status status = GM_ERR_MEMORY;
    int n = 2;
    (void)state;
    chosen_law = straight;
    for (long k = 1; status == GM_ERR_MEMORY; k++) {
        assert_true(k < 10000);
        n_sources = 0;
        gm_alloc_fail_after(k);
        status = gm_oil_choose(&oil, SYNTHETIC_SPEED_MAX, SYNTHETIC_TORQUE_MAX, 0.01, 0.0,
                               &n, at, &error);
        gm_alloc_fail_after(0);
        assert_int_equal(n, 2);
    }
    assert_int_equal(status, GM_OK);
    n_sources = 128;
    assert_int_equal(gm_oil_choose(&oil, SYNTHETIC_SPEED_MAX, SYNTHETIC_TORQUE_MAX, 0.01,
                                   0.0, &n, at, &error),
                     GM_ERR_TOOL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(temperatures_are_added_where_losses_bend),
        cmocka_unit_test(failures_while_choosing_leave_nothing_behind),
        cmocka_unit_test(a_slice_is_what_a_sweep_at_its_temperature_finds),
        cmocka_unit_test(losses_linear_in_temperature_are_exact_everywhere),
        cmocka_unit_test(the_bend_follows_losses_that_fall_steeply),
        cmocka_unit_test(losses_that_do_not_change_have_no_bend),
        cmocka_unit_test(the_reduced_gearset_reads_it_between),
        cmocka_unit_test(an_interrupted_sweep_goes_on_to_the_same_map),
        cmocka_unit_test(another_temperature_is_another_map),
        cmocka_unit_test(temperatures_that_are_no_axis_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
