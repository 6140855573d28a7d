/* SPDX-License-Identifier: BSD-2-Clause */
#include "solve/energy.h"

#include <math.h>
#include <string.h>

void gm_energy_start(gm_energy *energy, double t, const gm_transient_powers *now)
{
    memset(energy, 0, sizeof *energy);
    energy->known = 1;
    energy->t[1] = t;
    energy->power[1] = *now;
    energy->sum.stored_start = energy->sum.stored = now->stored;
}

/* Steps h_1 and h_2 with the values p_0, p_1, p_2 at their ends; the integral over the
 * second. bend is the second divided difference. */
typedef struct step_pair {
    double h_1, h_2; /* h_1 0: there is no step before */
} step_pair;

static double integral(const step_pair *s, double p_0, double p_1, double p_2)
{
    double line = 0.5 * s->h_2 * (p_1 + p_2);
    if (s->h_1 <= 0.0)
        return line;
    double bend = ((p_2 - p_1) / s->h_2 - (p_1 - p_0) / s->h_1) / (s->h_1 + s->h_2);
    return line - bend * s->h_2 * s->h_2 * s->h_2 / 6.0;
}

void gm_energy_step(gm_energy *energy, double t, const gm_transient_powers *now)
{
    const gm_transient_powers *a = &energy->power[0], *b = &energy->power[1];
    const step_pair s = {energy->known > 1 ? energy->t[1] - energy->t[0] : 0.0,
                         t - energy->t[1]};
    gm_transient_energy *sum = &energy->sum;
    sum->stored = now->stored;
    if (!(s.h_2 > 0.0))
        return;
    sum->work += integral(&s, a->in, b->in, now->in);
    sum->through += integral(&s, a->through, b->through, now->through);
    sum->dissipated += integral(&s, a->loss, b->loss, now->loss);
    energy->t[0] = energy->t[1];
    energy->power[0] = energy->power[1];
    energy->t[1] = t;
    energy->power[1] = *now;
    energy->known = 2;
}

void gm_energy_jump(gm_energy *energy, double work, const gm_transient_powers *after)
{
    energy->sum.work += work;
    energy->sum.through += fabs(work);
    energy->sum.impulses += after->lost - energy->power[1].lost;
    energy->sum.stored = after->stored;
    energy->power[1] = *after;
    energy->known = 1;
}

void gm_energy_kink(gm_energy *energy)
{
    energy->known = 1;
}
