/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The force of an elastic element over its deflection x and the rate v of it: flanks with
 * backlash on both sides, or a plain spring (contact.c).
 */
#ifndef CONTACT_H
#define CONTACT_H

#include "model/gm_description.h"

/** Along a line: m, N; about an axis: rad, N.m. */
typedef struct gm_contact_law {
    gm_contact_model model;
    double stiffness; /* in full contact, > 0 */
    double damping;   /* in contact, >= 0 */
    double gap;       /* half of the backlash, >= 0 */
    double entry;     /* film: depth of soft entry, > 0 */
    double film;      /* film: damping in the gap over that in contact, 0 to 1 */
} gm_contact_law;

typedef struct gm_contact_force {
    double value;  /* against x: F(x, v) */
    double d_x;    /* dF/dx */
    double d_v;    /* dF/dv >= 0 */
    double spring; /* dU/dx: F v - spring v >= 0 is dissipated */
} gm_contact_force;

/** Force at deflection x and rate v, any finite values. */
gm_contact_force gm_contact_force_at(const gm_contact_law *law, double x, double v);

/** Elastic energy U(x) >= 0, zero in the gap [J]. */
double gm_contact_energy(const gm_contact_law *law, double x);

#endif
