/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The order of the checks, and what a single shaft with its bearings, seals and gaps must
 * fulfil.
 */
#include "model/check.h"

#include "model/bearing.h"

#include <math.h>
#include <string.h>

#define TOUCH 1e-6 /* m: rounding of positions in the file */

const gm_segment *gm_shaft_segment(const gm_shaft *shaft, double x)
{
    for (int i = 0; i < shaft->n_segments; i++)
        if (x >= shaft->segments[i].from && x <= shaft->segments[i].to)
            return &shaft->segments[i];
    return NULL;
}

double gm_shaft_distance(const gm_description *d, int a, int b)
{
    return hypot(d->shafts[b].y - d->shafts[a].y, d->shafts[b].z - d->shafts[a].z);
}

static gm_status check_segments(const gm_description *d, const gm_shaft *shaft,
                                gm_error *error)
{
    for (int i = 0; i < shaft->n_segments; i++) {
        const gm_segment *s = &shaft->segments[i];
        gm_label id = shaft->id;
        id.line = s->line;
        if (!(s->to > s->from))
            return gm_part_fail(d, "shaft", &id, error,
                                "segment %d: to_mm must be greater than from_mm; found "
                                "%.6g and %.6g",
                                i + 1, 1e3 * s->to, 1e3 * s->from);
        if (!(s->bore < s->diameter))
            return gm_part_fail(
                d, "shaft", &id, error,
                "segment %d: bore_mm must be less than diameter_mm; found "
                "%.6g and %.6g",
                i + 1, 1e3 * s->bore, 1e3 * s->diameter);
        if (i > 0 && fabs(s->from - s[-1].to) > TOUCH)
            return gm_part_fail(
                d, "shaft", &id, error,
                "segment %d: from_mm must be where segment %d ends; found "
                "%.6g, expected %.6g",
                i + 1, i, 1e3 * s->from, 1e3 * s[-1].to);
    }
    return GM_OK;
}

static gm_status check_support(const gm_description *d, int shaft, gm_error *error)
{
    int n = 0, locating = 0;
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int i = 0; i < d->n_bearings; i++) {
        const gm_bearing *b = &d->bearings[i];
        if (b->shaft != shaft)
            continue;
        n++;
        locating += b->locating;
        low = fmin(low, b->position);
        high = fmax(high, b->position);
    }
    const gm_label *id = &d->shafts[shaft].id;
    if (n < 2)
        return gm_part_fail(d, "shaft", id, error,
                            "a shaft needs at least 2 bearings, found %d", n);
    if (!(high - low > TOUCH))
        return gm_part_fail(d, "shaft", id, error,
                            "its bearings must stand apart; found all of them at %.6g mm",
                            1e3 * low);
    if (locating < 1)
        return gm_part_fail(d, "shaft", id, error,
                            "a shaft needs at least 1 locating bearing, found 0");
    return GM_OK;
}

gm_status gm_check_on(const gm_description *d, const char *word, const gm_label *id,
                      int shaft, int on, gm_error *error)
{
    if (on == GM_HOUSING)
        return GM_OK;
    if (on == shaft)
        return gm_part_fail(d, word, id, error,
                            "must connect two different shafts, found '%s' twice",
                            d->shafts[on].id.name);
    double distance = gm_shaft_distance(d, shaft, on);
    if (distance > GM_CONCENTRIC)
        return gm_part_fail(
            d, word, id, error,
            "shafts '%s' and '%s' must be concentric within %.3f mm; found "
            "their axes %.3f mm apart",
            d->shafts[shaft].id.name, d->shafts[on].id.name, 1e3 * GM_CONCENTRIC,
            1e3 * distance);
    return GM_OK;
}

static gm_status check_on_shaft(const gm_description *d, const gm_bearing *b, int shaft,
                                gm_error *error)
{
    const gm_shaft *s = &d->shafts[shaft];
    double from = s->segments[0].from, to = s->segments[s->n_segments - 1].to;
    double half = b->data.B > 0.0 ? 0.5 * b->data.B : 0.0;
    if (b->position - half < from - TOUCH || b->position + half > to + TOUCH)
        return gm_part_fail(d, "bearing", &b->id, error,
                            "lies outside its shaft '%s'; found it from %.6g to %.6g mm, "
                            "expected within %.6g to %.6g mm",
                            s->id.name, 1e3 * (b->position - half),
                            1e3 * (b->position + half), 1e3 * from, 1e3 * to);
    return GM_OK;
}

/* The friction model says itself what it needs. */
static gm_status check_bearing_data(const gm_description *d, const char *word,
                                    const gm_label *id, const gm_bearing_data *data,
                                    gm_error *error)
{
    gm_bearing_law law;
    gm_error why = {GM_OK, ""};
    gm_oil oil = gm_oil_at(&d->oil, d->oil.temperature);
    if (gm_bearing_law_make(data, &oil, &law, &why) != GM_OK)
        return gm_part_fail(d, word, id, error, "%s", why.message);
    return GM_OK;
}

static gm_status check_bearing(const gm_description *d, const gm_bearing *b,
                               gm_error *error)
{
    gm_status status = gm_check_on(d, "bearing", &b->id, b->shaft, b->on, error);
    if (status == GM_OK)
        status = check_bearing_data(d, "bearing", &b->id, &b->data, error);
    if (status == GM_OK)
        status = check_on_shaft(d, b, b->shaft, error);
    if (status == GM_OK && b->on != GM_HOUSING)
        status = check_on_shaft(d, b, b->on, error);
    return status;
}

static gm_status check_gap(const gm_description *d, const gm_gap *g, gm_error *error)
{
    if (!(g->clearance < g->radius))
        return gm_part_fail(
            d, "gap", &g->id, error,
            "clearance_mm must be less than radius_mm; found %.6g and %.6g",
            1e3 * g->clearance, 1e3 * g->radius);
    return gm_check_on(d, "gap", &g->id, g->inner, g->outer, error);
}

gm_status gm_check_shafts(const gm_description *d, gm_error *error)
{
    gm_status status = GM_OK;
    for (int i = 0; i < d->n_shafts && status == GM_OK; i++)
        status = check_segments(d, &d->shafts[i], error);
    for (int i = 0; i < d->n_bearings && status == GM_OK; i++)
        status = check_bearing(d, &d->bearings[i], error);
    for (int i = 0; i < d->n_wheels && status == GM_OK; i++)
        if (d->wheels[i].idles)
            status = check_bearing_data(d, "gear", &d->wheels[i].id,
                                        &d->wheels[i].bearing, error);
    for (int i = 0; i < d->n_shafts && status == GM_OK; i++)
        status = check_support(d, i, error);
    if (status == GM_OK)
        status = gm_check_thrust(d, error);
    for (int i = 0; i < d->n_seals && status == GM_OK; i++)
        status = gm_check_on(d, "seal", &d->seals[i].id, d->seals[i].shaft,
                             d->seals[i].on, error);
    for (int i = 0; i < d->n_gaps && status == GM_OK; i++)
        status = check_gap(d, &d->gaps[i], error);
    return status;
}

static gm_status check_third_viscosity(const gm_description *d, gm_error *error)
{
    const gm_oil_part *oil = &d->oil;
    double T = oil->third_temperature - 273.15;
    gm_vogel v;
    if (isnan(oil->third_viscosity) && isnan(T))
        return GM_OK;
    if (isnan(oil->third_viscosity) || isnan(T))
        return gm_description_fail(d->file, 1, "oil", GM_ERR_MODEL, error,
                                   "third_viscosity_mm2_s and third_temperature_degC "
                                   "need each other");
    if (fabs(T - 40.) < 5. || fabs(T - 100.) < 5.)
        return gm_description_fail(d->file, 1, "oil", GM_ERR_MODEL, error,
                                   "third_temperature_degC must be at least 5 K from 40 "
                                   "and 100 degC; found %.6g",
                                   T);
    if (!gm_oil_vogel(oil, &v))
        return gm_description_fail(
            d->file, 1, "oil", GM_ERR_MODEL, error,
            "third_viscosity_mm2_s, %.6g at %.6g degC, lies on no curve by Vogel's "
            "equation through %.6g at 40 and %.6g at 100 degC",
            1e6 * oil->third_viscosity, T, 1e6 * oil->viscosity_40,
            1e6 * oil->viscosity_100);
    return GM_OK;
}

static gm_status check_oil(const gm_description *d, gm_error *error)
{
    if (!(d->oil.viscosity_100 < d->oil.viscosity_40))
        return gm_description_fail(d->file, 1, "oil", GM_ERR_MODEL, error,
                                   "viscosity_100_mm2_s must be less than "
                                   "viscosity_40_mm2_s; found %.6g and %.6g",
                                   1e6 * d->oil.viscosity_100, 1e6 * d->oil.viscosity_40);
    return check_third_viscosity(d, error);
}

gm_status gm_check_description(const gm_description *d, gm_error *error)
{
    gm_status status = check_oil(d, error);
    if (status == GM_OK)
        status = gm_check_shafts(d, error);
    if (status == GM_OK)
        status = gm_check_gears(d, error);
    if (status == GM_OK)
        status = gm_check_paths(d, error);
    return status;
}
