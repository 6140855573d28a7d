/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/oil_bend.h"

#include "base/alloc.h"
#include "sweep/oil_profile.h"

static gm_status solve(void *user, const gm_steady_point *point, gm_steady_result *result,
                       gm_error *error)
{
    return gm_point_solve(user, point, result, error);
}

static gm_status measure(const gm_sweep_plan *plan, int plant, gm_point_solver *solver,
                         gm_oil_profile *profile, gm_error *error)
{
    const gm_oil_asker asker = {.solve = solve,
                                .user = solver,
                                .plant = plan->plants[plant],
                                .speed_max = plan->map->speed_max,
                                .torque_max = plan->map->torque_max};
    gm_point_solver_choose(solver, plant);
    return gm_oil_profile_measure(&asker, profile, error);
}

gm_status gm_oil_bend(const gm_sweep_plan *plan, int interval, gm_point_solver *solver,
                      double *bend, gm_error *error)
{
    const int plant[3] = {interval, plan->map->n_oil + interval, interval + 1};
    gm_oil_profile *profile = gm_calloc(3, sizeof *profile);
    gm_status status = GM_OK;
    if (!profile)
        return gm_fail(error, GM_ERR_MEMORY, "no memory for losses over the temperature");
    for (int k = 0; k < 3 && status == GM_OK; k++)
        status = measure(plan, plant[k], solver, &profile[k], error);
    if (status == GM_OK)
        *bend = gm_oil_bend_between(&profile[0], &profile[1], &profile[2]);
    gm_free(profile);
    return status;
}
