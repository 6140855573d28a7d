/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The tables of the description file: gears and meshes.
 */
#include "model/schema_fields.h"

#include "model/gm_description.h"

/* clang-format off */

static const gm_choice churnings[] = {{"none", GM_CHURNING_NONE},
                                      {"changenet_velex", GM_CHURNING_CHANGENET_VELEX},
                                      {"iso14179_1", GM_CHURNING_ISO14179_1},
                                      {"iso14179_2", GM_CHURNING_ISO14179_2},
                                      {NULL, 0}};

#define OWNER gm_wheel
static const gm_field gear_fields[] = {
    {.key = "shaft", .type = GM_FIELD_REFERENCE, .section = &gm_schema_shaft, AT(shaft),
     .help = "the shaft on which it sits"},
    {INTEGER("teeth", 5, 1000), AT(teeth), .help = "number of teeth"},
    {NUMBER("normal_module_mm", 0, 100), ABOVE, AT(normal_module), .help = "m_n"},
    {NUMBER("helix_deg", -60, 60), AT(helix), DEFAULT("0"),
     .help = "helix angle at the pitch circle, positive for right-hand teeth"},
    {NUMBER("pressure_angle_deg", 10, 35), AT(pressure_angle), DEFAULT("20"),
     .help = "normal pressure angle"},
    {NUMBER("profile_shift", -2, 2), AT(profile_shift), DEFAULT("0"),
     .help = "x, in modules"},
    {NUMBER("width_mm", 0, 1000), ABOVE, AT(width), .help = "face width"},
    {NUMBER("position_mm", -5000, 5000), AT(position), .help = "x of the face's middle"},
    {NUMBER("roughness_um", 0, 20), ABOVE, AT(roughness), DEFAULT("0.5"),
     .help = "flank roughness Ra"},
    {.key = "internal", .type = GM_FIELD_BOOLEAN, AT(internal), DEFAULT("false"),
     .help = "true: internal teeth"},
    {.key = "idles", .type = GM_FIELD_BOOLEAN, AT(idles), DEFAULT("false"),
     .help = "true: turns on its shaft until a synchroniser locks it"},
    {INTEGER("planets", 0, 12), AT(planets), DEFAULT("0"),
     .help = "planets like this one, evenly around the axis of their carrier, which is "
             "the shaft; 0: not a planet"},
    {NUMBER("pin_radius_mm", 0, 2000), ABOVE, AT(pin_radius), OPTIONAL,
     .help = "of a planet: from the axis of the carrier to that of the planet"},
    {NUMBER("pin_angle_deg", -360, 360), AT(pin_angle), OPTIONAL,
     .help = "of a planet: where the first one stands, from y to z; default 0; matters "
             "where planets mesh with each other"},
    {NUMBER("inertia_kgm2", 0, 1000), AT(inertia), OPTIONAL,
     .help = "default: a steel disc from bore to pitch diameter"},
    {NUMBER("mass_kg", 0, 10000), AT(mass), OPTIONAL, .help = "likewise"},
    {NUMBER("bore_mm", 0, 2000), AT(bore), OPTIONAL,
     .help = "inner diameter of that disc; default: the shaft's diameter, of an idling "
             "gear the outer diameter of its bearing"},
    {.key = "bearing", .type = GM_FIELD_GROUP, .section = &gm_schema_bearing_data,
     AT(bearing), OPTIONAL, .help = "of an idling gear: what it turns on"},
    {.key = "churning", .type = GM_FIELD_CHOICE, .choices = churnings, AT(churning),
     DEFAULT("changenet_velex"),
     .help = "loss when it dips into the oil; iso14179_2 is counted with its meshes"},
    {.key = "windage", .type = GM_FIELD_BOOLEAN, AT(windage), DEFAULT("false"),
     .help = "true: windage by Maurer, which matters above some 50 m/s"},
    END};
const gm_section gm_schema_gear = {
    .title = "gears", .word = "gear", .help = "Gear wheels, fixed on a shaft or idling.",
    .fields = gear_fields, .size = sizeof(gm_wheel), .key = GM_KEY_NAME,
    .label = offsetof(gm_wheel, id), .collection = "gears"};
#undef OWNER

static const gm_choice mesh_losses[] = {
    {"constant", GM_MESH_CONSTANT},
    {"torque_dependent", GM_MESH_TORQUE_DEPENDENT},
    {"temperature_dependent", GM_MESH_TEMPERATURE_DEPENDENT},
    {NULL, 0}};
static const gm_choice mesh_methods[] = {{"iso14179_2", GM_MESH_ISO14179_2},
                                         {"iso14179_1", GM_MESH_ISO14179_1},
                                         {NULL, 0}};

#define OWNER gm_mesh
static const gm_field mesh_loss_fields[] = {
    {.key = "model", .type = GM_FIELD_CHOICE, .choices = mesh_losses, AT(loss),
     DEFAULT("temperature_dependent"),
     .help = "an efficiency; a torque; or a standard with the viscosity of the oil at "
             "its temperature"},
    {.key = "method", .type = GM_FIELD_CHOICE, .choices = mesh_methods, AT(method),
     DEFAULT("iso14179_2"), ONLY("model", "temperature_dependent"),
     .help = "iso14179_2: Schlenk's friction and Ohlendorf's loss factor; iso14179_1: "
             "within its range, blended to the former outside"},
    {NUMBER("efficiency", 0.5, 1), AT(efficiency), OPTIONAL, ONLY("model", "constant"),
     .help = "share of the power that leaves; needed"},
    {NUMBER("idle_torque_Nm", 0, 1e5), AT(idle_torque), OPTIONAL,
     ONLY("model", "torque_dependent"),
     .help = "loss torque without load, at the first of the gears; needed"},
    {NUMBER("torque_share", 0, 0.5), AT(torque_share), OPTIONAL,
     ONLY("model", "torque_dependent"),
     .help = "share of the torque that enters the mesh; needed"},
    {NUMBER("minimum_line_load_N_mm", 0, 10000), AT(minimum_line_load), DEFAULT("150"),
     ONLY("model", "temperature_dependent"),
     .help = "smallest F_bt/b in Schlenk's coefficient of friction"},
    END};
static const gm_section mesh_loss_section = {
    .title = "loss", .word = "loss", .help = "Loss that depends on load.",
    .fields = mesh_loss_fields};
static const gm_field mesh_fields[] = {
    {.key = "gears", .type = GM_FIELD_REFERENCES, .section = &gm_schema_gear, AT(wheel),
     .fixed_count = 2, .help = "the two gears that mesh"},
    {.key = "loss", .type = GM_FIELD_GROUP, .section = &mesh_loss_section, .offset = 0,
     .need = GM_NEED_DEFAULT, .help = "how its loss is computed"},
    {.key = "flanks", .type = GM_FIELD_GROUP, .section = &gm_schema_flanks, AT(flanks),
     .need = GM_NEED_DEFAULT, .help = "stiffness, damping and backlash"},
    END};
const gm_section gm_schema_mesh = {
    .title = "meshes", .word = "mesh", .help = "Pairs of gears that mesh.",
    .fields = mesh_fields, .size = sizeof(gm_mesh), .key = GM_KEY_NAME,
    .label = offsetof(gm_mesh, id)};
#undef OWNER

#define OWNER gm_jet
static const gm_field jet_fields[] = {
    {.key = "gear", .type = GM_FIELD_REFERENCE, .section = &gm_schema_gear, AT(wheel),
     .help = "the gear that it hits"},
    {NUMBER("flow_l_min", 0, 1000), ABOVE, AT(flow), .help = "oil flow"},
    {NUMBER("speed_m_s", 0, 100), AT(speed), DEFAULT("0"),
     .help = "part of the jet's speed against the motion of the teeth"},
    {NUMBER("factor", 0, 2), ABOVE, AT(factor), DEFAULT("1"),
     .help = "of the impulse loss; 0.85 to 1"},
    END};
const gm_section gm_schema_jet = {
    .title = "jets", .word = "jet", .help = "Oil jets on gears: impulse loss.",
    .fields = jet_fields, .size = sizeof(gm_jet), .key = GM_KEY_NAME,
    .label = offsetof(gm_jet, id)};
#undef OWNER
/* clang-format on */
