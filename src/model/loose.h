/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Loose parts of a path: what turns with its flange but carries none of its torque, held
 * by nothing but the oil in its backlash. In a layshaft gearset these are the idling
 * gears of all other gears, a third to a half of a path's inertia.
 *
 * When the path vibrates they do not follow: their flanks part and meet again without
 * much rebound. A body of inertia J that moves freely over a part vibrating at frequency
 * w with speed v, and is caught twice a period at relative speeds of v to 2 v, takes
 * J v^2 to 4 J v^2 from a period, as a damper of w J / pi to 4 w J / pi does. (One that a
 * damper alone couples takes as much as a damper of w J / 2 at most.) Here 0.8 w J, the
 * middle: the detailed example rings down as with 0.3 to 0.8 w J (test_ring_down).
 * Vibrations that throw these parts beyond their backlash are damped less; the spring of
 * the reduced gearset lessens the damping with its slip (core/reduced_spring.c).
 */
#ifndef LOOSE_H
#define LOOSE_H

#include "model/gearset.h"

/** engaged: rows of the configuration with path p in gear. *path: inertia that turns with
 *  the flange in neutral, *loose: that of what carries nothing in this gear [kg.m2], both
 *  at the flange; both 0 for a path without neutral. GM_ERR_MODEL, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_loose_inertia(const gm_gearset *gearset,
                                        const gm_configuration_rows *engaged, int p,
                                        double *path, double *loose, gm_error *error);

#endif
