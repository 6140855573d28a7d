/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Axial load of two bearings on a shaft each of which holds it in one direction only:
 * tapered roller or angular contact ball bearings, face to face or back to back.
 *
 * A radial load F_r wedges the rings of such a bearing apart by an axial force
 * S = e F_r (tapered: e = 0.5 / Y). It pushes the shaft towards the mate, which has to
 * answer. With K the axial force on the shaft towards this bearing, ' its mate and P the
 * preload, the catalogues' rules (SKF, Rolling bearings, "Axial load of bearings arranged
 * as pairs"; ISO 281 uses the same) are in one line:
 *
 *   F_a  = max(S, S' + K, P + K/2),     F_a' = F_a - K = max(S', S - K, P - K/2)
 *
 * The larger induced force rules; the mate gets what the balance of the shaft leaves. A
 * preload shares the external force between springs of equal stiffness until one side
 * would lose contact. P falls or rises with temperature as the housing expands more than
 * the shaft: P = P_20 + c (T - 20 degC), not below 0.
 *
 * The maximum is rounded over a few newtons: (a + b + sqrt((a - b)^2 + 10^2)) / 2, at
 * most 5 N above. It keeps the balance F_a - F_a' = K exactly, since a common shift of
 * its arguments shifts it.
 */
#include "model/statics.h"

#include <math.h>
#include <string.h>

static const double rounding = 10.0; /* N */

/* A force and its derivatives by the own and the mate's radial load and by K. */
typedef struct axial_force {
    double value, own, mate, K;
} axial_force;

static axial_force larger(axial_force a, axial_force b)
{
    double difference = a.value - b.value;
    double root = sqrt(difference * difference + rounding * rounding);
    double p = 0.5 * (1.0 + difference / root), q = 1.0 - p;
    /* (root - |difference|)/2 without cancellation */
    double above = 0.5 * rounding * rounding / (root + fabs(difference));
    return (axial_force){fmax(a.value, b.value) + above, p * a.own + q * b.own,
                         p * a.mate + q * b.mate, p * a.K + q * b.K};
}

static axial_force thrust(const gm_load_row *row, double radial, double mate_radial,
                          double K)
{
    double S = row->induced * radial, S_mate = row->mate->induced * mate_radial;
    axial_force own = {S, row->induced, 0.0, 0.0};
    axial_force mate = {S_mate + K, 0.0, row->mate->induced, 1.0};
    axial_force shared = {row->preload + 0.5 * K, 0.0, 0.0, 0.5};
    axial_force F_a = larger(own, mate);
    return row->preload > 0.0 ? larger(F_a, shared) : F_a;
}

static double radial_of(const double v[3])
{
    return sqrt(v[1] * v[1] + v[2] * v[2]);
}

/* Derivatives of the row's vector by force k. */
static double slope_of(const gm_load_row *row, int k, int axis, double F)
{
    return row->a[k][axis] + (F < 0.0 ? -1.0 : 1.0) * row->b[k][axis];
}

static double radial_slope(const gm_load_row *row, int k, const double v[3], double F)
{
    double radial = radial_of(v);
    double c = radial > 0.0 ? v[1] / radial : 1.0, s = radial > 0.0 ? v[2] / radial : 0.0;
    return c * slope_of(row, k, 1, F) + s * slope_of(row, k, 2, F);
}

double gm_thrust_at(const gm_load_row *row, const double *F, double *d_axial)
{
    const gm_load_row *mate = row->mate;
    double v[3], u[3];
    gm_load_row_vector(row, F, v);
    gm_load_row_vector(mate, F, u);
    axial_force F_a = thrust(row, radial_of(v), radial_of(u), row->way * (v[0] + u[0]));
    for (int k = 0; d_axial && k < row->n; k++) {
        double f = F[row->mesh[k]];
        double dK = row->way * (slope_of(row, k, 0, f) + slope_of(mate, k, 0, f));
        d_axial[k] = F_a.own * radial_slope(row, k, v, f) +
                     F_a.mate * radial_slope(mate, k, u, f) + F_a.K * dK;
    }
    return F_a.value;
}

/* The forces of `from` that `row` lacks, with zeros; rows have room for every mesh. */
static void add_missing(gm_load_row *row, const gm_load_row *from)
{
    for (int k = 0; k < from->n; k++) {
        int i = 0;
        while (i < row->n && row->mesh[i] != from->mesh[k])
            i++;
        if (i < row->n)
            continue;
        row->mesh[i] = from->mesh[k];
        memset(row->a[i], 0, sizeof row->a[i]);
        memset(row->b[i], 0, sizeof row->b[i]);
        row->n++;
    }
}

static void swap(gm_load_row *row, int i, int k)
{
    int mesh = row->mesh[i];
    row->mesh[i] = row->mesh[k], row->mesh[k] = mesh;
    for (int axis = 0; axis < 3; axis++) {
        double a = row->a[i][axis], b = row->b[i][axis];
        row->a[i][axis] = row->a[k][axis], row->a[k][axis] = a;
        row->b[i][axis] = row->b[k][axis], row->b[k][axis] = b;
    }
}

void gm_thrust_pair(gm_load_row *one, gm_load_row *other)
{
    add_missing(one, other);
    add_missing(other, one);
    for (int i = 0; i < one->n; i++)
        for (int k = i + 1; k < one->n && other->mesh[i] != one->mesh[i]; k++)
            if (other->mesh[k] == one->mesh[i])
                swap(other, i, k);
    one->mate = other, other->mate = one;
}
