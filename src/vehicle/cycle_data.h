/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Speed traces and gears of the built-in cycles, as the regulations print them.
 */
#ifndef CYCLE_DATA_H
#define CYCLE_DATA_H

enum {
    GM_ECE15_POINTS = 26,
    GM_ECE15_GEARS = 7,
    GM_EUDC_POINTS = 22,
    GM_EUDC_GEARS = 9,
    GM_WLTC_SAMPLES = 1801
};

typedef struct gm_trace_point {
    short time, speed; /* s, km/h */
} gm_trace_point;

/** From this second on the wheels are driven in this gear, or wait in it. */
typedef struct gm_trace_gear {
    short time, gear;
} gm_trace_gear;

extern const gm_trace_point gm_ece15[GM_ECE15_POINTS], gm_eudc[GM_EUDC_POINTS];
extern const gm_trace_gear gm_ece15_gears[GM_ECE15_GEARS], gm_eudc_gears[GM_EUDC_GEARS];
extern const short gm_wltc_class3b[GM_WLTC_SAMPLES]; /* 0.1 km/h, one a second */

#endif
