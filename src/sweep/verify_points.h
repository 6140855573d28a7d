/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Random operating points of the cases of a verification, and what is compared there.
 */
#ifndef VERIFY_POINTS_H
#define VERIFY_POINTS_H

#include "solve/gm_steady_solver.h"
#include "sweep/gm_verify.h"

/** A case with what drawing its points needs. */
typedef struct gm_verify_draw {
    gm_verify_group group;
    int path; /* loaded or turning free; -1: both are loaded */
    int gear[GM_MAX_INPUT_PATHS];
    int direction;                          /* of the output */
    double ratio[GM_MAX_INPUT_PATHS];       /* of engaged paths */
    double output_max;                      /* largest |w_o|, rad/s */
    const double *line[GM_MAX_INPUT_PATHS]; /* ratios of the path's drag lines */
    int n_lines[GM_MAX_INPUT_PATHS];
} gm_verify_draw;

/** SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators, 2014):
 *  next number of the sequence. */
uint64_t gm_random_next(uint64_t *state);
/** Evenly distributed in [low, high). */
double gm_random_between(uint64_t *state, double low, double high);

/** The two values compared at one point and where it was. */
typedef struct gm_verify_sample {
    double detailed, reduced; /* N.m */
    double speed, torque;     /* of the path */
    double output_speed;
    double oil; /* K */
    int failed; /* 1: a simulated model failed here, and the status says how */
} gm_verify_sample;

GM_NODISCARD gm_status gm_verify_compare(const gm_verify_draw *draw,
                                         gm_steady_solver *solver, const gm_plant *plant,
                                         const gm_reduced_probe *probe, uint64_t *random,
                                         gm_verify_sample *sample, gm_error *error);

#endif
