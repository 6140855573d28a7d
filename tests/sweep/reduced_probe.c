/* SPDX-License-Identifier: BSD-2-Clause */
#include "reduced_probe.h"

gm_status reduced_probe_at(void *self, double oil, const gm_steady_point *point,
                           double output_torque, gm_reduced_answer *answer,
                           gm_error *error)
{
    reduced_probe *of = self;
    if (++of->asked == of->fail_at)
        return gm_fail(error, GM_ERR_TOOL, "asked once too often");
    gm_verify_view(of->view, oil, point, output_torque, answer);
    answer->loss_power *= of->loss_factor;
    for (int p = 0; p < GM_MAX_INPUT_PATHS; p++)
        answer->path_drag[p] += of->drag_offset;
    return GM_OK;
}
