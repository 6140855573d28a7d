/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The experiments: one row of a table from steady points of the detailed gearset. T_o and
 * tau_p are the torques into the gearset; the balance that the reduced gearset fulfils at
 * constant speed (core/gm_reduced.h with a = 0) is solved for the quantity wanted.
 * Neutral paths are at rest (speed 0, direction 0) except where a row turns them.
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

#include "solve/gm_steady_solver.h"
#include "sweep/plan.h"

/** Solve the points of a job and write its row of the map's tables (or of the plan's
 *  reference). Restarts the solver. Threads may run different jobs of a phase at once.
 *  GM_ERR_SOLVE with the point when one does not converge. */
GM_NODISCARD gm_status gm_experiment_row(const gm_sweep_plan *plan, const gm_job *job,
                                         gm_steady_solver *solver, gm_error *error);

#endif
