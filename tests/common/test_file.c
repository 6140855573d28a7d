/* SPDX-License-Identifier: BSD-2-Clause */
#include "common/test_file.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static char temporary[] = "/tmp/gm_test_XXXXXX";

int test_file_make(void **state)
{
    (void)state;
    int file = mkstemp(temporary);
    return file < 0 || close(file);
}

int test_file_remove(void **state)
{
    (void)state;
    return unlink(temporary);
}

const char *test_file_path(void)
{
    return temporary;
}

void test_file_write(const char *text)
{
    FILE *file = fopen(temporary, "wb");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

size_t test_file_load(const char *path, char *text, size_t size)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    size_t n = fread(text, 1, size - 1, file);
    assert_true(n < size - 1);
    text[n] = '\0';
    assert_int_equal(fclose(file), 0);
    return n;
}
