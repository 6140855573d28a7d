/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Error control of a sweep: a refinement (refine.h) for every unit of a phase, all of
 * them in step, so that as many points as possible are wanted at once. A unit's share of
 * the tolerance leaves room for the tables that are added to it:
 *
 *   D with P, N, R, X   most of it; relative to the largest loss of the gear (of the
 *                       configuration), drag and reaction to the largest of theirs
 *   P with both paths engaged, C, jumps   a quarter: they come on top
 */
#ifndef CONTROL_H
#define CONTROL_H

#include "sweep/experiments.h"

typedef struct gm_control_tolerance {
    double share;  /* of the largest loss */
    double torque; /* N.m at a path's flange */
} gm_control_tolerance;

/** What the refinement of a unit begins with and has to reach, in all slices. output: of
 *  P with all paths engaged the tolerances at the output [N.m], [slices], from the load
 *  losses of its gears; else NULL. */
void gm_control_spec(const gm_sweep_plan *plan, const gm_unit *unit,
                     const gm_control_tolerance *tolerance, const double *output,
                     gm_refine_spec *spec);

typedef struct gm_control gm_control;

/** The plan must outlive it. GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_control_create(gm_sweep_plan *plan,
                                         const gm_sweep_options *options,
                                         gm_control **control, gm_error *error);
void gm_control_destroy(gm_control *control);

/** Begin with the units of a phase; the phases before it must be in the map. */
GM_NODISCARD gm_status gm_control_begin(gm_control *control, int phase, gm_error *error);

/** Lots of points that are wanted now: how many lots; and how many points in lot i. Lots
 *  may be sampled by different threads. */
GM_NODISCARD gm_status gm_control_lots(gm_control *control, int *n, gm_error *error);
int gm_control_lot_size(const gm_control *control, int i);
GM_NODISCARD gm_status gm_control_sample(gm_control *control, int i,
                                         gm_point_solver *solver, gm_error *error);

/** All lots are sampled: let the units find out what they want next. Units (as many as
 *  the plan has) may be advanced by different threads. */
GM_NODISCARD gm_status gm_control_advance(gm_control *control, int unit, gm_error *error);

/** The phase is done: give its tables their axes. */
GM_NODISCARD gm_status gm_control_end(gm_control *control, gm_error *error);

/** Largest error at held-out points, of the largest loss, over the units of the phase;
 *  NAN when none were compared so far. Not while units are advanced. */
double gm_control_worst(const gm_control *control);

/** Tables that missed the tolerance, by symbol: missed[GM_SYMBOLS]; see gm_sweep.h. */
void gm_control_missed(const gm_control *control, gm_sweep_missed *missed);

#endif
