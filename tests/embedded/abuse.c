/* SPDX-License-Identifier: BSD-2-Clause
 *
 * abuse STEPS SEED: random inputs and step lengths, among them NaN, infinities and the
 * largest and smallest numbers, for both fidelities. Whatever comes in, the state stays
 * finite; what is not a number is flagged and moves nothing. Built with a sanitizer it
 * also tells of undefined behaviour.
 */
#include "gm_gearset.h"
#include "gm_tables.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint32_t seed;

static uint32_t next(void)
{
    seed = seed * 1664525u + 1013904223u;
    return seed >> 8;
}

static gm_real between(gm_real low, gm_real high)
{
    return low + (high - low) * (gm_real)next() / (gm_real)16777216;
}

/* Now and then a number that nobody expects. */
static gm_real any(gm_real usual)
{
    static const gm_real odd[] = {
        (gm_real)NAN,  (gm_real)INFINITY, -(gm_real)INFINITY, FLT_MAX,
        -FLT_MAX,      FLT_MIN,           -FLT_MIN / 4,       0,
        (gm_real)1e18, (gm_real)-1e19,    (gm_real)1e30};
    return next() % 100 == 0 ? odd[next() % (sizeof odd / sizeof *odd)]
                             : between(-usual, usual);
}

static int is_number(gm_real x)
{
    return x - x == 0;
}

static int is_valid(const gm_gearset *g)
{
    int valid = is_number(g->state.w_o) && is_number(g->phi_o.high) &&
                is_number(g->work.high) && is_number(g->loss_energy.high) &&
                is_number(g->state.brake);
    for (int p = 0; p < gm_tables_map.n_paths; p++) {
        const gm_path_state *path = &g->state.path[p];
        valid = valid && is_number(path->w) && is_number(path->twist) &&
                is_number(g->phi[p].high) && path->mode >= 0 && path->mode <= 2 &&
                path->gear >= -1 && path->gear < gm_tables_map.path[p].n_gears;
    }
    return valid;
}

static int same_motion(const gm_gearset *a, const gm_gearset *b)
{
    int same = a->state.w_o == b->state.w_o && a->work.high == b->work.high &&
               a->loss_energy.high == b->loss_energy.high;
    for (int p = 0; p < gm_tables_map.n_paths; p++) {
        const gm_path_state *x = &a->state.path[p], *y = &b->state.path[p];
        same = same && x->w == y->w && x->twist == y->twist && x->mode == y->mode &&
               x->gear == y->gear && a->phi[p].high == b->phi[p].high;
    }
    return same;
}

static void start_anew(int fidelity, gm_gearset *g)
{
    gm_gearset_start start;
    gm_gearset_defaults(&gm_tables_map, &start);
    start.params.fidelity = fidelity;
    start.params.loss_scale = any(2);
    start.w_o = any(100);
    for (int p = 0; p < gm_tables_map.n_paths; p++) {
        start.gear[p] = (int)(next() % 11) - 2;
        start.w[p] = any(700);
        start.params.sync_torque[p] = next() % 5 ? between(0, 300) : any(1);
    }
    (void)gm_gearset_init(&gm_tables_map, &start, g);
}

static void shake(gm_reduced_inputs *in)
{
    in->output_tau = any(3000);
    in->output_tau_rate = next() % 4 ? 0 : any(10000);
    in->oil_temperature = next() % 50 ? 350 : any(400);
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        in->path_tau[p] = next() % 4 ? any(300) : 0;
        in->path_tau_rate[p] = next() % 4 ? 0 : any(10000);
        in->gear[p] = next() % 200 ? (int)(next() % 9) - 1 : (int)(next() << 8);
    }
}

static int inputs_are_numbers(const gm_reduced_inputs *in, gm_real h)
{
    int numbers = h > 0 && h <= 1 && is_number(in->output_tau) &&
                  is_number(in->output_tau_rate) && is_number(in->oil_temperature);
    for (int p = 0; p < gm_tables_map.n_paths; p++) {
        numbers =
            numbers && is_number(in->path_tau[p]) && is_number(in->path_tau_rate[p]);
    }
    return numbers;
}

/* 0, or what was wrong. */
static const char *one_step(const gm_reduced_inputs *in, gm_real h, gm_gearset *g)
{
    const gm_gearset before = *g;
    gm_gearset_outputs outputs;
    gm_gearset_set(in, g);
    const int refused = gm_gearset_step(&gm_tables_map, g, h) & GM_FLAG_NOT_FINITE;
    if (!is_valid(g)) {
        return "the state is not finite";
    }
    if (!inputs_are_numbers(in, h) && !refused) {
        return "what is not a number was not flagged";
    }
    if (refused && !same_motion(&before, g)) {
        return "a refused step moved something";
    }
    if (!(gm_gearset_get(&gm_tables_map, g, &outputs) & GM_FLAG_NOT_FINITE) &&
        !(is_number(outputs.at.loss_power) && is_number(outputs.power))) {
        return "an output is not finite";
    }
    return 0;
}

int main(int argc, char **argv)
{
    const long n = argc > 1 ? atol(argv[1]) : 100000;
    gm_gearset g;
    gm_reduced_inputs in;
    long refused = 0;
    seed = argc > 2 ? (uint32_t)atol(argv[2]) : 1;
    memset(&in, 0, sizeof in);
    for (long k = 0; k < n; k++) {
        const gm_real h = next() % 20 ? GM_STEP : any(1);
        if (k % 200 == 0) {
            start_anew(k % 400 ? GM_LASH : GM_RIGID, &g);
        }
        if (next() % 8 == 0) {
            shake(&in);
        }
        const char *wrong = one_step(&in, h, &g);
        refused += (g.flags & GM_FLAG_NOT_FINITE) != 0;
        if (wrong) {
            printf("step %ld: %s\n", k, wrong);
            return 1;
        }
    }
    printf("%ld steps, %ld refused\n", n, refused);
    return 0;
}
