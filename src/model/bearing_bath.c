/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Drag of a bearing that runs in the oil bath, by the SKF model (SKF, Rolling bearings,
 * General Catalogue 10000, "Drag losses"). Horizontal shaft; N.mm, mm, rpm, mm2/s.
 *
 *   ball:   M = 0.4 V_M K_ball d_m^5 n^2 + viscous
 *   roller: M = 4 V_M K_roll C_w B d_m^4 n^2 + viscous
 *   viscous = 1.093e-7 n^2 d_m^3 (n d_m^2 f_t / nu)^-1.379 R_s
 *   K_ball = K_Z (d + D)/(D - d) 1e-12,  K_roll = K_L K_Z (d + D)/(D - d) 1e-12
 *   C_w = 2.789e-10 l^3 - 2.786e-4 l^2 + 0.0195 l + 0.6439,  l = 5 K_L B / d_m
 *   t = 2 acos((0.6 d_m - H)/(0.6 d_m)),  f_t = sin(t/2) up to t = pi, then 1
 *   R_s = 0.36 d_m^2 (t - sin t) f_A,  f_A = 0.05 K_Z (D + d)/(D - d)
 *
 * H: oil level above the lowest contact of the outer raceway, at most 1.2 d_m. V_M(H/d_m)
 * is read from the catalogue's diagram and interpolated linearly. Valid for nu < 500
 * mm2/s and D up to about 215 mm.
 */
#include "model/bearing_models.h"

#include "model/power.h"

#include <math.h>

static const double share[] = {0.0,   0.025, 0.05, 0.075, 0.1,  0.125, 0.15,
                               0.175, 0.2,   0.25, 0.3,   0.35, 0.4,   0.5,
                               0.6,   0.7,   0.8,  0.9,   1.0,  1.1,   1.2};
static const double V_M_ball[] = {
    0.0,      8.075e-6, 1.856e-5, 4.028e-5, 7.309e-5, 1.129e-4, 1.574e-4,
    2.018e-4, 2.464e-4, 3.133e-4, 3.814e-4, 4.310e-4, 4.786e-4, 5.658e-4,
    6.389e-4, 7.028e-4, 7.780e-4, 8.654e-4, 9.471e-4, 1.046e-3, 1.238e-3};
static const double V_M_roller[] = {
    0.0,      1.657e-5, 3.974e-5, 7.308e-5, 1.159e-4, 1.684e-4, 2.302e-4,
    2.905e-4, 3.255e-4, 3.886e-4, 4.512e-4, 5.111e-4, 5.701e-4, 6.824e-4,
    7.830e-4, 8.844e-4, 9.809e-4, 1.090e-3, 1.194e-3, 1.310e-3, 1.434e-3};
enum { N_SHARES = sizeof share / sizeof *share };

static bool is_ball(const gm_bearing_data *data)
{
    return data->type == GM_BEARING_DEEP_GROOVE_BALL ||
           data->type == GM_BEARING_ANGULAR_CONTACT_BALL;
}

double gm_skf_drag_variable(const gm_bearing_data *data, double H_share)
{
    const double *V_M = is_ball(data) ? V_M_ball : V_M_roller;
    int i = 0;
    double h = fmin(fmax(H_share, 0.0), share[N_SHARES - 1]);
    while (i < N_SHARES - 2 && h > share[i + 1])
        i++;
    return V_M[i] + (V_M[i + 1] - V_M[i]) * (h - share[i]) / (share[i + 1] - share[i]);
}

/* Factor of V_M n^2. */
static double flow(const gm_bearing_law *law, double d_m, double K)
{
    double B = 1e3 * law->data.B, K_L = law->skf.K_L;
    if (is_ball(&law->data))
        return 0.4 * K * pow(d_m, 5.0);
    double l = 5.0 * K_L * B / d_m;
    double C_w = 2.789e-10 * l * l * l - 2.786e-4 * l * l + 0.0195 * l + 0.6439;
    return 4.0 * K_L * K * C_w * B * pow(d_m, 4.0);
}

gm_skf_bath gm_skf_bath_at(const gm_bearing_law *law, double H, double V_M)
{
    double d = 1e3 * law->data.d, D = 1e3 * law->data.D, d_m = 0.5 * (d + D);
    double level = fmin(H, 1.2 * d_m), slenderness = (d + D) / (D - d);
    double t = 2.0 * acos((0.6 * d_m - level) / (0.6 * d_m));
    double f_t = t < GM_PI ? sin(0.5 * t) : 1.0;
    double f_A = 0.05 * law->skf.K_Z * slenderness;
    double R_s = 0.36 * d_m * d_m * (t - sin(t)) * f_A;
    double K = law->skf.K_Z * slenderness * 1e-12;
    return (gm_skf_bath){.flow = V_M * flow(law, d_m, K),
                         .viscous = 1.093e-7 * pow(d_m, 3.0) *
                                    pow(d_m * d_m * f_t / law->nu, -1.379) * R_s};
}

void gm_bearing_immerse(gm_bearing_law *law, double H)
{
    double d_m = 0.5e3 * (law->data.d + law->data.D);
    if (law->data.friction != GM_FRICTION_SKF || !(H > 0.0))
        return;
    double V_M = gm_skf_drag_variable(&law->data, 1e3 * H / d_m);
    law->bath = gm_skf_bath_at(law, 1e3 * H, V_M);
}
