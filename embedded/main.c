/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Example: the gearset runs up from rest under a constant torque and is then left to its
 * losses. Prints what a controller would send on its bus; only this file needs stdio.
 */
#include "gm_gearset.h"
#include "gm_tables.h"

#include <stdio.h>

#define H GM_NUM(0.001) /* s */

int main(void)
{
    const gm_reduced_map *map = &gm_tables_map;
    gm_gearset g;
    gm_gearset_start start;
    gm_gearset_outputs outputs;
    gm_reduced_inputs inputs = {.oil_temperature = map->oil_temperature};

    gm_gearset_defaults(map, &start);
    start.gear[0] = map->path[0].gears[0].number;
    inputs.gear[0] = start.gear[0];
    int flags = gm_gearset_init(map, &start, &g);

    printf("t [s]  output [rad/s]  %s [rad/s]  loss [W]  lost [J]\n",
           gm_tables_path_names[0]);
    for (int k = 0; k < 2000; k++) {
        inputs.path_tau[0] = k < 1000 ? 5 : 0;
        gm_gearset_set(&inputs, &g);
        flags |= gm_gearset_step(map, &g, H);
        if (k % 200 == 199 && !(gm_gearset_get(map, &g, &outputs) & GM_FLAG_NOT_FINITE)) {
            printf("%.1f  %.3f  %.3f  %.2f  %.3f\n", (k + 1) * 1e-3, (double)outputs.w_o,
                   (double)outputs.w[0], (double)outputs.at.loss_power,
                   (double)outputs.loss_energy.high);
        }
    }
    return (flags & GM_FLAG_NOT_FINITE) != 0;
}
