/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Verification: the reduced component, as the file that ships, against the detailed
 * gearset at random points off the grid.
 */
#ifndef GM_VERIFY_H
#define GM_VERIFY_H

#include "map/gm_map.h"
#include "plant/gm_plant.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What the reduced component answers at a steady point: speeds as in the point, torques
 *  at the engaged flanges as in the point, zero at neutral ones, and the detailed
 *  gearset's torque at the output. */
typedef struct gm_reduced_answer {
    double loss_power; /* W */
    double
        path_drag[GM_MAX_INPUT_PATHS]; /* loss torque of a path in neutral, N + C, N.m */
    double output_reaction; /* loss torque at the output, sigma (P + X) + R, N.m */
} gm_reduced_answer;

/** The reduced component as verification sees it: the shipped file behind a function. */
typedef struct gm_reduced_probe {
    /* oil: temperature, K */
    gm_status (*at)(void *self, double oil, const gm_steady_point *point,
                    double output_torque, gm_reduced_answer *answer, gm_error *error);
    void *self;
} gm_reduced_probe;

/** One compared point. */
typedef struct gm_verify_point {
    double speed, torque;     /* of the path, rad/s, N.m */
    double detailed, reduced; /* N.m */
    double oil;               /* K */
} gm_verify_point;

/** Errors of one kind of point. Loss torques at the flange of the loaded path (of the
 *  faster path when both are loaded), drag at the path's flange, reaction at the output.
 */
typedef struct gm_verify_case {
    const char *path; /* name of the path that is loaded or turns free, or "both" */
    int gear[GM_MAX_INPUT_PATHS];
    int direction; /* +1 or -1: rotation of the output */
    int points;
    double largest_loss;               /* detailed, over the case's points, N.m */
    double max, rms;                   /* N.m */
    double max_relative, rms_relative; /* of largest_loss */
    double worst_speed,
        worst_torque;          /* of the path, where the error is max: rad/s, N.m */
    double worst_output_speed; /* rad/s */
    double worst_oil;          /* K */
    gm_verify_point *point;    /* [points], owned by the result */
} gm_verify_case;

typedef enum gm_verify_group {
    GM_VERIFY_SINGLE,      /* one path engaged, the other at rest in neutral */
    GM_VERIFY_PRESELECTED, /* both engaged, one loaded */
    GM_VERIFY_BOTH_LOADED,
    GM_VERIFY_DRAG,     /* torque of free shafts turning in neutral */
    GM_VERIFY_REACTION, /* their reaction on the output */
    GM_VERIFY_GROUPS
} gm_verify_group;

const char *gm_verify_group_name(gm_verify_group group);

typedef struct gm_verify_result {
    int points;
    uint64_t seed;
    double max_relative[GM_VERIFY_GROUPS], rms_relative[GM_VERIFY_GROUPS];
    int n_cases[GM_VERIFY_GROUPS];
    gm_verify_case *cases[GM_VERIFY_GROUPS];
    int n_skipped;     /* points that are left out: a simulated model failed there */
    char skipped[320]; /* the first of them, and why */
} gm_verify_result;

/** Compare at `points` >= 1 random points per group: cases, speeds from 1 rpm to the
 *  plant's largest and torques up to the plant's largest are drawn evenly. Drags and
 *  reactions leave out the documented ramps around the lines (GM_LINE_WIDTH). Groups that
 *  need two paths are empty with one. The numbers relative to the whole group weigh every
 *  point by its own case's largest loss. Free with gm_verify_result_clear.
 *  GM_ERR_ARGUMENT, GM_ERR_MEMORY, GM_ERR_SOLVE or what the probe answers. */
GM_NODISCARD gm_status gm_verify_steady(const gm_plant *plant,
                                        const gm_reduced_probe *probe, int points,
                                        uint64_t seed, gm_verify_result *result,
                                        gm_error *error);
/** The same with the gearset at n >= 1 oil temperatures, plants[n]: each point is at one
 *  of them, drawn evenly. */
GM_NODISCARD gm_status gm_verify_plants(int n, const gm_plant *const *plants,
                                        const gm_reduced_probe *probe, int points,
                                        uint64_t seed, gm_verify_result *result,
                                        gm_error *error);

/** Errors of a group at oil temperatures from low up to but not high [K], relative to the
 *  largest loss of each case at these; *points: how many. */
void gm_verify_between(const gm_verify_result *result, gm_verify_group group, double low,
                       double high, int *points, double *max_relative,
                       double *rms_relative);

/** The same as gm_verify_plants for a map, by the reduced gearset in this program.
 *  monotone: how the tables are read. As above, and GM_ERR_FORMAT when the map is not
 *  complete. */
GM_NODISCARD gm_status gm_verify_map(int n, const gm_plant *const *plants,
                                     const gm_map *map, int monotone, int points,
                                     uint64_t seed, gm_verify_result *result,
                                     gm_error *error);

/** What the reduced gearset of a map answers at an oil temperature [K] and point. */
void gm_verify_view(const gm_map_view *view, double oil, const gm_steady_point *point,
                    double output_torque, gm_reduced_answer *answer);

void gm_verify_result_clear(gm_verify_result *result);

#ifdef __cplusplus
}
#endif
#endif
