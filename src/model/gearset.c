/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Assembly: from the parts of a description to bodies, rows and friction elements.
 */
#include "model/gearset.h"

#include "base/alloc.h"

#include <math.h>
#include <string.h>

static gm_status no_memory(gm_error *error)
{
    return gm_fail(error, GM_ERR_MEMORY, "out of memory");
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
                                        .on = bearing->on,
                                        .position = bearing->position,
                                        .count = 1};
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

/* A planet turns around its carrier: weight goes round with it and is left out, the force
 * on its pin points outwards. Every planet carries its share of the row forces. */
static void load_planet(const gm_description *d, const gm_wheel *wheel,
                        gm_bearing_element *element)
{
    gm_load_row *load = &element->load;
    double pull = gm_wheel_mass(d, wheel) * wheel->pin_radius;
    element->centrifugal[1] = pull * cos(wheel->pin_angle);
    element->centrifugal[2] = pull * sin(wheel->pin_angle);
    for (int i = 0; i < 3; i++) {
        load->weight[i] = 0.0;
        for (int k = 0; k < load->n; k++) {
            load->a[k][i] /= wheel->planets;
            load->b[k][i] /= wheel->planets;
        }
    }
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
                                        .on = wheel->shaft,
                                        .position = wheel->position,
                                        .count = wheel->planets > 0 ? wheel->planets : 1};
        status = make_law(gearset, &wheel->bearing, &wheel->id, &element->law, error);
        if (status == GM_OK)
            status = wheel_load(gearset, w, &element->load, error);
        if (status == GM_OK && wheel->planets > 0)
            load_planet(d, wheel, element);
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
                                     .mass = fmax(1.0, d->wheels[w].planets) *
                                             gm_wheel_mass(d, &d->wheels[w])};
    return n;
}

/* Force of a mesh on the shaft that carries one of its wheels. Contacts that stand evenly
 * around its axis leave the sum of their axial forces. */
static gm_contact contact_on_shaft(const gm_gearset *gearset, int m, int side)
{
    const gm_description *d = gearset->description;
    const gm_contact *c = &gearset->meshes[m].contact[side];
    const gm_shaft *s = &d->shafts[d->wheels[d->meshes[m].wheel[side]].shaft];
    if (gearset->meshes[m].contacts == 1)
        return *c;
    return (gm_contact){.signed_part = {c->signed_part[0], 0.0, 0.0},
                        .magnitude_part = {c->magnitude_part[0], 0.0, 0.0},
                        .point = {c->point[0], s->y, s->z}};
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
            meshes[m].contact[side] = contact_on_shaft(gearset, m, side);
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

/* Axial force by radial load, see thrust.c. */
static double induced_factor(const gm_bearing *bearing)
{
    if (!isnan(bearing->induced))
        return bearing->induced;
    if (bearing->data.type == GM_BEARING_TAPERED_ROLLER)
        return 0.5 / bearing->data.Y;
    return bearing->data.type == GM_BEARING_ANGULAR_CONTACT_BALL ? 1.14 : 0.0;
}

static double preload_at(const gm_bearing *bearing, double temperature)
{
    const double room = 293.15; /* K */
    return fmax(bearing->preload + bearing->preload_change * (temperature - room), 0.0);
}

/* Bearings that hold one direction each, with equal holders (check_thrust.c). */
static void pair_bearings(gm_gearset *gearset)
{
    const gm_description *d = gearset->description;
    for (int i = 0; i < d->n_bearings; i++)
        for (int k = 0; k < d->n_bearings; k++) {
            const gm_bearing *plus = &d->bearings[i], *minus = &d->bearings[k];
            gm_load_row *one = &gearset->bearings[i].load,
                        *other = &gearset->bearings[k].load;
            if (plus->thrust <= 0 || minus->thrust >= 0 || plus->shaft != minus->shaft)
                continue;
            one->way = 1.0, other->way = -1.0;
            one->induced = induced_factor(plus), other->induced = induced_factor(minus);
            one->preload = preload_at(plus, gearset->oil.temperature);
            other->preload = one->preload;
            gm_thrust_pair(one, other);
        }
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
        pair_bearings(gearset);
    if (status == GM_OK)
        status = idler_bearings(gearset, error);
    return status;
}

gm_bearing_load gm_bearing_load_at(const gm_bearing_element *bearing, double w_on,
                                   const double *F, double *d_radial, double *d_axial)
{
    const double *c = bearing->centrifugal;
    gm_load_row row = bearing->load;
    gm_bearing_load load = {0.0, 0.0, 0.0};
    double v[3];
    for (int i = 0; i < 3; i++)
        row.weight[i] += c[i] * w_on * w_on;
    gm_load_row_at(&row, F, &load.radial, &load.axial, d_radial, d_axial);
    if (c[1] == 0.0 && c[2] == 0.0)
        return load;
    gm_load_row_vector(&row, F, v);
    if (load.radial > 0.0)
        load.d_radial_on = 2.0 * w_on * (c[1] * v[1] + c[2] * v[2]) / load.radial;
    return load;
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
        status = gm_meshes_make(g, error);
    if (status == GM_OK)
        status = make_bearings(g, error);
    if (status == GM_OK)
        status = gm_drags_make(g, error);
    if (status == GM_OK)
        status = gm_gearset_check_inertia(g, error);
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
    case GM_LOSS_CLUTCH:
        return "open clutches";
    case GM_LOSS_GAP:
        return "concentric shafts";
    case GM_LOSS_CHURNING:
        return "churning";
    case GM_LOSS_WINDAGE:
        return "windage";
    case GM_LOSS_JET:
        return "oil jets";
    case GM_LOSS_KINDS:
        break;
    }
    return "unknown";
}
