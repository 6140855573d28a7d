/* SPDX-License-Identifier: BSD-2-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/text.h"

#include <math.h>
#include <string.h>

static void accepts_decimal_numbers(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double value;
    } cases[] = {{"0", 0.0},       {"-1.5", -1.5}, {"+2", 2.0},    {".5", 0.5},
                 {"3.", 3.0},      {"1e3", 1e3},   {"1E-3", 1e-3}, {"6.02e+23", 6.02e23},
                 {"0000.10", 0.1}, {"-0", 0.0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value = (double)NAN;
        assert_true(gm_text_to_double(cases[i].text, &value));
        assert_true(value == cases[i].value);
    }
}

static void refuses_what_is_not_a_number(void **state)
{
    (void)state;
    static const char *const cases[] = {"",    " ",    "30 mm", "3o0",   "nan",  "inf",
                                        "1e",  "0x10", "1,5",   "--1",   ".",    "-",
                                        "1 2", " 1",   "1 ",    "1e400", "1.2.3"};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value = 42.0;
        assert_false(gm_text_to_double(cases[i], &value));
        assert_true(value == 42.0);
    }
}

static void accepts_integers_within_int(void **state)
{
    (void)state;
    int value = 0;
    assert_true(gm_text_to_int("-17", &value));
    assert_int_equal(value, -17);
    assert_true(gm_text_to_int("2147483647", &value));
    assert_int_equal(value, 2147483647);
    assert_false(gm_text_to_int("2147483648", &value));
    assert_false(gm_text_to_int("99999999999999999999", &value));
    assert_false(gm_text_to_int("1.0", &value));
    assert_false(gm_text_to_int("", &value));
    assert_false(gm_text_to_int("-", &value));
    assert_int_equal(value, 2147483647);
}

static void quantity_takes_its_own_unit_only(void **state)
{
    (void)state;
    double value = 0.0;
    assert_true(gm_text_to_quantity("150", "rpm", &value));
    assert_true(value == 150.0);
    assert_true(gm_text_to_quantity("151rpm", "rpm", &value));
    assert_true(value == 151.0);
    assert_true(gm_text_to_quantity("1.5e2 rpm", "rpm", &value));
    assert_true(value == 150.0);
    assert_false(gm_text_to_quantity("150Nm", "rpm", &value));
    assert_false(gm_text_to_quantity("150 ", "rpm", &value));
    assert_false(gm_text_to_quantity("rpm", "rpm", &value));
    assert_false(gm_text_to_quantity("150 rpm x", "rpm", &value));
}

static void nearest_word_is_found_only_when_near(void **state)
{
    (void)state;
    static const char *const words[] = {"width_mm", "teeth", "helix_deg"};
    assert_int_equal(gm_text_nearest("widht_mm", words, 3), 0);
    assert_int_equal(gm_text_nearest("tooth", words, 3), 1);
    assert_int_equal(gm_text_nearest("HELIX_DEG", words, 3), 2);
    assert_int_equal(gm_text_nearest("pressure", words, 3), -1);
    char monster[300];
    memset(monster, 'a', sizeof monster - 1);
    monster[sizeof monster - 1] = '\0';
    assert_int_equal(gm_text_nearest(monster, words, 3), -1);
}

static void only_true_utf8_has_a_length(void **state)
{
    (void)state;
    static const struct {
        const char *bytes;
        size_t length;
    } cases[] = {{"a", 1},
                 {"\xc3\xa4", 2},
                 {"\xe2\x82\xac", 3},
                 {"\xf0\x9f\x98\x80", 4},
                 {"\x80", 0},
                 {"\xc0\x80", 0},         /* overlong */
                 {"\xe0\x80\x80", 0},     /* overlong */
                 {"\xed\xa0\x80", 0},     /* surrogate */
                 {"\xf4\x90\x80\x80", 0}, /* beyond the last character */
                 {"\xc3", 0},
                 {"\xe2\x82", 0},
                 {"\xc3(", 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        size_t size = strlen(cases[i].bytes);
        assert_int_equal(gm_text_utf8_length(cases[i].bytes, size), cases[i].length);
        assert_int_equal(gm_text_utf8_length(cases[i].bytes, size + 1), cases[i].length);
    }
    assert_int_equal(gm_text_utf8_length("\xe2\x82\xac", 2), 0);
    assert_int_equal(gm_text_utf8_length("", 0), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(accepts_decimal_numbers),
        cmocka_unit_test(refuses_what_is_not_a_number),
        cmocka_unit_test(accepts_integers_within_int),
        cmocka_unit_test(quantity_takes_its_own_unit_only),
        cmocka_unit_test(nearest_word_is_found_only_when_near),
        cmocka_unit_test(only_true_utf8_has_a_length),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
