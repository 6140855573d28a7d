/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Torsion of a shaft: what sits on it are stations, between them are pieces that twist.
 */
#ifndef TORSION_H
#define TORSION_H

#include "model/gm_description.h"

#define GM_STEEL_SHEAR_MODULUS 79.2e9 /* Pa: E 206 GPa, Poisson's ratio 0.3 */

/** Places along a shaft that turn as one each. */
typedef struct gm_stations {
    int n;             /* >= 1; 1: nothing twists */
    double *x;         /* [n] ascending, m */
    double *share;     /* [n] of the shaft's own inertia; their sum is 1 */
    double *stiffness; /* [n - 1] between stations, N.m/rad */
} gm_stations;

/** Torsional stiffness of a shaft from x_0 to x_1 > x_0 [N.m/rad]: 1/k = sum L / (G J_p)
 *  over its cylinders; infinite where it has none between. */
double gm_shaft_stiffness(const gm_shaft *shaft, double x_0, double x_1);

/** Stations of shaft s: where gears sit and where its flange is; those closer than 1 mm
 *  are one. A rigid shaft has one. GM_ERR_MEMORY; clear what was made. */
GM_NODISCARD gm_status gm_stations_make(const gm_description *description, int s,
                                        gm_stations *stations, gm_error *error);
void gm_stations_clear(gm_stations *stations);

/** The station nearest to x; the first where x is NAN. */
int gm_station_at(const gm_stations *stations, double x);

/** Where a shaft's flange is: as given, else the end with the lower x. */
double gm_flange_position(const gm_shaft *shaft);

#endif
