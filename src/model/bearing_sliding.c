/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Bearing friction by given numbers: Coulomb, elastic and hydrodynamic,
 *
 *   M     = g(w, F) + k_v w
 *   g     = g_c + (g_s - g_c) exp(-(w / w_s)^2)                          (Stribeck)
 *   g_c   = T_c + mu_c r F,   g_s = T_s + mu_s r F,   F = sqrt(F_r^2 + F_a^2)
 *
 * r is half the mean diameter of a rolling bearing, (d + D)/4, and half the bore of a
 * plain bearing. Coulomb friction has g_s = g_c and k_v = 0; T_c may be a table over
 * speed, straight between its points and beyond the last one, as in the bearing friction
 * of the Modelica Standard Library.
 *
 * The film of a plain bearing adds Petroff's torque: k_v includes 2 pi eta r^3 L / c,
 * for c much less than r and a shaft that runs centrally: light load or high speed. A
 * plain bearing in full film at speed has mu_c = 0 and mu_s of boundary friction, about
 * 0.1, and w_s where the film begins to carry.
 *
 * Elastic friction is the same law when it slides steadily; in motion it has a state, the
 * deflection of its bristles (bristle.c).
 */
#include "model/bearing_models.h"

#include "model/power.h"

#include <math.h>

/* Values that are not given: nothing, and at rest the same as while sliding. */
static double given(double value, double fallback)
{
    return isnan(value) ? fallback : value;
}

static bool is_plain(const gm_bearing_data *data)
{
    return data->type == GM_BEARING_PLAIN;
}

static double film(const gm_bearing_data *data, double eta)
{
    double r = 0.5 * data->d;
    if (isnan(data->clearance))
        return 0.0;
    return 2.0 * GM_PI * eta * r * r * r * data->B / data->clearance;
}

void gm_sliding_make(gm_bearing_law *law, double eta)
{
    const gm_bearing_data *data = &law->data;
    double r = is_plain(data) ? 0.5 * data->d : 0.25 * (data->d + data->D);
    double mu = given(data->mu, 0.0), mu_s = given(data->static_mu, mu);
    double T_c = given(data->torque, 0.0);
    law->sliding = (gm_sliding){.torque = T_c,
                                .lever = mu > 0.0 ? mu * r : 0.0,
                                .torque_at_rest = given(data->static_torque, T_c),
                                .lever_at_rest = mu_s > 0.0 ? mu_s * r : 0.0,
                                .stribeck = data->stribeck,
                                .viscous = given(data->viscous, 0.0)};
    if (data->friction == GM_FRICTION_HYDRODYNAMIC)
        law->sliding.viscous += film(data, eta);
    law->bristle = (gm_bristle_law){
        .stiffness = data->stiffness, .damping = data->damping, .speed = data->stribeck};
}

static bool has_load_part(const gm_bearing_data *data)
{
    return given(data->mu, 0.0) > 0.0 || given(data->static_mu, 0.0) > 0.0;
}

static gm_status needs(gm_error *error, const char *friction, const char *what)
{
    return gm_fail(error, GM_ERR_MODEL, "friction %s needs %s", friction, what);
}

static gm_status check_dimensions(const gm_bearing_data *data, const char *friction,
                                  gm_error *error)
{
    bool film = data->friction == GM_FRICTION_HYDRODYNAMIC && !isnan(data->clearance);
    if (film && !is_plain(data))
        return gm_fail(error, GM_ERR_MODEL,
                       "clearance_mm belongs to a bearing of type plain");
    if (film && (isnan(data->d) || isnan(data->B)))
        return needs(error, friction, "bore_mm and width_mm beside clearance_mm");
    if (film && !(data->clearance < 0.1 * data->d))
        return gm_fail(error, GM_ERR_MODEL,
                       "clearance_mm must be less than a tenth of bore_mm; found %g and "
                       "%g",
                       1e3 * data->clearance, 1e3 * data->d);
    if (!has_load_part(data))
        return GM_OK;
    if (isnan(data->d))
        return needs(error, friction, "bore_mm beside mu");
    if (!is_plain(data) && !(data->D > data->d))
        return needs(error, friction, "outer_mm, greater than bore_mm, beside mu");
    return GM_OK;
}

/* At rest at least what it has while sliding; see bristle.c for the damping. */
static gm_status check_levels(const gm_bearing_data *data, gm_error *error)
{
    double T_c = given(data->torque, 0.0), mu = given(data->mu, 0.0);
    if (given(data->static_torque, T_c) < T_c)
        return gm_fail(error, GM_ERR_MODEL,
                       "static_torque_Nm must not be less than torque_Nm; found %g and "
                       "%g",
                       data->static_torque, T_c);
    if (given(data->static_mu, mu) < mu)
        return gm_fail(error, GM_ERR_MODEL,
                       "static_mu must not be less than mu; found %g and %g",
                       data->static_mu, mu);
    if (data->friction == GM_FRICTION_ELASTIC &&
        !(data->damping * data->stribeck <= 9.0 * T_c))
        return gm_fail(error, GM_ERR_MODEL,
                       "damping_Nms_rad times the Stribeck speed must be at most 9 times "
                       "torque_Nm; found %g and 9 times %g N.m",
                       data->damping * data->stribeck, T_c);
    return GM_OK;
}

static gm_status check_table(const gm_bearing_data *data, gm_error *error)
{
    const gm_friction_point *p = data->table;
    int last = data->n_table - 1;
    if (last < 0)
        return GM_OK;
    if (!isnan(data->torque))
        return gm_fail(error, GM_ERR_MODEL,
                       "torque_Nm and torque_over_speed exclude each other");
    if (last < 1 || p[0].speed != 0.0)
        return gm_fail(error, GM_ERR_MODEL,
                       "torque_over_speed needs two points at least, the first at 0 rpm");
    for (int i = 1; i <= last; i++)
        if (!(p[i].speed > p[i - 1].speed))
            return gm_fail(error, GM_ERR_MODEL,
                           "speeds of torque_over_speed must rise; found %g rpm at point "
                           "%d after %g",
                           p[i].speed * 30.0 / GM_PI, i + 1,
                           p[i - 1].speed * 30.0 / GM_PI);
    if (p[last].torque < p[last - 1].torque)
        return gm_fail(error, GM_ERR_MODEL,
                       "torque_over_speed must not fall at its end, which is continued; "
                       "found %g N.m after %g",
                       p[last].torque, p[last - 1].torque);
    return GM_OK;
}

gm_status gm_sliding_check(const gm_bearing_data *data, gm_error *error)
{
    double T_c = given(data->torque, 0.0);
    const char *friction = gm_bearing_friction_name(data->friction);
    bool nothing = isnan(data->torque) && isnan(data->mu) && data->n_table == 0;
    if (data->friction == GM_FRICTION_COULOMB && nothing)
        return needs(error, friction, "torque_Nm, torque_over_speed or mu");
    if (data->friction == GM_FRICTION_ELASTIC && !(T_c > 0.0))
        return needs(error, friction, "torque_Nm greater than 0");
    if (data->friction == GM_FRICTION_HYDRODYNAMIC && isnan(data->viscous) &&
        isnan(data->clearance))
        return needs(error, friction, "viscous_Nms_rad, or the clearance_mm of a film");
    gm_status status = check_dimensions(data, friction, error);
    if (status == GM_OK)
        status = check_table(data, error);
    return status == GM_OK ? check_levels(data, error) : status;
}

/* The piece that begins at the last point not above w. */
static void read_table(const gm_bearing_data *data, double w, gm_bearing_speed *speed)
{
    const gm_friction_point *p = data->table;
    for (int i = 2; i < data->n_table && w >= p[1].speed; i++)
        p++;
    speed->d_rolling = (p[1].torque - p[0].torque) / (p[1].speed - p[0].speed);
    speed->rolling = p[0].torque + speed->d_rolling * (w - p[0].speed);
}

/* In gm_bearing_speed: sliding is the Stribeck share, rolling the viscous torque or that
 * of the table. */
gm_bearing_speed gm_sliding_at_speed(const gm_bearing_law *law, double w)
{
    const gm_sliding *s = &law->sliding;
    gm_bearing_speed speed = {.w = w, .rolling = s->viscous * w, .d_rolling = s->viscous};
    if (law->data.friction == GM_FRICTION_COULOMB) {
        if (law->data.n_table > 0)
            read_table(&law->data, w, &speed);
        return speed;
    }
    double u = w / s->stribeck;
    speed.sliding = exp(-u * u);
    speed.d_sliding = -2.0 * u / s->stribeck * speed.sliding;
    return speed;
}

/* Without load the slopes are those along either axis. */
gm_bearing_torque gm_sliding_friction(const gm_bearing_law *law,
                                      const gm_bearing_speed *speed, double F_r,
                                      double F_a)
{
    const gm_sliding *s = &law->sliding;
    double F = sqrt(F_r * F_r + F_a * F_a);
    double more = s->torque_at_rest - s->torque + (s->lever_at_rest - s->lever) * F;
    double lever = s->lever + speed->sliding * (s->lever_at_rest - s->lever);
    return (gm_bearing_torque){.value = s->torque + s->lever * F + speed->sliding * more +
                                        speed->rolling,
                               .d_speed = speed->d_sliding * more + speed->d_rolling,
                               .d_radial = lever * (F > 0.0 ? F_r / F : 1.0),
                               .d_axial = lever * (F > 0.0 ? F_a / F : 1.0)};
}

gm_bearing_state gm_bearing_elastic(const gm_bearing_law *law,
                                    const gm_bearing_speed *speed, double w, double z,
                                    double F_r, double F_a)
{
    gm_bearing_torque M = gm_sliding_friction(law, speed, F_r, F_a);
    gm_bristle_level level = {M.value - speed->rolling, M.d_speed - speed->d_rolling};
    gm_bristle b = gm_bristle_at(&law->bristle, &level, w, z);
    double viscous = law->sliding.viscous;
    return (gm_bearing_state){.rate = b.rate,
                              .rate_state = b.rate_state,
                              .rate_speed = b.rate_speed,
                              .rate_radial = b.rate_level * M.d_radial,
                              .rate_axial = b.rate_level * M.d_axial,
                              .torque = b.torque + viscous * w,
                              .torque_state = b.torque_state,
                              .torque_speed = b.torque_speed + viscous,
                              .torque_radial = b.torque_level * M.d_radial,
                              .torque_axial = b.torque_level * M.d_axial,
                              .stored = b.stored,
                              .loss = b.loss + viscous * w * w};
}
