/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Open addressing with linear probing; at most half of the slots are taken.
 */
#include "sweep/memo.h"

#include "base/alloc.h"

#include <stdint.h>
#include <string.h>

#define FIRST_SIZE 64 /* slots; a power of two */

struct gm_memo {
    size_t key_size, entry_size;
    long n, room, n_slots;
    unsigned char *entries; /* [room] key and value */
    int32_t *slot;          /* [n_slots] index of an entry + 1; 0: free */
};

static int grow_entries(gm_memo *m)
{
    long room = m->room > 0 ? 2 * m->room : FIRST_SIZE / 2;
    unsigned char *entries = gm_resize(m->entries, (size_t)room, m->entry_size);
    if (!entries)
        return 0;
    m->entries = entries;
    m->room = room;
    return 1;
}

gm_memo *gm_memo_create(size_t key_size, size_t value_size)
{
    gm_memo *m = gm_calloc(1, sizeof *m);
    if (!m)
        return NULL;
    m->key_size = key_size;
    m->entry_size = key_size + value_size;
    m->n_slots = FIRST_SIZE;
    m->slot = gm_calloc((size_t)m->n_slots, sizeof *m->slot);
    if (!m->slot || !grow_entries(m)) {
        gm_memo_destroy(m);
        return NULL;
    }
    return m;
}

void gm_memo_destroy(gm_memo *memo)
{
    if (!memo)
        return;
    gm_free(memo->entries);
    gm_free(memo->slot);
    gm_free(memo);
}

/* Finaliser of SplitMix64 over the words of the key. */
static uint64_t hash_of(const gm_memo *m, const void *key)
{
    uint64_t hash = 0;
    for (size_t i = 0; i < m->key_size; i += sizeof(uint64_t)) {
        uint64_t word;
        memcpy(&word, (const unsigned char *)key + i, sizeof word);
        hash = (hash ^ word) + 0x9e3779b97f4a7c15u;
        hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9u;
        hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebu;
        hash ^= hash >> 31;
    }
    return hash;
}

static unsigned char *entry(const gm_memo *m, long i)
{
    return m->entries + (size_t)i * m->entry_size;
}

/* The slot of the key, or the free one where it belongs. */
static long place_of(const gm_memo *m, const void *key)
{
    long at = (long)(hash_of(m, key) & (uint64_t)(m->n_slots - 1));
    while (m->slot[at] != 0 && memcmp(entry(m, m->slot[at] - 1), key, m->key_size) != 0)
        at = (at + 1) & (m->n_slots - 1);
    return at;
}

void *gm_memo_find(const gm_memo *memo, const void *key)
{
    int32_t found = memo->slot[place_of(memo, key)];
    return found ? entry(memo, found - 1) + memo->key_size : NULL;
}

static int grow_slots(gm_memo *m)
{
    long before = m->n_slots;
    int32_t *old = m->slot;
    m->slot = gm_calloc(2 * (size_t)before, sizeof *m->slot);
    if (!m->slot) {
        m->slot = old;
        return 0;
    }
    m->n_slots = 2 * before;
    for (long i = 0; i < m->n; i++)
        m->slot[place_of(m, entry(m, i))] = (int32_t)(i + 1);
    gm_free(old);
    return 1;
}

void *gm_memo_add(gm_memo *memo, const void *key)
{
    gm_memo *m = memo;
    if ((2 * (m->n + 1) > m->n_slots && !grow_slots(m)) ||
        (m->n == m->room && !grow_entries(m)))
        return NULL;
    unsigned char *made = entry(m, m->n);
    memcpy(made, key, m->key_size);
    memset(made + m->key_size, 0, m->entry_size - m->key_size);
    m->slot[place_of(m, key)] = (int32_t)++m->n;
    return made + m->key_size;
}

long gm_memo_count(const gm_memo *memo)
{
    return memo->n;
}

const void *gm_memo_key(const gm_memo *memo, long i)
{
    return entry(memo, i);
}

void *gm_memo_value(const gm_memo *memo, long i)
{
    return entry(memo, i) + memo->key_size;
}
