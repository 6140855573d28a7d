/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The shipped FMU as verification asks it: started at a steady point, its losses read.
 */
#ifndef FMU_PROBE_H
#define FMU_PROBE_H

#include "sweep/gm_verify.h"

typedef struct gm_fmu_probe gm_fmu_probe;

/** Open the FMU and find its variables. GM_ERR_MODEL when its paths are not the plant's,
 *  which must outlive the probe. */
GM_NODISCARD gm_status gm_fmu_probe_open(const char *path, const gm_plant *plant,
                                         gm_fmu_probe **probe, gm_error *error);
void gm_fmu_probe_close(gm_fmu_probe *probe);

/** The probe as gm_verify_steady takes it. */
gm_reduced_probe gm_fmu_probe_interface(gm_fmu_probe *probe);

#endif
