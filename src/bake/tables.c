/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/tables.h"

#include "base/alloc.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* An array that is already in the text. */
typedef struct written_array {
    const double *data;
    int n;
    char name[64];
} written_array;

typedef struct writer {
    const gm_map *map;
    const gm_reduced_map *reduced;
    gm_buffer *text;
    int n_arrays, room;
    written_array *arrays;
} writer;

static const char *const direction_name[2] = {"forward", "backward"};
static const char *const direction_index[2] = {"GM_FORWARD", "GM_BACKWARD"};

/* Part of a C name for a gear: "1", "r" for reverse, "n" for neutral. */
static const char *gear_word(const gm_map *map, int p, int g, char word[16])
{
    if (g < 0)
        snprintf(word, 16, "n");
    else if (map->paths[p].gears[g].number < 0)
        snprintf(word, 16, "r");
    else
        snprintf(word, 16, "%d", map->paths[p].gears[g].number);
    return word;
}

static const written_array *find_array(const writer *w, const double *data, int n)
{
    for (int i = 0; i < w->n_arrays; i++)
        if (w->arrays[i].n == n &&
            (w->arrays[i].data == data ||
             memcmp(w->arrays[i].data, data, (size_t)n * sizeof *data) == 0))
            return &w->arrays[i];
    return NULL;
}

static written_array *new_array(writer *w)
{
    if (w->n_arrays == w->room) {
        int room = 2 * w->room + 64;
        written_array *arrays = gm_resize(w->arrays, (size_t)room, sizeof *arrays);
        if (!arrays) {
            w->text->failed = true;
            return NULL;
        }
        w->arrays = arrays;
        w->room = room;
    }
    return &w->arrays[w->n_arrays++];
}

/* Write an array of rows x n numbers, unless its like is there already. */
static void write_array(writer *w, const char *name, const char *comment,
                        const double *data, int rows, int n)
{
    if (find_array(w, data, rows * n))
        return;
    written_array *a = new_array(w);
    if (!a)
        return;
    *a = (written_array){.data = data, .n = rows * n};
    snprintf(a->name, sizeof a->name, "%s", name);
    gm_buffer_text(w->text, "\n/* %s */\nstatic const gm_real %s[%d * %d] = {", comment,
                   name, rows, n);
    for (int i = 0; i < rows * n; i++) {
        gm_buffer_text(w->text, i % n == 0 || i % n % 4 == 0 ? "\n    " : " ");
        gm_buffer_number(w->text, data[i]);
        gm_buffer_text(w->text, ",");
    }
    gm_buffer_text(w->text, "\n};\n");
}

static const char *array_name(const writer *w, const double *data, int n)
{
    const written_array *a = find_array(w, data, n);
    return a ? a->name : "0"; /* 0 only after a failed allocation */
}

/* What a table holds, for its comments. */
typedef struct meaning {
    const char *axis[3]; /* with unit */
    const char *value;
} meaning;

static const meaning load_loss_meaning = {
    {"speed of the path [rad/s]", "torque in the direction of rotation [N.m]", NULL},
    "load loss [N.m at the input flange]"};
static const meaning pin_meaning = {{"speed of the path [rad/s]", NULL, NULL},
                                    "drag of the input side [N.m at the input flange]"};
static const meaning drag_meaning = {
    {"speed of the path [rad/s]", "speed of the output [rad/s]", NULL},
    "drag of the neutral shaft [N.m at the input flange]"};
static const meaning reaction_meaning = {
    {"speed of the path [rad/s]", "speed of the output [rad/s]", NULL},
    "reaction of the drag [N.m at the output]"};
static const meaning jump_meaning = {{"speed of the output [rad/s]", NULL, NULL},
                                     "jump of the drag [N.m at the input flange]"};
static const meaning parasitic_meaning = {{"speed of the output [rad/s]", NULL, NULL},
                                          "parasitic loss [N.m at the output]"};
static const meaning both_meaning = {
    {"speed of the output [rad/s]", "torque of path 0 [N.m]", "torque of path 1 [N.m]"},
    "correction with both paths loaded [N.m at the output]"};
static const meaning coupling_meaning = {
    {"relative speed of the input shafts [rad/s]", NULL, NULL},
    "drag between the input shafts [N.m]"};

static void write_axes(writer *w, const char *name, const meaning *m, int n_axes,
                       const gm_axis *const *axis, const double *value)
{
    char array[80], comment[200];
    int rows = 1;
    for (int a = 0; a < n_axes; a++) {
        snprintf(array, sizeof array, "%s_%c", name, "xyz"[a]);
        write_array(w, array, m->axis[a], axis[a]->x, 1, axis[a]->n);
        rows *= a + 1 < n_axes ? axis[a]->n : 1;
    }
    int n = axis[n_axes - 1]->n;
    if (n_axes == 1)
        snprintf(comment, sizeof comment, "%s, [%d]", m->value, n);
    else
        snprintf(comment, sizeof comment, "%s, [%d][%d]", m->value, rows, n);
    write_array(w, name, comment, value, rows, n);
}

static void data1(writer *w, const char *name, const meaning *m, const gm_table1 *t)
{
    const gm_axis *axis[] = {&t->x};
    if (t->value)
        write_axes(w, name, m, 1, axis, t->value);
}

static void data2(writer *w, const char *name, const meaning *m, const gm_table2 *t)
{
    const gm_axis *axis[] = {&t->x, &t->y};
    if (t->value)
        write_axes(w, name, m, 2, axis, t->value);
}

static void data3(writer *w, const char *name, const meaning *m, const gm_table3 *t)
{
    const gm_axis *axis[] = {&t->x, &t->y, &t->z};
    if (t->value)
        write_axes(w, name, m, 3, axis, t->value);
}

static void write_axis(const writer *w, char letter, const gm_axis *axis)
{
    gm_buffer_text(w->text, ".%c = {.n = %d, .x = %s}, ", letter, axis->n,
                   array_name(w, axis->x, axis->n));
}

static void struct1(const writer *w, const gm_table1 *t)
{
    if (!t->value) {
        gm_buffer_text(w->text, "{.value = 0}");
        return;
    }
    gm_buffer_text(w->text, "{");
    write_axis(w, 'x', &t->x);
    gm_buffer_text(w->text, ".value = %s%s}", array_name(w, t->value, t->x.n),
                   t->monotone ? ", .monotone = 1" : "");
}

static void struct2(const writer *w, const gm_table2 *t)
{
    if (!t->value) {
        gm_buffer_text(w->text, "{.value = 0}");
        return;
    }
    gm_buffer_text(w->text, "{");
    write_axis(w, 'x', &t->x);
    write_axis(w, 'y', &t->y);
    gm_buffer_text(w->text, ".value = %s%s}", array_name(w, t->value, t->x.n * t->y.n),
                   t->monotone ? ", .monotone = 1" : "");
}

static void struct3(const writer *w, const gm_table3 *t)
{
    if (!t->value) {
        gm_buffer_text(w->text, "{.value = 0}");
        return;
    }
    gm_buffer_text(w->text, "{");
    write_axis(w, 'x', &t->x);
    write_axis(w, 'y', &t->y);
    write_axis(w, 'z', &t->z);
    gm_buffer_text(w->text, ".value = %s}",
                   array_name(w, t->value, t->x.n * t->y.n * t->z.n));
}

static void gear_data(writer *w, int p)
{
    const gm_path *path = &w->reduced->path[p];
    char name[64], word[16];
    for (int g = 0; g < path->n_gears; g++)
        for (int d = 0; d < 2; d++) {
            snprintf(name, sizeof name, "load_loss_%d_%s_%s", p,
                     gear_word(w->map, p, g, word), direction_name[d]);
            data2(w, name, &load_loss_meaning, &path->gears[g].load_loss[d]);
            snprintf(name, sizeof name, "pin_%d_%s_%s", p, gear_word(w->map, p, g, word),
                     direction_name[d]);
            data1(w, name, &pin_meaning, &path->gears[g].pin[d]);
        }
}

static void drag_data(writer *w, int p)
{
    const gm_path *path = &w->reduced->path[p];
    char name[64];
    for (int i = 0; i < 4; i++) {
        const char *of_path = direction_name[i / 2], *of_output = direction_name[i % 2];
        snprintf(name, sizeof name, "drag_%d_%s_%s", p, of_path, of_output);
        data2(w, name, &drag_meaning, &path->drag[i / 2][i % 2]);
        snprintf(name, sizeof name, "reaction_%d_%s_%s", p, of_path, of_output);
        data2(w, name, &reaction_meaning, &path->reaction[i / 2][i % 2]);
    }
    for (int l = 0; l < path->n_lines; l++)
        for (int d = 0; d < 2; d++) {
            snprintf(name, sizeof name, "jump_%d_%d_%s", p, l, direction_name[d]);
            data1(w, name, &jump_meaning, &path->lines[l].jump[d]);
        }
}

static void configuration_data(writer *w)
{
    for (int i = 0; i < w->reduced->n_configurations; i++) {
        const gm_configuration *c = &w->reduced->configurations[i];
        char name[64], word[2][16];
        gear_word(w->map, 0, c->gear[0], word[0]);
        if (w->reduced->n_paths > 1)
            gear_word(w->map, 1, c->gear[1], word[1]);
        else
            word[1][0] = '\0';
        for (int d = 0; d < 2; d++) {
            snprintf(name, sizeof name, "parasitic_%s_%s_%s", word[0], word[1],
                     direction_name[d]);
            data1(w, name, &parasitic_meaning, &c->parasitic[d]);
            snprintf(name, sizeof name, "both_loaded_%s_%s_%s", word[0], word[1],
                     direction_name[d]);
            data3(w, name, &both_meaning, &c->both_loaded[d]);
        }
    }
}

/* N.m/rad, N.m.s/rad, rad */
static void compliance_fields(const writer *w, const gm_gear *gear)
{
    gm_buffer_text(w->text, ",\n     .stiffness = ");
    gm_buffer_number(w->text, gear->stiffness);
    gm_buffer_text(w->text, ", .damping = ");
    gm_buffer_number(w->text, gear->damping);
    gm_buffer_text(w->text, ", .lash = ");
    gm_buffer_number(w->text, gear->lash);
    gm_buffer_text(w->text, ", .film = ");
    gm_buffer_number(w->text, gear->film);
    gm_buffer_text(w->text, ", .pin = {\n");
    for (int d = 0; d < 2; d++) {
        gm_buffer_text(w->text, "        [%s] = ", direction_index[d]);
        struct1(w, &gear->pin[d]);
        gm_buffer_text(w->text, ",\n");
    }
    gm_buffer_text(w->text, "    }");
}

static void gear_structs(const writer *w, int p)
{
    const gm_path *path = &w->reduced->path[p];
    if (path->n_gears == 0)
        return;
    gm_buffer_text(w->text,
                   "\n/* ratio: speed of the path / speed of the output */\n"
                   "static const gm_gear gears_%d[%d] = {\n",
                   p, path->n_gears);
    for (int g = 0; g < path->n_gears; g++) {
        gm_buffer_text(w->text, "    {.number = %d, .ratio = ", path->gears[g].number);
        gm_buffer_number(w->text, path->gears[g].ratio);
        compliance_fields(w, &path->gears[g]);
        gm_buffer_text(w->text, ", .inertia_extra = ");
        gm_buffer_number(w->text, path->gears[g].inertia_extra);
        gm_buffer_text(w->text, ", .load_loss = {\n");
        for (int d = 0; d < 2; d++) {
            gm_buffer_text(w->text, "        [%s] = ", direction_index[d]);
            struct2(w, &path->gears[g].load_loss[d]);
            gm_buffer_text(w->text, ",\n");
        }
        gm_buffer_text(w->text, "    }},\n");
    }
    gm_buffer_text(w->text, "};\n");
}

static void line_structs(const writer *w, int p)
{
    const gm_path *path = &w->reduced->path[p];
    if (path->n_lines == 0)
        return;
    gm_buffer_text(w->text, "\nstatic const gm_drag_line lines_%d[%d] = {\n", p,
                   path->n_lines);
    for (int l = 0; l < path->n_lines; l++) {
        gm_buffer_text(w->text, "    {.ratio = ");
        gm_buffer_number(w->text, path->lines[l].ratio);
        for (int d = 0; d < 2; d++) {
            gm_buffer_text(w->text, "%s        [%s] = ", d ? ",\n" : ", .jump = {\n",
                           direction_index[d]);
            struct1(w, &path->lines[l].jump[d]);
        }
        gm_buffer_text(w->text, "}},\n");
    }
    gm_buffer_text(w->text, "};\n");
}

static void configuration_structs(const writer *w)
{
    gm_buffer_text(w->text,
                   "\n/* gear: index into gears_<path>, -1 neutral */\n"
                   "static const gm_configuration configurations[%d] = {\n",
                   w->reduced->n_configurations);
    for (int i = 0; i < w->reduced->n_configurations; i++) {
        const gm_configuration *c = &w->reduced->configurations[i];
        gm_buffer_text(w->text, "    {.gear = {%d, %d},\n     .parasitic = {\n",
                       c->gear[0], c->gear[1]);
        for (int d = 0; d < 2; d++) {
            gm_buffer_text(w->text, "        [%s] = ", direction_index[d]);
            struct1(w, &c->parasitic[d]);
            gm_buffer_text(w->text, ",\n");
        }
        gm_buffer_text(w->text, "     },\n     .both_loaded = {\n");
        for (int d = 0; d < 2; d++) {
            gm_buffer_text(w->text, "        [%s] = ", direction_index[d]);
            struct3(w, &c->both_loaded[d]);
            gm_buffer_text(w->text, ",\n");
        }
        gm_buffer_text(w->text, "     }},\n");
    }
    gm_buffer_text(w->text, "};\n");
}

static void drag_struct(const writer *w, const char *field, const gm_table2 table[2][2])
{
    gm_buffer_text(w->text, "         .%s = {\n", field);
    for (int i = 0; i < 4; i++) {
        gm_buffer_text(w->text, "             %s[%s] = ",
                       i % 2 ? ""
                       : i   ? "[GM_BACKWARD] = {"
                             : "[GM_FORWARD] = {",
                       direction_index[i % 2]);
        struct2(w, &table[i / 2][i % 2]);
        gm_buffer_text(w->text, i % 2 ? "},\n" : ",\n");
    }
    gm_buffer_text(w->text, "         },\n");
}

static void path_struct(const writer *w, int p)
{
    const gm_path *path = &w->reduced->path[p];
    gm_buffer_text(w->text, "        {.inertia = ");
    gm_buffer_number(w->text, path->inertia);
    gm_buffer_text(w->text, ", /* kg.m2 */\n         .sync_torque = ");
    gm_buffer_number(w->text, path->sync_torque < 1e30 ? path->sync_torque : 1e30);
    gm_buffer_text(w->text, ", /* N.m at the input flange */\n         .n_gears = %d,\n",
                   path->n_gears);
    if (path->n_gears > 0)
        gm_buffer_text(w->text, "         .gears = gears_%d,\n", p);
    drag_struct(w, "drag", path->drag);
    drag_struct(w, "reaction", path->reaction);
    gm_buffer_text(w->text, "         .n_lines = %d,\n", path->n_lines);
    if (path->n_lines > 0)
        gm_buffer_text(w->text, "         .lines = lines_%d,\n", p);
    gm_buffer_text(w->text, "        },\n");
}

static void map_struct(const writer *w)
{
    gm_buffer_text(w->text,
                   "\nstatic const gm_reduced_map gm_tables_map = {\n"
                   "    .n_paths = %d,\n    .path = {\n",
                   w->reduced->n_paths);
    for (int p = 0; p < w->reduced->n_paths; p++)
        path_struct(w, p);
    gm_buffer_text(w->text,
                   "    },\n    .n_configurations = %d,\n"
                   "    .configurations = configurations,\n    .coupling = ",
                   w->reduced->n_configurations);
    struct1(w, &w->reduced->coupling);
    gm_buffer_text(w->text, ",\n    .inertia_output = ");
    gm_buffer_number(w->text, w->reduced->inertia_output);
    gm_buffer_text(w->text, ", /* kg.m2 */\n    .oil_temperature = ");
    gm_buffer_number(w->text, w->reduced->oil_temperature);
    gm_buffer_text(w->text, ", /* K */\n};\n\n#endif\n");
}

/* A hash as it may stand in a comment, whatever the map says. */
static const char *hex_text(const char hash[65], char text[65])
{
    size_t n = strspn(hash, "0123456789abcdef");
    if (n == 0)
        return "unknown";
    snprintf(text, 65, "%.*s", (int)n, hash);
    return text;
}

static void head(const writer *w, const char *guid)
{
    const gm_map *map = w->map;
    char input[65], content[65];
    gm_buffer_text(
        w->text,
        "/* Generated by gearmap %s from a description with SHA-256\n"
        " * %s,\n * map content %s,\n"
        " * %d path%s, %d configurations, SI units. Data only; do not edit. */\n"
        "#ifndef GM_TABLES_H\n#define GM_TABLES_H\n\n"
        "#include \"gm_reduced.h\"\n\n#define GM_TABLES_GUID \"%s\"\n\n"
        "static const char *const gm_tables_path_names[%d] = {",
        GM_VERSION, hex_text(map->input_sha256, input),
        hex_text(map->content_hash, content), map->n_paths, map->n_paths > 1 ? "s" : "",
        w->reduced->n_configurations, guid, map->n_paths);
    for (int p = 0; p < map->n_paths; p++)
        gm_buffer_text(w->text, "%s\"%s\"", p ? ", " : "", map->paths[p].name);
    gm_buffer_text(w->text, "};\n");
}

gm_status gm_tables_write(const gm_map *map, const gm_reduced_map *reduced,
                          const char *guid, gm_buffer *buffer, gm_error *error)
{
    writer w = {.map = map, .reduced = reduced, .text = buffer};
    head(&w, guid);
    for (int p = 0; p < map->n_paths; p++) {
        gear_data(&w, p);
        drag_data(&w, p);
    }
    configuration_data(&w);
    data1(&w, "coupling", &coupling_meaning, &reduced->coupling);
    for (int p = 0; p < map->n_paths; p++) {
        gear_structs(&w, p);
        line_structs(&w, p);
    }
    configuration_structs(&w);
    map_struct(&w);
    gm_free(w.arrays);
    return buffer->failed ? gm_fail(error, GM_ERR_MEMORY, "no memory to write the tables")
                          : GM_OK;
}
