/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/rig_point.h"

#include "sweep/rig_ramp.h"

#include <math.h>

/* A limit is extrapolated from once, twice and three times the creep speed. */
enum { CREEPS = 3 };
/* A path counts as on a line this close to it, relative to the speed there: the sweep
   puts its points 1e-11 away. */
static const double on_line = 1e-9;
/* At rest the sweep's directions are this far from a line, relative to it. */
static const double along_line = 1e-2;

static double sgn(double x)
{
    return (double)(x > 0) - (double)(x < 0);
}

/* On which side of a drag line path p is meant to be; 0: it is not on it. */
static double side_of_line(const gm_steady_point *at, int p, double ratio)
{
    double w = at->speed[1 + p], on = ratio * at->speed[0];
    if (on != 0.0)
        return fabs(w - on) <= on_line * fabs(on) ? sgn(w - on) : 0.0;
    double d = at->direction[1 + p], along = ratio * at->direction[0];
    if (w != 0.0 || along == 0.0 || d == 0.0)
        return 0.0;
    return fabs(d - along) <= along_line * fabs(along) ? sgn(d - along) : 0.0;
}

/* Move the independent flanges by `away` in the directions that the point names; 0: it is
   no limit. */
static int move(const gm_rig_limits *limits, int n_paths, double away,
                gm_steady_point *at)
{
    const gm_steady_point asked = *at;
    int moved = 0;
    for (int f = 0; f <= n_paths; f++) {
        int independent = f == 0 || asked.gear[f - 1] == 0;
        if (independent && asked.speed[f] == 0.0 && asked.direction[f] != 0.0) {
            at->speed[f] = away * sgn(asked.direction[f]);
            moved = 1;
        }
    }
    for (int p = 0; p < n_paths; p++)
        for (int i = 0; asked.gear[p] == 0 && i < limits->n_lines[p]; i++) {
            double ratio = limits->line[p][i], side = side_of_line(&asked, p, ratio);
            if (side == 0.0)
                continue;
            at->speed[1 + p] = ratio * at->speed[0] + side * away;
            moved = 1;
        }
    return moved;
}

/* From one, two and three times the distance to none, by a parabola; how far a straight
   line would be away tells how much it can be trusted. */
static void extrapolate(const gm_rig_found at[CREEPS], int n_paths, gm_rig_found *found)
{
    for (int f = 0; f <= n_paths; f++) {
        const double torque[] = {at[0].torque[f], at[1].torque[f], at[2].torque[f]};
        const double speed[] = {at[0].speed[f], at[1].speed[f], at[2].speed[f]};
        double bent = torque[0] - 2.0 * torque[1] + torque[2];
        found->torque[f] = 3.0 * (torque[0] - torque[1]) + torque[2];
        found->speed[f] = 3.0 * (speed[0] - speed[1]) + speed[2];
        found->change[f] =
            fabs(bent) + 3.0 * (at[0].change[f] + at[1].change[f]) + at[2].change[f];
    }
}

/* The flange that is ramped; -1: nothing turns faster than it creeps. */
static int ramped_flange(const gm_steady_point *at, int n_paths, double creep)
{
    for (int p = 0; p < n_paths; p++)
        if (at->gear[p] == 0 && fabs(at->speed[1 + p]) > CREEPS * creep)
            return 1 + p;
    return fabs(at->speed[0]) > CREEPS * creep ? 0 : -1;
}

static gm_status measure_at(gm_rig_run *run, const gm_rig_limits *limits,
                            const gm_rig_target *target, gm_rig_found *found,
                            gm_error *error)
{
    int flange = ramped_flange(&target->point, gm_rig_run_paths(run), limits->creep);
    if (!limits->ramps || flange < 0)
        return gm_rig_run_hold(run, target, found, error);
    return gm_rig_ramp_torque(run, target, flange, limits->ramp_time, found, error);
}

gm_status gm_rig_point_measure(gm_rig_run *run, const gm_rig_limits *limits,
                               const gm_rig_target *target, gm_rig_found *found,
                               gm_error *error)
{
    gm_rig_found at[CREEPS];
    int n_paths = gm_rig_run_paths(run);
    for (int k = CREEPS; k >= 1; k--) {
        gm_rig_target away = *target;
        if (!move(limits, n_paths, k * limits->creep, &away.point))
            return measure_at(run, limits, target, found, error);
        gm_status status = measure_at(run, limits, &away, &at[k - 1], error);
        if (status != GM_OK)
            return status;
    }
    extrapolate(at, n_paths, found);
    return GM_OK;
}
