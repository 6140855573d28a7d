/* SPDX-License-Identifier: BSD-2-Clause
 *
 * An opened FMU as the files of its adapters share it.
 */
#ifndef FMU_PARTS_H
#define FMU_PARTS_H

#include "plant/fmu_archive.h"
#include "plant/fmu_description.h"
#include "plant/fmu_library.h"
#include "plant/gm_fmu.h"

struct gm_fmu {
    char *path;
    char folder[FMU_FOLDER_SIZE]; /* empty while nothing is unpacked */
    fmu_description description;
    fmu_library library;
    fmi2CallbackFunctions callbacks;
    fmi2Component component;
    char message[512]; /* the FMU's last message */
};

/** GM_OK for OK and Warning (the FMU went on), else GM_ERR_TOOL with the function and the
 *  FMU's message. */
GM_NODISCARD gm_status gm_fmu_checked(gm_fmu *fmu, const char *function,
                                      fmi2Status status, gm_error *error);

#endif
