/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The tables of the description file: rolling bearings, of shafts and of idling gears.
 */
#include "model/schema_fields.h"

#include "model/gm_description.h"

/* clang-format off */

static const gm_choice bearing_types[] = {
    {"deep_groove_ball", GM_BEARING_DEEP_GROOVE_BALL},
    {"angular_contact_ball", GM_BEARING_ANGULAR_CONTACT_BALL},
    {"cylindrical_roller", GM_BEARING_CYLINDRICAL_ROLLER},
    {"needle_roller", GM_BEARING_NEEDLE_ROLLER},
    {"tapered_roller", GM_BEARING_TAPERED_ROLLER},
    {"plain", GM_BEARING_PLAIN},
    {NULL, 0}};

static const gm_choice bearing_frictions[] = {
    {"none", GM_FRICTION_NONE},
    {"coulomb", GM_FRICTION_COULOMB},
    {"elastic", GM_FRICTION_ELASTIC},
    {"hydrodynamic", GM_FRICTION_HYDRODYNAMIC},
    {"skf", GM_FRICTION_SKF},
    {"palmgren", GM_FRICTION_PALMGREN},
    {NULL, 0}};

static const gm_choice bearing_supplies[] = {{"oil_bath", GM_SUPPLY_BATH},
                                             {"grease", GM_SUPPLY_GREASE},
                                             {"flooded", GM_SUPPLY_FLOODED},
                                             {NULL, 0}};
static const gm_choice bearing_caps[] = {{"none", GM_CAP_NONE},
                                         {"rsl", GM_CAP_RSL},
                                         {"rsh", GM_CAP_RSH},
                                         {"rs1", GM_CAP_RS1},
                                         {NULL, 0}};

#define OWNER gm_friction_point
static const gm_field point_fields[] = {
    {NUMBER("speed_rpm", 0, 1e5), AT(speed), .help = "speed, from 0 upwards"},
    {NUMBER("torque_Nm", 0, 1e5), AT(torque), .help = "friction at that speed"},
    END};
static const gm_section point_section = {
    .title = "torque_over_speed", .word = "point",
    .help = "Friction of a bearing over its speed: straight lines between the points, "
            "the last one continued.",
    .fields = point_fields, .size = sizeof(gm_friction_point), .key = GM_KEY_NONE,
    .line = offsetof(gm_friction_point, line)};
#undef OWNER

#define GIVEN "coulomb, elastic or hydrodynamic"
#define STRIBECK "elastic or hydrodynamic"
#define OWNER gm_bearing_data
static const gm_field bearing_data_fields[] = {
    {.key = "type", .type = GM_FIELD_CHOICE, .choices = bearing_types, AT(type),
     .help = "kind of bearing"},
    {.key = "friction", .type = GM_FIELD_CHOICE, .choices = bearing_frictions,
     AT(friction), DEFAULT("skf"),
     .help = "friction model; none: a support whose friction belongs to another part"},
    {.key = "designation", .type = GM_FIELD_WORDS, OPTIONAL, AT(designation),
     .help = "deep groove ball bearings: the catalogue's number, such as \"6206\", in "
             "place of dimensions"},
    {.key = "series", .type = GM_FIELD_WORDS, OPTIONAL, AT(series),
     .help = "row of the SKF friction constants, such as \"62\" or \"22\"; what each "
             "type needs, and all series, stand above"},
    {NUMBER("bore_mm", 0, 2000), ABOVE, AT(d), OPTIONAL, .help = "inner diameter d"},
    {NUMBER("outer_mm", 0, 2000), ABOVE, AT(D), OPTIONAL, .help = "outer diameter D"},
    {NUMBER("width_mm", 0, 1000), ABOVE, AT(B), OPTIONAL, .help = "width B"},
    {NUMBER("static_load_N", 0, 1e8), ABOVE, AT(C0), OPTIONAL,
     .help = "static load rating C0; deep groove ball bearings need it, angular contact "
             "ones with palmgren and without f1"},
    {NUMBER("axial_factor", 0, 10), ABOVE, AT(Y), OPTIONAL,
     ONLY("type", "tapered_roller"),
     .help = "Y of the catalogue; needed, except with friction none"},
    {NUMBER("f0", 0, 100), ABOVE, AT(f0), OPTIONAL, ONLY("friction", "palmgren"),
     .help = "factor of the part without load; default of the type"},
    {NUMBER("f1", 0, 1), ABOVE, AT(f1), OPTIONAL, ONLY("friction", "palmgren"),
     .help = "factor of the part with load; default of the type"},
    {.key = "supply", .type = GM_FIELD_CHOICE, .choices = bearing_supplies, AT(supply),
     DEFAULT("oil_bath"), ONLY("friction", "skf"),
     .help = "how oil reaches the contacts: a low oil bath or a jet; grease or oil-air; "
             "so much that none is missing"},
    {.key = "seals", .type = GM_FIELD_CHOICE, .choices = bearing_caps, AT(cap),
     DEFAULT("none"), ONLY("friction", "skf"),
     .help = "contact seals on both sides of a deep groove ball bearing, by SKF's name"},
    {NUMBER("seal_diameter_mm", 0, 2000), ABOVE, AT(cap_diameter), OPTIONAL,
     ONLY("seals", "rsl, rsh or rs1"),
     .help = "where those seals slide, d1 or d2 of the catalogue; needed"},
    {NUMBER("torque_Nm", 0, 1e5), AT(torque), OPTIONAL, ONLY("friction", GIVEN),
     .help = "friction without load while it slides; default 0, elastic needs it"},
    {.key = "torque_over_speed", .type = GM_FIELD_ITEMS, .section = &point_section,
     AT(table), .count_offset = offsetof(gm_bearing_data, n_table),
     .fixed_count = GM_FRICTION_POINTS, OPTIONAL, ONLY("friction", "coulomb"),
     .help = "friction without load in place of torque_Nm; the torque of the first "
             "point is that at rest"},
    {NUMBER("mu", 0, 1), AT(mu), OPTIONAL, ONLY("friction", GIVEN),
     .help = "coefficient of friction while it slides, at half the mean diameter, of a "
             "plain bearing at half the bore; default 0"},
    {NUMBER("static_torque_Nm", 0, 1e5), AT(static_torque), OPTIONAL,
     ONLY("friction", STRIBECK),
     .help = "torque without load that it holds at rest; default torque_Nm"},
    {NUMBER("static_mu", 0, 1), AT(static_mu), OPTIONAL, ONLY("friction", STRIBECK),
     .help = "coefficient of friction at rest; default mu"},
    {NUMBER("stribeck_rpm", 0, 1e5), ABOVE, AT(stribeck), DEFAULT("0.5"),
     ONLY("friction", STRIBECK),
     .help = "speed over which friction falls from its value at rest"},
    {NUMBER("viscous_Nms_rad", 0, 1e5), AT(viscous), OPTIONAL,
     ONLY("friction", STRIBECK), .help = "torque by speed; default 0"},
    {NUMBER("stiffness_Nm_rad", 0, 1e9), ABOVE, AT(stiffness), DEFAULT("200"),
     ONLY("friction", "elastic"), .help = "torque by angle before it slides"},
    {NUMBER("damping_Nms_rad", 0, 1e6), ABOVE, AT(damping), DEFAULT("1"),
     ONLY("friction", "elastic"), .help = "torque by speed before it slides"},
    {NUMBER("clearance_mm", 0, 50), ABOVE, AT(clearance), OPTIONAL,
     ONLY("friction", "hydrodynamic"),
     .help = "radial clearance of a plain bearing, whose film then adds Petroff's torque "
             "of the oil"},
    END};
#undef GIVEN
#undef STRIBECK
const gm_section gm_schema_bearing_data = {
    .title = "bearing", .word = "bearing", .help = "Data of one bearing.",
    .fields = bearing_data_fields};
#undef OWNER

static const gm_choice thrusts[] = {
    {"both", 0}, {"plus_x", 1}, {"minus_x", -1}, {NULL, 0}};

#define OWNER gm_bearing
static const gm_field bearing_fields[] = {
    {.key = "shaft", .type = GM_FIELD_REFERENCE, .section = &gm_schema_shaft, AT(shaft),
     .help = "the shaft that it carries"},
    {.key = "on", .type = GM_FIELD_REFERENCE, .section = &gm_schema_shaft, AT(on),
     OPTIONAL, .help = "housing, or the concentric shaft that holds the other ring"},
    {NUMBER("position_mm", -5000, 5000), AT(position), .help = "x of its middle"},
    {.key = "locating", .type = GM_FIELD_BOOLEAN, AT(locating), DEFAULT("false"),
     .help = "true: takes axial load"},
    {.key = "thrust", .type = GM_FIELD_CHOICE, .choices = thrusts, AT(thrust),
     DEFAULT("both"), ONLY("locating", "true"),
     .help = "direction in which it holds its shaft; tapered roller and angular contact "
             "bearings come in pairs, one of them plus_x, the other minus_x"},
    {NUMBER("preload_N", 0, 1e7), AT(preload), DEFAULT("0"), ONLY("thrust", "plus_x"),
     .help = "axial preload of the pair at 20 degC"},
    {NUMBER("preload_change_N_K", -1e5, 1e5), AT(preload_change), DEFAULT("0"),
     ONLY("thrust", "plus_x"),
     .help = "its change by the oil's temperature; negative where the housing expands "
             "more and loosens the pair, -11.5e-6/K times distance times axial stiffness "
             "of the pair in aluminium"},
    {NUMBER("induced_axial_factor", 0, 10), AT(induced), OPTIONAL,
     ONLY("thrust", "plus_x or minus_x"),
     .help = "axial force that a radial load induces, per radial load; default: tapered "
             "roller 0.5/axial_factor, angular contact ball 1.14 (contact angle 40 deg), "
             "others 0"},
    {.key = "data", .type = GM_FIELD_INLINE, .section = &gm_schema_bearing_data,
     AT(data), .help = ""},
    {NUMBER("radial_stiffness_N_um", 0, 1e5), ABOVE, AT(radial_stiffness), DEFAULT("300"),
     .help = "matters where three or more bearings carry a shaft"},
    {NUMBER("axial_stiffness_N_um", 0, 1e5), ABOVE, AT(axial_stiffness), DEFAULT("100"),
     .help = "matters where two or more bearings are locating"},
    END};
const gm_section gm_schema_bearing = {
    .title = "bearings", .word = "bearing",
    .help = "Bearings that carry the shafts. Every shaft needs two, one of them "
            "locating.",
    .fields = bearing_fields, .size = sizeof(gm_bearing), .key = GM_KEY_NAME,
    .label = offsetof(gm_bearing, id)};
#undef OWNER
/* clang-format on */
