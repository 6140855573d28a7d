/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Temperatures for the oil axis of a map, chosen by error.
 */
#ifndef GM_OIL_H
#define GM_OIL_H

#include "map/gm_map.h"
#include "plant/gm_plant.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Where the gearset is to be had at any oil temperature [K]; the plants live as long as
 *  the source. */
typedef struct gm_oil_source {
    gm_status (*at)(void *self, double temperature, const gm_plant **plant,
                    gm_error *error);
    void *self;
} gm_oil_source;

/** Part of a tolerance that an axis chosen by it takes; the rest is for the other axes.
 */
#define GM_OIL_PART 0.4

/** Add temperatures to at[*n] (*n >= 2, ascending, K; room for GM_MAP_MAX_OIL), halving
 *  the interval with the largest error, until losses of all gears at three temperatures
 *  held out between any two are within GM_OIL_PART of the tolerance: the larger one of a
 *  share of the gear's largest loss there and of a torque [N.m]. They stay as they are
 *  where nothing more fits. speed_max [rad/s], torque_max [N.m]: up to where. What the
 *  source answers, GM_ERR_SOLVE, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_oil_choose(const gm_oil_source *source, double speed_max,
                                     double torque_max, double share, double torque,
                                     int *n, double *at, gm_error *error);

#ifdef __cplusplus
}
#endif
#endif
