/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/documentation.h"

#include "bake/accuracy.h"
#include "bake/page.h"
#include "bake/picture.h"
#include "bake/variables.h"

#include <string.h>

#define RPM 9.54929658551372 /* per rad/s */
#define KELVIN 273.15

static const char *title_of(const gm_map *map)
{
    return map->title[0] ? map->title : map->name;
}

/* ---- what it is ---- */

static void introduction(gm_buffer *page, const gm_map *map)
{
    gm_buffer_text(page, "<h1>");
    gm_page_escaped(page, title_of(map));
    gm_buffer_text(
        page,
        "</h1>\n<p class=\"lead\">A reduced gearset: ratios, inertias and losses from "
        "tables that were computed with a detailed model.</p>\n<div "
        "class=\"figure\"><img "
        "src=\"../model.png\" alt=\"Efficiency of every gear\"><div class=\"caption\">"
        "Efficiency of every gear, driving forward, over speed (to the right, ");
    gm_page_number(page, "to ", map->speed_max * RPM, 4, " rpm) and torque (up, ");
    gm_page_number(page, "to ", map->torque_max, 4, " N·m, half of it at 71 % of the ");
    gm_page_number(page, "height) of its input, from ", 100 * GM_PICTURE_LOW, 3,
                   " % (dark) to ");
    gm_page_number(page, "", 100 * GM_PICTURE_HIGH, 3, " % (bright).</div></div>\n");
}

static const char *const use[] = {
    "Torques are inputs and speeds are outputs at every flange, so clutches, shafts and "
    "machines connect without algebraic loops. Torques count positive into the gearset: "
    "a "
    "load at the output is negative, and braking with the engine is a negative torque at "
    "an input.",
    "A gear is commanded by its number: -1 reverse, 0 neutral, 1 and up forward. A path "
    "that leaves neutral synchronises with limited torque until the speeds agree, then "
    "it "
    "turns with the output. An unknown number keeps the gear that was and sets "
    "<code>gear_refused</code>.",
    "Gears that are commanded during initialisation are engaged from the start; "
    "<code>output.w_start</code> then sets the speed of everything that turns with the "
    "output.",
    "At standstill friction holds exactly: no creep on a hill, and two different limits "
    "of "
    "torque for breaking away in the two directions.",
    "Co-Simulation takes any communication step; work done by the flanges equals the "
    "change "
    "of kinetic and elastic energy plus <code>loss_energy</code> on each of them. A "
    "flange "
    "against a stiff clutch with damping c [N·m·s/rad] wants steps below 2 J / c, with J "
    "the inertia of that flange.",
};

/* Flanges whose speed is an input, if there are any. */
static void speed_in(gm_buffer *page, const gm_document *d)
{
    int n = 0;
    for (int k = 0; k <= GM_MAX_PATHS; k++)
        if (d->speed_in.flange[k])
            gm_buffer_text(page, "%s<code>%s</code>",
                           n++ ? ", "
                               : "<p>In this component motion is an input and "
                                 "torque is an output at: ",
                           k < GM_MAX_PATHS ? d->map->paths[k].name : "output");
    if (n)
        gm_buffer_text(
            page,
            ". There <code>w</code> is the speed and <code>a</code> its derivative, "
            "<code>phi</code> has no influence, and <code>tau</code> is the torque that "
            "has to act on the gearset for this motion: what the gearset does to its "
            "neighbour is -<code>tau</code>. In Co-Simulation a speed grows by "
            "<code>a</code> over each step; a speed that is set to another value jumps, "
            "and the impulse is in <code>work</code>. At rest such a flange feels no "
            "friction of its own: its torque is what the springs and inertias "
            "take. All else is as below.</p>\n");
}

static void usage(gm_buffer *page, const gm_document *d)
{
    gm_page_heading(page, "Use");
    speed_in(page, d);
    for (size_t i = 0; i < sizeof use / sizeof *use; i++)
        gm_buffer_text(page, "<p>%s</p>\n", use[i]);
}

/* ---- gears, inertias, range ---- */

static void gear_table(gm_buffer *page, const gm_map *map)
{
    gm_page_heading(page, "Gears and inertias");
    gm_page_table(page, "path|>gear|>ratio, input speed / output speed");
    for (int p = 0; p < map->n_paths; p++)
        for (int g = 0; g < map->paths[p].n_gears; g++) {
            gm_buffer_text(page, "<tr><td>%s</td><td class=\"n\">%d</td>",
                           map->paths[p].name, map->paths[p].gears[g].number);
            gm_page_number(page, "<td class=\"n\">", map->paths[p].gears[g].ratio, 7,
                           "</td></tr>\n");
        }
    gm_page_table_end(page);
    gm_page_number(page, "<p>Inertia at the output ", map->inertia_output, 6, " kg·m²");
    for (int p = 0; p < map->n_paths; p++) {
        gm_buffer_text(page, ", at <code>%s</code>", map->paths[p].name);
        gm_page_number(page, " ", map->paths[p].inertia, 6, " kg·m²");
    }
    gm_buffer_text(page, "; both in neutral.</p>\n");
}

static void oil_range(gm_buffer *page, const gm_map *map)
{
    if (map->n_oil == 0) {
        gm_page_number(page, "and an oil temperature of ", map->oil_temperature - KELVIN,
                       4, " °C. ");
        return;
    }
    gm_page_number(page, "and oil temperatures from ", map->oil[0] - KELVIN, 4, "");
    gm_page_number(page, " to ", map->oil[map->n_oil - 1] - KELVIN, 4, " °C, ");
    gm_buffer_text(page, "measured at %d of them. ", map->n_oil);
}

static void range(gm_buffer *page, const gm_document *d)
{
    const gm_map *map = d->map;
    gm_page_heading(page, "Validity");
    gm_page_number(page, "<p>The tables hold for input speeds up to ",
                   map->speed_max * RPM, 5, " rpm");
    gm_page_number(page, " (", map->speed_max, 5, " rad/s) in both directions, input ");
    gm_page_number(page, "torques up to ", map->torque_max, 5,
                   " N·m driving and driven, ");
    oil_range(page, map);
    gm_buffer_text(page, "Between their nodes they are read %s. ",
                   d->monotone ? "by monotone cubics, whose gradients are continuous and "
                                 "which never overshoot their nodes (where both paths "
                                 "carry load: linearly)"
                               : "linearly");
    gm_buffer_text(page,
                   "Outside, the value at the edge is used, <code>out_of_map</code> "
                   "is true and a warning is given once. A number that is not finite "
                   "is refused.</p>\n");
}

/* ---- variables ---- */

static void start_value(gm_buffer *page, const gm_map *map, scalar s, const variable *v)
{
    double start = v->start;
    if (v->causality != CAUSALITY_INPUT && v->initial != INITIAL_EXACT) {
        gm_buffer_text(page, "<td class=\"n\"></td>");
        return;
    }
    if (s.id == VARIABLE_OIL_TEMPERATURE)
        start = map->oil_temperature;
    if (s.id == VARIABLE_PATH_SYNC_TORQUE)
        start = map->paths[s.path].sync_torque;
    if (start < 1e30)
        gm_page_number(page, "<td class=\"n\">", start, 6, "</td>");
    else
        gm_buffer_text(page, "<td class=\"n\">1e30</td>");
}

static void variable_row(gm_buffer *page, const gm_map *map, scalar s, const variable *v)
{
    static const char *const type[] = {"Real", "Integer", "Boolean", "Enumeration",
                                       "Enumeration"};
    gm_buffer_text(page, "<tr><td><code>%s%s%s</code></td><td>%s</td><td>%s</td>",
                   s.path < 0 ? "" : map->paths[s.path].name, s.path < 0 ? "" : ".",
                   v->name, type[v->type], v->unit);
    start_value(page, map, s, v);
    gm_buffer_text(page, "<td>");
    gm_page_escaped(page, v->description);
    gm_buffer_text(page, "%s</td></tr>\n",
                   v->causality == CAUSALITY_PARAMETER &&
                           v->variability == VARIABILITY_TUNABLE
                       ? " (may change during a run)"
                       : "");
}

static void variables_of(gm_buffer *page, const gm_document *d, int causality,
                         const char *heading)
{
    scalar all[2 * N_VARIABLES];
    int n = gm_bake_scalars(d->map->n_paths, &d->speed_in, all);
    gm_page_heading(page, heading);
    gm_page_table(page, "name|type|unit|>start|meaning");
    for (int i = 0; i < n; i++) {
        const variable v = gm_bake_variable(&d->speed_in, all[i]);
        if (v.causality == causality)
            variable_row(page, d->map, all[i], &v);
    }
    gm_page_table_end(page);
}

/* ---- origin ---- */

static void origin_row(gm_buffer *page, const char *name, const char *value)
{
    gm_buffer_text(page, "<tr><td>%s</td><td><code>", name);
    gm_page_escaped(page, value[0] ? value : "unknown");
    gm_buffer_text(page, "</code></td></tr>\n");
}

static void origin(gm_buffer *page, const gm_document *d)
{
    gm_page_heading(page, "How it was made");
    gm_page_table(page, "what|value");
    origin_row(page, "generator", "gearmap " GM_VERSION);
    origin_row(page, "map made by", d->map->tool_version);
    origin_row(page, "SHA-256 of the description", d->map->input_sha256);
    origin_row(page, "options of the sweep", d->map->options);
    origin_row(page, "interpolation", d->monotone ? "monotone" : "linear");
    origin_row(page, "SHA-256 of the map's content", d->map->content_hash);
    origin_row(page, "GUID, from the interface and the tables", d->guid);
    gm_page_table_end(page);
    gm_buffer_text(page,
                   "<p>Same map, options, tool and compiler: the same bytes. The map, "
                   "an SQLite database, is in <code>extra/gearmap/</code>; the C "
                   "sources (C99, the C library only) in <code>sources/</code>, with "
                   "the tables in <code>gm_tables.h</code>. Compile them with "
                   "<code>-ffp-contract=off</code> for the same bits as the library "
                   "in <code>binaries/</code>.</p>\n");
    gm_buffer_text(page, "<p>Licence of the sources: <a href=\"licenses/license.txt\">"
                         "BSD-2-Clause</a>. The model and its tables belong to whoever "
                         "made the description.</p>\n");
}

void gm_documentation_write(const gm_document *d, gm_buffer *page)
{
    gm_page_begin(page, title_of(d->map));
    introduction(page, d->map);
    usage(page, d);
    gear_table(page, d->map);
    range(page, d);
    gm_accuracy_write(d->passport, page);
    variables_of(page, d, CAUSALITY_INPUT, "Inputs");
    variables_of(page, d, CAUSALITY_OUTPUT, "Outputs");
    variables_of(page, d, CAUSALITY_PARAMETER, "Parameters");
    origin(page, d);
    gm_page_end(page);
}
