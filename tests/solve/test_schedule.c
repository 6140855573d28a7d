/* SPDX-License-Identifier: BSD-2-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/alloc.h"
#include "solve/gm_schedule.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define RPM 0.10471975511965977 /* rad/s */

/* ---- a plant with two paths, of which only names, gears and ratios are asked ---- */

static const gm_plant_gear odd_gears[] = {{1, (double)NAN}, {3, (double)NAN}};
static const gm_plant_gear even_gears[] = {{-1, (double)NAN}, {2, (double)NAN}};

static gm_status kinematics(const void *self, const int *gear, gm_kinematics *k,
                            gm_error *error)
{
    (void)self, (void)error;
    memset(k, 0, sizeof *k);
    k->ratio[0] = gear[0] ? 12.0 / gear[0] : 0.0;
    k->ratio[1] = gear[1] ? 12.0 / gear[1] : 0.0;
    return GM_OK;
}

static const gm_plant_class plant_class = {.kinematics = kinematics};
static const gm_plant plant = {
    .is = &plant_class,
    .info = {.n_paths = 2,
             .path = {{.name = "odd", .n_gears = 2, .gears = odd_gears},
                      {.name = "even", .n_gears = 2, .gears = even_gears}}}};

static const char file_name[] = "schedule_test.csv";

static gm_status read_text(const char *text, gm_schedule **s, gm_error *error)
{
    FILE *file = fopen(file_name, "wb");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
    gm_status status = gm_schedule_read(file_name, &plant.info, s, error);
    assert_int_equal(unlink(file_name), 0);
    return status;
}

static gm_schedule *read_well(const char *text)
{
    gm_schedule *s = NULL;
    gm_error error = {0};
    if (read_text(text, &s, &error) != GM_OK)
        fail_msg("%s", error.message);
    return s;
}

/* ---- reading ---- */

static void reads_columns_in_any_order_with_their_units(void **state)
{
    (void)state;
    gm_schedule *s = read_well("\xEF\xBB\xBF# a comment\r\n"
                               "odd.gear, output.speed_rpm, time_s, even.tau_Nm,"
                               " oil_temperature_degC, even.w_start_rpm\r\n"
                               "\r\n"
                               "1, 60, 0, -5.5, 80, 600\r\n"
                               ", 120, 2.5, 1e1,,\r\n"
                               "3, 120, 4, 0, 80, 600");
    assert_int_equal(s->n_rows, 3);
    assert_true(s->driven[0] && !s->driven[1] && !s->driven[2]);
    assert_true(fabs(s->rows[0].value[0] - 60.0 * RPM) < 1e-12);
    assert_true(s->rows[0].value[2] == -5.5 && s->rows[1].value[2] == 10.0);
    assert_true(s->rows[1].t == 2.5);
    assert_int_equal(s->rows[1].gear[0], 1); /* empty: as before */
    assert_int_equal(s->rows[2].gear[0], 3);
    assert_int_equal(s->rows[2].gear[1], 0); /* no column: neutral */
    assert_true(fabs(s->oil_temperature - 353.15) < 1e-12);
    assert_true(fabs(s->start_speed[2] - 600.0 * RPM) < 1e-12);
    assert_true(isnan(s->start_speed[1]));
    gm_schedule_destroy(s);
}

static void refuses(const char *text, const char *sentence)
{
    gm_schedule *s = NULL;
    gm_error error = {0};
    assert_int_equal(read_text(text, &s, &error), GM_ERR_FORMAT);
    assert_null(s);
    char expected[512];
    (void)snprintf(expected, sizeof expected, "%s%s", file_name, sentence);
    assert_string_equal(error.message, expected);
}

static void says_what_is_wrong_and_where(void **state)
{
    (void)state;
    refuses("", ": found no line with names of columns, such as time_s");
    refuses("time_s,odd.tau\n0,1\n",
            ":1: there is no column 'odd.tau', did you mean odd.tau_Nm?");
    refuses("time_s,something_else\n",
            ":1: there is no column 'something_else'; there are time_s, output.tau_Nm, "
            "output.speed_rpm, odd.tau_Nm, odd.speed_rpm, odd.gear and more");
    refuses("time_s;odd.gear\n0;1\n",
            ":1: found 'time_s;odd.gear'; columns are separated by commas");
    refuses("odd.tau_Nm\n1\n", ":1: the column time_s is missing");
    refuses("time_s,odd.gear,odd.gear\n", ":1: the column odd.gear stands twice");
    refuses("time_s,odd.tau_Nm,odd.speed_rpm\n0,1,2\n",
            ":1: columns odd.tau_Nm and odd.speed_rpm: a flange is given its torque or "
            "its speed, not both");
    refuses("time_s,odd.speed_rpm,odd.w_start_rpm\n0,1,2\n",
            ":1: columns odd.speed_rpm and odd.w_start_rpm: the speed starts where its "
            "own column says");
    refuses("time_s,odd.tau_Nm\n0,12\n1,3 Nm\n",
            ":3: column odd.tau_Nm: found '3 Nm', expected a number");
    refuses("time_s,odd.tau_Nm\n0,nan\n",
            ":2: column odd.tau_Nm: found 'nan', expected a number");
    refuses("time_s,odd.tau_Nm\n0,\n",
            ":2: column odd.tau_Nm: found '', expected a number");
    refuses("time_s,odd.gear\n0,2\n",
            ":2: column odd.gear: found '2', expected a gear of this path: 0, 1, 3");
    refuses("time_s,odd.gear\n0,1.0\n",
            ":2: column odd.gear: found '1.0', expected a gear of this path: 0, 1, 3");
    refuses("time_s,odd.tau_Nm\n0,1\n2,1\n1.5,1\n",
            ":4: column time_s: found 1.5, expected at least 2, the time of the row "
            "before");
    refuses("time_s,odd.tau_Nm\n0,1\n0,2\n0,3\n1,1\n",
            ":4: column time_s: found 0 for the third time; twice makes a step, from the "
            "first row's values to the second's");
    refuses("time_s,odd.tau_Nm\n0,1\n1\n",
            ":3: found 1 values, expected 2, one for each column");
    refuses("time_s,odd.tau_Nm\n0,1\n1,2,3\n",
            ":3: found 3 values, expected 2, one for each column");
    refuses("time_s,oil_temperature_degC\n0,80\n1,90\n",
            ":3: column oil_temperature_degC: found '90', expected what the first row "
            "says or nothing: it belongs to the start");
    refuses(
        "time_s,odd.tau_Nm\n0,1\n",
        ": found no two rows with different times; a schedule has a start and an end");
    refuses("time_s,odd.tau_Nm\n0,\x01\x02 an overlong cell that goes on and on and on\n",
            ":2: column odd.tau_Nm: found '?? an overlong cell that goes on and on ...', "
            "expected a number");
}

static void a_missing_file_and_a_long_line_are_refused(void **state)
{
    (void)state;
    gm_schedule *s = NULL;
    gm_error error = {0};
    assert_int_equal(gm_schedule_read("no_such.csv", &plant.info, &s, &error), GM_ERR_IO);
    assert_string_equal(error.message,
                        "no_such.csv: cannot be opened: No such file or directory");
    static char text[6000];
    memset(text, 'x', sizeof text - 1);
    refuses(text, ":1: the line has more than 4094 characters");
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    gm_status status = GM_ERR_MEMORY;
    int k;
    for (k = 1; status != GM_OK; k++) {
        gm_schedule *s = NULL;
        gm_alloc_fail_after(k);
        status = read_text("time_s,odd.tau_Nm\n0,1\n1,2\n", &s, NULL);
        gm_alloc_fail_after(0);
        assert_true(status == GM_OK || status == GM_ERR_MEMORY);
        gm_schedule_destroy(s);
    }
    assert_true(k > 4);
}

/* ---- as a drive ---- */

static double torque_at(const gm_drive *drive, double t)
{
    gm_drive_point point = {0};
    drive->at(drive->user, t, &point);
    return point.input.torque[1];
}

static void runs_on_straight_lines_and_steps_where_a_time_stands_twice(void **state)
{
    (void)state;
    gm_schedule *s = read_well("time_s,odd.tau_Nm,output.speed_rpm,odd.gear\n"
                               "1,0,60,1\n2,10,60,1\n2,20,60,1\n3,20,60,1\n4,20,60,1\n"
                               "5,20,60,3\n6,20,120,3\n");
    gm_schedule_reader reader = {.schedule = s};
    gm_drive drive = gm_schedule_drive(&reader);
    gm_drive_point point = {0};
    int jump = 1;
    assert_true(drive.driven[0] && !drive.driven[1]);
    assert_true(drive.enter(drive.user, 1.0, &jump) == 2.0 && !jump);
    assert_true(torque_at(&drive, 1.25) == 2.5 && torque_at(&drive, 2.0) == 10.0);
    /* nothing happens at 3 and 4: one piece up to the shift at 5 */
    assert_true(drive.enter(drive.user, 2.0, &jump) == 5.0 && jump);
    assert_true(torque_at(&drive, 2.0) == 20.0 && torque_at(&drive, 4.5) == 20.0);
    assert_true(drive.enter(drive.user, 5.0, &jump) == 6.0 && jump);
    drive.at(drive.user, 5.5, &point);
    assert_int_equal(point.input.gear[0], 3);
    assert_true(fabs(point.speed[0] - 90.0 * RPM) < 1e-12);
    assert_true(fabs(point.acceleration[0] - 60.0 * RPM) < 1e-12);
    /* after the end all stays, and a kink is no jump */
    assert_true(isinf(drive.enter(drive.user, 6.0, &jump)) && !jump);
    drive.at(drive.user, 7.5, &point);
    assert_true(fabs(point.speed[0] - 120.0 * RPM) < 1e-12);
    assert_true(point.acceleration[0] == 0.0);
    gm_schedule_destroy(s);
}

static void a_step_at_the_very_start_begins_with_its_end(void **state)
{
    (void)state;
    gm_schedule *s = read_well("time_s,odd.tau_Nm\n0,5\n0,7\n1,7\n");
    gm_schedule_reader reader = {.schedule = s};
    gm_drive drive = gm_schedule_drive(&reader);
    int jump = 1;
    assert_true(isinf(drive.enter(drive.user, 0.0, &jump)) || !jump);
    assert_true(torque_at(&drive, 0.0) == 7.0);
    gm_schedule_destroy(s);
}

/* ---- the start ---- */

static void start_is(const char *text, double output, double odd, double even)
{
    gm_schedule *s = read_well(text);
    double speed[GM_MAX_FLANGES] = {0.0};
    gm_error error = {0};
    assert_int_equal(gm_schedule_start_speeds(s, &plant, speed, &error), GM_OK);
    assert_true(fabs(speed[0] - output * RPM) < 1e-9);
    assert_true(fabs(speed[1] - odd * RPM) < 1e-9);
    assert_true(fabs(speed[2] - even * RPM) < 1e-9);
    gm_schedule_destroy(s);
}

static void starts_as_given_and_as_the_gears_make_it(void **state)
{
    (void)state;
    start_is("time_s\n0\n1\n", 0.0, 0.0, 0.0);
    start_is("time_s,output.speed_rpm,odd.gear,even.gear\n0,50,3,2\n1,80,3,2\n", 50.0,
             200.0, 300.0);
    start_is("time_s,odd.speed_rpm,odd.gear,even.w_start_rpm\n0,240,1,7\n1,0,1,\n", 20.0,
             240.0, 7.0);
    start_is("time_s,odd.w_start_rpm,even.gear,odd.gear\n0,240,-1,1\n1,,-1,1\n", 20.0,
             240.0, -240.0);
}

static void starts_that_disagree_are_refused(void **state)
{
    (void)state;
    gm_schedule *s = read_well("time_s,output.speed_rpm,odd.speed_rpm,odd.gear\n"
                               "0,50,500,1\n1,50,500,1\n");
    double speed[GM_MAX_FLANGES];
    gm_error error = {0};
    assert_int_equal(gm_schedule_start_speeds(s, &plant, speed, &error), GM_ERR_MODEL);
    assert_string_equal(error.message,
                        "schedule_test.csv: odd starts with 500 rpm, but in gear 1 it "
                        "turns with 600 rpm while the output turns with 50 rpm");
    gm_schedule_destroy(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_columns_in_any_order_with_their_units),
        cmocka_unit_test(says_what_is_wrong_and_where),
        cmocka_unit_test(a_missing_file_and_a_long_line_are_refused),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(runs_on_straight_lines_and_steps_where_a_time_stands_twice),
        cmocka_unit_test(a_step_at_the_very_start_begins_with_its_end),
        cmocka_unit_test(starts_as_given_and_as_the_gears_make_it),
        cmocka_unit_test(starts_that_disagree_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
