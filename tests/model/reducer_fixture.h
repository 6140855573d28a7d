/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A one-stage helical reducer as a description in memory: the smallest gearset, for tests
 * that want every number at hand. z 32/49, m_n 1.75 mm, alpha_n 17.5 deg, beta 30 deg,
 * bearings at x = 0 and 160 mm, gears at 60 mm, no weight, no friction unless set.
 */
#ifndef REDUCER_FIXTURE_H
#define REDUCER_FIXTURE_H

#include "model/gm_gearset.h"

typedef struct reducer {
    gm_description d;
    gm_shaft shafts[2];
    gm_wheel wheels[2];
    gm_mesh meshes[1];
    gm_bearing bearings[4];
    gm_path_gear gear;
    gm_lock lock;
    gm_synchroniser synchroniser;
    int locked_wheel;
} reducer;

/** Fill; pointers inside refer to *r itself. */
void reducer_make(reducer *r);

#endif
