/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/oil_profile.h"

#include <math.h>
#include <string.h>

enum { SPEEDS = 4, TORQUES = GM_OIL_PLACES / SPEEDS };

/* Of the largest ones. */
static const double speeds[SPEEDS] = {0.03, 0.15, 0.4, 0.9};
static const double torques[TORQUES] = {0.0, 0.15, 0.8, -0.5};

/* Shares beyond these would be none of a loss that goes one way. */
#define LEAST_SHARE 0.05
#define MOST_SHARE 0.95
#define NO_BEND 1e-9 /* what solvers and rounding leave of a straight line */

static int rest_gear(const gm_plant_path *path)
{
    return path->always_engaged ? path->gears[0].number : GM_NEUTRAL;
}

static gm_steady_point point_at_rest(const gm_plant *plant)
{
    gm_steady_point point;
    memset(&point, 0, sizeof point);
    for (int p = 0; p < plant->info.n_paths; p++)
        point.gear[p] = rest_gear(&plant->info.path[p]);
    return point;
}

static gm_status ask(const gm_oil_asker *a, const gm_steady_point *point, double speed,
                     double *loss, gm_error *error)
{
    gm_steady_result result;
    double power = 0.0;
    gm_status status = a->solve(a->user, point, &result, error);
    if (status != GM_OK)
        return status;
    for (int f = 0; f <= a->plant->info.n_paths; f++)
        power += result.torque[f] * result.speed[f];
    *loss = power / speed;
    return GM_OK;
}

static double *new_group(gm_oil_profile *profile)
{
    double *loss = profile->loss[profile->n++];
    for (int i = 0; i < GM_OIL_PLACES; i++)
        loss[i] = (double)NAN;
    return loss;
}

static gm_status measure_gear(const gm_oil_asker *a, int p, int number,
                              gm_oil_profile *profile, gm_error *error)
{
    gm_kinematics kinematics;
    double *loss = new_group(profile);
    gm_steady_point at = point_at_rest(a->plant);
    at.gear[p] = number;
    gm_status status =
        a->plant->is->kinematics(a->plant->self, at.gear, &kinematics, error);
    for (int i = 0; i < GM_OIL_PLACES && status == GM_OK; i++) {
        double speed = speeds[i / TORQUES] * a->speed_max, ratio = kinematics.ratio[p];
        at.speed[0] = speed / ratio;
        at.direction[0] = ratio < 0.0 ? -1.0 : 1.0;
        at.torque[1 + p] = torques[i % TORQUES] * a->torque_max;
        status = ask(a, &at, speed, &loss[i], error);
    }
    return status;
}

static gm_status measure_drag(const gm_oil_asker *a, int p, gm_oil_profile *profile,
                              gm_error *error)
{
    double *loss = new_group(profile);
    gm_steady_point at = point_at_rest(a->plant);
    gm_status status = GM_OK;
    for (int i = 0; i < SPEEDS && status == GM_OK; i++) {
        at.speed[1 + p] = speeds[i] * a->speed_max;
        at.direction[1 + p] = 1.0;
        status = ask(a, &at, at.speed[1 + p], &loss[i], error);
    }
    return status;
}

gm_status gm_oil_profile_measure(const gm_oil_asker *asker, gm_oil_profile *profile,
                                 gm_error *error)
{
    const gm_plant_info *info = &asker->plant->info;
    gm_status status = GM_OK;
    profile->temperature = info->oil_temperature;
    profile->n = 0;
    for (int p = 0; p < info->n_paths && status == GM_OK; p++) {
        const gm_plant_path *path = &info->path[p];
        if (!path->always_engaged)
            status = measure_drag(asker, p, profile, error);
        for (int g = 0; g < path->n_gears && status == GM_OK; g++)
            status = measure_gear(asker, p, path->gears[g].number, profile, error);
    }
    return status;
}

static double largest_of(const double *loss)
{
    double largest = 0.0;
    for (int i = 0; i < GM_OIL_PLACES; i++)
        largest = fmax(largest, fabs(loss[i])); /* fmax passes over what is no number */
    return largest;
}

static double way(const gm_oil_profile *low, double temperature,
                  const gm_oil_profile *high)
{
    return (temperature - low->temperature) / (high->temperature - low->temperature);
}

double gm_oil_bend_between(const gm_oil_profile *low, const gm_oil_profile *between,
                           const gm_oil_profile *high)
{
    double product = 0.0, square = 0.0;
    for (int g = 0; g < low->n; g++) {
        double largest = fmax(largest_of(low->loss[g]), largest_of(high->loss[g]));
        for (int i = 0; i < GM_OIL_PLACES && largest > 0.0; i++) {
            double all = (high->loss[g][i] - low->loss[g][i]) / largest;
            double part = (between->loss[g][i] - low->loss[g][i]) / largest;
            product += isfinite(part * all) ? part * all : 0.0;
            square += isfinite(part * all) ? all * all : 0.0;
        }
    }
    if (!(square > 0.0))
        return 0.0;
    /* share = u (1 + bend) / (1 + bend u) solved for the bend */
    double share = fmin(fmax(product / square, LEAST_SHARE), MOST_SHARE);
    double u = way(low, between->temperature, high);
    double bend = (share - u) / (u * (1.0 - share));
    return fabs(bend) < NO_BEND ? 0.0 : bend;
}

double gm_oil_error(const gm_oil_profile *low, const gm_oil_profile *high, double bend,
                    const gm_oil_profile *there, double share, double torque)
{
    double u = way(low, there->temperature, high), error = 0.0;
    double part = u * (1.0 + bend) / (1.0 + bend * u);
    for (int g = 0; g < low->n; g++) {
        double tolerance = fmax(torque, share * largest_of(there->loss[g]));
        for (int i = 0; i < GM_OIL_PLACES && tolerance > 0.0; i++) {
            double from = low->loss[g][i];
            double read = from + part * (high->loss[g][i] - from);
            error = fmax(error, fabs(read - there->loss[g][i]) / tolerance);
        }
    }
    return error;
}
