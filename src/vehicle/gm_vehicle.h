/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The vehicle around a gearset: engine, dual-mass flywheel, clutches, driveshafts, car,
 * road, brakes and driver. The same for a detailed and for a reduced gearset.
 *
 *   J_e dw_e/dt = T_e - T_dmf              dT_e/dt = (T_target - T_e) / lag
 *   J_d dw_d/dt = T_dmf - sum_p T_p        T_dmf = k twist + d (w_e - w_d)
 *   T_p = share_p grip tanh((w_d - w_p) / slip)         into path p of the gearset
 *   T_s = k twist + d (w_o - v / r)                     out of the gearset's output
 *   (m + J_w / r2) dv/dt = T_s / r - rolling - drag - hill - brake
 *   hill = m g sin(atan(grade))     grade: the road's and, added to it, the cycle's
 *
 * Two options. Tyres that slip let the wheels turn apart from the car:
 *   F = F_max tanh(C s / F_max)    s = (w_w r - v) / sqrt(v2 + v0^2), v0 = 1 m/s
 *   J_w dw_w/dt = T_s - r (F + brake)     m dv/dt = F - rolling - drag - hill
 * Mounts that give way let engine and gearbox roll (transverse: about the axis of the
 * output) by the reaction of the driveshafts, whose twist then grows with w_o + w_m too:
 *   J_m dw_m/dt = -T_s - k_m phi_m - d_m w_m
 * The inertia of what turns inside counts in J_m; its change of spin by w_m is left out.
 *
 * w_o counts positive where the car drives forward in a forward gear.
 */
#ifndef GM_VEHICLE_H
#define GM_VEHICLE_H

#include "base/gm_status.h"

#ifdef __cplusplus
extern "C" {
#endif

#define GM_VEHICLE_MAX_POINTS 16

/** Full-load torque over speed: linear between points, constant beyond. */
typedef struct gm_full_load_point {
    double speed, torque; /* rad/s, increasing; N.m */
    int line;             /* of the file, if it is from one */
} gm_full_load_point;

typedef struct gm_full_load {
    int n;
    gm_full_load_point point[GM_VEHICLE_MAX_POINTS];
} gm_full_load;

typedef struct gm_vehicle {
    double mass;                /* kg */
    double wheel_radius;        /* dynamic, m */
    double wheel_inertia;       /* all wheels, kg.m2 */
    double tyre_stiffness;      /* N for a slip of 1, small slips; 0: tyres do not slip */
    double tyre_force_max;      /* N, of all driven tyres */
    double rolling_coefficient; /* smoothed at standstill with tanh(v / 0.1 m/s) */
    double drag_area;           /* c_d A, m2 */
    double air_density;         /* kg/m3 */
    double shaft_stiffness;     /* both driveshafts at the output flange, N.m/rad */
    double shaft_damping;       /* N.m.s/rad */
    double mount_inertia;       /* of engine and gearbox about the roll axis, kg.m2;
                                   0: they are mounted rigidly */
    double mount_stiffness;     /* N.m/rad */
    double mount_damping;       /* N.m.s/rad */
    double engine_inertia;      /* with the primary side of the flywheel, kg.m2 */
    double flywheel_stiffness;  /* N.m/rad */
    double flywheel_damping;    /* N.m.s/rad */
    double drum_inertia;        /* secondary side and clutch drum, kg.m2 */
    double clutch_slip;         /* speed at which a clutch carries 76 %, rad/s */
    double launch_speed;        /* engine speed at which the clutch begins, rad/s */
    double launch_gain;         /* capacity = gain (w - launch_speed)^2, N.m.s2/rad2 */
    double clutch_torque_max;   /* N.m */
    double clutch_margin;       /* what a clutch that slips much holds beyond the engine's
                                   torque, N.m */
    gm_full_load full_load;     /* of the engine */
    double drag_torque, drag_per_speed; /* engine without fuel: N.m, N.m.s/rad */
    double torque_lag;                  /* of the engine, s */
    double idle_speed, idle_gain;       /* governor: gain (idle_speed - w) at least */
    double driver_gain;                 /* N/(m/s) */
    double driver_integral;             /* N/m */
    double driver_windup;               /* largest integral part, N */
    double driver_mass_factor;          /* feed-forward: factor on m a */
    double shift_time;                  /* clutch-to-clutch, s */
    double preselect_time;              /* before the shift, s */
    double interrupt_time;              /* one clutch: open, before and after, s */
    double gravity;                     /* m/s2 */
    double grade;                       /* of the whole road, rise over run */
} gm_vehicle;

/** A C-segment car: mass, radius, inertia, rolling resistance and drag of a Volkswagen
 *  Golf 1.5 TSI (NREL FASTSim vehicle database); the rest are engineering assumptions. */
gm_vehicle gm_vehicle_reference(void);

/** A vehicle from a YAML file (vehicle_file.c; docs/vehicle.md); fields of driver and
 *  control that it leaves out are those of the reference. GM_ERR_IO, GM_ERR_FORMAT with
 *  file, line, what was found and expected, GM_ERR_MEMORY; then *vehicle is untouched. */
GM_NODISCARD gm_status gm_vehicle_read(const char *path, gm_vehicle *vehicle,
                                       gm_error *error);

/** Reference of that file's format: calls write with successive pieces of Markdown. */
void gm_vehicle_help(void (*write)(void *context, const char *text), void *context);

/** GM_ERR_ARGUMENT names the field that is not finite, or not positive where it must be.
 */
GM_NODISCARD gm_status gm_vehicle_check(const gm_vehicle *vehicle, gm_error *error);

/* ---- laws, with derivatives where the Jacobian needs them ---- */

/** Engine torque at full load [N.m]; *slope: its derivative by w. */
double gm_full_load_torque(const gm_full_load *curve, double w, double *slope);

/** Torque of the engine without fuel [N.m], negative at w > 0, smooth at rest. */
double gm_engine_drag(const gm_vehicle *v, double w, double *slope);

/** Torque that the engine is asked for: between drag and full load, and what the idle
 *  governor wants at least. *d_demand, *d_w: derivatives. */
double gm_engine_target(const gm_vehicle *v, double demand, double w, double *d_demand,
                        double *d_w);

/** Capacity of a closing or closed clutch over engine speed [N.m]. */
double gm_clutch_capacity(const gm_vehicle *v, double w, double *slope);

/** What a clutch can carry at present [N.m], with derivatives. While it slips it is
 *  pressed for the engine's torque T and, to pull the engine to its new speed, for
 *  clutch_margin more, which eases off before the slip is gone; then it closes to all of
 *  its capacity C:
 *    S = sqrt(T2 + (5 N.m)2) + margin z2 / (1 + z2),   z = slip / (30 rad/s)
 *    F = C S / sqrt(C2 + S2),  the smaller of the two
 *    grip = F + (C - F) / (1 + y2),   y = slip / (1 rad/s)
 *  So a shift moves as much torque as there is, two clutches that both carry do not work
 *  against each other, and the torque does not jump when slip ends. */
typedef struct gm_clutch_grip {
    double value, by_w, by_torque, by_slip;
} gm_clutch_grip;

gm_clutch_grip gm_clutch_grip_at(const gm_vehicle *v, double w, double torque,
                                 double slip);

/** Rolling resistance and air drag [N] at speed v [m/s], on the level: the cosine of a
 *  grade of 10 % is 0.995. */
double gm_road_load(const gm_vehicle *vehicle, double v, double *slope);

/** Force of all driven tyres on the car [N], their surface at speed_wheel, the car at v
 *  [m/s]. *by_wheel, *by_v: derivatives. Only with tyre_stiffness > 0. */
double gm_tyre_force(const gm_vehicle *vehicle, double speed_wheel, double v,
                     double *by_wheel, double *by_v);

/** Rise over way, the sine of the slope's angle, for a grade, rise over run. */
double gm_rise(double grade);

#ifdef __cplusplus
}
#endif
#endif
