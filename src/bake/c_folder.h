/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What the writers of the folder of plain C share.
 */
#ifndef C_FOLDER_H
#define C_FOLDER_H

#include "bake/gm_bake_c.h"
#include "bake/package.h"
#include "bake/table_text.h"
#include "bake/thin.h"

typedef struct gm_c_folder {
    const gm_map *map;
    const gm_reduced_map *reduced; /* thinned and rounded */
    const gm_bake_c_options *options;
    gm_thin_loss loss[GM_THIN_KINDS];
    gm_c_sizes sizes;
    gm_package package;
} gm_c_folder;

/** gm_tables.h, gm_tables.c and tables.csv into the package; sizes are filled.
 *  GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_c_tables(gm_c_folder *folder, gm_error *error);

/** README.md into the package. GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_c_readme(gm_c_folder *folder, gm_error *error);

#endif
