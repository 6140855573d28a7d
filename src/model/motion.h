/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The gearset in motion, as the files motion*.c share it.
 *
 * Order of the states: speeds of the nodes, deflections of the rows (meshes, locks,
 * pieces of shafts that twist), then the bristles of bearings with elastic friction.
 */
#ifndef MOTION_H
#define MOTION_H

#include "model/contact.h"
#include "model/gearset.h"
#include "model/gm_motion.h"
#include "model/nodes.h"

/** An elastic row over nodes. */
typedef struct gm_motion_row {
    gm_row row;
    gm_contact_law law;
    int closed; /* 0: an open lock, no force and no motion */
} gm_motion_row;

typedef enum gm_lock_mode {
    GM_LOCK_OPEN,
    GM_LOCK_SYNCHRONISING, /* its cones rub */
    GM_LOCK_CLOSED
} gm_lock_mode;

typedef struct gm_motion_lock {
    const char *name;
    gm_lock what;    /* idling gear, clutch or brake */
    int row;         /* its row */
    double capacity; /* of its cones, N.m along the row */
    double scale;    /* factor on it */
    gm_lock_mode mode;
    double sense; /* +-1: sign of its relative speed when synchronising began */
} gm_motion_lock;

/** Two nodes that rub against each other; on < 0: the housing. */
typedef struct gm_motion_pair {
    int node, on;
} gm_motion_pair;

/** Speed of what the pair's node rubs against. */
static inline double gm_motion_speed_on(const gm_motion_pair *pair, const double *w)
{
    return pair->on < 0 ? 0.0 : w[pair->on];
}

/** Friction at the present state: acts against `speed` with `torque`. Meshes: force
 *  along the line of action, against the rolling speed. */
typedef struct gm_motion_friction {
    double speed;   /* rad/s, m/s; signed */
    double torque;  /* N.m, N */
    double d_speed; /* d torque / d speed */
    double d_force; /* meshes: by the row force */
    double loss;    /* W */
} gm_motion_friction;

/** What a bearing has besides. */
typedef struct gm_motion_bearing {
    gm_motion_pair pair;
    int state;                /* of its bristle; -1: it has none */
    gm_bearing_speed law;     /* factors at the present speed */
    double radial, axial;     /* loads of one of them, N */
    double d_radial, d_axial; /* d torque / d load */
    gm_bearing_state bristle;
} gm_motion_bearing;

/** Compressed columns of the Jacobian; `at` finds an entry by row and column. */
typedef struct gm_motion_pattern_data {
    int n, n_entries;
    int *column_start; /* [n + 1] */
    int *row;          /* [n_entries] */
    int *at;           /* [n][n]: its number, -1 where there is none */
} gm_motion_pattern_data;

struct gm_motion {
    const gm_gearset *gearset;
    gm_nodes nodes;
    int n_nodes, n_rows, n_locks, n_bristles, n_states;
    const double *inertia; /* [n_nodes] kg.m2, of the nodes */
    gm_motion_row *rows;
    gm_row *roll;               /* [n_meshes] over nodes */
    gm_motion_bearing *bearing; /* [n_bearings] */
    gm_motion_pair *drag;       /* [n_drags] */
    gm_motion_lock *locks;
    int flange[GM_MAX_FLANGES]; /* node */
    int gear[GM_MAX_INPUT_PATHS];
    double jump_loss;
    double loss_scale; /* factor on all friction */
    gm_motion_pattern_data pattern;
    int n_signals;
    gm_motion_signal *signals; /* names owned */
    /* at the state evaluated last; known 0: in other modes than now */
    int known;
    double *x;                         /* [n_states] */
    gm_contact_force *contact;         /* [n_rows] */
    double *rate;                      /* [n_rows] g . w */
    double *force;                     /* [n_rows] */
    gm_motion_friction *mesh_friction; /* [n_meshes] */
    gm_motion_friction *bearing_friction;
    gm_motion_friction *drag_friction;
    double *torque;             /* [n_nodes] */
    double *d_radial, *d_axial; /* [n_meshes] scratch */
};

/** Build nodes, rows, pairs and locks (motion_rows.c). */
GM_NODISCARD gm_status gm_motion_make_rows(gm_motion *motion, gm_error *error);

/** gm_path_mode of core/gm_reduced.h that path p is in (motion_modes.c). */
int gm_motion_path_mode(const gm_motion *motion, int p);

/** Torque of a lock's cones along its row. */
static inline double gm_motion_cone_torque(const gm_motion_lock *lock)
{
    return lock->mode == GM_LOCK_SYNCHRONISING
               ? lock->sense * lock->scale * lock->capacity
               : 0.0;
}

/** Find the pattern of the Jacobian (motion_jacobian.c). */
GM_NODISCARD gm_status gm_motion_make_pattern(gm_motion *motion, gm_error *error);

/** Names of all signals (motion_signals.c). */
GM_NODISCARD gm_status gm_motion_make_signals(gm_motion *motion, gm_error *error);
void gm_motion_clear_signals(gm_motion *motion);

/** Forces of all rows and friction of all elements at x: what stands under "evaluated
 *  last". Nothing is done where that is known. */
void gm_motion_evaluate(gm_motion *motion, const double *x);

/** After the forces: friction of all elements at x (motion_friction.c). */
void gm_motion_friction_at(gm_motion *motion, const double *x);

/** Add the torques of friction to torque[n_nodes]; its power [W] and what bristles store
 *  [J]. */
void gm_motion_add_friction(const gm_motion *motion, double *torque);
double gm_motion_friction_power(const gm_motion *motion);
double gm_motion_bristle_energy(const gm_motion *motion);

/** Relative speed of a row. */
static inline double gm_row_speed(const gm_row *row, const double *w)
{
    double v = 0.0;
    for (int k = 0; k < row->n; k++)
        v += row->g[k] * w[row->body[k]];
    return v;
}

/** Add -g f to torque. */
static inline void gm_row_apply(const gm_row *row, double f, double *torque)
{
    for (int k = 0; k < row->n; k++)
        torque[row->body[k]] -= row->g[k] * f;
}

#endif
