/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The vehicle with a gearset on a cycle, as a system for the transient solver. States:
 * the car (gm_vehicle.h), its accounts of work and losses, then those of the gearset.
 */
#ifndef TRIP_H
#define TRIP_H

#include "plant/gm_dynamics.h"
#include "solve/gm_transient.h"
#include "vehicle/gear_plan.h"

typedef struct gm_trip gm_trip;

/** All parts outlive the trip; it changes none of them. */
typedef struct gm_trip_parts {
    const gm_vehicle *vehicle;
    const gm_cycle *cycle;
    const gm_gear_plan *plan;
    const gm_dynamics *gearset;
    double forward; /* 1 or -1: how the gearset's output turns when the car drives on */
} gm_trip_parts;

/** What is seen of a trip at one instant. */
typedef struct gm_trip_view {
    double cycle_speed, speed, distance;     /* m/s, m/s, m */
    double height;                           /* m, since the start */
    double engine_speed, engine_torque;      /* rad/s, N.m */
    double demand;                           /* of the driver at the engine, N.m */
    double input_torque[GM_MAX_INPUT_PATHS]; /* into each path of the gearset, N.m */
    double input_speed[GM_MAX_INPUT_PATHS];  /* rad/s */
    double output_torque;          /* out of the gearset, driving positive, N.m */
    double output_speed;           /* driving forward positive, rad/s */
    double brake;                  /* N */
    int gear[GM_MAX_INPUT_PATHS];  /* commanded */
    int state[GM_MAX_INPUT_PATHS]; /* gm_path_mode of core/gm_reduced.h */
    /* J, since the start */
    double engine_work, clutch_loss, damper_loss, road_loss, brake_loss;
    double gearset_work;   /* done on the gearset at its flanges */
    double gearset_stored; /* kinetic and elastic energy in it */
} gm_trip_view;

/** GM_ERR_MEMORY; errors of the plant. */
GM_NODISCARD gm_status gm_trip_create(const gm_trip_parts *parts, gm_trip **trip,
                                      gm_error *error);
void gm_trip_destroy(gm_trip *trip);

/** The system for gm_transient_create; valid while the trip lives. */
gm_transient_system gm_trip_system(gm_trip *trip);

/** t lies in the present piece of the solver. */
void gm_trip_look(gm_trip *trip, double t, const double *x, gm_trip_view *view);

/** Time spent in the rates of the gearset since it was made [s], from a sample of the
 *  evaluations. */
double gm_trip_gearset_time(const gm_trip *trip);

#endif
