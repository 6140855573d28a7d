/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The car's own equations, apart from the gearset: what drives the flanges, and the rates
 * and Jacobian of the car's states. Equations: gm_vehicle.h.
 */
#ifndef CAR_H
#define CAR_H

#include "vehicle/driver.h"
#include "vehicle/trip.h"

/** States of the car; those of the gearset follow. */
enum {
    GM_CAR_ENGINE_SPEED,
    GM_CAR_ENGINE_TORQUE,
    GM_CAR_FLYWHEEL, /* twist */
    GM_CAR_DRUM_SPEED,
    GM_CAR_SHAFTS, /* twist */
    GM_CAR_WHEELS, /* speed; with tyres that do not slip it only follows the car's */
    GM_CAR_SPEED,
    GM_CAR_MOUNT, /* roll angle of engine and gearbox; rigid mounts: at rest */
    GM_CAR_MOUNT_SPEED,
    GM_CAR_INTEGRAL, /* of the driver */
    GM_CAR_DYNAMIC,  /* how many states act back on others */
    /* accounts: integrals that nothing depends on */
    GM_CAR_DISTANCE = GM_CAR_DYNAMIC,
    GM_CAR_HEIGHT,
    GM_CAR_ENGINE_WORK,
    GM_CAR_CLUTCH_LOSS,
    GM_CAR_DAMPER_LOSS,
    GM_CAR_ROAD_LOSS,
    GM_CAR_BRAKE_LOSS,
    GM_CAR_GEARSET_WORK,
    GM_CAR_STATES
};

/** Columns of what the car's rates depend on: its dynamic states, then the flanges'
 *  speeds. */
enum { GM_CAR_COLUMNS = GM_CAR_DYNAMIC + GM_MAX_FLANGES };

/** What follows from the time alone: the cycle and the commands. */
typedef struct gm_car_time {
    double t;            /* s */
    double v_ref, a_ref; /* m/s, m/s2 */
    double rise;         /* rise over way */
    double ratio;        /* w_engine / w_wheel that the driver reckons with */
    double share[GM_MAX_INPUT_PATHS];
} gm_car_time;

void gm_car_time_at(const gm_trip_parts *parts, double t, gm_car_time *now);

/** Everything between the car's states and the flanges at one instant, with derivatives
 *  by GM_CAR_COLUMNS. */
typedef struct gm_car_point {
    gm_driver_act act;
    double target, target_demand, target_w; /* engine torque asked for */
    double clutch[GM_MAX_INPUT_PATHS];      /* N.m */
    double clutch_by[GM_MAX_INPUT_PATHS][GM_CAR_COLUMNS];
    double flywheel; /* N.m */
    double shafts;   /* N.m, driving positive */
    double road, road_slope;
    double rise, hill; /* rise over way; N */
    double hub;        /* speed of the wheels, rad/s */
    double tyre;       /* force on the car, N */
    double tyre_by_wheel, tyre_by_v;
    double speed[GM_MAX_FLANGES]; /* of the gearset; the output's in driving direction */
} gm_car_point;

/** now: the instant; x: states of the car; flange_speed[1 + n_paths] as the gearset has
 *  them [rad/s]. */
void gm_car_at(const gm_trip_parts *parts, const gm_car_time *now, const double *x,
               const double *flange_speed, gm_car_point *point);

/** Torques on the flanges of the gearset, into it. */
void gm_car_torques(const gm_trip_parts *parts, const gm_car_point *point,
                    double torque[GM_MAX_FLANGES]);

/** d torque of a flange / d columns (speeds as the gearset has them). */
void gm_car_torque_by(const gm_trip_parts *parts, const gm_car_point *point, int flange,
                      double by[GM_CAR_COLUMNS]);

void gm_car_rates(const gm_trip_parts *parts, const gm_car_point *point, const double *x,
                  double *dx);

/** Columns that torque_by (of a flange) and rates_by (of a row) may fill: 1 << column. */
unsigned gm_car_torque_columns(int flange);
unsigned gm_car_rate_columns(int row);

/** by[GM_CAR_DYNAMIC][GM_CAR_COLUMNS]. */
void gm_car_rates_by(const gm_trip_parts *parts, const gm_car_point *point,
                     double by[GM_CAR_DYNAMIC][GM_CAR_COLUMNS]);

/** Kinetic, elastic and potential energy of the car [J]. */
double gm_car_stored(const gm_vehicle *vehicle, const double *x);

/** Typical sizes of the states, for tolerances. */
extern const double gm_car_typical[GM_CAR_STATES];

/** Name of a state, for messages. */
const char *gm_car_state_name(int i);

#endif
