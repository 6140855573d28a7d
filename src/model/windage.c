/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Gears in the air, and oil sprayed onto them.
 *
 * Windage (Maurer, dissertation, Stuttgart 1994), by the gear:
 *   T = 1.37e-9 v_t^1.9 d^1.6 b^0.52 m_n^0.69       N.m; m/s, mm
 * Made for pitch line speeds above some 50 m/s, below which it is negligible: it goes to
 * zero with speed by itself.
 *
 * Oil of a jet is brought to the speed of the gear and thrown off again (impulse loss,
 * Ariura, Ueno and Sunaga 1973):
 *   T = C r rho Q (v_t + v_jet),  C between 0.85 and 1
 * v_jet is the part of the jet's speed against the motion of the teeth. Below 0.1 m/s it
 * is led to zero by a smoothstep: a jet does not hold a gear at rest.
 */
#include "model/drag.h"

#include "model/power.h"

#include <math.h>

static const double jet_start = 0.1; /* m/s */

gm_speed_torque gm_windage_torque(const gm_windage *gear, double w)
{
    double r = 0.5 * gear->d, v = r * w;
    double k = 1.37e-9 * pow(1e3 * gear->d, 1.6) * pow(1e3 * gear->b, 0.52) *
               pow(1e3 * gear->m_n, 0.69);
    double slope = v > 0. ? 1.9 * pow(v, 0.9) : 0.;
    return (gm_speed_torque){k * pow(v, 1.9), k * slope * r};
}

gm_speed_torque gm_jet_torque(const gm_jet_law *jet, const gm_oil *oil, double w)
{
    double r = jet->radius, k = jet->factor * r * oil->rho * jet->flow,
           t = r * w / jet_start;
    if (t >= 1.)
        return (gm_speed_torque){k * (r * w + jet->speed), k * r};
    double s = t * t * (3. - 2. * t), ds = 6. * t * (1. - t) * r / jet_start;
    return (gm_speed_torque){k * (r * w + s * jet->speed), k * (r + ds * jet->speed)};
}
