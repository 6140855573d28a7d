/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Friction of the moving gearset. The laws are those of the steady balance, magnitudes
 * over magnitudes; here they get the sign of the relative speed, rounded over a narrow
 * band where it changes (gm_motion.h).
 */
#include "model/motion.h"

#include <math.h>
#include <stddef.h>

typedef struct smooth_sign {
    double value, slope;
} smooth_sign;

/* u (3 - u^2) / 2 between -1 and 1, once continuously differentiable. */
static smooth_sign sign_of(double v, double width)
{
    double u = v / width;
    if (fabs(u) >= 1.0)
        return (smooth_sign){v < 0.0 ? -1.0 : 1.0, 0.0};
    return (smooth_sign){0.5 * u * (3.0 - u * u), 1.5 * (1.0 - u * u) / width};
}

static double relative(const gm_motion_pair *pair, const double *w)
{
    return w[pair->node] - gm_motion_speed_on(pair, w);
}

/* d/dv of M(|v|) s(v). */
static double slope_of(double value, double d_speed, double v, smooth_sign s)
{
    return (v < 0.0 ? -d_speed : d_speed) * s.value + value * s.slope;
}

static gm_motion_friction mesh_at(const gm_motion *m, int i, const double *w)
{
    const gm_mesh_element *mesh = &m->gearset->meshes[i];
    double v = gm_row_speed(&m->roll[i], w);
    smooth_sign s = sign_of(v, GM_COULOMB_ROLLING);
    gm_mesh_friction f =
        gm_mesh_friction_at(mesh, m->force[i], fabs(v) / mesh->cos_alpha_wt);
    double scale = m->loss_scale, torque = scale * s.value * f.value;
    return (gm_motion_friction){
        .speed = v,
        .torque = torque,
        .d_speed = scale * slope_of(f.value, f.d_speed / mesh->cos_alpha_wt, v, s),
        .d_force = scale * s.value * f.d_force,
        .loss = torque * v};
}

/* `count` bearings together, loss_scale included. A law without a state, with the sign of
 * its speed. */
static gm_motion_friction sliding_at(const gm_bearing_element *e, gm_motion_bearing *b,
                                     double count, double v)
{
    smooth_sign s = sign_of(v, GM_COULOMB_SPEED);
    gm_bearing_torque M = gm_bearing_friction(&e->law, &b->law, b->radial, b->axial);
    b->d_radial = count * s.value * M.d_radial;
    b->d_axial = count * s.value * M.d_axial;
    return (gm_motion_friction){.speed = v,
                                .torque = count * s.value * M.value,
                                .d_speed = count * slope_of(M.value, M.d_speed, v, s),
                                .loss = count * s.value * M.value * v};
}

static gm_motion_friction elastic_at(const gm_bearing_element *e, gm_motion_bearing *b,
                                     double count, double v, double z)
{
    b->bristle = gm_bearing_elastic(&e->law, &b->law, v, z, b->radial, b->axial);
    b->d_radial = count * b->bristle.torque_radial;
    b->d_axial = count * b->bristle.torque_axial;
    return (gm_motion_friction){.speed = v,
                                .torque = count * b->bristle.torque,
                                .d_speed = count * b->bristle.torque_speed,
                                .loss = count * b->bristle.loss};
}

static gm_motion_friction bearing_at(gm_motion *m, int i, const double *x)
{
    const gm_bearing_element *e = &m->gearset->bearings[i];
    gm_motion_bearing *b = &m->bearing[i];
    double v = relative(&b->pair, x);
    gm_bearing_load load =
        gm_bearing_load_at(e, gm_motion_speed_on(&b->pair, x), m->force, NULL, NULL);
    b->radial = load.radial;
    b->axial = load.axial;
    if (fabs(v) != b->law.w)
        b->law = gm_bearing_at_speed(&e->law, fabs(v));
    double count = m->loss_scale * e->count;
    return b->state >= 0 ? elastic_at(e, b, count, v, x[b->state])
                         : sliding_at(e, b, count, v);
}

static gm_motion_friction drag_at(const gm_motion *m, int i, const double *w)
{
    double v = relative(&m->drag[i], w);
    smooth_sign s = sign_of(v, GM_COULOMB_SPEED);
    gm_speed_torque M = gm_drag_torque(m->gearset, &m->gearset->drags[i], fabs(v));
    double torque = m->loss_scale * s.value * M.value;
    return (gm_motion_friction){.speed = v,
                                .torque = torque,
                                .d_speed =
                                    m->loss_scale * slope_of(M.value, M.d_speed, v, s),
                                .loss = torque * v};
}

void gm_motion_friction_at(gm_motion *motion, const double *x)
{
    const gm_gearset *g = motion->gearset;
    for (int i = 0; i < g->n_meshes; i++)
        motion->mesh_friction[i] = mesh_at(motion, i, x);
    for (int i = 0; i < g->n_bearings; i++)
        motion->bearing_friction[i] = bearing_at(motion, i, x);
    for (int i = 0; i < g->n_drags; i++)
        motion->drag_friction[i] = drag_at(motion, i, x);
}

static void apply(const gm_motion_pair *pair, double t, double *torque)
{
    torque[pair->node] -= t;
    if (pair->on >= 0)
        torque[pair->on] += t;
}

void gm_motion_add_friction(const gm_motion *motion, double *torque)
{
    const gm_gearset *g = motion->gearset;
    for (int i = 0; i < g->n_meshes; i++)
        gm_row_apply(&motion->roll[i], motion->mesh_friction[i].torque, torque);
    for (int i = 0; i < g->n_bearings; i++)
        apply(&motion->bearing[i].pair, motion->bearing_friction[i].torque, torque);
    for (int i = 0; i < g->n_drags; i++)
        apply(&motion->drag[i], motion->drag_friction[i].torque, torque);
}

static double power_of(int n, const gm_motion_friction *f)
{
    double power = 0.0;
    for (int i = 0; i < n; i++)
        power += f[i].loss;
    return power;
}

double gm_motion_friction_power(const gm_motion *motion)
{
    const gm_gearset *g = motion->gearset;
    return power_of(g->n_meshes, motion->mesh_friction) +
           power_of(g->n_bearings, motion->bearing_friction) +
           power_of(g->n_drags, motion->drag_friction);
}

double gm_motion_bristle_energy(const gm_motion *motion)
{
    double energy = 0.0;
    for (int i = 0; i < motion->gearset->n_bearings; i++)
        if (motion->bearing[i].state >= 0)
            energy += motion->loss_scale * motion->gearset->bearings[i].count *
                      motion->bearing[i].bristle.stored;
    return energy;
}
