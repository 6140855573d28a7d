/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The built-in detailed gearset as a plant.
 */
#ifndef GM_BUILTIN_H
#define GM_BUILTIN_H

#include "model/gm_gearset.h"
#include "plant/gm_dynamics.h"
#include "plant/gm_plant.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Plant over a gearset, which must outlive it. Free with gm_builtin_destroy. */
GM_NODISCARD gm_status gm_builtin_create(const gm_gearset *gearset, gm_plant **plant,
                                         gm_error *error);
void gm_builtin_destroy(gm_plant *plant);

/** The gearset in motion; it must outlive the dynamics and its motions. */
gm_dynamics gm_builtin_dynamics(const gm_gearset *gearset);

#ifdef __cplusplus
}
#endif
#endif
