/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The reduced gearset of a map behind the probe of a verification, with errors that a
 * test may ask for.
 */
#ifndef REDUCED_PROBE_H
#define REDUCED_PROBE_H

#include "map/gm_map.h"
#include "sweep/gm_verify.h"

typedef struct reduced_probe {
    const gm_map_view *view;
    double loss_factor; /* 1 */
    double drag_offset; /* 0 */
    int asked, fail_at; /* answer number that fails; 0: none */
} reduced_probe;

/* For gm_reduced_probe.at; self is a reduced_probe. */
gm_status reduced_probe_at(void *self, double oil, const gm_steady_point *point,
                           double output_torque, gm_reduced_answer *answer,
                           gm_error *error);

#endif
