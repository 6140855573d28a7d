/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What a simulation records: a table of comma-separated values, one row for each time.
 * Columns: time, speed, torque and acceleration of every flange, gear and state of every
 * path, power and energy, then the signals of the plant that were chosen. Units stand in
 * the names. The file appears under its name when it is complete, or not at all.
 */
#ifndef RECORDING_H
#define RECORDING_H

#include "plant/gm_plant.h"
#include "solve/gm_driven.h"

typedef struct gm_recording gm_recording;

typedef struct gm_recording_source {
    const gm_dynamics *dynamics;
    const gm_plant_info *info;
    gm_driven *driven;
} gm_recording_source;

/** Begin. patterns: of names of signals, separated by commas, * standing for any
 *  characters and ? for one. GM_ERR_ARGUMENT: a pattern that fits no signal. GM_ERR_IO,
 *  GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_recording_open(const char *path,
                                         const gm_recording_source *source,
                                         const char *patterns, gm_recording **recording,
                                         gm_error *error);

/** One row for the state x at t. */
GM_NODISCARD gm_status gm_recording_row(gm_recording *recording, double t,
                                        const double *x, gm_error *error);

long gm_recording_rows(const gm_recording *recording);
int gm_recording_columns(const gm_recording *recording);

/** Give the file its name. */
GM_NODISCARD gm_status gm_recording_finish(gm_recording *recording, gm_error *error);

/** Free; what is not finished is removed. */
void gm_recording_close(gm_recording *recording);

#endif
