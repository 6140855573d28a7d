/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Axes by error beside the uniform grid with the same error: points solved and nodes of
 * the load losses, for the loss with one path engaged at 2000 random points. For some
 * ratios of speed step to torque step both are shortened together from 75 rpm on, by a
 * factor of 1.4, until the grid is as good; the one with the fewest points is told.
 *
 *   bench_axes [description.yaml [tolerance in percent]]
 */
#include "model/gm_gearset.h"
#include "plant/gm_builtin.h"
#include "sweep/gm_sweep.h"
#include "sweep/gm_verify.h"

#include <stdio.h>
#include <stdlib.h>

#define RPM (2.0 * 3.14159265358979323846 / 60.0)
#define POINTS 2000
#define SEED 1
#define FINER 1.4
#define FIRST_STEP 75.0 /* rpm */

typedef struct outcome {
    long points, nodes;
    double error, elapsed;
} outcome;

static gm_status measure(const gm_plant *plant, const gm_sweep_options *options,
                         outcome *o, gm_error *error)
{
    gm_map *map = NULL;
    gm_sweep_summary summary;
    gm_verify_result result;
    gm_status status =
        gm_sweep_run(plant, options, NULL, NULL, NULL, &map, &summary, error);
    if (status != GM_OK)
        return status;
    status = gm_verify_map(1, &plant, map, 0, POINTS, SEED, &result, error);
    if (status == GM_OK) {
        *o = (outcome){summary.points, 0, result.max_relative[GM_VERIFY_SINGLE],
                       summary.elapsed};
        for (int t = 0; t < map->n_tables; t++)
            if (map->tables[t].key.symbol == GM_LOAD_LOSS)
                o->nodes += gm_map_table_size(&map->tables[t]);
        gm_verify_result_clear(&result);
    }
    gm_map_destroy(map);
    return status;
}

static void print(const char *name, const outcome *o)
{
    printf("%-24s %9ld points %9ld nodes of D  %7.3f %%  %7.2f s\n", name, o->points,
           o->nodes, 100.0 * o->error, o->elapsed);
    fflush(stdout);
}

static gm_status uniform(const gm_plant *plant, double speed, double torque, outcome *o,
                         gm_error *error)
{
    char name[48];
    const gm_sweep_options options = {.speed_step = speed * RPM, .torque_step = torque};
    gm_status status = measure(plant, &options, o, error);
    (void)snprintf(name, sizeof name, "%.4g rpm x %.4g N.m", speed, torque);
    if (status == GM_OK)
        print(name, o);
    return status;
}

/* The first grid of this ratio (rpm per N.m) that is as good. */
static gm_status search(const gm_plant *plant, double ratio, double wanted, outcome *grid,
                        gm_error *error)
{
    double speed = FIRST_STEP;
    gm_status status = uniform(plant, speed, speed / ratio, grid, error);
    while (status == GM_OK && grid->error > wanted) {
        speed /= FINER;
        status = uniform(plant, speed, speed / ratio, grid, error);
    }
    return status;
}

static gm_status compare(const gm_plant *plant, double tolerance, gm_error *error)
{
    static const double ratios[] = {2.0, 4.0};
    const gm_sweep_options options = {.tolerance_share = tolerance};
    outcome by_error, best = {0};
    gm_status status = measure(plant, &options, &by_error, error);
    if (status == GM_OK)
        print("by error", &by_error);
    for (size_t i = 0; i < sizeof ratios / sizeof ratios[0] && status == GM_OK; i++) {
        outcome grid;
        status = search(plant, ratios[i], by_error.error, &grid, error);
        if (status == GM_OK && (i == 0 || grid.points < best.points))
            best = grid;
    }
    if (status == GM_OK)
        printf("the uniform grid takes %.1f times the points, %.1f times the nodes\n",
               (double)best.points / (double)by_error.points,
               (double)best.nodes / (double)by_error.nodes);
    return status;
}

int main(int argc, char **argv)
{
    const char *path = argc > 1 ? argv[1] : GM_SOURCE_DIR "/examples/dct7.yaml";
    double tolerance = argc > 2 ? strtod(argv[2], NULL) / 100.0 : 0.005;
    gm_error error = {GM_OK, ""};
    gm_description *description = NULL;
    gm_gearset *gearset = NULL;
    gm_plant *plant = NULL;
    gm_status status = gm_description_read(path, &description, &error);
    if (status == GM_OK)
        status = gm_gearset_create(description, description->oil.temperature, &gearset,
                                   &error);
    if (status == GM_OK)
        status = gm_builtin_create(gearset, &plant, &error);
    if (status == GM_OK)
        status = compare(plant, tolerance, &error);
    gm_builtin_destroy(plant);
    gm_gearset_destroy(gearset);
    gm_description_destroy(description);
    if (status != GM_OK)
        fprintf(stderr, "bench_axes: %s\n", error.message);
    return status != GM_OK;
}
