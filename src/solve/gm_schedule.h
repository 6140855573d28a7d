/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A schedule: what acts on a gearset over time, as a table in a text file of
 * comma-separated values. The first row names the columns, in any order:
 *
 *   time_s                 ascending; a time given twice is a step of all values there
 *   FLANGE.tau_Nm          torque into the gearset, or
 *   FLANGE.speed_rpm       speed that the flange is made to turn with
 *   PATH.gear              commanded gear, holds until the next row; empty: as before
 *   FLANGE.w_start_rpm     speed at the start, of a flange whose torque is given
 *   oil_temperature_degC   constant over the run
 *
 * FLANGE is `output` or the name of a path. Torques and speeds run on straight lines
 * between the rows. What has no column is zero: no torque, neutral. The last two columns
 * belong to the start: below the first row they repeat it or stay empty. Empty lines and
 * lines that begin with # are skipped.
 */
#ifndef GM_SCHEDULE_H
#define GM_SCHEDULE_H

#include "plant/gm_plant.h"
#include "solve/gm_driven.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct gm_schedule_row {
    double t;                     /* s */
    double value[GM_MAX_FLANGES]; /* rad/s where the flange is driven, else N.m */
    int gear[GM_MAX_INPUT_PATHS];
} gm_schedule_row;

typedef struct gm_schedule {
    char *file;
    int n_flanges;
    int driven[GM_MAX_FLANGES];         /* 1: its speed is given */
    double start_speed[GM_MAX_FLANGES]; /* rad/s; NAN: not given */
    double oil_temperature;             /* K; NAN: not given */
    int n_rows;                         /* >= 2 */
    gm_schedule_row *rows;              /* by time, never three of the same */
} gm_schedule;

/** Read a schedule for a gearset. GM_ERR_IO; GM_ERR_FORMAT with file, line and column,
 *  what was found and what was expected; GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_schedule_read(const char *path, const gm_plant_info *info,
                                        gm_schedule **schedule, gm_error *error);
void gm_schedule_destroy(gm_schedule *schedule);

/** Speeds of all flanges at the start, speed[n_flanges] [rad/s]: as given; where a gear
 *  is engaged, from the other side of it; else zero. GM_ERR_MODEL when given speeds do
 *  not fit the gears of the first row, and errors of the plant's kinematics. */
GM_NODISCARD gm_status gm_schedule_start_speeds(const gm_schedule *schedule,
                                                const gm_plant *plant, double *speed,
                                                gm_error *error);

/** A place in a schedule, for one run. */
typedef struct gm_schedule_reader {
    const gm_schedule *schedule;
    int row; /* the present piece begins here; -1: not begun */
} gm_schedule_reader;

/** The schedule as a drive; the reader, which it changes, outlives it. */
gm_drive gm_schedule_drive(gm_schedule_reader *reader);

#ifdef __cplusplus
}
#endif
#endif
