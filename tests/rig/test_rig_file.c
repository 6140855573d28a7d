/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The rig file: its page has the schema, the example is read, and no allocation that
 * fails leaves anything behind.
 */
#include "plant/gm_rig_file.h"

#include "base/alloc.h"
#include "common/schema_page.h"
#include "common/test_file.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#define DOCS GM_SOURCE_DIR "/docs/rig.md"

/* A rig file beside which lies its model: itself will do. */
static const char text[] =
    "format: 1\n"
    "name: box\n"
    "model: %s\n"
    "limits: {input_speed_max_rpm: 6000, input_torque_max_Nm: 250}\n"
    "paths:\n"
    "  even:\n"
    "    torque: {variable: t2, unit: kN.m, sign: minus}\n"
    "    speed: {variable: n2}\n"
    "    gear: {variable: g2}\n"
    "    gears:\n"
    "      4: {ratio: 3, command: 104}\n"
    "      2: {ratio: 9}\n"
    "  odd:\n"
    "    drive: speed\n"
    "    gears: {1: {ratio: -14}}\n"
    "    neutral: false\n"
    "    inertia_kgm2: 0.02\n";

static void write_rig(void)
{
    FILE *file = fopen(test_file_path(), "wb");
    assert_non_null(file);
    assert_true(fprintf(file, text, test_file_path()) > 0);
    assert_int_equal(fclose(file), 0);
}

static void paths_and_gears_come_in_order(void **state)
{
    gm_rig_file *file = NULL;
    gm_error error = {GM_OK, ""};
    gm_plant_gear gears[GM_MAX_INPUT_PATHS][32];
    (void)state;
    write_rig();
    assert_int_equal(gm_rig_file_read(test_file_path(), &file, &error), GM_OK);
    assert_string_equal(file->paths[0].id.name, "odd");
    assert_int_equal(file->paths[0].flange.drive, GM_RIG_SPEED_IN);
    assert_true(file->paths[0].inertia == 0.02 && isnan(file->paths[1].inertia));
    assert_int_equal(file->paths[1].gears[0].number, 2);
    assert_true(file->paths[1].gears[1].command == 104.0);
    assert_int_equal(file->paths[1].flange.torque.sign, -1);
    assert_null(file->paths[0].gear.variable);
    gm_plant_info info = gm_rig_file_info(file, gears);
    assert_int_equal(info.n_paths, 2);
    assert_true(info.path[0].always_engaged && !info.path[1].always_engaged);
    assert_true(info.coupled);
    assert_true(gears[0][0].ratio_given == -14.0);
    assert_int_equal(strlen(info.source_sha256), 64);
    gm_rig_file_destroy(file);
}

static void a_rig_file_is_told_from_a_description(void **state)
{
    (void)state;
    write_rig();
    assert_int_equal(gm_rig_file_is_one(test_file_path()), 1);
    assert_int_equal(gm_rig_file_is_one(GM_SOURCE_DIR "/examples/dct7.yaml"), 0);
    assert_int_equal(gm_rig_file_is_one("/no/such/file"), 0);
}

static void failed_allocations_leave_nothing(void **state)
{
    gm_error error = {GM_OK, ""};
    gm_status status = GM_ERR_MEMORY;
    long k = 1;
    (void)state;
    write_rig();
    for (; status != GM_OK && k < 10000; k++) {
        gm_rig_file *file = NULL;
        gm_alloc_fail_after(k);
        status = gm_rig_file_read(test_file_path(), &file, &error);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || status == GM_ERR_MEMORY);
        assert_true((file != NULL) == (status == GM_OK));
        gm_rig_file_destroy(file);
    }
    assert_true(status == GM_OK && k > 20);
}

static void docs_have_the_schema(void **state)
{
    (void)state;
    schema_page_check(gm_rig_file_help, DOCS, "rig_fields.md");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(paths_and_gears_come_in_order),
        cmocka_unit_test(a_rig_file_is_told_from_a_description),
        cmocka_unit_test(failed_allocations_leave_nothing),
        cmocka_unit_test(docs_have_the_schema),
    };
    return cmocka_run_group_tests(tests, test_file_make, test_file_remove);
}
