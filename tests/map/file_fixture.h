/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A folder for a map's file and its journal, made for each test, and short ways to write
 * and read them. Each function stops the test when it fails.
 */
#ifndef FILE_FIXTURE_H
#define FILE_FIXTURE_H

#include "map/gm_map_file.h"

#include <stddef.h>

/** The folder, the map in it (with a space and a question mark in its name), and its
 *  journal. */
extern char file_folder[64], file_path[96], file_part[104];

int file_setup(void **state);
int file_teardown(void **state);

/** True when nothing but the named file (NULL: nothing at all) is in the folder. */
bool file_only(const char *name);

void file_write_bytes(const char *name, const void *bytes, size_t size);

/** Free the bytes with gm_free. */
unsigned char *file_read_bytes(const char *name, size_t *size);

/** A record of the tests' journals: number n and a value that follows from it. */
typedef struct file_record {
    long n;
    double value;
} file_record;

/** Open the journal of file_path. */
gm_journal *file_journal(const gm_map *map);

/** Put records number first .. last - 1, three at a time. */
void file_put(gm_journal *journal, int first, int last);

/** The journal was opened with the records 0 .. n - 1, and no others. */
void file_expect_records(const gm_journal *journal, int n);

void file_finish(gm_journal *journal, gm_map *map);

/** Write a finished map at file_path, and read one. */
void file_write_map(gm_map *map);
gm_map *file_read_map(const char *name);

/** Reading must give this status and a sentence with the words and the name. */
void file_expect_refusal(const char *name, gm_status status, const char *words);

#endif
