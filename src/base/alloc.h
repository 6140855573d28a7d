/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The only allocation calls of the library. A test build counts them and makes the
 * k-th one fail (gm_alloc_fail_after), so that failure paths are really taken.
 */
#ifndef ALLOC_H
#define ALLOC_H

#include <stddef.h>

/** Zeroed memory for count items of size bytes; NULL when there is none or on overflow.
 *  A count of zero gives a valid pointer. The caller frees it with gm_free. */
void *gm_calloc(size_t count, size_t size);

/** Resize to count items; new items are not zeroed. NULL on failure (old block kept). */
void *gm_resize(void *block, size_t count, size_t size);

/** Copy of a string; NULL when there is no memory. */
char *gm_strdup(const char *text);

/** Free; NULL is fine. */
void gm_free(void *block);

/** For tests, per thread: the n-th allocation from now on fails (0: none fails). */
void gm_alloc_fail_after(long n);

#endif
