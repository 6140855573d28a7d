/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The files that go into an FMU, in memory, and the archive they make. Same files, same
 * bytes: entries are sorted by name, their time is fixed (1980-01-01, where the time of
 * zip archives begins) and no property of the machine is stored.
 */
#ifndef PACKAGE_H
#define PACKAGE_H

#include "bake/buffer.h"

typedef struct gm_package_file {
    char *name; /* with forward slashes, such as "sources/fmi2.c" */
    gm_buffer content;
} gm_package_file;

typedef struct gm_package {
    int n, room;
    gm_package_file *files;
} gm_package;

/** Add a file; content is moved into the package, also on failure. GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_package_add(gm_package *package, const char *name,
                                      gm_buffer *content, gm_error *error);

/** Add the file at path. GM_ERR_IO, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_package_add_file(gm_package *package, const char *name,
                                           const char *path, gm_error *error);

/** Add all regular files of a folder whose names end in .c, .h or .def, as
 *  "<prefix><file name>". GM_ERR_IO when it cannot be read or has none. */
GM_NODISCARD gm_status gm_package_add_folder(gm_package *package, const char *prefix,
                                             const char *folder, gm_error *error);

/** Order by name. */
void gm_package_sort(gm_package *package);

/** Write those files whose names begin with prefix into a folder, without the prefix. */
GM_NODISCARD gm_status gm_package_extract(const gm_package *package, const char *prefix,
                                          const char *folder, gm_error *error);

/** Write the archive over the file at path. GM_ERR_IO. */
GM_NODISCARD gm_status gm_package_write(const gm_package *package, const char *path,
                                        gm_error *error);

/** Replace n files of the archive at path; contents are moved, also on failure. Then the
 *  archive is as it was. GM_ERR_IO. */
GM_NODISCARD gm_status gm_package_replace(const char *path, int n,
                                          const char *const *names,
                                          gm_buffer *const *contents, gm_error *error);

void gm_package_clear(gm_package *package);

#endif
