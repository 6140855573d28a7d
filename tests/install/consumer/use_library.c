/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The library from outside: read a description, assemble it, solve one steady point.
 */
#include "model/gm_gearset.h"
#include "plant/gm_builtin.h"
#include "solve/gm_steady_solver.h"

#include <stdio.h>

int main(int argc, char **argv)
{
    gm_description *description = NULL;
    gm_gearset *gearset = NULL;
    gm_plant *plant = NULL;
    gm_steady_solver *solver = NULL;
    gm_steady_point point = {{0}, {0}, {0}, {0}};
    gm_steady_result result;
    gm_kinematics k;
    gm_error error = {GM_OK, ""};
    gm_status status =
        gm_description_read(argc > 1 ? argv[1] : "missing.yaml", &description, &error);
    if (status == GM_OK)
        status = gm_gearset_create(description, 353.15, &gearset, &error);
    if (status == GM_OK)
        status = gm_builtin_create(gearset, &plant, &error);
    if (status == GM_OK)
        status = gm_steady_solver_create(plant, &solver, &error);
    point.gear[0] = 1;
    if (status == GM_OK)
        status = gm_gearset_kinematics(gearset, point.gear, &k, &error);
    for (int i = 0; i < GM_MAX_FLANGES; i++)
        point.direction[i] = 1.0;
    point.speed[0] = 10.0;
    point.torque[1] = 100.0;
    if (status == GM_OK)
        status = gm_steady_solve(solver, &point, &result, &error);
    if (status != GM_OK) {
        printf("library: %s\n", error.message);
        return 1;
    }
    double loss = 100.0 * k.ratio[0] * 10.0 + result.torque[0] * 10.0;
    printf("library: ratio %.4f, loss %.1f W\n", k.ratio[0], loss);
    gm_steady_solver_destroy(solver);
    gm_builtin_destroy(plant);
    gm_gearset_destroy(gearset);
    gm_description_destroy(description);
    return loss > 0.0 ? 0 : 1;
}
