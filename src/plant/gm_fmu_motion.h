/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A reduced gearset in motion: a baked FMU in Model Exchange as the very file that ships,
 * with the interface of core/gm_vars.def (torques in, speeds out).
 */
#ifndef GM_FMU_MOTION_H
#define GM_FMU_MOTION_H

#include "plant/gm_dynamics.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Which fidelity the component is set to: the values of its parameter. */
typedef enum gm_fmu_fidelity { GM_FMU_RIGID = 1, GM_FMU_LASH = 2 } gm_fmu_fidelity;

typedef struct gm_fmu_plant gm_fmu_plant;

/** Looks into the file once; each motion opens it again. GM_ERR_FORMAT when it does not
 *  have the interface; errors of gm_fmu_open_exchange. */
GM_NODISCARD gm_status gm_fmu_plant_create(const char *path, gm_fmu_fidelity fidelity,
                                           gm_fmu_plant **plant, gm_error *error);
void gm_fmu_plant_destroy(gm_fmu_plant *plant);

/** The plant must outlive the dynamics and its motions. */
gm_dynamics gm_fmu_plant_dynamics(const gm_fmu_plant *plant);

#ifdef __cplusplus
}
#endif
#endif
