/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A memory of what is known at places: keys and values of fixed sizes in the order of
 * their coming, found by a hash over the bytes of the key. A key that holds numbers must
 * have no -0.0 and no padding that is not zero.
 */
#ifndef MEMO_H
#define MEMO_H

#include <stddef.h>

typedef struct gm_memo gm_memo;

/** An empty memo; NULL when there is no memory. key_size: a multiple of 8. */
gm_memo *gm_memo_create(size_t key_size, size_t value_size);
void gm_memo_destroy(gm_memo *memo);

/** The value of a key, or NULL. Valid until the next add. */
void *gm_memo_find(const gm_memo *memo, const void *key);

/** The zeroed value of a new key, which must not be there yet; NULL when there is no
 *  memory. Valid until the next add. */
void *gm_memo_add(gm_memo *memo, const void *key);

/** How many there are, and number i of them (from 0), in the order of their coming. */
long gm_memo_count(const gm_memo *memo);
const void *gm_memo_key(const gm_memo *memo, long i);
void *gm_memo_value(const gm_memo *memo, long i);

#endif
