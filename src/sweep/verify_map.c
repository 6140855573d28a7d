/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Verification of a map by the reduced gearset in this program, for maps that no
 * component has been made of yet.
 */
#include "map/gm_map.h"
#include "sweep/gm_verify.h"

#include <stddef.h>

void gm_verify_view(const gm_map_view *view, double oil, const gm_steady_point *point,
                    double output_torque, gm_reduced_answer *answer)
{
    const gm_reduced_map *m = gm_map_view_reduced(view);
    gm_reduced_inputs inputs = {.output_tau = output_torque, .oil_temperature = oil};
    gm_reduced_params params;
    gm_reduced_state s;
    gm_reduced_outputs out;
    for (int p = 0; p < m->n_paths; p++) {
        inputs.path_tau[p] = point->torque[1 + p];
        inputs.gear[p] = point->gear[p];
    }
    gm_reduced_default_params(m, &params);
    (void)gm_reduced_start(m, &inputs, point->speed[0], &point->speed[1], &s);
    (void)gm_reduced_outputs_at(m, &params, &inputs, &s, &out);
    *answer = (gm_reduced_answer){.loss_power = out.loss_power,
                                  .output_reaction = out.output_loss_torque};
    for (int p = 0; p < m->n_paths; p++)
        answer->path_drag[p] = out.path_loss_torque[p];
}

static gm_status answer_at(void *self, double oil, const gm_steady_point *point,
                           double output_torque, gm_reduced_answer *answer,
                           gm_error *error)
{
    (void)error;
    gm_verify_view(self, oil, point, output_torque, answer);
    return GM_OK;
}

gm_status gm_verify_map(int n, const gm_plant *const *plants, const gm_map *map,
                        int monotone, int points, uint64_t seed, gm_verify_result *result,
                        gm_error *error)
{
    gm_map_view *view = NULL;
    gm_status status = gm_map_view_create(map, &view, error);
    if (status != GM_OK)
        return status;
    if (monotone)
        gm_map_view_make_monotone(view);
    gm_reduced_probe probe = {answer_at, view};
    status = gm_verify_plants(n, plants, &probe, points, seed, result, error);
    gm_map_view_destroy(view);
    return status;
}
