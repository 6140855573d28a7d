/* SPDX-License-Identifier: BSD-2-Clause
 *
 * replay RECORDS FIDELITY: runs recorded inputs in steps of 1 ms from rest and prints a
 * line at the end of each record, then a hash over the bits of every speed, twist, mode
 * and sum of every step: equal on all targets that compute the same bits.
 */
#include "gm_gearset.h"
#include "gm_tables.h"
#include "records.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* FNV-1a, 32 bits. */
static uint32_t add(uint32_t hash, const void *data, size_t n)
{
    const unsigned char *bytes = data;
    for (size_t i = 0; i < n; i++) {
        hash = (hash ^ bytes[i]) * 16777619u;
    }
    return hash;
}

static uint32_t add_gearset(uint32_t hash, const gm_gearset *g)
{
    hash = add(hash, &g->state.w_o, sizeof g->state.w_o);
    hash = add(hash, &g->phi_o, sizeof g->phi_o);
    hash = add(hash, &g->work, sizeof g->work);
    hash = add(hash, &g->loss_energy, sizeof g->loss_energy);
    for (int p = 0; p < gm_tables_map.n_paths; p++) {
        const gm_path_state *path = &g->state.path[p];
        hash = add(hash, &path->w, sizeof path->w);
        hash = add(hash, &path->twist, sizeof path->twist);
        hash = add(hash, &path->mode, sizeof path->mode);
        hash = add(hash, &g->phi[p], sizeof g->phi[p]);
    }
    return hash;
}

static double sum_of(gm_sum sum)
{
    return (double)sum.high + (double)sum.low;
}

static void print_line(long step, const gm_gearset *g)
{
    printf("%ld %.17g %.17g %.17g %.17g %.17g %.17g\n", step, (double)g->state.w_o,
           (double)g->state.path[0].w, (double)g->state.path[1].w, sum_of(g->phi_o),
           sum_of(g->work), sum_of(g->loss_energy));
}

int main(int argc, char **argv)
{
    gm_gearset g;
    gm_gearset_start start;
    record r;
    long step = 0;
    int flags;
    uint32_t hash = 2166136261u;
    FILE *file = argc == 3 ? fopen(argv[1], "rb") : NULL;
    if (!file) {
        return 2;
    }
    gm_gearset_defaults(&gm_tables_map, &start);
    start.params.fidelity = atoi(argv[2]);
    flags = gm_gearset_init(&gm_tables_map, &start, &g);
    while (fread(&r, sizeof r, 1, file) == 1) {
        const gm_reduced_inputs in = inputs_of(&r);
        gm_gearset_set(&in, &g);
        for (int k = 0; k < r.steps; k++, step++) {
            flags |= gm_gearset_step(&gm_tables_map, &g, GM_NUM(0.001));
            hash = add_gearset(hash, &g);
        }
        print_line(step, &g);
    }
    printf("flags %d bits %08lx\n", flags, (unsigned long)hash);
    return fclose(file) != 0;
}
