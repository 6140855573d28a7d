/* SPDX-License-Identifier: BSD-2-Clause
 *
 * From a description file to a plant, in one call.
 */
#ifndef GEARSET_FILE_H
#define GEARSET_FILE_H

#include "plant/gm_builtin.h"

typedef struct gm_rig_source gm_rig_source; /* rig_source.h */

typedef struct gm_gearset_file {
    gm_description *description;
    gm_gearset *gearset;
    gm_plant *plant;
    gm_rig_source *rig;     /* of a rig file; description and gearset are then NULL */
    double oil_temperature; /* K */
    const char *path;       /* it was read from; the caller's */
} gm_gearset_file;

/** oil_temperature [K], NAN: the description's. On failure nothing is held. */
GM_NODISCARD gm_status gm_gearset_file_open(const char *path, double oil_temperature,
                                            gm_gearset_file *file, gm_error *error);
/** The same, and a rig file is fine too: its model is then opened and identified. */
GM_NODISCARD gm_status gm_gearset_file_open_any(const char *path, double oil_temperature,
                                                gm_gearset_file *file, gm_error *error);
void gm_gearset_file_close(gm_gearset_file *file);

#endif
