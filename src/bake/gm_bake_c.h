/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The generator of plain C for controllers and rigs: a folder with the core as it stands,
 * the map as constant tables, an interface of four calls, an example and what a reader
 * needs to know.
 */
#ifndef GM_BAKE_C_H
#define GM_BAKE_C_H

#include "bake/gm_bake.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct gm_bake_c_options {
    const char *share; /* folder with core/ and embedded/ sources to ship */
    gm_interpolation interpolation;
    bool is_float; /* numbers: float; else double */
    bool is_int16; /* nodes of tables: int16_t times a scale */
    double thin;   /* tolerance for leaving out nodes, of the reference torque; 0: none */
    double step;   /* s, that the example and GM_STEP have */
    int n_errors;  /* measured errors of the map for the README; 0: none */
    const gm_map_error *errors; /* [n_errors] */
} gm_bake_c_options;

typedef struct gm_c_sizes {
    long nodes, map_nodes; /* values in all tables; and in the map's */
    long table_bytes;      /* axes and nodes */
    long struct_bytes;     /* constant structs on a 32-bit target */
    double largest_error;  /* of thinning and rounding, over reference torque */
} gm_c_sizes;

typedef struct gm_bake_c_summary {
    int files;
    gm_c_sizes sizes;
} gm_bake_c_summary;

/** Write the folder. It must not exist, be empty, or be the work of an earlier bake,
 *  whose files are then replaced. Same map and options: same bytes. GM_ERR_IO,
 *  GM_ERR_MEMORY, GM_ERR_FORMAT as gm_map_view_create. */
GM_NODISCARD gm_status gm_bake_c(const gm_map *map, const gm_bake_c_options *options,
                                 const char *folder, gm_bake_c_summary *summary,
                                 gm_error *error);

#ifdef __cplusplus
}
#endif
#endif
