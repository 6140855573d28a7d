/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Time of the whole sweep of an example in memory: automatic axes and the grid of
 * published tools (150 rpm, 50 N.m), with one and two threads. The best of five runs.
 *
 *   bench_sweep [description.yaml]
 */
#include "model/gm_gearset.h"
#include "plant/gm_builtin.h"
#include "sweep/gm_sweep.h"

#include <stdio.h>

#define RUNS 5
#define RPM (2.0 * 3.14159265358979323846 / 60.0)

static gm_status time_sweep(const gm_plant *plant, const gm_sweep_options *options,
                            gm_sweep_summary *best, gm_error *error)
{
    for (int i = 0; i < RUNS; i++) {
        gm_map *map = NULL;
        gm_sweep_summary summary;
        gm_status status =
            gm_sweep_run(plant, options, NULL, NULL, NULL, &map, &summary, error);
        gm_map_destroy(map);
        if (status != GM_OK)
            return status;
        if (i == 0 || summary.elapsed < best->elapsed)
            *best = summary;
    }
    return GM_OK;
}

static gm_status run(const gm_plant *plant, gm_error *error)
{
    static const struct {
        const char *name;
        gm_sweep_options options;
    } grid[] = {
        {"automatic", {.threads = 1}},
        {"automatic", {.threads = 2}},
        {"150rpm 50Nm", {.speed_step = 150.0 * RPM, .torque_step = 50.0, .threads = 1}},
        {"150rpm 50Nm", {.speed_step = 150.0 * RPM, .torque_step = 50.0, .threads = 2}},
    };
    printf("%-12s %7s %8s %8s %10s %10s\n", "axes", "threads", "points", "s", "points/s",
           "us/point");
    for (size_t i = 0; i < sizeof grid / sizeof grid[0]; i++) {
        gm_sweep_summary best;
        gm_status status = time_sweep(plant, &grid[i].options, &best, error);
        if (status != GM_OK)
            return status;
        double points = (double)best.points;
        printf("%-12s %7d %8ld %8.3f %10.0f %10.2f\n", grid[i].name,
               grid[i].options.threads, best.points, best.elapsed, points / best.elapsed,
               1e6 * best.elapsed * grid[i].options.threads / points);
    }
    return GM_OK;
}

int main(int argc, char **argv)
{
    const char *path = argc > 1 ? argv[1] : GM_SOURCE_DIR "/examples/dct7.yaml";
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
        status = run(plant, &error);
    gm_builtin_destroy(plant);
    gm_gearset_destroy(gearset);
    gm_description_destroy(description);
    if (status != GM_OK)
        fprintf(stderr, "bench_sweep: %s\n", error.message);
    return status != GM_OK;
}
