/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Results of verifications, from files or from a map, on their way into a passport.
 */
#ifndef RESULTS_H
#define RESULTS_H

#include "bake/gm_bake.h"

typedef struct gm_results {
    int n;
    gm_bake_result *list; /* [n]; its texts are owned */
} gm_results;

/** Files whose names are separated by commas. GM_ERR_IO, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_results_read(const char *names, gm_results *results,
                                       gm_error *error);

/** What is kept in the map's file. Errors of gm_map_get_results. */
GM_NODISCARD gm_status gm_results_of_map(const char *path, gm_results *results,
                                         gm_error *error);

/** Leave out what was measured on other components of the map than the one with this
 *  GUID, with a note on the standard error. GM_ERR_FORMAT, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_results_keep_fitting(gm_results *results, const gm_map *map,
                                               const char *guid, gm_error *error);

void gm_results_clear(gm_results *results);

#endif
