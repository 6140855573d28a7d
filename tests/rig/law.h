/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Small gearsets in motion whose losses, inertias and ratios are known in closed form:
 * what experiments on a simulated model must find again. Plain C99 without libraries, so
 * that FMUs, plug-ins and tests share it. SI; flange 0 is the output, 1 + p is path p.
 *
 *   path p in gear g, transmitted torque t, speed w of the path:
 *     D = share_g (1 + bend / (1 + |w| / 50)) side |t|,   side 1 driving, 0.8 driven
 *   output:        P = warm (p0 + p1 |w_o|) + sum over paths in neutral of i_q |w_o|
 *   path neutral:  N = n0 sgn(w) + n1 w + n2 (w - r_i w_o), the last between path and
 *                  output; so R = -r_i n2 w and i_q = r_i^2 n2
 *   two paths:     C = c (w_1 - w_0) on path 0, the opposite on path 1
 *   temperature:   warm = exp(-0.02 (T - 353.15 K))
 *
 * A path is rigid, or a spring with damper and backlash stands between it and the output.
 * A flange that takes speed drives its inertia through a spring. Coulomb friction is
 * rounded as tanh(w / 0.01 rad/s).
 */
#ifndef LAW_H
#define LAW_H

enum { LAW_PATHS = 2, LAW_FLANGES = 3, LAW_GEARS = 8, LAW_STATES = 8 };

typedef struct law_path {
    double ratio[LAW_GEARS]; /* by gear number; [0] of reverse, 0: no such gear */
    double share;            /* of gear number g: share * (1 + 0.1 g) */
    double inertia;
    double n0, n1, n2, r_i;
} law_path;

typedef struct law {
    int n_paths;
    law_path path[LAW_PATHS];
    double inertia_output;
    double p0, p1, bend, coupling;
    double stiffness, damping, lash; /* of engaged paths; 0: rigid */
    int speed_in[LAW_FLANGES];
    double shaft_stiffness; /* of flanges that take speed */
    double shaft_damping[LAW_FLANGES];
} law;

/** The variants of the tests. */
typedef enum law_variant {
    LAW_RIGID,
    LAW_ELASTIC,
    LAW_TWO_PATHS,
    LAW_SPEED_INPUT,  /* the path takes speed, the output torque */
    LAW_SPEED_OUTPUT, /* the other way round */
    LAW_SPEED_BOTH
} law_variant;

law law_of(law_variant variant);

typedef struct law_run {
    law of;
    int gear[LAW_PATHS];
    double input[LAW_FLANGES]; /* torque or speed */
    double temperature;        /* K */
    /* w of the flanges, twist of the paths, twist of the flanges' shafts */
    double x[LAW_STATES];
} law_run;

void law_start(law_run *run, law_variant variant);
/** dx/dt at x for the run's gears and inputs. */
void law_rates(const law_run *run, const double *x, double *dx);
/** Go on by h with steps of at most 2e-4 s (fourth order). */
void law_step(law_run *run, double h);
/** Speed and torque seen at a flange. */
double law_speed(const law_run *run, const double *x, int flange);
double law_torque(const law_run *run, const double *x, int flange);

/* ---- the closed forms ---- */
double law_ratio(const law *l, int p, int gear);
double law_warm(double temperature);
/** P at |w_o| for these gears. */
double law_parasitic(const law *l, const int *gear, double temperature, double w_o);
double law_load(const law *l, int p, int gear, double w, double torque);
double law_drag(const law *l, int p, double w_n, double sign, double w_o);
double law_reaction(const law *l, int p, double w_n);

#endif
