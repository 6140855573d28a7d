/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Generators: a map in, the reduced component out. They write data, never logic: the
 * component's C is src/core and fmu/ as they stand.
 */
#ifndef GM_BAKE_H
#define GM_BAKE_H

#include "map/gm_map_file.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Between the nodes of the tables; names "linear" and "monotone". */
typedef enum gm_interpolation {
    GM_INTERPOLATION_LINEAR,
    GM_INTERPOLATION_MONOTONE /* cubics with continuous gradient; X stays linear */
} gm_interpolation;

typedef struct gm_bake_options {
    const char *share;    /* folder with core/, fmu/ and fmi2/ sources to ship */
    const char *compiler; /* C compiler; NULL: $CC, then cc, gcc, clang from the path */
    gm_interpolation interpolation;
    int n_errors;               /* measured errors for the documentation; 0: none */
    const gm_map_error *errors; /* [n_errors] */
} gm_bake_options;

typedef struct gm_bake_summary {
    char compiler[256];
    long file_size;    /* bytes */
    long library_size; /* bytes */
    char guid[64];
    gm_interpolation interpolation;
} gm_bake_summary;

/** Write an FMI 2.0 FMU (sources and a linux64 binary). Written beside its final name and
 *  renamed when whole; on failure nothing is left. Same map, options and compiler: same
 *  bytes. GM_ERR_TOOL when there is no compiler or it fails, GM_ERR_IO. */
GM_NODISCARD gm_status gm_bake_fmu2(const gm_map *map, const gm_bake_options *options,
                                    const char *path, gm_bake_summary *summary,
                                    gm_error *error);

/** Write measured errors into the documentation of the FMU at path, which was baked from
 *  this map; all else stays as it is, and so does the file on failure. The result is that
 *  of baking with the errors. GM_ERR_IO, GM_ERR_FORMAT, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_bake_document(const char *path, const gm_map *map,
                                        const gm_bake_summary *summary, int n_errors,
                                        const gm_map_error *errors, gm_error *error);

#ifdef __cplusplus
}
#endif
#endif
