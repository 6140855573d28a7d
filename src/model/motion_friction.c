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
    return (gm_motion_friction){
        .speed = v,
        .torque = s.value * f.value,
        .d_speed = slope_of(f.value, f.d_speed / mesh->cos_alpha_wt, v, s),
        .d_force = s.value * f.d_force};
}

static gm_motion_friction bearing_at(gm_motion *m, int i, const double *w)
{
    const gm_bearing_element *e = &m->gearset->bearings[i];
    gm_motion_friction f = {.speed = relative(&m->bearing[i], w)};
    smooth_sign s = sign_of(f.speed, GM_COULOMB_SPEED);
    if (fabs(f.speed) != m->bearing_speed[i].w)
        m->bearing_speed[i] = gm_bearing_at_speed(&e->law, fabs(f.speed));
    gm_bearing_load load = gm_bearing_load_at(e, gm_motion_speed_on(&m->bearing[i], w),
                                              m->force, NULL, NULL);
    gm_bearing_torque M =
        gm_bearing_friction(&e->law, &m->bearing_speed[i], load.radial, load.axial);
    f.radial = load.radial;
    f.axial = load.axial;
    f.torque = e->count * s.value * M.value;
    f.d_speed = e->count * slope_of(M.value, M.d_speed, f.speed, s);
    f.d_radial = e->count * s.value * M.d_radial;
    f.d_axial = e->count * s.value * M.d_axial;
    return f;
}

static gm_motion_friction drag_at(const gm_motion *m, int i, const double *w)
{
    double v = relative(&m->drag[i], w);
    smooth_sign s = sign_of(v, GM_COULOMB_SPEED);
    gm_speed_torque M = gm_drag_torque(m->gearset, &m->gearset->drags[i], fabs(v));
    return (gm_motion_friction){.speed = v,
                                .torque = s.value * M.value,
                                .d_speed = slope_of(M.value, M.d_speed, v, s)};
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
        apply(&motion->bearing[i], motion->bearing_friction[i].torque, torque);
    for (int i = 0; i < g->n_drags; i++)
        apply(&motion->drag[i], motion->drag_friction[i].torque, torque);
}

static double power_of(int n, const gm_motion_friction *f)
{
    double power = 0.0;
    for (int i = 0; i < n; i++)
        power += f[i].torque * f[i].speed;
    return power;
}

double gm_motion_friction_power(const gm_motion *motion)
{
    const gm_gearset *g = motion->gearset;
    return power_of(g->n_meshes, motion->mesh_friction) +
           power_of(g->n_bearings, motion->bearing_friction) +
           power_of(g->n_drags, motion->drag_friction);
}
