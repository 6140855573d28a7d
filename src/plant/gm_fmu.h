/* SPDX-License-Identifier: BSD-2-Clause
 *
 * An FMI 2.0 FMU opened from its file: unpacked into a temporary folder, its library
 * loaded, its variables found by name. Refuses what is malformed.
 */
#ifndef GM_FMU_H
#define GM_FMU_H

#include "base/gm_status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct gm_fmu gm_fmu;

/** Open and instantiate for Co-Simulation. GM_ERR_IO, GM_ERR_FORMAT (not an archive, no
 *  modelDescription, no binary for this platform, entries that would leave the folder),
 *  GM_ERR_TOOL. */
GM_NODISCARD gm_status gm_fmu_open(const char *path, gm_fmu **fmu, gm_error *error);
/** The same for Model Exchange (fmu_motion.c). */
GM_NODISCARD gm_status gm_fmu_open_exchange(const char *path, gm_fmu **fmu,
                                            gm_error *error);
void gm_fmu_close(gm_fmu *fmu);

/** What a component says it was made from. */
typedef struct gm_fmu_origin {
    const char *description_sha256; /* NULL: it does not say */
    const char *map_hash;           /* content hash of the map; NULL: it does not say */
    double oil_temperature;         /* K; NAN: it does not say */
    int n_oil; /* temperatures of its oil axis, [K]; 0: it has none */
    const double *oil;
    const char *guid;
} gm_fmu_origin;

/** The texts belong to the FMU. */
gm_fmu_origin gm_fmu_read_origin(const gm_fmu *fmu);
/** SHA-256 of the library that is executed, 64 hexadecimal digits. GM_ERR_IO. */
GM_NODISCARD gm_status gm_fmu_hash_library(const gm_fmu *fmu, char text[65],
                                           gm_error *error);
/** The name it was opened by; belongs to the FMU. */
const char *gm_fmu_path(const gm_fmu *fmu);

/** Value reference of a variable; GM_ERR_FORMAT when there is none of this name. */
GM_NODISCARD gm_status gm_fmu_find(const gm_fmu *fmu, const char *name,
                                   unsigned *reference, gm_error *error);
/** 1 when the FMU has a variable of this name. */
int gm_fmu_has(const gm_fmu *fmu, const char *name);

GM_NODISCARD gm_status gm_fmu_set_real(gm_fmu *fmu, unsigned reference, double value,
                                       gm_error *error);
GM_NODISCARD gm_status gm_fmu_set_integer(gm_fmu *fmu, unsigned reference, int value,
                                          gm_error *error);
GM_NODISCARD gm_status gm_fmu_get_real(gm_fmu *fmu, unsigned reference, double *value,
                                       gm_error *error);
GM_NODISCARD gm_status gm_fmu_get_boolean(gm_fmu *fmu, unsigned reference, int *value,
                                          gm_error *error);

/** Back to the state after instantiation. */
GM_NODISCARD gm_status gm_fmu_reset(gm_fmu *fmu, gm_error *error);
/** Set up the experiment at t = 0 and enter initialisation mode; then leave it. */
GM_NODISCARD gm_status gm_fmu_initialise(gm_fmu *fmu, gm_error *error);
GM_NODISCARD gm_status gm_fmu_start(gm_fmu *fmu, gm_error *error);
/** One communication step from time t [s] of h > 0 [s]. */
GM_NODISCARD gm_status gm_fmu_step(gm_fmu *fmu, double t, double h, gm_error *error);

#ifdef __cplusplus
}
#endif
#endif
