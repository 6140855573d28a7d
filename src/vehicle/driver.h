/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The driver: a proportional and integral controller on the speed error with feed-forward
 * of the trace's acceleration, the road load and the hill. What it wants at the wheels
 * becomes engine torque and, where the engine's drag does not reach, brake force. While
 * the cycle stands still the pedal is released and the brake holds the car: its force
 * carries what the hill pulls, and against motion comes what stops the car.
 *
 * Everything is continuous, so that what a comparison sees is the gearset's doing.
 */
#ifndef DRIVER_H
#define DRIVER_H

#include "vehicle/gm_vehicle.h"

/** What the driver sees at one instant. */
typedef struct gm_driver_view {
    double v_ref, a_ref; /* of the cycle, m/s, m/s2 */
    double v;            /* of the car, m/s */
    double integral;     /* m */
    double w_engine;     /* rad/s */
    double ratio;        /* w_engine / w_wheel that the driver reckons with */
    double hill;         /* force of the hill against the way, N */
} gm_driver_view;

/** What the driver does, with derivatives. */
typedef struct gm_driver_act {
    double torque, torque_v, torque_i;       /* demand at the engine, N.m */
    double brake, brake_v, brake_i, brake_w; /* force at the wheels, N, signed */
    double integral_rate, rate_v, rate_i;    /* d integral / dt, m/s */
} gm_driver_act;

gm_driver_act gm_driver(const gm_vehicle *vehicle, const gm_driver_view *view);

#endif
