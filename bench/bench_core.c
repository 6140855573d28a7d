/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Time of the core: table lookups and steps of the reduced gearset, on a map of the size
 * that a sweep makes (7 gears, 40 x 14 nodes). Medians over blocks, in nanoseconds.
 * "Chained": each query waits for the result of the last, as in a simulation.
 *
 * Usage: bench_core
 */
#include "core/gm_reduced.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { N_W = 40, N_T = 14, GEARS = 4, BLOCKS = 301, CALLS = 1000, N_CONFIGURATIONS = 25 };

static double w_p[N_W], w_o[N_W], torque[N_T], relative[N_T];
static double parasitic[N_W], drag[2][N_W][N_W], reaction[2][N_W][N_W];
static double load[N_W][N_T], jump[N_W], coupling[N_T], both[4][N_T][N_T];
static gm_gear gear[2][GEARS];
static gm_drag_line line[2][GEARS];
static gm_configuration configuration[N_CONFIGURATIONS];
static gm_reduced_map map;

static double now_ns(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *v, int n)
{
    qsort(v, (size_t)n, sizeof *v, compare);
    return v[n / 2];
}

static void fill_tables(void)
{
    for (int i = 0; i < N_W; i++) {
        const double x = (double)i / (N_W - 1);
        w_p[i] = 700 * x * x;
        w_o[i] = 170 * x * x;
        parasitic[i] = 6 + 0.05 * w_o[i] + 2e-4 * w_o[i] * w_o[i];
        jump[i] = 0.04 + 1e-4 * w_o[i];
    }
    for (int j = 0; j < N_T; j++) {
        const double y = 2.0 * j / (N_T - 1) - 1;
        torque[j] = 260 * y;
        relative[j] = 900 * y * fabs(y);
        coupling[j] = 2e-4 * relative[j];
    }
    for (int i = 0; i < N_W; i++) {
        for (int j = 0; j < N_T; j++) {
            load[i][j] = (0.015 + 1e-5 * w_p[i]) * fabs(torque[j]);
        }
        for (int j = 0; j < N_W; j++) {
            for (int dir = 0; dir < 2; dir++) {
                const double sign = dir == GM_FORWARD ? 1 : -1;
                drag[dir][i][j] = sign * (0.1 + 5e-4 * w_p[i]) + 1e-5 * w_p[i] * w_o[j];
                reaction[dir][i][j] = -1e-5 * sign * w_p[i] * w_o[j];
            }
        }
    }
    for (int i = 0; i < 4 * N_T * N_T; i++) {
        (&both[0][0][0])[i] = 1e-4 * fabs(torque[i / N_T % N_T] * torque[i % N_T]);
    }
}

static void fill_path(int p, const int *numbers, const double *ratios)
{
    gm_path *path = &map.path[p];
    path->inertia = 0.01;
    path->sync_torque = 30;
    path->n_gears = path->n_lines = GEARS;
    path->gears = gear[p];
    path->lines = line[p];
    for (int g = 0; g < GEARS; g++) {
        gear[p][g].number = numbers[g];
        gear[p][g].ratio = line[p][g].ratio = ratios[g];
        for (int dir = 0; dir < 2; dir++) {
            gear[p][g].load_loss[dir] =
                (gm_table2){{N_W, w_p}, {N_T, torque}, load[0], 0};
            line[p][g].jump[dir] = (gm_table1){{N_W, w_o}, jump, 0};
        }
    }
    for (int i = 0; i < 4; i++) {
        path->drag[i / 2][i % 2] = (gm_table2){{N_W, w_p}, {N_W, w_o}, drag[i / 2][0], 0};
        path->reaction[i / 2][i % 2] =
            (gm_table2){{N_W, w_p}, {N_W, w_o}, reaction[i / 2][0], 0};
    }
}

static void make_map(void)
{
    static const int numbers[2][GEARS] = {{1, 3, 5, 7}, {-1, 2, 4, 6}};
    static const double ratios[2][GEARS] = {{16, 6.9, 3.6, 2.4}, {-14, 10.1, 4.9, 2.9}};
    static const double coarse[4] = {0, 40, 90, 170};
    fill_tables();
    for (int i = 0; i < N_CONFIGURATIONS; i++) {
        gm_configuration *c = &configuration[i];
        c->gear[0] = i / 5 - 1;
        c->gear[1] = i % 5 - 1;
        for (int dir = 0; dir < 2; dir++) {
            c->parasitic[dir] = (gm_table1){{N_W, w_o}, parasitic, 0};
            c->both_loaded[dir] =
                (gm_table3){{4, coarse}, {N_T, torque}, {N_T, torque}, both[0][0]};
        }
    }
    map.n_paths = 2;
    fill_path(0, numbers[0], ratios[0]);
    fill_path(1, numbers[1], ratios[1]);
    map.n_configurations = N_CONFIGURATIONS;
    map.configurations = configuration;
    map.coupling = (gm_table1){{N_T, relative}, coupling, 0};
    map.inertia_output = 0.5;
}

/* Value and gradient, ns a query. stride: how far the point moves, in parts of the range.
 */
static double time_lookup(double stride, int monotone)
{
    static double blocks[BLOCKS];
    gm_table2 t = gear[0][0].load_loss[0];
    gm_cell2 cell = {0};
    double x = 0.1, sum = 0;
    t.monotone = monotone;
    for (int b = 0; b < BLOCKS; b++) {
        const double start = now_ns();
        for (int i = 0; i < CALLS; i++) {
            const gm_value2 v = gm_table2_at(&t, 1, &cell, 700 * x, 520 * (x - 0.5));
            x += stride + 1e-12 * v.value; /* waits for the value */
            x = x > 1 ? x - 1 : x;
            sum += v.dx + v.dy;
        }
        blocks[b] = (now_ns() - start) / CALLS;
    }
    return sum > -1e300 ? median(blocks, BLOCKS) : 0;
}

/* A load near the torque of path 0 holds the speed near its start, ns a step. */
static double time_step(int g0, int g1, double speed, double h)
{
    static double blocks[BLOCKS];
    gm_reduced_params params;
    gm_reduced_inputs in = {0};
    gm_reduced_state s;
    const double rest[2] = {120, 120};
    gm_reduced_default_params(&map, &params);
    in.gear[0] = g0;
    in.gear[1] = g1;
    in.oil_temperature = 353.15;
    gm_reduced_start(&map, &in, speed, rest, &s);
    const double r = speed != 0 ? s.path[0].w / speed : 0;
    for (int b = 0; b < BLOCKS; b++) {
        const double start = now_ns();
        for (int i = 0; i < CALLS; i++) {
            in.path_tau[0] = g0 ? 75 + 0.01 * (i & 63) : 0.02 * (120 - s.path[0].w);
            in.path_tau[1] = g1 ? 0 : 0.02 * (120 - s.path[1].w);
            in.output_tau = (g0 ? -75 * r : 0) + 20 * (speed - s.w_o);
            if (gm_reduced_step(&map, &params, &in, h, &s) & GM_FLAG_NOT_FINITE) {
                return -1;
            }
        }
        blocks[b] = (now_ns() - start) / CALLS;
    }
    return median(blocks, BLOCKS);
}

int main(void)
{
    make_map();
    printf("state of an instance        %6zu bytes\n", sizeof(gm_reduced_state));
    printf("lookup 2-D, same cell       %6.1f ns\n", time_lookup(1e-7, 0));
    printf("lookup 2-D, another cell    %6.1f ns\n", time_lookup(0.37, 0));
    printf("monotone, same cell         %6.1f ns\n", time_lookup(1e-7, 1));
    printf("monotone, another cell      %6.1f ns\n", time_lookup(0.37, 1));
    printf("step, 3rd gear, neutral     %6.1f ns\n", time_step(3, 0, 62, 1e-3));
    printf("step, 3rd, 4th preselected  %6.1f ns\n", time_step(3, 4, 62, 1e-3));
    printf("step, both paths neutral    %6.1f ns\n", time_step(0, 0, 62, 1e-3));
    printf("step, held at standstill    %6.1f ns\n", time_step(0, 2, 0, 1e-3));
    return 0;
}
