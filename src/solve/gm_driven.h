/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A plant in motion with its flanges driven from outside, as a system for the transient
 * solver. At each flange either the torque is given over time or the speed.
 *
 * A given speed is exact: the torque at its flange is the one that gives the flange the
 * acceleration of the speed over time. With B the columns d rates / d torque of these
 * flanges (rates are linear in the torques) and s the rows of their speeds,
 *
 *   dx/dt = rates(x, 0) + B u,     B_s u = dw/dt - rates_s(x, 0)
 *
 * and u is what a torque meter there would show. A speed that jumps does so by an
 * impulse, whose work is in the account.
 */
#ifndef GM_DRIVEN_H
#define GM_DRIVEN_H

#include "plant/gm_dynamics.h"
#include "solve/gm_transient.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What the outside does at one instant. */
typedef struct gm_drive_point {
    gm_motion_input input;        /* torques of flanges that are not driven; gears */
    double speed[GM_MAX_FLANGES]; /* rad/s, of driven flanges */
    double acceleration[GM_MAX_FLANGES]; /* rad/s2, its slope */
} gm_drive_point;

/** The outside over time, smooth in pieces. */
typedef struct gm_drive {
    void *user;
    int driven[GM_MAX_FLANGES]; /* 1: the speed of this flange is given */
    /* The piece that begins at t begins. Returns its end [s, > t]; *jump: 1 when a
       torque, a speed or a commanded gear changes suddenly at t. */
    double (*enter)(void *user, double t, int *jump);
    /* Within the present piece, its ends included. */
    void (*at)(void *user, double t, gm_drive_point *point);
} gm_drive;

typedef struct gm_driven gm_driven;

/** t [s]: a time to start at. start_speed[1 + n_paths]: speeds of the flanges there
 *  [rad/s], of those that are not driven. The dynamics outlive it; the drive is copied,
 *  what it points to is not. GM_ERR_MODEL: the given speeds depend on each other;
 *  GM_ERR_MEMORY; errors of the plant. */
GM_NODISCARD gm_status gm_driven_create(const gm_dynamics *dynamics,
                                        const gm_drive *drive, double t,
                                        const double *start_speed, gm_driven **driven,
                                        gm_error *error);
void gm_driven_destroy(gm_driven *driven);

/** The system for gm_transient_create; valid while driven lives. */
gm_transient_system gm_driven_system(gm_driven *driven);

/** The plant's motion, for reading its signals. */
void *gm_driven_motion(gm_driven *driven);

/** All that acts on the plant at (t, x), the torques of driven flanges found. t lies in
 *  the present piece. Non-zero: x cannot be evaluated. */
int gm_driven_input(gm_driven *driven, double t, const double *x, gm_motion_input *input);

#ifdef __cplusplus
}
#endif
#endif
