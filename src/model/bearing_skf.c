/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Rolling bearing friction by the SKF model (SKF, Rolling bearings, General Catalogue
 * 10000, "The SKF model for calculating the frictional moment"). Mixed units: N, mm,
 * N.mm, rpm, mm2/s; d_m = (d + D)/2.
 *
 *   M       = phi_ish phi_rs G_rr (nu n)^0.6 + G_sl mu_sl + M_seal + M_drag
 *   phi_ish = 1 / (1 + 1.84e-9 (n d_m)^1.28 nu^0.64)
 *   phi_rs  = exp(-K_rs nu n (d + D) sqrt(K_Z / (2 (D - d)))),  K_rs = 3e-8: low oil bath
 *             or jet, 6e-8: grease or oil-air, 0: flooded
 *   M_seal  = K_S1 d_s^beta + K_S2, seals on both sides of a capped deep groove ball
 *             bearing; M_drag: bearing_bath.c
 *   mu_sl   = phi_bl mu_bl + (1 - phi_bl) mu_EHL
 *   phi_bl  = exp(-2.6e-8 (n nu)^1.4 d_m)
 *   mu_bl   = 0.12 for n > 0 and for the limit n -> 0+ (the 0.15 of the first start is
 *             not a limit of motion)
 *   mu_EHL  = 0.02 cylindrical and needle, 0.002 tapered roller; balls: a property of oil
 *
 *   deep groove ball  G_rr = R1 dm^1.96 (Fr + R2 A)^0.54
 *                     G_sl = S1 dm^-0.145 (Fr^5 + S2 dm^1.5 A Fa^3)^(1/3)
 *                     with A = Fa / sin(alpha_F); for Fa = 0:
 *                     G_rr = R1 dm^1.96 Fr^0.54,  G_sl = S1 dm^-0.26 Fr^(5/3)
 *   angular contact   G_rr = R1 dm^1.97 (Fr + Fg + R2 Fa)^0.54,  Fg = R3 dm^4 n^2
 *                     G_sl = S1 dm^0.26 ((Fr + Fg)^(4/3) + S2 Fa^(4/3)), Fg with S3
 *   cylindrical       G_rr = R1 dm^2.41 Fr^0.31
 *                     G_sl = S1 dm^0.9 Fa + S2 dm Fr
 *   tapered           G_rr = R1 dm^2.38 (Fr + R2 Y Fa)^0.31
 *                     G_sl = S1 dm^0.82 (Fr + S2 Y Fa)
 *
 *   alpha_F = 24.6 (Fa/C0)^0.24 degrees
 *
 * Needle roller bearings: SKF gives no constants; those of full complement cylindrical
 * roller bearings stand in.
 *
 * Where the catalogue's formulas do not meet or have no slope, they are joined:
 * - Deep groove ball: G_sl for Fa = 0 and Fa -> 0+ differ by dm^0.115 (1.55 at dm = 46);
 *   blended by a smoothstep over 0 <= Fa <= 0.002 C0.
 * - A grows as Fa^0.76: a parabola below 1e-4 C0 (see power.h). Fa/C0 in alpha_F counts
 *   as 1 at most; the catalogue's loads end near 0.5.
 * - Loads to the power 0.54 or 0.31: a parabola below 1 N; nu n to 0.6: below 1
 *   mm2/s rpm.
 *
 * Valid for steady speed and constant load at or above the minimum load of the bearing,
 * normal clearance, speeds within the rating.
 */
#include "model/bearing_models.h"

#include "model/power.h"

#include <math.h>

static const double K_rs[] = {3e-8, 6e-8, 0.}; /* by gm_bearing_supply */
static const double mu_bl = 0.12;
static const double small_load = 1.;     /* N */
static const double small_n = 1.;        /* rpm, of the drag in the oil bath */
static const double small_nu_n = 1.;     /* mm2/s rpm */
static const double blend_share = 0.002; /* of C0 */
static const double small_share = 1e-4;  /* of C0 */
static const double rpm = 30. / GM_PI;   /* per rad/s */

/* A = F_a / sin(alpha_F) without the joint at zero. alpha_F ~ F_a^0.24 gives
 * dA/dF_a = (1 - 0.24 alpha_F / tan(alpha_F)) / sin(alpha_F). */
static gm_power contact(double F_a, double C0)
{
    double share = F_a / C0, full = 24.6 * GM_PI / 180.;
    double alpha = share < 1. ? full * pow(share, 0.24) : full;
    double s = sin(alpha), growth = share < 1. ? 0.24 * alpha * cos(alpha) / s : 0.;
    return (gm_power){F_a / s, (1. - growth) / s};
}

static void make_deep_groove_ball(gm_bearing_law *law, const gm_skf_row *row, double d_m)
{
    gm_skf *skf = &law->skf;
    skf->k_rr = row->R1 * pow(d_m, 1.96);
    skf->k_rr_axial = row->R2;
    skf->k_sl = row->S1 * pow(d_m, -0.26);
    skf->k_sl_both = row->S1 * pow(d_m, -0.145);
    skf->k_sl_axial = row->S2 * pow(d_m, 1.5);
    skf->F_small = small_share * law->data.C0;
    gm_power at = contact(skf->F_small, law->data.C0);
    skf->small[0] = 2. * at.value / skf->F_small - at.slope;
    skf->small[1] = (at.slope - at.value / skf->F_small) / skf->F_small;
}

static void make_angular_contact(gm_skf *skf, const gm_skf_row *row, double d_m)
{
    skf->k_rr = row->R1 * pow(d_m, 1.97);
    skf->k_rr_axial = row->R2;
    skf->k_sl = row->S1 * pow(d_m, 0.26);
    skf->k_sl_axial = row->S2;
    skf->F_g_rr = row->R3 * pow(d_m, 4.);
    skf->F_g_sl = row->S3 * pow(d_m, 4.);
}

static void make_cylindrical(gm_skf *skf, const gm_skf_row *row, double d_m)
{
    skf->k_rr = row->R1 * pow(d_m, 2.41);
    skf->k_sl = row->S2 * d_m;
    skf->k_sl_axial = row->S1 * pow(d_m, 0.9);
    skf->mu_EHL = 0.02;
}

static void make_tapered(gm_skf *skf, const gm_skf_row *row, double d_m, double Y)
{
    skf->k_rr = row->R1 * pow(d_m, 2.38);
    skf->k_rr_axial = row->R2 * Y;
    skf->k_sl = row->S1 * pow(d_m, 0.82);
    skf->k_sl_axial = skf->k_sl * row->S2 * Y;
    skf->mu_EHL = 0.002;
}

/* Constants of the catalogue's table for deep groove ball bearings. */
double gm_skf_seals(gm_bearing_cap cap, double D, double diameter)
{
    double lip = pow(diameter, 2.25);
    switch (cap) {
    case GM_CAP_RSL:
        return D <= 25. ? 0. : D <= 52. ? 0.0018 * lip : (double)NAN;
    case GM_CAP_RSH:
        return D <= 52. ? 0.028 * lip + 2. : (double)NAN;
    case GM_CAP_RS1:
        if (D <= 62.)
            return 0.023 * lip + 2.;
        return 0.018 * lip + (D <= 80. ? 20. : D <= 100. ? 15. : 0.);
    case GM_CAP_NONE:
        break;
    }
    return 0.;
}

void gm_skf_make(gm_bearing_law *law, const gm_skf_row *row, double mu_EHL_ball)
{
    double d = 1e3 * law->data.d, D = 1e3 * law->data.D, nu = law->nu;
    double d_m = 0.5 * (d + D);
    gm_skf *skf = &law->skf;
    *skf = (gm_skf){.mu_EHL = mu_EHL_ball, .K_Z = row->K_Z, .K_L = row->K_L};
    skf->ish = 1.84e-9 * pow(d_m, 1.28) * pow(nu, 0.64);
    skf->rs = K_rs[law->data.supply] * nu * (d + D) * sqrt(row->K_Z / (2. * (D - d)));
    skf->bl = 2.6e-8 * d_m * pow(nu, 1.4);
    skf->seals = gm_skf_seals(law->data.cap, D, 1e3 * law->data.cap_diameter);
    switch (law->data.type) {
    case GM_BEARING_DEEP_GROOVE_BALL:
        make_deep_groove_ball(law, row, d_m);
        break;
    case GM_BEARING_ANGULAR_CONTACT_BALL:
        make_angular_contact(skf, row, d_m);
        break;
    case GM_BEARING_CYLINDRICAL_ROLLER:
    case GM_BEARING_NEEDLE_ROLLER:
        make_cylindrical(skf, row, d_m);
        break;
    case GM_BEARING_TAPERED_ROLLER:
        make_tapered(skf, row, d_m, law->data.Y);
        break;
    case GM_BEARING_PLAIN:
        break;
    }
}

gm_skf_phi gm_skf_factors(const gm_bearing_law *law, double n)
{
    const gm_skf *skf = &law->skf;
    double shear = skf->ish * pow(n, 0.28), film = skf->bl * pow(n, 0.4);
    gm_skf_phi phi = {
        .ish = 1. / (1. + shear * n), .rs = exp(-skf->rs * n), .bl = exp(-film * n)};
    phi.d_ish = -1.28 * shear * phi.ish * phi.ish;
    phi.d_rs = -skf->rs * phi.rs;
    phi.d_bl = -1.4 * film * phi.bl;
    return phi;
}

gm_bearing_speed gm_skf_at_speed(const gm_bearing_law *law, double w)
{
    const gm_skf *skf = &law->skf;
    double n = rpm * w;
    gm_skf_phi phi = gm_skf_factors(law, n);
    gm_power film = gm_power_from_zero(law->nu * n, 0.6, small_nu_n);
    double d_phi = phi.d_ish * phi.rs + phi.ish * phi.d_rs;
    gm_bearing_speed speed = {.w = w};
    speed.rolling = phi.ish * phi.rs * film.value;
    speed.d_rolling =
        rpm * (d_phi * film.value + phi.ish * phi.rs * film.slope * law->nu);
    speed.sliding = phi.bl * mu_bl + (1. - phi.bl) * skf->mu_EHL;
    speed.d_sliding = rpm * phi.d_bl * (mu_bl - skf->mu_EHL);
    speed.F_g_rr = skf->F_g_rr * n * n;
    speed.d_F_g_rr = rpm * 2. * skf->F_g_rr * n;
    speed.F_g_sl = skf->F_g_sl * n * n;
    speed.d_F_g_sl = rpm * 2. * skf->F_g_sl * n;
    if (law->bath.flow == 0. && law->bath.viscous == 0.) /* above the oil: no power */
        return speed;
    gm_power viscous = gm_power_from_zero(n, 0.621, small_n);
    speed.drag = law->bath.flow * n * n + law->bath.viscous * viscous.value;
    speed.d_drag = rpm * (2. * law->bath.flow * n + law->bath.viscous * viscous.slope);
    return speed;
}

/* G_rr = k_rr (F_r + F_g + weighted axial load)^p */
static void rolling(gm_skf_loads *g, const gm_skf *skf, double load, double p,
                    double axial_slope)
{
    gm_power power = gm_power_from_zero(load, p, small_load);
    g->G_rr = skf->k_rr * power.value;
    g->rr_r = skf->k_rr * power.slope;
    g->rr_a = g->rr_r * axial_slope;
    g->rr_g = g->rr_r;
}

/* G_sl without axial load, blended with what is in *g, the formula for F_a > 0. */
static void blend_to_radial(gm_skf_loads *g, const gm_skf *skf, double F_r, double t,
                            double F_blend)
{
    double radial = skf->k_sl * cbrt(F_r * F_r * F_r * F_r * F_r);
    double radial_r = F_r > 0. ? 5. / 3. * radial / F_r : 0.;
    double s = t * t * (3. - 2. * t), ds = 6. * t * (1. - t) / F_blend;
    g->sl_a = s * g->sl_a + ds * (g->G_sl - radial);
    g->sl_r = radial_r + s * (g->sl_r - radial_r);
    g->G_sl = radial + s * (g->G_sl - radial);
}

static gm_skf_loads deep_groove_ball(const gm_bearing_law *law, double F_r, double F_a)
{
    const gm_skf *skf = &law->skf;
    gm_skf_loads g = {0};
    gm_power A = {F_a * (skf->small[0] + F_a * skf->small[1]),
                  skf->small[0] + 2. * F_a * skf->small[1]};
    if (F_a >= skf->F_small)
        A = contact(F_a, law->data.C0);
    rolling(&g, skf, F_r + skf->k_rr_axial * A.value, 0.54, skf->k_rr_axial * A.slope);
    double F_r4 = F_r * F_r * F_r * F_r, F_a2 = F_a * F_a;
    double sum = F_r4 * F_r + skf->k_sl_axial * A.value * F_a2 * F_a;
    double root = cbrt(sum);
    double slope = sum > 0. ? skf->k_sl_both / (3. * root * root) : 0.;
    g.G_sl = skf->k_sl_both * root;
    g.sl_r = slope * 5. * F_r4;
    g.sl_a = slope * skf->k_sl_axial * F_a2 * (A.slope * F_a + 3. * A.value);
    double F_blend = blend_share * law->data.C0;
    if (F_a < F_blend)
        blend_to_radial(&g, skf, F_r, F_a / F_blend, F_blend);
    return g;
}

static gm_skf_loads angular_contact(const gm_skf *skf, const gm_bearing_speed *speed,
                                    double F_r, double F_a)
{
    gm_skf_loads g = {0};
    rolling(&g, skf, F_r + speed->F_g_rr + skf->k_rr_axial * F_a, 0.54, skf->k_rr_axial);
    double F = F_r + speed->F_g_sl;
    double root_r = cbrt(F), root_a = cbrt(F_a);
    g.G_sl = skf->k_sl * (F * root_r + skf->k_sl_axial * F_a * root_a);
    g.sl_r = skf->k_sl * 4. / 3. * root_r;
    g.sl_a = skf->k_sl * 4. / 3. * skf->k_sl_axial * root_a;
    g.sl_g = g.sl_r;
    return g;
}

/* Cylindrical, needle and tapered: sliding is linear in the loads. */
static gm_skf_loads roller(const gm_skf *skf, double F_r, double F_a)
{
    gm_skf_loads g = {0};
    rolling(&g, skf, F_r + skf->k_rr_axial * F_a, 0.31, skf->k_rr_axial);
    g.G_sl = skf->k_sl * F_r + skf->k_sl_axial * F_a;
    g.sl_r = skf->k_sl;
    g.sl_a = skf->k_sl_axial;
    return g;
}

gm_skf_loads gm_skf_at_loads(const gm_bearing_law *law, const gm_bearing_speed *speed,
                             double F_r, double F_a)
{
    switch (law->data.type) {
    case GM_BEARING_DEEP_GROOVE_BALL:
        return deep_groove_ball(law, F_r, F_a);
    case GM_BEARING_ANGULAR_CONTACT_BALL:
        return angular_contact(&law->skf, speed, F_r, F_a);
    case GM_BEARING_CYLINDRICAL_ROLLER:
    case GM_BEARING_NEEDLE_ROLLER:
    case GM_BEARING_TAPERED_ROLLER:
    case GM_BEARING_PLAIN:
        break;
    }
    return roller(&law->skf, F_r, F_a);
}

gm_bearing_torque gm_skf_friction(const gm_bearing_law *law,
                                  const gm_bearing_speed *speed, double F_r, double F_a)
{
    gm_skf_loads g = gm_skf_at_loads(law, speed, F_r, F_a);
    double rr = 1e-3 * speed->rolling, sl = 1e-3 * speed->sliding; /* N.mm to N.m */
    return (gm_bearing_torque){
        .value = rr * g.G_rr + sl * g.G_sl + 1e-3 * (law->skf.seals + speed->drag),
        .d_speed = 1e-3 * (speed->d_rolling * g.G_rr + speed->d_sliding * g.G_sl) +
                   rr * g.rr_g * speed->d_F_g_rr + sl * g.sl_g * speed->d_F_g_sl +
                   1e-3 * speed->d_drag,
        .d_radial = rr * g.rr_r + sl * g.sl_r,
        .d_axial = rr * g.rr_a + sl * g.sl_a};
}
