/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Seals and oil films.
 *
 * Radial shaft seals (mm, rpm, W in the sources; a torque here):
 *   ISO/TR 14179-2:2001   P = 7.69e-6 d^2 n
 *   ISO/TR 14179-1:2001   T = 3.737e-3 d (FPM), 2.429e-3 d (NBR)
 *   Linke                 P = (145 - 1.6 theta + 350 lg lg (nu_40 + 0.8)) d^2 n 1e-7,
 *                         theta in degC, nu_40 in mm2/s; 0 where the bracket falls below,
 *                         at some 130 degC
 * None depends on speed; at w = 0 the torque is the one-sided limit.
 *
 * Oil films in gaps, Petroff 1883: T = 2 pi eta w r^3 L / c, for c much less than r and
 * laminar flow. Where Re = w r c / nu reaches 41.2 sqrt(r/c), Taylor's vortices set in
 * (Taylor 1923); beyond, the coefficient of friction falls as Re^-0.6 in place of Re^-1
 * (Bilgen and Boulos, J. Fluids Eng. 95 (1973)), so that T is Petroff's times
 * (1 + (Re/Re_T)^8)^(0.4/8), within 0.1 % of either at half and twice Re_T.
 *
 * Open wet clutches and brakes, n gaps: the same shear stress eta w r / h over discs,
 * T = n pi eta w (r_e^4 - r_i^4) / (2 h). One plate turns, the other stands; laminar flow
 * without a pressure difference carries
 *   Q = n pi rho w^2 h^3 (r_o^2 - r_i^2) / (40 eta ln (r_o/r_i))
 * outwards when the gaps are full (0 = -dp/dr + rho r w^2 (z/h)^2 + eta d2u/dz2). With
 * less feed the films shrink: r_e^2 - r_i^2 = (feed/Q) (r_o^2 - r_i^2), the effective
 * radius of Kitabayashi, Li and Hiraki, SAE 2003-01-1973, and Yuan et al., J. Fluids Eng.
 * 129 (2007). Drag is largest where feed = Q and falls with about 1/w beyond. Not in it:
 * droplets and touching plates at very high slip.
 */
#include "model/drag.h"

#include "model/power.h"

#include <math.h>

static const double rpm = 30. / GM_PI; /* per rad/s */

gm_speed_torque gm_seal_torque(gm_seal_model model, double d, const gm_oil *oil, double w)
{
    double d_mm = 1e3 * d, T = 0.;
    (void)w; /* see above: a constant */
    switch (model) {
    case GM_SEAL_ISO14179_2:
        T = 7.69e-6 * d_mm * d_mm * rpm;
        break;
    case GM_SEAL_ISO14179_1_FPM:
        T = 3.737e-3 * d_mm;
        break;
    case GM_SEAL_ISO14179_1_NBR:
        T = 2.429e-3 * d_mm;
        break;
    case GM_SEAL_LINKE: {
        double viscosity = log10(log10(1e6 * oil->nu_40 + 0.8));
        double factor = 145. - 1.6 * (oil->temperature - 273.15) + 350. * viscosity;
        T = fmax(factor, 0.) * d_mm * d_mm * 1e-7 * rpm;
        break;
    }
    }
    return (gm_speed_torque){T, 0.};
}

gm_speed_torque gm_petroff_torque(double r, double L, double c, const gm_oil *oil,
                                  double w)
{
    double slope = 2. * GM_PI * oil->eta * r * r * r * L / c;
    double x = w * r * c / (oil->nu * 41.2 * sqrt(r / c));
    double x2 = x * x, x8 = x2 * x2 * x2 * x2;
    /* powers are slow; below 1e-5 the next term is less than rounding */
    double more = x8 < 1e-5 ? 1. + 0.05 * x8 * (1. - 0.475 * x8) : pow(1. + x8, 0.05);
    return (gm_speed_torque){slope * w * more,
                             slope * more * (1. + 0.4 * x8 / (1. + x8))};
}

double gm_plates_full_slip(const gm_plates *plates, const gm_oil *oil)
{
    double h = plates->h, A = plates->r_o * plates->r_o - plates->r_i * plates->r_i;
    double flow = plates->n * GM_PI * oil->rho * h * h * h * A /
                  (40. * oil->eta * log(plates->r_o / plates->r_i));
    return sqrt(plates->feed / flow);
}

/* With the wet part wet = r_e^2 - r_i^2: T = k w wet (wet + 2 r_i^2); beyond full films
 * wet ~ 1/w^2. */
gm_speed_torque gm_plates_drag(const gm_plates *plates, const gm_oil *oil, double w)
{
    double r_i2 = plates->r_i * plates->r_i, wet = plates->r_o * plates->r_o - r_i2;
    double k = 0.5 * plates->n * GM_PI * oil->eta / plates->h;
    double full = gm_plates_full_slip(plates, oil);
    if (w <= full)
        return (gm_speed_torque){k * w * wet * (wet + 2. * r_i2),
                                 k * wet * (wet + 2. * r_i2)};
    wet *= full / w * (full / w);
    return (gm_speed_torque){k * w * wet * (wet + 2. * r_i2),
                             -k * wet * (3. * wet + 2. * r_i2)};
}
