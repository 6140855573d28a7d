/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A one-speed reducer made by hand: one path, one gear of ratio -9, an infinite
 * synchroniser. D = 0.01 |tau|, P = 1 N.m, N = 0.1 N.m against the rotation.
 * Ranges: |w_o| <= 200 rad/s, |tau| <= 300 N.m, |w_n| <= 1800 rad/s.
 */
#ifndef GM_TABLES_H
#define GM_TABLES_H

#include "gm_reduced.h"

#define GM_TABLES_GUID "{8c1f6d0a-6a41-4f86-9d0e-52f6a9d3c111}"

static const char *const gm_tables_path_names[1] = {"input"};

/* speed of the output, of the path [rad/s] */
static const gm_real speed_output[2] = {0, 200};
static const gm_real speed_path[2] = {0, 1800};
/* torque in the direction of rotation [N.m] */
static const gm_real torque[3] = {-300, 0, 300};

/* [speed][torque] N.m at the input flange */
static const gm_real load_loss[2 * 3] = {3, 0, 3, 3, 0, 3};
/* N.m at the output */
static const gm_real parasitic[2] = {1, 1};
/* [speed of the path][speed of the output] N.m at the input flange */
static const gm_real drag_forward[2 * 2] = {0.1, 0.1, 0.1, 0.1};
static const gm_real drag_backward[2 * 2] = {-0.1, -0.1, -0.1, -0.1};
/* N.m at the output */
static const gm_real reaction[2 * 2] = {0, 0, 0, 0};

// clang-format off
#define LOAD_LOSS {.x = {2, speed_path}, .y = {3, torque}, .value = load_loss}
#define FREE(v) {.x = {2, speed_path}, .y = {2, speed_output}, .value = (v)}
#define PARASITIC {.x = {2, speed_output}, .value = parasitic}

static const gm_gear gears_input[1] = {
    {.number = 1, .ratio = -9.0, .load_loss = {LOAD_LOSS, LOAD_LOSS}},
};
static const gm_configuration configurations[2] = {
    {.gear = {-1, -1}, .parasitic = {PARASITIC, PARASITIC}},
    {.gear = {0, -1}, .parasitic = {PARASITIC, PARASITIC}},
};
static const gm_reduced_map gm_tables_map = {
    .n_paths = 1,
    .path = {{
        .inertia = 0.02, .sync_torque = 1e30, .n_gears = 1, .gears = gears_input,
        .drag = {{FREE(drag_forward), FREE(drag_forward)},
                 {FREE(drag_backward), FREE(drag_backward)}},
        .reaction = {{FREE(reaction), FREE(reaction)}, {FREE(reaction), FREE(reaction)}},
    }},
    .n_configurations = 2,
    .configurations = configurations,
    .inertia_output = 0.05,
    .oil_temperature = 263.15,
};
// clang-format on

#undef LOAD_LOSS
#undef FREE
#undef PARASITIC

#endif
