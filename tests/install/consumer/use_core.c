/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The reduced gearset alone, as a controller would use it: one path with one gear of
 * ratio 4 and a constant drag, accelerated for one second. With J = 0.5 + 4^2 * 0.01
 * = 0.66 kg.m2 and (4 * 2 - 1.4) N.m = 6.6 N.m the speed must be 10 rad/s.
 */
#include "core/gm_reduced.h"

#include <stdio.h>
#include <string.h>

static const gm_real speed[] = {0.0, 1000.0}, torque[] = {-100.0, 100.0};
static const gm_real none[4] = {0.0}, drag[] = {1.4, 1.4};

static gm_table2 zero_table(const gm_real *y)
{
    gm_table2 table = {{2, speed}, {2, y}, none};
    return table;
}

int main(void)
{
    gm_gear gear;
    gm_configuration configurations[2];
    gm_reduced_map map;
    gm_reduced_params params;
    gm_reduced_inputs inputs;
    gm_reduced_state state;
    gm_real w = 0.0;
    memset(&gear, 0, sizeof gear);
    gear.number = 1;
    gear.ratio = 4.0;
    memset(configurations, 0, sizeof configurations);
    memset(&map, 0, sizeof map);
    memset(&inputs, 0, sizeof inputs);
    for (int d = 0; d < 2; d++) {
        gear.load_loss[d] = zero_table(torque);
        for (int s = 0; s < 2; s++) {
            const gm_table1 parasitic = {{2, speed}, drag};
            configurations[s].parasitic[d] = parasitic;
            map.path[0].drag[d][s] = zero_table(speed);
            map.path[0].reaction[d][s] = zero_table(speed);
        }
    }
    configurations[0].gear[0] = -1;
    map.n_paths = 1;
    map.path[0].inertia = 0.01;
    map.path[0].sync_torque = 1000.0;
    map.path[0].n_gears = 1;
    map.path[0].gears = &gear;
    map.n_configurations = 2;
    map.configurations = configurations;
    map.inertia_output = 0.5;
    gm_reduced_default_params(&map, &params);
    inputs.gear[0] = 1;
    inputs.path_tau[0] = 2.0;
    if (gm_reduced_start(&map, &inputs, 0.0, &w, &state) != 0)
        return 1;
    for (int i = 0; i < 1000; i++)
        if (gm_reduced_step(&map, &params, &inputs, 1e-3, &state) != 0)
            return 1;
    printf("core: %.9f rad/s\n", state.w_o);
    return state.w_o > 10.0 - 1e-9 && state.w_o < 10.0 + 1e-9 ? 0 : 1;
}
