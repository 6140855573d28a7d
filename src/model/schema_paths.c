/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The tables of the description file: what shifts, and the paths.
 */
#include "model/schema_fields.h"

#include "model/gm_description.h"

/* clang-format off */

#define OWNER gm_synchroniser
static const gm_field synchroniser_fields[] = {
    {.key = "shaft", .type = GM_FIELD_REFERENCE, .section = &gm_schema_shaft, AT(shaft),
     .help = "the shaft on which it sits"},
    {.key = "gears", .type = GM_FIELD_REFERENCES, .section = &gm_schema_gear, AT(wheels),
     .count_offset = offsetof(gm_synchroniser, n_wheels),
     .help = "the idling gears beside it, one of which it locks at a time"},
    {NUMBER("cone_torque_Nm", 0, 1e5), ABOVE, AT(cone_torque),
     .help = "friction torque up to which its cones synchronise; a path has one "
             "capacity, the smallest of its gears at the input flange"},
    {NUMBER("cone_radius_mm", 0, 1000), ABOVE, AT(cone_radius), .help = "mean radius"},
    {NUMBER("cone_width_mm", 0, 1000), ABOVE, AT(cone_width),
     .help = "length of the cone"},
    {NUMBER("cone_clearance_mm", 0, 50), ABOVE, AT(cone_clearance),
     .help = "oil film when open"},
    {.key = "dogs", .type = GM_FIELD_GROUP, .section = &gm_schema_dogs, AT(dogs),
     .need = GM_NEED_DEFAULT, .help = "stiffness, damping and backlash when locked"},
    END};
const gm_section gm_schema_synchroniser = {
    .title = "synchronisers", .word = "synchroniser",
    .help = "Synchronisers lock idling gears to their shaft.",
    .fields = synchroniser_fields, .size = sizeof(gm_synchroniser), .key = GM_KEY_NAME,
    .label = offsetof(gm_synchroniser, id)};
#undef OWNER

#define OWNER gm_path_gear
static const gm_field path_gear_fields[] = {
    {.key = "lock", .type = GM_FIELD_REFERENCE, .section = &gm_schema_gear, AT(wheel),
     .help = "the idling gear that is locked to its shaft"},
    {NUMBER("ratio", -1000, 1000), AT(ratio), OPTIONAL,
     .help = "input speed over output speed, negative if they turn in opposite "
             "directions; must be what the gears make within 0.001 of it"},
    END};
static const gm_section path_gear_section = {
    .title = "gears", .word = "gear",
    .help = "Gears of a path by number: -1 reverse, 1 and up forward.",
    .fields = path_gear_fields, .size = sizeof(gm_path_gear), .key = GM_KEY_INTEGER,
    .label = offsetof(gm_path_gear, number), .line = offsetof(gm_path_gear, line),
    .low = -1, .high = 30};
#undef OWNER

#define OWNER gm_path_part
static const gm_field path_fields[] = {
    {.key = "shaft", .type = GM_FIELD_REFERENCE, .section = &gm_schema_shaft, AT(shaft),
     .help = "the shaft with the input flange"},
    {.key = "gears", .type = GM_FIELD_ITEMS, .section = &path_gear_section, AT(gears),
     .count_offset = offsetof(gm_path_part, n_gears),
     .help = "what it can be shifted to"},
    END};
const gm_section gm_schema_path = {
    .title = "paths", .word = "path",
    .help = "Ways from an input flange to the output: odd and even, or one named input.",
    .fields = path_fields, .size = sizeof(gm_path_part), .key = GM_KEY_NAME,
    .label = offsetof(gm_path_part, id)};
#undef OWNER
/* clang-format on */
