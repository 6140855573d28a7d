/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Files around a command: is the output writable before the work starts, where is the
 * share folder with the sources that a bake needs.
 */
#ifndef FILES_H
#define FILES_H

#include "base/gm_status.h"

#include <stdbool.h>

#define GM_PATH_SIZE 4096

/** Refuse an output that could not be written at the end: a folder that does not exist or
 *  is read-only, a name that is a folder or a device, a name that is the input's own.
 *  Leaves nothing behind. GM_ERR_IO. */
GM_NODISCARD gm_status gm_file_check_output(const char *output, const char *input,
                                            gm_error *error);

/** Do two names, of files that need not exist, mean the same place? Their folders are
 *  resolved. */
bool gm_file_is_same(const char *a, const char *b);

/** A name beside path that no other running process uses: path.PID.new. GM_ERR_IO when it
 *  is too long. */
GM_NODISCARD gm_status gm_file_own_name(const char *path, char name[GM_PATH_SIZE],
                                        gm_error *error);

/** Size in bytes, -1 when there is no such file. */
long gm_file_size(const char *path);

/** The folder with core/, fmu/ and fmi2/: $GEARMAP_SHARE, else share/gearmap beside the
 *  program (build tree) or beside its folder (installed). GM_ERR_TOOL with the places
 *  that were looked at. */
GM_NODISCARD gm_status gm_file_find_share(char path[GM_PATH_SIZE], gm_error *error);

#endif
