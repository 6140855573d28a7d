/* SPDX-License-Identifier: BSD-2-Clause
 *
 * How the outputs of the reduced gearset change with states, torques and losses, exactly:
 * along one direction, through the tables and with the modes as they are. In a cell of a
 * table the gradient is that of its surface; on an edge it is that of the cell above, and
 * outside the map, where the edge value is used, it is zero.
 */
#ifndef GM_REDUCED_GRADIENT_H
#define GM_REDUCED_GRADIENT_H

#include "gm_reduced_modes.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A direction: how fast each of these changes. Speeds of engaged rigid paths follow the
 *  output's, whatever is said of them here; only elastic paths have a twist. */
typedef struct gm_reduced_change {
    gm_real w_o, w[GM_MAX_PATHS], twist[GM_MAX_PATHS];
    gm_real output_tau, path_tau[GM_MAX_PATHS]; /* flange torques */
    gm_real a[GM_MAX_PATHS + 1]; /* accelerations of prescribed flanges, output last */
    gm_real loss_scale, oil_temperature;
} gm_reduced_change;

/** Derivatives of all that gm_reduced_outputs_at tells (modes NULL: the modes are those
 *  that it finds) or gm_reduced_modes_outputs does, along *change. Returns flags.
 *  Changes nothing but the caches in *state. */
int gm_reduced_derivative(const gm_reduced_map *map, const gm_reduced_params *params,
                          const gm_reduced_inputs *inputs, const gm_reduced_modes *modes,
                          gm_reduced_state *state, const gm_reduced_change *change,
                          gm_reduced_outputs *derivative);

#ifdef __cplusplus
}
#endif
#endif
