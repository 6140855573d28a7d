/* SPDX-License-Identifier: BSD-2-Clause
 *
 * modelDescription.xml of FMI 2.0 for Co-Simulation, from core/gm_vars.def and a map.
 */
#ifndef MODEL_DESCRIPTION_H
#define MODEL_DESCRIPTION_H

#include "bake/buffer.h"
#include "bake/gm_bake.h"

typedef struct gm_description_options {
    const char *model_identifier; /* name of library and C prefix */
    const char *guid;
    gm_speed_in speed_in;
    int n_sources;
    const char *const *sources; /* [n_sources] names of the C files to compile */
} gm_description_options;

/** Append the whole file. The date is written only when SOURCE_DATE_EPOCH is set: same
 *  input, same bytes. GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_model_description_write(const gm_map *map,
                                                  const gm_description_options *options,
                                                  gm_buffer *buffer, gm_error *error);

#endif
