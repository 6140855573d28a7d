/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/description_parts.h"

#include <stdio.h>

void gm_gear_type_name(const xml *x, int p, char name[32])
{
    snprintf(name, 32, "%sGear", x->map->paths[p].name);
    if (name[0] >= 'a' && name[0] <= 'z')
        name[0] = (char)(name[0] - 'a' + 'A');
}

static void exponent(xml *x, const char *name, int value)
{
    if (value != 0)
        gm_xml_integer(x, name, value);
}

static void write_units(xml *x, const unit_type *units, int n)
{
    gm_xml_start(x, "UnitDefinitions");
    for (int i = 0; i < n; i++) {
        const unit_type *u = &units[i];
        gm_xml_start(x, "Unit");
        gm_xml_text(x, "name", u->unit);
        gm_xml_start(x, "BaseUnit");
        exponent(x, "kg", u->kg);
        exponent(x, "m", u->m);
        exponent(x, "s", u->s);
        exponent(x, "K", u->K);
        exponent(x, "rad", u->rad);
        gm_xml_end(x);
        if (u->display.name) {
            gm_xml_start(x, "DisplayUnit");
            gm_xml_text(x, "name", u->display.name);
            gm_xml_number(x, "factor", u->display.factor);
            gm_xml_number(x, "offset", u->display.offset);
            gm_xml_end(x);
        }
        gm_xml_end(x);
    }
    gm_xml_end(x);
}

static void write_item(xml *x, const char *name, int value, const char *description)
{
    gm_xml_start(x, "Item");
    gm_xml_text(x, "name", name);
    gm_xml_integer(x, "value", value);
    gm_xml_text(x, "description", description);
    gm_xml_end(x);
}

static void write_enumerations(xml *x)
{
    gm_xml_start(x, "SimpleType");
    gm_xml_text(x, "name", "PathState");
    gm_xml_text(x, "description", "what a path is doing");
    gm_xml_start(x, "Enumeration");
    write_item(x, "neutral", GM_PATH_NEUTRAL, "the input flange is free");
    write_item(x, "synchronising", GM_PATH_SYNCHRONISING,
               "the cone brings the path to the speed of its gear");
    write_item(x, "engaged", GM_PATH_ENGAGED, "the path turns with the output");
    gm_xml_end(x);
    gm_xml_end(x);
    gm_xml_start(x, "SimpleType");
    gm_xml_text(x, "name", "Fidelity");
    gm_xml_text(x, "description", "how the path from input to output is modelled");
    gm_xml_start(x, "Enumeration");
    write_item(x, "rigid", GM_RIGID, "engaged paths turn with the output");
    write_item(x, "lash", GM_LASH, "a spring with backlash connects them");
    gm_xml_end(x);
    gm_xml_end(x);
}

/* Least and greatest gear that can be commanded. */
static void write_gear_types(xml *x)
{
    for (int p = 0; p < x->map->n_paths; p++) {
        const gm_map_path *path = &x->map->paths[p];
        char name[32];
        int least = x->first_gear[p], greatest = least;
        for (int g = 0; g < path->n_gears; g++) {
            least = path->gears[g].number < least ? path->gears[g].number : least;
            greatest =
                path->gears[g].number > greatest ? path->gears[g].number : greatest;
        }
        gm_gear_type_name(x, p, name);
        gm_xml_start(x, "SimpleType");
        gm_xml_text(x, "name", name);
        gm_xml_text(x, "description", "-1 reverse, 0 neutral, 1 and up forward");
        gm_xml_start(x, "Integer");
        gm_xml_text(x, "quantity", "Gear");
        gm_xml_integer(x, "min", least);
        gm_xml_integer(x, "max", greatest);
        gm_xml_end(x);
        gm_xml_end(x);
    }
}

static void write_types(xml *x, const unit_type *units, int n)
{
    gm_xml_start(x, "TypeDefinitions");
    for (int i = 0; i < n; i++) {
        gm_xml_start(x, "SimpleType");
        gm_xml_text(x, "name", units[i].type);
        gm_xml_start(x, "Real");
        gm_xml_text(x, "quantity", units[i].quantity);
        gm_xml_text(x, "unit", units[i].unit);
        if (units[i].display.name)
            gm_xml_text(x, "displayUnit", units[i].display.name);
        gm_xml_end(x);
        gm_xml_end(x);
    }
    write_gear_types(x);
    write_enumerations(x);
    gm_xml_end(x);
}

static void write_log_categories(xml *x)
{
    static const char *const category[][2] = {
        {"logStatusWarning", "what the component did instead of what it was told"},
        {"logStatusDiscard", "calls that could not be done; the state is unchanged"},
        {"logStatusError", "misuse and numbers that cannot be"},
        {"logEvents", "gears engaged, synchronising, disengaged"},
        {"logAll", "everything"},
    };
    gm_xml_start(x, "LogCategories");
    for (size_t i = 0; i < sizeof category / sizeof *category; i++) {
        gm_xml_start(x, "Category");
        gm_xml_text(x, "name", category[i][0]);
        gm_xml_text(x, "description", category[i][1]);
        gm_xml_end(x);
    }
    gm_xml_end(x);
}

void gm_describe_types(xml *x, const unit_type *units, int n)
{
    write_units(x, units, n);
    write_types(x, units, n);
    write_log_categories(x);
}
