/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Given ratios against those that the gears make: a description whose parts fit is
 * refused when it is assembled, with the line of the gear and both numbers.
 */
#include "description_fixture.h"

#include "base/alloc.h"
#include "model/gm_gearset.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define CHANGED GM_BINARY_DIR "/test_description_ratios.yaml"

/* The example with one piece of text changed, as a description. */
static gm_description *changed(const char *find, const char *replace, int *line)
{
    char *example = gm_test_slurp(EXAMPLE);
    char *text = gm_test_replaced(example, find, replace);
    gm_test_spill(CHANGED, text);
    *line = gm_test_line_of(text, replace);
    free(text);
    free(example);
    return gm_test_read(CHANGED);
}

static void refused(const char *find, const char *replace, const char *sentence)
{
    int line;
    char expected[GM_ERROR_MESSAGE_SIZE];
    gm_error error = {GM_OK, ""};
    gm_gearset *gearset = NULL;
    gm_description *d = changed(find, replace, &line);
    assert_int_equal(gm_gearset_create(d, d->oil.temperature, &gearset, &error),
                     GM_ERR_MODEL);
    assert_null(gearset);
    (void)snprintf(expected, sizeof expected, "%s:%d: %s", CHANGED, line, sentence);
    assert_string_equal(error.message, expected);
    gm_description_destroy(d);
}

static void accepted(const char *find, const char *replace)
{
    int line;
    gm_error error = {GM_OK, ""};
    gm_gearset *gearset = NULL;
    gm_description *d = changed(find, replace, &line);
    if (gm_gearset_create(d, d->oil.temperature, &gearset, &error) != GM_OK)
        fail_msg("%s", error.message);
    gm_gearset_destroy(gearset);
    gm_description_destroy(d);
}

/* The gears make 49/32 71/16 = 6.794922 in third, 44/22 50/24 71/17 = 17.401961 in
 * reverse. */
static void a_ratio_that_the_gears_do_not_make_is_named(void **state)
{
    (void)state;
    refused("3: {lock: g3_driven, ratio: 6.7949}", "3: {lock: g3_driven, ratio: 5.7949}",
            "path 'odd': gear 3: given ratio 5.7949, the gears make 6.79492; they may "
            "differ by 0.001 of it");
    refused("ratio: -17.402}", "ratio: 17.402}",
            "path 'even': gear -1: given ratio 17.402, the gears make -17.402; the sign "
            "must be the same");
}

/* 6.794922 / 1.001 = 6.788134 and 6.794922 / 0.999 = 6.801724 are the limits. */
static void a_ratio_may_be_rounded_or_left_out(void **state)
{
    (void)state;
    accepted("3: {lock: g3_driven, ratio: 6.7949}",
             "3: {lock: g3_driven, ratio: 6.7882}");
    accepted("3: {lock: g3_driven, ratio: 6.7949}",
             "3: {lock: g3_driven, ratio: 6.8017}");
    accepted("3: {lock: g3_driven, ratio: 6.7949}", "3: {lock: g3_driven}");
    refused("3: {lock: g3_driven, ratio: 6.7949}", "3: {lock: g3_driven, ratio: 6.7880}",
            "path 'odd': gear 3: given ratio 6.788, the gears make 6.79492; they may "
            "differ by 0.001 of it");
    refused("3: {lock: g3_driven, ratio: 6.7949}", "3: {lock: g3_driven, ratio: 6.8018}",
            "path 'odd': gear 3: given ratio 6.8018, the gears make 6.79492; they may "
            "differ by 0.001 of it");
}

/* Every allocation of the assembly fails once; a leak is the sanitizer's to find. */
static void running_out_of_memory_is_said_as_such(void **state)
{
    (void)state;
    gm_description *d = gm_test_read(EXAMPLE);
    gm_status status = GM_ERR_MEMORY;
    for (long k = 1; status == GM_ERR_MEMORY; k++) {
        gm_gearset *gearset = NULL;
        gm_error error = {GM_OK, ""};
        gm_alloc_fail_after(k);
        status = gm_gearset_create(d, d->oil.temperature, &gearset, &error);
        gm_alloc_fail_after(0);
        if (status != GM_OK) {
            assert_null(gearset);
            assert_string_equal(error.message, "out of memory");
        }
        gm_gearset_destroy(gearset);
    }
    assert_int_equal(status, GM_OK);
    gm_description_destroy(d);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ratio_that_the_gears_do_not_make_is_named),
        cmocka_unit_test(a_ratio_may_be_rounded_or_left_out),
        cmocka_unit_test(running_out_of_memory_is_said_as_such),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
