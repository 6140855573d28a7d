/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A small gearset made by hand, to compile and test the component against. Two paths.
 * Losses are simple formulas, exact at every point because they are (bi)linear:
 *
 *   D = 0.02 |tau|                         load loss of every gear, both directions
 *   P = 2 + 0.01 |w_o|                     parasitic loss of every configuration [N.m]
 *   N = sgn(w_n) (0.2 + 0.001 |w_n|)       drag of a neutral path [N.m], no reaction
 *   C = 0.0005 (w_0 - w_1)                 between the two input shafts [N.m]
 *
 * With GM_EXAMPLE_SPEED_IN gears have springs, and motion is prescribed at the first path
 * and at the output: phi, w and a come in there and tau goes out.
 * Ranges: |w_o| <= 500 rad/s, |tau| <= 400 N.m at the inputs, |w_n| <= 2000 rad/s.
 */
#ifndef GM_TABLES_H
#define GM_TABLES_H

#include "gm_reduced.h"

#define GM_TABLES_GUID "{0e7f9a52-5d0c-4c7e-9f5b-3a1d64c1b2a0}"

static const char *const gm_tables_path_names[2] = {"odd", "even"};

/* speed of the output [rad/s] */
static const gm_real speed_output[2] = {0, 500};
/* speed of a path [rad/s] */
static const gm_real speed_path[2] = {0, 2000};
/* torque in the direction of rotation [N.m] */
static const gm_real torque[3] = {-400, 0, 400};
/* relative speed of the input shafts [rad/s] */
static const gm_real speed_relative[2] = {-2000, 2000};

/* [speed][torque] N.m at the input flange */
static const gm_real load_loss[2 * 3] = {8, 0, 8, 8, 0, 8};
/* N.m at the output */
static const gm_real parasitic[2] = {2, 7};
/* [speed of the path][speed of the output] N.m at the input flange */
static const gm_real drag_forward[2 * 2] = {0.2, 0.2, 2.2, 2.2};
static const gm_real drag_backward[2 * 2] = {-0.2, -0.2, -2.2, -2.2};
/* N.m at the output */
static const gm_real reaction[2 * 2] = {0, 0, 0, 0};
/* N.m */
static const gm_real coupling[2] = {-1, 1};

#ifdef GM_EXAMPLE_SPEED_IN
#define GM_EXAMPLE_SPRING                                                                \
    .stiffness = 2e4, .damping = 2, .loose_damping = 4, .lash = 5e-3, .film = 1e-4,
#define GM_EXAMPLE_PRESCRIBED .prescribed = {1, 0, 1},
#else
#define GM_EXAMPLE_SPRING
#define GM_EXAMPLE_PRESCRIBED
#endif

// clang-format off
#define AXIS(name) {.n = sizeof(name) / sizeof *(name), .x = (name)}
#define LOAD_LOSS {.x = AXIS(speed_path), .y = AXIS(torque), .value = load_loss}
#define GEAR(n, r) {.number = (n), .ratio = (r), GM_EXAMPLE_SPRING                       \
                    .load_loss = {LOAD_LOSS, LOAD_LOSS}}
#define FREE(v) {.x = AXIS(speed_path), .y = AXIS(speed_output), .value = (v)}
#define PARASITIC {.x = AXIS(speed_output), .value = parasitic}
#define CONFIGURATION(g0, g1) {.gear = {g0, g1}, .parasitic = {PARASITIC, PARASITIC}}
#define PATH(list, capacity) {                                                           \
    .inertia = 0.01, .sync_torque = (capacity),                                          \
    .n_gears = sizeof(list) / sizeof *(list), .gears = (list),                           \
    .drag = {{FREE(drag_forward), FREE(drag_forward)},                                   \
             {FREE(drag_backward), FREE(drag_backward)}},                                \
    .reaction = {{FREE(reaction), FREE(reaction)}, {FREE(reaction), FREE(reaction)}}}

static const gm_gear gears_odd[2] = {GEAR(1, 15.0), GEAR(3, 6.0)};
static const gm_gear gears_even[2] = {GEAR(-1, -14.0), GEAR(2, 9.0)};

static const gm_configuration configurations[9] = {
    CONFIGURATION(-1, -1), CONFIGURATION(-1, 0), CONFIGURATION(-1, 1),
    CONFIGURATION(0, -1),  CONFIGURATION(0, 0),  CONFIGURATION(0, 1),
    CONFIGURATION(1, -1),  CONFIGURATION(1, 0),  CONFIGURATION(1, 1),
};

static const gm_reduced_map gm_tables_map = {
    .n_paths = 2,
    .path = {PATH(gears_odd, 30.0), PATH(gears_even, 40.0)},
    .n_configurations = 9,
    .configurations = configurations,
    .coupling = {.x = AXIS(speed_relative), .value = coupling},
    .inertia_output = 0.1,
    .oil_temperature = 333.15,
    GM_EXAMPLE_PRESCRIBED
};
// clang-format on

#undef AXIS
#undef LOAD_LOSS
#undef GEAR
#undef FREE
#undef PARASITIC
#undef CONFIGURATION
#undef PATH

#endif
