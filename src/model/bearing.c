/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Entry to bearing friction: checks what a model needs of a bearing, and hands on to the
 * model. GM_FRICTION_NONE supports its shaft without friction.
 */
#include "model/bearing.h"

#include "model/bearing_models.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

const char *gm_bearing_type_name(gm_bearing_type type)
{
    switch (type) {
    case GM_BEARING_DEEP_GROOVE_BALL:
        return "deep groove ball bearing";
    case GM_BEARING_ANGULAR_CONTACT_BALL:
        return "angular contact ball bearing";
    case GM_BEARING_CYLINDRICAL_ROLLER:
        return "cylindrical roller bearing";
    case GM_BEARING_NEEDLE_ROLLER:
        return "needle roller bearing";
    case GM_BEARING_TAPERED_ROLLER:
        return "tapered roller bearing";
    case GM_BEARING_PLAIN:
        break;
    }
    return "plain bearing";
}

const char *gm_bearing_friction_name(gm_bearing_friction_model friction)
{
    switch (friction) {
    case GM_FRICTION_COULOMB:
        return "coulomb";
    case GM_FRICTION_ELASTIC:
        return "elastic";
    case GM_FRICTION_HYDRODYNAMIC:
        return "hydrodynamic";
    case GM_FRICTION_SKF:
        return "skf";
    case GM_FRICTION_PALMGREN:
        return "palmgren";
    case GM_FRICTION_NONE:
        break;
    }
    return "none";
}

/* Models of rolling contacts, against those by given numbers. */
static bool is_rolling(const gm_bearing_data *data)
{
    return data->friction == GM_FRICTION_SKF || data->friction == GM_FRICTION_PALMGREN;
}

/* The static load rating appears in the contact angle of deep groove ball bearings (SKF)
 * and in the default f_1 of ball bearings (Palmgren). */
static bool needs_C0(const gm_bearing_data *data)
{
    if (data->friction == GM_FRICTION_SKF)
        return data->type == GM_BEARING_DEEP_GROOVE_BALL;
    return isnan(data->f1) && (data->type == GM_BEARING_DEEP_GROOVE_BALL ||
                               data->type == GM_BEARING_ANGULAR_CONTACT_BALL);
}

/* Palmgren tells cylindrical rollers with and without a cage by the series, if given. */
static bool needs_row(const gm_bearing_data *data)
{
    if (data->friction == GM_FRICTION_PALMGREN)
        return data->type == GM_BEARING_CYLINDRICAL_ROLLER && data->series[0] != '\0';
    return data->friction == GM_FRICTION_SKF;
}

static gm_status check_cap(const gm_bearing_data *data, gm_error *error)
{
    if (data->cap == GM_CAP_NONE)
        return GM_OK;
    if (data->type != GM_BEARING_DEEP_GROOVE_BALL)
        return gm_fail(error, GM_ERR_MODEL,
                       "seals belong to a deep groove ball bearing; a %s takes a part of "
                       "its own under seals",
                       gm_bearing_type_name(data->type));
    if (isnan(data->cap_diameter))
        return gm_fail(error, GM_ERR_MODEL, "seals need their seal_diameter_mm");
    if (isnan(gm_skf_seals(data->cap, 1e3 * data->D, 1e3 * data->cap_diameter)))
        return gm_fail(error, GM_ERR_MODEL,
                       "seals rsl and rsh are known up to an outer_mm of 52; found %g",
                       1e3 * data->D);
    return GM_OK;
}

static gm_status check_rolling(const gm_bearing_data *data, gm_error *error)
{
    const char *kind = gm_bearing_type_name(data->type);
    const char *model = gm_bearing_friction_name(data->friction);
    if (data->type == GM_BEARING_PLAIN)
        return gm_fail(error, GM_ERR_MODEL,
                       "a plain bearing has friction none, coulomb, elastic or "
                       "hydrodynamic; found %s",
                       model);
    if (isnan(data->d) || isnan(data->D))
        return gm_fail(error, GM_ERR_MODEL,
                       "a %s with friction %s needs bore_mm and outer_mm%s", kind, model,
                       data->type == GM_BEARING_DEEP_GROOVE_BALL ? ", or its designation"
                                                                 : "");
    if (!(data->d > 0. && data->D > data->d))
        return gm_fail(error, GM_ERR_MODEL,
                       "bore_mm must be less than outer_mm; found %g and %g",
                       1e3 * data->d, 1e3 * data->D);
    if (data->type == GM_BEARING_TAPERED_ROLLER && !(data->Y > 0.))
        return gm_fail(error, GM_ERR_MODEL,
                       "a %s with friction %s needs axial_factor, its Y", kind, model);
    if (needs_C0(data) && !(data->C0 > 0.))
        return gm_fail(error, GM_ERR_MODEL,
                       "a %s with friction %s needs static_load_N, its static load "
                       "rating C0%s",
                       kind, model,
                       data->friction == GM_FRICTION_PALMGREN ? ", or f1" : "");
    return check_cap(data, error);
}

static gm_status check(const gm_bearing_data *data, gm_error *error)
{
    if (data->friction == GM_FRICTION_NONE)
        return GM_OK;
    return is_rolling(data) ? check_rolling(data, error) : gm_sliding_check(data, error);
}

static void make(gm_bearing_law *law, const gm_skf_row *row, const gm_oil *oil)
{
    switch (law->data.friction) {
    case GM_FRICTION_COULOMB:
    case GM_FRICTION_ELASTIC:
    case GM_FRICTION_HYDRODYNAMIC:
        gm_sliding_make(law, oil->eta);
        break;
    case GM_FRICTION_SKF:
        gm_skf_make(law, row, oil->bearing_mu_ehl);
        break;
    case GM_FRICTION_PALMGREN:
        gm_palmgren_make(law);
        break;
    case GM_FRICTION_NONE:
        break;
    }
}

gm_status gm_bearing_law_make(const gm_bearing_data *data, const gm_oil *oil,
                              gm_bearing_law *law, gm_error *error)
{
    gm_bearing_law made = {.data = *data, .nu = 1e6 * oil->nu};
    gm_status status = GM_OK;
    if (data->designation[0] != '\0')
        status = gm_bearing_data_complete(&made.data, error);
    if (status == GM_OK)
        status = check(&made.data, error);
    const gm_skf_row *row = NULL;
    if (status == GM_OK && needs_row(&made.data))
        status = gm_skf_find(made.data.type, made.data.series, &row, error);
    if (status != GM_OK)
        return status;
    make(&made, row, oil);
    *law = made;
    return GM_OK;
}

gm_bearing_speed gm_bearing_at_speed(const gm_bearing_law *law, double w)
{
    switch (law->data.friction) {
    case GM_FRICTION_COULOMB:
    case GM_FRICTION_ELASTIC:
    case GM_FRICTION_HYDRODYNAMIC:
        return gm_sliding_at_speed(law, w);
    case GM_FRICTION_SKF:
        return gm_skf_at_speed(law, w);
    case GM_FRICTION_PALMGREN:
        return gm_palmgren_at_speed(law, w);
    case GM_FRICTION_NONE:
        break;
    }
    return (gm_bearing_speed){.w = w};
}

gm_bearing_torque gm_bearing_friction(const gm_bearing_law *law,
                                      const gm_bearing_speed *speed, double F_r,
                                      double F_a)
{
    switch (law->data.friction) {
    case GM_FRICTION_COULOMB:
    case GM_FRICTION_ELASTIC:
    case GM_FRICTION_HYDRODYNAMIC:
        return gm_sliding_friction(law, speed, F_r, F_a);
    case GM_FRICTION_SKF:
        return gm_skf_friction(law, speed, F_r, F_a);
    case GM_FRICTION_PALMGREN:
        return gm_palmgren_friction(law, speed, F_r, F_a);
    case GM_FRICTION_NONE:
        break;
    }
    return (gm_bearing_torque){0};
}
