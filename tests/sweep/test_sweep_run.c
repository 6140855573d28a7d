/* SPDX-License-Identifier: BSD-2-Clause
 *
 * How a sweep runs: threads, steps, progress, interruption, refusals and failures.
 */
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
#include <string.h>
#include <unistd.h>

static synthetic source;
static gm_error error;

static int fresh(void **state)
{
    (void)state;
    synthetic_init(&source, 2);
    error = (gm_error){GM_OK, ""};
    return 0;
}

static gm_status sweep(gm_sweep_options options, const char *path, gm_map **map,
                       gm_sweep_summary *summary)
{
    return gm_sweep_run(&source.plant, &options, path, NULL, NULL, map, summary, &error);
}

static gm_map *sweep_ok(gm_sweep_options options)
{
    gm_map *map = NULL;
    if (sweep(options, NULL, &map, NULL) != GM_OK)
        fail_msg("%s", error.message);
    return map;
}

static const gm_map_table *load_table(const gm_map *map, int p, int number)
{
    gm_table_key key = gm_table_key_of(GM_LOAD_LOSS);
    key.path = p;
    key.gear[p] = number;
    key.direction[0] = GM_FORWARD;
    return gm_map_find(map, &key);
}

/* ---- the result does not depend on how it was computed ---- */

static void threads_do_not_change_the_result(void **state)
{
    (void)state;
    gm_map *map[3];
    for (int i = 0; i < 3; i++)
        map[i] = sweep_ok((gm_sweep_options){.threads = i}); /* 0: as many as there are */
    assert_int_equal(strlen(map[0]->content_hash), 64);
    assert_string_equal(map[0]->content_hash, map[1]->content_hash);
    assert_string_equal(map[0]->content_hash, map[2]->content_hash);
    for (int i = 0; i < 3; i++)
        gm_map_destroy(map[i]);
}

static void options_change_the_hash_and_are_written_down(void **state)
{
    (void)state;
    gm_map *automatic = sweep_ok((gm_sweep_options){.threads = 1});
    gm_map *steps =
        sweep_ok((gm_sweep_options){.speed_step = 100.0, .torque_step = 20.0});
    assert_string_equal(automatic->options,
                        "speed_step=auto torque_step=auto speed_max=500 torque_max=40 "
                        "oil_temperature=353.14999999999998");
    assert_string_equal(steps->options,
                        "speed_step=100 torque_step=20 speed_max=500 torque_max=40 "
                        "oil_temperature=353.14999999999998");
    assert_string_not_equal(automatic->content_hash, steps->content_hash);
    gm_map_destroy(automatic);
    gm_map_destroy(steps);
}

static void steps_give_uniform_axes(void **state)
{
    (void)state;
    gm_map *map = sweep_ok((gm_sweep_options){.speed_step = 150.0,
                                              .torque_step = 25.0,
                                              .speed_max = 450.0,
                                              .torque_max = 50.0});
    const gm_map_table *t = load_table(map, 0, 3);
    const double speed[] = {0.0, 150.0, 300.0, 450.0};
    const double torque[] = {-50.0, -25.0, 0.0, 25.0, 50.0};
    assert_int_equal(t->n[0], 4);
    assert_int_equal(t->n[1], 5);
    assert_memory_equal(t->x[0], speed, sizeof speed);
    assert_memory_equal(t->x[1], torque, sizeof torque);
    gm_map_destroy(map);
}

static void output_axes_reach_the_largest_speed_of_the_slowest_gear(void **state)
{
    (void)state;
    gm_map *map = sweep_ok((gm_sweep_options){.threads = 1});
    const int gears[3][2] = {{0, 0}, {1, 0}, {1, 6}};
    const double slowest[3] = {2.5, 14.0, 2.5}; /* |ratio| of the synthetic gearset */
    for (int i = 0; i < 3; i++) {
        gm_table_key key = gm_table_key_of(GM_PARASITIC);
        memcpy(key.gear, gears[i], sizeof key.gear);
        key.direction[0] = GM_FORWARD;
        const gm_map_table *t = gm_map_find(map, &key);
        double end = t->x[0][t->n[0] - 1], wanted = SYNTHETIC_SPEED_MAX / slowest[i];
        assert_true(fabs(end - wanted) <= 1e-12 * wanted);
        assert_true(t->n[0] <= 40);
    }
    gm_map_destroy(map);
}

/* ---- progress, interruption, resume ---- */

typedef struct watch {
    int calls, stop_at;
    gm_sweep_progress last;
} watch;

static int look(void *user, const gm_sweep_progress *progress)
{
    watch *w = user;
    assert_true(progress->points_done >= w->last.points_done);
    w->last = *progress;
    return ++w->calls == w->stop_at;
}

static void progress_ends_at_the_total(void **state)
{
    (void)state;
    watch w = {0};
    gm_sweep_options options = {.threads = 2};
    gm_sweep_summary summary;
    gm_map *map = NULL;
    assert_int_equal(
        gm_sweep_run(&source.plant, &options, NULL, look, &w, &map, &summary, &error),
        GM_OK);
    assert_true(w.calls >= 1);
    assert_true(w.last.points_total > 10000);
    assert_int_equal(w.last.points_done, w.last.points_total);
    assert_int_equal(summary.points, w.last.points_total);
    assert_int_equal(summary.resumed, 0);
    gm_map_destroy(map);
}

static void remove_map(const char *path)
{
    char part[64];
    (void)snprintf(part, sizeof part, "%s.part", path);
    (void)remove(path);
    (void)remove(part);
}

static void an_interrupted_sweep_resumes_to_the_same_map(void **state)
{
    (void)state;
    const char *path = "interrupted.map";
    gm_sweep_options options = {.threads = 2};
    gm_map *whole = sweep_ok(options), *map = NULL;
    gm_sweep_summary summary;
    watch w = {.stop_at = 2};
    remove_map(path);
    source.pause = 10000;
    assert_int_equal(
        gm_sweep_run(&source.plant, &options, path, look, &w, &map, &summary, &error),
        GM_ERR_INTERRUPTED);
    assert_null(map);
    assert_true(access(path, F_OK) != 0);
    assert_non_null(strstr(error.message, "interrupted after"));
    source.pause = 0;
    if (sweep(options, path, &map, &summary) != GM_OK)
        fail_msg("%s", error.message);
    assert_true(summary.resumed > 0);
    assert_true(summary.points < w.last.points_total);
    assert_string_equal(map->content_hash, whole->content_hash);
    gm_map_destroy(map);
    assert_int_equal(gm_map_read(path, &map, &error), GM_OK);
    assert_string_equal(map->content_hash, whole->content_hash);
    gm_map_destroy(map);
    gm_map_destroy(whole);
    remove_map(path);
}

static void an_unwritable_map_is_refused_before_any_point(void **state)
{
    (void)state;
    gm_map *map = NULL;
    source.unsolvable_above = -1.0; /* a single point would fail otherwise */
    assert_int_equal(sweep((gm_sweep_options){0}, "no/such/folder/x.map", &map, NULL),
                     GM_ERR_IO);
    assert_null(map);
}

/* ---- axes by error ---- */

static const gm_sweep_options by_error = {.tolerance_share = 0.01, .threads = 2};

/* X of the synthetic gearset is a product of torques, which no table of these sizes meets
   beside a hundredth everywhere; the loss of one path and the drags are. */
static void axes_by_error_meet_their_tolerance(void **state)
{
    (void)state;
    const gm_verify_group inside[] = {GM_VERIFY_SINGLE, GM_VERIFY_PRESELECTED,
                                      GM_VERIFY_DRAG, GM_VERIFY_REACTION};
    for (int monotone = 0; monotone < 2; monotone++) {
        gm_sweep_options options = by_error;
        gm_verify_result result;
        options.monotone = monotone;
        gm_map *map = sweep_ok(options);
        assert_non_null(strstr(map->options, monotone ? "monotone" : "linear"));
        assert_int_equal(gm_verify_map(1, &(const gm_plant *){&source.plant}, map,
                                       monotone, 3000, 17, &result, &error),
                         GM_OK);
        for (size_t g = 0; g < sizeof inside / sizeof inside[0]; g++)
            if (!(result.max_relative[inside[g]] <= 0.01))
                fail_msg("%s: %g", gm_verify_group_name(inside[g]),
                         result.max_relative[inside[g]]);
        gm_verify_result_clear(&result);
        gm_map_destroy(map);
    }
}

static void axes_by_error_do_not_depend_on_threads(void **state)
{
    (void)state;
    char hash[65] = "";
    long points = 0;
    for (int threads = 1; threads <= 3; threads++) {
        gm_sweep_options options = by_error;
        gm_sweep_summary summary;
        gm_map *map = NULL;
        options.threads = threads;
        assert_int_equal(sweep(options, NULL, &map, &summary), GM_OK);
        if (threads > 1) {
            assert_string_equal(map->content_hash, hash);
            assert_int_equal(summary.points, points);
        }
        memcpy(hash, map->content_hash, sizeof hash);
        points = summary.points;
        gm_map_destroy(map);
    }
}

/* Stop after some points of the run's own. */
static int stop_after_a_thousand(void *user, const gm_sweep_progress *progress)
{
    *(gm_sweep_progress *)user = *progress;
    return progress->points_done - progress->points_resumed >= 1000;
}

/* Interrupted at every stage of the refinement, in turn. */
static void interrupted_axes_by_error_resume_to_the_same_map(void **state)
{
    (void)state;
    const char *path = "by_error.map";
    gm_sweep_summary whole_summary, summary;
    gm_map *whole = NULL, *map = NULL;
    gm_status status = GM_ERR_INTERRUPTED;
    int interruptions = -1;
    gm_sweep_progress last = {0};
    assert_int_equal(sweep(by_error, NULL, &whole, &whole_summary), GM_OK);
    remove_map(path);
    source.pause = 100000; /* 1000 points take longer than the time between reports */
    for (; status == GM_ERR_INTERRUPTED; interruptions++) {
        long before = last.points_done;
        status = gm_sweep_run(&source.plant, &by_error, path, stop_after_a_thousand,
                              &last, &map, &summary, &error);
        assert_true(last.points_resumed >= before);
    }
    if (status != GM_OK)
        fail_msg("%s", error.message);
    assert_true(interruptions > 2);
    assert_int_equal(summary.points + summary.resumed, whole_summary.points);
    assert_string_equal(map->content_hash, whole->content_hash);
    gm_map_destroy(map);
    gm_map_destroy(whole);
    remove_map(path);
}

static void progress_of_axes_by_error_tells_the_worst_error(void **state)
{
    (void)state;
    watch w = {0};
    gm_map *map = NULL;
    source.pause = 2000;
    assert_int_equal(
        gm_sweep_run(&source.plant, &by_error, NULL, look, &w, &map, NULL, &error),
        GM_OK);
    assert_int_equal(w.last.points_done, w.last.points_total);
    assert_true(w.last.worst_error > 0.0 && w.last.worst_error < 0.2);
    gm_map_destroy(map);
}

static void an_absolute_tolerance_takes_fewer_points(void **state)
{
    (void)state;
    const gm_sweep_options fine = {.tolerance_share = 0.001, .threads = 2};
    const gm_sweep_options coarse = {
        .tolerance_share = 0.001, .tolerance_torque = 0.05, .threads = 2};
    gm_sweep_summary summary[2];
    gm_map *map[2] = {NULL, NULL};
    assert_int_equal(sweep(fine, NULL, &map[0], &summary[0]), GM_OK);
    assert_int_equal(sweep(coarse, NULL, &map[1], &summary[1]), GM_OK);
    assert_true(summary[1].points < summary[0].points);
    gm_map_destroy(map[0]);
    gm_map_destroy(map[1]);
}

/* ---- refusals ---- */

static void options_out_of_range_are_refused(void **state)
{
    (void)state;
    const gm_sweep_options bad[] = {
        {.speed_step = -1.0},
        {.torque_step = nan("")},
        {.speed_max = HUGE_VAL},
        {.torque_max = -5.0},
        {.threads = -1},
        {.speed_step = 1e-6},
        {.torque_step = 1e-6},
        {.tolerance_share = -0.1},
        {.tolerance_share = 1.0},
        {.tolerance_torque = nan("")},
        {.tolerance_share = 0.01, .speed_step = 50.0},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        gm_map *map = NULL;
        error = (gm_error){GM_OK, ""};
        assert_int_equal(sweep(bad[i], NULL, &map, NULL), GM_ERR_ARGUMENT);
        assert_null(map);
        assert_true(error.message[0] != '\0');
    }
}

static void a_gearset_without_a_range_is_refused(void **state)
{
    (void)state;
    gm_map *map = NULL;
    source.plant.info.speed_max = 0.0;
    assert_int_equal(sweep((gm_sweep_options){0}, NULL, &map, NULL), GM_ERR_ARGUMENT);
    source.plant.info.speed_max = nan("");
    assert_int_equal(sweep((gm_sweep_options){0}, NULL, &map, NULL), GM_ERR_ARGUMENT);
}

static void a_ratio_that_disagrees_is_refused_with_both_numbers(void **state)
{
    (void)state;
    gm_map *map = NULL;
    source.gears[1][1].ratio_given = 4.1; /* the gearset has 4 */
    assert_int_equal(sweep((gm_sweep_options){0}, NULL, &map, NULL), GM_ERR_MODEL);
    assert_string_equal(error.message, "path 'even', gear 4: given ratio 4.1, the model "
                                       "makes 4; they may differ by 0.001 of it");
    source.gears[1][1].ratio_given = -4.0;
    assert_int_equal(sweep((gm_sweep_options){0}, NULL, &map, NULL), GM_ERR_MODEL);
    assert_string_equal(error.message, "path 'even', gear 4: given ratio -4, the model "
                                       "makes 4; the sign must be the same");
    assert_null(map);
}

static void a_rounded_ratio_or_none_is_accepted(void **state)
{
    (void)state;
    gm_map *map = NULL;
    gm_sweep_summary summary;
    source.gears[1][1].ratio_given = 4.003;
    source.gears[0][0].ratio_given = nan("");
    assert_int_equal(sweep((gm_sweep_options){0}, NULL, &map, &summary), GM_OK);
    assert_true(fabs(summary.largest_ratio_deviation - 0.003 / 4.003) < 1e-12);
    assert_true(isnan(map->paths[0].gears[0].ratio_given));
    gm_map_destroy(map);
}

static void a_path_that_does_not_turn_with_its_ratio_is_refused(void **state)
{
    (void)state;
    gm_map *map = NULL;
    source.slip = 1.0001;
    assert_int_equal(sweep((gm_sweep_options){0}, NULL, &map, NULL), GM_ERR_MODEL);
    assert_non_null(strstr(error.message, "by its ratio it should"));
    assert_null(map);
}

static void a_loss_that_grows_faster_than_its_torque_is_refused(void **state)
{
    (void)state;
    gm_map *map = NULL;
    source.load_factor = 90.0; /* 0.01 * 1.3 * 90 > 1 */
    assert_int_equal(sweep((gm_sweep_options){0}, NULL, &map, NULL), GM_ERR_MODEL);
    assert_non_null(strstr(error.message, "no unique motion"));
    assert_null(map);
}

static void a_point_without_solution_is_named(void **state)
{
    (void)state;
    gm_map *map = NULL;
    remove_map("unsolved.map");
    source.unsolvable_above = 100.0;
    assert_int_equal(sweep((gm_sweep_options){.threads = 2}, "unsolved.map", &map, NULL),
                     GM_ERR_SOLVE);
    assert_non_null(strstr(error.message, "gears ("));
    assert_non_null(strstr(error.message, "rad/s"));
    assert_null(map);
    assert_true(access("unsolved.map", F_OK) != 0);
    assert_true(access("unsolved.map.part", F_OK) != 0);
}

static void every_failing_allocation_is_a_clean_error(void **state)
{
    (void)state;
    gm_status status = GM_ERR_MEMORY;
    long k = 1;
    /* Every one at the start, where plan and tables are made, then samples: the solver
       allocates anew with every configuration. */
    for (; status != GM_OK && k < 100000; k += k < 700 ? 1 : 37) {
        gm_map *map = NULL;
        gm_alloc_fail_after(k);
        status = sweep((gm_sweep_options){.threads = 1, .speed_step = 500.0}, NULL, &map,
                       NULL);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK ? map != NULL : map == NULL);
        if (status != GM_OK)
            assert_int_equal(status, GM_ERR_MEMORY);
        gm_map_destroy(map);
    }
    assert_int_equal(status, GM_OK);
    assert_true(k > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(threads_do_not_change_the_result, fresh),
        cmocka_unit_test_setup(options_change_the_hash_and_are_written_down, fresh),
        cmocka_unit_test_setup(steps_give_uniform_axes, fresh),
        cmocka_unit_test_setup(output_axes_reach_the_largest_speed_of_the_slowest_gear,
                               fresh),
        cmocka_unit_test_setup(progress_ends_at_the_total, fresh),
        cmocka_unit_test_setup(an_interrupted_sweep_resumes_to_the_same_map, fresh),
        cmocka_unit_test_setup(an_unwritable_map_is_refused_before_any_point, fresh),
        cmocka_unit_test_setup(axes_by_error_meet_their_tolerance, fresh),
        cmocka_unit_test_setup(axes_by_error_do_not_depend_on_threads, fresh),
        cmocka_unit_test_setup(interrupted_axes_by_error_resume_to_the_same_map, fresh),
        cmocka_unit_test_setup(progress_of_axes_by_error_tells_the_worst_error, fresh),
        cmocka_unit_test_setup(an_absolute_tolerance_takes_fewer_points, fresh),
        cmocka_unit_test_setup(options_out_of_range_are_refused, fresh),
        cmocka_unit_test_setup(a_gearset_without_a_range_is_refused, fresh),
        cmocka_unit_test_setup(a_ratio_that_disagrees_is_refused_with_both_numbers,
                               fresh),
        cmocka_unit_test_setup(a_rounded_ratio_or_none_is_accepted, fresh),
        cmocka_unit_test_setup(a_path_that_does_not_turn_with_its_ratio_is_refused,
                               fresh),
        cmocka_unit_test_setup(a_loss_that_grows_faster_than_its_torque_is_refused,
                               fresh),
        cmocka_unit_test_setup(a_point_without_solution_is_named, fresh),
        cmocka_unit_test_setup(every_failing_allocation_is_a_clean_error, fresh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
