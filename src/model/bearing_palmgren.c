/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Rolling bearing friction by Palmgren, in the form of Harris, "Rolling Bearing
 * Analysis", and ISO/TR 14179. Mixed units: N, mm, N.mm, rpm, mm2/s; d_m = (d + D)/2.
 *
 *   M   = M_0 + M_1 + M_2
 *   M_0 = 1e-7 f_0 (nu n)^(2/3) d_m^3    for nu n >= 2000,  160e-7 f_0 d_m^3 below
 *   M_1 = f_1 P_1 d_m
 *   M_2 = f_2 F_a d_m                     cylindrical rollers under axial load
 *
 * The two forms of M_0 differ by 0.8 % at nu n = 2000; the larger of both is taken, which
 * is continuous and differs from the source by at most those 0.8 %, between 2000 and
 * 2024. At rest M_0 keeps its lower value: the limit n -> 0+.
 *
 * Defaults, oil bath:      f_0   f_1                      P_1
 *   deep groove ball        2    0.0009 (P_0/C_0)^0.55    max(3 F_a - 0.1 F_r, F_r)
 *   angular contact ball    2    0.001 (P_0/C_0)^0.33     max(1.4 F_a - 0.1 F_r, F_r)
 *   cylindrical, cage       2.5  0.0003                   F_r        f_2 0.006
 *   cylindrical, full       6    0.00055                  F_r        f_2 0.003
 *   needle                 12    0.002                    F_r        f_2 0.003
 *   tapered                 4    0.0004                   max(2 Y F_a, F_r)
 * A given f_1 is a constant. P_0 by ISO 76: max(0.6 F_r + 0.5 F_a, F_r) for deep groove,
 * max(0.5 F_r + 0.26 F_a, F_r) for angular contact ball bearings (contact angle 40 deg).
 */
#include "model/bearing_models.h"

#include "model/power.h"

#include <math.h>
#include <stddef.h>

static const double rpm = 30. / GM_PI; /* per rad/s */

typedef struct defaults {
    double f0, f1, exponent, f2;
} defaults;

static defaults defaults_of(const gm_bearing_data *data)
{
    const gm_skf_row *row;
    switch (data->type) {
    case GM_BEARING_DEEP_GROOVE_BALL:
        return (defaults){2., 0.0009, 0.55, 0.};
    case GM_BEARING_ANGULAR_CONTACT_BALL:
        return (defaults){2., 0.001, 0.33, 0.};
    case GM_BEARING_NEEDLE_ROLLER:
        return (defaults){12., 0.002, 0., 0.003};
    case GM_BEARING_TAPERED_ROLLER:
        return (defaults){4., 0.0004, 0., 0.};
    case GM_BEARING_CYLINDRICAL_ROLLER:
    case GM_BEARING_PLAIN:
        break;
    }
    /* The series matters only in telling a full complement of rollers. */
    if (gm_skf_find(data->type, data->series, &row, NULL) == GM_OK && row->K_Z > 6.)
        return (defaults){6., 0.00055, 0., 0.003};
    return (defaults){2.5, 0.0003, 0., 0.006};
}

void gm_palmgren_make(gm_bearing_law *law)
{
    const gm_bearing_data *data = &law->data;
    defaults d = defaults_of(data);
    double d_m = 0.5e3 * (data->d + data->D);
    double f0 = isnan(data->f0) ? d.f0 : data->f0;
    int given = !isnan(data->f1);
    law->palmgren = (gm_palmgren){.viscous = 1e-7 * f0 * d_m * d_m * d_m,
                                  .load = (given ? data->f1 : d.f1) * d_m,
                                  .exponent = given ? 0. : d.exponent,
                                  .axial = d.f2 * d_m};
}

gm_bearing_speed gm_palmgren_at_speed(const gm_bearing_law *law, double w)
{
    double viscous = law->palmgren.viscous, x = law->nu * rpm * w;
    double root = cbrt(x), film = root * root;
    if (film <= 160.)
        return (gm_bearing_speed){.w = w, .rolling = 160. * viscous};
    return (gm_bearing_speed){
        .w = w, .rolling = viscous * film, .d_rolling = viscous * 2. / 3. * film / w};
}

/* A load that is linear in F_r and F_a, but at least F_r. */
typedef struct equivalent {
    double value, r, a;
} equivalent;

static equivalent at_least_radial(double r, double a, double F_r, double F_a)
{
    double P = r * F_r + a * F_a;
    return P > F_r ? (equivalent){P, r, a} : (equivalent){F_r, 1., 0.};
}

static equivalent load_P_1(const gm_bearing_data *data, double F_r, double F_a)
{
    switch (data->type) {
    case GM_BEARING_DEEP_GROOVE_BALL:
        return at_least_radial(-0.1, 3., F_r, F_a);
    case GM_BEARING_ANGULAR_CONTACT_BALL:
        return at_least_radial(-0.1, 1.4, F_r, F_a);
    case GM_BEARING_TAPERED_ROLLER:
        return at_least_radial(0., 2. * data->Y, F_r, F_a);
    case GM_BEARING_CYLINDRICAL_ROLLER:
    case GM_BEARING_NEEDLE_ROLLER:
    case GM_BEARING_PLAIN:
        break;
    }
    return (equivalent){F_r, 1., 0.};
}

static equivalent load_P_0(const gm_bearing_data *data, double F_r, double F_a)
{
    if (data->type == GM_BEARING_ANGULAR_CONTACT_BALL)
        return at_least_radial(0.5, 0.26, F_r, F_a);
    return at_least_radial(0.6, 0.5, F_r, F_a);
}

gm_bearing_torque gm_palmgren_friction(const gm_bearing_law *law,
                                       const gm_bearing_speed *speed, double F_r,
                                       double F_a)
{
    const gm_palmgren *palmgren = &law->palmgren;
    equivalent P_1 = load_P_1(&law->data, F_r, F_a);
    double f = palmgren->load, f_r = 0., f_a = 0.;
    if (palmgren->exponent > 0.) {
        equivalent P_0 = load_P_0(&law->data, F_r, F_a);
        f *= pow(P_0.value / law->data.C0, palmgren->exponent);
        /* F_r = F_a = 0: f P_1 ~ load^1.55 starts with slope 0 */
        double slope = P_0.value > 0. ? palmgren->exponent * f / P_0.value : 0.;
        f_r = slope * P_0.r;
        f_a = slope * P_0.a;
    }
    return (gm_bearing_torque){
        .value = 1e-3 * (speed->rolling + f * P_1.value + palmgren->axial * F_a),
        .d_speed = 1e-3 * speed->d_rolling,
        .d_radial = 1e-3 * (f * P_1.r + f_r * P_1.value),
        .d_axial = 1e-3 * (f * P_1.a + f_a * P_1.value + palmgren->axial)};
}
