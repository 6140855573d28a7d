/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The tables of the description file: shafts, and what sits on them besides gears and
 * bearings.
 */
#include "model/schema_fields.h"

#include "model/gm_description.h"

/* clang-format off */

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

static const gm_choice torsion_models[] = {{"rigid", GM_TORSION_RIGID},
                                           {"elastic", GM_TORSION_ELASTIC},
                                           {NULL, 0}};

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
    {.key = "torsion", .type = GM_FIELD_CHOICE, .choices = torsion_models, AT(torsion),
     DEFAULT("rigid"),
     .help = "elastic: in motion over time it twists between its gears and its flange"},
    {NUMBER("torsion_damping_ratio", 0, 2), AT(torsion_damping), DEFAULT("0.02"),
     ONLY("torsion", "elastic"), .help = "of each piece between two gears"},
    {NUMBER("flange_mm", -5000, 5000), AT(flange), OPTIONAL, ONLY("torsion", "elastic"),
     .help = "x of the flange of an input or output shaft; default: the end with the "
             "lower x"},
    END};
const gm_section gm_schema_shaft = {
    .title = "shafts", .word = "shaft",
    .help = "Shafts, all parallel to x. A differential cage or a sleeve that carries "
            "several gears is a shaft too.",
    .fields = shaft_fields, .size = sizeof(gm_shaft), .key = GM_KEY_NAME,
    .label = offsetof(gm_shaft, id), .collection = "shafts"};
#undef OWNER

static const gm_choice seal_models[] = {
    {"iso14179_2", GM_SEAL_ISO14179_2},
    {"iso14179_1_fpm", GM_SEAL_ISO14179_1_FPM},
    {"iso14179_1_nbr", GM_SEAL_ISO14179_1_NBR},
    {"linke", GM_SEAL_LINKE},
    {NULL, 0}};

#define OWNER gm_seal
static const gm_field seal_fields[] = {
    {.key = "shaft", .type = GM_FIELD_REFERENCE, .section = &gm_schema_shaft, AT(shaft),
     .help = "the shaft on which its lip slides"},
    {.key = "on", .type = GM_FIELD_REFERENCE, .section = &gm_schema_shaft, AT(on),
     OPTIONAL, .help = "housing, or the concentric shaft that holds it"},
    {NUMBER("diameter_mm", 0, 1000), ABOVE, AT(diameter), .help = "where the lip slides"},
    {.key = "model", .type = GM_FIELD_CHOICE, .choices = seal_models, AT(model),
     DEFAULT("iso14179_2"), .help = "friction model"},
    END};
const gm_section gm_schema_seal = {
    .title = "seals", .word = "seal", .help = "Radial shaft seals.",
    .fields = seal_fields, .size = sizeof(gm_seal), .key = GM_KEY_NAME,
    .label = offsetof(gm_seal, id)};
#undef OWNER

#define OWNER gm_gap
static const gm_field gap_fields[] = {
    {.key = "inner", .type = GM_FIELD_REFERENCE, .section = &gm_schema_shaft, AT(inner),
     .help = "the inner shaft"},
    {.key = "outer", .type = GM_FIELD_REFERENCE, .section = &gm_schema_shaft, AT(outer),
     .help = "the hollow shaft around it"},
    {NUMBER("radius_mm", 0, 1000), ABOVE, AT(radius), .help = "mean radius of the film"},
    {NUMBER("length_mm", 0, 5000), ABOVE, AT(length), .help = "length of the film"},
    {NUMBER("clearance_mm", 0, 50), ABOVE, AT(clearance), .help = "radial thickness"},
    END};
const gm_section gm_schema_gap = {
    .title = "gaps", .word = "gap", .help = "Oil films between concentric shafts.",
    .fields = gap_fields, .size = sizeof(gm_gap), .key = GM_KEY_NAME,
    .label = offsetof(gm_gap, id)};
#undef OWNER
/* clang-format on */
