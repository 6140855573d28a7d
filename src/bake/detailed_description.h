/* SPDX-License-Identifier: BSD-2-Clause
 *
 * modelDescription.xml of the detailed gearset as a component: the variables of a reduced
 * one (core/gm_vars.def), and behind them its own (model/gm_motion_variables.h).
 */
#ifndef DETAILED_DESCRIPTION_H
#define DETAILED_DESCRIPTION_H

#include "bake/buffer.h"
#include "model/gm_motion_variables.h"

typedef struct gm_detailed_subject {
    const gm_gearset *gearset;
    gm_motion *motion;
    const gm_motion_variables *variables;
    const char *identifier, *guid;
} gm_detailed_subject;

/** Append the whole file. GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_detailed_description_write(const gm_detailed_subject *subject,
                                                     gm_buffer *buffer, gm_error *error);

#endif
