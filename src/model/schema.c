/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The tables of the description file. A new field is one line here and one member of the
 * structure in gm_description.h.
 *
 * Ranges are wide: they catch a wrong unit or a slip of the keyboard; whether parts fit
 * together is looked at in check.c.
 */
#include "model/schema.h"

#include "model/gm_description.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define PI 3.14159265358979323846

/* clang-format off */

/* The longest suffix that fits counts. */
static const gm_unit units[] = {
    {"",         "",      0.0,    1.0,  1.0},
    {"_mm",      "mm",    0.0,    1.0,  1e3},
    {"_um",      "um",    0.0,    1.0,  1e6},
    {"_deg",     "deg",   0.0,    PI,   180.0},
    {"_rpm",     "rpm",   0.0,    PI,   30.0},
    {"_Nm",      "N.m",   0.0,    1.0,  1.0},
    {"_N",       "N",     0.0,    1.0,  1.0},
    {"_N_um",    "N/um",  0.0,    1e6,  1.0},
    {"_N_mm",    "N/mm",  0.0,    1e3,  1.0},
    {"_kg",      "kg",    0.0,    1.0,  1.0},
    {"_kgm2",    "kg.m2", 0.0,    1.0,  1.0},
    {"_kg_m3",   "kg/m3", 0.0,    1.0,  1.0},
    {"_mm2_s",   "mm2/s", 0.0,    1.0,  1e6},
    {"_degC",    "degC",  273.15, 1.0,  1.0},
    {"_1_K",     "1/K",   0.0,    1.0,  1.0},
    {"_l",       "l",     0.0,    1.0,  1e3},
};

/* Shorthand for the tables below. AT: offset of a member of the section's structure. */
#define AT(member) .offset = offsetof(OWNER, member)
#define NUMBER(name, lo, hi) .key = name, .type = GM_FIELD_NUMBER, .low = lo, .high = hi
#define INTEGER(name, lo, hi) .key = name, .type = GM_FIELD_INTEGER, .low = lo, .high = hi
#define ABOVE .open = GM_OPEN_LOW
#define DEFAULT(text) .need = GM_NEED_DEFAULT, .fallback = text
#define OPTIONAL .need = GM_NEED_NOTHING
#define ONLY(key, word) .only_key = key, .only_word = word
#define END {.key = NULL}

static const gm_section shaft_section, gear_section;

#define OWNER gm_description
static const gm_field limit_fields[] = {
    {NUMBER("input_speed_max_rpm", 10, 100000), AT(speed_max),
     .help = "largest input speed; the default sweep goes up to it"},
    {NUMBER("input_torque_max_Nm", 0, 100000), ABOVE, AT(torque_max),
     .help = "largest input torque; the default sweep goes up to it"},
    END};
static const gm_section limit_section = {
    .title = "limits", .word = "limits", .help = "What the gearset is made for.",
    .fields = limit_fields};
#undef OWNER

#define OWNER gm_oil_part
static const gm_field oil_fields[] = {
    {.key = "name", .type = GM_FIELD_WORDS, OPTIONAL, AT(name), .help = "for people"},
    {NUMBER("viscosity_40_mm2_s", 2, 10000), AT(viscosity_40),
     .help = "kinematic viscosity at 40 degC"},
    {NUMBER("viscosity_100_mm2_s", 1, 1000), AT(viscosity_100),
     .help = "kinematic viscosity at 100 degC"},
    {NUMBER("density_15_kg_m3", 500, 1500), AT(density_15), .help = "density at 15 degC"},
    {NUMBER("thermal_expansion_1_K", 0, 0.01), AT(thermal_expansion), DEFAULT("7e-4"),
     .help = "alpha in rho = rho_15 (1 - alpha (T - 15 degC))"},
    {NUMBER("temperature_degC", -40, 160), AT(temperature), DEFAULT("80"),
     .help = "oil temperature at which the gearset is computed"},
    {NUMBER("mesh_lubricant_factor", 0, 3), ABOVE, AT(mesh_lubricant_factor),
     DEFAULT("1"),
     .help = "X_L of ISO/TR 14179-2: 1 mineral oil, 0.8 synthetic hydrocarbon, "
             "0.75 a 75W transmission oil"},
    {NUMBER("bearing_mu_ehl", 0, 0.2), ABOVE, AT(bearing_mu_ehl), DEFAULT("0.05"),
     .help = "sliding friction of rolling bearings in full film (SKF): 0.05 mineral oil, "
             "0.04 synthetic oil, 0.1 transmission fluids"},
    {NUMBER("level_mm", -5000, 5000), AT(level), OPTIONAL,
     .help = "z of the oil's surface at rest; without it there is no churning"},
    {NUMBER("volume_l", 0, 1000), ABOVE, AT(volume), DEFAULT("1"), .help = "oil fill"},
    END};
static const gm_section oil_section = {
    .title = "oil", .word = "oil", .help = "The lubricant of all parts.",
    .fields = oil_fields};
#undef OWNER

#define OWNER gm_segment
static const gm_field segment_fields[] = {
    {NUMBER("from_mm", -5000, 5000), AT(from), .help = "where the cylinder begins (x)"},
    {NUMBER("to_mm", -5000, 5000), AT(to), .help = "where it ends (x)"},
    {NUMBER("diameter_mm", 0, 2000), ABOVE, AT(diameter), .help = "outside diameter"},
    {NUMBER("bore_mm", 0, 2000), AT(bore), DEFAULT("0"), .help = "inner diameter"},
    END};
static const gm_section segment_section = {
    .title = "segments", .word = "segment",
    .help = "Cylinders of a shaft, one after the other along x.",
    .fields = segment_fields, .size = sizeof(gm_segment), .key = GM_KEY_NONE,
    .line = offsetof(gm_segment, line)};
#undef OWNER

#define OWNER gm_shaft
static const gm_field shaft_fields[] = {
    {NUMBER("y_mm", -5000, 5000), AT(y), .help = "position of the axis, to the side"},
    {NUMBER("z_mm", -5000, 5000), AT(z), .help = "position of the axis, upwards"},
    {NUMBER("inertia_kgm2", 0, 1000), AT(inertia), OPTIONAL,
     .help = "of the shaft without its gears; default: from the segments, in steel"},
    {NUMBER("mass_kg", 0, 10000), AT(mass), OPTIONAL,
     .help = "of the shaft without its gears; default: from the segments, in steel"},
    {.key = "segments", .type = GM_FIELD_ITEMS, .section = &segment_section, AT(segments),
     .count_offset = offsetof(gm_shaft, n_segments), .help = "its cylinders"},
    END};
static const gm_section shaft_section = {
    .title = "shafts", .word = "shaft",
    .help = "Shafts, all parallel to x. A differential cage or a sleeve that carries "
            "several gears is a shaft too.",
    .fields = shaft_fields, .size = sizeof(gm_shaft), .key = GM_KEY_NAME,
    .label = offsetof(gm_shaft, id), .collection = "shafts"};
#undef OWNER

static const gm_choice bearing_types[] = {
    {"deep_groove_ball", GM_BEARING_DEEP_GROOVE_BALL},
    {"angular_contact_ball", GM_BEARING_ANGULAR_CONTACT_BALL},
    {"cylindrical_roller", GM_BEARING_CYLINDRICAL_ROLLER},
    {"needle_roller", GM_BEARING_NEEDLE_ROLLER},
    {"tapered_roller", GM_BEARING_TAPERED_ROLLER},
    {NULL, 0}};
static const gm_choice bearing_frictions[] = {
    {"none", GM_FRICTION_NONE},
    {"skf", GM_FRICTION_SKF},
    {"palmgren", GM_FRICTION_PALMGREN},
    {NULL, 0}};

#define OWNER gm_bearing_data
static const gm_field bearing_data_fields[] = {
    {.key = "type", .type = GM_FIELD_CHOICE, .choices = bearing_types, AT(type),
     .help = "kind of rolling bearing"},
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
    END};
static const gm_section bearing_data_section = {
    .title = "bearing", .word = "bearing", .help = "Data of one rolling bearing.",
    .fields = bearing_data_fields};
#undef OWNER

#define OWNER gm_wheel
static const gm_field gear_fields[] = {
    {.key = "shaft", .type = GM_FIELD_REFERENCE, .section = &shaft_section, AT(shaft),
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
    {NUMBER("inertia_kgm2", 0, 1000), AT(inertia), OPTIONAL,
     .help = "default: a steel disc from bore to pitch diameter"},
    {NUMBER("mass_kg", 0, 10000), AT(mass), OPTIONAL, .help = "likewise"},
    {NUMBER("bore_mm", 0, 2000), AT(bore), OPTIONAL,
     .help = "inner diameter of that disc; default: the shaft's diameter, of an idling "
             "gear the outer diameter of its bearing"},
    {.key = "bearing", .type = GM_FIELD_GROUP, .section = &bearing_data_section,
     AT(bearing), OPTIONAL, .help = "of an idling gear: what it turns on"},
    {.key = "churning", .type = GM_FIELD_BOOLEAN, AT(churning), DEFAULT("true"),
     .help = "false: no churning loss even if it dips into the oil"},
    END};
static const gm_section gear_section = {
    .title = "gears", .word = "gear", .help = "Gear wheels, fixed on a shaft or idling.",
    .fields = gear_fields, .size = sizeof(gm_wheel), .key = GM_KEY_NAME,
    .label = offsetof(gm_wheel, id), .collection = "gears"};
#undef OWNER

static const gm_choice mesh_losses[] = {{"constant", GM_MESH_CONSTANT},
                                        {"iso14179_2", GM_MESH_ISO14179_2},
                                        {NULL, 0}};

#define OWNER gm_mesh
static const gm_field mesh_loss_fields[] = {
    {.key = "model", .type = GM_FIELD_CHOICE, .choices = mesh_losses, AT(loss),
     DEFAULT("iso14179_2"),
     .help = "iso14179_2: Schlenk's friction and Ohlendorf's loss factor"},
    {NUMBER("efficiency", 0.5, 1), AT(efficiency), OPTIONAL, ONLY("model", "constant"),
     .help = "share of the power that leaves; the constant model needs it"},
    {NUMBER("minimum_line_load_N_mm", 0, 10000), AT(minimum_line_load), DEFAULT("150"),
     ONLY("model", "iso14179_2"),
     .help = "smallest F_bt/b in the coefficient of friction"},
    END};
static const gm_section mesh_loss_section = {
    .title = "loss", .word = "loss", .help = "Loss that depends on load.",
    .fields = mesh_loss_fields};
static const gm_field mesh_fields[] = {
    {.key = "gears", .type = GM_FIELD_REFERENCES, .section = &gear_section, AT(wheel),
     .fixed_count = 2, .help = "the two gears that mesh"},
    {.key = "loss", .type = GM_FIELD_GROUP, .section = &mesh_loss_section, .offset = 0,
     .need = GM_NEED_DEFAULT, .help = "how its loss is computed"},
    END};
static const gm_section mesh_section = {
    .title = "meshes", .word = "mesh", .help = "Pairs of gears that mesh.",
    .fields = mesh_fields, .size = sizeof(gm_mesh), .key = GM_KEY_NAME,
    .label = offsetof(gm_mesh, id)};
#undef OWNER

#define OWNER gm_bearing
static const gm_field bearing_fields[] = {
    {.key = "shaft", .type = GM_FIELD_REFERENCE, .section = &shaft_section, AT(shaft),
     .help = "the shaft that it carries"},
    {.key = "on", .type = GM_FIELD_REFERENCE, .section = &shaft_section, AT(on), OPTIONAL,
     .help = "housing, or the concentric shaft that holds the other ring"},
    {NUMBER("position_mm", -5000, 5000), AT(position), .help = "x of its middle"},
    {.key = "locating", .type = GM_FIELD_BOOLEAN, AT(locating), DEFAULT("false"),
     .help = "true: takes axial load"},
    {.key = "data", .type = GM_FIELD_INLINE, .section = &bearing_data_section, AT(data),
     .help = ""},
    {NUMBER("radial_stiffness_N_um", 0, 1e5), ABOVE, AT(radial_stiffness), DEFAULT("300"),
     .help = "matters where three or more bearings carry a shaft"},
    {NUMBER("axial_stiffness_N_um", 0, 1e5), ABOVE, AT(axial_stiffness), DEFAULT("100"),
     .help = "matters where two or more bearings are locating"},
    END};
static const gm_section bearing_section = {
    .title = "bearings", .word = "bearing",
    .help = "Rolling bearings that carry the shafts. Every shaft needs two, one of them "
            "locating.",
    .fields = bearing_fields, .size = sizeof(gm_bearing), .key = GM_KEY_NAME,
    .label = offsetof(gm_bearing, id)};
#undef OWNER

static const gm_choice seal_models[] = {
    {"iso14179_2", GM_SEAL_ISO14179_2},
    {"iso14179_1_fpm", GM_SEAL_ISO14179_1_FPM},
    {"iso14179_1_nbr", GM_SEAL_ISO14179_1_NBR},
    {"linke", GM_SEAL_LINKE},
    {NULL, 0}};

#define OWNER gm_seal
static const gm_field seal_fields[] = {
    {.key = "shaft", .type = GM_FIELD_REFERENCE, .section = &shaft_section, AT(shaft),
     .help = "the shaft on which its lip slides"},
    {.key = "on", .type = GM_FIELD_REFERENCE, .section = &shaft_section, AT(on), OPTIONAL,
     .help = "housing, or the concentric shaft that holds it"},
    {NUMBER("diameter_mm", 0, 1000), ABOVE, AT(diameter), .help = "where the lip slides"},
    {.key = "model", .type = GM_FIELD_CHOICE, .choices = seal_models, AT(model),
     DEFAULT("iso14179_2"), .help = "friction model"},
    END};
static const gm_section seal_section = {
    .title = "seals", .word = "seal", .help = "Radial shaft seals.",
    .fields = seal_fields, .size = sizeof(gm_seal), .key = GM_KEY_NAME,
    .label = offsetof(gm_seal, id)};
#undef OWNER

#define OWNER gm_gap
static const gm_field gap_fields[] = {
    {.key = "inner", .type = GM_FIELD_REFERENCE, .section = &shaft_section, AT(inner),
     .help = "the inner shaft"},
    {.key = "outer", .type = GM_FIELD_REFERENCE, .section = &shaft_section, AT(outer),
     .help = "the hollow shaft around it"},
    {NUMBER("radius_mm", 0, 1000), ABOVE, AT(radius), .help = "mean radius of the film"},
    {NUMBER("length_mm", 0, 5000), ABOVE, AT(length), .help = "length of the film"},
    {NUMBER("clearance_mm", 0, 50), ABOVE, AT(clearance), .help = "radial thickness"},
    END};
static const gm_section gap_section = {
    .title = "gaps", .word = "gap", .help = "Oil films between concentric shafts.",
    .fields = gap_fields, .size = sizeof(gm_gap), .key = GM_KEY_NAME,
    .label = offsetof(gm_gap, id)};
#undef OWNER

#define OWNER gm_synchroniser
static const gm_field synchroniser_fields[] = {
    {.key = "shaft", .type = GM_FIELD_REFERENCE, .section = &shaft_section, AT(shaft),
     .help = "the shaft on which it sits"},
    {.key = "gears", .type = GM_FIELD_REFERENCES, .section = &gear_section, AT(wheels),
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
    END};
static const gm_section synchroniser_section = {
    .title = "synchronisers", .word = "synchroniser",
    .help = "Synchronisers lock idling gears to their shaft.",
    .fields = synchroniser_fields, .size = sizeof(gm_synchroniser), .key = GM_KEY_NAME,
    .label = offsetof(gm_synchroniser, id)};
#undef OWNER

#define OWNER gm_path_gear
static const gm_field path_gear_fields[] = {
    {.key = "lock", .type = GM_FIELD_REFERENCE, .section = &gear_section, AT(wheel),
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
    {.key = "shaft", .type = GM_FIELD_REFERENCE, .section = &shaft_section, AT(shaft),
     .help = "the shaft with the input flange"},
    {.key = "gears", .type = GM_FIELD_ITEMS, .section = &path_gear_section, AT(gears),
     .count_offset = offsetof(gm_path_part, n_gears),
     .help = "what it can be shifted to"},
    END};
static const gm_section path_section = {
    .title = "paths", .word = "path",
    .help = "Ways from an input flange to the output: odd and even, or one named input.",
    .fields = path_fields, .size = sizeof(gm_path_part), .key = GM_KEY_NAME,
    .label = offsetof(gm_path_part, id)};
#undef OWNER

#define OWNER gm_description
#define PARTS(name, part, list, count)                                                   \
    .key = name, .type = GM_FIELD_ITEMS, .section = &part, AT(list),                     \
    .count_offset = offsetof(gm_description, count)
static const gm_field root_fields[] = {
    {INTEGER("format", 1, 1), AT(format), .help = "version of this format"},
    {.key = "name", .type = GM_FIELD_WORDS, AT(name),
     .help = "short name of the gearset"},
    {.key = "title", .type = GM_FIELD_TEXT, AT(title), DEFAULT(""),
     .help = "one line that says what it is"},
    {.key = "limits", .type = GM_FIELD_GROUP, .section = &limit_section, .offset = 0,
     .help = "largest speed and torque"},
    {.key = "oil", .type = GM_FIELD_GROUP, .section = &oil_section, AT(oil),
     .help = "lubricant"},
    {PARTS("shafts", shaft_section, shafts, n_shafts),
     .help = "what turns, all parallel to x"},
    {PARTS("gears", gear_section, wheels, n_wheels), .help = "gear wheels"},
    {PARTS("meshes", mesh_section, meshes, n_meshes), .help = "which gears mesh"},
    {PARTS("bearings", bearing_section, bearings, n_bearings),
     .help = "what carries the shafts"},
    {PARTS("seals", seal_section, seals, n_seals), OPTIONAL,
     .help = "radial shaft seals"},
    {PARTS("gaps", gap_section, gaps, n_gaps), OPTIONAL,
     .help = "oil films between concentric shafts"},
    {PARTS("synchronisers", synchroniser_section, synchronisers, n_synchronisers),
     OPTIONAL, .help = "what locks idling gears"},
    {PARTS("paths", path_section, paths, n_paths), .fixed_count = GM_MAX_INPUT_PATHS,
     .help = "odd and even, or input"},
    {.key = "output", .type = GM_FIELD_REFERENCE, .section = &shaft_section, AT(output),
     .help = "the shaft with the output flange"},
    END};
static const gm_section root_section = {
    .title = "description", .word = "description",
    .help = "One gearset: everything between the input flanges and the output flange. "
            "Coordinates: x along the shafts, y to the side, z upwards; a positive "
            "rotation is about +x.",
    .fields = root_fields, .size = sizeof(gm_description)};
#undef OWNER
/* clang-format on */

const gm_section *gm_schema_root(void)
{
    return &root_section;
}

static bool ends_with(const char *text, const char *end)
{
    size_t n = strlen(text), m = strlen(end);
    return n > m && strcmp(text + n - m, end) == 0;
}

const gm_unit *gm_schema_unit(const char *key)
{
    const gm_unit *best = &units[0];
    for (size_t i = 1; i < sizeof units / sizeof units[0]; i++)
        if (ends_with(key, units[i].suffix) &&
            strlen(units[i].suffix) > strlen(best->suffix))
            best = &units[i];
    return best;
}

double gm_unit_to_si(const gm_unit *unit, double value)
{
    return (value + unit->offset) * unit->factor / unit->divisor;
}

const gm_field *gm_schema_find(const gm_section *section, const char *key, size_t *offset)
{
    for (const gm_field *f = section->fields; f->key; f++) {
        if (f->type == GM_FIELD_INLINE) {
            size_t inner = 0;
            const gm_field *found = gm_schema_find(f->section, key, &inner);
            if (found) {
                *offset = f->offset + inner;
                return found;
            }
        } else if (strcmp(f->key, key) == 0) {
            *offset = f->offset;
            return f;
        }
    }
    return NULL;
}

int gm_schema_keys(const gm_section *section, const char **keys, int max)
{
    int n = 0;
    for (const gm_field *f = section->fields; f->key && n < max; f++) {
        if (f->type == GM_FIELD_INLINE)
            n += gm_schema_keys(f->section, keys + n, max - n);
        else
            keys[n++] = f->key;
    }
    return n;
}
