/* SPDX-License-Identifier: BSD-2-Clause
 *
 * How a path gives way: its flange turned against the held output. The row forces F_e at
 * 1 N.m follow from statics alone, without friction; virtual work then gives
 *
 *   1/k = sum F_e^2 / k_e,   lash = sum |F_e| j_e
 *
 * and equal dissipation at slow motion, where every row takes its static share of the
 * rate, d / k^2 = sum d_e (F_e / k_e)^2.
 */
#include "model/stiffness.h"

#include "base/alloc.h"

#include <math.h>

typedef struct sums {
    double flexibility, dissipation, lash;
} sums;

static void add_row(sums *s, const gm_contact_law *law, double F)
{
    s->flexibility += F * F / law->stiffness;
    s->dissipation += law->damping * F * F / (law->stiffness * law->stiffness);
    s->lash += 2.0 * fabs(F) * law->gap;
}

static void add_rows(const gm_gearset *gearset, const gm_configuration_rows *rows, int p,
                     const double *inertia, sums *s)
{
    int input = gm_flange_body(gearset, 1 + p);
    for (int m = 0; m < gearset->n_meshes; m++) {
        double mass = gm_row_reduced_mass(&gearset->meshes[m].row, inertia);
        gm_contact_law law = gm_mesh_contact_law(gearset, m, mass);
        add_row(s, &law, rows->inverse[m * rows->n_bodies + input]);
    }
    for (int i = 0; i < rows->n_locks; i++) {
        double mass = gm_row_reduced_mass(&rows->lock[i], inertia);
        gm_contact_law law = gm_lock_contact_law(gearset, rows->locked[i], mass);
        add_row(s, &law, rows->inverse[(gearset->n_meshes + i) * rows->n_bodies + input]);
    }
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
    gm_status status = gm_configuration_rows_make(gearset, gear, &rows, error);
    if (status != GM_OK)
        return status;
    double *inertia = gm_calloc((size_t)gearset->n_bodies, sizeof *inertia);
    if (!inertia) {
        gm_configuration_rows_clear(&rows);
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    }
    for (int b = 0; b < gearset->n_bodies; b++)
        inertia[b] = gearset->bodies[b].inertia;
    sums s = {0.0, 0.0, 0.0};
    add_rows(gearset, &rows, p, inertia, &s);
    double k = 1.0 / s.flexibility;
    *compliance = (gm_compliance){k, k * k * s.dissipation, s.lash};
    gm_free(inertia);
    gm_configuration_rows_clear(&rows);
    return GM_OK;
}
