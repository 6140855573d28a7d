/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What the tests of the motion share: gearsets in motion from description files, and the
 * classical Runge-Kutta method with small steps, which needs nothing of the library.
 */
#ifndef MOTION_FIXTURE_H
#define MOTION_FIXTURE_H

#include "model/gm_motion.h"

#define MOTION_EXAMPLES GM_SOURCE_DIR "/examples/"

typedef struct moving {
    gm_description *d;
    gm_gearset *gearset;
    gm_motion *motion;
    int n;
    double *x;
    gm_motion_input input;
    double t, work, lost; /* of the flanges and of all friction since the start [J] */
} moving;

/** Read, assemble, make the motion; fails the test with the library's sentence. */
void moving_read(moving *m, const char *path);
/** The same with shafts that twist. */
void moving_read_twisting(moving *m, const char *path);
/** The same with elastic friction in all bearings. */
void moving_read_holding(moving *m, const char *path);
/** Over a description in memory, which stays the caller's. */
void moving_make(moving *m, gm_description *d);
void moving_clear(moving *m);

/** Begin; fails the test on an error. */
void moving_start(moving *m, const double *speed);

/** Runge-Kutta steps of length h up to t + duration, with the modes handled after each
 *  step; adds up work and losses by the same method. */
void moving_run(moving *m, double duration, double h);

gm_motion_view moving_view(moving *m);

/** Value of a recorded signal. */
double moving_signal(moving *m, const char *name);

#endif
