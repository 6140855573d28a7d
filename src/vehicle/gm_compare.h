/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Two drives of one cycle, with the detailed and with the reduced gearset: what was
 * gained and what it cost.
 *
 * Torques are compared below 5 Hz (second-order Butterworth, run forward and backward, so
 * without delay): what reaches driver and car; above it the two differ by what a reduced
 * gearset leaves out on purpose.
 */
#ifndef GM_COMPARE_H
#define GM_COMPARE_H

#include "vehicle/gm_record.h"

#ifdef __cplusplus
extern "C" {
#endif

#define GM_COMPARE_CUT_OFF 5.0 /* Hz */
#define GM_COMPARE_WORST 5

/** Difference of one quantity over the whole cycle. */
typedef struct gm_difference {
    double rms, largest; /* SI */
    double at;           /* s, where it is largest */
    double relative;     /* rms over the rms of the detailed signal */
} gm_difference;

/** What was going on where two drives differ. */
typedef enum gm_cause {
    GM_CAUSE_STANDS,   /* the car stands or just starts */
    GM_CAUSE_SHIFT,    /* a gear is changed, or waits to be */
    GM_CAUSE_REVERSAL, /* torque changes its sign: backlash */
    GM_CAUSE_TABLES,   /* none of these: the tables */
    GM_CAUSES
} gm_cause;

/** "standstill", "shift", "torque reversal", "tables". */
const char *gm_cause_name(gm_cause cause);

/** One of the places with the largest difference of output torque below the cut-off. */
typedef struct gm_worst {
    double time;       /* s */
    double difference; /* N.m */
    gm_cause cause;
} gm_worst;

/** Loss energy while the wheels are driven in one gear. */
typedef struct gm_gear_loss {
    int gear;
    double time;              /* s */
    double detailed, reduced; /* J */
} gm_gear_loss;

/** One shift. */
typedef struct gm_shift {
    double time; /* s, when it begins */
    int from, to;
    double engaged_detailed, engaged_reduced; /* s, when the new gear was locked; NAN */
    double rms;                               /* output torque below the cut-off, N.m */
} gm_shift;

typedef struct gm_comparison {
    gm_difference engine_speed;  /* rad/s */
    gm_difference engine_torque; /* N.m */
    gm_difference vehicle_speed; /* m/s */
    gm_difference output_torque; /* N.m, below the cut-off */
    gm_difference input_torque[GM_MAX_INPUT_PATHS];
    double loss_detailed, loss_reduced; /* J, in the gearset */
    double loss_relative;               /* their difference over the detailed one */
    double cpu_saved;                   /* 1 - reduced over detailed */
    int n_worst;
    gm_worst worst[GM_COMPARE_WORST]; /* at least 2 s apart, the largest first */
    int n_gears;
    gm_gear_loss gear[GM_PLAN_MAX_GEARS];
    int n_shifts;
    gm_shift *shift; /* [n_shifts] */
} gm_comparison;

/** Both records have the same step and length; plan: that of both drives. The comparison
 *  is to be cleared. GM_ERR_ARGUMENT, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_compare(const gm_record *detailed, const gm_record *reduced,
                                  const gm_gear_plan *plan, gm_comparison *comparison,
                                  gm_error *error);
void gm_comparison_clear(gm_comparison *comparison);

#ifdef __cplusplus
}
#endif
#endif
