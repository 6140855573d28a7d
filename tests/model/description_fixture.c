/* SPDX-License-Identifier: BSD-2-Clause */
#include "description_fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

char *gm_test_slurp(const char *path)
{
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    char *text = calloc(1, 1 << 16);
    assert_non_null(text);
    size_t n = fread(text, 1, (1 << 16) - 1, f);
    assert_true(n > 0 && n < (1 << 16) - 1);
    assert_int_equal(fclose(f), 0);
    return text;
}

void gm_test_spill(const char *path, const char *text)
{
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(text, 1, strlen(text), f), strlen(text));
    assert_int_equal(fclose(f), 0);
}

char *gm_test_replaced(const char *text, const char *find, const char *replace)
{
    const char *at = strstr(text, find);
    if (!at)
        fail_msg("the example no longer contains '%s'", find);
    char *out = calloc(1, strlen(text) + strlen(replace) + 1);
    assert_non_null(out);
    memcpy(out, text, (size_t)(at - text));
    strcat(out, replace);
    strcat(out, at + strlen(find));
    return out;
}

int gm_test_line_of(const char *text, const char *find)
{
    const char *at = strstr(text, find);
    if (!at)
        fail_msg("the changed example does not contain '%s'", find);
    int line = 1;
    for (const char *s = text; s < at; s++)
        line += *s == '\n';
    return line;
}

gm_description *gm_test_read(const char *path)
{
    gm_description *d = NULL;
    gm_error error = {GM_OK, ""};
    if (gm_description_read(path, &d, &error) != GM_OK)
        fail_msg("%s", error.message);
    return d;
}

void gm_test_rule_answers(const char *example, const char *file, const gm_test_rule *rule)
{
    char expected[GM_ERROR_MESSAGE_SIZE];
    gm_error error = {GM_OK, ""};
    gm_description *d = NULL;
    char *text = gm_test_replaced(example, rule->find, rule->replace);
    gm_test_spill(file, text);
    gm_status status = gm_description_read(file, &d, &error);
    if (status != rule->status)
        fail_msg("'%s': status %d, %s", rule->replace, status, error.message);
    assert_null(d);
    assert_null(strchr(error.message, '\n'));
    int line = rule->at ? gm_test_line_of(text, rule->at) + (rule->at[0] == '\n') : 0;
    int n = snprintf(expected, sizeof expected, "%s:%d: %s", file, line, rule->sentence);
    if (rule->other)
        (void)snprintf(expected + n, sizeof expected - (size_t)n, "%d",
                       gm_test_line_of(text, rule->other));
    const char *tail = strstr(error.message, ": ");
    assert_non_null(tail);
    if (rule->at)
        assert_string_equal(error.message, expected);
    else
        assert_string_equal(tail + 2, rule->sentence);
    free(text);
}
