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
    sqlite3_stmt *begin, *commit, *put;
    int n_tables;
    int *first; /* [n_tables + 1] number of rows before each table */
    int *size;  /* [n_tables] values of a row */
    int *count; /* [rows] stored values of each row; its size: finished */
    int resumed;
};

/** Where a stored value (map_table, i, j, k, value) belongs: table, row and index in
 *  table->value. False when it belongs nowhere or is not a finite number. */
bool gm_journal_place(sqlite3_stmt *rows, const gm_map *map, int *table, int *row,
                      int *index, double *value);

/** Close the file and free everything; NULL is fine. */
void gm_journal_destroy(gm_journal *journal);

#endif
