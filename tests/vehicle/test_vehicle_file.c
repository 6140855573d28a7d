/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The vehicle file: the example is the reference, what is wrong is refused where it
 * stands, and docs/vehicle.md has the schema.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/alloc.h"
#include "common/schema_page.h"
#include "common/test_file.h"
#include "vehicle/gm_vehicle.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXAMPLE GM_SOURCE_DIR "/examples/vehicle_c_segment.yaml"
#define DOCS GM_SOURCE_DIR "/docs/vehicle.md"

/* The example with `what` (which it contains) replaced. */
static void write_changed(const char *what, const char *by)
{
    static char text[8192];
    test_file_load(EXAMPLE, text, sizeof text);
    char *at = strstr(text, what);
    assert_non_null(at);
    FILE *file = fopen(test_file_path(), "wb");
    assert_non_null(file);
    assert_true(fprintf(file, "%.*s%s%s", (int)(at - text), text, by, at + strlen(what)) >
                0);
    assert_int_equal(fclose(file), 0);
}

static void same(const gm_vehicle *a, const gm_vehicle *b)
{
    const double *x = (const double *)a, *y = (const double *)b;
    size_t before = offsetof(gm_vehicle, full_load) / sizeof *x;
    size_t after = (offsetof(gm_vehicle, full_load) + sizeof a->full_load) / sizeof *x;
    for (size_t i = 0; i < sizeof *a / sizeof *x; i++)
        if (i < before || i >= after)
            assert_true(fabs(x[i] - y[i]) <= 1e-15 * fabs(x[i]));
    assert_int_equal(a->full_load.n, b->full_load.n);
    for (int i = 0; i < a->full_load.n; i++) {
        double w = a->full_load.point[i].speed;
        assert_true(fabs(w - b->full_load.point[i].speed) <= 1e-15 * w);
        assert_true(a->full_load.point[i].torque == b->full_load.point[i].torque);
    }
}

static void the_example_is_the_reference(void **state)
{
    (void)state;
    gm_vehicle reference = gm_vehicle_reference(), car;
    gm_error error;
    assert_int_equal(gm_vehicle_read(EXAMPLE, &car, &error), GM_OK);
    same(&reference, &car);
}

static void defaults_are_those_of_the_reference(void **state)
{
    (void)state;
    static char text[8192];
    gm_vehicle reference = gm_vehicle_reference(), car;
    gm_error error;
    test_file_load(EXAMPLE, text, sizeof text);
    *strstr(text, "driver:") = '\0';
    char *road = strstr(text, "road:"), *next = strstr(text, "driveshafts:");
    memmove(road, next, strlen(next) + 1);
    for (const char *const *key = (const char *const[]){"launch_speed", "launch_gain",
                                                        "slip_rad", "idle_gain", NULL};
         *key; key++) {
        char *at = strstr(text, *key), *end = strchr(at, '\n');
        memmove(at, end, strlen(end) + 1);
    }
    test_file_write(text);
    assert_int_equal(gm_vehicle_read(test_file_path(), &car, &error), GM_OK);
    same(&reference, &car);
}

static void options_are_read(void **state)
{
    (void)state;
    gm_vehicle car;
    gm_error error;
    write_changed("# tyres:", "tyres:");
    assert_int_equal(gm_vehicle_read(test_file_path(), &car, &error), GM_OK);
    assert_true(car.tyre_stiffness == 1e5 && car.tyre_force_max == 7000.0);
    assert_true(car.mount_inertia == 0.0);
    write_changed("# mounts:", "mounts:");
    assert_int_equal(gm_vehicle_read(test_file_path(), &car, &error), GM_OK);
    assert_true(car.mount_inertia == 12.0 && car.mount_stiffness == 47000.0);
    write_changed("grade_percent: 0", "grade_percent: -4");
    assert_int_equal(gm_vehicle_read(test_file_path(), &car, &error), GM_OK);
    assert_true(fabs(car.grade + 0.04) < 1e-15);
}

static void refused(const char *what, const char *by, const char *sentence)
{
    gm_vehicle car = {.mass = -1.0};
    gm_error error;
    write_changed(what, by);
    assert_int_equal(gm_vehicle_read(test_file_path(), &car, &error), GM_ERR_FORMAT);
    assert_true(car.mass == -1.0);
    assert_memory_equal(error.message, test_file_path(), strlen(test_file_path()));
    assert_non_null(strstr(error.message, sentence));
}

static void what_is_wrong_is_refused_where_it_stands(void **state)
{
    (void)state;
    refused("mass_kg: 1416", "mass_kg: 1.4 t",
            ":16: body: mass_kg must be a number in kg greater than 0");
    refused("mass_kg: 1416", "mas_kg: 1416", "mass_kg");
    refused("  mass_kg: 1416", "  #", "mass_kg is missing");
    refused("radius_mm: 316", "radius_mm: 0.316", "radius_mm must be a number in mm");
    refused("speed_rpm: 1500", "speed_rpm: 750",
            ":33: engine: full_load: speeds must increase");
    refused("# tyres:  {slip_stiffness_N: 100000, ", "tyres: {",
            "slip_stiffness_N is missing");
}

static void a_file_that_is_not_there_is_an_error(void **state)
{
    (void)state;
    gm_vehicle car;
    gm_error error;
    assert_int_equal(gm_vehicle_read("/nonexistent.yaml", &car, &error), GM_ERR_IO);
    gm_status status = GM_ERR_MEMORY;
    int k = 1;
    for (; status != GM_OK; k++) {
        gm_alloc_fail_after(k);
        status = gm_vehicle_read(EXAMPLE, &car, &error);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || status == GM_ERR_MEMORY);
        assert_true(k < 2000);
    }
    assert_true(k > 10);
}

static void docs_have_the_schema(void **state)
{
    (void)state;
    schema_page_check(gm_vehicle_help, DOCS, "vehicle_fields.md");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_example_is_the_reference),
        cmocka_unit_test(defaults_are_those_of_the_reference),
        cmocka_unit_test(options_are_read),
        cmocka_unit_test(what_is_wrong_is_refused_where_it_stands),
        cmocka_unit_test(a_file_that_is_not_there_is_an_error),
        cmocka_unit_test(docs_have_the_schema),
    };
    return cmocka_run_group_tests(tests, test_file_make, test_file_remove);
}
