/* SPDX-License-Identifier: BSD-2-Clause
 *
 * From a rig file to a plant: the model opened, identified and ready to be measured.
 */
#ifndef RIG_SOURCE_H
#define RIG_SOURCE_H

#include "plant/gm_foreign.h"
#include "solve/gm_continuous_rig.h"
#include "sweep/gm_experiment_choice.h"

#include <stdbool.h>

typedef struct gm_rig_source {
    gm_rig_file *file;
    gm_foreign *foreign;
    gm_continuous_rig continuous;
    gm_plant_gear gears[GM_MAX_INPUT_PATHS][32];
    gm_plant *plant;
    gm_rig_report report;
    gm_experiment_choice how; /* of the rig file, or as chosen */
} gm_rig_source;

/** oil_temperature [K]; NAN: the rig file's. how: NULL or automatic: the rig file's.
 *  GM_ERR_ARGUMENT: a foreign model cannot do this. */
GM_NODISCARD gm_status gm_rig_source_open(const char *path, double oil_temperature,
                                          const gm_experiment_choice *how,
                                          gm_rig_source **source, gm_error *error);
/** Whether the model takes an oil temperature. */
bool gm_rig_source_takes_oil(const gm_rig_source *source);
void gm_rig_source_close(gm_rig_source *source);

#endif
