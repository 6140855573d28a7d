/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/table_text.h"

static const char *const direction_index[2] = {"GM_FORWARD", "GM_BACKWARD"};

static void number(const gm_table_text *w, double value)
{
    gm_table_text_number(&w->style, w->text, value);
}

static void write_axis(const gm_table_text *w, char letter, const gm_axis *axis)
{
    char name[96];
    gm_buffer_text(w->text, ".%c = {.n = %d, .x = %s}, ", letter, axis->n,
                   gm_table_text_name(w, axis->x, axis->n, false, name));
}

/* What stands in a table's struct behind its axes. */
static void write_value(const gm_table_text *w, const double *value, int nodes,
                        int monotone)
{
    char name[96];
    const int n = gm_reduced_slices(w->reduced) * nodes;
    const gm_table_array *a = gm_table_text_find(w, value, n, true);
    gm_buffer_text(w->text, ".value = %s", gm_table_text_name(w, value, n, true, name));
    if (w->style.is_int16 && a) {
        gm_buffer_text(w->text, ", .scale = ");
        number(w, a->scale);
    }
    gm_buffer_text(w->text, "%s}", monotone ? ", .monotone = 1" : "");
}

static bool is_table(const gm_table_text *w, const double *value)
{
    gm_buffer_text(w->text, value ? "{" : "{.value = 0}");
    return value != NULL;
}

static void struct1(const gm_table_text *w, const gm_table1 *t)
{
    if (!is_table(w, t->value))
        return;
    write_axis(w, 'x', &t->x);
    write_value(w, t->value, t->x.n, t->monotone);
}

static void struct2(const gm_table_text *w, const gm_table2 *t)
{
    if (!is_table(w, t->value))
        return;
    write_axis(w, 'x', &t->x);
    write_axis(w, 'y', &t->y);
    write_value(w, t->value, t->x.n * t->y.n, t->monotone);
}

static void struct3(const gm_table_text *w, const gm_table3 *t)
{
    if (!is_table(w, t->value))
        return;
    write_axis(w, 'x', &t->x);
    write_axis(w, 'y', &t->y);
    write_axis(w, 'z', &t->z);
    write_value(w, t->value, t->x.n * t->y.n * t->z.n, 0);
}

/* N.m/rad, N.m.s/rad, rad */
static void compliance_fields(const gm_table_text *w, const gm_gear *gear)
{
    gm_buffer_text(w->text, ",\n     .stiffness = ");
    number(w, gear->stiffness);
    gm_buffer_text(w->text, ", .damping = ");
    number(w, gear->damping);
    gm_buffer_text(w->text, ", .loose_damping = ");
    number(w, gear->loose_damping);
    gm_buffer_text(w->text, ", .lash = ");
    number(w, gear->lash);
    gm_buffer_text(w->text, ", .film = ");
    number(w, gear->film);
    gm_buffer_text(w->text, ", .pin = {\n");
    for (int d = 0; d < 2; d++) {
        gm_buffer_text(w->text, "        [%s] = ", direction_index[d]);
        struct1(w, &gear->pin[d]);
        gm_buffer_text(w->text, ",\n");
    }
    gm_buffer_text(w->text, "    }");
}

static void gear_structs(const gm_table_text *w, int p)
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
        number(w, path->gears[g].ratio);
        compliance_fields(w, &path->gears[g]);
        gm_buffer_text(w->text, ", .inertia_extra = ");
        number(w, path->gears[g].inertia_extra);
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

static void line_structs(const gm_table_text *w, int p)
{
    const gm_path *path = &w->reduced->path[p];
    if (path->n_lines == 0)
        return;
    gm_buffer_text(w->text, "\nstatic const gm_drag_line lines_%d[%d] = {\n", p,
                   path->n_lines);
    for (int l = 0; l < path->n_lines; l++) {
        gm_buffer_text(w->text, "    {.ratio = ");
        number(w, path->lines[l].ratio);
        for (int d = 0; d < 2; d++) {
            gm_buffer_text(w->text, "%s        [%s] = ", d ? ",\n" : ", .jump = {\n",
                           direction_index[d]);
            struct1(w, &path->lines[l].jump[d]);
        }
        gm_buffer_text(w->text, "}},\n");
    }
    gm_buffer_text(w->text, "};\n");
}

static void configuration_structs(const gm_table_text *w)
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

static void drag_struct(const gm_table_text *w, const char *field,
                        const gm_table2 table[2][2])
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

static void path_struct(const gm_table_text *w, int p)
{
    const gm_path *path = &w->reduced->path[p];
    gm_buffer_text(w->text, "        {.inertia = ");
    number(w, path->inertia);
    gm_buffer_text(w->text, ", /* kg.m2 */\n         .sync_torque = ");
    number(w, path->sync_torque < 1e30 ? path->sync_torque : 1e30);
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

static void oil_struct(const gm_table_text *w)
{
    const gm_oil_axis *oil = &w->reduced->oil;
    char name[96];
    if (oil->n < 2)
        return;
    gm_buffer_text(w->text, "    .oil = {.n = %d, .temperature = %s, ", oil->n,
                   gm_table_text_name(w, oil->temperature, oil->n, false, name));
    gm_buffer_text(w->text, ".bend = %s},\n",
                   gm_table_text_name(w, oil->bend, oil->n - 1, false, name));
}

/* Flanges whose motion is an input. */
static void prescribed_field(const gm_table_text *w)
{
    const int *k = w->reduced->prescribed;
    if (k[0] || k[1] || k[GM_MAX_PATHS])
        gm_buffer_text(w->text, "    .prescribed = {%d, %d, %d},\n", k[0] != 0, k[1] != 0,
                       k[GM_MAX_PATHS] != 0);
}

static void map_struct(const gm_table_text *w, const char *keyword)
{
    gm_buffer_text(w->text,
                   "\n%sconst gm_reduced_map gm_tables_map = {\n"
                   "    .n_paths = %d,\n    .path = {\n",
                   keyword, w->reduced->n_paths);
    for (int p = 0; p < w->reduced->n_paths; p++)
        path_struct(w, p);
    gm_buffer_text(w->text,
                   "    },\n    .n_configurations = %d,\n"
                   "    .configurations = configurations,\n    .coupling = ",
                   w->reduced->n_configurations);
    struct1(w, &w->reduced->coupling);
    gm_buffer_text(w->text, ",\n    .inertia_output = ");
    number(w, w->reduced->inertia_output);
    gm_buffer_text(w->text, ", /* kg.m2 */\n");
    oil_struct(w);
    gm_buffer_text(w->text, "    .oil_temperature = ");
    number(w, w->reduced->oil_temperature);
    gm_buffer_text(w->text, ", /* K */\n");
    prescribed_field(w);
    gm_buffer_text(w->text, "};\n");
}

void gm_table_text_structs(const gm_table_text *w, const char *keyword)
{
    for (int p = 0; p < w->map->n_paths; p++) {
        gear_structs(w, p);
        line_structs(w, p);
    }
    configuration_structs(w);
    map_struct(w, keyword);
}
