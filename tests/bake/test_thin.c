/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Thinning of a map: what stays is right within the tolerance, what is straight goes,
 * and what is measured is what a reader of the tables would find.
 */
#include "bake/thin.h"

#include "base/alloc.h"
#include "example_map.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

typedef struct fixture {
    gm_map *map;
    gm_map_view *view;
} fixture;

static int setup(void **state)
{
    static fixture f;
    gm_error error;
    f.map = example_map(2);
    assert_int_equal(gm_map_view_create(f.map, &f.view, &error), GM_OK);
    *state = &f;
    return 0;
}

static int teardown(void **state)
{
    fixture *f = *state;
    gm_map_view_destroy(f->view);
    gm_map_destroy(f->map);
    return 0;
}

static gm_thin *thin_of(const fixture *f, double tolerance, gm_thin_stored *stored)
{
    gm_thin *thin = NULL;
    gm_error error;
    const gm_reduced_map *map = gm_map_view_reduced(f->view);
    assert_int_equal(gm_thin_create(map, tolerance, stored, &thin, &error), GM_OK);
    return thin;
}

static void no_tolerance_keeps_everything(void **state)
{
    gm_thin_loss loss[GM_THIN_KINDS];
    gm_thin *thin = thin_of(*state, 0.0, NULL);
    gm_thin_measure(thin, loss);
    for (int k = 0; k < GM_THIN_KINDS; k++) {
        assert_int_equal(loss[k].nodes, loss[k].kept);
        assert_true(loss[k].most == 0.0);
    }
    gm_thin_destroy(thin);
}

static double value2(const gm_table2 *t, double x, double y)
{
    gm_cell2 cell = {0};
    return gm_table2_at(t, 1, &cell, x, y).value;
}

/* Load loss between the nodes too: both are multilinear in the map's cells. */
static void errors_stay_within_the_tolerance(void **state)
{
    const fixture *f = *state;
    const double tolerance = 0.02;
    gm_thin *thin = thin_of(f, tolerance, NULL);
    const gm_gear *before = gm_map_view_reduced(f->view)->path[0].gears;
    const gm_gear *after = gm_thin_map(thin)->path[0].gears;
    gm_thin_loss loss[GM_THIN_KINDS];
    double largest = 0.0, most = 0.0;
    const gm_table2 *a = &before[0].load_loss[0], *b = &after[0].load_loss[0];
    const double x_end = a->x.x[a->x.n - 1], y_0 = a->y.x[0];
    const double y_end = a->y.x[a->y.n - 1];
    for (int i = 0; i <= 200; i++)
        for (int j = 0; j <= 200; j++) {
            const double x = x_end * i / 200, y = y_0 + (y_end - y_0) * j / 200;
            const double truth = value2(a, x, y);
            largest = fmax(largest, fabs(truth));
            most = fmax(most, fabs(value2(b, x, y) - truth));
        }
    gm_thin_measure(thin, loss);
    assert_true(most <= loss[GM_LOAD_LOSS].most + 1e-12 * largest); /* rounding */
    assert_true(loss[GM_LOAD_LOSS].relative <= tolerance);
    for (int k = 0; k < GM_THIN_KINDS; k++) {
        assert_true(loss[k].relative <= tolerance);
        assert_true(loss[k].root_mean_sq <= loss[k].relative);
        assert_true(loss[k].kept <= loss[k].nodes);
    }
    assert_true(loss[GM_LOAD_LOSS].kept < loss[GM_LOAD_LOSS].nodes);
    gm_thin_destroy(thin);
}

static double halves(double value, double most)
{
    return most > 0.0 ? rint(2.0 * value / most) * most / 2.0 : 0.0;
}

/* A storage of three values: at most a quarter of the largest is lost, and it is told. */
static void rounding_is_measured(void **state)
{
    gm_thin_loss loss[GM_THIN_KINDS];
    gm_thin *thin = thin_of(*state, 0.0, halves);
    gm_thin_measure(thin, loss);
    assert_true(loss[GM_LOAD_LOSS].relative > 0.05);
    assert_true(loss[GM_LOAD_LOSS].relative <= 0.25);
    gm_thin_destroy(thin);
}

static void failed_allocations_are_errors(void **state)
{
    const fixture *f = *state;
    const gm_reduced_map *map = gm_map_view_reduced(f->view);
    for (int k = 1; k < 2000; k++) {
        gm_thin *thin = NULL;
        gm_error error;
        gm_alloc_fail_after(k);
        const gm_status status = gm_thin_create(map, 0.01, NULL, &thin, &error);
        gm_alloc_fail_after(0);
        if (status == GM_OK) {
            gm_thin_destroy(thin);
            return;
        }
        assert_int_equal(status, GM_ERR_MEMORY);
        assert_null(thin);
    }
    fail();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(no_tolerance_keeps_everything, setup, teardown),
        cmocka_unit_test_setup_teardown(errors_stay_within_the_tolerance, setup,
                                        teardown),
        cmocka_unit_test_setup_teardown(rounding_is_measured, setup, teardown),
        cmocka_unit_test_setup_teardown(failed_allocations_are_errors, setup, teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
