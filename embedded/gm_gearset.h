/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The reduced gearset for a controller, a virtual sensor or a real-time rig, in four
 * calls: init, set, step, get.
 *
 *   gm_gearset g;                                    the caller's, as many as wanted
 *   gm_gearset_start start;
 *   gm_gearset_defaults(&gm_tables_map, &start);
 *   gm_gearset_init(&gm_tables_map, &start, &g);
 *   each cycle:
 *       gm_gearset_set(&inputs, &g);
 *       gm_gearset_step(&gm_tables_map, &g, h);
 *       gm_gearset_get(&gm_tables_map, &g, &outputs);
 *
 * Equations, stiction and fidelities are those of gm_reduced.h, the same files that the
 * FMU runs. No heap, no recursion, no input or output, no variables of its own; bounded
 * work whatever the inputs. A gearset holds no pointer: to copy it is to save it. Calls
 * for different gearsets may run at the same time.
 *
 * Angles, work and loss energy are sums over the whole run. The core integrates each
 * step from zero and the sums are kept here with twice the digits (gm_sum.h): with float
 * an angle neither sticks nor drifts.
 *
 * Units are SI: rad, rad/s, N.m, J, W, s, K. Paths are numbered 0, 1; a gearset of one
 * path leaves number 1 alone.
 */
#ifndef GM_GEARSET_H
#define GM_GEARSET_H

#include "gm_reduced.h"
#include "gm_sum.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct gm_gearset_start {
    gm_reduced_params params; /* fidelity, loss_scale >= 0, sync_torque > 0 [N.m] */
    int gear[GM_MAX_PATHS];   /* engaged from the beginning; 0 neutral */
    gm_real w_o;              /* speed of the output [rad/s] */
    gm_real w[GM_MAX_PATHS];  /* of paths in neutral; engaged ones turn with the output */
} gm_gearset_start;

/** One gearset. Members are private: use the calls. */
typedef struct gm_gearset {
    gm_reduced_params params;
    gm_reduced_inputs inputs;
    gm_reduced_state state; /* its sums are those of the last step only */
    gm_sum phi_o, phi[GM_MAX_PATHS], work, loss_energy;
    int flags; /* of the last init or step */
} gm_gearset;

typedef struct gm_gearset_outputs {
    gm_real w_o, w[GM_MAX_PATHS];    /* speeds [rad/s] */
    gm_sum phi_o, phi[GM_MAX_PATHS]; /* angles since the start [rad] */
    gm_real twist[GM_MAX_PATHS];     /* of engaged gears, 0 mid-lash [rad] */
    int mode[GM_MAX_PATHS];          /* gm_path_mode */
    gm_sum work, loss_energy;        /* since the start [J] */
    gm_real power;                   /* of all flanges into the gearset [W] */
    gm_reduced_outputs at;           /* accelerations, losses, energies, inertias */
    int flags;                       /* of the last init or step, and of this call */
} gm_gearset_outputs;

/** Everything at its default: rigid, the map's cone capacities, neutral where there is
 *  one, at rest. */
void gm_gearset_defaults(const gm_reduced_map *map, gm_gearset_start *start);

/** Begin a run. Returns flags of gm_reduced.h. GM_FLAG_NOT_FINITE: a number of *start is
 *  NaN, infinite or out of its range; the gearset is then at rest with defaults. */
int gm_gearset_init(const gm_reduced_map *map, const gm_gearset_start *start,
                    gm_gearset *g);

/** Torques [N.m], their slopes over the next step [N.m/s] and gear commands for the steps
 *  to come. Checked by the step. */
void gm_gearset_set(const gm_reduced_inputs *inputs, gm_gearset *g);

/** One step of h seconds, 0 < h <= 1. Returns flags. GM_FLAG_NOT_FINITE: an input or h is
 *  NaN, infinite or out of range, or a result overflowed; nothing has moved. */
int gm_gearset_step(const gm_reduced_map *map, gm_gearset *g, gm_real h);

/** What can be observed under the inputs as they are set. Returns flags; with
 *  GM_FLAG_NOT_FINITE *outputs is unchanged. */
int gm_gearset_get(const gm_reduced_map *map, gm_gearset *g, gm_gearset_outputs *outputs);

#ifdef __cplusplus
}
#endif
#endif
