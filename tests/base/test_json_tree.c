/* SPDX-License-Identifier: BSD-2-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/alloc.h"
#include "base/json_tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static gm_json_tree *good(const char *text)
{
    gm_json_tree *tree = NULL;
    gm_error error = {0};
    if (gm_json_read("a.json", text, &tree, &error) != GM_OK)
        fail_msg("%s: %s", text, error.message);
    return tree;
}

static void refused(const char *text, const char *sentence)
{
    gm_json_tree *tree = NULL;
    gm_error error = {0};
    assert_int_equal(gm_json_read("a.json", text, &tree, &error), GM_ERR_FORMAT);
    assert_string_equal(error.message, sentence);
    assert_null(tree);
}

static void reads_every_kind_of_value(void **state)
{
    (void)state;
    gm_json_tree *tree = good(" {\"a\": [1, -2.50e+1, \"x\"], \"b\": {\"c\": true},\n"
                              "\t\"d\": null, \"e\": false, \"f\": {}, \"g\": []}\r\n");
    const gm_json_node *root = gm_json_root(tree), *a = gm_json_member(root, "a");
    assert_int_equal(root->kind, GM_JSON_OBJECT);
    assert_int_equal(a->kind, GM_JSON_ARRAY);
    assert_true(a->first->number == 1.0 && a->first->next->number == -25.0);
    assert_string_equal(a->first->next->text, "-2.50e+1"); /* as it was written */
    assert_string_equal(a->first->next->next->text, "x");
    assert_null(a->first->next->next->next);
    assert_int_equal(gm_json_member(gm_json_member(root, "b"), "c")->kind, GM_JSON_TRUE);
    assert_int_equal(gm_json_member(root, "d")->kind, GM_JSON_NULL);
    assert_int_equal(gm_json_member(root, "e")->kind, GM_JSON_FALSE);
    assert_null(gm_json_member(root, "f")->first);
    assert_null(gm_json_member(root, "g")->first);
    gm_json_tree_destroy(tree);
}

static void members_that_are_missing(void **state)
{
    (void)state;
    gm_json_tree *tree = good("{\"n\": 2, \"t\": \"x\", \"n\": 3}");
    const gm_json_node *root = gm_json_root(tree);
    assert_null(gm_json_member(root, "m"));
    assert_null(gm_json_member(NULL, "m"));
    assert_null(gm_json_member(gm_json_member(root, "t"), "m"));
    assert_true(gm_json_member_number(root, "n") == 2.0);
    assert_true(isnan(gm_json_member_number(root, "t")));
    assert_string_equal(gm_json_member_text(root, "t"), "x");
    assert_string_equal(gm_json_member_text(root, "n"), "");
    gm_json_tree_destroy(tree);
}

/* RFC 8259, section 7: the clef is its example of a pair of surrogates. */
static void escapes_are_resolved(void **state)
{
    (void)state;
    gm_json_tree *tree = good(
        "[\"\\\"\\\\\\/\\b\\f\\n\\r\\t\", \"\\u00e4\\u20AC\\uD834\\uDD1E\", \"ä€𝄞\"]");
    const gm_json_node *first = gm_json_root(tree)->first;
    assert_string_equal(first->text, "\"\\/\b\f\n\r\t");
    assert_string_equal(first->next->text, "ä€𝄞");
    assert_string_equal(first->next->next->text, "ä€𝄞");
    gm_json_tree_destroy(tree);
}

static void a_document_may_be_one_value(void **state)
{
    (void)state;
    static const char *const texts[] = {"0", "-0.5", "\"\"", "true", " null ", "1E5"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        gm_json_tree_destroy(good(texts[i]));
}

static void what_is_no_json_is_refused(void **state)
{
    (void)state;
    static const char *const values[] = {"",
                                         " ",
                                         "+1",
                                         "01",
                                         ".5",
                                         "1.",
                                         "1e",
                                         "-",
                                         "NaN",
                                         "nul",
                                         "truE",
                                         "'a'",
                                         "{a: 1}",
                                         "{\"a\"",
                                         "{\"a\":",
                                         "{\"a\" 1}",
                                         "{\"a\":1",
                                         "{\"a\":1,",
                                         "{\"a\":1,}",
                                         "[",
                                         "[1",
                                         "[1,",
                                         "[1,]",
                                         "[1 2]",
                                         "]",
                                         "1 2",
                                         "{} x",
                                         "\"a",
                                         "\"\\",
                                         "\"\\x\"",
                                         "\"\\u12\"",
                                         "\"\\u0000\"",
                                         "\"\\ud834\"",
                                         "\"\\ud834\\u0041\"",
                                         "\"\\udd1e\"",
                                         "\"a\nb\"",
                                         "\"\x80\"",
                                         "1e999"};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        gm_json_tree *tree = NULL;
        /* memory of its exact size: reading beyond shows in a checked build */
        char *text = malloc(strlen(values[i]) + 1);
        assert_non_null(text);
        memcpy(text, values[i], strlen(values[i]) + 1);
        assert_int_equal(gm_json_read("a.json", text, &tree, NULL), GM_ERR_FORMAT);
        free(text);
    }
}

static void the_sentence_names_file_and_line(void **state)
{
    (void)state;
    refused("{\n \"a\": [1,\n 2;]}", "a.json:3: is not JSON: expected a comma or ]");
    refused("{\"a\": 1e999}", "a.json:1: is not JSON: expected a finite number");
    refused("\n\n{\"a\"}", "a.json:3: is not JSON: expected a colon");
    refused("{} {}", "a.json:1: is not JSON: expected the end");
}

static void levels_are_limited(void **state)
{
    (void)state;
    char text[2 * GM_JSON_MAX_LEVELS + 3];
    memset(text, '[', GM_JSON_MAX_LEVELS);
    memset(text + GM_JSON_MAX_LEVELS, ']', GM_JSON_MAX_LEVELS);
    text[2 * GM_JSON_MAX_LEVELS] = '\0';
    gm_json_tree_destroy(good(text));
    memset(text, '[', GM_JSON_MAX_LEVELS + 1);
    refused(text, "a.json:1: is not JSON: expected fewer levels");
}

/* Every cut of a document is refused, and nothing beyond its end is read. */
static void every_beginning_is_refused(void **state)
{
    (void)state;
    static const char whole[] =
        "{\"a\": [1, {\"b\": \"\\u20AC x\"}, -1.5e3], \"c\": null}";
    for (size_t n = 0; n + 1 < sizeof whole - 1; n++) {
        gm_json_tree *tree = NULL;
        char *text = calloc(n + 1, 1);
        assert_non_null(text);
        memcpy(text, whole, n);
        assert_int_equal(gm_json_read("a.json", text, &tree, NULL), GM_ERR_FORMAT);
        free(text);
    }
}

static void no_memory(void **state)
{
    (void)state;
    gm_json_tree *tree = NULL;
    gm_status status = GM_ERR_MEMORY;
    for (long k = 1; status != GM_OK; k++) {
        assert_int_equal(status, GM_ERR_MEMORY);
        assert_null(tree);
        gm_alloc_fail_after(k);
        status = gm_json_read("a.json", "[1, 2]", &tree, NULL);
    }
    gm_alloc_fail_after(0);
    gm_json_tree_destroy(tree);
    gm_json_tree_destroy(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_every_kind_of_value),
        cmocka_unit_test(members_that_are_missing),
        cmocka_unit_test(escapes_are_resolved),
        cmocka_unit_test(a_document_may_be_one_value),
        cmocka_unit_test(what_is_no_json_is_refused),
        cmocka_unit_test(the_sentence_names_file_and_line),
        cmocka_unit_test(levels_are_limited),
        cmocka_unit_test(every_beginning_is_refused),
        cmocka_unit_test(no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
