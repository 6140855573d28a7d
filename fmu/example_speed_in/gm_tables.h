/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The gearset of example/ with springs, and with prescribed motion at the first path and
 * at the output: phi, w and a come in there and tau goes out.
 */
#ifndef GM_TABLES_SPEED_IN_H
#define GM_TABLES_SPEED_IN_H

#define GM_EXAMPLE_SPRING                                                                \
    .stiffness = 2e4, .damping = 2, .loose_damping = 4, .lash = 5e-3, .film = 1e-4,
#define GM_EXAMPLE_PRESCRIBED .prescribed = {1, 0, 1},

#include "../example/gm_tables.h"

#endif
