/* SPDX-License-Identifier: BSD-2-Clause */
#include "vehicle/car.h"

#include <math.h>
#include <string.h>

const double gm_car_typical[GM_CAR_STATES] = {
    [GM_CAR_ENGINE_SPEED] = 200.0, [GM_CAR_ENGINE_TORQUE] = 100.0,
    [GM_CAR_FLYWHEEL] = 0.1,       [GM_CAR_DRUM_SPEED] = 200.0,
    [GM_CAR_SHAFTS] = 0.1,         [GM_CAR_WHEELS] = 30.0,
    [GM_CAR_SPEED] = 10.0,         [GM_CAR_MOUNT] = 1e-2,
    [GM_CAR_MOUNT_SPEED] = 0.1,    [GM_CAR_INTEGRAL] = 1.0,
    [GM_CAR_DISTANCE] = 1e3,       [GM_CAR_HEIGHT] = 10.0,
    [GM_CAR_ENGINE_WORK] = 1e5,    [GM_CAR_CLUTCH_LOSS] = 1e4,
    [GM_CAR_DAMPER_LOSS] = 1e3,    [GM_CAR_ROAD_LOSS] = 1e5,
    [GM_CAR_BRAKE_LOSS] = 1e5,     [GM_CAR_GEARSET_WORK] = 1e5,
};

const char *gm_car_state_name(int i)
{
    static const char *const names[GM_CAR_STATES] = {
        [GM_CAR_ENGINE_SPEED] = "engine speed",
        [GM_CAR_ENGINE_TORQUE] = "engine torque",
        [GM_CAR_FLYWHEEL] = "twist of the flywheel",
        [GM_CAR_DRUM_SPEED] = "speed of the clutch drum",
        [GM_CAR_SHAFTS] = "twist of the driveshafts",
        [GM_CAR_WHEELS] = "speed of the wheels",
        [GM_CAR_SPEED] = "vehicle speed",
        [GM_CAR_MOUNT] = "roll angle on the mounts",
        [GM_CAR_MOUNT_SPEED] = "roll speed on the mounts",
        [GM_CAR_INTEGRAL] = "integral part of the driver",
        [GM_CAR_DISTANCE] = "distance",
        [GM_CAR_HEIGHT] = "height",
        [GM_CAR_ENGINE_WORK] = "work of the engine",
        [GM_CAR_CLUTCH_LOSS] = "loss of the clutches",
        [GM_CAR_DAMPER_LOSS] = "loss of the dampers",
        [GM_CAR_ROAD_LOSS] = "loss on the road",
        [GM_CAR_BRAKE_LOSS] = "loss of the brakes",
        [GM_CAR_GEARSET_WORK] = "work on the gearset",
    };
    return names[i];
}

/* ---- one instant ---- */

static void clutch_at(const gm_trip_parts *parts, const gm_car_time *now, const double *x,
                      int p, gm_car_point *point)
{
    const gm_vehicle *v = parts->vehicle;
    double slip = x[GM_CAR_DRUM_SPEED] - point->speed[1 + p];
    const gm_clutch_grip grip =
        gm_clutch_grip_at(v, x[GM_CAR_ENGINE_SPEED], x[GM_CAR_ENGINE_TORQUE], slip);
    double s = tanh(slip / v->clutch_slip), share = now->share[p];
    double by_slip =
        share * (grip.value * (1.0 - s * s) / v->clutch_slip + grip.by_slip * s);
    double *by = point->clutch_by[p];
    memset(by, 0, GM_CAR_COLUMNS * sizeof *by);
    point->clutch[p] = share * grip.value * s;
    by[GM_CAR_ENGINE_SPEED] = share * grip.by_w * s;
    by[GM_CAR_ENGINE_TORQUE] = share * grip.by_torque * s;
    by[GM_CAR_DRUM_SPEED] = by_slip;
    by[GM_CAR_DYNAMIC + 1 + p] = -by_slip;
}

void gm_car_time_at(const gm_trip_parts *parts, double t, gm_car_time *now)
{
    now->t = t;
    now->v_ref = gm_cycle_speed(parts->cycle, t, &now->a_ref);
    now->rise = gm_rise(parts->vehicle->grade + gm_cycle_grade(parts->cycle, t));
    now->ratio = gm_gear_plan_ratio(parts->plan, t);
    for (int p = 0; p < parts->gearset->n_paths; p++)
        now->share[p] = gm_gear_plan_share(parts->plan, p, t);
}

static gm_driver_act driver_at(const gm_trip_parts *parts, const gm_car_time *now,
                               const double *x, double hill)
{
    const gm_driver_view see = {.v_ref = now->v_ref,
                                .a_ref = now->a_ref,
                                .v = x[GM_CAR_SPEED],
                                .hill = hill,
                                .integral = x[GM_CAR_INTEGRAL],
                                .w_engine = x[GM_CAR_ENGINE_SPEED],
                                .ratio = now->ratio};
    return gm_driver(parts->vehicle, &see);
}

static int slips(const gm_vehicle *v)
{
    return v->tyre_stiffness > 0.0;
}

/* Speed at which the driveshafts twist. */
static double shafts_slip(const gm_car_point *point, const double *x)
{
    return point->speed[0] + x[GM_CAR_MOUNT_SPEED] - point->hub;
}

void gm_car_at(const gm_trip_parts *parts, const gm_car_time *now, const double *x,
               const double *flange_speed, gm_car_point *point)
{
    const gm_vehicle *v = parts->vehicle;
    int n_paths = parts->gearset->n_paths;
    point->rise = now->rise;
    point->hill = v->mass * v->gravity * point->rise;
    point->act = driver_at(parts, now, x, point->hill);
    point->target = gm_engine_target(v, point->act.torque, x[GM_CAR_ENGINE_SPEED],
                                     &point->target_demand, &point->target_w);
    point->speed[0] = parts->forward * flange_speed[0];
    for (int p = 0; p < n_paths; p++) {
        point->speed[1 + p] = flange_speed[1 + p];
        clutch_at(parts, now, x, p, point);
    }
    point->flywheel =
        v->flywheel_stiffness * x[GM_CAR_FLYWHEEL] +
        v->flywheel_damping * (x[GM_CAR_ENGINE_SPEED] - x[GM_CAR_DRUM_SPEED]);
    point->hub = slips(v) ? x[GM_CAR_WHEELS] : x[GM_CAR_SPEED] / v->wheel_radius;
    point->shafts =
        v->shaft_stiffness * x[GM_CAR_SHAFTS] + v->shaft_damping * shafts_slip(point, x);
    if (slips(v))
        point->tyre = gm_tyre_force(v, point->hub * v->wheel_radius, x[GM_CAR_SPEED],
                                    &point->tyre_by_wheel, &point->tyre_by_v);
    point->road = gm_road_load(v, x[GM_CAR_SPEED], &point->road_slope);
}

void gm_car_torques(const gm_trip_parts *parts, const gm_car_point *point,
                    double torque[GM_MAX_FLANGES])
{
    memset(torque, 0, GM_MAX_FLANGES * sizeof *torque);
    torque[0] = -parts->forward * point->shafts;
    for (int p = 0; p < parts->gearset->n_paths; p++)
        torque[1 + p] = point->clutch[p];
}

void gm_car_torque_by(const gm_trip_parts *parts, const gm_car_point *point, int flange,
                      double by[GM_CAR_COLUMNS])
{
    const gm_vehicle *v = parts->vehicle;
    memset(by, 0, GM_CAR_COLUMNS * sizeof *by);
    if (flange > 0) {
        memcpy(by, point->clutch_by[flange - 1], GM_CAR_COLUMNS * sizeof *by);
        return;
    }
    by[GM_CAR_SHAFTS] = -parts->forward * v->shaft_stiffness;
    by[GM_CAR_MOUNT_SPEED] = -parts->forward * v->shaft_damping;
    if (slips(v))
        by[GM_CAR_WHEELS] = parts->forward * v->shaft_damping;
    else
        by[GM_CAR_SPEED] = parts->forward * v->shaft_damping / v->wheel_radius;
    by[GM_CAR_DYNAMIC] = -v->shaft_damping; /* forward squared is one */
}

/* ---- rates ---- */

static double moved_mass(const gm_vehicle *v)
{
    return v->mass + v->wheel_inertia / (v->wheel_radius * v->wheel_radius);
}

static double carried(const gm_trip_parts *parts, const gm_car_point *point)
{
    double sum = 0.0;
    for (int p = 0; p < parts->gearset->n_paths; p++)
        sum += point->clutch[p];
    return sum;
}

static void account(const gm_trip_parts *parts, const gm_car_point *point,
                    const double *x, double *dx)
{
    const gm_vehicle *v = parts->vehicle;
    double w_e = x[GM_CAR_ENGINE_SPEED], w_d = x[GM_CAR_DRUM_SPEED];
    double twisting = shafts_slip(point, x), w_m = x[GM_CAR_MOUNT_SPEED];
    double surface = point->hub * v->wheel_radius; /* of the wheels, m/s */
    dx[GM_CAR_DISTANCE] = x[GM_CAR_SPEED];
    dx[GM_CAR_HEIGHT] = x[GM_CAR_SPEED] * point->rise;
    dx[GM_CAR_ENGINE_WORK] = x[GM_CAR_ENGINE_TORQUE] * w_e;
    dx[GM_CAR_DAMPER_LOSS] = v->flywheel_damping * (w_e - w_d) * (w_e - w_d) +
                             v->shaft_damping * twisting * twisting +
                             v->mount_damping * w_m * w_m;
    dx[GM_CAR_ROAD_LOSS] = point->road * x[GM_CAR_SPEED];
    if (slips(v))
        dx[GM_CAR_ROAD_LOSS] += point->tyre * (surface - x[GM_CAR_SPEED]);
    dx[GM_CAR_BRAKE_LOSS] = point->act.brake * surface;
    dx[GM_CAR_CLUTCH_LOSS] = 0.0;
    dx[GM_CAR_GEARSET_WORK] = -point->shafts * point->speed[0];
    for (int p = 0; p < parts->gearset->n_paths; p++) {
        dx[GM_CAR_CLUTCH_LOSS] += point->clutch[p] * (w_d - point->speed[1 + p]);
        dx[GM_CAR_GEARSET_WORK] += point->clutch[p] * point->speed[1 + p];
    }
}

static void wheels_and_body(const gm_vehicle *v, const gm_car_point *point, double *dx)
{
    double r = v->wheel_radius, against = point->road + point->hill;
    if (slips(v)) {
        dx[GM_CAR_SPEED] = (point->tyre - against) / v->mass;
        dx[GM_CAR_WHEELS] =
            (point->shafts - r * (point->tyre + point->act.brake)) / v->wheel_inertia;
        return;
    }
    dx[GM_CAR_SPEED] = (point->shafts / r - against - point->act.brake) / moved_mass(v);
    dx[GM_CAR_WHEELS] = dx[GM_CAR_SPEED] / r;
}

static void mounts(const gm_vehicle *v, const gm_car_point *point, const double *x,
                   double *dx)
{
    double torque = point->shafts + v->mount_stiffness * x[GM_CAR_MOUNT] +
                    v->mount_damping * x[GM_CAR_MOUNT_SPEED];
    dx[GM_CAR_MOUNT] = x[GM_CAR_MOUNT_SPEED];
    dx[GM_CAR_MOUNT_SPEED] = v->mount_inertia > 0.0 ? -torque / v->mount_inertia : 0.0;
}

void gm_car_rates(const gm_trip_parts *parts, const gm_car_point *point, const double *x,
                  double *dx)
{
    const gm_vehicle *v = parts->vehicle;
    dx[GM_CAR_ENGINE_SPEED] =
        (x[GM_CAR_ENGINE_TORQUE] - point->flywheel) / v->engine_inertia;
    dx[GM_CAR_ENGINE_TORQUE] = (point->target - x[GM_CAR_ENGINE_TORQUE]) / v->torque_lag;
    dx[GM_CAR_FLYWHEEL] = x[GM_CAR_ENGINE_SPEED] - x[GM_CAR_DRUM_SPEED];
    dx[GM_CAR_DRUM_SPEED] = (point->flywheel - carried(parts, point)) / v->drum_inertia;
    dx[GM_CAR_SHAFTS] = shafts_slip(point, x);
    wheels_and_body(v, point, dx);
    mounts(v, point, x, dx);
    dx[GM_CAR_INTEGRAL] = point->act.integral_rate;
    account(parts, point, x, dx);
}

#define BIT(column) (1u << (column))
#define FLANGE(f) (1u << (GM_CAR_DYNAMIC + (f)))

/* What the twist speed of the driveshafts depends on, and what the brake does. */
enum {
    TWISTING =
        BIT(GM_CAR_WHEELS) | BIT(GM_CAR_SPEED) | BIT(GM_CAR_MOUNT_SPEED) | FLANGE(0),
    SHAFT_TORQUE = TWISTING | BIT(GM_CAR_SHAFTS),
    BRAKE = BIT(GM_CAR_SPEED) | BIT(GM_CAR_INTEGRAL) | BIT(GM_CAR_ENGINE_SPEED),
    FLYWHEEL = BIT(GM_CAR_ENGINE_SPEED) | BIT(GM_CAR_DRUM_SPEED) | BIT(GM_CAR_FLYWHEEL)
};

unsigned gm_car_torque_columns(int flange)
{
    return flange == 0 ? SHAFT_TORQUE
                       : BIT(GM_CAR_ENGINE_SPEED) | BIT(GM_CAR_ENGINE_TORQUE) |
                             BIT(GM_CAR_DRUM_SPEED) | FLANGE(flange);
}

unsigned gm_car_rate_columns(int row)
{
    static const unsigned columns[GM_CAR_DYNAMIC] = {
        [GM_CAR_ENGINE_SPEED] = FLYWHEEL | BIT(GM_CAR_ENGINE_TORQUE),
        [GM_CAR_ENGINE_TORQUE] = BIT(GM_CAR_ENGINE_SPEED) | BIT(GM_CAR_ENGINE_TORQUE) |
                                 BIT(GM_CAR_SPEED) | BIT(GM_CAR_INTEGRAL),
        [GM_CAR_FLYWHEEL] = BIT(GM_CAR_ENGINE_SPEED) | BIT(GM_CAR_DRUM_SPEED),
        [GM_CAR_DRUM_SPEED] =
            FLYWHEEL | BIT(GM_CAR_ENGINE_TORQUE) | FLANGE(1) | FLANGE(2),
        [GM_CAR_SHAFTS] = TWISTING,
        [GM_CAR_WHEELS] = SHAFT_TORQUE | BRAKE,
        [GM_CAR_SPEED] = SHAFT_TORQUE | BRAKE,
        [GM_CAR_MOUNT] = BIT(GM_CAR_MOUNT_SPEED),
        [GM_CAR_MOUNT_SPEED] = SHAFT_TORQUE | BIT(GM_CAR_MOUNT),
        [GM_CAR_INTEGRAL] = BIT(GM_CAR_SPEED) | BIT(GM_CAR_INTEGRAL),
    };
    return columns[row];
}

static void engine_by(const gm_vehicle *v, const gm_car_point *point,
                      double by[GM_CAR_DYNAMIC][GM_CAR_COLUMNS])
{
    double *speed = by[GM_CAR_ENGINE_SPEED], *torque = by[GM_CAR_ENGINE_TORQUE];
    speed[GM_CAR_ENGINE_SPEED] = -v->flywheel_damping / v->engine_inertia;
    speed[GM_CAR_ENGINE_TORQUE] = 1.0 / v->engine_inertia;
    speed[GM_CAR_FLYWHEEL] = -v->flywheel_stiffness / v->engine_inertia;
    speed[GM_CAR_DRUM_SPEED] = v->flywheel_damping / v->engine_inertia;
    torque[GM_CAR_ENGINE_SPEED] = point->target_w / v->torque_lag;
    torque[GM_CAR_ENGINE_TORQUE] = -1.0 / v->torque_lag;
    torque[GM_CAR_SPEED] = point->target_demand * point->act.torque_v / v->torque_lag;
    torque[GM_CAR_INTEGRAL] = point->target_demand * point->act.torque_i / v->torque_lag;
    by[GM_CAR_FLYWHEEL][GM_CAR_ENGINE_SPEED] = 1.0;
    by[GM_CAR_FLYWHEEL][GM_CAR_DRUM_SPEED] = -1.0;
}

static void drum_by(const gm_trip_parts *parts, const gm_car_point *point,
                    double by[GM_CAR_COLUMNS])
{
    const gm_vehicle *v = parts->vehicle;
    by[GM_CAR_ENGINE_SPEED] = v->flywheel_damping / v->drum_inertia;
    by[GM_CAR_FLYWHEEL] = v->flywheel_stiffness / v->drum_inertia;
    by[GM_CAR_DRUM_SPEED] = -v->flywheel_damping / v->drum_inertia;
    for (int p = 0; p < parts->gearset->n_paths; p++)
        for (int k = 0; k < GM_CAR_COLUMNS; k++)
            by[k] -= point->clutch_by[p][k] / v->drum_inertia;
}

/* Row of T_s = k twist + d (w_o + w_m - hub), times factor. */
static void add_shafts(const gm_trip_parts *parts, double factor,
                       double by[GM_CAR_COLUMNS])
{
    const gm_vehicle *v = parts->vehicle;
    by[GM_CAR_SHAFTS] += factor * v->shaft_stiffness;
    by[GM_CAR_DYNAMIC] += factor * parts->forward * v->shaft_damping;
    by[GM_CAR_MOUNT_SPEED] += factor * v->shaft_damping;
    if (slips(v))
        by[GM_CAR_WHEELS] -= factor * v->shaft_damping;
    else
        by[GM_CAR_SPEED] -= factor * v->shaft_damping / v->wheel_radius;
}

static void add_brake(const gm_car_point *point, double factor, double by[GM_CAR_COLUMNS])
{
    by[GM_CAR_SPEED] += factor * point->act.brake_v;
    by[GM_CAR_INTEGRAL] += factor * point->act.brake_i;
    by[GM_CAR_ENGINE_SPEED] += factor * point->act.brake_w;
}

static void slipping_by(const gm_trip_parts *parts, const gm_car_point *point,
                        double by[GM_CAR_DYNAMIC][GM_CAR_COLUMNS])
{
    const gm_vehicle *v = parts->vehicle;
    double r = v->wheel_radius, *wheels = by[GM_CAR_WHEELS], *speed = by[GM_CAR_SPEED];
    add_shafts(parts, 1.0 / v->wheel_inertia, wheels);
    add_brake(point, -r / v->wheel_inertia, wheels);
    wheels[GM_CAR_WHEELS] -= r * r * point->tyre_by_wheel / v->wheel_inertia;
    wheels[GM_CAR_SPEED] -= r * point->tyre_by_v / v->wheel_inertia;
    speed[GM_CAR_WHEELS] = r * point->tyre_by_wheel / v->mass;
    speed[GM_CAR_SPEED] = (point->tyre_by_v - point->road_slope) / v->mass;
}

static void rolling_by(const gm_trip_parts *parts, const gm_car_point *point,
                       double by[GM_CAR_DYNAMIC][GM_CAR_COLUMNS])
{
    const gm_vehicle *v = parts->vehicle;
    double r = v->wheel_radius, m = moved_mass(v), *speed = by[GM_CAR_SPEED];
    add_shafts(parts, 1.0 / (r * m), speed);
    add_brake(point, -1.0 / m, speed);
    speed[GM_CAR_SPEED] -= point->road_slope / m;
    for (int k = 0; k < GM_CAR_COLUMNS; k++)
        by[GM_CAR_WHEELS][k] = speed[k] / r;
}

static void mounts_by(const gm_trip_parts *parts,
                      double by[GM_CAR_DYNAMIC][GM_CAR_COLUMNS])
{
    const gm_vehicle *v = parts->vehicle;
    double *speed = by[GM_CAR_MOUNT_SPEED];
    by[GM_CAR_MOUNT][GM_CAR_MOUNT_SPEED] = 1.0;
    if (v->mount_inertia <= 0.0)
        return;
    add_shafts(parts, -1.0 / v->mount_inertia, speed);
    speed[GM_CAR_MOUNT] -= v->mount_stiffness / v->mount_inertia;
    speed[GM_CAR_MOUNT_SPEED] -= v->mount_damping / v->mount_inertia;
}

void gm_car_rates_by(const gm_trip_parts *parts, const gm_car_point *point,
                     double by[GM_CAR_DYNAMIC][GM_CAR_COLUMNS])
{
    const gm_vehicle *v = parts->vehicle;
    memset(by, 0, GM_CAR_DYNAMIC * sizeof by[0]);
    engine_by(v, point, by);
    drum_by(parts, point, by[GM_CAR_DRUM_SPEED]);
    by[GM_CAR_SHAFTS][GM_CAR_DYNAMIC] = parts->forward;
    by[GM_CAR_SHAFTS][GM_CAR_MOUNT_SPEED] = 1.0;
    if (slips(v)) {
        by[GM_CAR_SHAFTS][GM_CAR_WHEELS] = -1.0;
        slipping_by(parts, point, by);
    } else {
        by[GM_CAR_SHAFTS][GM_CAR_SPEED] = -1.0 / v->wheel_radius;
        rolling_by(parts, point, by);
    }
    mounts_by(parts, by);
    by[GM_CAR_INTEGRAL][GM_CAR_SPEED] = point->act.rate_v;
    by[GM_CAR_INTEGRAL][GM_CAR_INTEGRAL] = point->act.rate_i;
}

/* The gearset's share of what rolls on the mounts is in mount_inertia. */
double gm_car_stored(const gm_vehicle *v, const double *x)
{
    double w_e = x[GM_CAR_ENGINE_SPEED], w_d = x[GM_CAR_DRUM_SPEED];
    double w_m = x[GM_CAR_MOUNT_SPEED], car = x[GM_CAR_SPEED];
    double hub = slips(v) ? x[GM_CAR_WHEELS] : car / v->wheel_radius;
    double kinetic = v->engine_inertia * w_e * w_e + v->drum_inertia * w_d * w_d +
                     v->mass * car * car + v->wheel_inertia * hub * hub +
                     v->mount_inertia * w_m * w_m;
    double elastic = v->flywheel_stiffness * x[GM_CAR_FLYWHEEL] * x[GM_CAR_FLYWHEEL] +
                     v->shaft_stiffness * x[GM_CAR_SHAFTS] * x[GM_CAR_SHAFTS] +
                     v->mount_stiffness * x[GM_CAR_MOUNT] * x[GM_CAR_MOUNT];
    return 0.5 * (kinetic + elastic) + v->mass * v->gravity * x[GM_CAR_HEIGHT];
}
