/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A steady point of the sweep on the test rig. Where the sweep asks for a one-sided limit
 * (a flange at rest that starts to move, a neutral path just beside one of its drag
 * lines), points at once, twice and three times the creep speed c away are measured and
 * extrapolated: f(0+) = 3 f(c) - 3 f(2c) + f(3c). The creep speed lies beyond the
 * band over which models round Coulomb friction.
 *
 * By ramps, the torque of the flange that the point is about (a path that turns in
 * neutral, else the output) is that in passing; the others are held. At a creeping speed
 * all are held: a ramp would cross the band.
 */
#ifndef RIG_POINT_H
#define RIG_POINT_H

#include "sweep/rig_run.h"

#define GM_RIG_MAX_LINES 32

typedef struct gm_rig_limits {
    double creep;     /* rad/s */
    int ramps;        /* 1: losses by ramps through each speed, 0: held until steady */
    double ramp_time; /* s, of one ramp; 0: automatic */
    int n_lines[GM_MAX_INPUT_PATHS]; /* drag lines of paths in neutral */
    double line[GM_MAX_INPUT_PATHS][GM_RIG_MAX_LINES];
} gm_rig_limits;

/** target: point and ratios as gm_rig_run_hold takes them. Errors of gm_rig_run_hold. */
GM_NODISCARD gm_status gm_rig_point_measure(gm_rig_run *run, const gm_rig_limits *limits,
                                            const gm_rig_target *target,
                                            gm_rig_found *found, gm_error *error);

#endif
