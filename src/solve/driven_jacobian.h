/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Jacobian of a driven plant. With J = d rates / d x of the plant, B the columns of the
 * driven torques and s the rows of the driven speeds,
 *
 *   d/dx (rates(x, 0) + B u) = J - B B_s^-1 J_s,     its rows s being zero
 *
 * (B is taken as constant, which it is as long as inertias are.) A torque that reaches
 * its own flange only costs nothing but these rows. A plant without Jacobian gets
 * differences over a full matrix.
 */
#ifndef DRIVEN_JACOBIAN_H
#define DRIVEN_JACOBIAN_H

#include "solve/gm_driven.h"

struct gm_driven {
    const gm_dynamics_class *is;
    void *motion;
    gm_drive drive;
    int n, n_flanges;
    double start_speed[GM_MAX_FLANGES];
    int n_driven;
    int driven[GM_MAX_FLANGES], speed_state[GM_MAX_FLANGES]; /* [n_driven] */
    /* at the last point that was looked at */
    gm_motion_input input;
    double *column[GM_MAX_FLANGES]; /* B, [n_driven][n] */
    double lu[GM_MAX_FLANGES * GM_MAX_FLANGES];
    int pivot[GM_MAX_FLANGES];
    double *dx;
    double t_known, *x_known; /* where input was found; NAN: nowhere */
    /* pattern of the Jacobian */
    int *column_start, *row;
    int *place;                           /* of the plant's entries in it */
    double *plant_value;                  /* [plant's entries] */
    double *typical, *x_moved, *dx_moved; /* [n], for differences */
};

/** Rates of a driven plant. */
typedef int gm_driven_rates(gm_driven *driven, double t, const double *x, double *dx);

/** Make the pattern; the columns B must be known. Non-zero: no memory. */
int gm_driven_pattern(gm_driven *driven);
void gm_driven_pattern_free(gm_driven *driven);

/** Values by the plant's Jacobian at the last point that was looked at, x. */
int gm_driven_jacobian(gm_driven *driven, const double *x, double *value);

/** Values by differences. */
int gm_driven_differences(gm_driven *driven, gm_driven_rates *rates, double t,
                          const double *x, double *value);

#endif
