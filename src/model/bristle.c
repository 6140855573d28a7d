/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The LuGre model (Canudas de Wit, Olsson, Astrom, Lischinsky, IEEE Trans. Automat.
 * Contr. 40 (1995)) in the elasto-plastic form (Dupont, Hayward, Armstrong, Altpeter,
 * IEEE Trans. Automat. Contr. 47 (2002)):
 *
 *   dz/dt = w (1 - alpha(r) r),   r = sigma_0 z sgn(w) / g(|w|)
 *   T     = sigma_0 z + sigma_1 exp(-(w/w_s)^2) dz/dt    (+ sigma_2 w: the caller's)
 *
 * alpha is 0 up to r = 0.9, also for r < 0 (unloading), 1 from r = 1 on, and a smoothstep
 * between. LuGre is alpha = 1: there a load that oscillates below the holding torque
 * creeps, since loading and unloading differ. Here both are purely elastic up to 0.9 g;
 * dz/dt vanishes with w, so that a load below g = T_s is held at rest. Dupont's
 * break-away deflection is a constant, below that of the fastest sliding; taken as a
 * share of g(|w|) it follows the Stribeck curve, and the static torque is held too.
 *
 * Steady sliding: r = 1, T = g(|w|) sgn(w). Sliding relaxes with the rate
 * |w| sigma_0 / g: stiff, for implicit solvers. The damping fades with speed (Olsson, PhD
 * thesis, Lund 1996): a constant one could give energy back where z is ahead of g, and
 * its product with that rate would be enormous.
 *   loss = sigma_0 z w alpha r + sigma_1(w) w^2 (1 - alpha r)
 * is least at r = 2: not negative while sigma_1(w) |w| <= 4 g; the left is at most
 * 0.43 sigma_1 w_s.
 */
#include "model/bristle.h"

#include <math.h>

typedef struct share {
    double value, slope;
} share;

static share plastic_share(double r)
{
    double t = (r - GM_BRISTLE_ELASTIC) / (1.0 - GM_BRISTLE_ELASTIC);
    if (t <= 0.0)
        return (share){0.0, 0.0};
    if (t >= 1.0)
        return (share){1.0, 0.0};
    return (share){t * t * (3.0 - 2.0 * t),
                   6.0 * t * (1.0 - t) / (1.0 - GM_BRISTLE_ELASTIC)};
}

gm_bristle gm_bristle_at(const gm_bristle_law *law, const gm_bristle_level *level,
                         double w, double z)
{
    double way = w != 0.0 ? copysign(1.0, w) : copysign(1.0, z);
    double per_z = law->stiffness * way / level->g; /* dr/dz */
    double r = per_z * z;
    share alpha = plastic_share(r);
    double slope = alpha.slope * r + alpha.value; /* d(alpha r)/dr */
    gm_bristle b = {.rate = w * (1.0 - alpha.value * r)};
    b.rate_state = -w * slope * per_z;
    b.rate_level = w * slope * r / level->g;
    b.rate_speed = 1.0 - alpha.value * r + b.rate_level * level->d_speed * way;
    double u = w / law->speed, damping = law->damping * exp(-u * u);
    b.torque = law->stiffness * z + damping * b.rate;
    b.torque_state = law->stiffness + damping * b.rate_state;
    b.torque_speed = damping * (b.rate_speed - 2.0 * u / law->speed * b.rate);
    b.torque_level = damping * b.rate_level;
    b.stored = 0.5 * law->stiffness * z * z;
    b.loss = b.torque * w - law->stiffness * z * b.rate;
    return b;
}

double gm_bristle_steady(const gm_bristle_law *law, const gm_bristle_level *level,
                         double w)
{
    return copysign(level->g / law->stiffness, w);
}
