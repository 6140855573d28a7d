/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A gearset of law.h on the test rig, in the tests' own process.
 */
#ifndef LAW_RIG_H
#define LAW_RIG_H

#include "law.h"
#include "plant/gm_plant.h"
#include "plant/gm_rig.h"

typedef struct law_rig {
    law_variant variant;
    double temperature; /* K */
    long fails_after;   /* steps until the model answers GM_ERR_TOOL; 0: never */
    gm_rig rig;         /* points back here */
    gm_plant_gear gears[LAW_PATHS][LAW_GEARS];
    gm_plant_info info;
} law_rig;

void law_rig_init(law_rig *l, law_variant variant);

#endif
