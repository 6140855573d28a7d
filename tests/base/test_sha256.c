/* SPDX-License-Identifier: BSD-2-Clause */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "base/alloc.h"
#include "base/sha256.h"

static void finish(gm_sha256 *sum, char *text)
{
    gm_sha256_finish(sum, text);
    gm_sha256_destroy(sum);
}

/* FIPS 180-2, appendix B.1. */
static void gives_the_published_digest(void **state)
{
    (void)state;
    char text[GM_SHA256_TEXT];
    gm_sha256 *sum = gm_sha256_create();
    gm_sha256_bytes(sum, "abc", 3);
    finish(sum, text);
    assert_string_equal(
        text, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

static void keeps_texts_apart(void **state)
{
    (void)state;
    char a[GM_SHA256_TEXT], b[GM_SHA256_TEXT];
    gm_sha256 *sum = gm_sha256_create();
    gm_sha256_text(sum, "ab");
    gm_sha256_text(sum, "c");
    finish(sum, a);
    sum = gm_sha256_create();
    gm_sha256_text(sum, "a");
    gm_sha256_text(sum, "bc");
    finish(sum, b);
    assert_string_not_equal(a, b);
}

static void both_zeros_are_one_number(void **state)
{
    (void)state;
    char a[GM_SHA256_TEXT], b[GM_SHA256_TEXT];
    gm_sha256 *sum = gm_sha256_create();
    gm_sha256_double(sum, 0.0);
    finish(sum, a);
    sum = gm_sha256_create();
    gm_sha256_double(sum, -0.0);
    finish(sum, b);
    assert_string_equal(a, b);
}

static void missing_file_is_named(void **state)
{
    (void)state;
    char text[GM_SHA256_TEXT];
    gm_error error = {GM_OK, ""};
    assert_int_equal(gm_sha256_file("/nonexistent/file", text, &error), GM_ERR_IO);
    assert_string_equal(error.message,
                        "/nonexistent/file: cannot be opened: No such file or directory");
}

static void lack_of_memory_is_told(void **state)
{
    (void)state;
    char text[GM_SHA256_TEXT];
    gm_alloc_fail_after(1);
    assert_int_equal(gm_sha256_file(GM_SOURCE_DIR "/VERSION", text, NULL), GM_ERR_MEMORY);
    gm_alloc_fail_after(0);
    assert_int_equal(gm_sha256_file(GM_SOURCE_DIR "/VERSION", text, NULL), GM_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gives_the_published_digest),
        cmocka_unit_test(keeps_texts_apart),
        cmocka_unit_test(both_zeros_are_one_number),
        cmocka_unit_test(missing_file_is_named),
        cmocka_unit_test(lack_of_memory_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
