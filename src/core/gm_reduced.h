/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The reduced gearset: the mechanical part between the input flanges and the output
 * flange, with losses, inertias and ratios from tables. Rigid fidelity: an engaged path p
 * turns with the output, w_p = r_p w_o (r_p signed).
 *
 * For a configuration s (one gear per path), E engaged, N neutral paths, a = dw_o/dt and
 * sigma in Sgn(w_o), set-valued at zero:
 *
 *   0 = J_s a - tau_o - sum_E r_p tau_p - sum_sync r_g T_c,p + sum_N R_n
 *       - sum_{n in N, q in E} r_q C(w_n - w_q)
 *       + sigma [ P_s(|w_o|) + sum_E |r_p| D_p(|w_p|, sigma_p tau_m,p) + X_s ]
 *   tau_m,p = tau_p + sum_N C(w_n - w_p) - J_p r_p a          sigma_p = sgn(r_p) sigma
 *   J_n dw_n/dt = tau_n - N_n(w_n, w_o) - C(w_n - w_q) - T_c,n
 *   T_c,n in capacity Sgn(w_n - r_g w_o)                      while synchronising to g
 *   J_s = J_out + sum_E (r_p^2 J_p + J_g)
 *
 * When both paths are in neutral, C acts between the two of them.
 *
 * Fidelity rigid is the above. In fidelity lash an engaged path keeps its own speed and
 * drives the output through a spring with damping and backlash, torque T_p at its flange
 * (law in reduced_spring.c), twist theta_p:
 *
 *   J_p dw_p/dt = tau_p - C - sgn(w_p) pin_p - T_p       dtheta_p/dt = w_p - r_p w_o
 *   0 = J_out a - tau_o - sum_E r_p T_p - ... + sigma [P_s - sum_E |r_p| pin_p + ...]
 *   tau_m,p = T_p + sgn(w_p) pin_p
 *
 * with pin_p(|r_p w_o|) the part of P_s that brakes the input side: while the twist rests
 * both fidelities lose the same.
 *
 * J_g, of gear g, is zero but for planetary gearsets, where parts turn in some gears
 * only. When a gear comes or goes, they are taken along from rest or left behind at rest:
 * one impulse, which conserves the momentum of what stays in motion and loses energy.
 *
 * Time stepping: implicit in the signs (exact stiction, no creep), tables and their
 * speed gradients at the middle of the step, angles by the trapezoid rule; so the energy
 * account (work = kinetic + elastic + loss) closes to rounding on every step, with
 * springs to 1e-11. Vibrations of the springs are followed in up to two parts of a step;
 * those that are faster than that die out (reduced_drive.c): any step is stable.
 *
 * No allocation, no I/O, no globals, only + - * / : the same bits on every platform.
 */
#ifndef GM_REDUCED_H
#define GM_REDUCED_H

#include "gm_interp.h"

#ifdef __cplusplus
extern "C" {
#endif

#define GM_MAX_PATHS 2
#define GM_NEUTRAL 0

/** Direction of rotation as a table index: forward (speed > 0 or 0+), backward. */
enum { GM_FORWARD = 0, GM_BACKWARD = 1 };

/** One gear of a path. */
typedef struct gm_gear {
    int number;             /* -1 reverse, 1..n; never 0 */
    gm_real ratio;          /* r = w_path / w_output, signed */
    gm_real inertia_extra;  /* J_g: what turns with the output in this gear beyond J_out
                               and r^2 J_p [kg.m2], may be < 0; J_out + J_g > 0 */
    gm_table2 load_loss[2]; /* D by direction of rotation of the path: x |w_p| [rad/s],
                               y torque in the direction of rotation [N.m] (> 0 driving)
                               -> loss torque at the path's flange [N.m] */
    /* Between the path's flange and the output, seen from the flange; used in fidelity
       lash. stiffness 0: not known, the path is rigid in that gear. */
    gm_real stiffness;     /* k [N.m/rad], both flanks in contact, >= 0 */
    gm_real damping;       /* d of the contact [N.m.s/rad], >= 0 */
    gm_real loose_damping; /* d_l of what idles along, at slow slip [N.m.s/rad], >= 0 */
    gm_real lash;          /* whole free angle [rad], >= 0 */
    gm_real film;     /* last part of it before contact, in which the squeezed oil film
                          damps more and more [rad], >= 0 */
    gm_table1 pin[2]; /* part of P that brakes the input side, by direction of rotation
                          of the path: x |w_p| [rad/s] -> N.m at the path's flange, >= 0;
                          value = NULL: zero */
} gm_gear;

/** A line w_n = ratio * w_o of the (w_n, w_o) plane, on which the drag of one idling gear
 *  changes sign: N jumps by +jump, R by -ratio * jump when w_n grows past it. The tables
 *  drag and reaction hold the rest, after subtraction of the exact jumps
 *  jump/2 sgn(w_n - r w_o) and -ratio jump/2 [sgn(w_n - r w_o) + sgn(r w_o)]. When used,
 *  sgn(x) becomes a ramp of slope 1/GM_LINE_WIDTH between -1 and +1: closer than
 *  GM_LINE_WIDTH to a line the idler's drag is too small, farther away it is exact. */
typedef struct gm_drag_line {
    gm_real ratio;
    gm_table1 jump[2]; /* by direction of w_o: x |w_o| [rad/s] -> N.m, >= 0 */
} gm_drag_line;

#define GM_LINE_WIDTH GM_NUM(1.0) /* rad/s, the ramp is from -1 to +1 around the line */

/** One path: an input flange and what is behind it. A path without drag tables
 *  (drag[0][0].value = NULL) has no neutral: it has one gear and is always in it. */
typedef struct gm_path {
    gm_real inertia;     /* J_p: turns with the input flange in neutral [kg.m2] */
    gm_real sync_torque; /* default cone capacity at the input flange [N.m] */
    int n_gears;
    const gm_gear *gears; /* [n_gears] */
    /* Smooth parts of N and R by [direction of w_n][direction of w_o]:
       x |w_n|, y |w_o| [rad/s] -> N.m at the input flange, at the output; signed: N > 0
       brakes a shaft that turns forward. N is continuous across w_o = 0, R(0, w_o) = 0.
     */
    gm_table2 drag[2][2];
    gm_table2 reaction[2][2];
    int n_lines;
    const gm_drag_line *lines; /* [n_lines] */
} gm_path;

/** One gear per path; gear[p] is an index into path[p].gears, or -1 for neutral. */
typedef struct gm_configuration {
    int gear[GM_MAX_PATHS];
    gm_table1 parasitic[2];   /* P_s by direction of w_o: x |w_o| -> N.m at the output,
                                 neutral shafts at rest, C not included */
    gm_table3 both_loaded[2]; /* X_s by direction of w_o: x |w_o|, y and z torque of path
                                 0 and 1 in their direction of rotation -> N.m at the
                                 output, signed. value = NULL: zero */
} gm_configuration;

/** Oil temperatures of the slices of all tables. With the way u = 0 .. 1 from one to the
 *  next, losses follow the share u (1 + bend) / (1 + bend u) of the next slice: bend 0
 *  is linear; with bend > 0 they change most at the lower temperature, as a viscosity
 *  does. */
typedef struct gm_oil_axis {
    int n; /* slices; 0 or 1: one, and the temperature has no effect */
    const gm_real *temperature; /* [n] K, strictly increasing */
    const gm_real *bend;        /* [n - 1], > -1 */
} gm_oil_axis;

/** Everything a gearset is reduced to. Constant; may live in flash. */
typedef struct gm_reduced_map {
    int n_paths; /* 1 or 2 */
    gm_path path[GM_MAX_PATHS];
    /* Index of (g0, g1): (g0 + 1) * (path[1].n_gears + 1) + g1 + 1; for one path g0 + 1.
     */
    int n_configurations;
    const gm_configuration *configurations;
    gm_table1 coupling;     /* C: x relative speed w_0 - w_1, signed [rad/s] -> N.m; zero
                                when value = NULL. C(w_1 - w_0) = -C(w_0 - w_1). */
    gm_real inertia_output; /* J_out [kg.m2] */
    gm_oil_axis oil;
    gm_real oil_temperature; /* that the tables hold for; with an oil axis one of its
                                range, usual in operation [K] */
    /* Flanges, the output last, whose motion is prescribed from outside: speed and
       acceleration come in, the torque that they take goes out. A path needs fidelity
       lash and gears with a stiffness for it: a rigid path that is engaged turns with
       the output, whatever is prescribed. */
    int prescribed[GM_MAX_PATHS + 1];
} gm_reduced_map;

typedef enum gm_path_mode {
    GM_PATH_NEUTRAL = 0,
    GM_PATH_SYNCHRONISING = 1,
    GM_PATH_ENGAGED = 2
} gm_path_mode;

typedef enum gm_fidelity {
    GM_RIGID = 1, /* engaged paths turn with the output */
    GM_LASH = 2   /* a spring with backlash connects them */
} gm_fidelity;

typedef struct gm_reduced_params {
    int fidelity;                      /* gm_fidelity; the same over a whole run */
    gm_real loss_scale;                /* factor on every loss torque, >= 0; default 1 */
    gm_real sync_torque[GM_MAX_PATHS]; /* cone capacity at the input flange [N.m], > 0 or
                                          infinite (HUGE_VAL): instantaneous engagement */
} gm_reduced_params;

/** Inputs, constant or linear over a step. Torques act into the gearset. */
typedef struct gm_reduced_inputs {
    gm_real output_tau, output_tau_rate; /* N.m, N.m/s */
    gm_real path_tau[GM_MAX_PATHS], path_tau_rate[GM_MAX_PATHS];
    int gear[GM_MAX_PATHS];  /* commanded gear numbers */
    gm_real oil_temperature; /* K; constant over a step. Without effect where the map has
                                no oil axis */
    /* Of prescribed flanges, instead of torques: speed at the start of a step [rad/s] and
       its derivative over it [rad/s2]. A speed that jumps between steps does so by an
       impulse, which is in the account of work. */
    gm_real w[GM_MAX_PATHS + 1], a[GM_MAX_PATHS + 1];
} gm_reduced_inputs;

/** State of one path. */
typedef struct gm_path_state {
    gm_real phi, w; /* rad, rad/s */
    gm_real twist;  /* of the engaged gear, 0 in the middle of its lash; its rate is
                       w - ratio w_o in fidelity lash, and it is 0 in rigid [rad] */
    int mode;       /* gm_path_mode */
    int gear;       /* index of the gear engaged or being synchronised; -1 in neutral */
    gm_real rest;   /* float: what rounding left over of the changes of w [rad/s]; double:
                       0 */
} gm_path_state;

/** c + cx u + cy v + cxy u v + cyy v^2, u and v from the low ends of a range. */
typedef struct gm_surface {
    gm_real c, cx, cy, cxy, cyy;
} gm_surface;

/** A range of one variable and the line there. outside: 1 beyond the table. */
typedef struct gm_strip {
    short key, outside;
    gm_real low, high, c, cx;
} gm_strip;

/** A range of two variables and the surfaces there: load loss of an engaged path over
 *  speed and torque, or drag and reaction of a free one over both speeds. The latter with
 *  all drag lines; where among them: bits of sides and the ratios that bound the range,
 *  see reduced_drag.c. */
typedef struct gm_patch {
    short key, outside, sides;
    gm_real x_low, x_high, y_low, y_high;
    gm_surface a, b;
    gm_real ratio[4];
} gm_patch;

/** A range of three variables; c[i][j][k] is the factor of u^i v^j w^k. */
typedef struct gm_block {
    short key, outside;
    gm_real low[3], high[3], c[2][2][2];
} gm_block;

/** An oil temperature and where it lies between the slices of the tables. inside: 0
 *  beyond their range, where the nearest slice is used. */
typedef struct gm_oil_place {
    gm_real temperature;
    int inside;
    gm_slices slices;
} gm_oil_place;

/** What was read from tables the last time. No influence on results. Zeroed memory is an
 *  empty cache. */
typedef struct gm_reduced_cache {
    gm_oil_place oil; /* all the rest is for this temperature */
    gm_strip parasitic, coupling, pin[GM_MAX_PATHS];
    gm_patch path[GM_MAX_PATHS];
    gm_block both_loaded;
#if GM_CURVED
    gm_cell2 curved[GM_MAX_PATHS][2]; /* of monotone tables: D or N, R */
#endif
} gm_reduced_cache;

/** Speed of every independent shaft and the accounts; plain data without pointers. */
typedef struct gm_reduced_state {
    gm_real phi_o, w_o;
    gm_real brake;  /* what losses took from the output's torque in the last step [N.m]:
                      where the next one begins to look, so part of the state */
    gm_real rest_o; /* as gm_path_state.rest, of w_o */
    gm_path_state path[GM_MAX_PATHS];
    gm_real work; /* done by the flanges on the gearset since the start [J] */
    gm_real
        loss_energy; /* dissipated since the start, engagement impulses included [J] */
    gm_reduced_cache cache;
} gm_reduced_state;

/** What can be observed of a state under given inputs. */
typedef struct gm_reduced_outputs {
    gm_real a_o;                       /* rad/s2 */
    gm_real a[GM_MAX_PATHS];           /* rad/s2 */
    gm_real transmitted[GM_MAX_PATHS]; /* tau_m of engaged paths, else 0 [N.m] */
    gm_real
        path_loss_torque[GM_MAX_PATHS]; /* sigma_p D_p engaged; N_n + C neutral [N.m] */
    gm_real output_loss_torque;         /* sigma (P + X) + R at the output [N.m] */
    gm_real loss_power;                 /* all of it, cones included [W] */
    gm_real kinetic_energy;             /* [J] */
    gm_real elastic_energy;             /* of the twisted paths [J] */
    gm_real twist_rate[GM_MAX_PATHS];   /* of elastic paths, else 0 [rad/s] */
    gm_real step; /* the longest of 10, 5, 2, 1 ms ... that follows every vibration [s] */
    gm_real inertia_o;             /* that the output flange feels at once, */
    gm_real inertia[GM_MAX_PATHS]; /* and that of each path [kg.m2] */
    gm_real tau[GM_MAX_PATHS + 1]; /* into the gearset, the output last: what a prescribed
                                      flange takes, or the input [N.m] */
} gm_reduced_outputs;

/** Flags of a call, or-ed. */
enum {
    GM_FLAG_OUT_OF_MAP = 1, /* a table was left; its edge value was used */
    GM_FLAG_NOT_FINITE =
        2, /* an input is NaN or beyond 1e108 (float: 1e18), or a result overflowed:
                               the state is unchanged */
    GM_FLAG_GEAR_REFUSED_0 = 4, /* unknown gear number commanded on path 0; gear kept */
    GM_FLAG_GEAR_REFUSED_1 = 8
};

/** Slices of every table: 1 without an oil axis. */
static inline int gm_reduced_slices(const gm_reduced_map *map)
{
    return map->oil.n > 1 ? map->oil.n : 1;
}

/** Rigid, loss_scale 1 and the map's own cone capacities. */
void gm_reduced_default_params(const gm_reduced_map *map, gm_reduced_params *params);

/** Index of gear number in path p: -1 for neutral, -2 when the path has no such gear. */
int gm_reduced_find_gear(const gm_reduced_map *map, int p, int number);

/** Whether path p has a neutral: 1, or 0 where it is always in its one gear. */
int gm_reduced_has_neutral(const gm_reduced_map *map, int p);

/** Index into map->configurations of the gears engaged in *state (a path that
 *  synchronises counts as neutral). */
int gm_reduced_configuration(const gm_reduced_map *map, const gm_reduced_state *state);

/** Start: commanded gears are engaged at once; angles and accounts are zero.
 *  w_o [rad/s]: speed of the output; w[n_paths]: speed of each path, used where the path
 *  is in neutral (an engaged path gets r_p w_o). Returns flags; an unknown gear counts as
 *  neutral and is flagged. */
int gm_reduced_start(const gm_reduced_map *map, const gm_reduced_inputs *inputs,
                     gm_real w_o, const gm_real *w, gm_reduced_state *state);

/** One step of h > 0 seconds. Returns flags. Bounded work whatever the inputs. */
int gm_reduced_step(const gm_reduced_map *map, const gm_reduced_params *params,
                    const gm_reduced_inputs *inputs, gm_real h, gm_reduced_state *state);

/** Accelerations, losses and energies of the state under the inputs at this instant
 *  (one-sided limits at standstill: the friction that holds or is overcome). Returns
 *  flags. Changes nothing but the caches in *state. */
int gm_reduced_outputs_at(const gm_reduced_map *map, const gm_reduced_params *params,
                          const gm_reduced_inputs *inputs, gm_reduced_state *state,
                          gm_reduced_outputs *outputs);

#ifdef __cplusplus
}
#endif
#endif
