/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What the parts of the reduced gearset share: the shafts over one sub-step, the loss
 * torques with their gradients, and the solution. Private to the core.
 *
 * Shafts are numbered 0, 1 for the paths and GM_OUT for the output. An engaged path has
 * no speed of its own unless it is elastic; "free" is a path in neutral or synchronising.
 */
#ifndef REDUCED_PARTS_H
#define REDUCED_PARTS_H

#include "gm_reduced_modes.h"
#include "reduced_cells.h"

/* Sub-steps that a vibration may ask for in one step. */
enum { GM_PARTS = 2 };

enum { GM_OUT = GM_MAX_PATHS, GM_SHAFTS = GM_MAX_PATHS + 1 };

/* N.m at the input flange. From here on a cone capacity counts as infinite: engagement at
 * once, as it would be within microseconds. */
#define GM_SYNC_AT_ONCE GM_NUM(1e12)

/* The state without its caches: what a step computes and then commits or drops. */
typedef struct gm_motion {
    gm_real phi_o, w_o, brake, rest_o;
    gm_path_state path[GM_MAX_PATHS];
    gm_real work, loss_energy;
} gm_motion;

/* One way of a spring: the sub-step, the mean slip over it, what is late (0: the middle,
 * 1: all at its end), the damping where it begins; h = 0: at this instant, not late. */
typedef struct gm_stride {
    gm_real h, slip, late, damping; /* s, rad/s, 0 .. 1, N.m.s/rad */
} gm_stride;

typedef struct gm_spring {
    gm_real torque, slope; /* T at the path's flange [N.m]; dT/dslip */
    gm_real power;         /* lost [W] */
} gm_spring;

/** Damping of a gear's spring at a twist [rad] and slip [rad/s]: N.m.s/rad. */
gm_real gm_spring_damping(const gm_gear *gear, gm_real twist, gm_real slip);

/** Mean torque of a gear's spring from a twist on [rad]. */
gm_spring gm_spring_at(const gm_gear *gear, gm_real twist, const gm_stride *stride);

/* How it changes at an instant. */
typedef struct gm_spring_gradient {
    gm_real torque_twist, torque_slip; /* N.m/rad, N.m.s/rad */
    gm_real power_twist, power_slip;   /* W/rad, W.s/rad */
} gm_spring_gradient;

gm_spring_gradient gm_spring_gradient_at(const gm_gear *gear, gm_real twist,
                                         gm_real slip);

/** Torque of a gear's spring where it does not move [N.m]. */
gm_real gm_spring_rest_torque(const gm_gear *gear, gm_real twist);

/* How the slips of elastic paths yield to their springs: slip_p = free_p - sum_q
 * y[p][q] (T_q - reference_q). */
typedef struct gm_yield {
    gm_real free[GM_MAX_PATHS], y[GM_MAX_PATHS][GM_MAX_PATHS];
} gm_yield;

/** Elastic energy at a twist [J]. */
gm_real gm_spring_energy(const gm_gear *gear, gm_real twist);

/** Whether a gear's spring acts. */
static inline int gm_is_elastic(const gm_reduced_params *params, const gm_gear *gear)
{
    return params->fidelity == GM_LASH && gear->stiffness > 0;
}

/* Constant over one sub-step. Path quantities are [p], output's are [GM_OUT]. */
typedef struct gm_drive {
    const gm_reduced_map *map;
    const gm_configuration *configuration;
    gm_reduced_cache *cache;
    int index; /* of the configuration */
    int n_paths;
    int coupled; /* the coupling C acts outside P */
    int engaged[GM_MAX_PATHS], free[GM_MAX_PATHS];
    int elastic[GM_MAX_PATHS];         /* engaged, through its spring */
    int own[GM_MAX_PATHS];             /* free or elastic: has a speed of its own */
    gm_real twist[GM_MAX_PATHS];       /* at the start of the sub-step */
    gm_real damping[GM_MAX_PATHS];     /* of elastic paths, likewise */
    const gm_gear *gear[GM_MAX_PATHS]; /* engaged or being synchronised, else NULL */
    int gear_index[GM_MAX_PATHS];      /* of that gear in its path */
    gm_real ratio[GM_MAX_PATHS];       /* of that gear, else 0 */
    gm_real cone[GM_MAX_PATHS];        /* T_c, signed [N.m] */
    gm_real inertia[GM_SHAFTS];        /* J_p; J_s of the configuration at the output */
    gm_real inertia_own;               /* J_s without the engaged paths' r^2 J_p */
    gm_real w[GM_SHAFTS];              /* at the start of the sub-step */
    gm_real tau[GM_SHAFTS];    /* flange torques, mean of the sub-step; of prescribed
                                 flanges once the motion is solved */
    int prescribed[GM_SHAFTS]; /* moves as it is told, */
    gm_real given[GM_SHAFTS];  /* with this acceleration */
    gm_real brake;             /* the last step's, a first guess [N.m] */
    gm_real scale;             /* loss_scale */
    gm_real h;                 /* s; 0: at this instant */
    gm_real mean;              /* mean speeds are those this long into the sub-step [s] */
    gm_real late;              /* 2 mean/h - 1, of 0 .. 1: 0 but in too long sub-steps */
    gm_real stiff; /* of the elastic paths: sum of k (1/J_p + r2/J_o) [1/s2] */
} gm_drive;

/* Where the tables are read: accelerations, mid-step speeds, transmitted torques. */
typedef struct gm_point {
    gm_real a[GM_SHAFTS]; /* dw/dt; of free paths and of the output */
    gm_real m[GM_SHAFTS]; /* mean speeds of the sub-step; engaged paths r_p m_o */
    gm_real tau_m[GM_MAX_PATHS];
    gm_real spring[GM_MAX_PATHS]; /* T of elastic paths [N.m] */
} gm_point;

/* Loss torques of one path with their gradients. Signed: positive brakes forward. */
typedef struct gm_path_terms {
    gm_real load, load_o, load_tau;           /* sigma_p D; d/dw_o, d/dtau_m */
    gm_real drag, drag_n, drag_o;             /* N or pin; d/dw_n, d/dw_o */
    gm_real pin, pin_o;                       /* amount of its pin; d/dw_o */
    gm_real reaction, reaction_n, reaction_o; /* R */
} gm_path_terms;

typedef struct gm_terms {
    gm_real out, out_o, out_tau[GM_MAX_PATHS]; /* sigma (P + X); d/dw_o, d/dtau_m,p */
    gm_real coupling, coupling_w;              /* C(w_0 - w_1) and its slope */
    gm_real coupling_a;                        /* and its gradient to dw_0/dt - dw_1/dt */
    gm_path_terms path[GM_MAX_PATHS];
    int outside;
} gm_terms;

typedef struct gm_solution {
    gm_real slip[GM_MAX_PATHS];     /* of elastic paths, */
    gm_spring spring[GM_MAX_PATHS]; /* and their springs there */
    gm_real lead; /* when in the sub-step C is read: theta h, see reduced_terms.c */
    gm_point point;
    gm_terms terms;          /* the very torques of the momentum balance */
    gm_real sign[GM_SHAFTS]; /* direction of rotation assumed: +1, -1; 0: prescribed and
                                at rest, no friction acts */
    int held[GM_SHAFTS];     /* 1: at rest, friction holds it */
    int barred[GM_SHAFTS]; /* 1: was let go in this solution and did not move that way */
    int passes;            /* that the step has left; at none a solution takes one */
    int warm;              /* 1: point.a is that of a similar motion and a first guess */
} gm_solution;

static inline gm_real gm_abs(gm_real x)
{
    return x < 0 ? -x : x;
}

static inline gm_real gm_not_below_zero(gm_real x)
{
    return x > 0 ? x : 0;
}

static inline int gm_is_finite(gm_real x)
{
    return x - x == 0;
}

static inline int gm_direction(gm_real sign)
{
    return sign < 0 ? GM_BACKWARD : GM_FORWARD;
}

/* Relative size of the bilinear remainder cxy du dv that a step may leave out. It is of
 * second order in the step, like the method; the bound matters for large steps only. */
#define GM_REMAINDER GM_NUM(1e-4)
#define GM_REMAINDER_NM                                                                  \
    GM_BY_TYPE(1e-9, 1e-5) /* N.m, where the torque itself passes through zero */

/** Whether a remainder may be left out beside a value. */
static inline int gm_is_small(gm_real rest, gm_real value)
{
    return gm_abs(rest) <= GM_REMAINDER * gm_abs(value) + GM_REMAINDER_NM;
}

/** Gear engaged or being synchronised on path p; NULL in neutral. */
const gm_gear *gm_motion_gear(const gm_reduced_map *map, const gm_motion *s, int p);

/** Whether path p has a speed of its own: it is free or elastic. */
int gm_has_own_speed(const gm_reduced_map *map, const gm_reduced_params *params,
                     const gm_motion *s, int p);

/** J_s: inertia that turns with the output [kg.m2]. */
gm_real gm_motion_inertia(const gm_reduced_map *map, const gm_reduced_params *params,
                          const gm_motion *s);

/** Index into map->configurations; paths[n_paths]. */
int gm_configuration_index(const gm_reduced_map *map, const gm_path_state *paths);

/** Fill *d for the present motion; torques and length follow with gm_set_span. */
void gm_make_drive(const gm_reduced_map *map, const gm_reduced_params *params,
                   const gm_motion *s, gm_reduced_cache *cache, gm_drive *d);

/** Whether the vibrations of elastic paths are followed in a step of h seconds cut into
 *  so many parts: (omega h / parts)^2 <= 4. */
static inline int gm_is_followed(const gm_drive *d, gm_real h, int parts)
{
    return d->stiff * h * h <= (gm_real)(4 * parts * parts);
}

/** Mean flange torques over h seconds that begin t seconds into the step. */
void gm_set_span(const gm_reduced_inputs *in, gm_real t, gm_real h, gm_drive *d);

/** Power of all loss torques of *s at its mean speeds, cones included [W]. */
gm_real gm_loss_power(const gm_drive *d, const gm_solution *s);

/** Cone torque of path p at a slip of this sign [N.m]. */
gm_real gm_cone_torque(const gm_reduced_params *params, int p, gm_real slip);

/** What can be observed of a solution at an instant (d->h = 0); flags as
 *  gm_reduced_outputs_at. The holding torques of *s are completed. */
int gm_observe(const gm_drive *d, gm_solution *s, gm_reduced_outputs *outputs);

/** Whether all of them are numbers. */
int gm_outputs_are_finite(const gm_reduced_outputs *o);

/** While friction holds the output: the direction it would break away in, the terms there
 *  in *t, and the share of them that it takes. */
int gm_holding(const gm_drive *d, const gm_solution *s, gm_terms *t, gm_real *share);

/** Speeds that are prescribed; what turns with the output follows. */
void gm_take_prescribed(const gm_reduced_map *map, const gm_reduced_params *params,
                        const gm_reduced_inputs *in, gm_motion *s);

/** Whether shaft k moves by the balance of torques on it. */
static inline int gm_moves(const gm_drive *d, const gm_solution *s, int k)
{
    return (k == GM_OUT || d->own[k]) && !d->prescribed[k] && !s->held[k];
}

/** Torques that prescribed flanges take, from a solution. */
void gm_complete_torques(gm_drive *d, const gm_solution *s);

/** The part of the state that a step computes, and back. */
gm_motion gm_load_motion(const gm_reduced_state *state);
void gm_store_motion(const gm_motion *s, gm_reduced_state *state);

/** Whether all inputs, all of the motion are numbers that can be computed with. */
int gm_inputs_are_finite(const gm_reduced_map *map, const gm_reduced_inputs *in);
int gm_motion_is_finite(const gm_reduced_map *map, const gm_motion *s);

/** Path p leaves its gear for neutral or begins to synchronise, if the command says so.
 *  Returns a flag when there is no such gear: nothing changes then. */
int gm_command_gear(const gm_reduced_map *map, const gm_reduced_params *params, int p,
                    int number, gm_motion *s);

/** Shaft k stands; what kinetic energy it had goes into the losses. */
void gm_bring_to_rest(const gm_reduced_map *map, const gm_reduced_params *params, int k,
                      gm_motion *s);

/** Path p, which is engaged, lets go of its gear: it is in neutral from here on. What an
 *  elastic path stores is lost; the gear's own inertia J_g changes speeds and energy. */
void gm_release(const gm_reduced_map *map, const gm_reduced_params *params, int p,
                gm_motion *s);

/** Path p and the output meet in one impulse that conserves momentum; the kinetic energy
 *  that goes is lost. The path is engaged from here on. */
void gm_engage(const gm_reduced_map *map, const gm_reduced_params *params, int p,
               gm_motion *s);

/* Part of a step: rest seconds, from start seconds into it; last: events do not end it.
 */
typedef struct gm_span {
    gm_real start, rest, step; /* step: the whole */
    int last;
} gm_span;

/** One sub-step of at most span->rest; it ends at the first event unless span->last.
 *  *solution: of the sub-step before, or its passes set and warm 0. Returns its length.
 */
gm_real gm_substep(const gm_reduced_map *map, const gm_reduced_params *params,
                   const gm_reduced_inputs *in, const gm_span *span,
                   gm_reduced_cache *cache, gm_motion *s, gm_solution *solution);

/** What no path and no coupling adds to. */
void gm_clear_terms(gm_terms *terms);

/** Table values at *point for the directions in *s: fills s->terms; point->tau_m is
 *  completed first. Terms of held shafts are zero: R(0, w_o) = 0, and what holds the
 *  output or a path is not needed for the motion. */
void gm_terms_at(const gm_drive *d, gm_solution *s, gm_point *point);

/** What a kelvin more of oil temperature makes of the torques in s->terms, which were
 *  read at s->point, in *t; its gradients mean nothing. */
void gm_terms_by_oil(const gm_drive *d, const gm_solution *s, gm_terms *t);

/** Terms on the output and the load losses for direction sign of the output (terms->out
 *  and terms->path[].load of engaged paths) at point. */
void gm_output_terms(const gm_drive *d, gm_real sign, const gm_point *point,
                     gm_terms *terms);

/** The same torques, without gradients, where the output is about to leave rest in
 *  direction sign; point->m[GM_OUT] is 0. */
void gm_output_terms_at_rest(const gm_drive *d, gm_real sign, const gm_point *point,
                             gm_terms *terms);

/** How fast the two paths' speeds part: dw_0/dt - dw_1/dt. */
static inline gm_real gm_parting(const gm_drive *d, const gm_point *at)
{
    return (d->own[0] ? at->a[0] : d->ratio[0] * at->a[GM_OUT]) -
           (d->own[1] ? at->a[1] : d->ratio[1] * at->a[GM_OUT]);
}

/** Mean slip of an elastic path over the sub-step. */
static inline gm_real gm_slip(const gm_drive *d, const gm_point *at, int p)
{
    return at->m[p] - d->ratio[p] * at->m[GM_OUT];
}

/** Torques of all springs that fit the slips they cause. In: s->slip and s->spring,
 *  where the springs are read first; s->point.spring, the reference. Out: the slips,
 *  the springs there, and the torques in s->point.spring. */
void gm_springs_meet(const gm_drive *d, const gm_yield *yield, gm_solution *s);

/** Pin and transmitted torque of elastic path p, for direction sign_o of the output, with
 *  the spring's torque at *point. */
void gm_pin_terms(const gm_drive *d, const gm_solution *s, int p, gm_real sign_o,
                  gm_point *point, gm_terms *terms);

/** Pin of elastic path p that breaks away in direction sign: terms->path[p].drag. */
void gm_pin_friction(const gm_drive *d, int p, gm_real sign, const gm_point *point,
                     gm_terms *terms);

/** N and R of free path p for the directions of the path and of the output. */
void gm_drag_terms(const gm_drive *d, int p, gm_real sign_n, gm_real sign_o,
                   const gm_point *point, gm_terms *terms);

/** N at standstill of free path p that is about to turn in direction sign_n; R is zero
 *  there. */
gm_real gm_drag_at_rest(const gm_drive *d, int p, gm_real sign_n, gm_real sign_o,
                        const gm_point *point, int *outside);

/** Part of gm_terms_hold for free path p. */
int gm_drag_holds(const gm_drive *d, const gm_solution *s, int p, const gm_point *from,
                  const gm_point *next);

/** Whether the linearised terms of s hold from point to next as well: every table read
 *  stays in its cell, and what the gradients leave out of its bilinear surface is small.
 */
int gm_terms_hold(const gm_drive *d, gm_solution *s, const gm_point *point,
                  const gm_point *next);

/** What is left of the torques on the output, on path p, beyond inertia [N.m]. */
gm_real gm_output_balance(const gm_drive *d, const gm_terms *terms,
                          const gm_point *point);
gm_real gm_path_balance(const gm_drive *d, const gm_terms *terms, const gm_point *point,
                        int p);

/* A pivot below this part of the inertia means that falling gradients or dD/dtau near 1
 * leave no unique solution: gradients are dropped then. */
#define GM_PIVOT_LIMIT GM_NUM(0.1)

void gm_drop_gradients(gm_terms *terms);

/** Changes of the accelerations at point [GM_SHAFTS] that bring the linearised balances
 *  to zero, with the springs' torques in s->point. May drop gradients of s->terms. */
void gm_newton_change(const gm_drive *d, gm_solution *s, const gm_point *point,
                      gm_real *change);

/* Passes of one solution. */
enum { GM_PASSES = 40 };

/** Motion over d->h from the speeds d->w: accelerations, held shafts, loss torques. In:
 *  s->passes, s->warm. */
void gm_solve(const gm_drive *d, gm_solution *s);

/** The same for the directions of rotation and the held shafts that *s has. */
void gm_solve_given(const gm_drive *d, gm_solution *s);

/** Torque on shaft k at rest minus the friction it must overcome to break away in
 *  direction sign: it does when > 0 for sign = 1, < 0 for sign = -1. *terms receives the
 *  loss torques at that break-away. */
gm_real gm_excess(const gm_drive *d, const gm_solution *s, int k, gm_real sign,
                  gm_terms *terms);

/** Motion at this instant in the given modes; NULL: in those that a step would find. */
void gm_solve_at(const gm_reduced_map *map, const gm_reduced_params *params,
                 const gm_reduced_inputs *in, const gm_reduced_modes *modes,
                 gm_reduced_state *state, gm_drive *d, gm_solution *s);

/** What the losses of the solution take from the torque on the output [N.m]. */
gm_real gm_brake(const gm_drive *d, const gm_solution *s);

#endif
