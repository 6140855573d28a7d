/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Meshes: the rows that they are, and what their forces do to the wheels. With base radii
 * r_b (negative for internal teeth) and, where a planet gear takes part, the carrier c:
 *
 *   r_b,0 (w_0 - w_c) + r_b,1 (w_1 - w_c) = 0
 *
 * Planets stand evenly around the axis of their carrier and share the load equally, so
 * that one row stands for all of them: sun, ring and carrier see the sum of the axial
 * forces and no net radial force.
 */
#include "model/gearset.h"

#include "base/alloc.h"

#include <math.h>

void gm_wheel_axis(const gm_description *description, int wheel, double axis[2])
{
    const gm_wheel *w = &description->wheels[wheel];
    const gm_shaft *s = &description->shafts[w->shaft];
    double r = w->planets > 0 ? w->pin_radius : 0.0;
    axis[0] = s->y + (r > 0.0 ? r * cos(w->pin_angle) : 0.0);
    axis[1] = s->z + (r > 0.0 ? r * sin(w->pin_angle) : 0.0);
}

double gm_wheel_distance(const gm_description *description, const int wheel[2])
{
    double a[2], b[2];
    gm_wheel_axis(description, wheel[0], a);
    gm_wheel_axis(description, wheel[1], b);
    return hypot(b[0] - a[0], b[1] - a[1]);
}

static gm_pair make_pair(const gm_description *d, const gm_mesh *mesh)
{
    const gm_wheel *w0 = &d->wheels[mesh->wheel[0]], *w1 = &d->wheels[mesh->wheel[1]];
    const int z[2] = {w0->internal ? -w0->teeth : w0->teeth,
                      w1->internal ? -w1->teeth : w1->teeth};
    const double x[2] = {w0->profile_shift, w1->profile_shift};
    return gm_pair_make(z, w0->normal_module, w0->pressure_angle, fabs(w0->helix), x,
                        fmin(w0->width, w1->width), gm_wheel_distance(d, mesh->wheel));
}

/* Normal force of a mesh on one wheel. With e from the wheel's centre to the pitch
 * point's side and t = x cross e, the base-tangent force F gives the torque -r_b F about
 * +x: F_t = -F cos(alpha_wt) along t, |F| sin(alpha_wt) away from the mate, and the axial
 * force -h F_t tan(beta_w), h = +1 for right-hand teeth (derived from the tooth trace).
 */
static gm_contact make_contact(const gm_description *d, const gm_mesh *mesh,
                               const gm_pair *pair, int side)
{
    const gm_wheel *own = &d->wheels[mesh->wheel[side]];
    const gm_wheel *mate = &d->wheels[mesh->wheel[1 - side]];
    double s[2], o[2], a = gm_wheel_distance(d, mesh->wheel);
    gm_wheel_axis(d, mesh->wheel[side], s);
    gm_wheel_axis(d, mesh->wheel[1 - side], o);
    double out = mate->internal ? -1.0 : 1.0; /* inside a ring: away from its centre */
    double e_y = out * (o[0] - s[0]) / a, e_z = out * (o[1] - s[1]) / a;
    double t_y = -e_z, t_z = e_y;
    double r_w = 0.5 * fabs(pair->d_w[side]);
    double row_sign = own->internal ? -1.0 : 1.0;
    double F_t = -row_sign * cos(pair->alpha_wt);
    double F_r = (own->internal ? -1.0 : 1.0) * sin(pair->alpha_wt);
    double tan_beta_w = tan(own->helix) * pair->d_w[side] / pair->d[side];
    return (gm_contact){
        .signed_part = {-F_t * tan_beta_w, F_t * t_y, F_t * t_z},
        .magnitude_part = {0.0, -F_r * e_y, -F_r * e_z},
        .point = {own->position, s[0] + r_w * e_y, s[1] + r_w * e_z},
    };
}

/* Rows of a mesh: along the line of action, and of its rolling speed. */
static void make_rows(const gm_gearset *gearset, const gm_mesh *mesh,
                      gm_mesh_element *element)
{
    gm_row *row = &element->row, *roll = &element->roll;
    for (int side = 0; side < 2; side++) {
        const gm_wheel *wheel = &gearset->description->wheels[mesh->wheel[side]];
        double sign = wheel->internal ? -1.0 : 1.0;
        row->body[side] = gearset->wheel_body[mesh->wheel[side]];
        row->g[side] = 0.5 * sign * fabs(element->pair.d_b[side]);
    }
    row->n = 2;
    row->body[2] = element->carrier;
    row->g[2] = -(row->g[0] + row->g[1]);
    if (element->carrier != GM_HOUSING)
        row->n = 3;
    *roll = *row;
    roll->g[0] = 0.5 * row->g[0];
    roll->g[1] = -0.5 * row->g[1];
    roll->g[2] = -(roll->g[0] + roll->g[1]);
}

/* The carrier of the planets that take part; both wheels may be planets of one. */
static void see_from_carrier(const gm_gearset *gearset, const gm_mesh *mesh,
                             gm_mesh_element *element)
{
    element->carrier = GM_HOUSING;
    element->contacts = 1;
    for (int side = 0; side < 2; side++) {
        const gm_wheel *wheel = &gearset->description->wheels[mesh->wheel[side]];
        if (wheel->planets > 0) {
            element->carrier = wheel->shaft;
            element->contacts = wheel->planets;
        }
    }
}

static void make_mesh(gm_gearset *gearset, int m)
{
    const gm_description *d = gearset->description;
    const gm_mesh *mesh = &d->meshes[m];
    gm_mesh_element *element = &gearset->meshes[m];
    element->pair = make_pair(d, mesh);
    element->cos_alpha_wt = cos(element->pair.alpha_wt);
    double roughness =
        0.5 * (d->wheels[mesh->wheel[0]].roughness + d->wheels[mesh->wheel[1]].roughness);
    element->law = gm_mesh_law_make(mesh, &element->pair, roughness, &gearset->oil);
    see_from_carrier(gearset, mesh, element);
    make_rows(gearset, mesh, element);
    for (int side = 0; side < 2; side++)
        element->contact[side] = make_contact(d, mesh, &element->pair, side);
}

gm_status gm_meshes_make(gm_gearset *gearset, gm_error *error)
{
    int n = gearset->description->n_meshes;
    gearset->meshes = gm_calloc((size_t)n, sizeof *gearset->meshes);
    if (!gearset->meshes)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    gearset->n_meshes = n;
    for (int m = 0; m < n; m++)
        make_mesh(gearset, m);
    return GM_OK;
}
