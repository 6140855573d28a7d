/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A first rig file for an FMU, by what its modelDescription says: names, units,
 * causalities, ranges. Nothing of the FMU runs.
 */
#ifndef GM_RIG_GUESS_H
#define GM_RIG_GUESS_H

#include "base/gm_status.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What the user knows. NAN: nothing. */
typedef struct gm_rig_hints {
    double speed_max;  /* rad/s at the input flanges */
    double torque_max; /* N.m at the input flanges */
    const char *model; /* how the rig file names the FMU */
} gm_rig_hints;

typedef struct gm_rig_guess_summary {
    int guessed; /* lines with a comment that begins "guessed" */
    int missing; /* fields that are TODO */
} gm_rig_guess_summary;

/** Read the FMU and write a rig file: calls write with pieces of text. GM_ERR_IO,
 *  GM_ERR_FORMAT: it is malformed or no gearset (no shafts with torque and speed, or too
 *  many), GM_ERR_MEMORY; nothing is written then. */
GM_NODISCARD gm_status gm_rig_guess(const char *fmu, const gm_rig_hints *hints,
                                    void (*write)(void *context, const char *text),
                                    void *context, gm_rig_guess_summary *summary,
                                    gm_error *error);

#ifdef __cplusplus
}
#endif
#endif
