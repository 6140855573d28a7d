/* SPDX-License-Identifier: BSD-2-Clause */
#include "vehicle/driver.h"

#include <math.h>

#define MOVES 0.3         /* m/s of the cycle from which on the driver is fully at work */
#define HOLD 1500.0       /* N, brake while the cycle stands */
#define HOLD_SPEED 0.1    /* m/s, over which the brake's force changes its direction */
#define RELEASE_TIME 1.0  /* s, in which the integral part is forgotten at a stop */
#define BRAKE_ROUNDING 20 /* N, over which the brake sets in */

/* 0 at rest, 1 from MOVES on. */
static double at_work(double v_ref)
{
    double s = fmin(1.0, fmax(0.0, v_ref / MOVES));
    return s * s * (3.0 - 2.0 * s);
}

/* max(0, x), rounded off: (x + sqrt(x2 + r2)) / 2. */
static double ramp(double x, double *slope)
{
    double root = sqrt(x * x + (double)BRAKE_ROUNDING * BRAKE_ROUNDING);
    *slope = 0.5 * (1.0 + x / root);
    return 0.5 * (x + root);
}

/* Share of the speed error that may still wind the integral up; *slope: d share / d
 * integral. */
static double windup(const gm_vehicle *c, double integral, double error, double *slope)
{
    double by = c->driver_integral / c->driver_windup, part = by * integral;
    double cubed = part * part * part;
    *slope = 0.0;
    if (part * error <= 0.0)
        return 1.0;
    if (fabs(part) >= 1.0)
        return 0.0;
    *slope = -4.0 * by * cubed;
    return 1.0 - part * cubed;
}

static void brakes(const gm_vehicle *c, const gm_driver_view *s, double force,
                   double force_v, double force_i, double work, gm_driver_act *a)
{
    double drag_slope, on;
    double drag = gm_engine_drag(c, s->w_engine, &drag_slope);
    double to_wheels = s->ratio / c->wheel_radius;
    double wanted = ramp(drag * to_wheels - force, &on);
    double direction = tanh(s->v / HOLD_SPEED);
    double turn = (1.0 - direction * direction) / HOLD_SPEED;
    double size = work * wanted + (1.0 - work) * HOLD;
    a->brake = size * direction - (1.0 - work) * s->hill;
    a->brake_v = size * turn - work * on * force_v * direction;
    a->brake_i = -work * on * force_i * direction;
    a->brake_w = work * on * drag_slope * to_wheels * direction;
}

gm_driver_act gm_driver(const gm_vehicle *vehicle, const gm_driver_view *view)
{
    const gm_vehicle *c = vehicle;
    gm_driver_act a;
    double road_slope, work = at_work(view->v_ref), error = view->v_ref - view->v;
    double force = c->driver_gain * error + c->driver_integral * view->integral +
                   c->driver_mass_factor * c->mass * view->a_ref +
                   gm_road_load(c, view->v_ref, &road_slope) + view->hill;
    double to_engine = work * c->wheel_radius / view->ratio;
    a.torque = force * to_engine;
    a.torque_v = -c->driver_gain * to_engine;
    a.torque_i = c->driver_integral * to_engine;
    brakes(c, view, force, -c->driver_gain, c->driver_integral, work, &a);
    double closing, open = windup(c, view->integral, error, &closing);
    a.integral_rate = work * open * error - (1.0 - work) * view->integral / RELEASE_TIME;
    a.rate_v = -work * open;
    a.rate_i = work * closing * error - (1.0 - work) / RELEASE_TIME;
    return a;
}
