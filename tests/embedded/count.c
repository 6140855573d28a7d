/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Instructions of one step of the reduced gearset in many situations, and a search for
 * the worst: what a scheduler must reserve. Counts are those of the emulated Cortex-M4F.
 *
 *   drive    a car drives through all gears with torque steps, shifts, a stop, a hill
 *   random   every input new at random now and then, also far beyond the map
 *   cold     one step from a random state with an empty cache, mutated towards the worst
 *
 * Prints for each fidelity and situation: steps, median, 99 %, largest, and for the
 * largest the inputs that caused it.
 */
#include "counter.h"
#include "gm_gearset.h"
#include "gm_tables.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 1 << 17, KEPT = 16 };

#define STEP GM_NUM(1e-3)

typedef struct tally {
    unsigned n, largest, count[MOST];
} tally;

static tally counts;
static uint32_t seed, overhead;

static uint32_t next(void)
{
    seed = seed * 1664525u + 1013904223u;
    return seed >> 8;
}

/* Uniform between low and high. */
static gm_real between(gm_real low, gm_real high)
{
    return low + (high - low) * (gm_real)next() / (gm_real)16777216;
}

static int one_of(int n)
{
    return (int)(next() % (unsigned)n);
}

static void note(unsigned n)
{
    counts.n++;
    counts.largest = n > counts.largest ? n : counts.largest;
    counts.count[n < MOST ? n : MOST - 1]++;
}

static unsigned at_share(double share)
{
    unsigned sum = 0;
    for (unsigned i = 0; i < MOST; i++) {
        sum += counts.count[i];
        if (sum >= share * counts.n) {
            return i;
        }
    }
    return MOST;
}

static void print_tally(const char *fidelity, const char *name)
{
    printf("%-6s %-8s %7u %7u %7u %7u\n", fidelity, name, counts.n, at_share(0.5),
           at_share(0.99), counts.largest);
    memset(&counts, 0, sizeof counts);
}

static gm_gearset begin(const gm_reduced_params *params, const gm_reduced_inputs *in,
                        gm_real w_o, const gm_real *w)
{
    gm_gearset g;
    gm_gearset_start start;
    gm_gearset_defaults(&gm_tables_map, &start);
    start.params = *params;
    start.w_o = w_o;
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        start.gear[p] = in->gear[p];
        start.w[p] = w[p];
    }
    (void)gm_gearset_init(&gm_tables_map, &start, &g);
    return g;
}

static unsigned counted_step(const gm_reduced_inputs *in, gm_gearset *g)
{
    gm_gearset_set(in, g);
    const uint32_t start = counter_start();
    (void)gm_gearset_step(&gm_tables_map, g, STEP);
    return (unsigned)(counter_since(start) - overhead);
}

/* ---- a car ---- */

static int gear_near(int p, int position)
{
    const gm_path *path = &gm_tables_map.path[p];
    return position < 0 ? 0 : path->gears[position % path->n_gears].number;
}

/* Brake, clutches and engine of a car, roughly: the output pulls at a body through a
 * damper, one path drives, the other idles, is preselected or synchronises. */
static void drive(const gm_reduced_params *params)
{
    gm_reduced_inputs in = {0};
    gm_real w[GM_MAX_PATHS] = {80, 90}, car = 0;
    gm_gearset g = begin(params, &in, 0, w);
    for (int k = 0; k < 60000; k++) {
        const int phase = k / 1500, active = phase & 1;
        const gm_real pedal = (phase / 4) % 5 == 4 ? -60 : (phase % 7 == 3 ? -15 : 120);
        for (int p = 0; p < gm_tables_map.n_paths; p++) {
            const int selected = p == active || k % 1500 > 700;
            in.gear[p] = gear_near(p, selected ? (phase / 2 + p) % 5 : -1);
            in.path_tau[p] = p == active && k % 1500 > 300 ? pedal : 0;
            if (g.state.path[p].mode == GM_PATH_NEUTRAL) {
                in.path_tau[p] = (80 - g.state.path[p].w) / 10;
            }
        }
        in.output_tau = (car - g.state.w_o) * 100;
        car += STEP * (-in.output_tau - (car > 0 ? 100 : car < 0 ? -100 : 0)) / 200;
        note(counted_step(&in, &g));
    }
}

/* ---- chaos ---- */

static gm_real any_torque(gm_real usual)
{
    const int kind = one_of(20);
    return kind == 0  ? between(-1000, 1000) * usual
           : kind < 4 ? 0
                      : between(-usual, usual);
}

static void shake(gm_reduced_inputs *in)
{
    for (int p = 0; p < gm_tables_map.n_paths; p++) {
        if (one_of(10) == 0) {
            in->path_tau[p] = any_torque(300);
            in->path_tau_rate[p] = one_of(3) == 0 ? any_torque(3e4f) : 0;
        }
        if (one_of(40) == 0) {
            in->gear[p] = one_of(10) - 1;
        }
    }
    if (one_of(10) == 0) {
        in->output_tau = any_torque(3000);
    }
}

static void chaos(const gm_reduced_params *params, int n)
{
    gm_reduced_inputs in = {0};
    gm_real w[GM_MAX_PATHS] = {0, 0};
    gm_gearset g = begin(params, &in, 0, w);
    for (int k = 0; k < n; k++) {
        if (k % 500 == 0) {
            w[0] = between(-600, 600);
            w[1] = between(-600, 600);
            memset(&in, 0, sizeof in);
            g = begin(params, &in, between(-80, 80), w);
        }
        shake(&in);
        note(counted_step(&in, &g));
    }
}

/* ---- search ---- */

/* One step: from a start in gear `from`, with everything else as it says. */
typedef struct situation {
    int from[GM_MAX_PATHS], to[GM_MAX_PATHS];
    gm_real w_o, w[GM_MAX_PATHS], twist[GM_MAX_PATHS], brake;
    gm_real tau_o, tau[GM_MAX_PATHS], rate[GM_MAX_PATHS], sync[GM_MAX_PATHS];
    unsigned cost;
} situation;

static unsigned cost_of(const gm_reduced_params *params, const situation *s)
{
    gm_reduced_inputs in = {.gear = {s->from[0], s->from[1]}};
    gm_gearset g = begin(params, &in, s->w_o, s->w);
    g.state.brake = s->brake;
    in.output_tau = s->tau_o;
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        if (params->fidelity == GM_LASH && g.state.path[p].mode == GM_PATH_ENGAGED) {
            g.state.path[p].twist = s->twist[p];
            g.state.path[p].w = s->w[p];
        }
        in.path_tau[p] = s->tau[p];
        in.path_tau_rate[p] = s->rate[p];
        in.gear[p] = s->to[p];
        g.params.sync_torque[p] = s->sync[p];
    }
    return counted_step(&in, &g);
}

static gm_real ratio_of(int p, int number)
{
    const int i = gm_reduced_find_gear(&gm_tables_map, p, number);
    return i < 0 ? 0 : gm_tables_map.path[p].gears[i].ratio;
}

static void invent(situation *s)
{
    s->w_o = one_of(4) == 0 ? 0 : between(-1, 1) * (one_of(2) ? 150 : 2);
    s->tau_o = any_torque(3000);
    s->brake = any_torque(200);
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        const int known = one_of(gm_tables_map.path[p].n_gears + 1) - 1;
        s->to[p] = one_of(3) ? gear_near(p, known) : one_of(10) - 1;
        s->from[p] = one_of(2) ? s->to[p] : gear_near(p, one_of(5) - 1);
        s->w[p] = one_of(4) == 0   ? between(-600, 600)
                  : one_of(3) == 0 ? 0
                                   : ratio_of(p, s->to[p]) * s->w_o + between(-2, 2);
        s->twist[p] = between(-1, 1) * GM_NUM(0.03);
        s->tau[p] = any_torque(300);
        s->rate[p] = one_of(3) == 0 ? any_torque(3e4f) : 0;
        s->sync[p] = one_of(4) == 0 ? GM_NUM(1e30) : between(1, 200);
    }
}

/* Some numbers of *s a little or completely other. */
static void mutate(situation *s)
{
    situation other;
    invent(&other);
    gm_real *const number[] = {&s->w_o,      &s->w[0],    &s->w[1],    &s->twist[0],
                               &s->twist[1], &s->brake,   &s->tau_o,   &s->tau[0],
                               &s->tau[1],   &s->rate[0], &s->rate[1], &s->sync[0],
                               &s->sync[1]};
    gm_real *const fresh[] = {
        &other.w_o,     &other.w[0],    &other.w[1],   &other.twist[0], &other.twist[1],
        &other.brake,   &other.tau_o,   &other.tau[0], &other.tau[1],   &other.rate[0],
        &other.rate[1], &other.sync[0], &other.sync[1]};
    for (int changes = 1 + one_of(3); changes > 0; changes--) {
        const int i = one_of(16);
        if (i >= 13) {
            const int p = one_of(2);
            s->from[p] = other.from[p];
            s->to[p] = one_of(2) ? other.to[p] : s->to[p];
        } else if (one_of(2)) {
            *number[i] = *fresh[i];
        } else {
            *number[i] *= 1 + between(-1, 1) * (one_of(2) ? GM_NUM(0.3) : GM_NUM(0.01));
        }
    }
    for (int p = 0; p < GM_MAX_PATHS; p++) { /* a capacity that a cone has, or none */
        s->sync[p] = s->sync[p] > 500 ? GM_NUM(1e30) : s->sync[p];
    }
}

static void keep(situation kept[KEPT], const situation *s)
{
    int least = 0;
    for (int i = 1; i < KEPT; i++) {
        least = kept[i].cost < kept[least].cost ? i : least;
    }
    if (s->cost > kept[least].cost) {
        kept[least] = *s;
    }
}

static void print_situation(const situation *s)
{
    printf(
        "  %u: gears %d %d -> %d %d, w %.9g %.9g out %.9g, twist %.9g %.9g, brake %.9g\n"
        "    tau %.9g %.9g out %.9g, rates %.9g %.9g, sync %.9g %.9g\n",
        s->cost, s->from[0], s->from[1], s->to[0], s->to[1], (double)s->w[0],
        (double)s->w[1], (double)s->w_o, (double)s->twist[0], (double)s->twist[1],
        (double)s->brake, (double)s->tau[0], (double)s->tau[1], (double)s->tau_o,
        (double)s->rate[0], (double)s->rate[1], (double)s->sync[0], (double)s->sync[1]);
}

static situation search(const gm_reduced_params *params, int n)
{
    static situation kept[KEPT];
    situation worst;
    memset(kept, 0, sizeof kept);
    for (int k = 0; k < n; k++) {
        situation s;
        if (k < n / 4 || one_of(8) == 0) {
            invent(&s);
        } else {
            s = kept[one_of(KEPT)];
            mutate(&s);
        }
        s.cost = cost_of(params, &s);
        note(s.cost);
        keep(kept, &s);
    }
    worst = kept[0];
    for (int i = 1; i < KEPT; i++) {
        worst = kept[i].cost > worst.cost ? kept[i] : worst;
    }
    return worst;
}

int main(int argc, char **argv)
{
    static const char *const name[] = {"", "rigid", "lash"};
    const int n = argc > 1 ? atoi(argv[1]) : 100000;
    const uint32_t start = counter_start();
    overhead = counter_since(start);
    printf("%-6s %-8s %7s %7s %7s %7s\n", "", "", "steps", "median", "99 %", "largest");
    for (int fidelity = GM_RIGID; fidelity <= GM_LASH; fidelity++) {
        gm_reduced_params params;
        seed = 1;
        gm_reduced_default_params(&gm_tables_map, &params);
        params.fidelity = fidelity;
        drive(&params);
        print_tally(name[fidelity], "drive");
        chaos(&params, n);
        print_tally(name[fidelity], "random");
        const situation worst = search(&params, n);
        print_tally(name[fidelity], "cold");
        print_situation(&worst);
    }
    return 0;
}
