/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/oil_bend.h"

#include <math.h>
#include <string.h>

enum { SPEEDS = 4, TORQUES = 4, PLACES = SPEEDS * TORQUES };

/* Of the largest ones. */
static const double speeds[SPEEDS] = {0.03, 0.15, 0.4, 0.9};
static const double torques[TORQUES] = {0.0, 0.15, 0.8, -0.5};

/* Shares beyond these would be none of a loss that goes one way. */
#define LEAST_SHARE 0.05
#define MOST_SHARE 0.95
#define NO_BEND 1e-9 /* what solvers and rounding leave of a straight line */

/* Loss torques below, between and above, and their sums. */
typedef struct fit {
    const gm_sweep_plan *plan;
    gm_point_solver *solver;
    gm_error *error;
    int plant[3];
    int n;
    double loss[PLACES][3];
    double product, square;
} fit;

static gm_status add_place(fit *f, const gm_steady_point *point, double speed)
{
    gm_status status = GM_OK;
    for (int k = 0; k < 3 && status == GM_OK; k++) {
        gm_steady_result result;
        double power = 0.0;
        gm_point_solver_choose(f->solver, f->plant[k]);
        status = gm_point_solve(f->solver, point, &result, f->error);
        if (status != GM_OK)
            return status;
        for (int flange = 0; flange <= f->plan->map->n_paths; flange++)
            power += result.torque[flange] * result.speed[flange];
        f->loss[f->n][k] = power / speed;
    }
    /* Not a number: the point was skipped. */
    if (isfinite(f->loss[f->n][0] + f->loss[f->n][1] + f->loss[f->n][2]))
        f->n++;
    return GM_OK;
}

/* Every gear counts the same, however large its losses are. */
static void add_group(fit *f)
{
    double largest = 0.0;
    for (int i = 0; i < f->n; i++)
        largest = fmax(largest, fmax(fabs(f->loss[i][0]), fabs(f->loss[i][2])));
    for (int i = 0; i < f->n && largest > 0.0; i++) {
        double all = (f->loss[i][2] - f->loss[i][0]) / largest;
        f->product += (f->loss[i][1] - f->loss[i][0]) / largest * all;
        f->square += all * all;
    }
    f->n = 0;
}

static gm_steady_point point_at_rest(const gm_sweep_plan *plan)
{
    gm_steady_point point;
    memset(&point, 0, sizeof point);
    for (int p = 0; p < plan->map->n_paths; p++)
        point.gear[p] = gm_sweep_rest_gear(plan->plant, p);
    return point;
}

static gm_status add_gear(fit *f, int p, const gm_map_gear *gear)
{
    const gm_map *map = f->plan->map;
    gm_status status = GM_OK;
    for (int i = 0; i < PLACES && status == GM_OK; i++) {
        double speed = speeds[i / TORQUES] * map->speed_max;
        gm_steady_point point = point_at_rest(f->plan);
        point.gear[p] = gear->number;
        point.speed[0] = speed / gear->ratio;
        point.direction[0] = gear->ratio < 0.0 ? -1.0 : 1.0;
        point.torque[1 + p] = torques[i % TORQUES] * map->torque_max;
        status = add_place(f, &point, speed);
    }
    add_group(f);
    return status;
}

static gm_status add_drag(fit *f, int p)
{
    gm_status status = GM_OK;
    for (int i = 0; i < SPEEDS && status == GM_OK; i++) {
        gm_steady_point point = point_at_rest(f->plan);
        point.speed[1 + p] = speeds[i] * f->plan->map->speed_max;
        point.direction[1 + p] = 1.0;
        status = add_place(f, &point, point.speed[1 + p]);
    }
    add_group(f);
    return status;
}

/* share = u (1 + bend) / (1 + bend u) solved for the bend. */
static double bend_of(double share, double u)
{
    share = fmin(fmax(share, LEAST_SHARE), MOST_SHARE);
    double bend = (share - u) / (u * (1.0 - share));
    return fabs(bend) < NO_BEND ? 0.0 : bend;
}

static double temperature(const fit *f, int k)
{
    return f->plan->plants[f->plant[k]]->info.oil_temperature;
}

gm_status gm_oil_bend(const gm_sweep_plan *plan, int interval, gm_point_solver *solver,
                      double *bend, gm_error *error)
{
    const gm_map *map = plan->map;
    fit f = {.plan = plan,
             .solver = solver,
             .error = error,
             .plant = {interval, map->n_oil + interval, interval + 1}};
    gm_status status = GM_OK;
    for (int p = 0; p < map->n_paths && status == GM_OK; p++) {
        if (!plan->plant->info.path[p].always_engaged)
            status = add_drag(&f, p);
        for (int g = 0; g < map->paths[p].n_gears && status == GM_OK; g++)
            status = add_gear(&f, p, &map->paths[p].gears[g]);
    }
    double u = (temperature(&f, 1) - temperature(&f, 0)) /
               (temperature(&f, 2) - temperature(&f, 0));
    if (status == GM_OK)
        *bend = f.square > 0.0 ? bend_of(f.product / f.square, u) : 0.0;
    return status;
}
