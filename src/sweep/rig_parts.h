/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A run on the test rig as its files share it.
 */
#ifndef RIG_PARTS_H
#define RIG_PARTS_H

#include "sweep/rig_run.h"

#define GM_RIG_HOLDS GM_MAX_FLANGES

typedef enum gm_rig_hold_kind {
    GM_HOLD_SPEED,  /* of a flange that takes torque */
    GM_HOLD_TORQUE, /* of a path that takes speed, the output taking speed too */
    GM_HOLD_THROUGH /* torque of a path that takes speed, through the output's torque */
} gm_rig_hold_kind;

typedef struct gm_rig_hold {
    gm_rig_hold_kind kind;
    int flange;  /* whose command is varied */
    int seen_at; /* where what is held is seen */
    double u_scale, y_scale;
    double u0;     /* command that would have held y over the last period */
    double change; /* of u0 over the last period */
} gm_rig_hold;

struct gm_rig_run {
    const gm_rig *rig;
    void *model;
    gm_rig_scales scales;
    double first_period, longest_period, period; /* s */
    int started;
    int learned; /* 1: holds, g and this period belong to the gears of base ... */
    double learned_period, learned_ratio[GM_MAX_INPUT_PATHS]; /* ... and these ratios */
    gm_rig_command command, base;
    gm_rig_view seen;
    double mean_torque[GM_MAX_FLANGES]; /* over the last stair of a speed that moved */
    double ratio_max; /* largest |ratio| that is engaged, 1: none known */
    double counter;   /* gm_rig_run_counter_torque of the last target */
    int n_holds;
    gm_rig_hold hold[GM_RIG_HOLDS];
    double g[GM_RIG_HOLDS * GM_RIG_HOLDS]; /* factors of G */
    int pivot[GM_RIG_HOLDS];
};

/** Go on by `time` to the commands `next`: torques are set at once, speeds that are taken
 *  move evenly over the first part (rise, 0 to 1) of the time. */
GM_NODISCARD gm_status gm_rig_run_go(gm_rig_run *run, const gm_rig_command *next,
                                     double time, double rise, gm_error *error);

/** What a hold wants to be constant, as seen now. */
double gm_rig_run_seen(const gm_rig_run *run, const gm_rig_hold *hold);

/** Torque at the output that balances the torques of engaged paths but for losses. */
double gm_rig_run_counter_torque(const gm_rig_run *run, const gm_rig_target *target);

/** Measure G with a period that suits. */
GM_NODISCARD gm_status gm_rig_run_learn(gm_rig_run *run, gm_error *error);

/** Begin in the target's configuration, at rest, unless the run is in it already. */
GM_NODISCARD gm_status gm_rig_run_begin(gm_rig_run *run, const gm_rig_target *target,
                                        gm_error *error);

#endif
