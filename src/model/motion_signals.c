/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What can be recorded of a gearset in motion, in this order:
 *
 *   body.NAME.w                       rad/s
 *   mesh.NAME.force, .deflection      N, m along the line of action
 *   lock.NAME.torque, .w              N.m, rad/s between gear and shaft
 *   bearing.NAME.radial, .axial       N
 *   bearing.NAME.torque               N.m, friction
 *   shaft.NAME.1.torque ...           N.m, in the pieces of a shaft that twists
 *
 * A shaft that twists has body.NAME.1.w and so on, one for each station along x.
 */
#include "model/motion.h"

#include "base/alloc.h"

#include <stdio.h>

enum { SIGNAL_SIZE = GM_NAME_SIZE + 64 };

static int add(gm_motion *m, const char *kind, const char *name, const char *what,
               const char *unit)
{
    char text[SIGNAL_SIZE];
    (void)snprintf(text, sizeof text, "%s.%s.%s", kind, name, what);
    char *copy = gm_strdup(text);
    m->signals[m->n_signals] = (gm_motion_signal){copy, unit};
    m->n_signals += copy != NULL;
    return copy != NULL;
}

/* Stations of a shaft that twists are counted from 1. */
static int name_nodes(gm_motion *m)
{
    int done = 1;
    for (int i = 0; i < m->n_nodes && done; i++) {
        int body = m->nodes.body[i], first = m->nodes.first[body];
        const char *name = gm_body_label(m->gearset, body)->name;
        char what[32] = "w";
        if (i > first || (i + 1 < m->n_nodes && m->nodes.body[i + 1] == body))
            (void)snprintf(what, sizeof what, "%d.w", i - first + 1);
        done = add(m, "body", name, what, "rad/s");
    }
    return done;
}

static int name_pieces(gm_motion *m)
{
    int done = 1;
    for (int i = 0; i < m->nodes.n_pieces && done; i++) {
        const gm_piece *piece = &m->nodes.pieces[i];
        char what[32];
        (void)snprintf(what, sizeof what, "%d.torque", piece->number + 1);
        done = add(m, "shaft", m->gearset->description->shafts[piece->shaft].id.name,
                   what, "N.m");
    }
    return done;
}

static int name_rows(gm_motion *m)
{
    const gm_mesh *mesh = m->gearset->description->meshes;
    int done = 1;
    for (int i = 0; i < m->gearset->n_meshes && done; i++)
        done = add(m, "mesh", mesh[i].id.name, "force", "N") &&
               add(m, "mesh", mesh[i].id.name, "deflection", "m");
    for (int i = 0; i < m->n_locks && done; i++)
        done = add(m, "lock", m->locks[i].name, "torque", "N.m") &&
               add(m, "lock", m->locks[i].name, "w", "rad/s");
    return done;
}

static int name_bearings(gm_motion *m)
{
    int done = 1;
    for (int i = 0; i < m->gearset->n_bearings && done; i++) {
        const char *name = m->gearset->bearings[i].name;
        done = add(m, "bearing", name, "radial", "N") &&
               add(m, "bearing", name, "axial", "N") &&
               add(m, "bearing", name, "torque", "N.m");
    }
    return done;
}

gm_status gm_motion_make_signals(gm_motion *motion, gm_error *error)
{
    const gm_gearset *g = motion->gearset;
    int n = motion->n_nodes + 2 * g->n_meshes + 2 * motion->n_locks + 3 * g->n_bearings +
            motion->nodes.n_pieces;
    motion->signals = gm_calloc((size_t)n, sizeof *motion->signals);
    if (!motion->signals || !name_nodes(motion) || !name_rows(motion) ||
        !name_bearings(motion) || !name_pieces(motion))
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    return GM_OK;
}

void gm_motion_clear_signals(gm_motion *motion)
{
    for (int i = 0; i < motion->n_signals; i++)
        gm_free((void *)motion->signals[i].name);
    gm_free(motion->signals);
}

int gm_motion_n_signals(const gm_motion *motion)
{
    return motion->n_signals;
}

gm_motion_signal gm_motion_signal_at(const gm_motion *motion, int i)
{
    return motion->signals[i];
}

static int bearing_of_state(const gm_motion *motion, int state)
{
    int i = 0;
    while (motion->bearing[i].state != state)
        i++;
    return i;
}

const char *gm_motion_state_name(const gm_motion *motion, int i)
{
    const gm_gearset *g = motion->gearset;
    int mesh = motion->n_nodes, lock = mesh + g->n_meshes;
    int piece = lock + motion->n_locks, bristle = piece + motion->nodes.n_pieces;
    int locks = mesh + 2 * g->n_meshes, bearings = locks + 2 * motion->n_locks;
    int at = i;
    if (i >= bristle)
        at = bearings + 3 * bearing_of_state(motion, i) + 2;
    else if (i >= piece)
        at = bearings + 3 * g->n_bearings + i - piece;
    else if (i >= lock)
        at = locks + 2 * (i - lock);
    else if (i >= mesh)
        at = mesh + 2 * (i - mesh) + 1;
    return motion->signals[at].name;
}

void gm_motion_observe(gm_motion *motion, const gm_motion_input *input, const double *x,
                       double *value)
{
    const gm_gearset *g = motion->gearset;
    (void)input;
    gm_motion_evaluate(motion, x);
    for (int i = 0; i < motion->n_nodes; i++)
        *value++ = x[i];
    for (int i = 0; i < g->n_meshes; i++) {
        *value++ = motion->force[i];
        *value++ = x[motion->n_nodes + i];
    }
    for (int i = 0; i < motion->n_locks; i++) {
        int row = motion->locks[i].row;
        *value++ = motion->force[row] + gm_motion_cone_torque(&motion->locks[i]);
        *value++ = motion->rate[row];
    }
    for (int i = 0; i < g->n_bearings; i++) {
        *value++ = motion->bearing[i].radial;
        *value++ = motion->bearing[i].axial;
        *value++ = motion->bearing_friction[i].torque;
    }
    for (int i = 0; i < motion->nodes.n_pieces; i++)
        *value++ = motion->force[g->n_meshes + motion->n_locks + i];
}
