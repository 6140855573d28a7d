/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A reduced map with fewer nodes, for the small memory of a controller. A node of an axis
 * goes when linear interpolation between the nodes that stay gives its values within a
 * tolerance; the cheapest go first. What is lost is measured at all nodes of the map:
 * between them both are multilinear in the map's own cells, so it is largest at a node.
 * With an oil axis a node stays or goes in all slices.
 *
 * The tolerance is a part of the reference torque: the largest loss torque at the same
 * flange in the same gears (a drag of 0.2 N.m beside a loss of 200 N.m needs no digits).
 */
#ifndef THIN_H
#define THIN_H

#include "map/gm_map.h"

/* Kinds of tables: those of gm_symbol and the drag of the input side. */
enum { GM_THIN_PIN = GM_SYMBOLS, GM_THIN_KINDS };

typedef struct gm_thin gm_thin;

/** What a table will hold in place of `value`. most: largest magnitude of the table. */
typedef double gm_thin_stored(double value, double most);

/** Thin all tables of a reduced map; tolerance 0 keeps all nodes. stored: rounds values
 *  to what the tables will hold; NULL: they stay. The arrays of monotone tables, which
 *  are not thinned, stay those of `map`, which must live as long. GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_thin_create(const gm_reduced_map *map, double tolerance,
                                      gm_thin_stored *stored, gm_thin **thin,
                                      gm_error *error);
void gm_thin_destroy(gm_thin *thin);

/** The thinned map. */
const gm_reduced_map *gm_thin_map(const gm_thin *thin);

/* What was lost in the tables of one kind. */
typedef struct gm_thin_loss {
    int tables;
    long nodes, kept;    /* values of all tables, before and after */
    double most;         /* largest error [N.m] */
    double relative;     /* largest error over reference torque */
    double root_mean_sq; /* of error over reference torque, over all nodes */
} gm_thin_loss;

/** Losses by kind, thinning and rounding together. */
void gm_thin_measure(const gm_thin *thin, gm_thin_loss loss[GM_THIN_KINDS]);

#endif
