/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Small maps made by hand, whose laws are simple enough to know the truth:
 *
 *   P  = p0[dir] + p1 |w_o| + what the idlers of the free paths take from the output
 *   D  = (d0[dir] + d1 |w_p|) |y|, for y < 0 times overrun
 *   X  = x |y_0 y_1| / torque_max
 *   N  = sgn(w_n) n0[dir] + n1 w_n + k (w_n - r_k w_o)     R = -r_k k w_n
 *   lines: jump = j0 + j1 |w_o| for every gear of the path
 *   pin = pin_part / |r| (p0 + p1 |w_p / r|): a share of P brakes the input side
 *   C  = c0 sat((w_0 - w_1)/c_width) + c1 (w_0 - w_1)
 *
 * All are piecewise linear with kinks at nodes (but for w |y| terms, which are bilinear),
 * so the tables hold them exactly. They are passive by construction.
 */
#ifndef HAND_MAP_H
#define HAND_MAP_H

#include "core/gm_reduced.h"

enum { HAND_GEARS = 3, HAND_W = 6, HAND_T = 9, HAND_C = 6, HAND_X = 3 };
enum { HAND_CONFIGURATIONS = (HAND_GEARS + 1) * (HAND_GEARS + 1) };

typedef struct hand_spec {
    int n_paths, n_gears[2], number[2][HAND_GEARS];
    double ratio[2][HAND_GEARS];
    double inertia[2], inertia_output, sync_torque[2];
    double inertia_extra[2][HAND_GEARS];
    double p0[2], p1;
    double d0[2], d1, overrun;
    double x;
    double n0[2], n1, k, r_k;
    double j0, j1;
    double c0, c1, c_width;
    double stiffness[2], damping[2], loose_damping[2], lash[2], film, pin_part;
    double speed_max,
        torque_max;     /* of the output, of a path; path speeds go 20 x higher */
    unsigned roughness; /* seed: node values of P and D vary by up to 50 %; 0: no */
    int monotone;       /* interpolation of all tables but X */
} hand_spec;

typedef struct hand_map {
    gm_reduced_map map;
    gm_gear gear[2][HAND_GEARS];
    gm_drag_line line[2][HAND_GEARS];
    gm_configuration configuration[HAND_CONFIGURATIONS];
    double w_o[HAND_W], w_p[HAND_W], torque[HAND_T], relative[HAND_C];
    double x_w[HAND_X], x_t[HAND_X];
    double p[HAND_CONFIGURATIONS][2][HAND_W];
    double d[2][HAND_GEARS][2][HAND_W][HAND_T];
    double n[2][2][2][HAND_W][HAND_W], r[2][2][2][HAND_W][HAND_W];
    double pin[2][HAND_GEARS][2][HAND_W];
    double jump[HAND_W], c[HAND_C], both[HAND_X][HAND_X][HAND_X];
} hand_map;

/** Two paths (1, 3, reverse; 2, 4), every kind of loss. */
hand_spec hand_default(void);

/** No losses at all, otherwise the default. */
hand_spec hand_lossless(void);

/** Everything mirrored: forward and backward exchanged. */
hand_spec hand_mirrored(const hand_spec *spec);

/** Fill *m; pointers of m->map point into *m, which must stay where it is. */
void hand_build(const hand_spec *spec, hand_map *m);

/** State started in the gears with given speed of the output; paths at rest if neutral.
 */
gm_reduced_state hand_start(const hand_map *m, int gear_0, int gear_1, double w_o);

/** Inputs without torque; gears as given. */
gm_reduced_inputs hand_inputs(int gear_0, int gear_1);

/** Kinetic energy straight from the speeds and inertias. */
double hand_kinetic(const hand_map *m, const gm_reduced_state *s);

/** The same and what the twisted paths hold. */
double hand_energy(const hand_map *m, const gm_reduced_params *params,
                   const gm_reduced_state *s);

/** Small deterministic generator: uniform in [0, 1). */
double hand_random(unsigned *seed);

/** Uniform in [low, high). */
double hand_between(unsigned *seed, double low, double high);

/** A random valid passive map. */
hand_spec hand_random_spec(unsigned *seed);

#endif
