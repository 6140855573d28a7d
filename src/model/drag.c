/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Losses that do not depend on load.
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
 * laminar flow (w r c / nu below about 1000).
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
 *
 * Gears in the oil bath, Changenet and Velex, "A Model for the Prediction of Churning
 * Losses in Geared Transmissions", J. Mech. Des. 129 (2007):
 *   T   = 1/2 rho w^2 R_p^3 S_m C_m
 *   C_m = 1.366 (h/D_p)^0.45 (V_0/D_p^3)^0.1 Fr^-0.6 Re^-0.21       Re_c < 6000
 *   C_m = 0.239 (h/D_p)^0.45 (V_0/D_p^3)^0.1 Fr^-0.6                Re_c > 9000
 *   Fr = w^2 R_p / g,  Re = w R_p^2 / nu,  Re_c = w R_p b / nu
 *   S_m = R_p^2 (2 theta - sin 2 theta) + 2 theta R_p b,  cos theta = 1 - h/R_p
 * and linear in between. T ~ w^0.59 has no slope at w = 0: a parabola below 0.1 rad/s.
 */
#include "model/drag.h"

#include "model/power.h"

#include <math.h>

static const double gravity = 9.81;      /* m/s2 */
static const double rpm = 30. / GM_PI;   /* per rad/s */
static const double small_speed = 0.1;   /* rad/s, see power.h */
static const double laminar_end = 6000.; /* Re_c */
static const double turbulent_start = 9000.;

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
    return (gm_speed_torque){slope * w, slope};
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

/* S_m */
static double wetted_area(const gm_dip *dip, double h)
{
    double R = dip->R_p, theta = acos(1. - h / R);
    return R * R * (2. * theta - sin(2. * theta)) + 2. * theta * R * dip->b;
}

gm_speed_torque gm_churning_torque(const gm_dip *dip, const gm_oil *oil, double w)
{
    double R = dip->R_p, D = 2. * R, h = fmin(dip->h, D);
    if (!(h > 0.))
        return (gm_speed_torque){0., 0.};
    /* Powers of w apart: w^2 Fr^-0.6 ~ w^0.8, with Re^-0.21 ~ w^0.59. */
    double common = 0.5 * oil->rho * R * R * R * wetted_area(dip, h) * pow(h / D, 0.45) *
                    pow(dip->V_0 / (D * D * D), 0.1) * pow(R / gravity, -0.6);
    double laminar = 1.366 * pow(R * R / oil->nu, -0.21);
    gm_power slow = gm_power_from_zero(w, 0.59, small_speed);
    gm_power fast = gm_power_from_zero(w, 0.80, small_speed);
    slow = (gm_power){common * laminar * slow.value, common * laminar * slow.slope};
    fast = (gm_power){common * 0.239 * fast.value, common * 0.239 * fast.slope};
    double per_w = R * dip->b / oil->nu, width = turbulent_start - laminar_end;
    double t = (per_w * w - laminar_end) / width;
    if (t <= 0.)
        return (gm_speed_torque){slow.value, slow.slope};
    if (t >= 1.)
        return (gm_speed_torque){fast.value, fast.slope};
    return (gm_speed_torque){slow.value + t * (fast.value - slow.value),
                             slow.slope + t * (fast.slope - slow.slope) +
                                 per_w / width * (fast.value - slow.value)};
}
