/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The transmission control, decided before the drive: which gear every path is commanded
 * to and how much of the clutch capacity each path gets, over time. Both gearsets under
 * comparison get the same commands.
 *
 * Two paths: the next gear is preselected on the waiting path, then the clutches hand
 * over within shift_time. A shift within one path opens its clutch for interrupt_time,
 * changes the gear, waits as long for the synchroniser, and closes it again.
 */
#ifndef GEAR_PLAN_H
#define GEAR_PLAN_H

#include "model/gm_steady.h"
#include "vehicle/gm_cycle.h"
#include "vehicle/gm_vehicle.h"

/** What the control must know of a gearset: its forward gears in ascending order. */
#define GM_PLAN_MAX_GEARS 32

typedef struct gm_plan_gear {
    int number, path;
    double ratio; /* |w_path / w_output| */
} gm_plan_gear;

typedef struct gm_transmission {
    int n_paths, n_gears;
    gm_plan_gear gear[GM_PLAN_MAX_GEARS];
} gm_transmission;

/** A value that runs from one value to another, as a smooth step. */
typedef struct gm_ramp {
    double from_time, to_time; /* s */
    double from, to;
} gm_ramp;

typedef struct gm_gear_command {
    double time; /* s */
    int path, gear;
} gm_gear_command;

/** One change of the gear that drives. */
typedef struct gm_plan_shift {
    double start, end; /* s */
    int from, to;      /* gear numbers */
    int path;          /* of the new gear */
} gm_plan_shift;

typedef struct gm_gear_plan {
    int first_gear; /* that drives at the start */
    int n_shifts;
    gm_plan_shift *shifts; /* by time */
    int n_commands;
    gm_gear_command *commands;          /* by time; the first n_paths at 0 */
    int n_ramps[GM_MAX_INPUT_PATHS];    /* share of the clutch capacity of each path */
    gm_ramp *ramps[GM_MAX_INPUT_PATHS]; /* by time, not overlapping */
    double first_share[GM_MAX_INPUT_PATHS];
    int n_ratios;
    gm_ramp *ratios; /* ratio from the engine to the gearset's output */
    double first_ratio;
} gm_gear_plan;

/** Plan for a cycle: by the cycle's own gears where it names them (a gear that the
 *  gearset does not have becomes its highest), else by engine speed over the trace.
 *  GM_ERR_ARGUMENT: the gearset has no forward gear. GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_gear_plan_create(const gm_cycle *cycle,
                                           const gm_vehicle *vehicle,
                                           const gm_transmission *transmission,
                                           gm_gear_plan **plan, gm_error *error);
void gm_gear_plan_destroy(gm_gear_plan *plan);

/** Gears commanded at time t. */
void gm_gear_plan_gears(const gm_gear_plan *plan, double t, int gear[GM_MAX_INPUT_PATHS]);

/** Share of the clutch capacity that path p gets at time t, 0 to 1. */
double gm_gear_plan_share(const gm_gear_plan *plan, int p, double t);

/** Ratio w_engine / w_output that the driver reckons with at time t. */
double gm_gear_plan_ratio(const gm_gear_plan *plan, double t);

/** The gear that drives at time t; during a shift the one that is left until its middle.
 */
int gm_gear_plan_driving(const gm_gear_plan *plan, double t);

/** The first time after t at which commands or the law of a share change; infinite after
 *  the last. */
double gm_gear_plan_next(const gm_gear_plan *plan, double t);

#endif
