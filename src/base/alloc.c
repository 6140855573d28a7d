/* SPDX-License-Identifier: BSD-2-Clause */
#include "base/alloc.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static _Thread_local long countdown;

static int must_fail(void)
{
    return countdown > 0 && --countdown == 0;
}

void gm_alloc_fail_after(long n)
{
    countdown = n;
}

void *gm_calloc(size_t count, size_t size)
{
    return must_fail() ? NULL : calloc(count ? count : 1, size ? size : 1);
}

void *gm_resize(void *block, size_t count, size_t size)
{
    if (size && count > SIZE_MAX / size)
        return NULL;
    size_t bytes = count * size;
    return must_fail() ? NULL : realloc(block, bytes ? bytes : 1);
}

char *gm_strdup(const char *text)
{
    size_t size = strlen(text) + 1;
    char *copy = gm_calloc(size, 1);
    if (copy)
        memcpy(copy, text, size);
    return copy;
}

void gm_free(void *block)
{
    free(block);
}
