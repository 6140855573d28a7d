/* SPDX-License-Identifier: BSD-2-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/alloc.h"
#include "base/csv.h"
#include "common/test_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const known[] = {"time_s", "speed_km_h", "gear"};
enum { N_KNOWN = 3 };

/* Reads to the end; the first failure. *sum: of all numbers. */
static gm_status read_all(double *sum, gm_error *error)
{
    gm_csv *csv = NULL;
    bool more = true;
    gm_status status = gm_csv_open(test_file_path(), &csv, error);
    if (status == GM_OK)
        status = gm_csv_read_header(csv, known, N_KNOWN, "time_s and speed_km_h", error);
    *sum = 0.0;
    while (status == GM_OK && more) {
        status = gm_csv_read_row(csv, &more, error);
        for (int i = 0; more && status == GM_OK && i < gm_csv_n_columns(csv); i++) {
            double x = 0.0;
            status = gm_csv_number(csv, i, &x, error);
            *sum += x;
        }
    }
    gm_csv_close(csv);
    return status;
}

static void refused(const char *text, const char *sentence)
{
    gm_error error;
    double sum;
    test_file_write(text);
    assert_int_equal(read_all(&sum, &error), GM_ERR_FORMAT);
    assert_memory_equal(error.message, test_file_path(), strlen(test_file_path()));
    assert_string_equal(error.message + strlen(test_file_path()), sentence);
}

static void reads_what_spreadsheets_write(void **state)
{
    (void)state;
    gm_error error;
    double sum;
    test_file_write("\xEF\xBB\xBF# a comment\r\n\r\n gear ,\tspeed_km_h\r\n 1 , 2.5\r\n"
                    "# more\n 3,4e1 ");
    assert_int_equal(read_all(&sum, &error), GM_OK);
    assert_true(sum == 46.5);
}

static void columns_are_found_by_name(void **state)
{
    (void)state;
    gm_csv *csv = NULL;
    gm_error error;
    bool more;
    test_file_write("gear,time_s\n7,8\n");
    assert_int_equal(gm_csv_open(test_file_path(), &csv, &error), GM_OK);
    assert_int_equal(gm_csv_read_header(csv, known, N_KNOWN, "", &error), GM_OK);
    assert_true(gm_csv_has(csv, 0) && !gm_csv_has(csv, 1) && gm_csv_has(csv, 2));
    assert_int_equal(gm_csv_n_columns(csv), 2);
    assert_int_equal(gm_csv_column(csv, 0), 2);
    assert_int_equal(gm_csv_read_row(csv, &more, &error), GM_OK);
    assert_true(more && gm_csv_line(csv) == 2);
    assert_string_equal(gm_csv_cell(csv, 1), "8");
    assert_int_equal(gm_csv_read_row(csv, &more, &error), GM_OK);
    assert_false(more);
    gm_csv_close(csv);
}

static void nothing_is_guessed(void **state)
{
    (void)state;
    refused("", ": found no line with names of columns, such as time_s");
    refused("time_s,sped_km_h\n",
            ":1: there is no column 'sped_km_h', did you mean speed_km_h?");
    refused("time_s,torque\n",
            ":1: there is no column 'torque'; there are time_s and speed_km_h");
    refused("time_s;gear\n", ":1: found 'time_s;gear'; columns are separated by commas");
    refused("time_s,time_s\n", ":1: the column time_s stands twice");
    refused("time_s,gear\n1\n", ":2: found 1 values, expected 2, one for each column");
    refused("time_s\n1\n2,5\n", ":3: found 2 values, expected 1, one for each column");
    refused("time_s\n30 s\n", ":2: column time_s: found '30 s', expected a number");
    refused("time_s\nnan\n", ":2: column time_s: found 'nan', expected a number");
    refused("time_s\n\x1B[31m\n", ":2: column time_s: found '?[31m', expected a number");
}

static void long_lines_are_refused(void **state)
{
    (void)state;
    static char text[2 * GM_CSV_LINE];
    memset(text, '1', sizeof text - 1);
    memcpy(text, "time_s\n", 7);
    refused(text, ":2: the line has more than 4094 characters");
}

static void cells_are_shown_in_part(void **state)
{
    (void)state;
    char text[200] = "time_s\n", sentence[200];
    const char *forty = "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx";
    strcat(strcat(text, forty), "yyyy\n");
    (void)snprintf(sentence, sizeof sentence,
                   ":2: column time_s: found '%s...', expected a number", forty);
    refused(text, sentence);
}

static void failures_are_told(void **state)
{
    (void)state;
    gm_csv *csv = NULL;
    gm_error error;
    assert_int_equal(gm_csv_open("/nonexistent/x.csv", &csv, &error), GM_ERR_IO);
    test_file_write("time_s\n");
    gm_alloc_fail_after(1);
    assert_int_equal(gm_csv_open(test_file_path(), &csv, &error), GM_ERR_MEMORY);
    gm_alloc_fail_after(0);
    assert_null(csv);
    gm_csv_close(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_what_spreadsheets_write),
        cmocka_unit_test(columns_are_found_by_name),
        cmocka_unit_test(nothing_is_guessed),
        cmocka_unit_test(long_lines_are_refused),
        cmocka_unit_test(cells_are_shown_in_part),
        cmocka_unit_test(failures_are_told),
    };
    return cmocka_run_group_tests(tests, test_file_make, test_file_remove);
}
