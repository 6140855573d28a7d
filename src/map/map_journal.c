/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Using a journal: records into it, and the map beside it at the end. How it is kept and
 * opened: map_journal_open.c.
 */
#include "map/map_journal.h"

#include "base/alloc.h"
#include "map/map_place.h"
#include "map/map_rules.h"

#include <stdint.h>
#include <string.h>

#define NEW_SUFFIX                                                                       \
    "-new" /* the map before it has its name; a killed one is overwritten */

/* FNV-1a (Fowler, Noll, Vo), by bytes, 64 bits. */
long long gm_journal_sum(const void *bytes, size_t size)
{
    const unsigned char *byte = bytes;
    uint64_t sum = 0xcbf29ce484222325u;
    for (size_t i = 0; i < size; i++)
        sum = (sum ^ byte[i]) * 0x100000001b3u;
    return (long long)(sum >> 1);
}

const void *gm_journal_records(const gm_journal *journal, long *count)
{
    *count = journal->count;
    return journal->records;
}

/* One statement, so one transaction. */
gm_status gm_journal_put(gm_journal *journal, const void *records, int n, gm_error *error)
{
    size_t size = (size_t)n * journal->record;
    if (n == 0)
        return GM_OK;
    (void)sqlite3_bind_int64(journal->put, 1, gm_journal_sum(records, size));
    (void)sqlite3_bind_blob64(journal->put, 2, records, size, SQLITE_STATIC);
    return gm_db_step(&journal->db, journal->put, error);
}

/* SQLite keeps no negative zero; the map in memory shall be what a reader gets. */
static void drop_negative_zeros(gm_map *map)
{
    for (int t = 0; t < map->n_tables; t++) {
        gm_map_table *table = &map->tables[t];
        for (int m = 0; m < gm_map_value_count(table); m++)
            if (table->value[m] == 0.0)
                table->value[m] = 0.0;
    }
}

/* Whole under another name, then renamed, under the journal's lock: no other sweep can
 * get between. */
static gm_status write_map(const gm_journal *journal, const gm_map *map, gm_error *error)
{
    unsigned char *bytes = NULL;
    size_t size = 0;
    char *name = gm_place_name(journal->part, NEW_SUFFIX);
    if (!name)
        return gm_fail(error, GM_ERR_MEMORY, "no memory to write %s", journal->path);
    gm_status status = gm_map_to_bytes(map, &bytes, &size, error);
    if (status == GM_OK)
        status = gm_place_write(name, bytes, size, error);
    if (status == GM_OK)
        status = gm_place_rename(name, journal->path, error);
    if (status != GM_OK)
        gm_place_remove(name);
    gm_free(bytes);
    gm_free(name);
    return status;
}

gm_status gm_journal_finish(gm_journal *journal, gm_map *map, gm_error *error)
{
    char before[sizeof map->content_hash], hash[65];
    memcpy(before, map->content_hash, sizeof before);
    gm_status status = gm_map_check(map, error);
    if (status == GM_OK) {
        drop_negative_zeros(map);
        status = gm_map_hash(map, hash, error);
    }
    if (status == GM_OK) {
        memcpy(map->content_hash, hash, sizeof hash);
        status = write_map(journal, map, error);
        if (status != GM_OK)
            memcpy(map->content_hash, before, sizeof before);
    }
    gm_journal_close(journal, status != GM_OK);
    return status;
}

void gm_journal_close(gm_journal *journal, bool keep)
{
    if (journal && !keep) {
        (void)sqlite3_db_config(journal->db.handle, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1,
                                NULL);
        gm_place_remove(journal->part);
    }
    gm_journal_destroy(journal);
}
