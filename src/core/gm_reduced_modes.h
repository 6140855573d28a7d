/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The reduced gearset as an ordinary differential equation with events, for a solver that
 * steps it from outside (Model Exchange). The physics is that of gm_reduced.h; what a
 * step decides by itself is here a mode that changes at events only:
 *
 *   shaft (output, free path)   turns forward, turns backward, or is held by friction
 *   cone                        sign of its slip while a path synchronises
 *
 * Between events the modes are given, the rates are continuous and a held shaft has the
 * speed zero to the last bit. An event is told by an indicator that falls to zero or
 * below:
 *
 *   turning shaft    its speed in the direction of the mode
 *   held shaft       the distance of the torque on it to the nearer end of what friction
 *                    can hold
 *   cone             its slip in the direction of the mode
 *   map              1 inside, -1 outside
 *
 * GM_INDICATOR_MARGIN keeps them away from zero where a mode begins: a shaft that breaks
 * away starts at speed zero. What a free path does next to a drag line is a ramp and the
 * edges of table cells are kinks, so neither is an event.
 *
 * One call of gm_reduced_modes_update leads from any event to modes that agree with the
 * rates; there is nothing to iterate. It looks for them as a step does, by the bounded
 * search in reduced_solve.c.
 */
#ifndef GM_REDUCED_MODES_H
#define GM_REDUCED_MODES_H

#include "gm_reduced.h"

#ifdef __cplusplus
extern "C" {
#endif

/* In the unit of an indicator: 100 rad/s, 100 N.m at a path, 1000 N.m at the output. */
#define GM_INDICATOR_MARGIN GM_NUM(1e-9)

enum { GM_OUTPUT_SHAFT = GM_MAX_PATHS, GM_MODE_SHAFTS = GM_MAX_PATHS + 1 };

/** Modes beside those in gm_path_state. Zeroed: unknown, to be found by an update. */
typedef struct gm_reduced_modes {
    int direction[GM_MODE_SHAFTS]; /* of path 0, 1 and the output: 1, -1; 0 held (or an
                                      engaged path, which goes with the output) */
    int slip[GM_MAX_PATHS];        /* sign of w_p - r w_o while synchronising, else 0 */
    int outside;                   /* 1: the map was left when the modes were found */
} gm_reduced_modes;

/** Number of event indicators: each path's shaft, each path's cone, output, map. */
int gm_reduced_indicators(const gm_reduced_map *map);
enum { GM_MAX_INDICATORS = 2 * GM_MAX_PATHS + 2 };

/** Treat what has happened: gear commands, shafts that have come to rest, cones whose
 *  slip is gone, and find modes that agree with the rates. Engagement conserves momentum;
 *  what energy it and a shaft's coming to rest cost is added to the losses. *jumped
 *  tells whether speeds or energies in *state changed. Returns flags of gm_reduced.h;
 *  with GM_FLAG_NOT_FINITE nothing was changed. */
int gm_reduced_modes_update(const gm_reduced_map *map, const gm_reduced_params *params,
                            const gm_reduced_inputs *inputs, gm_reduced_state *state,
                            gm_reduced_modes *modes, int *jumped);

/** Accelerations, losses and energies in the given modes. Returns flags. Changes nothing
 *  but the caches in *state. */
int gm_reduced_modes_outputs(const gm_reduced_map *map, const gm_reduced_params *params,
                             const gm_reduced_inputs *inputs,
                             const gm_reduced_modes *modes, gm_reduced_state *state,
                             gm_reduced_outputs *outputs);

/** Event indicators z[gm_reduced_indicators]; those that do not apply are 1. Returns
 *  flags. Changes nothing but the caches in *state. */
int gm_reduced_modes_indicators(const gm_reduced_map *map,
                                const gm_reduced_params *params,
                                const gm_reduced_inputs *inputs,
                                const gm_reduced_modes *modes, gm_reduced_state *state,
                                gm_real *z);

#ifdef __cplusplus
}
#endif
#endif
