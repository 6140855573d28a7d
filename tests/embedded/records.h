/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Recorded inputs: a file of records, each held for some steps. Numbers are floats, so
 * that a run in double gets the very same ones.
 */
#ifndef RECORDS_H
#define RECORDS_H

#include "gm_reduced.h"

#include <stdint.h>

typedef struct record {
    int32_t steps, gear[2];
    float path_tau[2], output_tau; /* N.m */
} record;

static inline gm_reduced_inputs inputs_of(const record *r)
{
    gm_reduced_inputs in = {.output_tau = (gm_real)r->output_tau};
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        in.path_tau[p] = (gm_real)r->path_tau[p];
        in.gear[p] = r->gear[p];
    }
    return in;
}

#endif
