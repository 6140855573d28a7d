/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/documentation.h"

#include "bake/variables.h"

/* Text that may hold what HTML reads as markup. */
static void escaped(gm_buffer *page, const char *text)
{
    for (; *text; text++) {
        unsigned char c = (unsigned char)*text;
        if (c == '<')
            gm_buffer_text(page, "&lt;");
        else if (c == '>')
            gm_buffer_text(page, "&gt;");
        else if (c == '&')
            gm_buffer_text(page, "&amp;");
        else if (c >= 0x20)
            gm_buffer_bytes(page, text, 1);
    }
}

static void number(gm_buffer *page, const char *before, double value, int digits,
                   const char *after)
{
    char text[GM_NUMBER_TEXT];
    gm_buffer_text(page, "%s%s%s", before, gm_number_text(value, digits, text), after);
}

static void row(gm_buffer *page, const gm_map *map, scalar s)
{
    static const char *const kind[] = {"input", "output", "parameter"};
    const variable *v = &gm_bake_variables[s.id];
    gm_buffer_text(page, "<tr><td><code>%s%s%s</code></td><td>%s</td><td>%s</td><td>",
                   s.path < 0 ? "" : map->paths[s.path].name, s.path < 0 ? "" : ".",
                   v->name, kind[v->causality], v->unit);
    escaped(page, v->description);
    gm_buffer_text(page, "</td></tr>\n");
}

static void interface_table(gm_buffer *page, const gm_map *map)
{
    scalar all[2 * N_VARIABLES];
    int n = gm_bake_scalars(map->n_paths, all);
    gm_buffer_text(page, "<h2>Variables</h2>\n<table>\n<tr><th>name</th><th>kind</th>"
                         "<th>unit</th><th>meaning</th></tr>\n");
    for (int i = 0; i < n; i++)
        row(page, map, all[i]);
    gm_buffer_text(page, "</table>\n");
}

static void gear_table(gm_buffer *page, const gm_map *map)
{
    gm_buffer_text(page, "<h2>Gears</h2>\n<table>\n<tr><th>path</th><th>gear</th>"
                         "<th>ratio (input speed / output speed)</th></tr>\n");
    for (int p = 0; p < map->n_paths; p++)
        for (int g = 0; g < map->paths[p].n_gears; g++) {
            gm_buffer_text(page, "<tr><td>%s</td><td>%d</td><td>", map->paths[p].name,
                           map->paths[p].gears[g].number);
            number(page, "", map->paths[p].gears[g].ratio, 7, "</td></tr>\n");
        }
    gm_buffer_text(page, "</table>\n");
}

static void range(gm_buffer *page, const gm_map *map)
{
    gm_buffer_text(page, "<h2>Range</h2>\n<p>The tables were made for ");
    number(page, "input speeds up to ", map->speed_max, 6, " rad/s, ");
    number(page, "input torques up to ", map->torque_max, 6, " N.m and ");
    number(page, "an oil temperature of ", map->oil_temperature, 6, " K. ");
    gm_buffer_text(
        page, "Outside, edge values are used, <code>out_of_map</code> is true, and a "
              "warning is given once.</p>\n<h2>Inertia</h2>\n<p>");
    number(page, "output ", map->inertia_output, 6, " kg.m2");
    for (int p = 0; p < map->n_paths; p++) {
        gm_buffer_text(page, ", input flange of path %s", map->paths[p].name);
        number(page, " ", map->paths[p].inertia, 6, " kg.m2");
    }
    gm_buffer_text(page, ". Against a stiff clutch with damping c [N.m.s/rad] the "
                         "communication step has to stay below 2 J / c.</p>\n");
}

void gm_documentation_write(const gm_map *map, const char *guid, gm_buffer *buffer)
{
    gm_buffer_text(buffer, "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta "
                           "charset=\"utf-8\"><title>");
    escaped(buffer, map->name);
    gm_buffer_text(buffer, "</title></head>\n<body>\n<h1>");
    escaped(buffer, map->title[0] ? map->title : map->name);
    gm_buffer_text(
        buffer,
        "</h1>\n<p>A reduced gearset: ratios, inertias and losses from tables that were "
        "computed with a detailed model. Torques are inputs, speeds are outputs, at "
        "every "
        "flange; torques count positive into the gearset. Engaged paths turn with the "
        "output. Friction holds at standstill without creep. Any communication step is "
        "accepted.</p>\n");
    interface_table(buffer, map);
    gear_table(buffer, map);
    range(buffer, map);
    gm_buffer_text(buffer, "<h2>Origin</h2>\n<p>gearmap %s<br>description SHA-256 ",
                   GM_VERSION);
    escaped(buffer, map->input_sha256);
    gm_buffer_text(buffer, "<br>map content SHA-256 ");
    escaped(buffer, map->content_hash);
    gm_buffer_text(buffer, "<br>options ");
    escaped(buffer, map->options);
    gm_buffer_text(buffer, "<br>GUID %s</p>\n</body>\n</html>\n", guid);
}
