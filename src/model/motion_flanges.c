/* SPDX-License-Identifier: BSD-2-Clause */
#include "model/gm_motion_flanges.h"

#include "base/alloc.h"
#include "core/gm_reduced.h"
#include "model/motion.h"
#include "model/stiffness.h"

#include <math.h>
#include <string.h>

struct gm_motion_flanges {
    gm_motion *motion;
    double ratio[GM_MAX_INPUT_PATHS];
    double *row_force; /* [n_paths][n_rows] at 1 N.m on the path's flange */
    double *way; /* [n_flanges][n_nodes]: speeds of the nodes where this flange turns with
                    1 rad/s and the other independent ones stand; 0: it depends */
    double *force, *torque; /* scratch: [n_rows], [n_nodes] */
};

static int n_flanges(const gm_motion *m)
{
    return 1 + m->gearset->description->n_paths;
}

void gm_motion_flanges_destroy(gm_motion_flanges *f)
{
    if (!f)
        return;
    gm_free(f->row_force);
    gm_free(f->way);
    gm_free(f->force);
    gm_free(f->torque);
    gm_free(f);
}

gm_status gm_motion_flanges_create(gm_motion *motion, gm_motion_flanges **flanges,
                                   gm_error *error)
{
    gm_motion_flanges *f = gm_calloc(1, sizeof *f);
    if (!f)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    size_t n = (size_t)n_flanges(motion), n_rows = (size_t)motion->n_rows,
           n_nodes = (size_t)motion->n_nodes;
    f->motion = motion;
    f->row_force = gm_calloc(n * n_rows, sizeof *f->row_force);
    f->way = gm_calloc(n * n_nodes, sizeof *f->way);
    f->force = gm_calloc(n_rows, sizeof *f->force);
    f->torque = gm_calloc(n_nodes, sizeof *f->torque);
    if (!f->row_force || !f->way || !f->force || !f->torque) {
        gm_motion_flanges_destroy(f);
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    }
    *flanges = f;
    return GM_OK;
}

/* ---- the configuration ---- */

/* Row of the motion that row e of the configuration is. */
static int motion_row(const gm_motion *m, const gm_configuration_rows *rows, int e)
{
    int n_meshes = m->gearset->n_meshes, i = 0;
    if (e < n_meshes)
        return e;
    while (!gm_same_lock(&m->locks[i].what, rows->locked[e - n_meshes]))
        i++;
    return m->locks[i].row;
}

/* Row forces of statics at 1 N.m on path p: see compliance.c. */
static void find_forces(gm_motion_flanges *f, const gm_configuration_rows *rows, int p)
{
    const gm_motion *m = f->motion;
    int body = gm_flange_body(m->gearset, 1 + p);
    double *F = f->row_force + p * m->n_rows, *torque = f->torque, through = 0.0;
    memset(torque, 0, (size_t)m->n_nodes * sizeof *torque);
    torque[m->flange[1 + p]] += 1.0;
    torque[m->flange[0]] -= rows->inverse[rows->n_rows * rows->n_bodies + body];
    for (int e = 0; e < rows->n_rows; e++) {
        int row = motion_row(m, rows, e);
        F[row] = -rows->inverse[e * rows->n_bodies + body];
        gm_row_apply(&m->rows[row].row, F[row], torque);
    }
    for (int i = 0; i < m->nodes.n_pieces; i++) {
        const gm_piece *piece = &m->nodes.pieces[i];
        through = (piece->number > 0 ? through : 0.0) + torque[piece->row.body[0]];
        F[m->gearset->n_meshes + m->n_locks + i] = through;
    }
}

static void find_ways(gm_motion_flanges *f, const gm_configuration_rows *rows)
{
    const gm_motion *m = f->motion;
    for (int flange = 0; flange < n_flanges(m); flange++) {
        int column = gm_flange_column(rows, flange);
        for (int i = 0; i < m->n_nodes && column >= 0; i++)
            f->way[flange * m->n_nodes + i] =
                rows->speed_of[m->nodes.body[i] * rows->n_independent + column];
    }
}

gm_status gm_motion_flanges_update(gm_motion_flanges *f, gm_error *error)
{
    const gm_motion *m = f->motion;
    int n_paths = n_flanges(m) - 1, gear[GM_MAX_INPUT_PATHS],
        engaged[GM_MAX_INPUT_PATHS] = {0};
    gm_configuration_rows rows;
    gm_rest_gears(m->gearset->description, gear);
    for (int p = 0; p < n_paths; p++) {
        engaged[p] = gm_motion_path_mode(m, p) == GM_PATH_ENGAGED;
        if (engaged[p])
            gear[p] = m->gear[p];
    }
    gm_status status = gm_configuration_rows_make(m->gearset, gear, &rows, error);
    if (status != GM_OK)
        return status;
    memset(f->row_force, 0, (size_t)(n_paths * m->n_rows) * sizeof *f->row_force);
    memset(f->way, 0, (size_t)((n_paths + 1) * m->n_nodes) * sizeof *f->way);
    find_ways(f, &rows);
    for (int p = 0; p < n_paths; p++) {
        f->ratio[p] = engaged[p] ? f->way[m->flange[1 + p]] : 0.0;
        if (engaged[p])
            find_forces(f, &rows, p);
    }
    gm_configuration_rows_clear(&rows);
    return GM_OK;
}

/* ---- what is seen ---- */

double gm_motion_flanges_ratio(const gm_motion_flanges *f, int p)
{
    return f->ratio[p];
}

double gm_motion_flanges_twist(const gm_motion_flanges *f, int p, const double *x)
{
    const gm_motion *m = f->motion;
    double twist = 0.0;
    for (int e = 0; e < m->n_rows; e++)
        twist += f->row_force[p * m->n_rows + e] * x[m->n_nodes + e];
    return twist;
}

/* - sum of friction torques along the way of a flange, added to loss. */
static void add_losses(gm_motion_flanges *f, double factor, double loss[GM_MAX_FLANGES])
{
    const gm_motion *m = f->motion;
    memset(f->torque, 0, (size_t)m->n_nodes * sizeof *f->torque);
    gm_motion_add_friction(m, f->torque);
    for (int flange = 0; flange < n_flanges(m); flange++)
        for (int i = 0; i < m->n_nodes; i++)
            loss[flange] -= factor * f->way[flange * m->n_nodes + i] * f->torque[i];
}

/* Friction that would be at these speeds without row forces, taken from loss. */
static void take_unloaded(gm_motion_flanges *f, const double *x,
                          double loss[GM_MAX_FLANGES])
{
    gm_motion *m = f->motion;
    size_t size = (size_t)m->n_rows * sizeof *m->force;
    memcpy(f->force, m->force, size);
    memset(m->force, 0, size);
    gm_motion_friction_at(m, x);
    add_losses(f, -1.0, loss);
    memcpy(m->force, f->force, size);
    gm_motion_friction_at(m, x);
}

void gm_motion_flanges_losses(gm_motion_flanges *f, const gm_motion_input *input,
                              const double *x, double torque[GM_MAX_FLANGES])
{
    double load[GM_MAX_FLANGES], power[GM_MAX_INPUT_PATHS], sum = 0.0;
    int n_paths = n_flanges(f->motion) - 1, n_engaged = 0;
    for (int i = 0; i < GM_MAX_FLANGES; i++)
        torque[i] = 0.0;
    gm_motion_evaluate(f->motion, x);
    add_losses(f, 1.0, torque);
    memcpy(load, torque, sizeof load);
    take_unloaded(f, x, load);
    for (int p = 0; p < n_paths; p++) {
        power[p] = fabs(f->ratio[p] * input->torque[1 + p]);
        n_engaged += f->ratio[p] != 0.0;
        sum += power[p];
    }
    if (n_engaged > 0)
        torque[0] -= load[0];
    for (int p = 0; p < n_paths; p++)
        if (f->ratio[p] != 0.0)
            torque[1 + p] =
                load[0] * (sum > 0.0 ? power[p] / sum : 1.0 / n_engaged) / f->ratio[p];
}

double gm_motion_flanges_kinetic_energy(const gm_motion_flanges *f, const double *x)
{
    const gm_motion *m = f->motion;
    double energy = 0.0;
    for (int i = 0; i < m->n_nodes; i++)
        energy += 0.5 * m->inertia[i] * x[i] * x[i];
    return energy;
}

double gm_motion_flanges_inertia(const gm_motion_flanges *f, int flange)
{
    return f->motion->inertia[f->motion->flange[flange]];
}

double gm_motion_flanges_frequency(const gm_motion_flanges *f)
{
    const gm_motion *m = f->motion;
    double square = 0.0;
    for (int e = 0; e < m->n_rows; e++)
        if (m->rows[e].closed)
            square = fmax(square, m->rows[e].law.stiffness /
                                      gm_row_reduced_mass(&m->rows[e].row, m->inertia));
    return sqrt(square);
}
