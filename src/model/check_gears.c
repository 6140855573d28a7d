/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Gears on their shafts, and gears with their mates (ISO 21771):
 *   equal normal module and pressure angle;
 *   opposite helices (external), equal ones (internal);
 *   centre distance at zero backlash, from teeth, module, helix and profile shift, equal
 *   to the distance of the shafts;
 *   contact ratio 1 <= eps_alpha <= 2.5;
 *   root circle d + 2 m_n (x - 1.25) outside the bore (external teeth).
 */
#include "model/check.h"
#include "model/gearset.h"
#include "model/mesh.h"
#include "model/power.h"

#include <math.h>
#include <string.h>

#define TOUCH 1e-6            /* m: rounding of positions in the file */
#define CENTRE_DISTANCE 20e-6 /* m: a tenth of the usual backlash */
#define EQUAL_MODULE 1e-9     /* m */
#define EQUAL_ANGLE 1e-6      /* rad: six digits in the file */
#define DEGREES (180.0 / 3.14159265358979323846)

static double pitch_diameter(const gm_wheel *w)
{
    return w->teeth * w->normal_module / cos(w->helix);
}

static gm_status check_position(const gm_description *d, const gm_wheel *w,
                                gm_error *error)
{
    const gm_shaft *s = &d->shafts[w->shaft];
    double from = s->segments[0].from, to = s->segments[s->n_segments - 1].to;
    double left = w->position - 0.5 * w->width, right = w->position + 0.5 * w->width;
    if (left < from - TOUCH || right > to + TOUCH)
        return gm_part_fail(d, "gear", &w->id, error,
                            "lies outside its shaft '%s'; found it from %.6g to %.6g mm, "
                            "expected within %.6g to %.6g mm",
                            s->id.name, 1e3 * left, 1e3 * right, 1e3 * from, 1e3 * to);
    return GM_OK;
}

static gm_status check_bore(const gm_description *d, const gm_wheel *w, gm_error *error)
{
    const gm_segment *s = gm_shaft_segment(&d->shafts[w->shaft], w->position);
    double root = pitch_diameter(w) + 2.0 * w->normal_module * (w->profile_shift - 1.25);
    double core = w->idles ? w->bore : s->bore;
    if (w->idles && w->planets == 0 && w->bore < s->diameter - TOUCH)
        return gm_part_fail(
            d, "gear", &w->id, error,
            "its bore must not be smaller than the shaft; found bore %.6g "
            "mm on diameter %.6g mm",
            1e3 * w->bore, 1e3 * s->diameter);
    if (!w->internal && !(root > core))
        return gm_part_fail(d, "gear", &w->id, error,
                            "its root circle must be larger than the bore %s; found root "
                            "diameter %.6g mm, bore %.6g mm",
                            w->idles ? "in which it turns" : "of its shaft", 1e3 * root,
                            1e3 * core);
    return GM_OK;
}

/* A planet turns on a pin, its fellows stand evenly around and must not touch it. */
static gm_status check_planet(const gm_description *d, const gm_wheel *w, gm_error *error)
{
    double tip = pitch_diameter(w) + 2.0 * w->normal_module * (1.0 + w->profile_shift);
    if (!w->idles || w->internal)
        return gm_part_fail(d, "gear", &w->id, error,
                            "a planet needs idles: true and external teeth");
    if (w->planets < 2)
        return gm_part_fail(d, "gear", &w->id, error,
                            "planets stand evenly around their carrier, so there are 2 "
                            "or more; found %d",
                            w->planets);
    if (isnan(w->pin_radius))
        return gm_part_fail(d, "gear", &w->id, error, "a planet needs pin_radius_mm");
    double apart = 2.0 * w->pin_radius * sin(GM_PI / w->planets);
    if (!(apart > tip))
        return gm_part_fail(d, "gear", &w->id, error,
                            "planets side by side must not touch; found tip diameter "
                            "%.6g mm, their axes %.6g mm apart",
                            1e3 * tip, 1e3 * apart);
    return GM_OK;
}

static gm_status check_gear(const gm_description *d, const gm_wheel *w, gm_error *error)
{
    gm_status planet = w->planets > 0 ? check_planet(d, w, error) : GM_OK;
    if (planet != GM_OK)
        return planet;
    if (w->internal && (isnan(w->inertia) || isnan(w->mass)))
        return gm_part_fail(d, "gear", &w->id, error,
                            "a gear with internal teeth needs inertia_kgm2 and mass_kg, "
                            "which do not follow from its teeth");
    if (!w->idles && w->bearing.D != 0.0)
        return gm_part_fail(d, "gear", &w->id, error,
                            "a gear that does not idle turns with its shaft: its bearing "
                            "has no effect");
    if (w->idles && w->bearing.D == 0.0) /* the group is absent */
        return gm_part_fail(d, "gear", &w->id, error, "an idling gear needs a bearing");
    if (w->planets == 0 && (!isnan(w->pin_radius) || !isnan(w->pin_angle)))
        return gm_part_fail(d, "gear", &w->id, error,
                            "pin_radius_mm and pin_angle_deg have an effect only with "
                            "planets");
    gm_status status = check_position(d, w, error);
    return status == GM_OK ? check_bore(d, w, error) : status;
}

static gm_status check_mates(const gm_description *d, const gm_mesh *m, gm_error *error)
{
    const gm_wheel *a = &d->wheels[m->wheel[0]], *b = &d->wheels[m->wheel[1]];
    const char *first = a->id.name, *second = b->id.name;
    double hand = a->internal || b->internal ? 1.0 : -1.0;
    if (a->internal && b->internal)
        return gm_part_fail(d, "mesh", &m->id, error,
                            "only one of its gears can have internal teeth, found both "
                            "('%s' and '%s')",
                            first, second);
    if (fabs(a->normal_module - b->normal_module) > EQUAL_MODULE)
        return gm_part_fail(d, "mesh", &m->id, error,
                            "gears that mesh have the same normal module; found %.6g mm "
                            "('%s') and %.6g mm ('%s')",
                            1e3 * a->normal_module, first, 1e3 * b->normal_module,
                            second);
    if (fabs(a->pressure_angle - b->pressure_angle) > EQUAL_ANGLE)
        return gm_part_fail(
            d, "mesh", &m->id, error,
            "gears that mesh have the same pressure angle; found %.6g deg "
            "('%s') and %.6g deg ('%s')",
            DEGREES * a->pressure_angle, first, DEGREES * b->pressure_angle, second);
    if (fabs(b->helix - hand * a->helix) > EQUAL_ANGLE)
        return gm_part_fail(d, "mesh", &m->id, error,
                            "helix angles must be %s; found %.8g deg ('%s') and %.8g deg "
                            "('%s')",
                            hand > 0.0 ? "equal with internal teeth"
                                       : "equal and opposite",
                            DEGREES * a->helix, first, DEGREES * b->helix, second);
    return GM_OK;
}

static gm_status check_overlap(const gm_description *d, const gm_mesh *m, gm_error *error)
{
    const gm_wheel *a = &d->wheels[m->wheel[0]], *b = &d->wheels[m->wheel[1]];
    double apart = fabs(b->position - a->position);
    double reach = 0.5 * (a->width + b->width);
    if (!(apart < reach - TOUCH))
        return gm_part_fail(
            d, "mesh", &m->id, error,
            "gears '%s' and '%s' must overlap along x; found their middles "
            "%.6g mm apart, expected less than half the sum of their "
            "widths, %.6g mm",
            a->id.name, b->id.name, 1e3 * apart, 1e3 * reach);
    return GM_OK;
}

static gm_pair make_pair(const gm_wheel *a, const gm_wheel *b)
{
    const int z[2] = {a->internal ? -a->teeth : a->teeth,
                      b->internal ? -b->teeth : b->teeth};
    const double x[2] = {a->profile_shift, b->profile_shift};
    return gm_pair_make(z, a->normal_module, a->pressure_angle, fabs(a->helix), x,
                        fmin(a->width, b->width), 0.0);
}

static gm_status check_geometry(const gm_description *d, const gm_mesh *m,
                                gm_error *error)
{
    const gm_wheel *a = &d->wheels[m->wheel[0]], *b = &d->wheels[m->wheel[1]];
    double distance = gm_wheel_distance(d, m->wheel);
    int pins = a->planets > 0 || b->planets > 0;
    if ((a->internal && a->teeth <= b->teeth) || (b->internal && b->teeth <= a->teeth))
        return gm_part_fail(
            d, "mesh", &m->id, error,
            "the gear with internal teeth must be the larger one; found %d "
            "teeth ('%s') and %d teeth ('%s')",
            a->teeth, a->id.name, b->teeth, b->id.name);
    gm_pair pair = make_pair(a, b);
    if (!(fabs(pair.a_w - distance) <= CENTRE_DISTANCE))
        return gm_part_fail(
            d, "mesh", &m->id, error,
            "the centre distance from teeth, module, helix and profile "
            "shift of '%s' and '%s' must be that of %s '%s' and '%s' "
            "within %.2f mm; found %.4f mm from the gears, %.4f mm from the "
            "%s",
            a->id.name, b->id.name, pins ? "the axes of" : "shafts",
            pins ? a->id.name : d->shafts[a->shaft].id.name,
            pins ? b->id.name : d->shafts[b->shaft].id.name, 1e3 * CENTRE_DISTANCE,
            1e3 * pair.a_w, 1e3 * distance, pins ? "pins" : "shafts");
    if (!(pair.eps_alpha >= 1.0 && pair.eps_alpha <= 2.5))
        return gm_part_fail(
            d, "mesh", &m->id, error,
            "the transverse contact ratio must be from 1 to 2.5, found %.4f",
            pair.eps_alpha);
    return GM_OK;
}

/* Planets mesh with gears around the axis of their carrier, or with each other. */
static gm_status check_planet_mesh(const gm_description *d, const gm_mesh *m,
                                   gm_error *error)
{
    const gm_wheel *a = &d->wheels[m->wheel[0]], *b = &d->wheels[m->wheel[1]];
    const gm_wheel *planet = a->planets > 0 ? a : b, *other = planet == a ? b : a;
    const char *carrier = d->shafts[planet->shaft].id.name;
    if (planet->planets == 0)
        return GM_OK;
    if (other->planets > 0 &&
        (other->shaft != planet->shaft || other->planets != planet->planets))
        return gm_part_fail(d, "mesh", &m->id, error,
                            "planets that mesh are as many and on one carrier; found %d "
                            "on '%s' and %d on '%s'",
                            planet->planets, carrier, other->planets,
                            d->shafts[other->shaft].id.name);
    if (other->planets == 0 && other->shaft == planet->shaft && !other->idles)
        return gm_part_fail(d, "mesh", &m->id, error,
                            "planet '%s' must not mesh with a gear that is fixed on its "
                            "own carrier '%s', found '%s'",
                            planet->id.name, carrier, other->id.name);
    double apart = gm_shaft_distance(d, planet->shaft, other->shaft);
    if (apart > GM_CONCENTRIC)
        return gm_part_fail(d, "mesh", &m->id, error,
                            "gear '%s' that meshes with planet '%s' must be concentric "
                            "with the carrier '%s' within %.3f mm; found the axes %.3f "
                            "mm apart",
                            other->id.name, planet->id.name, carrier, 1e3 * GM_CONCENTRIC,
                            1e3 * apart);
    return GM_OK;
}

static gm_status check_partners(const gm_description *d, int mesh, gm_error *error)
{
    const gm_mesh *m = &d->meshes[mesh];
    const gm_wheel *a = &d->wheels[m->wheel[0]], *b = &d->wheels[m->wheel[1]];
    gm_status status = check_planet_mesh(d, m, error);
    if (status != GM_OK)
        return status;
    if (a->shaft == b->shaft && a->planets == 0 && b->planets == 0)
        return gm_part_fail(
            d, "mesh", &m->id, error,
            "gears that mesh sit on different shafts; found '%s' and '%s' "
            "both on '%s'",
            a->id.name, b->id.name, d->shafts[a->shaft].id.name);
    for (int i = 0; i < mesh; i++) {
        const int *w = d->meshes[i].wheel;
        if ((w[0] == m->wheel[0] && w[1] == m->wheel[1]) ||
            (w[0] == m->wheel[1] && w[1] == m->wheel[0]))
            return gm_part_fail(d, "mesh", &m->id, error,
                                "its gears already mesh in '%s', line %d",
                                d->meshes[i].id.name, d->meshes[i].id.line);
    }
    return GM_OK;
}

static gm_status check_loss(const gm_description *d, const gm_mesh *m, gm_error *error)
{
    if (m->loss == GM_MESH_CONSTANT && isnan(m->efficiency))
        return gm_part_fail(d, "mesh", &m->id, error,
                            "the loss model constant needs an efficiency");
    if (m->loss == GM_MESH_TORQUE_DEPENDENT &&
        (isnan(m->idle_torque) || isnan(m->torque_share)))
        return gm_part_fail(d, "mesh", &m->id, error,
                            "the loss model torque_dependent needs idle_torque_Nm and "
                            "torque_share");
    return GM_OK;
}

static gm_status check_mesh(const gm_description *d, int mesh, gm_error *error)
{
    const gm_mesh *m = &d->meshes[mesh];
    gm_status status = check_loss(d, m, error);
    if (status == GM_OK)
        status = check_partners(d, mesh, error);
    if (status == GM_OK)
        status = check_mates(d, m, error);
    if (status == GM_OK)
        status = check_overlap(d, m, error);
    if (status == GM_OK)
        status = check_geometry(d, m, error);
    return status;
}

/* Mate of a planet with external (0) or internal teeth (1); NULL: none. */
static const gm_wheel *mate_of(const gm_description *d, int planet, int internal)
{
    for (int i = 0; i < d->n_meshes; i++)
        for (int side = 0; side < 2; side++) {
            const gm_wheel *mate = &d->wheels[d->meshes[i].wheel[1 - side]];
            if (d->meshes[i].wheel[side] == planet && mate->planets == 0 &&
                mate->internal == internal)
                return mate;
        }
    return NULL;
}

/* Teeth find their gaps all around only if sun and ring together are divisible. */
static gm_status check_even(const gm_description *d, int wheel, gm_error *error)
{
    const gm_wheel *w = &d->wheels[wheel];
    const gm_wheel *sun = mate_of(d, wheel, 0), *ring = mate_of(d, wheel, 1);
    if (w->planets == 0 || !sun || !ring || (sun->teeth + ring->teeth) % w->planets == 0)
        return GM_OK;
    return gm_part_fail(d, "gear", &w->id, error,
                        "%d planets stand evenly only where the teeth of sun and ring "
                        "add up to a multiple of %d; found %d ('%s') and %d ('%s')",
                        w->planets, w->planets, sun->teeth, sun->id.name, ring->teeth,
                        ring->id.name);
}

static gm_status check_has_mesh(const gm_description *d, int wheel, gm_error *error)
{
    for (int i = 0; i < d->n_meshes; i++)
        if (d->meshes[i].wheel[0] == wheel || d->meshes[i].wheel[1] == wheel)
            return GM_OK;
    return gm_part_fail(d, "gear", &d->wheels[wheel].id, error,
                        "is in no mesh; every gear needs at least 1, found 0");
}

gm_status gm_check_gears(const gm_description *d, gm_error *error)
{
    gm_status status = GM_OK;
    for (int i = 0; i < d->n_wheels && status == GM_OK; i++)
        status = check_gear(d, &d->wheels[i], error);
    for (int i = 0; i < d->n_wheels && status == GM_OK; i++)
        status = check_has_mesh(d, i, error);
    for (int i = 0; i < d->n_meshes && status == GM_OK; i++)
        status = check_mesh(d, i, error);
    for (int i = 0; i < d->n_wheels && status == GM_OK; i++)
        status = check_even(d, i, error);
    return status;
}
