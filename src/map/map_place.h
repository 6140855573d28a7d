/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Where a map is to be written: checks before the first byte, and the files around it.
 */
#ifndef MAP_PLACE_H
#define MAP_PLACE_H

#include "base/gm_status.h"

#include <stdbool.h>
#include <stddef.h>

/** GM_ERR_IO unless a file can be made at path: its folder exists and can be written,
 *  and path is not a folder or device. Makes nothing. */
GM_NODISCARD gm_status gm_place_check(const char *path, gm_error *error);

/** Name of the journal, "<path>.part"; NULL when there is no memory. */
char *gm_place_journal(const char *path);

/** The name with a suffix; NULL when there is no memory. */
char *gm_place_name(const char *path, const char *suffix);

/** Write a file whole, in place of what was there, down to the disk. GM_ERR_IO. */
GM_NODISCARD gm_status gm_place_write(const char *path, const void *bytes, size_t size,
                                      gm_error *error);

/** True when there is something of this name. */
bool gm_place_exists(const char *path);

/** Remove a database and what SQLite may keep beside it; missing files are fine. */
void gm_place_remove(const char *database);

/** Rename and make sure that the new name survives a power failure. */
GM_NODISCARD gm_status gm_place_rename(const char *from, const char *to, gm_error *error);

#endif
