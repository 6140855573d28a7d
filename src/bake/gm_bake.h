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

/** What `gearmap verify --json` printed about a component. */
typedef struct gm_bake_result {
    const char *name; /* for messages: where it is from */
    const char *json;
} gm_bake_result;

/** Flanges whose motion is an input and whose torque is an output: paths, then the output
 *  flange. */
typedef struct gm_speed_in {
    bool flange[GM_MAX_PATHS + 1];
} gm_speed_in;

typedef struct gm_bake_options {
    const char *share;    /* folder with core/, fmu/ and fmi2/ sources to ship */
    const char *compiler; /* C compiler; NULL: $CC, then cc, gcc, clang from the path */
    gm_interpolation interpolation;
    const char *speed_in; /* names of the flanges, with commas between; NULL: none */
    int n_results;        /* for passport and documentation; 0: nothing was measured */
    const gm_bake_result *results; /* [n_results] */
} gm_bake_options;

typedef struct gm_bake_summary {
    char compiler[256];
    long file_size;    /* bytes */
    long library_size; /* bytes */
    char guid[64];
    char library_sha256[65];
    gm_interpolation interpolation;
    gm_speed_in speed_in;
} gm_bake_summary;

/** Write an FMI 2.0 FMU (sources and a linux64 binary). Written beside its final name and
 *  renamed when whole; on failure nothing is left. Same map, options and compiler: same
 *  bytes. Results change passport and documentation alone. GM_ERR_TOOL when there is no
 *  compiler or it fails, GM_ERR_IO, GM_ERR_ARGUMENT when speed_in names a flange that
 *  there is not, or whose speed can be no input, errors of gm_bake_check_result. */
GM_NODISCARD gm_status gm_bake_fmu2(const gm_map *map, const gm_bake_options *options,
                                    const char *path, gm_bake_summary *summary,
                                    gm_error *error);

/** Write the detailed gearset of a description file as an FMI 2.0 FMU for Model Exchange
 *  (a linux64 binary), with the interface of the reduced one. share: as in the options;
 *  nothing is compiled. As gm_bake_fmu2, and as gm_description_read. */
GM_NODISCARD gm_status gm_bake_detailed(const char *description, const char *share,
                                        const char *path, gm_bake_summary *summary,
                                        gm_error *error);

/** GUID that the component of these options will have, without compiling it; results do
 *  not count. GM_ERR_FORMAT, GM_ERR_IO, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_bake_guid(const gm_map *map, const gm_bake_options *options,
                                    char guid[64], gm_error *error);

/** Does the result belong to the component of this map and GUID? GM_ERR_FORMAT when it is
 *  no result, GM_ERR_MODEL with what it belongs to, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_bake_check_result(const gm_bake_result *result,
                                            const gm_map *map, const char *guid,
                                            gm_error *error);

/** Write results into passport and documentation of the FMU at path, which was baked from
 *  this map; all else stays as it is, and so does the file on failure. The outcome is
 *  that of baking with the results. GM_ERR_IO, GM_ERR_MEMORY, errors of
 *  gm_bake_check_result. */
GM_NODISCARD gm_status gm_bake_document(const char *path, const gm_map *map,
                                        const gm_bake_summary *summary, int n_results,
                                        const gm_bake_result *results, gm_error *error);

#ifdef __cplusplus
}
#endif
#endif
