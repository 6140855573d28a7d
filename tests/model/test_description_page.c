/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What docs/description.md says beside the schema: its examples are gearsets, and the
 * names of bearings and series that it lists are those of the tables.
 */
#include "description_fixture.h"

#include "model/bearing_models.h"
#include "model/gm_gearset.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define PAGE GM_SOURCE_DIR "/docs/description.md"
#define COPY GM_BINARY_DIR "/test_description_page.yaml"

/* The text between two marks; the caller frees it. */
static char *between(const char *text, const char *begin, const char *end)
{
    const char *from = strstr(text, begin);
    assert_non_null(from);
    from += strlen(begin);
    const char *to = strstr(from, end);
    assert_non_null(to);
    size_t n = (size_t)(to - from);
    char *piece = calloc(1, n + 1);
    assert_non_null(piece);
    memcpy(piece, from, n);
    return piece;
}

static void check_is_a_gearset(const char *example)
{
    gm_error error = {GM_OK, ""};
    gm_gearset *gearset = NULL;
    gm_test_spill(COPY, example);
    gm_description *d = gm_test_read(COPY);
    if (gm_gearset_create(d, d->oil.temperature, &gearset, &error) != GM_OK)
        fail_msg("%s", error.message);
    assert_int_equal(d->n_paths, 1);
    assert_int_equal(d->paths[0].n_gears, 2);
    gm_gearset_destroy(gearset);
    gm_description_destroy(d);
}

/* Both have two speeds. */
static void its_examples_are_gearsets(void **state)
{
    (void)state;
    char *page = gm_test_slurp(PAGE);
    const char *begin = "```yaml\n";
    int n = 0;
    for (const char *at = page; (at = strstr(at, begin)); at += strlen(begin), n++) {
        char *example = between(at, begin, "```\n");
        check_is_a_gearset(example);
        free(example);
    }
    assert_int_equal(n, 2);
    free(page);
}

/* Blanks at the beginning of a line are the wrapping of the page. */
static void unwrap(char *text)
{
    char *to = text;
    for (const char *from = text; *from; from++) {
        int wraps = *from == '\n';
        *to++ = wraps ? ' ' : *from;
        if (wraps)
            from += strspn(from + 1, " ");
    }
    *to = '\0';
}

static void check_series(const char *page, const char *word, gm_bearing_type type)
{
    char expected[1024];
    int n, used = snprintf(expected, sizeof expected, "- `%s`: ", word);
    const gm_skf_row *rows = gm_skf_rows(type, &n);
    for (int i = 0; i < n; i++)
        used += snprintf(expected + used, sizeof expected - (size_t)used, "%s`%s`",
                         i > 0 ? ", " : "", rows[i].series);
    if (!strstr(page, expected))
        fail_msg("the page has not: %s", expected);
}

static void it_lists_every_series(void **state)
{
    (void)state;
    char *page = gm_test_slurp(PAGE);
    unwrap(page);
    check_series(page, "deep_groove_ball", GM_BEARING_DEEP_GROOVE_BALL);
    check_series(page, "angular_contact_ball", GM_BEARING_ANGULAR_CONTACT_BALL);
    check_series(page, "cylindrical_roller", GM_BEARING_CYLINDRICAL_ROLLER);
    check_series(page, "tapered_roller", GM_BEARING_TAPERED_ROLLER);
    free(page);
}

static void it_lists_the_catalogue(void **state)
{
    (void)state;
    char *page = gm_test_slurp(PAGE);
    char *list = between(page, "`designation` can be", ".");
    int n = 0;
    for (char *at = list; *at;) {
        gm_bearing_data data = {.type = GM_BEARING_DEEP_GROOVE_BALL};
        size_t length = strspn(at, "0123456789");
        if (length == 0) {
            at++;
            continue;
        }
        assert_true(length < sizeof data.designation);
        memcpy(data.designation, at, length);
        assert_int_equal(gm_bearing_data_complete(&data, NULL), GM_OK);
        at += length;
        n++;
    }
    assert_int_equal(n, 25); /* rows of bearing_catalogue.c, as in test_bearing.c */
    free(list);
    free(page);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(its_examples_are_gearsets),
        cmocka_unit_test(it_lists_every_series),
        cmocka_unit_test(it_lists_the_catalogue),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
