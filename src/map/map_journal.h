/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Inside of a journal, shared by its opening (map_journal_open.c) and its use.
 */
#ifndef MAP_JOURNAL_H
#define MAP_JOURNAL_H

#include "map/gm_map_file.h"
#include "map/map_db.h"

struct gm_journal {
    gm_db db;
    char *path, *part;
    bool fresh; /* made by this call, or empty: removed when opening fails */
    sqlite3_stmt *put;
    size_t record;          /* bytes */
    unsigned char *records; /* [count], those found when it was opened */
    long count;
};

/** Sum over the bytes of a block, so that a damaged one is noticed. */
long long gm_journal_sum(const void *bytes, size_t size);

/** Close the file and free everything; NULL is fine. */
void gm_journal_destroy(gm_journal *journal);

#endif
