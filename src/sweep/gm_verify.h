/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Verification: the reduced component, as the file that ships, against the detailed
 * gearset at random points off the grid.
 */
#ifndef GM_VERIFY_H
#define GM_VERIFY_H

#include "plant/gm_plant.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What the reduced component answers at a steady point. */
typedef struct gm_reduced_answer {
    double loss_power;                  /* W */
    double path_drag[GM_MAX_INPUT_PATHS]; /* torque that a path in neutral needs, N.m */
    double output_reaction; /* output loss torque, N.m */
} gm_reduced_answer;

/** The reduced component as verification sees it: the shipped file behind a function. */
typedef struct gm_reduced_probe {
    gm_status (*at)(void *self, const gm_steady_point *point, double output_torque,
                    gm_reduced_answer *answer, gm_error *error);
    void *self;
} gm_reduced_probe;

/** Errors of one kind of point; relative means divided by the case's largest value. */
typedef struct gm_verify_case {
    const char *path; /* path name, or "both" */
    int gear[GM_MAX_INPUT_PATHS];
    int direction; /* +1 or -1: rotation of the output */
    int points;
    double largest_loss; /* N.m at the input flange */
    double max, rms;     /* N.m */
    double worst_speed, worst_torque; /* rad/s, N.m */
} gm_verify_case;

typedef enum gm_verify_group {
    GM_VERIFY_SINGLE,      /* one path engaged, the other at rest in neutral */
    GM_VERIFY_PRESELECTED, /* both engaged, one loaded */
    GM_VERIFY_BOTH_LOADED,
    GM_VERIFY_DRAG,        /* torque of free shafts turning in neutral */
    GM_VERIFY_REACTION,    /* their reaction on the output */
    GM_VERIFY_GROUPS
} gm_verify_group;

const char *gm_verify_group_name(gm_verify_group group);

typedef struct gm_verify_result {
    int points;
    uint64_t seed;
    double max_relative[GM_VERIFY_GROUPS], rms_relative[GM_VERIFY_GROUPS];
    int n_cases[GM_VERIFY_GROUPS];
    gm_verify_case *cases[GM_VERIFY_GROUPS];
} gm_verify_result;

/** Compare at `points` random points per group. Free with gm_verify_result_clear. */
GM_NODISCARD gm_status gm_verify_steady(const gm_plant *plant, const gm_reduced_probe *probe,
                                        int points, uint64_t seed, gm_verify_result *result,
                                        gm_error *error);
void gm_verify_result_clear(gm_verify_result *result);

#ifdef __cplusplus
}
#endif
#endif
