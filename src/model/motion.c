/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The right side of the motion, and its accounts. The torque of every node is that of its
 * rows, of friction, of the cones that rub and of its flange.
 */
#include "model/motion.h"

#include "base/alloc.h"

#include <math.h>
#include <string.h>

/* ---- life ---- */

void gm_motion_destroy(gm_motion *motion)
{
    if (!motion)
        return;
    gm_motion_clear_signals(motion);
    gm_nodes_clear(&motion->nodes);
    gm_free(motion->rows);
    gm_free(motion->roll);
    gm_free(motion->bearing);
    gm_free(motion->drag);
    gm_free(motion->locks);
    gm_free(motion->pattern.column_start);
    gm_free(motion->pattern.row);
    gm_free(motion->pattern.at);
    gm_free(motion->x);
    gm_free(motion->contact);
    gm_free(motion->rate);
    gm_free(motion->force);
    gm_free(motion->mesh_friction);
    gm_free(motion->bearing_friction);
    gm_free(motion->drag_friction);
    gm_free(motion->torque);
    gm_free(motion->d_radial);
    gm_free(motion->d_axial);
    gm_free(motion);
}

static gm_status allocate_work(gm_motion *m, gm_error *error)
{
    size_t n_rows = (size_t)m->n_rows, n_meshes = (size_t)m->gearset->n_meshes,
           n_bearings = (size_t)m->gearset->n_bearings,
           n_drags = (size_t)m->gearset->n_drags;
    m->x = gm_calloc((size_t)m->n_states, sizeof *m->x);
    m->contact = gm_calloc(n_rows, sizeof *m->contact);
    m->rate = gm_calloc(n_rows, sizeof *m->rate);
    m->force = gm_calloc(n_rows, sizeof *m->force);
    m->mesh_friction = gm_calloc(n_meshes, sizeof *m->mesh_friction);
    m->bearing_friction = gm_calloc(n_bearings, sizeof *m->bearing_friction);
    m->drag_friction = gm_calloc(n_drags, sizeof *m->drag_friction);
    m->torque = gm_calloc((size_t)m->n_nodes, sizeof *m->torque);
    m->d_radial = gm_calloc(n_meshes, sizeof *m->d_radial);
    m->d_axial = gm_calloc(n_meshes, sizeof *m->d_axial);
    if (!m->x || !m->contact || !m->rate || !m->force || !m->mesh_friction ||
        !m->bearing_friction || !m->drag_friction || !m->torque || !m->d_radial ||
        !m->d_axial)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    for (int i = 0; i < m->gearset->n_bearings; i++)
        m->bearing[i].law = gm_bearing_at_speed(&m->gearset->bearings[i].law, 0.0);
    return GM_OK;
}

gm_status gm_motion_create(const gm_gearset *gearset, gm_motion **motion, gm_error *error)
{
    gm_motion *m = gm_calloc(1, sizeof *m);
    if (!m)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    m->gearset = gearset;
    m->loss_scale = 1.0;
    gm_status status = gm_motion_make_rows(m, error);
    if (status == GM_OK)
        status = allocate_work(m, error);
    if (status == GM_OK)
        status = gm_motion_make_pattern(m, error);
    if (status == GM_OK)
        status = gm_motion_make_signals(m, error);
    if (status != GM_OK) {
        gm_motion_destroy(m);
        return status;
    }
    *motion = m;
    return GM_OK;
}

int gm_motion_n_states(const gm_motion *motion)
{
    return motion->n_states;
}

int gm_motion_speed_state(const gm_motion *motion, int flange)
{
    return motion->flange[flange];
}

/* ---- right side ---- */

static void forces_at(gm_motion *motion, const double *x)
{
    const double *deflection = x + motion->n_nodes;
    for (int e = 0; e < motion->n_rows; e++) {
        const gm_motion_row *row = &motion->rows[e];
        motion->rate[e] = gm_row_speed(&row->row, x);
        if (row->closed)
            motion->contact[e] =
                gm_contact_force_at(&row->law, deflection[e], motion->rate[e]);
        else
            motion->contact[e] = (gm_contact_force){0.0, 0.0, 0.0, 0.0};
        motion->force[e] = motion->contact[e].value;
    }
}

void gm_motion_evaluate(gm_motion *motion, const double *x)
{
    size_t size = (size_t)motion->n_states * sizeof *x;
    if (motion->known && memcmp(motion->x, x, size) == 0)
        return;
    forces_at(motion, x);
    gm_motion_friction_at(motion, x);
    memcpy(motion->x, x, size);
    motion->known = 1;
}

static void node_torques(gm_motion *m, const gm_motion_input *input)
{
    memset(m->torque, 0, (size_t)m->n_nodes * sizeof *m->torque);
    for (int e = 0; e < m->n_rows; e++)
        gm_row_apply(&m->rows[e].row, m->force[e], m->torque);
    for (int i = 0; i < m->n_locks; i++)
        gm_row_apply(&m->rows[m->locks[i].row].row, gm_motion_cone_torque(&m->locks[i]),
                     m->torque);
    gm_motion_add_friction(m, m->torque);
    for (int f = 0; f <= m->gearset->description->n_paths; f++)
        m->torque[m->flange[f]] += input->torque[f];
}

static int finite(int n, const double *x)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++)
        sum += 0.0 * x[i];
    return sum == 0.0;
}

int gm_motion_rates(gm_motion *motion, const gm_motion_input *input, const double *x,
                    double *dx)
{
    if (!finite(motion->n_states, x))
        return 1;
    gm_motion_evaluate(motion, x);
    node_torques(motion, input);
    for (int i = 0; i < motion->n_nodes; i++)
        dx[i] = motion->torque[i] / motion->inertia[i];
    for (int e = 0; e < motion->n_rows; e++)
        dx[motion->n_nodes + e] = motion->rows[e].closed ? motion->rate[e] : 0.0;
    for (int i = 0; i < motion->gearset->n_bearings; i++)
        if (motion->bearing[i].state >= 0)
            dx[motion->bearing[i].state] = motion->bearing[i].bristle.rate;
    return 0;
}

/* ---- accounts ---- */

static double stored_energy(const gm_motion *m, const double *x)
{
    double energy = gm_motion_bristle_energy(m);
    for (int i = 0; i < m->n_nodes; i++)
        energy += 0.5 * m->inertia[i] * x[i] * x[i];
    for (int e = 0; e < m->n_rows; e++)
        if (m->rows[e].closed)
            energy += gm_contact_energy(&m->rows[e].law, x[m->n_nodes + e]);
    return energy;
}

static double loss_power(const gm_motion *m)
{
    double power = gm_motion_friction_power(m);
    for (int e = 0; e < m->n_rows; e++)
        power += (m->contact[e].value - m->contact[e].spring) * m->rate[e];
    for (int i = 0; i < m->n_locks; i++)
        power += gm_motion_cone_torque(&m->locks[i]) * m->rate[m->locks[i].row];
    return power;
}

void gm_motion_view_at(gm_motion *motion, const gm_motion_input *input, const double *x,
                       gm_motion_view *view)
{
    const gm_description *d = motion->gearset->description;
    memset(view, 0, sizeof *view);
    gm_motion_evaluate(motion, x);
    node_torques(motion, input);
    for (int f = 0; f <= d->n_paths; f++) {
        int node = motion->flange[f];
        view->speed[f] = x[node];
        view->acceleration[f] = motion->torque[node] / motion->inertia[node];
    }
    view->loss_power = loss_power(motion);
    view->stored_energy = stored_energy(motion, x);
    view->jump_loss = motion->jump_loss;
    for (int p = 0; p < d->n_paths; p++)
        view->state[p] = gm_motion_path_mode(motion, p);
}
