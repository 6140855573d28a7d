/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Assembly: from the parts of a description to bodies, rows and friction elements.
 */
#include "model/gearset.h"

#include "base/alloc.h"

#include <math.h>
#include <string.h>

#define INFINITE_CLEARANCE 0.0 /* a synchroniser without a clearance has no open drag */

static gm_status no_memory(gm_error *error)
{
    return gm_fail(error, GM_ERR_MEMORY, "out of memory");
}

/* ---- meshes ---- */

static double centre_distance(const gm_description *d, const gm_mesh *mesh)
{
    const gm_shaft *a = &d->shafts[d->wheels[mesh->wheel[0]].shaft];
    const gm_shaft *b = &d->shafts[d->wheels[mesh->wheel[1]].shaft];
    return hypot(b->y - a->y, b->z - a->z);
}

static gm_pair make_pair(const gm_description *d, const gm_mesh *mesh)
{
    const gm_wheel *w0 = &d->wheels[mesh->wheel[0]], *w1 = &d->wheels[mesh->wheel[1]];
    const int z[2] = {w0->internal ? -w0->teeth : w0->teeth,
                      w1->internal ? -w1->teeth : w1->teeth};
    const double x[2] = {w0->profile_shift, w1->profile_shift};
    return gm_pair_make(z, w0->normal_module, w0->pressure_angle, fabs(w0->helix), x,
                        fmin(w0->width, w1->width), centre_distance(d, mesh));
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
    const gm_shaft *s = &d->shafts[own->shaft], *o = &d->shafts[mate->shaft];
    double a = hypot(o->y - s->y, o->z - s->z);
    double out = mate->internal ? -1.0 : 1.0; /* inside a ring: away from its centre */
    double e_y = out * (o->y - s->y) / a, e_z = out * (o->z - s->z) / a;
    double t_y = -e_z, t_z = e_y;
    double r_w = 0.5 * fabs(pair->d_w[side]);
    double row_sign = own->internal ? -1.0 : 1.0;
    double F_t = -row_sign * cos(pair->alpha_wt);
    double F_r = (own->internal ? -1.0 : 1.0) * sin(pair->alpha_wt);
    double tan_beta_w = tan(own->helix) * pair->d_w[side] / pair->d[side];
    return (gm_contact){
        .signed_part = {-F_t * tan_beta_w, F_t * t_y, F_t * t_z},
        .magnitude_part = {0.0, -F_r * e_y, -F_r * e_z},
        .point = {own->position, s->y + r_w * e_y, s->z + r_w * e_z},
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
    element->carrier = GM_HOUSING;
    element->contacts = 1;
    make_rows(gearset, mesh, element);
    for (int side = 0; side < 2; side++)
        element->contact[side] = make_contact(d, mesh, &element->pair, side);
}

static gm_status make_meshes(gm_gearset *gearset, gm_error *error)
{
    int n = gearset->description->n_meshes;
    gearset->meshes = gm_calloc((size_t)n, sizeof *gearset->meshes);
    if (!gearset->meshes)
        return no_memory(error);
    gearset->n_meshes = n;
    for (int m = 0; m < n; m++)
        make_mesh(gearset, m);
    return GM_OK;
}

/* ---- bearings ---- */

static gm_status make_law(const gm_gearset *gearset, const gm_bearing_data *data,
                          const gm_label *id, gm_bearing_law *law, gm_error *error)
{
    gm_error detail = {GM_OK, ""};
    gm_status status = gm_bearing_law_make(data, &gearset->oil, law, &detail);
    if (status != GM_OK)
        return gm_fail(error, status, "%s:%d: %s: %s", gearset->description->file,
                       id->line, id->name, detail.message);
    return GM_OK;
}

/* Oil level above the lowest contact of the outer raceway, whose diameter is about
 * d_m + 0.3 (D - d): rolling elements of 0.3 (D - d). NAN without a bath. */
static double bath_level(const gm_description *d, const gm_bearing *bearing,
                         const gm_bearing_law *law)
{
    double d_m = 0.5 * (law->data.d + law->data.D);
    double raceway = 0.5 * (d_m + 0.3 * (law->data.D - law->data.d));
    return d->oil.level - (d->shafts[bearing->shaft].z - raceway);
}

static gm_status shaft_bearings(gm_gearset *gearset, gm_error *error)
{
    const gm_description *d = gearset->description;
    for (int i = 0; i < d->n_bearings; i++) {
        const gm_bearing *bearing = &d->bearings[i];
        gm_bearing_element *element = &gearset->bearings[i];
        *element = (gm_bearing_element){.kind = GM_LOSS_BEARING,
                                        .name = bearing->id.name,
                                        .body = bearing->shaft,
                                        .on = bearing->on};
        gm_status status =
            make_law(gearset, &bearing->data, &bearing->id, &element->law, error);
        if (status != GM_OK)
            return status;
        if (bearing->on == GM_HOUSING)
            gm_bearing_immerse(&element->law, bath_level(d, bearing, &element->law));
    }
    gearset->n_bearings = d->n_bearings;
    return GM_OK;
}

/* The meshes of one wheel and what they do to it. */
static gm_status wheel_load(gm_gearset *gearset, int wheel, gm_load_row *load,
                            gm_error *error)
{
    const gm_description *d = gearset->description;
    int n = 0;
    int *mesh = gm_calloc((size_t)d->n_meshes, sizeof *mesh);
    const gm_contact **contact = gm_calloc((size_t)d->n_meshes, sizeof *contact);
    gm_status status = GM_OK;
    if (!mesh || !contact) {
        status = no_memory(error);
        goto done;
    }
    for (int m = 0; m < d->n_meshes; m++)
        for (int side = 0; side < 2; side++)
            if (d->meshes[m].wheel[side] == wheel) {
                mesh[n] = m;
                contact[n++] = &gearset->meshes[m].contact[side];
            }
    status = gm_statics_wheel(gm_wheel_mass(d, &d->wheels[wheel]), n, mesh, contact, load,
                              error);
done:
    gm_free(mesh);
    gm_free(contact);
    return status;
}

static gm_status idler_bearings(gm_gearset *gearset, gm_error *error)
{
    const gm_description *d = gearset->description;
    gm_status status = GM_OK;
    for (int w = 0; w < d->n_wheels && status == GM_OK; w++) {
        const gm_wheel *wheel = &d->wheels[w];
        if (!wheel->idles)
            continue;
        gm_bearing_element *element = &gearset->bearings[gearset->n_bearings++];
        *element = (gm_bearing_element){.kind = GM_LOSS_IDLER,
                                        .name = wheel->id.name,
                                        .body = gearset->wheel_body[w],
                                        .on = wheel->shaft};
        status = make_law(gearset, &wheel->bearing, &wheel->id, &element->law, error);
        if (status == GM_OK)
            status = wheel_load(gearset, w, &element->load, error);
    }
    return status;
}

static int collect_masses(const gm_gearset *gearset, gm_static_mass *masses)
{
    const gm_description *d = gearset->description;
    int n = 0;
    for (int s = 0; s < d->n_shafts; s++, n++) {
        masses[n].shaft = s;
        masses[n].mass = gm_shaft_mass(&d->shafts[s], &masses[n].position);
    }
    for (int w = 0; w < d->n_wheels; w++, n++)
        masses[n] = (gm_static_mass){.shaft = d->wheels[w].shaft,
                                     .position = d->wheels[w].position,
                                     .mass = gm_wheel_mass(d, &d->wheels[w])};
    return n;
}

/* Loads of the shaft bearings by statics. */
static gm_status shaft_loads(gm_gearset *gearset, gm_error *error)
{
    const gm_description *d = gearset->description;
    gm_status status = GM_OK;
    gm_static_mesh *meshes = gm_calloc((size_t)d->n_meshes, sizeof *meshes);
    gm_static_mass *masses =
        gm_calloc((size_t)(d->n_shafts + d->n_wheels), sizeof *masses);
    gm_load_row *rows = gm_calloc((size_t)d->n_bearings, sizeof *rows);
    if (!meshes || !masses || !rows) {
        status = no_memory(error);
        goto done;
    }
    for (int m = 0; m < d->n_meshes; m++)
        for (int side = 0; side < 2; side++) {
            meshes[m].shaft[side] = d->wheels[d->meshes[m].wheel[side]].shaft;
            meshes[m].contact[side] = gearset->meshes[m].contact[side];
        }
    int n_masses = collect_masses(gearset, masses);
    status = gm_statics_solve(d, d->n_meshes, meshes, n_masses, masses, rows, error);
    for (int i = 0; i < d->n_bearings && status == GM_OK; i++)
        gearset->bearings[i].load = rows[i];
done:
    gm_free(meshes);
    gm_free(masses);
    gm_free(rows);
    return status;
}

static gm_status make_bearings(gm_gearset *gearset, gm_error *error)
{
    const gm_description *d = gearset->description;
    gearset->bearings =
        gm_calloc((size_t)(d->n_bearings + d->n_wheels), sizeof *gearset->bearings);
    if (!gearset->bearings)
        return no_memory(error);
    gm_status status = shaft_bearings(gearset, error);
    if (status == GM_OK)
        status = shaft_loads(gearset, error);
    if (status == GM_OK)
        status = idler_bearings(gearset, error);
    return status;
}

/* ---- drags of speed alone ---- */

static void add_seals_and_gaps(gm_gearset *gearset)
{
    const gm_description *d = gearset->description;
    for (int i = 0; i < d->n_seals; i++)
        gearset->drags[gearset->n_drags++] =
            (gm_drag_element){.kind = GM_LOSS_SEAL,
                              .name = d->seals[i].id.name,
                              .body = d->seals[i].shaft,
                              .on = d->seals[i].on,
                              .law = GM_DRAG_SEAL,
                              .seal = d->seals[i].model,
                              .radius = 0.5 * d->seals[i].diameter};
    for (int i = 0; i < d->n_gaps; i++)
        gearset->drags[gearset->n_drags++] =
            (gm_drag_element){.kind = GM_LOSS_GAP,
                              .name = d->gaps[i].id.name,
                              .body = d->gaps[i].inner,
                              .on = d->gaps[i].outer,
                              .law = GM_DRAG_GAP,
                              .radius = d->gaps[i].radius,
                              .length = d->gaps[i].length,
                              .clearance = d->gaps[i].clearance};
}

static void add_cones(gm_gearset *gearset)
{
    const gm_description *d = gearset->description;
    for (int i = 0; i < d->n_synchronisers; i++) {
        const gm_synchroniser *sync = &d->synchronisers[i];
        for (int k = 0; k < sync->n_wheels && sync->cone_clearance > INFINITE_CLEARANCE;
             k++)
            gearset->drags[gearset->n_drags++] =
                (gm_drag_element){.kind = GM_LOSS_SYNCHRONISER,
                                  .name = d->wheels[sync->wheels[k]].id.name,
                                  .body = gearset->wheel_body[sync->wheels[k]],
                                  .on = sync->shaft,
                                  .law = GM_DRAG_GAP,
                                  .radius = sync->cone_radius,
                                  .length = sync->cone_width,
                                  .clearance = sync->cone_clearance};
    }
}

static void add_churning(gm_gearset *gearset)
{
    const gm_description *d = gearset->description;
    for (int w = 0; w < d->n_wheels; w++) {
        const gm_wheel *wheel = &d->wheels[w];
        double tip = wheel->normal_module * (0.5 * wheel->teeth / cos(wheel->helix) +
                                             1.0 + wheel->profile_shift);
        double depth = d->oil.level - (d->shafts[wheel->shaft].z - tip);
        if (!wheel->churning || isnan(d->oil.level) || depth <= 0.0)
            continue;
        gearset->drags[gearset->n_drags++] = (gm_drag_element){
            .kind = GM_LOSS_CHURNING,
            .name = wheel->id.name,
            .body = gearset->wheel_body[w],
            .on = GM_HOUSING,
            .law = GM_DRAG_CHURNING,
            .dip = {.R_p = 0.5 * wheel->normal_module * wheel->teeth / cos(wheel->helix),
                    .b = wheel->width,
                    .h = depth,
                    .V_0 = d->oil.volume}};
    }
}

static gm_status make_drags(gm_gearset *gearset, gm_error *error)
{
    const gm_description *d = gearset->description;
    int n = d->n_seals + d->n_gaps + d->n_wheels;
    for (int i = 0; i < d->n_synchronisers; i++)
        n += d->synchronisers[i].n_wheels;
    gearset->drags = gm_calloc((size_t)n, sizeof *gearset->drags);
    if (!gearset->drags)
        return no_memory(error);
    add_seals_and_gaps(gearset);
    add_cones(gearset);
    add_churning(gearset);
    return GM_OK;
}

/* ---- the whole ---- */

gm_status gm_gearset_create(const gm_description *description, double oil_temperature,
                            gm_gearset **gearset, gm_error *error)
{
    gm_gearset *g = gm_calloc(1, sizeof *g);
    if (!g)
        return no_memory(error);
    g->description = description;
    g->oil = gm_oil_at(&description->oil, oil_temperature);
    gm_status status = gm_bodies_make(g, error);
    if (status == GM_OK)
        status = make_meshes(g, error);
    if (status == GM_OK)
        status = make_bearings(g, error);
    if (status == GM_OK)
        status = make_drags(g, error);
    if (status == GM_OK)
        status = gm_gearset_check_ratios(g, error);
    if (status != GM_OK) {
        gm_gearset_destroy(g);
        return status;
    }
    *gearset = g;
    return GM_OK;
}

void gm_gearset_destroy(gm_gearset *gearset)
{
    if (!gearset)
        return;
    for (int i = 0; i < gearset->n_bearings; i++)
        gm_load_row_clear(&gearset->bearings[i].load);
    gm_free(gearset->bearings);
    gm_free(gearset->drags);
    gm_free(gearset->meshes);
    gm_free(gearset->bodies);
    gm_free(gearset->wheel_body);
    gm_free(gearset);
}

const gm_description *gm_gearset_description(const gm_gearset *gearset)
{
    return gearset->description;
}

double gm_gearset_oil_temperature(const gm_gearset *gearset)
{
    return gearset->oil.temperature;
}

int gm_gearset_element_count(const gm_gearset *gearset)
{
    return gearset->n_meshes + gearset->n_bearings + gearset->n_drags;
}

const char *gm_loss_kind_name(gm_loss_kind kind)
{
    switch (kind) {
    case GM_LOSS_MESH:
        return "meshes";
    case GM_LOSS_BEARING:
        return "bearings";
    case GM_LOSS_IDLER:
        return "idling gears";
    case GM_LOSS_SEAL:
        return "seals";
    case GM_LOSS_SYNCHRONISER:
        return "open synchronisers";
    case GM_LOSS_GAP:
        return "concentric shafts";
    case GM_LOSS_CHURNING:
        return "churning";
    case GM_LOSS_KINDS:
        break;
    }
    return "unknown";
}
