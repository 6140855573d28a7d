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

#define OWNER gm_clutch
static const gm_field clutch_fields[] = {
    {.key = "shaft", .type = GM_FIELD_REFERENCE, .section = &gm_schema_shaft, AT(shaft),
     .help = "the shaft that it locks"},
    {.key = "on", .type = GM_FIELD_REFERENCE, .section = &gm_schema_shaft, AT(on),
     OPTIONAL, .help = "the concentric shaft to which it locks it, or housing: a brake"},
    {NUMBER("torque_capacity_Nm", 0, 1e6), ABOVE, AT(torque_capacity),
     .help = "friction torque up to which it synchronises, as cone_torque_Nm of a "
             "synchroniser"},
    {INTEGER("friction_surfaces", 0, 100), AT(surfaces), DEFAULT("0"),
     .help = "wetted gaps, which drag while it is open; 0: no drag, as of a dog clutch"},
    {NUMBER("inner_radius_mm", 0, 1000), ABOVE, AT(inner_radius), OPTIONAL,
     .help = "of the friction surfaces"},
    {NUMBER("outer_radius_mm", 0, 1000), ABOVE, AT(outer_radius), OPTIONAL,
     .help = "of the friction surfaces"},
    {NUMBER("clearance_mm", 0, 50), ABOVE, AT(clearance), OPTIONAL,
     .help = "oil film of one open gap"},
    {NUMBER("stiffness_Nm_rad", 0, 1e10), ABOVE, AT(closed.stiffness), DEFAULT("2e5"),
     .help = "between its two sides while it is closed"},
    {NUMBER("damping_ratio", 0, 2), AT(closed.damping_ratio), DEFAULT("0.1"),
     .help = "of both sides on that stiffness"},
    {NUMBER("oil_feed_l_min", 0, 1000), AT(feed), OPTIONAL,
     .help = "oil fed to its gaps: at high slip they throw out more and drag less; "
             "without it they stay full at any slip"},
    END};
const gm_section gm_schema_clutch = {
    .title = "clutches", .word = "clutch",
    .help = "Clutches lock two concentric shafts to each other, brakes a shaft to the "
            "housing: shift elements of planetary gearsets, and direct drive.",
    .fields = clutch_fields, .size = sizeof(gm_clutch), .key = GM_KEY_NAME,
    .label = offsetof(gm_clutch, id), .collection = "clutches"};
#undef OWNER

#define OWNER gm_path_gear
static const gm_field path_gear_fields[] = {
    {.key = "lock", .type = GM_FIELD_LOCKS, .section = &gm_schema_gear,
     .other = &gm_schema_clutch, AT(locks),
     .count_offset = offsetof(gm_path_gear, n_locks),
     .help = "idling gears that are locked to their shafts, clutches and brakes that are "
             "closed; an empty list [] where meshes alone connect the path"},
    {NUMBER("ratio", -1000, 1000), AT(ratio), OPTIONAL,
     .help = "input speed over output speed, negative if they turn in opposite "
             "directions; must be what the gears make within 0.001 of it"},
    END};
static const gm_section path_gear_section = {
    .title = "gears", .word = "gear",
    .help = "Gears of a path by number: -1 reverse, 1 and up forward. Number 0 says what "
            "stays locked in neutral; without it nothing does. A path with one gear that "
            "locks the same as neutral, as a rule [], has no neutral.",
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
