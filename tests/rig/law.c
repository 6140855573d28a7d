/* SPDX-License-Identifier: BSD-2-Clause */
#include "law.h"

#include <math.h>
#include <string.h>

enum { SPEED = 0, TWIST = 3, SHAFT = 5 }; /* where the states begin */
static const double round_over = 0.01, largest_step = 2e-4;

law law_of(law_variant variant)
{
    law l = {.n_paths = 1,
             .path = {{.ratio = {-12.0, 14.0, 8.25, 4.125, 2.5},
                       .share = 0.012,
                       .inertia = 0.012,
                       .n0 = 0.1,
                       .n1 = 0.0008,
                       .n2 = 0.0004,
                       .r_i = 6.0},
                      {.ratio = {0.0, 0.0, 9.0, 0.0, 3.0},
                       .share = 0.010,
                       .inertia = 0.010,
                       .n0 = 0.08,
                       .n1 = 0.0006,
                       .n2 = 0.0003,
                       .r_i = -5.0}},
             .inertia_output = 0.3,
             .p0 = 2.0,
             .p1 = 0.02,
             .bend = 0.3};
    if (variant == LAW_ELASTIC) {
        l.stiffness = 6000.0;
        l.damping = 3.0;
        l.lash = 0.02;
    }
    if (variant == LAW_TWO_PATHS) {
        l.n_paths = 2;
        l.coupling = 0.0005;
        l.path[0].ratio[2] = l.path[0].ratio[4] = 0.0;
    }
    l.speed_in[1] = variant == LAW_SPEED_INPUT || variant == LAW_SPEED_BOTH;
    l.speed_in[0] = variant == LAW_SPEED_OUTPUT || variant == LAW_SPEED_BOTH;
    l.shaft_stiffness = 8000.0;
    l.shaft_damping[0] = 60.0;
    l.shaft_damping[1] = l.shaft_damping[2] = 10.0;
    return l;
}

double law_ratio(const law *l, int p, int gear)
{
    if (gear == 0 || gear < -1 || gear >= LAW_GEARS)
        return 0.0;
    return l->path[p].ratio[gear < 0 ? 0 : gear];
}

double law_warm(double temperature)
{
    return exp(-0.02 * (temperature - 353.15));
}

double law_parasitic(const law *l, const int *gear, double temperature, double w_o)
{
    double sum = law_warm(temperature) * (l->p0 + l->p1 * w_o);
    for (int p = 0; p < l->n_paths; p++)
        if (gear[p] == 0)
            sum += l->path[p].r_i * l->path[p].r_i * l->path[p].n2 * w_o;
    return sum;
}

double law_load(const law *l, int p, int gear, double w, double torque)
{
    double share = l->path[p].share * (1.0 + 0.1 * gear);
    double bend = 1.0 + l->bend / (1.0 + fabs(w) / 50.0);
    return share * bend * (torque < 0.0 ? 0.8 : 1.0) * fabs(torque);
}

double law_drag(const law *l, int p, double w_n, double sign, double w_o)
{
    const law_path *path = &l->path[p];
    return sign * path->n0 + path->n1 * w_n + path->n2 * (w_n - path->r_i * w_o);
}

double law_reaction(const law *l, int p, double w_n)
{
    return -l->path[p].r_i * l->path[p].n2 * w_n;
}

/* ---- motion ---- */

void law_start(law_run *run, law_variant variant)
{
    memset(run, 0, sizeof *run);
    run->of = law_of(variant);
    run->temperature = 353.15;
}

static double side(double w)
{
    return tanh(w / round_over);
}

/* Torque that an elastic path transmits. */
static double spring(const law *l, double twist, double rate)
{
    double half = 0.5 * l->lash, depth = fabs(twist) - half;
    if (depth <= 0.0)
        return 0.0;
    double along = twist > 0.0 ? 1.0 : -1.0;
    double force = l->stiffness * depth + along * l->damping * rate;
    return along * fmax(0.0, force);
}

double law_speed(const law_run *run, const double *x, int flange)
{
    return run->of.speed_in[flange] ? run->input[flange] : x[SPEED + flange];
}

double law_torque(const law_run *run, const double *x, int flange)
{
    const law *l = &run->of;
    if (!l->speed_in[flange])
        return run->input[flange];
    return l->shaft_stiffness * x[SHAFT + flange] +
           l->shaft_damping[flange] * (run->input[flange] - x[SPEED + flange]);
}

/* What acts on the bodies beside the engaged paths, positive. */
static void outside(const law_run *run, const double *x, double torque[LAW_FLANGES])
{
    const law *l = &run->of;
    double w_o = x[SPEED];
    for (int f = 0; f <= l->n_paths; f++)
        torque[f] = law_torque(run, x, f);
    for (int p = 0; p < l->n_paths; p++) {
        double w = x[SPEED + 1 + p];
        if (run->gear[p] != 0)
            continue;
        double between = l->path[p].n2 * (w - l->path[p].r_i * w_o);
        torque[1 + p] -= l->path[p].n0 * side(w) + l->path[p].n1 * w + between;
        torque[0] += l->path[p].r_i * between;
    }
    if (l->n_paths == 2) {
        double drag = l->coupling * (x[SPEED + 2] - x[SPEED + 1]);
        torque[1] += drag;
        torque[2] -= drag;
    }
    int none[LAW_PATHS] = {1, 1};
    torque[0] -= side(w_o) * law_parasitic(l, none, run->temperature, fabs(w_o));
}

static double lost_at_output(const law_run *run, int p, double ratio, double w_o,
                             double transmitted)
{
    double w = ratio * w_o, along = side(w);
    double load = law_load(&run->of, p, run->gear[p], w, transmitted * along);
    return along * ratio * load;
}

/* The loss depends on the torque that is transmitted, that on the acceleration: found by
   passes, each of which gains two digits. */
static void rigid(const law_run *run, const double *x, const double *torque, double *dx)
{
    const law *l = &run->of;
    double inertia = l->inertia_output, a = 0.0;
    for (int p = 0; p < l->n_paths; p++) {
        double ratio = law_ratio(l, p, run->gear[p]);
        inertia += ratio * ratio * l->path[p].inertia;
    }
    for (int pass = 0; pass < 12; pass++) {
        double sum = torque[0];
        for (int p = 0; p < l->n_paths; p++) {
            double ratio = law_ratio(l, p, run->gear[p]);
            double transmitted = torque[1 + p] - l->path[p].inertia * ratio * a;
            if (run->gear[p] != 0)
                sum += ratio * torque[1 + p] -
                       lost_at_output(run, p, ratio, x[SPEED], transmitted);
        }
        a = sum / inertia;
    }
    dx[SPEED] = a;
    for (int p = 0; p < l->n_paths; p++)
        if (run->gear[p] != 0)
            dx[SPEED + 1 + p] = law_ratio(l, p, run->gear[p]) * a;
}

static void elastic(const law_run *run, const double *x, const double *torque, double *dx)
{
    const law *l = &run->of;
    double sum = torque[0];
    for (int p = 0; p < l->n_paths; p++) {
        double ratio = law_ratio(l, p, run->gear[p]);
        if (run->gear[p] == 0)
            continue;
        double rate = x[SPEED + 1 + p] - ratio * x[SPEED];
        double through = spring(l, x[TWIST + p], rate);
        dx[TWIST + p] = rate;
        dx[SPEED + 1 + p] = (torque[1 + p] - through) / l->path[p].inertia;
        sum += ratio * through - lost_at_output(run, p, ratio, x[SPEED], through);
    }
    dx[SPEED] = sum / l->inertia_output;
}

void law_rates(const law_run *run, const double *x, double *dx)
{
    const law *l = &run->of;
    double torque[LAW_FLANGES] = {0.0};
    memset(dx, 0, LAW_STATES * sizeof *dx);
    outside(run, x, torque);
    if (l->stiffness > 0.0)
        elastic(run, x, torque, dx);
    else
        rigid(run, x, torque, dx);
    for (int p = 0; p < l->n_paths; p++)
        if (run->gear[p] == 0)
            dx[SPEED + 1 + p] = torque[1 + p] / l->path[p].inertia;
    for (int f = 0; f <= l->n_paths; f++)
        if (l->speed_in[f])
            dx[SHAFT + f] = run->input[f] - x[SPEED + f];
}

static void one_step(law_run *run, double h)
{
    double k[4][LAW_STATES], x[LAW_STATES];
    static const double at[] = {0.0, 0.5, 0.5, 1.0}, weight[] = {1.0, 2.0, 2.0, 1.0};
    for (int s = 0; s < 4; s++) {
        for (int i = 0; i < LAW_STATES; i++)
            x[i] = run->x[i] + (s > 0 ? at[s] * h * k[s - 1][i] : 0.0);
        law_rates(run, x, k[s]);
    }
    for (int i = 0; i < LAW_STATES; i++)
        for (int s = 0; s < 4; s++)
            run->x[i] += h / 6.0 * weight[s] * k[s][i];
}

void law_step(law_run *run, double h)
{
    int n = (int)ceil(h / largest_step - 1e-9);
    for (int i = 0; i < n; i++)
        one_step(run, h / n);
}
