/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Integrals of powers over the steps of a solver: over each step the quadratic through
 * its two ends and the end of the step before; after a jump the straight line. The error
 * of a step is of fourth order in its length, one above that of the solution.
 */
#ifndef ENERGY_H
#define ENERGY_H

#include "solve/gm_transient.h"

typedef struct gm_energy {
    int known;                    /* points of the history since the last jump, 0 to 2 */
    double t[2];                  /* [1]: the present, [0]: one step before */
    gm_transient_powers power[2]; /* there */
    gm_transient_energy sum;
} gm_energy;

/** Begin with nothing done. */
void gm_energy_start(gm_energy *energy, double t, const gm_transient_powers *now);

/** A step has ended at t. */
void gm_energy_step(gm_energy *energy, double t, const gm_transient_powers *now);

/** At the present time x has jumped or the powers have: work [J] was put in. */
void gm_energy_jump(gm_energy *energy, double work, const gm_transient_powers *after);

/** The powers have a kink at the present time. */
void gm_energy_kink(gm_energy *energy);

#endif
