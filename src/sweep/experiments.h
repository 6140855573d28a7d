/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The experiments: what the tables hold, from steady points of the detailed gearset. T_o
 * and tau_p are the torques into the gearset; the balance that the reduced gearset
 * fulfils at constant speed (core/gm_reduced.h with a = 0) is solved for the quantity
 * wanted. Neutral paths are at rest (speed 0, direction 0) except where a row turns them.
 *
 *   C(d)      = [tau_0(w_1 = -d) - tau_0(w_1 = +d)] / 2, both paths in neutral, path 0
 *               and output at 0+: the odd part of tau_0 over the relative speed
 *               d = w_0 - w_1
 *   P_s       = sigma T_o where the engaged paths transmit nothing, tau_m,p = 0
 *   |r_p| D_p = sigma (T_o + r_p tau_m,p) - P_s, the other path at rest
 *   X_s       = sigma (T_o + sum r_p tau_p) - P_s - sum |r_p| D_p, both paths engaged
 *   N         = tau_n - C(w_n),  R = T_o(w_n, w_o) - T_o(0, w_o), both in neutral
 *   jump      = N just above minus N just below a drag line w_n = r w_o
 *
 * N and R are stored without the steps on the lines (core/gm_reduced.h adds them back as
 * ramps):
 *   N_smooth = N - sum jump / 2 sgn(w_n - r w_o)
 *   R_smooth = R + sum r jump / 2 [sgn(w_n - r w_o) - sgn(-r w_o)]
 */
#ifndef EXPERIMENTS_H
#define EXPERIMENTS_H

#include "sweep/plan.h"
#include "sweep/points.h"
#include "sweep/refine.h"

/** What a unit's tables hold between their nodes, at coordinates x of its axes, for each
 *  slice of the map one after the other:
 *    D and P  value[0]: P / |r_p| + D, the loss at the path's flange; value[1]: D
 *    N and R  value[0]: N, value[1]: R, both without the steps on the lines
 *    others   value[0]: what the table holds
 *  Sizes are those of the torques that the values are a part of: the loss of the gearset
 *  at the same flange, the torque at a flange that turns free. GM_ERR_SOLVE with the
 *  point when it does not converge; what gm_point_solve answers. */
GM_NODISCARD gm_status gm_experiment_at(const gm_sweep_plan *plan, const gm_unit *unit,
                                        const double *x, gm_point_solver *solver,
                                        gm_sample *sample, gm_error *error);

/** Solve the points of a row and write it into the unit's tables. Threads may run
 *  different rows of a phase at once. */
GM_NODISCARD gm_status gm_experiment_row(const gm_sweep_plan *plan, const gm_unit *unit,
                                         int row, gm_point_solver *solver,
                                         gm_error *error);

#endif
