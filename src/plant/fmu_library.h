/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The shared library of an FMI 2.0 FMU and its functions.
 */
#ifndef FMU_LIBRARY_H
#define FMU_LIBRARY_H

#include "base/gm_status.h"
#include "fmi2FunctionTypes.h"

#define FMU_LIBRARY_PATH 1024

/** Functions that every FMU must have. */
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
    X(GetInteger)                                                                        \
    X(GetBoolean)                                                                        \
    X(DoStep)

/** Functions of Model Exchange: NULL where the library does not have them. */
#define FMU_EXCHANGE_FUNCTIONS(X)                                                        \
    X(EnterEventMode)                                                                    \
    X(NewDiscreteStates)                                                                 \
    X(EnterContinuousTimeMode)                                                           \
    X(SetTime)                                                                           \
    X(SetContinuousStates)                                                               \
    X(GetContinuousStates)                                                               \
    X(GetDerivatives)                                                                    \
    X(GetEventIndicators)                                                                \
    X(GetDirectionalDerivative)

typedef struct fmu_library {
    void *handle;
    char path[FMU_LIBRARY_PATH]; /* of the file that was loaded */
#define FMU_FIELD(name) fmi2##name##TYPE *name;
    FMU_FUNCTIONS(FMU_FIELD)
    FMU_EXCHANGE_FUNCTIONS(FMU_FIELD)
#undef FMU_FIELD
} fmu_library;

/** Load binaries/<platform>/<identifier> of an unpacked FMU; archive names it in
 *  messages. GM_ERR_FORMAT when there is no such file or a function is missing,
 *  GM_ERR_TOOL when it cannot be loaded. */
GM_NODISCARD gm_status gm_fmu_library_load(const char *folder, const char *identifier,
                                           const char *archive, fmu_library *library,
                                           gm_error *error);

/** 1 when the library has what Model Exchange needs (but for directional derivatives).
 */
int gm_fmu_library_exchanges(const fmu_library *library);

/** Unload; a library that was never loaded is fine. */
void gm_fmu_library_close(fmu_library *library);

#endif
