/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Thinning of one table; see thin.h. A table has three axes here, those that it lacks
 * with one node.
 */
#ifndef THIN_GRID_H
#define THIN_GRID_H

#include "bake/thin.h"

#include <stdbool.h>

enum { GM_GRID_AXES = 3 };

typedef struct gm_grid {
    int kind;
    double reference;              /* N.m */
    int slices;                    /* of all values, one after the other */
    int n[GM_GRID_AXES];           /* nodes of a slice */
    const double *x[GM_GRID_AXES]; /* NULL where there is no axis */
    const double *value;
    int n_kept[GM_GRID_AXES];
    double *kept_x[GM_GRID_AXES]; /* owned */
    double *kept_value;           /* owned */
} gm_grid;

static inline int gm_grid_size(const int n[GM_GRID_AXES])
{
    return n[0] * n[1] * n[2];
}

/** Fill the kept part: no node's value is farther than limit from what is left [N.m],
 *  before what is left is rounded; a negative limit keeps all. stored may be NULL.
 *  false: no memory. */
bool gm_grid_thin(gm_grid *grid, double limit, gm_thin_stored *stored);

/** Largest difference between the table and what is kept over the nodes of the table;
 *  *square: sum of the squares is added. */
double gm_grid_error(const gm_grid *grid, double *square);

void gm_grid_clear(gm_grid *grid);

#endif
