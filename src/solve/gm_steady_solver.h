/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The steady experiment: KINSOL with the plant's sparse Jacobian, started from the last
 * solution or from the plant's own predictor. One solver per thread.
 */
#ifndef GM_STEADY_SOLVER_H
#define GM_STEADY_SOLVER_H

#include "plant/gm_plant.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct gm_steady_solver gm_steady_solver;

GM_NODISCARD gm_status gm_steady_solver_create(const gm_plant *plant,
                                               gm_steady_solver **solver,
                                               gm_error *error);
void gm_steady_solver_destroy(gm_steady_solver *solver);

/** The plant that the solver works on. */
const gm_plant *gm_steady_solver_plant(const gm_steady_solver *solver);

/** Forget the last solution, so that a grid line's results depend on the line alone. */
void gm_steady_solver_restart(gm_steady_solver *solver);

/** Solve one point: no balance of torques is open by more than 1e-12 of the largest
 *  flange torque (1e-11 where rounding leaves more). GM_ERR_SOLVE with the point in the
 *  sentence when it does not converge. */
GM_NODISCARD gm_status gm_steady_solve(gm_steady_solver *solver,
                                       const gm_steady_point *point,
                                       gm_steady_result *result, gm_error *error);

/** Speed and state of a path in neutral that nothing drives but the drag of its gears.
 *  The point's speed and direction of that path are ignored; found and stored there. */
typedef struct gm_free_path {
    double speed; /* rad/s */
    int sticks;   /* 1: held by friction, at rest or to one of its gears */
} gm_free_path;

/** Find the speed at which the torque at path p's flange is zero, exactly also where
 *  friction holds (at rest, or turning with a gear). */
GM_NODISCARD gm_status gm_steady_solve_free(gm_steady_solver *solver, int p,
                                            gm_steady_point *point,
                                            gm_free_path *free_path,
                                            gm_steady_result *result, gm_error *error);

/** The workspace and the unknowns of the last solved point, for reading losses. */
void *gm_steady_solver_work(gm_steady_solver *solver, const double **x);

#ifdef __cplusplus
}
#endif
#endif
