/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A detailed gearset whose reduction is known: two paths of three gears, one of them
 * reverse, with closed forms for P, D, X, N, R, the jumps and C. Its balance is that of
 * core/gm_reduced.h at a = 0, dressed as a nonlinear system, so a sweep must find the
 * closed forms again, at every node, to the solver's tolerance.
 */
#ifndef SYNTHETIC_H
#define SYNTHETIC_H

#include "core/gm_reduced.h"
#include "plant/gm_plant.h"

#define SYNTHETIC_SPEED_MAX 500.0
#define SYNTHETIC_TORQUE_MAX 40.0
#define SYNTHETIC_LINES 4

typedef struct synthetic {
    double load_factor;      /* on D; 1 */
    double unsolvable_above; /* output speed from which no balance exists; HUGE_VAL */
    double slip;             /* engaged paths turn by this factor too fast; 1 */
    long pause;              /* ns for every point: a slow gearset; 0 */
    gm_plant_gear gears[2][3];
    gm_plant plant; /* points back here */
} synthetic;

void synthetic_init(synthetic *s, int n_paths);

double synthetic_ratio(int p, int number);
double synthetic_inertia(int flange);

/** How path p gives way in a gear. */
gm_compliance synthetic_compliance(int p, int number);
double synthetic_parasitic(const int *gear, int backward, double w);
double synthetic_load(const synthetic *s, int p, int number, int backward, double w,
                      double torque);
double synthetic_both(const int *gear, int backward, double w, const double *torque);
double synthetic_coupling(double relative_speed);
/* Drag line i of path p: its ratio, and the jump of N on it. */
double synthetic_line(int p, int i);
double synthetic_jump(int p, int i, int backward, double w);
/* Without the steps on the lines; sign: of w_n, for its limit at zero. */
double synthetic_drag(int p, double w_n, double sign, double w_o);
double synthetic_reaction(int p, double w_n, double w_o);

#endif
