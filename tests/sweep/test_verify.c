/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Verification: what it finds with a map whose truth is known, read through the reduced
 * gearset itself, and with components that are wrong on purpose.
 */
#include "sweep/gm_verify.h"

#include "base/alloc.h"
#include "sweep/gm_sweep.h"
#include "sweep/verify_points.h"
#include "reduced_probe.h"
#include "synthetic.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <string.h>

#define POINTS 1500

static synthetic source, single;
static gm_map *map, *single_map;
static gm_map_view *view, *single_view;
static gm_error error;

static int set_up(void **state)
{
    const gm_sweep_options options = {.threads = 2};
    (void)state;
    synthetic_init(&source, 2);
    synthetic_init(&single, 1);
    return gm_sweep_run(&source.plant, &options, NULL, NULL, NULL, &map, NULL, NULL) ||
           gm_sweep_run(&single.plant, &options, NULL, NULL, NULL, &single_map, NULL,
                        NULL) ||
           gm_map_view_create(map, &view, NULL) ||
           gm_map_view_create(single_map, &single_view, NULL);
}

static int tear_down(void **state)
{
    (void)state;
    gm_map_view_destroy(view);
    gm_map_view_destroy(single_view);
    gm_map_destroy(map);
    gm_map_destroy(single_map);
    return 0;
}

static reduced_probe faithful(void)
{
    return (reduced_probe){.view = view, .loss_factor = 1.0};
}

static gm_verify_result verify(reduced_probe *of, int points, uint64_t seed)
{
    const gm_reduced_probe probe = {reduced_probe_at, of};
    gm_verify_result result;
    const gm_plant *plant = of->view == view ? &source.plant : &single.plant;
    error = (gm_error){GM_OK, ""};
    if (gm_verify_steady(plant, &probe, points, seed, &result, &error) != GM_OK)
        fail_msg("%s", error.message);
    return result;
}

/* What is left is interpolation: sqrt(w) in P and 1/(1 + 0.02 w) in D on 35 nodes, the
   products of X and N on coarse ones. A wrong sign anywhere is some ten per cent. */
static void the_sweep_of_a_known_gearset_is_faithful(void **state)
{
    (void)state;
    static const double limit[GM_VERIFY_GROUPS] = {2e-3, 2e-3, 2e-2, 1e-3, 1e-3};
    reduced_probe of = faithful();
    gm_verify_result result = verify(&of, POINTS, 1);
    for (int g = 0; g < GM_VERIFY_GROUPS; g++)
        if (!(result.max_relative[g] < limit[g]))
            fail_msg("%s: %g", gm_verify_group_name((gm_verify_group)g),
                     result.max_relative[g]);
    gm_verify_result_clear(&result);
}

static void one_path_has_no_pairs(void **state)
{
    (void)state;
    reduced_probe of = {.view = single_view, .loss_factor = 1.0};
    gm_verify_result result = verify(&of, POINTS, 1);
    assert_int_equal(result.n_cases[GM_VERIFY_SINGLE], 3 * 2);
    assert_int_equal(result.n_cases[GM_VERIFY_PRESELECTED], 0);
    assert_int_equal(result.n_cases[GM_VERIFY_BOTH_LOADED], 0);
    assert_int_equal(result.n_cases[GM_VERIFY_DRAG], 2);
    assert_string_equal(result.cases[GM_VERIFY_SINGLE][0].path, "input");
    assert_true(result.max_relative[GM_VERIFY_SINGLE] < 2e-3);
    assert_true(result.max_relative[GM_VERIFY_DRAG] < 1e-3);
    assert_true(result.max_relative[GM_VERIFY_REACTION] < 1e-3);
    gm_verify_result_clear(&result);
}

/* A loss that is 1 % too large is 1 % of the largest loss wrong there. */
static void a_wrong_loss_is_measured(void **state)
{
    (void)state;
    reduced_probe of = faithful();
    of.loss_factor = 1.01;
    gm_verify_result result = verify(&of, POINTS, 2);
    for (int g = GM_VERIFY_SINGLE; g <= GM_VERIFY_BOTH_LOADED; g++) {
        assert_true(result.max_relative[g] > 0.009 && result.max_relative[g] < 0.03);
        assert_true(result.rms_relative[g] > 0.003);
    }
    assert_true(result.max_relative[GM_VERIFY_DRAG] < 1e-3);
    gm_verify_result_clear(&result);
}

static void a_wrong_drag_is_measured_at_its_flange(void **state)
{
    (void)state;
    reduced_probe of = faithful();
    of.drag_offset = 0.5;
    gm_verify_result result = verify(&of, POINTS, 3);
    for (int i = 0; i < result.n_cases[GM_VERIFY_DRAG]; i++) {
        const gm_verify_case *c = &result.cases[GM_VERIFY_DRAG][i];
        assert_true(fabs(c->rms - 0.5) < 0.01 && fabs(c->max - 0.5) < 0.01);
        assert_true(fabs(c->max_relative - c->max / c->largest_loss) < 1e-15);
    }
    gm_verify_result_clear(&result);
}

static void cases_cover_every_gear_pair_and_direction(void **state)
{
    (void)state;
    static const int wanted[GM_VERIFY_GROUPS] = {12, 36, 18, 4, 4};
    reduced_probe of = faithful();
    gm_verify_result result = verify(&of, POINTS, 4);
    for (int g = 0; g < GM_VERIFY_GROUPS; g++) {
        int points = 0;
        assert_int_equal(result.n_cases[g], wanted[g]);
        for (int i = 0; i < wanted[g]; i++) {
            points += result.cases[g][i].points;
            assert_true(result.cases[g][i].points > 0);
            assert_true(result.cases[g][i].largest_loss > 0.0);
        }
        assert_int_equal(points, POINTS);
    }
    gm_verify_result_clear(&result);
}

static void assert_same_case(const gm_verify_case *a, const gm_verify_case *b)
{
    gm_verify_case x = *a, y = *b;
    double squares = 0.0;
    assert_int_equal(a->points, b->points);
    assert_memory_equal(a->point, b->point, (size_t)a->points * sizeof *a->point);
    x.point = y.point = NULL;
    assert_memory_equal(&x, &y, sizeof x);
    for (int i = 0; i < a->points; i++)
        squares += pow(a->point[i].reduced - a->point[i].detailed, 2.0);
    assert_true(fabs(sqrt(squares / a->points) - a->rms) < 1e-12 * a->largest_loss);
}

static void a_seed_gives_the_same_points_again(void **state)
{
    (void)state;
    reduced_probe of = faithful();
    gm_verify_result a = verify(&of, 200, 7), b = verify(&of, 200, 7),
                     c = verify(&of, 200, 8);
    for (int g = 0; g < GM_VERIFY_GROUPS; g++) {
        for (int i = 0; i < a.n_cases[g]; i++)
            assert_same_case(&a.cases[g][i], &b.cases[g][i]);
        assert_true(a.rms_relative[g] != c.rms_relative[g]);
    }
    gm_verify_result_clear(&a);
    gm_verify_result_clear(&b);
    gm_verify_result_clear(&c);
}

/* ---- where points are drawn ---- */

typedef struct seen {
    double lowest, highest, largest_torque, nearest_line;
    int resting;
} seen;

static gm_status see(void *self, double oil, const gm_steady_point *point,
                     double output_torque, gm_reduced_answer *answer, gm_error *e)
{
    seen *s = self;
    (void)oil;
    (void)output_torque;
    (void)e;
    *answer = (gm_reduced_answer){.loss_power = 0.0};
    for (int p = 0; p < 2; p++) {
        double ratio = synthetic_ratio(p, point->gear[p]), w_o = point->speed[0];
        double w = point->gear[p] ? fabs(ratio * w_o) : fabs(point->speed[1 + p]);
        s->highest = fmax(s->highest, w);
        s->largest_torque = fmax(s->largest_torque, fabs(point->torque[1 + p]));
        s->resting += w == 0.0;
        if (w > 0.0)
            s->lowest = fmin(s->lowest, w);
        for (int g = 0; g < 3 && w > 0.0 && !point->gear[p]; g++)
            s->nearest_line =
                fmin(s->nearest_line,
                     fabs(point->speed[1 + p] - source.gears[p][g].ratio_given * w_o));
    }
    return GM_OK;
}

static void points_lie_within_the_gearsets_range(void **state)
{
    (void)state;
    seen s = {.lowest = HUGE_VAL, .nearest_line = HUGE_VAL};
    const gm_reduced_probe probe = {see, &s};
    gm_verify_result result;
    assert_int_equal(gm_verify_steady(&source.plant, &probe, POINTS, 5, &result, NULL),
                     GM_OK);
    assert_true(s.highest <= SYNTHETIC_SPEED_MAX * (1.0 + 1e-12));
    assert_true(s.highest > 0.99 * SYNTHETIC_SPEED_MAX);
    assert_true(s.lowest >
                0.01); /* 1 rpm of the loaded path, less of a preselected one */
    assert_true(s.largest_torque <= SYNTHETIC_TORQUE_MAX);
    assert_true(s.largest_torque > 0.99 * SYNTHETIC_TORQUE_MAX);
    assert_true(s.nearest_line >= GM_LINE_WIDTH);
    assert_true(s.resting > 0);
    /* A component that loses nothing is wrong by all of the loss. */
    for (int g = 0; g < GM_VERIFY_GROUPS; g++)
        assert_true(fabs(result.max_relative[g] - 1.0) < 1e-12);
    gm_verify_result_clear(&result);
}

/* First numbers of SplitMix64 for seed 1234567, from its reference implementation. */
static void random_numbers_are_splitmix64(void **state)
{
    (void)state;
    uint64_t random = 1234567;
    assert_true(gm_random_next(&random) == 6457827717110365317u);
    assert_true(gm_random_next(&random) == 3203168211198807973u);
    assert_true(gm_random_next(&random) == 9817491932198370423u);
    for (int i = 0; i < 1000; i++) {
        double x = gm_random_between(&random, -2.0, 3.0);
        assert_true(x >= -2.0 && x < 3.0);
    }
}

/* ---- failures ---- */

static void no_points_are_refused(void **state)
{
    (void)state;
    reduced_probe of = faithful();
    const gm_reduced_probe probe = {reduced_probe_at, &of};
    gm_verify_result result;
    assert_int_equal(gm_verify_steady(&source.plant, &probe, 0, 1, &result, &error),
                     GM_ERR_ARGUMENT);
}

static void a_failing_component_ends_the_verification(void **state)
{
    (void)state;
    for (int k = 1; k < 60; k += 7) {
        reduced_probe of = faithful();
        const gm_reduced_probe probe = {reduced_probe_at, &of};
        gm_verify_result result;
        of.fail_at = k;
        assert_int_equal(gm_verify_steady(&source.plant, &probe, 10, 1, &result, &error),
                         GM_ERR_TOOL);
        assert_string_equal(error.message, "asked once too often");
    }
}

static void an_answer_that_is_no_number_is_an_error(void **state)
{
    (void)state;
    reduced_probe of = faithful();
    const gm_reduced_probe probe = {reduced_probe_at, &of};
    gm_verify_result result;
    of.loss_factor = nan("");
    assert_int_equal(gm_verify_steady(&source.plant, &probe, 10, 1, &result, &error),
                     GM_ERR_MODEL);
}

static void every_failing_allocation_is_a_clean_error(void **state)
{
    (void)state;
    gm_status status = GM_ERR_MEMORY;
    long k = 1;
    for (; status != GM_OK && k < 10000; k++) {
        reduced_probe of = faithful();
        const gm_reduced_probe probe = {reduced_probe_at, &of};
        gm_verify_result result;
        gm_alloc_fail_after(k);
        status = gm_verify_steady(&source.plant, &probe, 20, 1, &result, &error);
        gm_alloc_fail_after(0);
        if (status == GM_OK)
            gm_verify_result_clear(&result);
        else
            assert_int_equal(status, GM_ERR_MEMORY);
    }
    assert_int_equal(status, GM_OK);
    assert_true(k > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_sweep_of_a_known_gearset_is_faithful),
        cmocka_unit_test(one_path_has_no_pairs),
        cmocka_unit_test(a_wrong_loss_is_measured),
        cmocka_unit_test(a_wrong_drag_is_measured_at_its_flange),
        cmocka_unit_test(cases_cover_every_gear_pair_and_direction),
        cmocka_unit_test(a_seed_gives_the_same_points_again),
        cmocka_unit_test(points_lie_within_the_gearsets_range),
        cmocka_unit_test(random_numbers_are_splitmix64),
        cmocka_unit_test(no_points_are_refused),
        cmocka_unit_test(a_failing_component_ends_the_verification),
        cmocka_unit_test(an_answer_that_is_no_number_is_an_error),
        cmocka_unit_test(every_failing_allocation_is_a_clean_error),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
