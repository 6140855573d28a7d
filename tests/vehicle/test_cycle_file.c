/* SPDX-License-Identifier: BSD-2-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/alloc.h"
#include "common/test_file.h"
#include "vehicle/gm_cycle.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static gm_cycle *read_cycle(const char *text)
{
    gm_cycle *cycle = NULL;
    gm_error error;
    test_file_write(text);
    assert_int_equal(gm_cycle_read(test_file_path(), &cycle, &error), GM_OK);
    return cycle;
}

static void refused(const char *text, const char *sentence)
{
    gm_cycle *cycle = NULL;
    gm_error error;
    test_file_write(text);
    assert_int_equal(gm_cycle_read(test_file_path(), &cycle, &error), GM_ERR_FORMAT);
    assert_null(cycle);
    assert_memory_equal(error.message, test_file_path(), strlen(test_file_path()));
    assert_string_equal(error.message + strlen(test_file_path()), sentence);
}

static void speeds_and_gears_are_read(void **state)
{
    (void)state;
    gm_cycle *c =
        read_cycle("time_s,speed_km_h,gear\n0,0,1\n10,36,\n20,72,2\n21.5,0,0\n");
    assert_true(gm_cycle_duration(c) == 21.5);
    assert_true(fabs(gm_cycle_distance(c) - (50.0 + 150.0 + 15.0)) < 1e-9);
    assert_int_equal(c->n_gears, 3);
    assert_true(c->gears[0].time == 0.0 && c->gears[0].gear == 1);
    assert_true(c->gears[1].time == 20.0 && c->gears[1].gear == 2);
    assert_true(c->gears[2].time == 21.5 && c->gears[2].gear == 0);
    assert_true(gm_cycle_grade(c, 5.0) == 0.0);
    assert_non_null(strstr(test_file_path(), c->name));
    gm_cycle_destroy(c);
}

/* Columns in any order; the grade runs linearly from 0 to 10 %, averaged over 1 s. */
static void grades_are_read(void **state)
{
    (void)state;
    gm_cycle *c = read_cycle("grade_percent,speed_km_h,time_s\n0,10,0\n10,10,20\n");
    assert_int_equal(c->n_gears, 0);
    assert_true(fabs(gm_cycle_grade(c, 10.0) - 0.05) < 1e-12);
    assert_true(fabs(gm_cycle_grade(c, 30.0) - 0.10) < 1e-12);
    assert_true(fabs(gm_cycle_grade(c, 0.0) - 0.5 * 0.5 * 0.0025) < 1e-12);
    gm_cycle_destroy(c);
}

static void nothing_is_guessed(void **state)
{
    (void)state;
    const char *gear = "expected the number of a forward gear, or 0";
    char sentence[128];
    refused("time_s\n0\n1\n", ":1: the column speed_km_h is missing");
    refused("speed_km_h\n0\n1\n", ":1: the column time_s is missing");
    refused("time_s,speed_m_s\n0,0\n",
            ":1: there is no column 'speed_m_s', did you mean speed_km_h?");
    refused("time_s,speed_km_h\n0,0\n", ": found 1 rows; a cycle has a start and an end");
    refused("time_s,speed_km_h\n1,0\n2,0\n",
            ":2: column time_s: found '1', expected 0: a cycle starts there");
    refused("time_s,speed_km_h\n0,0\n1,0\n1,0\n",
            ":4: column time_s: found '1', expected more than in the row before");
    refused("time_s,speed_km_h\n0,0\n1,-3\n",
            ":3: column speed_km_h: found '-3', expected 0 to 500 km/h");
    refused("time_s,speed_km_h,grade_percent\n0,0,60\n",
            ":2: column grade_percent: found '60', expected -50 to 50 %");
    (void)snprintf(sentence, sizeof sentence, ":2: column gear: found '', %s", gear);
    refused("time_s,speed_km_h,gear\n0,0,\n1,0,1\n", sentence);
    (void)snprintf(sentence, sizeof sentence, ":3: column gear: found '-1', %s", gear);
    refused("time_s,speed_km_h,gear\n0,0,1\n1,0,-1\n", sentence);
}

static void no_memory_is_an_error(void **state)
{
    (void)state;
    gm_cycle *c = NULL;
    gm_error error;
    gm_status status = GM_ERR_MEMORY;
    test_file_write("time_s,speed_km_h,gear,grade_percent\n0,0,1,0\n9,9,1,1\n");
    for (int k = 1; status != GM_OK; k++) {
        gm_alloc_fail_after(k);
        status = gm_cycle_read(test_file_path(), &c, &error);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || (status == GM_ERR_MEMORY && !c));
        assert_true(k < 20);
    }
    gm_cycle_destroy(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(speeds_and_gears_are_read),
        cmocka_unit_test(grades_are_read),
        cmocka_unit_test(nothing_is_guessed),
        cmocka_unit_test(no_memory_is_an_error),
    };
    return cmocka_run_group_tests(tests, test_file_make, test_file_remove);
}
