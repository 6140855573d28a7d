/* SPDX-License-Identifier: BSD-2-Clause
 *
 * How losses go from one oil temperature of the map to the next. Viscosity falls steeply
 * where oil is cold, and with it all drags; mesh friction hardly changes. A line between
 * two temperatures 30 K apart is off by an eighth of a loss there. So the share of the
 * next slice is bent (gm_oil_axis in core/gm_reduced.h) by one number for each interval,
 * such that it is right in the mean at a temperature between, in the sense of least
 * squares over all gears at rest, idle and under load.
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
