/* SPDX-License-Identifier: BSD-2-Clause
 *
 * How a path gives way: its flange turned against the held output. The row forces F_e at
 * 1 N.m follow from statics alone, without friction; virtual work then gives
 *
 *   1/k = sum F_e^2 / k_e,   lash = sum |F_e| j_e,   film = sum |F_e| e_e
 *
 * and equal dissipation at slow motion, where every row takes its static share of the
 * rate, d / k^2 = sum d_e (F_e / k_e)^2. Parts that carry nothing damp as loose.h has it,
 * at the frequency of the path's flange on its stiffness.
 */
#include "model/loose.h"
#include "model/nodes.h"
#include "model/stiffness.h"

#include "base/alloc.h"

#include <math.h>

#define LOOSE_DAMPER 0.8 /* over w J, see loose.h */

typedef struct sums {
    double flexibility, dissipation, lash, film;
} sums;

static void add_row(sums *s, const gm_contact_law *law, double F)
{
    s->flexibility += F * F / law->stiffness;
    s->dissipation += law->damping * F * F / (law->stiffness * law->stiffness);
    s->lash += 2.0 * fabs(F) * law->gap;
    if (law->model == GM_CONTACT_FILM)
        s->film += fabs(F) * fmin(law->entry, law->gap);
}

static void apply(const gm_row *row, double F, double *torque)
{
    for (int k = 0; k < row->n; k++)
        if (row->body[k] >= 0)
            torque[row->body[k]] -= row->g[k] * F;
}

/* Meshes and locks; their torques on the nodes. */
static void add_rows(const gm_nodes *nodes, const gm_configuration_rows *rows, int input,
                     double *torque, sums *s)
{
    const gm_gearset *g = nodes->gearset;
    for (int e = 0; e < rows->n_rows; e++) {
        const gm_lock *lock = e < g->n_meshes ? NULL : rows->locked[e - g->n_meshes];
        gm_row row = lock ? gm_node_lock_row(nodes, lock)
                          : gm_node_row(nodes, e, &g->meshes[e].row);
        double mass = gm_row_reduced_mass(&row, nodes->inertia);
        gm_contact_law law =
            lock ? gm_lock_contact_law(g, lock, mass) : gm_mesh_contact_law(g, e, mass);
        /* x = - inverse t for the torque t = 1 N.m on the input */
        double F = -rows->inverse[e * rows->n_bodies + input];
        add_row(s, &law, F);
        apply(&row, F, torque);
    }
}

/* Through each piece of a shaft goes all that acts on the stations before it. */
static void add_pieces(const gm_nodes *nodes, const double *torque, sums *s)
{
    double through = 0.0;
    for (int i = 0; i < nodes->n_pieces; i++) {
        const gm_piece *piece = &nodes->pieces[i];
        through = (piece->number > 0 ? through : 0.0) + torque[piece->row.body[0]];
        add_row(s, &piece->law, through);
    }
}

static gm_status add_all(const gm_nodes *nodes, const gm_configuration_rows *rows, int p,
                         sums *s, gm_error *error)
{
    double *torque = gm_calloc((size_t)nodes->n, sizeof *torque);
    if (!torque)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    int input = gm_flange_body(nodes->gearset, 1 + p);
    torque[gm_flange_node(nodes, 1 + p)] += 1.0;
    torque[gm_flange_node(nodes, 0)] -=
        rows->inverse[rows->n_rows * rows->n_bodies + input];
    add_rows(nodes, rows, input, torque, s);
    add_pieces(nodes, torque, s);
    gm_free(torque);
    return GM_OK;
}

gm_status gm_gearset_compliance(const gm_gearset *gearset, int p, int number,
                                gm_compliance *compliance, gm_error *error)
{
    int gear[GM_MAX_INPUT_PATHS];
    gm_rest_gears(gearset->description, gear);
    gear[p] = number;
    if (number == 0)
        return gm_fail(error, GM_ERR_ARGUMENT, "compliance is that of a gear, not of 0");
    gm_configuration_rows rows;
    gm_nodes nodes;
    sums s = {0.0, 0.0, 0.0, 0.0};
    double path = 0.0, loose = 0.0;
    gm_status status = gm_configuration_rows_make(gearset, gear, &rows, error);
    if (status != GM_OK)
        return status;
    status = gm_nodes_make(gearset, &nodes, error);
    if (status == GM_OK) {
        status = add_all(&nodes, &rows, p, &s, error);
        gm_nodes_clear(&nodes);
    }
    if (status == GM_OK)
        status = gm_loose_inertia(gearset, &rows, p, &path, &loose, error);
    if (status == GM_OK) {
        double k = 1.0 / s.flexibility;
        double frequency = path > 0.0 ? sqrt(k / path) : 0.0;
        *compliance = (gm_compliance){.stiffness = k,
                                      .damping = k * k * s.dissipation,
                                      .loose_damping = LOOSE_DAMPER * frequency * loose,
                                      .lash = s.lash,
                                      .film = s.film};
    }
    gm_configuration_rows_clear(&rows);
    return status;
}
