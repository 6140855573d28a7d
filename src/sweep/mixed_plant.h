/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A plant whose losses and whose inertias come from different experiments on the same
 * gearset.
 */
#ifndef MIXED_PLANT_H
#define MIXED_PLANT_H

#include "plant/gm_plant.h"

/** Points, kinks and drag lines of `losses`; ratios, inertias and compliance of
 *  `inertias`. Both outlive it. Free with gm_free. GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_mixed_plant_create(const gm_plant *losses,
                                             const gm_plant *inertias, gm_plant **plant,
                                             gm_error *error);

#endif
