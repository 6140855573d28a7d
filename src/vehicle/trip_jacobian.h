/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Jacobian of the vehicle with its gearset. Torques at the flanges follow the car's
 * states and the flanges' speeds, so with B the columns d rates / d torque
 *
 *   [ car by car's states     car by flange speeds            ]
 *   [ B torque by car         J + B torque by flange speeds   ]
 *
 * J is the gearset's own Jacobian, or differences where it has none.
 */
#ifndef TRIP_JACOBIAN_H
#define TRIP_JACOBIAN_H

#include "vehicle/car.h"

struct gm_trip {
    gm_trip_parts parts;
    const gm_dynamics_class *is;
    void *motion;
    int n_gearset, n;
    int speed_state[GM_MAX_FLANGES]; /* among all states */
    gm_motion_input input;
    gm_car_time instant; /* of the last evaluation: several have the same time */
    double gearset_time, clock_cost; /* s */
    unsigned evaluations;
    /* pattern, and where an entry of the full matrix stands in it */
    int *column_start, *row, *place;
    int *own_start, *own_row; /* of the gearset's own Jacobian */
    double *own_value;
    double *column;                       /* [n_gearset] */
    double *typical, *moved, *now, *then; /* [n_gearset], for differences */
};

/** Make the pattern; the gearset's motion exists. Non-zero: no memory. */
int gm_trip_pattern(gm_trip *trip);
void gm_trip_pattern_free(gm_trip *trip);

/** Values at the instant that point and trip->input describe. */
int gm_trip_jacobian(gm_trip *trip, const gm_car_point *point, const double *x,
                     double *value);

#endif
