/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Which experiments a map is made by, as the user chooses.
 */
#ifndef GM_EXPERIMENT_CHOICE_H
#define GM_EXPERIMENT_CHOICE_H

#include "plant/gm_builtin.h"
#include "sweep/gm_rig_plant.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum gm_losses_by {
    GM_LOSSES_AUTO,   /* steady where the plant can be solved, else settle */
    GM_LOSSES_STEADY, /* the torque balance of every point is solved */
    GM_LOSSES_RAMP,   /* speeds are ramped through every point */
    GM_LOSSES_SETTLE  /* every point is held until nothing changes */
} gm_losses_by;

typedef enum gm_inertia_by {
    GM_INERTIA_AUTO,   /* of the mass matrix where the plant knows it, else ramps */
    GM_INERTIA_MATRIX, /* of the mass matrix */
    GM_INERTIA_RAMPS   /* two ramps of different slope */
} gm_inertia_by;

typedef struct gm_experiment_choice {
    gm_losses_by losses;
    gm_inertia_by inertia;
    double dwell;     /* s; 0: automatic */
    double ramp_time; /* s; 0: automatic */
} gm_experiment_choice;

/** What was chosen in the end, for people and for the map: "settle", "mass-matrix". */
const char *gm_losses_name(gm_losses_by losses);
const char *gm_inertia_name(gm_inertia_by inertia);

/** A built-in gearset by experiments on its motion, as far as the choice wants that. */
typedef struct gm_measured_builtin gm_measured_builtin;

/** solved: the same gearset as a plant that is solved; both outlive it. *choice is
 *  replaced by what holds. *measured is NULL where nothing is measured. GM_ERR_ARGUMENT:
 *  the choice contradicts itself; errors of gm_rig_plant_create. */
GM_NODISCARD gm_status gm_measured_builtin_create(const gm_gearset *gearset,
                                                  const gm_plant *solved,
                                                  gm_experiment_choice *choice,
                                                  gm_measured_builtin **measured,
                                                  gm_error *error);
void gm_measured_builtin_destroy(gm_measured_builtin *measured);
const gm_plant *gm_measured_builtin_plant(const gm_measured_builtin *measured);
gm_rig_report gm_measured_builtin_report(const gm_measured_builtin *measured);

#ifdef __cplusplus
}
#endif
#endif
