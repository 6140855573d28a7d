/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What the component remembers as a row of numbers: the oil of the gearset, flags, gears,
 * values, states, modes.
 */
#include "gm_detailed.h"

#include <string.h>

enum { N_VALUES = GM_VARIABLES * GM_DETAILED_PATHS, N_FLAGS = 2 + 2 * GM_DETAILED_PATHS };

int gm_detailed_n_saved(const gm_detailed *d)
{
    return 1 + N_FLAGS + N_VALUES + d->n_states + gm_motion_n_modes(d->motion);
}

static double *put(double *to, const double *from, size_t n)
{
    memcpy(to, from, n * sizeof *to);
    return to + n;
}

void gm_detailed_save(const gm_detailed *d, double *saved)
{
    *saved++ = gm_gearset_oil_temperature(d->gearset);
    *saved++ = d->start_pending;
    *saved++ = d->jump_loss;
    for (int p = 0; p < GM_DETAILED_PATHS; p++) {
        *saved++ = d->input.gear[p];
        *saved++ = d->refused[p];
    }
    saved = put(saved, &d->value[0][0], N_VALUES);
    saved = put(saved, d->x, (size_t)d->n_states);
    gm_motion_get_modes(d->motion, saved);
}

static void take(gm_detailed *d, const double *saved)
{
    d->start_pending = saved[0] != 0.0;
    d->jump_loss = saved[1];
    saved += 2;
    for (int p = 0; p < GM_DETAILED_PATHS; p++) {
        d->input.gear[p] = (int)*saved++;
        d->refused[p] = *saved++ != 0.0;
    }
    memcpy(d->value, saved, sizeof d->value);
    gm_detailed_set_states(d, saved + N_VALUES);
    d->input.torque[0] = d->value[GM_OUTPUT_TAU][0];
    for (int p = 0; p < d->n_paths; p++)
        d->input.torque[1 + p] = d->value[GM_PATH_TAU][p];
}

gm_status gm_detailed_restore(gm_detailed *d, const double *saved, gm_error *error)
{
    const double *modes = saved + 1 + N_FLAGS + N_VALUES + d->n_states;
    gm_status status = gm_detailed_take_oil(d, saved[0], error);
    if (status != GM_OK)
        return status;
    if (gm_motion_set_modes(d->motion, modes))
        return gm_fail(error, GM_ERR_ARGUMENT, "the state is damaged");
    take(d, saved + 1);
    gm_detailed_take_parameters(d);
    return gm_motion_flanges_update(d->flanges, error);
}
