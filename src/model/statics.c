/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Coordinates of shaft s, about its origin x = 0: u_x, u_y, u_z, theta_y, theta_z. A
 * point at x moves by u_y + theta_z x in y and by u_z - theta_y x in z (small rotations).
 */
#include "model/statics.h"

#include "base/alloc.h"
#include "base/linear.h"

#include <math.h>
#include <string.h>

#define GRAVITY 9.81 /* m/s2 */
#define DOF 5

/* The three directions in which a bearing holds, as rows over one shaft's coordinates. */
static void bearing_rows(double x, double row[3][DOF])
{
    memset(row, 0, 3 * sizeof row[0]);
    row[0][0] = 1.0;
    row[1][1] = 1.0;
    row[1][4] = x;
    row[2][2] = 1.0;
    row[2][3] = -x;
}

static double bearing_stiffness(const gm_bearing *bearing, int axis)
{
    if (axis == 0)
        return bearing->locating ? bearing->axial_stiffness : 0.0;
    return bearing->radial_stiffness;
}

/* Spring between shaft coordinates p and q (equal: the same shaft), with sign. */
static void add_spring(int n, double *K, int p, int q, const double *row, double k)
{
    for (int i = 0; i < DOF; i++)
        for (int j = 0; j < DOF; j++)
            K[(p * DOF + i) * n + q * DOF + j] += k * row[i] * row[j];
}

static void add_bearing(int n, double *K, const gm_bearing *bearing)
{
    double row[3][DOF];
    bearing_rows(bearing->position, row);
    for (int axis = 0; axis < 3; axis++) {
        double k = bearing_stiffness(bearing, axis);
        add_spring(n, K, bearing->shaft, bearing->shaft, row[axis], k);
        if (bearing->on != GM_HOUSING) {
            add_spring(n, K, bearing->on, bearing->on, row[axis], k);
            add_spring(n, K, bearing->shaft, bearing->on, row[axis], -k);
            add_spring(n, K, bearing->on, bearing->shaft, row[axis], -k);
        }
    }
}

/* Generalised load of force f at point r (relative to the shaft's axis in y and z). */
static void add_force(double *load, int shaft, const double f[3], const double r[3])
{
    double *q = load + shaft * DOF;
    q[0] += f[0];
    q[1] += f[1];
    q[2] += f[2];
    q[3] += r[2] * f[0] - r[0] * f[2]; /* M_y */
    q[4] += r[0] * f[1] - r[1] * f[0]; /* M_z */
}

static void add_contact(const gm_description *d, double *load, int shaft,
                        const gm_contact *contact, const double f[3])
{
    double r[3] = {contact->point[0], contact->point[1] - d->shafts[shaft].y,
                   contact->point[2] - d->shafts[shaft].z};
    add_force(load, shaft, f, r);
}

static void mesh_load(const gm_description *d, const gm_static_mesh *mesh, int magnitude,
                      double *load)
{
    for (int side = 0; side < 2; side++) {
        const gm_contact *c = &mesh->contact[side];
        add_contact(d, load, mesh->shaft[side], c,
                    magnitude ? c->magnitude_part : c->signed_part);
    }
}

static void weight_load(int n_masses, const gm_static_mass *masses, double *load)
{
    for (int i = 0; i < n_masses; i++) {
        const double f[3] = {0.0, 0.0, -masses[i].mass * GRAVITY};
        const double r[3] = {masses[i].position, 0.0, 0.0};
        add_force(load, masses[i].shaft, f, r);
    }
}

/* Force that the shaft puts on the bearing at displacements u. */
static void bearing_force(const gm_bearing *bearing, const double *u, double force[3])
{
    double row[3][DOF];
    bearing_rows(bearing->position, row);
    for (int axis = 0; axis < 3; axis++) {
        double x = 0.0;
        for (int i = 0; i < DOF; i++) {
            x += row[axis][i] * u[bearing->shaft * DOF + i];
            if (bearing->on != GM_HOUSING)
                x -= row[axis][i] * u[bearing->on * DOF + i];
        }
        force[axis] = bearing_stiffness(bearing, axis) * x;
    }
}

static double largest(const double f[3])
{
    return fmax(fabs(f[0]), fmax(fabs(f[1]), fabs(f[2])));
}

static gm_status load_row_reserve(gm_load_row *row, int n, gm_error *error)
{
    memset(row, 0, sizeof *row);
    row->mesh = gm_calloc((size_t)n, sizeof *row->mesh);
    row->a = gm_calloc((size_t)n, sizeof *row->a);
    row->b = gm_calloc((size_t)n, sizeof *row->b);
    if (!row->mesh || !row->a || !row->b) {
        gm_load_row_clear(row);
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    }
    return GM_OK;
}

void gm_load_row_clear(gm_load_row *row)
{
    gm_free(row->mesh);
    gm_free(row->a);
    gm_free(row->b);
    memset(row, 0, sizeof *row);
}

/* Keep the pair of parts of one mesh if it loads this bearing beyond rounding. */
static void load_row_add(gm_load_row *row, int mesh, const double a[3], const double b[3])
{
    const double rounding =
        1e-9; /* forces are per newton, the solution is good to 1e-12 */
    if (largest(a) < rounding && largest(b) < rounding)
        return;
    row->mesh[row->n] = mesh;
    memcpy(row->a[row->n], a, 3 * sizeof *a);
    memcpy(row->b[row->n], b, 3 * sizeof *b);
    row->n++;
}

typedef struct statics {
    const gm_description *d;
    int n; /* coordinates */
    double *K, *load, *load_b;
    int *pivot;
} statics;

static void statics_clear(statics *s)
{
    gm_free(s->K);
    gm_free(s->load);
    gm_free(s->load_b);
    gm_free(s->pivot);
}

static gm_status statics_make(statics *s, const gm_description *d, gm_error *error)
{
    int n = DOF * d->n_shafts;
    *s = (statics){.d = d, .n = n};
    s->K = gm_calloc((size_t)n * (size_t)n, sizeof *s->K);
    s->load = gm_calloc((size_t)n, sizeof *s->load);
    s->load_b = gm_calloc((size_t)n, sizeof *s->load_b);
    s->pivot = gm_calloc((size_t)n, sizeof *s->pivot);
    if (!s->K || !s->load || !s->load_b || !s->pivot)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    for (int i = 0; i < d->n_bearings; i++)
        add_bearing(n, s->K, &d->bearings[i]);
    if (!gm_lu_factor(n, s->K, s->pivot))
        return gm_fail(
            error, GM_ERR_MODEL,
            "%s: the bearings do not hold every shaft: each needs two bearings "
            "at different positions and one of them locating",
            d->file);
    return GM_OK;
}

static void solve_mesh(statics *s, const gm_static_mesh *mesh, int index,
                       gm_load_row *rows)
{
    memset(s->load, 0, (size_t)s->n * sizeof *s->load);
    memset(s->load_b, 0, (size_t)s->n * sizeof *s->load_b);
    mesh_load(s->d, mesh, 0, s->load);
    mesh_load(s->d, mesh, 1, s->load_b);
    gm_lu_solve(s->n, s->K, s->pivot, s->load);
    gm_lu_solve(s->n, s->K, s->pivot, s->load_b);
    for (int i = 0; i < s->d->n_bearings; i++) {
        double a[3], b[3];
        bearing_force(&s->d->bearings[i], s->load, a);
        bearing_force(&s->d->bearings[i], s->load_b, b);
        load_row_add(&rows[i], index, a, b);
    }
}

static gm_status reserve_rows(int n_bearings, int n_meshes, gm_load_row *rows,
                              gm_error *error)
{
    gm_status status = GM_OK;
    for (int i = 0; i < n_bearings && status == GM_OK; i++)
        status = load_row_reserve(&rows[i], n_meshes, error);
    return status;
}

gm_status gm_statics_solve(const gm_description *description, int n_meshes,
                           const gm_static_mesh *meshes, int n_masses,
                           const gm_static_mass *masses, gm_load_row *rows,
                           gm_error *error)
{
    statics s;
    int n_bearings = description->n_bearings;
    memset(rows, 0, (size_t)n_bearings * sizeof *rows);
    gm_status status = statics_make(&s, description, error);
    if (status == GM_OK)
        status = reserve_rows(n_bearings, n_meshes, rows, error);
    if (status == GM_OK) {
        for (int m = 0; m < n_meshes; m++)
            solve_mesh(&s, &meshes[m], m, rows);
        memset(s.load, 0, (size_t)s.n * sizeof *s.load);
        weight_load(n_masses, masses, s.load);
        gm_lu_solve(s.n, s.K, s.pivot, s.load);
        for (int i = 0; i < n_bearings; i++)
            bearing_force(&description->bearings[i], s.load, rows[i].weight);
    } else {
        for (int i = 0; i < n_bearings; i++)
            gm_load_row_clear(&rows[i]);
    }
    statics_clear(&s);
    return status;
}

gm_status gm_statics_wheel(double mass, int n, const int *mesh,
                           const gm_contact *const *contact, gm_load_row *row,
                           gm_error *error)
{
    gm_status status = load_row_reserve(row, n, error);
    for (int i = 0; i < n && status == GM_OK; i++)
        load_row_add(row, mesh[i], contact[i]->signed_part, contact[i]->magnitude_part);
    row->weight[2] = -mass * GRAVITY;
    return status;
}

static double sign_of(double v)
{
    return v < 0.0 ? -1.0 : 1.0;
}

void gm_load_row_vector(const gm_load_row *row, const double *F, double load[3])
{
    for (int i = 0; i < 3; i++)
        load[i] = row->weight[i];
    for (int k = 0; k < row->n; k++) {
        double f = F[row->mesh[k]], magnitude = fabs(f);
        for (int i = 0; i < 3; i++)
            load[i] += row->a[k][i] * f + row->b[k][i] * magnitude;
    }
}

void gm_load_row_at(const gm_load_row *row, const double *F, double *radial,
                    double *axial, double *d_radial, double *d_axial)
{
    double v[3];
    gm_load_row_vector(row, F, v);
    *radial = sqrt(v[1] * v[1] + v[2] * v[2]);
    *axial = row->mate ? gm_thrust_at(row, F, d_axial) : fabs(v[0]);
    if (!d_radial || !d_axial)
        return;
    double c = *radial > 0.0 ? v[1] / *radial : 1.0;
    double s = *radial > 0.0 ? v[2] / *radial : 0.0;
    for (int k = 0; k < row->n; k++) {
        double sign = sign_of(F[row->mesh[k]]);
        d_radial[k] = c * (row->a[k][1] + sign * row->b[k][1]) +
                      s * (row->a[k][2] + sign * row->b[k][2]);
        if (!row->mate)
            d_axial[k] = sign_of(v[0]) * (row->a[k][0] + sign * row->b[k][0]);
    }
}
