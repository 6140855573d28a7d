/* SPDX-License-Identifier: BSD-2-Clause */
#include "reduced_probe.h"

gm_status reduced_probe_at(void *self, const gm_steady_point *point, double output_torque,
                           gm_reduced_answer *answer, gm_error *error)
{
    reduced_probe *of = self;
    const gm_reduced_map *m = gm_map_view_reduced(of->view);
    gm_reduced_inputs inputs = {.output_tau = output_torque};
    gm_reduced_params params;
    gm_reduced_state s;
    gm_reduced_outputs out;
    if (++of->asked == of->fail_at)
        return gm_fail(error, GM_ERR_TOOL, "asked once too often");
    for (int p = 0; p < m->n_paths; p++) {
        inputs.path_tau[p] = point->torque[1 + p];
        inputs.gear[p] = point->gear[p];
    }
    gm_reduced_default_params(m, &params);
    (void)gm_reduced_start(m, &inputs, point->speed[0], &point->speed[1], &s);
    (void)gm_reduced_outputs_at(m, &params, &inputs, &s, &out);
    *answer = (gm_reduced_answer){.loss_power = out.loss_power * of->loss_factor,
                                  .output_reaction = out.output_loss_torque};
    for (int p = 0; p < m->n_paths; p++)
        answer->path_drag[p] = out.path_loss_torque[p] + of->drag_offset;
    return GM_OK;
}
