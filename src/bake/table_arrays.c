/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/table_text.h"

#include "base/alloc.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *const direction_name[2] = {"forward", "backward"};

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

/* ---- arrays ---- */

const gm_table_array *gm_table_text_find(const gm_table_text *w, const double *data,
                                         int n, bool is_node)
{
    const bool by_kind = w->style.is_int16; /* else axes and nodes have one type */
    for (int i = 0; i < w->n_arrays; i++) {
        const gm_table_array *a = &w->arrays[i];
        if (a->rows * a->n == n && (!by_kind || a->is_node == is_node) &&
            (a->data == data || memcmp(a->data, data, (size_t)n * sizeof *data) == 0))
            return a;
    }
    return NULL;
}

const char *gm_table_text_name(const gm_table_text *w, const double *data, int n,
                               bool is_node, char name[96])
{
    const gm_table_array *a = gm_table_text_find(w, data, n, is_node);
    const char *block = w->style.block;
    snprintf(name, 96, "%s%s%s", a && block ? block : "", a && block ? "." : "",
             a ? a->name : "0"); /* 0 only after a failed allocation */
    return name;
}

static gm_table_array *new_array(gm_table_text *w)
{
    if (w->n_arrays == w->room) {
        int room = 2 * w->room + 64;
        gm_table_array *arrays = gm_resize(w->arrays, (size_t)room, sizeof *arrays);
        if (!arrays) {
            w->text->failed = true;
            return NULL;
        }
        w->arrays = arrays;
        w->room = room;
    }
    return &w->arrays[w->n_arrays++];
}

void gm_table_text_clear(gm_table_text *w)
{
    gm_free(w->arrays);
    w->arrays = NULL;
    w->n_arrays = w->room = 0;
}

void gm_table_text_number(const gm_table_style *style, gm_buffer *buffer, double value)
{
    char text[GM_NUMBER_TEXT];
    if (!style->is_float) {
        gm_buffer_number(buffer, value);
        return;
    }
    gm_number_text(value, 9, text);
    gm_buffer_text(buffer, "%s%sf", text, strpbrk(text, ".e") ? "" : ".0");
}

/* Largest magnitude over the largest integer, so that zero stays zero. */
static double scale_of(const double *data, int n)
{
    double most = 0.0;
    for (int i = 0; i < n; i++)
        most = fmax(most, fabs(data[i]));
    return most > 0.0 ? (double)(float)(most / 32767.0) : 1.0;
}

static void write_element(const gm_table_text *w, const gm_table_array *a, int i)
{
    if (w->style.is_int16 && a->is_node)
        gm_buffer_text(w->text, "%ld",
                       lrint(fmin(fmax(a->data[i] / a->scale, -32767.0), 32767.0)));
    else
        gm_table_text_number(&w->style, w->text, a->data[i]);
}

static void write_head(const gm_table_text *w, const gm_table_array *a)
{
    const char *type = a->is_node ? "gm_node" : "gm_real";
    if (!w->style.block) {
        gm_buffer_text(w->text, "\n/* %s */\nstatic const gm_real %s[%d * %d] = {",
                       a->comment, a->name, a->rows, a->n);
        return;
    }
    gm_buffer_text(w->members, "    /* %s */\n    %s %s[%d * %d];\n", a->comment, type,
                   a->name, a->rows, a->n);
    gm_buffer_text(w->text, "    .%s = {", a->name);
}

/* Write an array unless its like is there already. */
static void write_array(gm_table_text *w, const gm_table_array *array)
{
    const int n = array->rows * array->n;
    if (gm_table_text_find(w, array->data, n, array->is_node))
        return;
    gm_table_array *a = new_array(w);
    if (!a)
        return;
    *a = *array;
    a->scale = w->style.is_int16 && a->is_node ? scale_of(a->data, n) : 1.0;
    write_head(w, a);
    for (int i = 0; i < n; i++) {
        gm_buffer_text(w->text, i % a->n == 0 || i % a->n % 4 == 0 ? "\n    " : " ");
        write_element(w, a, i);
        gm_buffer_text(w->text, ",");
    }
    gm_buffer_text(w->text, w->style.block ? "\n    },\n" : "\n};\n");
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

static void write_axis(gm_table_text *w, const char *name, char letter,
                       const char *comment, const gm_axis *axis, gm_table_array *table)
{
    gm_table_array a = {.data = axis->x, .rows = 1, .n = axis->n};
    snprintf(a.name, sizeof a.name, "%s_%c", name, letter);
    snprintf(a.comment, sizeof a.comment, "%s", comment);
    write_array(w, &a);
    const gm_table_array *written = gm_table_text_find(w, axis->x, axis->n, false);
    size_t used = strlen(table->axes);
    snprintf(table->axes + used, sizeof table->axes - used, "%s%s", used ? " " : "",
             written ? written->name : "0");
}

static void write_table(gm_table_text *w, const char *name, const meaning *m, int n_axes,
                        const gm_axis *const *axis, const double *value)
{
    const int slices = gm_reduced_slices(w->reduced);
    gm_table_array a = {.data = value, .rows = slices, .is_node = true};
    char shape[32] = "";
    if (slices > 1)
        snprintf(shape, sizeof shape, "[%d]", slices);
    for (int i = 0; i < n_axes; i++) {
        write_axis(w, name, "xyz"[i], m -> axis[i], axis[i], &a);
        a.rows *= i + 1 < n_axes ? axis[i]->n : 1;
    }
    a.n = axis[n_axes - 1]->n;
    snprintf(a.name, sizeof a.name, "%s", name);
    if (n_axes == 1)
        snprintf(a.comment, sizeof a.comment, "%s, %s[%d]", m->value, shape, a.n);
    else
        snprintf(a.comment, sizeof a.comment, "%s, %s[%d][%d]", m->value, shape,
                 a.rows / slices, a.n);
    write_array(w, &a);
}

static void data1(gm_table_text *w, const char *name, const meaning *m,
                  const gm_table1 *t)
{
    const gm_axis *axis[] = {&t->x};
    if (t->value)
        write_table(w, name, m, 1, axis, t->value);
}

static void data2(gm_table_text *w, const char *name, const meaning *m,
                  const gm_table2 *t)
{
    const gm_axis *axis[] = {&t->x, &t->y};
    if (t->value)
        write_table(w, name, m, 2, axis, t->value);
}

static void data3(gm_table_text *w, const char *name, const meaning *m,
                  const gm_table3 *t)
{
    const gm_axis *axis[] = {&t->x, &t->y, &t->z};
    if (t->value)
        write_table(w, name, m, 3, axis, t->value);
}

static void gear_data(gm_table_text *w, int p)
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

static void drag_data(gm_table_text *w, int p)
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

static void configuration_data(gm_table_text *w)
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

static void oil_data(gm_table_text *w)
{
    const gm_oil_axis *oil = &w->reduced->oil;
    if (oil->n < 2)
        return;
    gm_table_array a = {.data = oil->temperature, .rows = 1, .n = oil->n};
    snprintf(a.name, sizeof a.name, "oil_temperature");
    snprintf(a.comment, sizeof a.comment, "oil temperature of each slice [K]");
    write_array(w, &a);
    gm_table_array b = {.data = oil->bend, .rows = 1, .n = oil->n - 1};
    snprintf(b.name, sizeof b.name, "oil_bend");
    snprintf(b.comment, sizeof b.comment, "bend between slices [1]");
    write_array(w, &b);
}

void gm_table_text_arrays(gm_table_text *w)
{
    oil_data(w);
    for (int p = 0; p < w->map->n_paths; p++) {
        gear_data(w, p);
        drag_data(w, p);
    }
    configuration_data(w);
    data1(w, "coupling", &coupling_meaning, &w->reduced->coupling);
}
