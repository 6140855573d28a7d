/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A simulated gearset (plant/gm_rig.h) as a plant for the sweep: its ratios and inertias
 * are identified and its steady points measured on a test rig, each thread's in a process
 * of its own.
 */
#ifndef GM_RIG_PLANT_H
#define GM_RIG_PLANT_H

#include "plant/gm_plant.h"
#include "plant/gm_rig.h"

#ifdef __cplusplus
extern "C" {
#endif

/** How to experiment. Zero: automatic. */
typedef struct gm_rig_settings {
    double dwell;      /* s: period over which commands are constant */
    double ramp_time;  /* s: of the ramps for inertias */
    double creep;      /* rad/s, > 0: speed that stands for the limit at rest */
    double time_limit; /* s, > 0, for one steady point; for the identification 20 times */
    double inertia[GM_MAX_INPUT_PATHS]; /* kg.m2 of paths without neutral; NAN: none */
    int losses_by_ramps;   /* 1: speeds are ramped, 0: points are held until steady */
    const gm_plant *known; /* knows the ratios and inertias; NULL: they are measured */
} gm_rig_settings;

/** What identification found beyond the plant's own calls. */
typedef struct gm_rig_report {
    double inertia_uncertainty; /* largest, relative */
} gm_rig_report;

/** Identify and make the plant. rig, settings' texts and the texts and gears of info must
 *  outlive it. report may be NULL. Free with gm_rig_plant_destroy. GM_ERR_ARGUMENT:
 *  losses by ramps at a flange that takes speed; GM_ERR_MODEL,
 *  GM_ERR_SOLVE, GM_ERR_TOOL with what went wrong in the model; GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_rig_plant_create(const gm_rig *rig, const gm_plant_info *info,
                                           const gm_rig_settings *settings,
                                           gm_plant **plant, gm_rig_report *report,
                                           gm_error *error);
void gm_rig_plant_destroy(gm_plant *plant);

#ifdef __cplusplus
}
#endif
#endif
