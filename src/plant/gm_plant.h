/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The plant: what experiments see of a detailed gearset, whatever is inside. The built-in
 * model is one (builtin.h); an FMU or a compiled model can be others. No experiment knows
 * which plant it runs.
 *
 * A plant is constant and may be shared by threads; each thread makes its own workspace.
 */
#ifndef GM_PLANT_H
#define GM_PLANT_H

#include "base/gm_status.h"
#include "model/gm_steady.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What is known of a plant without running it. */
typedef struct gm_plant_gear {
    int number;         /* -1 reverse, 1..n */
    double ratio_given; /* w_path / w_output as the source states it; NAN: not stated */
} gm_plant_gear;

typedef struct gm_plant_path {
    const char *name; /* "odd", "even" or "input" */
    int n_gears;
    const gm_plant_gear *gears; /* ascending by number */
    int always_engaged;         /* 1: it has one gear and no neutral */
    double
        sync_torque; /* cone capacity at the input flange, N.m (smallest of its gears) */
} gm_plant_path;

typedef struct gm_plant_info {
    const char *name, *title;
    const char *source_sha256; /* identifies the source */
    int n_paths;
    gm_plant_path path[GM_MAX_INPUT_PATHS];
    double speed_max;       /* at the input flanges, rad/s */
    double torque_max;      /* at the input flanges, N.m */
    double oil_temperature; /* K */
    int coupled;            /* 1: the input shafts drag on each other (concentric) */
} gm_plant_info;

/** A steady problem: the torque balance of one point. See model/gm_gearset.h for the
 *  meaning of the calls; `work` is the workspace of the calling thread. */
typedef struct gm_plant_class {
    gm_status (*kinematics)(const void *self, const int *gear, gm_kinematics *kinematics,
                            gm_error *error);
    /* How path p gives way in gear `number`; NULL: not known, the path is rigid. */
    gm_status (*compliance)(const void *self, int p, int number,
                            gm_compliance *compliance, gm_error *error);
    /* Speeds at path p (rad/s, > 0) in gear `number` where the loss has a kink; returns
       how many of at most n_max were written, ascending. */
    int (*kink_speeds)(const void *self, int p, int number, int n_max, double *speed);
    /* The same for torques at path p (N.m, > 0). */
    int (*kink_torques)(const void *self, int p, int number, int n_max, double *torque);
    /* Ratios w_path / w_output of path p in neutral at which its drag jumps: parts of the
       path turn in step with parts of the output. At most n_max, ascending. */
    int (*drag_lines)(const void *self, int p, int n_max, double *ratio);
    gm_status (*work_create)(const void *self, void **work, gm_error *error);
    void (*work_destroy)(void *work);
    gm_status (*set_point)(void *work, const gm_steady_point *point, gm_error *error);
    int (*size)(const void *work);
    int (*entries)(const void *work);
    double (*pass)(void *work, double *x);
    void (*residual)(void *work, const double *x, double *f);
    void (*pattern)(const void *work, int *column_start, int *row);
    void (*jacobian)(void *work, const double *x, double *value);
    void (*result)(const void *work, const double *x, gm_steady_result *result);
    /* A plant that is measured instead of solved answers a point by experiment; then
       set_point to result are NULL. What is found has an uncertainty. */
    gm_status (*measure)(void *work, const gm_steady_point *point,
                         gm_steady_result *result, gm_error *error);
    /* What is measured from now on does not depend on what was measured before. */
    void (*restart)(void *work);
} gm_plant_class;

typedef struct gm_plant {
    const gm_plant_class *is;
    const void *self;
    gm_plant_info info;
} gm_plant;

#ifdef __cplusplus
}
#endif
#endif
