/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Nodes of a gearset: every station of every shaft, every other body. The inertia of a
 * twisting shaft's own cylinders is spread over its stations, that of each fixed gear
 * belongs to the station where it sits.
 */
#include "model/nodes.h"

#include "base/alloc.h"
#include "model/stiffness.h"

#include <math.h>

const gm_label *gm_body_label(const gm_gearset *gearset, int body)
{
    const gm_description *d = gearset->description;
    for (int w = 0; w < d->n_wheels && body >= d->n_shafts; w++)
        if (gearset->wheel_body[w] == body)
            return &d->wheels[w].id;
    return &d->shafts[body < d->n_shafts ? body : 0].id;
}

static gm_status make_stations(gm_nodes *nodes, gm_error *error)
{
    const gm_description *d = nodes->gearset->description;
    for (int s = 0; s < d->n_shafts; s++) {
        gm_status status = gm_stations_make(d, s, &nodes->stations[s], error);
        if (status != GM_OK)
            return status;
        nodes->n_pieces += nodes->stations[s].n - 1;
    }
    nodes->n = nodes->gearset->n_bodies + nodes->n_pieces;
    return GM_OK;
}

static void number_nodes(gm_nodes *nodes)
{
    const gm_gearset *g = nodes->gearset;
    for (int b = 0, n = 0; b < g->n_bodies; b++) {
        int count = b < g->description->n_shafts ? nodes->stations[b].n : 1;
        nodes->first[b] = n;
        for (int i = 0; i < count; i++)
            nodes->body[n++] = b;
    }
}

static gm_status make_inertia(gm_nodes *nodes, gm_error *error)
{
    const gm_gearset *g = nodes->gearset;
    const gm_description *d = g->description;
    for (int b = 0; b < g->n_bodies; b++)
        nodes->inertia[nodes->first[b]] = g->bodies[b].inertia;
    for (int s = 0; s < d->n_shafts; s++) {
        const gm_stations *st = &nodes->stations[s];
        double own = g->bodies[s].inertia;
        for (int w = 0; w < d->n_wheels; w++)
            if (g->wheel_body[w] == s)
                own -= gm_wheel_inertia(d, &d->wheels[w]);
        for (int i = 0; i < st->n && st->n > 1; i++)
            nodes->inertia[nodes->first[s] + i] = own * st->share[i];
        for (int w = 0; w < d->n_wheels && st->n > 1; w++)
            if (g->wheel_body[w] == s)
                nodes->inertia[gm_node_at(nodes, s, d->wheels[w].position)] +=
                    gm_wheel_inertia(d, &d->wheels[w]);
    }
    for (int i = 0; i < nodes->n; i++) {
        const gm_label *id = gm_body_label(g, nodes->body[i]);
        if (!(nodes->inertia[i] > 0.0))
            return gm_fail(error, GM_ERR_MODEL,
                           "%s:%d: '%s' has no moment of inertia: it cannot move in time",
                           d->file, id->line, id->name);
    }
    return GM_OK;
}

static void make_pieces(gm_nodes *nodes)
{
    const gm_description *d = nodes->gearset->description;
    gm_piece *piece = nodes->pieces;
    for (int s = 0; s < d->n_shafts; s++)
        for (int i = 0; i + 1 < nodes->stations[s].n; i++, piece++) {
            int node = nodes->first[s] + i;
            gm_flanks twist = {.model = GM_CONTACT_LINEAR,
                               .damping_ratio = d->shafts[s].torsion_damping};
            *piece = (gm_piece){.shaft = s, .number = i};
            piece->row = (gm_row){.n = 2, .body = {node, node + 1}, .g = {1.0, -1.0}};
            piece->law = gm_flanks_law(&twist, nodes->stations[s].stiffness[i], 0.0,
                                       gm_row_reduced_mass(&piece->row, nodes->inertia));
        }
}

static gm_status build(gm_nodes *nodes, gm_error *error)
{
    const gm_gearset *g = nodes->gearset;
    size_t n_shafts = (size_t)g->description->n_shafts;
    nodes->stations = gm_calloc(n_shafts, sizeof *nodes->stations);
    if (!nodes->stations)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    gm_status status = make_stations(nodes, error);
    if (status != GM_OK)
        return status;
    nodes->first = gm_calloc((size_t)g->n_bodies, sizeof *nodes->first);
    nodes->body = gm_calloc((size_t)nodes->n, sizeof *nodes->body);
    nodes->inertia = gm_calloc((size_t)nodes->n, sizeof *nodes->inertia);
    nodes->pieces = gm_calloc((size_t)nodes->n_pieces, sizeof *nodes->pieces);
    if (!nodes->first || !nodes->body || !nodes->inertia || !nodes->pieces)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    number_nodes(nodes);
    status = make_inertia(nodes, error);
    if (status == GM_OK)
        make_pieces(nodes);
    return status;
}

gm_status gm_nodes_make(const gm_gearset *gearset, gm_nodes *nodes, gm_error *error)
{
    gm_nodes made = {.gearset = gearset};
    gm_status status = build(&made, error);
    if (status == GM_OK)
        *nodes = made;
    else
        gm_nodes_clear(&made);
    return status;
}

void gm_nodes_clear(gm_nodes *nodes)
{
    if (nodes->stations)
        for (int s = 0; s < nodes->gearset->description->n_shafts; s++)
            gm_stations_clear(&nodes->stations[s]);
    gm_free(nodes->stations);
    gm_free(nodes->first);
    gm_free(nodes->body);
    gm_free(nodes->inertia);
    gm_free(nodes->pieces);
    *nodes = (gm_nodes){.gearset = NULL};
}

int gm_node_at(const gm_nodes *nodes, int body, double x)
{
    if (body < 0)
        return body;
    if (body >= nodes->gearset->description->n_shafts)
        return nodes->first[body];
    return nodes->first[body] + gm_station_at(&nodes->stations[body], x);
}

int gm_flange_node(const gm_nodes *nodes, int flange)
{
    int body = gm_flange_body(nodes->gearset, flange);
    return gm_node_at(nodes, body,
                      gm_flange_position(&nodes->gearset->description->shafts[body]));
}

gm_row gm_node_row(const gm_nodes *nodes, int m, const gm_row *row)
{
    const gm_description *d = nodes->gearset->description;
    gm_row over = *row;
    for (int k = 0; k < row->n; k++) { /* a carrier is where its planets are */
        const gm_wheel *wheel = &d->wheels[d->meshes[m].wheel[k < 2 ? k : 0]];
        over.body[k] = gm_node_at(nodes, row->body[k], wheel->position);
    }
    return over;
}

gm_row gm_node_lock_row(const gm_nodes *nodes, const gm_lock *lock)
{
    const gm_description *d = nodes->gearset->description;
    gm_row row = gm_lock_row(nodes->gearset, lock);
    double x = lock->is_clutch ? (double)NAN : d->wheels[lock->index].position;
    for (int k = 0; k < row.n; k++)
        row.body[k] = gm_node_at(nodes, row.body[k], x);
    return row;
}
