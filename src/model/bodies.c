/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Masses and moments of inertia of the rotating bodies: every shaft with the gears that
 * are fixed on it, then every idling gear as a body of its own. From geometry (steel,
 * solid of revolution up to the pitch circle) unless given. All planets of a kind are one
 * body, which turns about their pins; the carrier moves their masses around its axis.
 */
#include "model/gearset.h"

#include "base/alloc.h"
#include "model/inertia.h"

#include <math.h>

double gm_shaft_mass(const gm_shaft *shaft, double *centre)
{
    double mass = 0.0, moment = 0.0, middle = 0.0;
    for (int i = 0; i < shaft->n_segments; i++) {
        const gm_segment *s = &shaft->segments[i];
        double m =
            gm_cylinder_mass(GM_STEEL_DENSITY, s->to - s->from, s->diameter, s->bore);
        mass += m;
        moment += m * 0.5 * (s->from + s->to);
        middle += 0.5 * (s->from + s->to) / shaft->n_segments;
    }
    *centre = mass > 0.0 ? moment / mass : middle;
    return isnan(shaft->mass) ? mass : shaft->mass;
}

static double shaft_inertia(const gm_shaft *shaft)
{
    if (!isnan(shaft->inertia))
        return shaft->inertia;
    double J = 0.0;
    for (int i = 0; i < shaft->n_segments; i++) {
        const gm_segment *s = &shaft->segments[i];
        J += gm_cylinder_inertia(GM_STEEL_DENSITY, s->to - s->from, s->diameter, s->bore);
    }
    return J;
}

/* Outside diameter of a shaft where a gear sits; 0 beyond its segments. */
static double shaft_diameter_at(const gm_shaft *shaft, double x)
{
    for (int i = 0; i < shaft->n_segments; i++)
        if (x >= shaft->segments[i].from && x <= shaft->segments[i].to)
            return shaft->segments[i].diameter;
    return 0.0;
}

static double wheel_bore(const gm_description *d, const gm_wheel *wheel)
{
    if (!isnan(wheel->bore))
        return wheel->bore;
    return shaft_diameter_at(&d->shafts[wheel->shaft], wheel->position);
}

static double pitch_diameter(const gm_wheel *wheel)
{
    return wheel->normal_module * wheel->teeth / cos(wheel->helix);
}

double gm_wheel_mass(const gm_description *description, const gm_wheel *wheel)
{
    if (!isnan(wheel->mass))
        return wheel->mass;
    return fmax(0.0,
                gm_cylinder_mass(GM_STEEL_DENSITY, wheel->width, pitch_diameter(wheel),
                                 wheel_bore(description, wheel)));
}

double gm_wheel_inertia(const gm_description *d, const gm_wheel *wheel)
{
    if (!isnan(wheel->inertia))
        return wheel->inertia;
    return fmax(0.0, gm_cylinder_inertia(GM_STEEL_DENSITY, wheel->width,
                                         pitch_diameter(wheel), wheel_bore(d, wheel)));
}

gm_status gm_bodies_make(gm_gearset *gearset, gm_error *error)
{
    const gm_description *d = gearset->description;
    gearset->bodies =
        gm_calloc((size_t)(d->n_shafts + d->n_wheels), sizeof *gearset->bodies);
    gearset->wheel_body = gm_calloc((size_t)d->n_wheels, sizeof *gearset->wheel_body);
    if (!gearset->bodies || !gearset->wheel_body)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    for (int s = 0; s < d->n_shafts; s++) {
        double centre;
        gearset->bodies[s].inertia = shaft_inertia(&d->shafts[s]);
        gearset->bodies[s].mass = gm_shaft_mass(&d->shafts[s], &centre);
    }
    gearset->n_bodies = d->n_shafts;
    for (int w = 0; w < d->n_wheels; w++) {
        const gm_wheel *wheel = &d->wheels[w];
        int body = wheel->idles ? gearset->n_bodies++ : wheel->shaft;
        int n = wheel->planets > 0 ? wheel->planets : 1;
        gearset->wheel_body[w] = body;
        gearset->bodies[body].inertia += n * gm_wheel_inertia(d, wheel);
        gearset->bodies[body].mass += n * gm_wheel_mass(d, wheel);
        if (wheel->planets > 0)
            gearset->bodies[wheel->shaft].inertia +=
                n * gm_wheel_mass(d, wheel) * wheel->pin_radius * wheel->pin_radius;
    }
    return GM_OK;
}
