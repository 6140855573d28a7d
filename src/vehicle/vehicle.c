/* SPDX-License-Identifier: BSD-2-Clause */
#include "vehicle/gm_vehicle.h"

#include <math.h>
#include <stddef.h>

#define RPM (3.14159265358979323846 / 30.0)
#define CLOSING_SLIP 1.0 /* rad/s: within this it closes for good */
#define EASING_SLIP 30.0 /* rad/s: nearer than this a clutch eases off */
#define LEAST_GRIP 5.0 /* N.m, of a clutch that slips, beside an engine without torque */
#define REST_SPEED 0.1 /* m/s, over which rolling resistance changes its direction */
#define SLIP_SPEED 1.0 /* m/s, below which slip is reckoned as if at that speed */
#define REST_OMEGA 5.0 /* rad/s, the same for the engine's drag: it never runs there */

gm_vehicle gm_vehicle_reference(void)
{
    return (gm_vehicle){
        .mass = 1416.0,
        .wheel_radius = 0.316,
        .wheel_inertia = 3.26,
        .rolling_coefficient = 0.009,
        .drag_area = 0.6078,
        .air_density = 1.2,
        .shaft_stiffness = 6000.0,
        .shaft_damping = 40.0,
        .engine_inertia = 0.13,
        .flywheel_stiffness = 800.0,
        .flywheel_damping = 4.0,
        .drum_inertia = 0.05,
        .clutch_slip = 0.5,
        .launch_speed = 82.0,
        .launch_gain = 0.04,
        .clutch_torque_max = 300.0,
        .clutch_margin = 30.0,
        .full_load = {2, {{750.0 * RPM, 100.0, 0}, {1500.0 * RPM, 200.0, 0}}},
        .drag_torque = 12.0,
        .drag_per_speed = 0.02,
        .torque_lag = 0.08,
        .idle_speed = 80.0,
        .idle_gain = 2.5,
        .driver_gain = 1500.0,
        .driver_integral = 300.0,
        .driver_windup = 2500.0,
        .driver_mass_factor = 1.06,
        .shift_time = 0.4,
        .preselect_time = 1.5,
        .interrupt_time = 0.3,
        .gravity = 9.81,
    };
}

/* ---- check ---- */

typedef struct rule {
    const char *name;
    size_t offset;
    int may_be_zero;
} rule;

#define POSITIVE(member)                                                                 \
    {                                                                                    \
#member, offsetof(gm_vehicle, member), 0                                         \
    }
#define NOT_NEGATIVE(member)                                                             \
    {                                                                                    \
#member, offsetof(gm_vehicle, member), 1                                         \
    }

static const rule rules[] = {
    POSITIVE(mass),
    POSITIVE(wheel_radius),
    NOT_NEGATIVE(wheel_inertia),
    NOT_NEGATIVE(tyre_stiffness),
    NOT_NEGATIVE(tyre_force_max),
    NOT_NEGATIVE(mount_inertia),
    NOT_NEGATIVE(mount_stiffness),
    NOT_NEGATIVE(mount_damping),
    NOT_NEGATIVE(rolling_coefficient),
    NOT_NEGATIVE(drag_area),
    NOT_NEGATIVE(air_density),
    POSITIVE(shaft_stiffness),
    NOT_NEGATIVE(shaft_damping),
    POSITIVE(engine_inertia),
    POSITIVE(flywheel_stiffness),
    NOT_NEGATIVE(flywheel_damping),
    POSITIVE(drum_inertia),
    POSITIVE(clutch_slip),
    POSITIVE(launch_speed),
    POSITIVE(launch_gain),
    POSITIVE(clutch_torque_max),
    POSITIVE(clutch_margin),
    NOT_NEGATIVE(drag_torque),
    NOT_NEGATIVE(drag_per_speed),
    POSITIVE(torque_lag),
    POSITIVE(idle_speed),
    POSITIVE(idle_gain),
    POSITIVE(driver_gain),
    NOT_NEGATIVE(driver_integral),
    NOT_NEGATIVE(driver_windup),
    NOT_NEGATIVE(driver_mass_factor),
    POSITIVE(shift_time),
    POSITIVE(preselect_time),
    POSITIVE(interrupt_time),
    POSITIVE(gravity),
};

static gm_status check_full_load(const gm_full_load *curve, gm_error *error)
{
    if (curve->n < 1 || curve->n > GM_VEHICLE_MAX_POINTS)
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "the full-load curve has 1 to %d points; found %d",
                       GM_VEHICLE_MAX_POINTS, curve->n);
    for (int i = 0; i < curve->n; i++)
        if (!isfinite(curve->point[i].speed) || !(curve->point[i].torque > 0.0) ||
            !isfinite(curve->point[i].torque) ||
            (i > 0 && !(curve->point[i].speed > curve->point[i - 1].speed)))
            return gm_fail(error, GM_ERR_ARGUMENT,
                           "the full-load curve has increasing speeds and positive "
                           "torques; found %g rad/s, %g N.m",
                           curve->point[i].speed, curve->point[i].torque);
    return GM_OK;
}

gm_status gm_vehicle_check(const gm_vehicle *vehicle, gm_error *error)
{
    for (size_t i = 0; i < sizeof rules / sizeof rules[0]; i++) {
        double x = *(const double *)((const char *)vehicle + rules[i].offset);
        if (!isfinite(x) || x < 0.0 || (x == 0.0 && !rules[i].may_be_zero))
            return gm_fail(error, GM_ERR_ARGUMENT, "%s of the vehicle is %g, must be %s",
                           rules[i].name, x,
                           rules[i].may_be_zero ? "0 or more" : "more than 0");
    }
    if (!isfinite(vehicle->grade) || fabs(vehicle->grade) > 1.0)
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "grade of the vehicle is %g, must be -1 to 1", vehicle->grade);
    if (vehicle->tyre_stiffness > 0.0 &&
        !(vehicle->tyre_force_max > 0.0 && vehicle->wheel_inertia > 0.0))
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "tyres that slip need tyre_force_max and wheel_inertia above 0");
    return check_full_load(&vehicle->full_load, error);
}

/* ---- laws ---- */

double gm_full_load_torque(const gm_full_load *curve, double w, double *slope)
{
    *slope = 0.0;
    if (w <= curve->point[0].speed)
        return curve->point[0].torque;
    for (int i = 1; i < curve->n; i++)
        if (w < curve->point[i].speed) {
            *slope = (curve->point[i].torque - curve->point[i - 1].torque) /
                     (curve->point[i].speed - curve->point[i - 1].speed);
            return curve->point[i - 1].torque + *slope * (w - curve->point[i - 1].speed);
        }
    return curve->point[curve->n - 1].torque;
}

double gm_engine_drag(const gm_vehicle *v, double w, double *slope)
{
    double s = tanh(w / REST_OMEGA);
    *slope = -v->drag_torque * (1.0 - s * s) / REST_OMEGA - v->drag_per_speed;
    return -v->drag_torque * s - v->drag_per_speed * w;
}

double gm_engine_target(const gm_vehicle *v, double demand, double w, double *d_demand,
                        double *d_w)
{
    double full_slope, drag_slope;
    double full = gm_full_load_torque(&v->full_load, w, &full_slope);
    double drag = gm_engine_drag(v, w, &drag_slope);
    double idle = v->idle_gain * (v->idle_speed - w);
    double target = demand;
    *d_demand = 1.0;
    *d_w = 0.0;
    if (target < drag)
        target = drag, *d_demand = 0.0, *d_w = drag_slope;
    if (target < idle)
        target = idle, *d_demand = 0.0, *d_w = -v->idle_gain;
    if (target > full)
        target = full, *d_demand = 0.0, *d_w = full_slope;
    return target;
}

double gm_clutch_capacity(const gm_vehicle *v, double w, double *slope)
{
    double x = w - v->launch_speed;
    *slope = 0.0;
    if (x <= 0.0)
        return 0.0;
    double capacity = v->launch_gain * x * x;
    if (capacity >= v->clutch_torque_max)
        return v->clutch_torque_max;
    *slope = 2.0 * v->launch_gain * x;
    return capacity;
}

/* C S / sqrt(C2 + S2): the smaller of the two, rounded off. */
static double smaller(double c, double s, double *by_c, double *by_s)
{
    double root = hypot(c, s);
    *by_c = s * s * s / (root * root * root);
    *by_s = c * c * c / (root * root * root);
    return c * s / root;
}

gm_clutch_grip gm_clutch_grip_at(const gm_vehicle *v, double w, double torque,
                                 double slip)
{
    double slope, by_c, by_s, capacity = gm_clutch_capacity(v, w, &slope);
    double y = slip / CLOSING_SLIP, closed = 1.0 / (1.0 + y * y);
    double z = slip / EASING_SLIP, eased = z * z / (1.0 + z * z);
    double eased_by = 2.0 * z / EASING_SLIP / ((1.0 + z * z) * (1.0 + z * z));
    double root = hypot(torque, LEAST_GRIP);
    double held = smaller(capacity, root + v->clutch_margin * eased, &by_c, &by_s);
    double open = 1.0 - closed, closed_by = -2.0 * y / CLOSING_SLIP * closed * closed;
    return (gm_clutch_grip){.value = held + (capacity - held) * closed,
                            .by_w = slope * (by_c + (1.0 - by_c) * closed),
                            .by_torque = by_s * torque / root * open,
                            .by_slip = (capacity - held) * closed_by +
                                       by_s * v->clutch_margin * eased_by * open};
}

double gm_road_load(const gm_vehicle *vehicle, double v, double *slope)
{
    double s = tanh(v / REST_SPEED);
    double rolling = vehicle->rolling_coefficient * vehicle->mass * vehicle->gravity;
    double drag = 0.5 * vehicle->air_density * vehicle->drag_area;
    *slope = rolling * (1.0 - s * s) / REST_SPEED + 2.0 * drag * fabs(v);
    return rolling * s + drag * v * fabs(v);
}

double gm_rise(double grade)
{
    return grade / sqrt(1.0 + grade * grade);
}

double gm_tyre_force(const gm_vehicle *vehicle, double speed_wheel, double v,
                     double *by_wheel, double *by_v)
{
    double root = sqrt(v * v + SLIP_SPEED * SLIP_SPEED);
    double slip = (speed_wheel - v) / root;
    double s = tanh(vehicle->tyre_stiffness * slip / vehicle->tyre_force_max);
    double by_slip = vehicle->tyre_stiffness * (1.0 - s * s);
    *by_wheel = by_slip / root;
    *by_v = -by_slip * (1.0 + slip * v / root) / root;
    return vehicle->tyre_force_max * s;
}
