/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A gearset whose every answer is known: one path that is always engaged, an input and an
 * output inertia, a spring with a damper between them and viscous drag at the output.
 * States: input speed, output speed, twist at the input.
 */
#ifndef ELASTIC_GEARSET_H
#define ELASTIC_GEARSET_H

#include "plant/gm_dynamics.h"

typedef struct elastic_gearset {
    double ratio, inertia_in, inertia_out, stiffness, damping, drag;
    int with_jacobian;
} elastic_gearset;

/** *gearset outlives the dynamics. */
gm_dynamics elastic_gearset_dynamics(const elastic_gearset *gearset);

#endif
