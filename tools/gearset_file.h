/* SPDX-License-Identifier: BSD-2-Clause
 *
 * From a description file to a plant, in one call.
 */
#ifndef GEARSET_FILE_H
#define GEARSET_FILE_H

#include "plant/gm_builtin.h"
#include "sweep/gm_experiment_choice.h"

typedef struct gm_rig_source gm_rig_source; /* rig_source.h */

typedef struct gm_gearset_file {
    gm_description *description;
    gm_gearset *gearset;
    const gm_plant *plant;         /* what experiments see */
    gm_plant *solved;              /* the built-in gearset; NULL: it is a foreign model */
    gm_measured_builtin *measured; /* NULL: the plant is solved, or foreign */
    gm_rig_source *rig;         /* of a rig file; description and gearset are then NULL */
    gm_experiment_choice how;   /* what holds, nothing automatic */
    double inertia_uncertainty; /* relative, of ramps; 0: of the mass matrix */
    double oil_temperature;     /* K */
    const char *path;           /* it was read from; the caller's */
} gm_gearset_file;

/** oil_temperature [K], NAN: the description's. On failure nothing is held. */
GM_NODISCARD gm_status gm_gearset_file_open(const char *path, double oil_temperature,
                                            gm_gearset_file *file, gm_error *error);
/** The same, and a rig file is fine too: its model is then opened and identified. how:
 *  experiments as chosen; NULL: the plant's own. GM_ERR_ARGUMENT: it cannot do these. */
GM_NODISCARD gm_status gm_gearset_file_open_any(const char *path, double oil_temperature,
                                                const gm_experiment_choice *how,
                                                gm_gearset_file *file, gm_error *error);
void gm_gearset_file_close(gm_gearset_file *file);

#endif
