/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The description file as a whole, the units of its keys, and how tables are searched.
 * The tables of its sections: schema_oil.c, _shafts.c, _bearings.c, _gears.c,
 * _flanks.c, _paths.c.
 */
#include "model/schema.h"

#include "model/gm_description.h"
#include "model/schema_fields.h"

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
    {"_Nm_rad",  "N.m/rad", 0.0,  1.0,  1.0},
    {"_Nms_rad", "N.m.s/rad", 0.0, 1.0, 1.0},
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
    {"_l_min",   "l/min", 0.0,    1.0,  6e4},
    {"_m_s",     "m/s",   0.0,    1.0,  1.0},
    {"_N_K",     "N/K",   0.0,    1.0,  1.0},
    {"_N_m",     "N/m",   0.0,    1.0,  1.0},
    {"_Ns_m",    "N.s/m", 0.0,    1.0,  1.0},
    {"_Nms2_rad2", "N.m.s2/rad2", 0.0, 1.0, 1.0},
    {"_m2",      "m2",    0.0,    1.0,  1.0},
    {"_m_s2",    "m/s2",  0.0,    1.0,  1.0},
    {"_s",       "s",     0.0,    1.0,  1.0},
    {"_rad_s",   "rad/s", 0.0,    1.0,  1.0},
    {"_percent", "%",     0.0,    1.0,  100.0},
};

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
    {.key = "limits", .type = GM_FIELD_GROUP, .section = &gm_schema_limit, .offset = 0,
     .help = "largest speed and torque"},
    {.key = "oil", .type = GM_FIELD_GROUP, .section = &gm_schema_oil, AT(oil),
     .help = "lubricant"},
    {PARTS("shafts", gm_schema_shaft, shafts, n_shafts),
     .help = "what turns, all parallel to x"},
    {PARTS("gears", gm_schema_gear, wheels, n_wheels), .help = "gear wheels"},
    {PARTS("meshes", gm_schema_mesh, meshes, n_meshes), .help = "which gears mesh"},
    {PARTS("bearings", gm_schema_bearing, bearings, n_bearings),
     .help = "what carries the shafts"},
    {PARTS("seals", gm_schema_seal, seals, n_seals), OPTIONAL,
     .help = "radial shaft seals"},
    {PARTS("jets", gm_schema_jet, jets, n_jets), OPTIONAL, .help = "oil jets on gears"},
    {PARTS("gaps", gm_schema_gap, gaps, n_gaps), OPTIONAL,
     .help = "oil films between concentric shafts"},
    {PARTS("synchronisers", gm_schema_synchroniser, synchronisers, n_synchronisers),
     OPTIONAL, .help = "what locks idling gears"},
    {PARTS("clutches", gm_schema_clutch, clutches, n_clutches), OPTIONAL,
     .help = "what locks shafts: clutches and brakes inside the gearset"},
    {PARTS("paths", gm_schema_path, paths, n_paths), .fixed_count = GM_MAX_INPUT_PATHS,
     .help = "odd and even, or input"},
    {.key = "output", .type = GM_FIELD_REFERENCE, .section = &gm_schema_shaft, AT(output),
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

bool gm_schema_has_effect(const gm_field *field, const char *choice)
{
    size_t n = strlen(choice);
    for (const char *at = field->only_word; (at = strstr(at, choice)) != NULL; at += n) {
        bool begins = at == field->only_word || at[-1] == ' ';
        if (begins && (at[n] == '\0' || at[n] == ',' || at[n] == ' '))
            return true;
    }
    return false;
}
