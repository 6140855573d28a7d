/* SPDX-License-Identifier: BSD-2-Clause
 *
 * From the assembled gearset to nodes and rows: what turns, what gives way, what rubs and
 * what can be locked.
 */
#include "model/motion.h"
#include "model/stiffness.h"

#include "base/alloc.h"

#include <math.h>

static gm_status allocate(gm_motion *m, gm_error *error)
{
    const gm_gearset *g = m->gearset;
    const gm_description *d = g->description;
    m->n_nodes = m->nodes.n;
    m->inertia = m->nodes.inertia;
    for (int i = 0; i < d->n_synchronisers; i++)
        m->n_locks += d->synchronisers[i].n_wheels;
    m->n_locks += d->n_clutches;
    m->n_rows = g->n_meshes + m->n_locks + m->nodes.n_pieces;
    m->rows = gm_calloc((size_t)m->n_rows, sizeof *m->rows);
    m->roll = gm_calloc((size_t)g->n_meshes, sizeof *m->roll);
    m->bearing = gm_calloc((size_t)g->n_bearings, sizeof *m->bearing);
    m->drag = gm_calloc((size_t)g->n_drags, sizeof *m->drag);
    m->locks = gm_calloc((size_t)m->n_locks, sizeof *m->locks);
    return m->rows && m->roll && m->bearing && m->drag && m->locks
               ? GM_OK
               : gm_fail(error, GM_ERR_MEMORY, "out of memory");
}

static void make_meshes(gm_motion *m)
{
    for (int i = 0; i < m->gearset->n_meshes; i++) {
        const gm_mesh_element *mesh = &m->gearset->meshes[i];
        gm_motion_row *row = &m->rows[i];
        row->row = gm_node_row(&m->nodes, i, &mesh->row);
        row->law = gm_mesh_contact_law(m->gearset, i,
                                       gm_row_reduced_mass(&row->row, m->inertia));
        row->closed = 1;
        m->roll[i] = gm_node_row(&m->nodes, i, &mesh->roll);
    }
}

static void make_lock(gm_motion *m, int i, gm_lock what)
{
    const gm_description *d = m->gearset->description;
    gm_motion_row *row = &m->rows[m->gearset->n_meshes + i];
    row->row = gm_node_lock_row(&m->nodes, &what);
    row->law = gm_lock_contact_law(m->gearset, &what,
                                   gm_row_reduced_mass(&row->row, m->inertia));
    m->locks[i] = (gm_motion_lock){.name = gm_lock_name(d, &what),
                                   .what = what,
                                   .row = m->gearset->n_meshes + i,
                                   .capacity = gm_lock_capacity(d, &what),
                                   .scale = 1.0,
                                   .sense = 1.0};
}

static void make_locks(gm_motion *m)
{
    const gm_description *d = m->gearset->description;
    int n = 0;
    for (int s = 0; s < d->n_synchronisers; s++)
        for (int k = 0; k < d->synchronisers[s].n_wheels; k++)
            make_lock(m, n++, (gm_lock){.index = d->synchronisers[s].wheels[k]});
    for (int c = 0; c < d->n_clutches; c++)
        make_lock(m, n++, (gm_lock){.is_clutch = 1, .index = c});
}

static void make_pieces(gm_motion *m)
{
    gm_motion_row *row = &m->rows[m->gearset->n_meshes + m->n_locks];
    for (int i = 0; i < m->nodes.n_pieces; i++)
        row[i] = (gm_motion_row){m->nodes.pieces[i].row, m->nodes.pieces[i].law, 1};
}

static gm_motion_pair pair_at(const gm_motion *m, int body, int on, double x)
{
    const gm_nodes *nodes = &m->nodes;
    return (gm_motion_pair){gm_node_at(nodes, body, x), gm_node_at(nodes, on, x)};
}

static void make_pairs(gm_motion *m)
{
    const gm_gearset *g = m->gearset;
    for (int i = 0; i < g->n_bearings; i++) {
        const gm_bearing_element *e = &g->bearings[i];
        int elastic = e->law.data.friction == GM_FRICTION_ELASTIC;
        m->bearing[i] = (gm_motion_bearing){
            .pair = pair_at(m, e->body, e->on, e->position),
            .state = elastic ? m->n_nodes + m->n_rows + m->n_bristles++ : -1};
    }
    for (int i = 0; i < g->n_drags; i++) {
        const gm_drag_element *e = &g->drags[i];
        m->drag[i] = pair_at(m, e->body, e->on, e->position);
    }
    for (int f = 0; f <= g->description->n_paths; f++)
        m->flange[f] = gm_flange_node(&m->nodes, f);
}

gm_status gm_motion_make_rows(gm_motion *motion, gm_error *error)
{
    gm_status status = gm_nodes_make(motion->gearset, &motion->nodes, error);
    if (status == GM_OK)
        status = allocate(motion, error);
    if (status != GM_OK)
        return status;
    make_meshes(motion);
    make_locks(motion);
    make_pieces(motion);
    make_pairs(motion);
    motion->n_states = motion->n_nodes + motion->n_rows + motion->n_bristles;
    return GM_OK;
}

/* Usual values: differences of speed of three hundredths of the largest input speed,
 * deflections that the largest input torque makes on this row alone, bristles bent by
 * 1e-4 rad. */
void gm_motion_tolerances(const gm_motion *motion, double relative, double *absolute)
{
    const gm_description *d = motion->gearset->description;
    for (int i = 0; i < motion->n_nodes; i++)
        absolute[i] = relative * 0.03 * d->speed_max;
    for (int e = 0; e < motion->n_rows; e++) {
        const gm_motion_row *row = &motion->rows[e];
        double force = d->torque_max / fabs(row->row.g[0]);
        absolute[motion->n_nodes + e] = relative * force / row->law.stiffness;
    }
    for (int i = 0; i < motion->n_bristles; i++)
        absolute[motion->n_nodes + motion->n_rows + i] = relative * 1e-4;
}
