/* SPDX-License-Identifier: BSD-2-Clause
 *
 * An FMU's archive unpacked into a private temporary folder. What is malformed is
 * refused: names that would leave the folder, links, absurd sizes and counts.
 */
#ifndef FMU_ARCHIVE_H
#define FMU_ARCHIVE_H

#include "base/gm_status.h"

#define FMU_FOLDER_SIZE 256

/** Unpack the archive at path; folder receives the name of a new folder, which the caller
 *  removes with gm_fmu_remove. GM_ERR_IO, GM_ERR_FORMAT, GM_ERR_MEMORY; then there is no
 *  folder. */
GM_NODISCARD gm_status gm_fmu_unpack(const char *path, char folder[FMU_FOLDER_SIZE],
                                     gm_error *error);

/** Remove a folder made by gm_fmu_unpack with all that is in it. */
void gm_fmu_remove(const char *folder);

#endif
