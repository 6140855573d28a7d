/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A ratio is first seen roughly, at a creeping output that no gear can overspeed, then at
 * a tenth of the largest speed of the path. Inertias come from ramps: of every flange in
 * neutral, then of the output in every gear, driving and driven.
 */
#include "sweep/rig_identify.h"

#include "sweep/rig_parts.h"

#include <math.h>

/* Of the largest: speed of the paths while ratios and inertias are measured, and torque
   that keeps the flanks of an engaged path together. */
static const double test_speed = 0.3, test_torque = 0.1;
/* A ratio is first seen at this share of the largest speed at the output. */
static const double first_speed = 0.02;
/* Driving and driven differ by the slope of the loss over torque, and their mean is free
   of it where both slopes are alike: to a fifth, of which half stays in the mean. */
static const double unlike_slopes = 0.1;
/* What a gear adds beyond J_out and r^2 J_p counts only above this share of J_s. */
static const double least_extra = 5e-3;

typedef struct identifier {
    gm_rig_run *run;
    const gm_rig_identification *how;
    gm_rig_identity *identity;
    gm_error *error;
} identifier;

static int rest_gear(const gm_plant_info *info, int p)
{
    const gm_plant_path *path = &info->path[p];
    return path->always_engaged ? path->gears[0].number : 0;
}

/* All at rest, without load. */
static gm_rig_target rest(const identifier *id)
{
    gm_rig_target target = {.ratio = {0.0, 0.0}};
    for (int p = 0; p < id->how->info->n_paths; p++) {
        target.point.gear[p] = rest_gear(id->how->info, p);
        if (target.point.gear[p] != 0)
            target.ratio[p] = id->identity->ratio[p][0];
    }
    return target;
}

static gm_status see_ratio(identifier *id, int p, int number, double ratio,
                           double output_speed, double *seen)
{
    gm_rig_target target = rest(id);
    gm_rig_found found;
    target.point.gear[p] = number;
    target.ratio[p] = isnan(ratio) ? 0.0 : ratio;
    target.point.speed[0] = output_speed;
    target.point.torque[1 + p] = test_torque * id->run->scales.torque;
    gm_rig_run_restart(id->run);
    gm_status status = gm_rig_run_hold(id->run, &target, &found, id->error);
    if (status == GM_OK)
        *seen = found.speed[1 + p] / found.speed[0];
    return status;
}

static gm_status find_ratio(identifier *id, int p, int g)
{
    const gm_plant_gear *gear = &id->how->info->path[p].gears[g];
    double speed = id->run->scales.speed, rough = gear->ratio_given;
    gm_status status = GM_OK;
    if (isnan(rough))
        status = see_ratio(id, p, gear->number, rough, first_speed * speed, &rough);
    if (status != GM_OK)
        return status;
    if (rough == 0.0 || !isfinite(rough))
        return gm_fail(id->error, GM_ERR_MODEL,
                       "path '%s', gear %d: the path does not turn with the output",
                       id->how->info->path[p].name, gear->number);
    return see_ratio(id, p, gear->number, rough, test_speed * speed / fabs(rough),
                     &id->identity->ratio[p][g]);
}

/* A body gives in to torque; where torque counts the other way it seems to push back. */
static gm_status check_inertia(const identifier *id, const char *flange, double inertia)
{
    if (inertia > 0.0)
        return GM_OK;
    return gm_fail(id->error, GM_ERR_MODEL,
                   "the inertia at the %s seems to be %.3g kg.m2; does the model count "
                   "its torque the other way (sign: minus)?",
                   flange, inertia);
}

/* Flange f in neutral, the others at rest. */
static gm_status find_free_inertia(identifier *id, int f)
{
    gm_rig_target target = rest(id);
    double least = HUGE_VAL;
    const gm_plant_info *info = id->how->info;
    for (int p = 0; f == 0 && p < info->n_paths; p++)
        for (int g = 0; g < info->path[p].n_gears; g++)
            least = fmin(least, fabs(id->identity->ratio[p][g]));
    target.point.speed[f] = test_speed * id->run->scales.speed / (f == 0 ? least : 1.0);
    gm_rig_run_restart(id->run);
    gm_status status = gm_rig_ramp_inertia(id->run, &target, f, id->how->ramp_time,
                                           &id->identity->inertia[f], id->error);
    return status == GM_OK ? check_inertia(id, f == 0 ? "output" : info->path[f - 1].name,
                                           id->identity->inertia[f].value)
                           : status;
}

/* J_s at the output: the mean of driving and driven. */
static gm_status find_total(identifier *id, int p, int g)
{
    const gm_plant_gear *gear = &id->how->info->path[p].gears[g];
    double ratio = id->identity->ratio[p][g];
    int at_path = id->run->rig->drive[0] == GM_RIG_TORQUE_IN &&
                  id->run->rig->drive[1 + p] == GM_RIG_SPEED_IN;
    double factor = at_path ? ratio * ratio : 1.0;
    gm_rig_inertia sum = {0.0, 0.0};
    double spread = 0.0;
    gm_status status = GM_OK;
    for (int side = -1; side <= 1 && status == GM_OK; side += 2) {
        gm_rig_target target = rest(id);
        gm_rig_inertia one;
        target.point.gear[p] = gear->number;
        target.ratio[p] = ratio;
        target.point.speed[0] = test_speed * id->run->scales.speed / fabs(ratio);
        target.point.torque[1 + p] = side * test_torque * id->run->scales.torque;
        gm_rig_run_restart(id->run);
        status = gm_rig_ramp_inertia(id->run, &target, at_path ? 1 + p : 0,
                                     id->how->ramp_time, &one, id->error);
        sum.value += 0.5 * factor * one.value;
        sum.uncertainty += 0.5 * factor * one.uncertainty;
        spread += 0.5 * side * factor * one.value;
    }
    sum.uncertainty += unlike_slopes * fabs(spread);
    id->identity->total[p][g] = sum;
    return status;
}

/* In neutral where there is one; of a path without it what is given. */
static gm_status find_inertias(identifier *id)
{
    const gm_plant_info *info = id->how->info;
    gm_rig_identity *found = id->identity;
    int fixed = -1;
    gm_status status = GM_OK;
    for (int p = 0; p < info->n_paths && status == GM_OK; p++) {
        double given = id->how->given_inertia[p];
        if (info->path[p].always_engaged) {
            fixed = p;
            if (isnan(given))
                return gm_fail(id->error, GM_ERR_MODEL,
                               "path '%s' has no neutral to measure its inertia in: "
                               "give its inertia_kgm2",
                               info->path[p].name);
        }
        if (isnan(given))
            status = find_free_inertia(id, 1 + p);
        else
            found->inertia[1 + p] = (gm_rig_inertia){given, 0.0};
    }
    if (status != GM_OK || fixed < 0)
        return status == GM_OK ? find_free_inertia(id, 0) : status;
    status = find_total(id, fixed, 0);
    double ratio = found->ratio[fixed][0];
    found->inertia[0] = found->total[fixed][0];
    found->inertia[0].value -= ratio * ratio * found->inertia[1 + fixed].value;
    return status;
}

/* What ramps cannot tell from J_out + r^2 J_p is that. */
static void drop_small_extra(identifier *id, int p, int g)
{
    const gm_rig_identity *found = id->identity;
    gm_rig_inertia *total = &id->identity->total[p][g];
    double ratio = found->ratio[p][g];
    double sum = found->inertia[0].value + ratio * ratio * found->inertia[1 + p].value;
    for (int q = 0; q < id->how->info->n_paths; q++)
        if (q != p && rest_gear(id->how->info, q) != 0)
            sum += found->ratio[q][0] * found->ratio[q][0] * found->inertia[1 + q].value;
    if (fabs(total->value - sum) <= least_extra * sum + total->uncertainty)
        total->value = sum;
}

gm_status gm_rig_identify(gm_rig_run *run, const gm_rig_identification *how,
                          gm_rig_identity *identity, gm_error *error)
{
    identifier id = {run, how, identity, error};
    gm_status status = GM_OK;
    for (int p = 0; p < how->info->n_paths && status == GM_OK; p++)
        for (int g = 0; g < how->info->path[p].n_gears && status == GM_OK; g++)
            status = find_ratio(&id, p, g);
    if (status == GM_OK)
        status = find_inertias(&id);
    for (int p = 0; p < how->info->n_paths && status == GM_OK; p++)
        for (int g = 0; g < how->info->path[p].n_gears && status == GM_OK; g++) {
            status = find_total(&id, p, g);
            if (status == GM_OK)
                drop_small_extra(&id, p, g);
        }
    return status;
}
