/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Friction of the assembled elements as magnitudes over magnitudes: what the steady
 * balance and the motion share. Signs are theirs.
 */
#include "model/gearset.h"

#include <math.h>

/* With f on both sides of the mean force, the entering power loses exactly the share
 * kappa: (F - f/2)/(F + f/2) = 1 - kappa, so f = |F| kappa q with q = 2/(2 - kappa), and
 * df/dkappa = |F| q^2. */
gm_mesh_friction gm_mesh_friction_at(const gm_mesh_element *mesh, double F, double v_t)
{
    gm_mesh_share s = gm_mesh_loss_share(&mesh->law, fabs(F) / mesh->contacts, v_t);
    double q = 2.0 / (2.0 - s.kappa), slope = s.d_force / mesh->contacts;
    return (gm_mesh_friction){.value = fabs(F) * s.kappa * q,
                              .d_force = (F < 0.0 ? -1.0 : 1.0) *
                                         (s.kappa * q + fabs(F) * slope * q * q),
                              .d_speed = fabs(F) * s.d_speed * q * q};
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
    case GM_DRAG_CHURNING:
        return gm_churning_torque(&drag->dip, oil, w);
    }
    return (gm_speed_torque){0.0, 0.0};
}
