/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Drive cycles: a speed trace, and gears where the regulation names them.
 *
 * The trace is piecewise linear. What a driver follows is its moving average over
 * GM_CYCLE_SMOOTHING seconds: no jumps of acceleration, the same distance, and at most
 * 0.13 m/s (where the trace starts off with 1 m/s2) away from the trace, far inside the
 * 2 km/h that the regulations allow.
 */
#ifndef GM_CYCLE_H
#define GM_CYCLE_H

#include "base/gm_status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define GM_CYCLE_NAME 32
#define GM_CYCLE_SMOOTHING 1.0 /* s */

/** From this time on the car is driven in this gear, or waits in it. */
typedef struct gm_cycle_gear {
    double time; /* s */
    int gear;
} gm_cycle_gear;

typedef struct gm_cycle {
    char name[GM_CYCLE_NAME];
    int n;
    double *time, *speed; /* [n] s, strictly increasing from 0; m/s, >= 0 */
    double *distance;     /* [n] m, of the trace */
    double *grade;        /* [n] rise over run; NULL: level */
    double *grade_sum;    /* [n] its integral over time, s; NULL likewise */
    int n_gears;          /* 0: the cycle names no gears */
    gm_cycle_gear *gears; /* [n_gears] by time, the first at 0 */
} gm_cycle;

/** A built-in cycle: ece15, urban (4 x ECE-15), eudc, nedc (urban and EUDC), wltc3b.
 *  On success *cycle is the caller's (gm_cycle_destroy). GM_ERR_ARGUMENT with the names
 *  that there are; GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_cycle_named(const char *name, gm_cycle **cycle,
                                      gm_error *error);

/** A cycle from points: time [s] strictly increasing from 0, speed >= 0 [m/s], both are
 *  copied; gears may be NULL. GM_ERR_ARGUMENT says which point breaks the rule. */
GM_NODISCARD gm_status gm_cycle_create(const char *name, int n, const double *time,
                                       const double *speed, int n_gears,
                                       const gm_cycle_gear *gears, gm_cycle **cycle,
                                       gm_error *error);

/** A cycle from a file: columns time_s, speed_km_h, and optionally gear and grade_percent
 *  (cycle_file.c). Its name is that of the file. GM_ERR_IO, GM_ERR_FORMAT with file,
 *  line, what was found and expected, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_cycle_read(const char *path, gm_cycle **cycle, gm_error *error);

/** Give the cycle's points a grade (rise over run, finite), copied. Once. GM_ERR_MEMORY;
 *  then the cycle stays level. */
GM_NODISCARD gm_status gm_cycle_set_grade(gm_cycle *cycle, const double *grade,
                                          gm_error *error);
void gm_cycle_destroy(gm_cycle *cycle);

double gm_cycle_duration(const gm_cycle *cycle); /* s */
double gm_cycle_distance(const gm_cycle *cycle); /* m */

/** Smoothed speed [m/s] at time t [s], with its derivative [m/s2]. Before the start and
 *  after the end the trace keeps its edge value. */
double gm_cycle_speed(const gm_cycle *cycle, double t, double *acceleration);

/** Smoothed grade at time t, rise over run; 0 on the level. */
double gm_cycle_grade(const gm_cycle *cycle, double t);

/** The first time after t at which smoothed speed and grade change their laws (between
 *  such times they are polynomials); infinite after the last. */
double gm_cycle_next(const gm_cycle *cycle, double t);

#ifdef __cplusplus
}
#endif
#endif
