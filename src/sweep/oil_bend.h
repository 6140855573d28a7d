/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The bends of a map's oil axis; see oil_profile.h.
 */
#ifndef OIL_BEND_H
#define OIL_BEND_H

#include "sweep/plan.h"
#include "sweep/points.h"

/** The bend from slice `interval` to the next, measured with the plant between them; 0
 *  where nothing changes with the temperature. What gm_point_solve answers. */
GM_NODISCARD gm_status gm_oil_bend(const gm_sweep_plan *plan, int interval,
                                   gm_point_solver *solver, double *bend,
                                   gm_error *error);

#endif
