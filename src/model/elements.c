/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Friction of the assembled elements as magnitudes over magnitudes: what the steady
 * balance and the motion share. Signs are theirs.
 */
#include "model/gearset.h"

#include <math.h>

gm_mesh_friction gm_mesh_friction_at(const gm_mesh_element *mesh, double F, double v_t)
{
    int n = mesh->contacts;
    gm_mesh_force f = gm_mesh_law_force(&mesh->law, fabs(F) / n, v_t);
    return (gm_mesh_friction){.value = n * f.value,
                              .d_force = F < 0.0 ? -f.d_force : f.d_force,
                              .d_speed = n * f.d_speed};
}

gm_speed_torque gm_drag_torque(const gm_gearset *gearset, const gm_drag_element *drag,
                               double w)
{
    const gm_oil *oil = &gearset->oil;
    switch (drag->law) {
    case GM_DRAG_SEAL:
        return gm_seal_torque(drag->seal, 2.0 * drag->radius, oil, w);
    case GM_DRAG_GAP:
        return gm_petroff_torque(drag->radius, drag->length, drag->clearance, oil, w);
    case GM_DRAG_CLUTCH:
        return gm_plates_drag(&drag->plates, oil, w);
    case GM_DRAG_CHURNING:
        return gm_churning_torque(&drag->dip, oil, w);
    case GM_DRAG_CHURNING_ISO14179_1:
        return gm_churning_torque_iso14179_1(&drag->dip, oil, w);
    case GM_DRAG_SPLASH:
        return gm_splash_torque(&drag->splash, w);
    case GM_DRAG_WINDAGE:
        return gm_windage_torque(&drag->windage, w);
    case GM_DRAG_JET:
        return gm_jet_torque(&drag->jet, oil, w);
    }
    return (gm_speed_torque){0.0, 0.0};
}
