/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A reduction: sweep, bake and verify in one go. The component gets its name only when
 * all three are done: until then it stands beside under a name of this process.
 */
#ifndef REDUCTION_H
#define REDUCTION_H

#include "verified.h"

/** What to reduce and how. map and cycle may be NULL; vehicle and trace go with cycle. */
typedef struct gm_reduce_settings {
    const char *description, *output, *map;
    gm_sweep_settings sweep;
    gm_bake_settings bake;
    int points, seed;
    const char *cycle, *vehicle, *trace;
} gm_reduce_settings;

typedef struct gm_reduction {
    const char *output;
    gm_gearset_file file;
    gm_sweep_stage sweep;
    gm_bake_stage bake;
    gm_verify_stage verify;
    int drives; /* over a cycle, too */
    gm_cycle_stage cycle;
    double start, elapsed, driving; /* s; driving: in the cycle alone */
} gm_reduction;

/** Do it; clear *reduction in any case. On failure no output is left, finished points of
 *  a map stay in its journal. Errors of the stages. */
GM_NODISCARD gm_status gm_reduce(const gm_reduce_settings *settings,
                                 gm_reduction *reduction, gm_error *error);
void gm_reduction_clear(gm_reduction *reduction);

#endif
