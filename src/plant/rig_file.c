/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The tables of the rig file, and its reading by the reader of descriptions.
 */
#include "plant/gm_rig_file.h"

#include "base/alloc.h"
#include "base/sha256.h"
#include "model/description_fields.h"
#include "model/schema_fields.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_GEARS = 32 };

/* clang-format off */

static const gm_choice signs[] = {{"plus", 1}, {"minus", -1}, {NULL, 0}};
static const gm_choice drives[] = {
    {"torque", GM_RIG_TORQUE_IN}, {"speed", GM_RIG_SPEED_IN}, {NULL, 0}};
static const gm_choice interfaces[] = {
    {"any", GM_RIG_ANY}, {"co_simulation", GM_RIG_CO_SIMULATION},
    {"model_exchange", GM_RIG_MODEL_EXCHANGE}, {NULL, 0}};

#define OWNER gm_rig_signal
static const gm_field signal_fields[] = {
    {.key = "variable", .type = GM_FIELD_TEXT, AT(variable),
     .help = "name of the model's variable"},
    {.key = "unit", .type = GM_FIELD_TEXT, AT(unit), DEFAULT(""),
     .help = "its unit, such as rpm, kN.m, degC; without it that of the "
             "modelDescription, else SI"},
    {.key = "sign", .type = GM_FIELD_CHOICE, .choices = signs, AT(sign), DEFAULT("plus"),
     .help = "minus where the model counts the other way, such as torque out of the "
             "flange"},
    END};
static const gm_section signal = {
    .title = "variable", .word = "variable", .help = "One variable of the model.",
    .fields = signal_fields};
#undef OWNER

#define OWNER gm_rig_flange
#define SIGNAL(name, member, words)                                                      \
    {.key = name, .type = GM_FIELD_GROUP, .section = &signal, OPTIONAL, AT(member),      \
     .help = words}
static const gm_field flange_fields[] = {
    {.key = "drive", .type = GM_FIELD_CHOICE, .choices = drives, AT(drive),
     DEFAULT("torque"),
     .help = "what the model takes at this flange; it answers the other one"},
    SIGNAL("torque", torque, "torque at the flange, into the gearset"),
    SIGNAL("speed", speed, "speed of the flange"),
    SIGNAL("angle", angle, "angle of the flange, where the model takes it too"),
    END};
static const gm_section flange = {
    .title = "output", .word = "output",
    .help = "A flange. The variables are those of an FMU; a plug-in has none.",
    .fields = flange_fields};
#undef OWNER

#define OWNER gm_rig_gear
static const gm_field gear_fields[] = {
    {NUMBER("ratio", -1000, 1000), AT(ratio), OPTIONAL,
     .help = "input speed over output speed, negative if they turn in opposite "
             "directions; what the model makes must be this within 0.001 of it"},
    {NUMBER("command", -1e6, 1e6), AT(command), OPTIONAL,
     .help = "value of the gear's variable; default: the gear's number"},
    END};
static const gm_section gear = {
    .title = "gears", .word = "gear",
    .help = "Gears of a path by number: -1 reverse, 1 and up forward.",
    .fields = gear_fields, .size = sizeof(gm_rig_gear), .key = GM_KEY_INTEGER,
    .label = offsetof(gm_rig_gear, number), .line = offsetof(gm_rig_gear, line),
    .low = -1, .high = 30};
#undef OWNER

#define OWNER gm_rig_path
static const gm_field path_fields[] = {
    {.key = "flange", .type = GM_FIELD_INLINE, .section = &flange, AT(flange)},
    SIGNAL("gear", gear, "variable that commands the gear"),
    {.key = "neutral", .type = GM_FIELD_BOOLEAN, AT(neutral), DEFAULT("true"),
     .help = "whether the path can be shifted to neutral"},
    {NUMBER("neutral_command", -1e6, 1e6), AT(neutral_command), DEFAULT("0"),
     .help = "value of the gear's variable in neutral"},
    {NUMBER("sync_torque_Nm", 0, 1e6), ABOVE, AT(sync_torque), DEFAULT("40"),
     .help = "friction torque of its synchronisers at the input flange"},
    {NUMBER("inertia_kgm2", 0, 1e4), ABOVE, AT(inertia), OPTIONAL,
     .help = "inertia that turns with the input flange; default: measured in neutral"},
    {.key = "gears", .type = GM_FIELD_ITEMS, .section = &gear, AT(gears),
     .count_offset = offsetof(gm_rig_path, n_gears), .help = "what it can be shifted to"},
    END};
static const gm_section path_section = {
    .title = "paths", .word = "path",
    .help = "Ways from an input flange to the output: odd and even, or one named input.",
    .fields = path_fields, .size = sizeof(gm_rig_path), .key = GM_KEY_NAME,
    .label = offsetof(gm_rig_path, id)};
#undef OWNER

#define OWNER gm_rig_parameter
static const gm_field parameter_fields[] = {
    {NUMBER("value", -1e300, 1e300), AT(value), .help = "in the model's unit"},
    {.key = "variable", .type = GM_FIELD_TEXT, AT(variable), DEFAULT(""),
     .help = "its name in the model, where that is more than letters, digits and _"},
    END};
static const gm_section parameter = {
    .title = "parameters", .word = "parameter",
    .help = "Parameters and constant inputs of the model by name.",
    .fields = parameter_fields, .size = sizeof(gm_rig_parameter), .key = GM_KEY_NAME,
    .label = offsetof(gm_rig_parameter, id)};
#undef OWNER

static const gm_choice losses_by[] = {{"settle", 0}, {"ramp", 1}, {NULL, 0}};
#define OWNER gm_rig_experiments
static const gm_field experiment_fields[] = {
    {.key = "losses", .type = GM_FIELD_CHOICE, .choices = losses_by, AT(ramps),
     DEFAULT("settle"),
     .help = "settle: every point is held until nothing changes; ramp: speeds are ramped "
             "through every point, which takes longer"},
    {NUMBER("step_s", 0, 10), AT(step), DEFAULT("0"),
     .help = "commands change and are seen no finer than this; 0: the model's own step, "
             "else 1 ms"},
    {NUMBER("dwell_s", 0, 1000), AT(dwell), DEFAULT("0"),
     .help = "period over which torques and speeds are constant; 0: found by doubling "
             "until the model answers like one inertia"},
    {NUMBER("ramp_time_s", 0, 1000), AT(ramp_time), DEFAULT("0"),
     .help = "of one speed ramp; 0: automatic"},
    {NUMBER("creep_rad_s", 0, 100), ABOVE, AT(creep), DEFAULT("0.2"),
     .help = "standstill is extrapolated from 1, 2 and 3 times this speed, which lies "
             "beyond the band over which the model rounds Coulomb friction"},
    {NUMBER("time_limit_s", 0, 1e5), ABOVE, AT(time_limit), DEFAULT("60"),
     .help = "real time for one steady point; a model that takes longer hangs"},
    {NUMBER("solver_tolerance", 1e-12, 1e-2), AT(tolerance), DEFAULT("1e-7"),
     .help = "relative error of a step in Model Exchange"},
    END};
static const gm_section experiments = {
    .title = "experiments", .word = "experiments", .help = "How the model is measured.",
    .fields = experiment_fields};
#undef OWNER

#define OWNER gm_rig_file
static const gm_field limit_fields[] = {
    {NUMBER("input_speed_max_rpm", 10, 100000), AT(speed_max),
     .help = "largest input speed; the default sweep goes up to it"},
    {NUMBER("input_torque_max_Nm", 0, 100000), ABOVE, AT(torque_max),
     .help = "largest input torque; the default sweep goes up to it"},
    END};
static const gm_section limits = {
    .title = "limits", .word = "limits", .help = "What the gearset is made for.",
    .fields = limit_fields};
static const gm_field root_fields[] = {
    {INTEGER("format", 1, 1), AT(format), .help = "version of this format"},
    {.key = "name", .type = GM_FIELD_WORDS, AT(name),
     .help = "short name of the gearset"},
    {.key = "title", .type = GM_FIELD_TEXT, AT(title), DEFAULT(""),
     .help = "one line that says what it is"},
    {.key = "model", .type = GM_FIELD_TEXT, AT(model),
     .help = "the model's file, beside this file: .fmu, or a compiled plug-in .so"},
    {.key = "interface", .type = GM_FIELD_CHOICE, .choices = interfaces, AT(interface),
     DEFAULT("any"), .help = "of an FMU that has both: any is co_simulation"},
    {.key = "limits", .type = GM_FIELD_GROUP, .section = &limits, .offset = 0,
     .help = "largest speed and torque"},
    {NUMBER("oil_temperature_degC", -50, 200), AT(oil_temperature), DEFAULT("80"),
     .help = "at which it is measured"},
    SIGNAL("oil_temperature", oil, "variable that takes the oil temperature"),
    {.key = "input_shafts_drag", .type = GM_FIELD_BOOLEAN, AT(coupled), DEFAULT("true"),
     .help = "whether two input shafts may drag on each other (concentric shafts)"},
    {.key = "experiments", .type = GM_FIELD_GROUP, .section = &experiments,
     AT(experiments), .need = GM_NEED_DEFAULT, .help = "how it is measured"},
    {.key = "parameters", .type = GM_FIELD_ITEMS, .section = &parameter, AT(parameters),
     .count_offset = offsetof(gm_rig_file, n_parameters), OPTIONAL,
     .help = "values of parameters that differ from the model's own"},
    {.key = "paths", .type = GM_FIELD_ITEMS, .section = &path_section, AT(paths),
     .count_offset = offsetof(gm_rig_file, n_paths), .fixed_count = GM_MAX_INPUT_PATHS,
     .help = "odd and even, or input"},
    {.key = "output", .type = GM_FIELD_GROUP, .section = &flange, AT(output),
     .need = GM_NEED_DEFAULT, .help = "the output flange"},
    END};
static const gm_section root = {
    .title = "rig", .word = "rig",
    .help = "A foreign model of a gearset, an FMU or a plug-in, on the test rig.",
    .fields = root_fields, .size = sizeof(gm_rig_file)};
#undef OWNER
/* clang-format on */

void gm_rig_file_help(void (*write)(void *context, const char *text), void *context)
{
    gm_schema_help(&root, write, context);
}

/* ---- life ---- */

static void clear_signal(gm_rig_signal *s)
{
    gm_free(s->variable);
    gm_free(s->unit);
}

static void clear_flange(gm_rig_flange *f)
{
    clear_signal(&f->torque);
    clear_signal(&f->speed);
    clear_signal(&f->angle);
}

void gm_rig_file_destroy(gm_rig_file *file)
{
    if (!file)
        return;
    for (int p = 0; p < GM_MAX_INPUT_PATHS; p++) {
        clear_flange(&file->paths[p].flange);
        clear_signal(&file->paths[p].gear);
        gm_free(file->paths[p].gears);
    }
    clear_flange(&file->output);
    clear_signal(&file->oil);
    for (int i = 0; i < file->n_parameters && file->parameters; i++)
        gm_free(file->parameters[i].variable);
    gm_free(file->parameters);
    gm_free(file->title);
    gm_free(file->model);
    gm_free(file->model_path);
    gm_free(file);
}

/* ---- rules beyond the tables ---- */

static gm_status check_gears(const char *path, const gm_rig_path *p, gm_error *error)
{
    if (p->n_gears < 1 || p->n_gears > MOST_GEARS)
        return gm_fail(error, GM_ERR_MODEL,
                       "%s:%d: path '%s' has %d gears; 1 to %d are "
                       "possible",
                       path, p->id.line, p->id.name, p->n_gears, MOST_GEARS);
    for (int g = 0; g < p->n_gears; g++)
        if (p->gears[g].number == 0)
            return gm_fail(error, GM_ERR_MODEL,
                           "%s:%d: path '%s': gear 0 is neutral; say `neutral: true`",
                           path, p->gears[g].line, p->id.name);
    if (!p->neutral && p->n_gears > 1)
        return gm_fail(error, GM_ERR_MODEL,
                       "%s:%d: path '%s' has %d gears and no neutral; only one gear can "
                       "do without",
                       path, p->id.line, p->id.name, p->n_gears);
    return GM_OK;
}

static int by_number(const void *a, const void *b)
{
    return ((const gm_rig_gear *)a)->number - ((const gm_rig_gear *)b)->number;
}

static gm_status check_paths(const char *path, gm_rig_file *f, gm_error *error)
{
    int one = f->n_paths == 1 && strcmp(f->paths[0].id.name, "input") == 0;
    if (f->n_paths == 2 && strcmp(f->paths[0].id.name, "even") == 0) {
        gm_rig_path first = f->paths[1];
        f->paths[1] = f->paths[0];
        f->paths[0] = first;
    }
    int two = f->n_paths == 2 && strcmp(f->paths[0].id.name, "odd") == 0 &&
              strcmp(f->paths[1].id.name, "even") == 0;
    if (!one && !two)
        return gm_fail(error, GM_ERR_MODEL,
                       "%s:%d: paths: found '%s'; expected odd and even, or one named "
                       "input",
                       path, f->paths[0].id.line, f->paths[0].id.name);
    gm_status status = GM_OK;
    for (int p = 0; p < f->n_paths && status == GM_OK; p++) {
        status = check_gears(path, &f->paths[p], error);
        if (status == GM_OK)
            qsort(f->paths[p].gears, (size_t)f->paths[p].n_gears, sizeof(gm_rig_gear),
                  by_number);
    }
    return status;
}

/* ---- the model's file ---- */

static char *beside(const char *path, const char *name)
{
    const char *slash = strrchr(path, '/');
    size_t folder = slash && name[0] != '/' ? (size_t)(slash - path) + 1 : 0;
    size_t size = folder + strlen(name) + 3;
    char *joined = gm_calloc(size, 1);
    /* dlopen looks elsewhere for names without a slash */
    if (joined)
        (void)snprintf(joined, size, "%s%.*s%s",
                       folder == 0 && name[0] != '/' ? "./" : "", (int)folder, path,
                       name);
    return joined;
}

/* Both files together say what was measured. */
static gm_status hash_all(gm_rig_file *f, const char *rig_sha256, gm_error *error)
{
    char block[16384];
    size_t n;
    FILE *model = fopen(f->model_path, "rb");
    if (!model)
        return gm_fail(error, GM_ERR_IO, "%s: cannot be opened: %s", f->model_path,
                       strerror(errno));
    gm_sha256 *sum = gm_sha256_create();
    if (sum) {
        gm_sha256_bytes(sum, rig_sha256, strlen(rig_sha256));
        while ((n = fread(block, 1, sizeof block, model)) > 0)
            gm_sha256_bytes(sum, block, n);
        gm_sha256_finish(sum, f->sha256);
        gm_sha256_destroy(sum);
    }
    int bad = ferror(model);
    (void)fclose(model);
    if (!sum)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    return bad ? gm_fail(error, GM_ERR_IO, "%s: cannot be read", f->model_path) : GM_OK;
}

static gm_status read_all(const char *path, gm_rig_file *f, gm_error *error)
{
    char sha256[GM_SHA256_TEXT];
    gm_yaml *tree = NULL;
    gm_status status = gm_yaml_read(path, sha256, &tree, error);
    if (status == GM_OK)
        status = gm_fields_read(path, &root, tree, f, error);
    gm_yaml_destroy(tree);
    if (status == GM_OK)
        status = check_paths(path, f, error);
    if (status != GM_OK)
        return status;
    f->model_path = beside(path, f->model);
    if (!f->model_path)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    return hash_all(f, sha256, error);
}

gm_status gm_rig_file_read(const char *path, gm_rig_file **file, gm_error *error)
{
    gm_rig_file *f = gm_calloc(1, sizeof *f);
    if (!f)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    gm_status status = read_all(path, f, error);
    if (status == GM_OK)
        *file = f;
    else
        gm_rig_file_destroy(f);
    return status;
}

int gm_rig_file_is_one(const char *path)
{
    char sha256[GM_SHA256_TEXT];
    gm_yaml *tree = NULL;
    gm_error ignored;
    if (gm_yaml_read(path, sha256, &tree, &ignored) != GM_OK)
        return 0;
    int is = tree->kind == GM_YAML_MAPPING && gm_yaml_get(tree, "model") != NULL;
    gm_yaml_destroy(tree);
    return is;
}

gm_plant_info gm_rig_file_info(const gm_rig_file *file,
                               gm_plant_gear gears[GM_MAX_INPUT_PATHS][32])
{
    gm_plant_info info = {.name = file->name,
                          .title = file->title,
                          .source_sha256 = file->sha256,
                          .n_paths = file->n_paths,
                          .speed_max = file->speed_max,
                          .torque_max = file->torque_max,
                          .oil_temperature = file->oil_temperature,
                          .coupled = file->n_paths == 2 && file->coupled};
    for (int p = 0; p < file->n_paths; p++) {
        const gm_rig_path *path = &file->paths[p];
        for (int g = 0; g < path->n_gears; g++)
            gears[p][g] = (gm_plant_gear){path->gears[g].number, path->gears[g].ratio};
        info.path[p] = (gm_plant_path){.name = path->id.name,
                                       .n_gears = path->n_gears,
                                       .gears = gears[p],
                                       .always_engaged = !path->neutral,
                                       .sync_torque = path->sync_torque};
    }
    return info;
}
