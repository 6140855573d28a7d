/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The points of a sweep: every operating point is solved once, from the plant's own
 * predictor, so that its result depends on nothing but the point; it is then known to all
 * experiments and, where the sweep has a file, kept in the journal. A repeated sweep
 * takes up what the journal holds.
 */
#ifndef POINTS_H
#define POINTS_H

#include "map/gm_map_file.h"
#include "solve/gm_steady_solver.h"
#include "sweep/gm_sweep.h"

typedef struct gm_points gm_points;

/** Empty, or with the points of the journal beside path; path NULL: in memory only. map:
 *  names, gears and options, as gm_journal_open wants them. */
GM_NODISCARD gm_status gm_points_open(const char *path, const gm_map *map,
                                      gm_points **points, gm_error *error);

/** The map is complete: see gm_journal_finish; without a file only the hash is made. */
GM_NODISCARD gm_status gm_points_finish(gm_points *points, gm_map *map, gm_error *error);

/** keep: the journal stays, to be resumed. NULL is fine. */
void gm_points_close(gm_points *points, bool keep);

/** Called between points, from one thread at a time and not more often than ten times a
 *  second; what it answers other than GM_OK ends gm_point_solve. */
typedef gm_status (*gm_points_watch)(void *user, gm_error *error);
void gm_points_set_watch(gm_points *points, gm_points_watch watch, void *user);

/** Points that are known, and how many of them came from the journal. Thread-safe. */
long gm_points_count(gm_points *points);
long gm_points_resumed(const gm_points *points);

/** From now on points of a measured plant that fail are skipped: their torques are NaN,
 *  and they are not in the journal. */
void gm_points_allow_skips(gm_points *points);

/** What was skipped, as sentences with point and reason, in the order of these; they
 *  belong to the points. */
int gm_points_skipped(const gm_points *points, const gm_skipped_point **skipped);

/** The largest uncertainty of a torque that was measured, N.m; 0: all were solved. */
double gm_points_uncertainty(const gm_points *points);

/** A thread's way to the points. */
typedef struct gm_point_solver gm_point_solver;

/** For plants[n] that differ in their oil temperature only; they must outlive it. */
GM_NODISCARD gm_status gm_point_solver_create(gm_points *points, int n,
                                              const gm_plant *const *plants,
                                              gm_point_solver **solver, gm_error *error);

/** From now on points are those of plant number i; it begins with 0. */
void gm_point_solver_choose(gm_point_solver *solver, int i);

/** What was solved and not flushed is known, but not in the journal. */
void gm_point_solver_destroy(gm_point_solver *solver);

/** The result at a point: a known one, else solved now. Points go to the journal some at
 *  a time, but at most 20 ms after they were solved while the thread goes on; the last
 *  ones with gm_point_solver_flush. GM_ERR_SOLVE, GM_ERR_IO, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_point_solve(gm_point_solver *solver,
                                      const gm_steady_point *point,
                                      gm_steady_result *result, gm_error *error);
GM_NODISCARD gm_status gm_point_solver_flush(gm_point_solver *solver, gm_error *error);

#endif
