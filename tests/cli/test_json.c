/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The JSON writer: form, escaping, numbers that survive, what JSON does not have.
 */
#include "json.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static char text[4096];

static gm_json *start(gm_json *json)
{
    FILE *out = tmpfile();
    assert_non_null(out);
    gm_json_start(json, out);
    return json;
}

static const char *finish(gm_json *json)
{
    gm_json_finish(json);
    rewind(json->out);
    size_t n = fread(text, 1, sizeof text - 1, json->out);
    text[n] = '\0';
    (void)fclose(json->out);
    return text;
}

static void empty_levels_stay_on_one_line(void **state)
{
    (void)state;
    gm_json json;
    assert_string_equal(finish(start(&json)), "{}\n");
    gm_json_array(start(&json), "a");
    gm_json_end(&json);
    assert_string_equal(finish(&json), "{\n  \"a\": []\n}\n");
}

static void members_are_separated_and_indented(void **state)
{
    (void)state;
    gm_json json;
    gm_json_integer(start(&json), "n", -7);
    gm_json_array(&json, "list");
    gm_json_bool(&json, NULL, true);
    gm_json_object(&json, NULL);
    gm_json_text(&json, "nothing", NULL);
    gm_json_end(&json);
    gm_json_end(&json);
    assert_string_equal(finish(&json),
                        "{\n  \"n\": -7,\n  \"list\": [\n    true,\n    {\n"
                        "      \"nothing\": null\n    }\n  ]\n}\n");
}

static void text_is_escaped(void **state)
{
    (void)state;
    gm_json json;
    gm_json_text(start(&json), "k\"", "a\\b\"c\n\t\x01/\x7f µ");
    assert_string_equal(
        finish(&json),
        "{\n  \"k\\\"\": \"a\\\\b\\\"c\\u000a\\u0009\\u0001/\x7f µ\"\n}\n");
}

static void bytes_that_are_no_utf8_are_replaced(void **state)
{
    (void)state;
    static const struct {
        const char *in, *out;
    } cases[] = {
        {"\xff", "\\ufffd"},                                  /* never a byte of UTF-8 */
        {"a\xc3", "a\\ufffd"},                                /* cut off */
        {"\xc0\xaf", "\\ufffd\\ufffd"},                       /* overlong '/' */
        {"\xe0\x80\xaf", "\\ufffd\\ufffd\\ufffd"},            /* overlong, three bytes */
        {"\xed\xa0\x80", "\\ufffd\\ufffd\\ufffd"},            /* surrogate */
        {"\xf4\x90\x80\x80", "\\ufffd\\ufffd\\ufffd\\ufffd"}, /* past U+10FFFF */
        {"\xf0\x9f\x9a\x97", "\xf0\x9f\x9a\x97"},             /* four good bytes stay */
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        gm_json json;
        char expected[128];
        gm_json_text(start(&json), "t", cases[i].in);
        (void)snprintf(expected, sizeof expected, "{\n  \"t\": \"%s\"\n}\n",
                       cases[i].out);
        assert_string_equal(finish(&json), expected);
    }
}

static void numbers_read_back_to_the_same_bits(void **state)
{
    (void)state;
    static const double numbers[] = {
        0.1, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, -2.5, 3.0000000000000004};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        gm_json json;
        gm_json_number(start(&json), "x", numbers[i]);
        double back = strtod(strchr(finish(&json), ':') + 1, NULL);
        assert_memory_equal(&back, &numbers[i], sizeof back);
    }
}

static void what_is_not_finite_is_null(void **state)
{
    (void)state;
    gm_json json;
    gm_json_number(start(&json), "nan", (double)NAN);
    gm_json_number(&json, "inf", -HUGE_VAL);
    assert_string_equal(finish(&json), "{\n  \"nan\": null,\n  \"inf\": null\n}\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(empty_levels_stay_on_one_line),
        cmocka_unit_test(members_are_separated_and_indented),
        cmocka_unit_test(text_is_escaped),
        cmocka_unit_test(bytes_that_are_no_utf8_are_replaced),
        cmocka_unit_test(numbers_read_back_to_the_same_bits),
        cmocka_unit_test(what_is_not_finite_is_null),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
