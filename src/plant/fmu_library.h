/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The shared library of an FMI 2.0 Co-Simulation FMU and its functions.
 */
#ifndef FMU_LIBRARY_H
#define FMU_LIBRARY_H

#include "base/gm_status.h"
#include "fmi2FunctionTypes.h"

/** Functions that are called: field, type. */
#define FMU_FUNCTIONS(X)                                                                 \
    X(Instantiate)                                                                       \
    X(FreeInstance)                                                                      \
    X(SetupExperiment)                                                                   \
    X(EnterInitializationMode)                                                           \
    X(ExitInitializationMode)                                                            \
    X(Terminate)                                                                         \
    X(Reset)                                                                             \
    X(SetReal)                                                                           \
    X(SetInteger)                                                                        \
    X(GetReal)                                                                           \
    X(GetBoolean)                                                                        \
    X(DoStep)

typedef struct fmu_library {
    void *handle;
#define FMU_FIELD(name) fmi2##name##TYPE *name;
    FMU_FUNCTIONS(FMU_FIELD)
#undef FMU_FIELD
} fmu_library;

/** Load binaries/<platform>/<identifier> of an unpacked FMU; archive names it in
 *  messages. GM_ERR_FORMAT when there is no such file or a function is missing,
 *  GM_ERR_TOOL when it cannot be loaded. */
GM_NODISCARD gm_status gm_fmu_library_load(const char *folder, const char *identifier,
                                           const char *archive, fmu_library *library,
                                           gm_error *error);

/** Unload; a library that was never loaded is fine. */
void gm_fmu_library_close(fmu_library *library);

#endif
