/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The parts of a gearset with their places and sizes, for drawings: JSON only. Lengths in
 * mm. Radii of gears are those of the reference circle and of the tips and roots of
 * standard teeth (ISO 53: addendum 1, dedendum 1.25 modules) with their profile shift.
 */
#include "check.h"

#include <math.h>
#include <stdbool.h>

#define MM 1e3
#define DEG 57.29577951308232

static const char *holder_name(const gm_description *d, int on)
{
    return on == GM_HOUSING ? "housing" : d->shafts[on].id.name;
}

static void shaft_json(const gm_shaft *s, gm_json *json)
{
    gm_json_object(json, NULL);
    gm_json_text(json, "name", s->id.name);
    gm_json_number(json, "y_mm", MM * s->y);
    gm_json_number(json, "z_mm", MM * s->z);
    gm_json_number(json, "flange_mm", MM * s->flange);
    gm_json_array(json, "segments");
    for (int i = 0; i < s->n_segments; i++) {
        gm_json_object(json, NULL);
        gm_json_number(json, "from_mm", MM * s->segments[i].from);
        gm_json_number(json, "to_mm", MM * s->segments[i].to);
        gm_json_number(json, "diameter_mm", MM * s->segments[i].diameter);
        gm_json_number(json, "bore_mm", MM * s->segments[i].bore);
        gm_json_end(json);
    }
    gm_json_end(json);
    gm_json_end(json);
}

static void wheel_radii_json(const gm_wheel *w, gm_json *json)
{
    const double reference = 0.5 * w->teeth * w->normal_module / cos(w->helix);
    const double outward = w->internal ? -1.0 : 1.0; /* where the tips point */
    const double shift = w->profile_shift * w->normal_module;
    gm_json_number(json, "reference_radius_mm", MM * reference);
    gm_json_number(json, "tip_radius_mm",
                   MM * (reference + shift + outward * w->normal_module));
    gm_json_number(json, "root_radius_mm",
                   MM * (reference + shift - outward * 1.25 * w->normal_module));
}

static void wheel_json(const gm_description *d, const gm_wheel *w, gm_json *json)
{
    gm_json_object(json, NULL);
    gm_json_text(json, "name", w->id.name);
    gm_json_text(json, "shaft", d->shafts[w->shaft].id.name);
    gm_json_integer(json, "teeth", w->teeth);
    gm_json_number(json, "normal_module_mm", MM * w->normal_module);
    gm_json_number(json, "helix_deg", DEG * w->helix);
    gm_json_number(json, "position_mm", MM * w->position);
    gm_json_number(json, "width_mm", MM * w->width);
    wheel_radii_json(w, json);
    gm_json_bool(json, "internal", w->internal != 0);
    gm_json_bool(json, "idles", w->idles != 0);
    if (w->idles) {
        gm_json_number(json, "bearing_bore_mm", MM * w->bearing.d);
        gm_json_number(json, "bearing_outer_mm", MM * w->bearing.D);
    }
    gm_json_integer(json, "planets", w->planets);
    if (w->planets > 0) {
        gm_json_number(json, "pin_radius_mm", MM * w->pin_radius);
        gm_json_number(json, "pin_angle_deg", DEG * w->pin_angle);
    }
    gm_json_end(json);
}

static const char *bearing_type(gm_bearing_type type)
{
    static const char *const names[] = {
        [GM_BEARING_DEEP_GROOVE_BALL] = "deep groove ball bearing",
        [GM_BEARING_ANGULAR_CONTACT_BALL] = "angular contact ball bearing",
        [GM_BEARING_CYLINDRICAL_ROLLER] = "cylindrical roller bearing",
        [GM_BEARING_NEEDLE_ROLLER] = "needle roller bearing",
        [GM_BEARING_TAPERED_ROLLER] = "tapered roller bearing",
        [GM_BEARING_PLAIN] = "plain bearing",
    };
    return names[type];
}

static void bearing_json(const gm_description *d, const gm_bearing *b, gm_json *json)
{
    gm_json_object(json, NULL);
    gm_json_text(json, "name", b->id.name);
    gm_json_text(json, "shaft", d->shafts[b->shaft].id.name);
    gm_json_text(json, "on", holder_name(d, b->on));
    gm_json_text(json, "type", bearing_type(b->data.type));
    gm_json_text(json, "designation", b->data.designation);
    gm_json_bool(json, "locating", b->locating != 0);
    gm_json_number(json, "position_mm", MM * b->position);
    gm_json_number(json, "bore_mm", MM * b->data.d);
    gm_json_number(json, "outer_mm", MM * b->data.D);
    gm_json_number(json, "width_mm", MM * b->data.B);
    gm_json_end(json);
}

static void synchroniser_json(const gm_description *d, const gm_synchroniser *s,
                              gm_json *json)
{
    gm_json_object(json, NULL);
    gm_json_text(json, "name", s->id.name);
    gm_json_text(json, "shaft", d->shafts[s->shaft].id.name);
    gm_json_array(json, "gears");
    for (int i = 0; i < s->n_wheels; i++)
        gm_json_text(json, NULL, d->wheels[s->wheels[i]].id.name);
    gm_json_end(json);
    gm_json_number(json, "cone_radius_mm", MM * s->cone_radius);
    gm_json_number(json, "cone_width_mm", MM * s->cone_width);
    gm_json_end(json);
}

static void clutch_json(const gm_description *d, const gm_clutch *c, gm_json *json)
{
    gm_json_object(json, NULL);
    gm_json_text(json, "name", c->id.name);
    gm_json_text(json, "shaft", d->shafts[c->shaft].id.name);
    gm_json_text(json, "on", holder_name(d, c->on));
    gm_json_number(json, "inner_radius_mm", MM * c->inner_radius);
    gm_json_number(json, "outer_radius_mm", MM * c->outer_radius);
    gm_json_end(json);
}

static void bodies_json(const gm_description *d, gm_json *json)
{
    gm_json_array(json, "shafts");
    for (int i = 0; i < d->n_shafts; i++)
        shaft_json(&d->shafts[i], json);
    gm_json_end(json);
    gm_json_array(json, "gears");
    for (int i = 0; i < d->n_wheels; i++)
        wheel_json(d, &d->wheels[i], json);
    gm_json_end(json);
    gm_json_array(json, "meshes");
    for (int i = 0; i < d->n_meshes; i++) {
        gm_json_object(json, NULL);
        gm_json_text(json, "name", d->meshes[i].id.name);
        gm_json_array(json, "gears");
        for (int k = 0; k < 2; k++)
            gm_json_text(json, NULL, d->wheels[d->meshes[i].wheel[k]].id.name);
        gm_json_end(json);
        gm_json_end(json);
    }
    gm_json_end(json);
}

static void seals_json(const gm_description *d, gm_json *json)
{
    gm_json_array(json, "seals");
    for (int i = 0; i < d->n_seals; i++) {
        gm_json_object(json, NULL);
        gm_json_text(json, "name", d->seals[i].id.name);
        gm_json_text(json, "shaft", d->shafts[d->seals[i].shaft].id.name);
        gm_json_text(json, "on", holder_name(d, d->seals[i].on));
        gm_json_number(json, "diameter_mm", MM * d->seals[i].diameter);
        gm_json_end(json);
    }
    gm_json_end(json);
}

void gm_checked_parts_json(const gm_description *d, gm_json *json)
{
    gm_json_object(json, "parts");
    gm_json_text(json, "oil_name", d->oil.name);
    gm_json_number(json, "oil_level_mm", MM * d->oil.level);
    bodies_json(d, json);
    gm_json_array(json, "bearings");
    for (int i = 0; i < d->n_bearings; i++)
        bearing_json(d, &d->bearings[i], json);
    gm_json_end(json);
    seals_json(d, json);
    gm_json_array(json, "synchronisers");
    for (int i = 0; i < d->n_synchronisers; i++)
        synchroniser_json(d, &d->synchronisers[i], json);
    gm_json_end(json);
    gm_json_array(json, "clutches");
    for (int i = 0; i < d->n_clutches; i++)
        clutch_json(d, &d->clutches[i], json);
    gm_json_end(json);
    gm_json_end(json);
}
