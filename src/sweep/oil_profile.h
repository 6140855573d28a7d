/* SPDX-License-Identifier: BSD-2-Clause
 *
 * How losses go from one oil temperature to another. Viscosity falls steeply where oil is
 * cold, and with it all drags; mesh friction hardly changes. A line between two
 * temperatures 30 K apart is off by a third of a loss there. So the share of the next
 * slice of a map is bent (gm_oil_axis in core/gm_reduced.h) by one number for each
 * interval, such that it is right in the mean at a temperature between: least squares
 * over a profile, losses of all gears idle and under load and of paths in neutral, each
 * counted in its gear's largest loss.
 *
 * One share for all tables keeps what holds at every slice: losses are not negative, P
 * covers the drag of the input sides, the motion is unique.
 */
#ifndef OIL_PROFILE_H
#define OIL_PROFILE_H

#include "map/gm_map.h"
#include "plant/gm_plant.h"

enum {
    GM_OIL_PLACES = 16,
    GM_OIL_GROUPS = GM_MAX_PATHS * (GM_MAP_MAX_GEARS + 1) /* gears, paths in neutral */
};

/** Loss torques at one temperature [N.m]; NAN where none is known. */
typedef struct gm_oil_profile {
    double temperature; /* K */
    int n;              /* groups */
    double loss[GM_OIL_GROUPS][GM_OIL_PLACES];
} gm_oil_profile;

/** Who answers a point of a plant, and how far the profile reaches. */
typedef struct gm_oil_asker {
    gm_status (*solve)(void *user, const gm_steady_point *point, gm_steady_result *result,
                       gm_error *error);
    void *user;
    const gm_plant *plant;
    double speed_max, torque_max; /* rad/s, N.m */
} gm_oil_asker;

/** What the asker answers. */
GM_NODISCARD gm_status gm_oil_profile_measure(const gm_oil_asker *asker,
                                              gm_oil_profile *profile, gm_error *error);

/** The bend with which the losses at `between` are met best; 0 where none changes. */
double gm_oil_bend_between(const gm_oil_profile *low, const gm_oil_profile *between,
                           const gm_oil_profile *high);

/** Largest error of the losses read at the temperature of `there` with a bend, in
 *  tolerances: the larger one of a share of the gear's largest loss there and of a torque
 *  [N.m]. */
double gm_oil_error(const gm_oil_profile *low, const gm_oil_profile *high, double bend,
                    const gm_oil_profile *there, double share, double torque);

#endif
