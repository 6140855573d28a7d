/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Ratios and inertias of a gearset on the test rig.
 */
#ifndef RIG_IDENTIFY_H
#define RIG_IDENTIFY_H

#include "plant/gm_plant.h"
#include "sweep/rig_ramp.h"

#define GM_RIG_MAX_GEARS 32

typedef struct gm_rig_identity {
    double ratio[GM_MAX_INPUT_PATHS][GM_RIG_MAX_GEARS];         /* by index of the gear */
    gm_rig_inertia inertia[GM_MAX_FLANGES];                     /* J_out, J_p, kg.m2 */
    gm_rig_inertia total[GM_MAX_INPUT_PATHS][GM_RIG_MAX_GEARS]; /* J_s at the output */
} gm_rig_identity;

typedef struct gm_rig_identification {
    const gm_plant_info *info;
    double given_inertia[GM_MAX_INPUT_PATHS]; /* kg.m2; NAN: measured in neutral */
    double ramp_time;                         /* s; 0: automatic */
} gm_rig_identification;

/** Find them all. GM_ERR_MODEL: a path has neither neutral nor a given inertia, or does
 *  not turn with the output; errors of gm_rig_run_hold. */
GM_NODISCARD gm_status gm_rig_identify(gm_rig_run *run, const gm_rig_identification *how,
                                       gm_rig_identity *identity, gm_error *error);

#endif
