/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Small plants with motions known in closed form, behind the interface that the detailed
 * gearset has. Each is a spring, a contact or a friction between a body and the ground;
 * flange 0 is the body, flange 1 (where there is one) a second body on the other side.
 */
#ifndef TOY_DYNAMICS_H
#define TOY_DYNAMICS_H

#include "plant/gm_dynamics.h"

typedef enum toy_kind {
    TOY_OSCILLATOR, /* two bodies, spring and damper between them, friction to ground */
    TOY_BALL,       /* falls, bounces off the ground with restitution */
    TOY_STICK,      /* Coulomb friction with stiction on one body */
    TOY_CLUTCH,     /* two bodies; gear 1 joins them at once: an impulse */
    TOY_NAN,        /* the rate is not a number after it has turned by 1 rad */
    TOY_RESTLESS,   /* changes its mode at every call */
    TOY_GIVES_UP    /* fails for good after it has turned by 1 rad */
} toy_kind;

typedef struct toy {
    toy_kind kind;
    double inertia[2];               /* kg.m2 */
    double stiffness, damping, drag; /* between the bodies; of body 0 to the ground */
    double hold, slide;              /* friction, N.m */
    double gravity, restitution;     /* torque on the ball, N.m; speed kept */
    int no_jacobian;
} toy;

/** Dynamics over a toy, which must outlive it. */
gm_dynamics toy_dynamics(const toy *t);

#endif
