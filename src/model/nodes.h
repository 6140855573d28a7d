/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What turns as one when shafts may twist: nodes in place of bodies. A body that does not
 * twist is one node.
 */
#ifndef NODES_H
#define NODES_H

#include "model/contact.h"
#include "model/gearset.h"
#include "model/torsion.h"

/** A piece of shaft between two neighbouring nodes. */
typedef struct gm_piece {
    int shaft, number; /* counted from 0 on each shaft */
    gm_row row;        /* over nodes: +1 and -1 */
    gm_contact_law law;
} gm_piece;

typedef struct gm_nodes {
    const gm_gearset *gearset;
    int n;                 /* nodes */
    int *first;            /* [n_bodies]: first node of a body, in ascending order */
    int *body;             /* [n] */
    double *inertia;       /* [n] kg.m2 */
    gm_stations *stations; /* [n_shafts] */
    int n_pieces;
    gm_piece *pieces;
} gm_nodes;

/** GM_ERR_MODEL: a part without inertia; GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_nodes_make(const gm_gearset *gearset, gm_nodes *nodes,
                                     gm_error *error);
void gm_nodes_clear(gm_nodes *nodes);

/** Node of a body at x along it, its first where x is NAN; GM_HOUSING stays what it
 *  is. */
int gm_node_at(const gm_nodes *nodes, int body, double x);

/** Node of a flange. */
int gm_flange_node(const gm_nodes *nodes, int flange);

/** A row of mesh m over nodes in place of bodies. */
gm_row gm_node_row(const gm_nodes *nodes, int m, const gm_row *row);

/** Row of a lock over nodes; a clutch joins the first stations of its shafts. */
gm_row gm_node_lock_row(const gm_nodes *nodes, const gm_lock *lock);

/** Name and line of a body: a shaft's or a gear's. */
const gm_label *gm_body_label(const gm_gearset *gearset, int body);

#endif
