/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The shipped FMU as verification asks it: started at a steady point, its losses read.
 */
#ifndef FMU_PROBE_H
#define FMU_PROBE_H

#include "plant/gm_fmu.h"
#include "sweep/gm_verify.h"

typedef struct gm_fmu_probe gm_fmu_probe;

/** Find the variables of an open FMU. GM_ERR_MODEL when its paths are not the plant's,
 *  GM_ERR_FORMAT when it lacks a variable. FMU and plant must outlive the probe. */
GM_NODISCARD gm_status gm_fmu_probe_create(gm_fmu *fmu, const gm_plant *plant,
                                           gm_fmu_probe **probe, gm_error *error);
void gm_fmu_probe_destroy(gm_fmu_probe *probe);

/** The probe as gm_verify_steady takes it. Asking answers GM_ERR_MODEL when the FMU does
 *  not have the point's gear. */
gm_reduced_probe gm_fmu_probe_interface(gm_fmu_probe *probe);

#endif
