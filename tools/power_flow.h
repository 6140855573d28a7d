/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The way that power takes through the gearset in one gear, as a list of parts.
 */
#ifndef POWER_FLOW_H
#define POWER_FLOW_H

#include "model/gm_description.h"

typedef struct gm_power_flow {
    int n; /* number of parts, 0 when there is no way */
    const char *
        *parts; /* [n] names from the input shaft to the output, of the description */
} gm_power_flow;

/** Shortest way from the shaft of path p to the output when that path is in its gear with
 *  index g and the other one rests, through meshes that carry load (loaded[n_meshes]).
 *  Planetary sets split power; this is one of the ways, through parts that are not held.
 *  Free with gm_power_flow_clear. GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_power_flow_find(const gm_description *description, int p, int g,
                                          const unsigned char *loaded,
                                          gm_power_flow *flow, gm_error *error);
void gm_power_flow_clear(gm_power_flow *flow);

#endif
