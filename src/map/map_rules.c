/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Keys and axes of the tables: which there are, and what they must look like.
 */
#include "map/map_rules.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// clang-format off
#define PATH_SPEED {"path_speed", "rad/s", false}
#define OUTPUT_SPEED {"output_speed", "rad/s", false}
#define TORQUE(p) {"torque" p, "N.m", true}

static const gm_symbol_rule rules[GM_SYMBOLS] = {
    [GM_PARASITIC] = {"parasitic_loss", "parasitic loss", false, GM_GEARS_ALL, 1,
                      1, {OUTPUT_SPEED}},
    [GM_LOAD_LOSS] = {"load_loss", "load loss", true, GM_GEARS_OF_PATH, 1,
                      2, {PATH_SPEED, TORQUE("")}},
    [GM_BOTH_LOADED] = {"both_loaded", "correction with both paths loaded", false,
                        GM_GEARS_ALL, 1, 3, {OUTPUT_SPEED, TORQUE("_0"), TORQUE("_1")}},
    [GM_DRAG] = {"drag", "drag", true, GM_GEARS_NONE, 2, 2, {PATH_SPEED, OUTPUT_SPEED}},
    [GM_REACTION] = {"reaction", "reaction of the drag", true, GM_GEARS_NONE, 2,
                     2, {PATH_SPEED, OUTPUT_SPEED}},
    [GM_LINE_JUMP] = {"line_jump", "drag jump", true, GM_GEARS_NONE, 1,
                      1, {OUTPUT_SPEED}},
    [GM_COUPLING] = {"coupling", "coupling of the input shafts", false, GM_GEARS_NONE, 0,
                     1, {{"relative_speed", "rad/s", true}}},
};
// clang-format on

const gm_symbol_rule *gm_symbol_rule_of(gm_symbol symbol)
{
    return (int)symbol >= 0 && symbol < GM_SYMBOLS ? &rules[symbol] : NULL;
}

const char *gm_symbol_name(gm_symbol symbol)
{
    const gm_symbol_rule *rule = gm_symbol_rule_of(symbol);
    return rule ? rule->name : "unknown";
}

gm_symbol gm_symbol_named(const char *name)
{
    int s = 0;
    while (s < GM_SYMBOLS && strcmp(rules[s].name, name) != 0)
        s++;
    return (gm_symbol)s;
}

gm_table_key gm_table_key_of(gm_symbol symbol)
{
    gm_table_key key = {.symbol = symbol, .path = GM_MAP_ANY};
    for (int p = 0; p < GM_MAX_PATHS; p++)
        key.gear[p] = GM_MAP_ANY;
    key.direction[0] = key.direction[1] = GM_MAP_ANY;
    return key;
}

/* Text so far and the room for it; what does not fit is cut off. */
typedef struct words {
    char *text;
    size_t size, used;
} words;

static void add_words(words *w, const char *first, const char *second)
{
    int n = snprintf(w->text + w->used, w->size - w->used, "%s%s", first, second);
    if (n > 0)
        w->used += (size_t)n < w->size - w->used ? (size_t)n : w->size - w->used - 1;
}

void gm_map_key_text(const gm_map *map, const gm_table_key *key, char text[GM_KEY_TEXT])
{
    static const char *const direction_words[] = {"forward", "backward"};
    const gm_symbol_rule *rule = gm_symbol_rule_of(key->symbol);
    words w = {text, GM_KEY_TEXT, 0};
    const char *separator = " (";
    add_words(&w, rule ? rule->words : "unknown table", "");
    if (key->path >= 0 && key->path < map->n_paths) {
        add_words(&w, " (path ", map->paths[key->path].name);
        separator = ", ";
    }
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        char number[16];
        if (key->gear[p] == GM_MAP_ANY)
            continue;
        (void)snprintf(number, sizeof number, "gear %d", key->gear[p]);
        add_words(&w, separator, number);
        separator = ", ";
    }
    for (int d = 0; d < 2; d++) {
        if (key->direction[d] != GM_FORWARD && key->direction[d] != GM_BACKWARD)
            continue;
        add_words(&w, separator, direction_words[key->direction[d]]);
        separator = ", ";
    }
    if (key->line != 0.0) {
        char number[32];
        (void)snprintf(number, sizeof number, "line %.6g", key->line);
        add_words(&w, separator, number);
    }
    if (separator[0] == ',')
        add_words(&w, ")", "");
}

static int compare_int(int a, int b)
{
    return (a > b) - (a < b);
}

int gm_map_key_compare(const gm_table_key *a, const gm_table_key *b)
{
    int order = strcmp(gm_symbol_name(a->symbol), gm_symbol_name(b->symbol));
    if (order == 0)
        order = compare_int(a->path, b->path);
    for (int p = 0; order == 0 && p < GM_MAX_PATHS; p++)
        order = compare_int(a->gear[p], b->gear[p]);
    for (int d = 0; order == 0 && d < 2; d++)
        order = compare_int(a->direction[d], b->direction[d]);
    if (order == 0)
        order = (a->line > b->line) - (a->line < b->line);
    return compare_int(order, 0);
}

static bool gears_fit(const gm_table_key *key, gm_key_gears gears, int n_paths)
{
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        bool wanted = gears == GM_GEARS_ALL ? p < n_paths
                                            : gears == GM_GEARS_OF_PATH && p == key->path;
        bool neutral_fits = gears == GM_GEARS_ALL && key->symbol == GM_PARASITIC;
        int gear = key->gear[p];
        if (wanted != (gear != GM_MAP_ANY) || (gear == GM_NEUTRAL && !neutral_fits))
            return false;
    }
    return true;
}

bool gm_map_key_fits(const gm_table_key *key, int n_paths)
{
    const gm_symbol_rule *rule = gm_symbol_rule_of(key->symbol);
    if (!rule ||
        (rule->path ? key->path < 0 || key->path >= n_paths : key->path != GM_MAP_ANY))
        return false;
    if (!gears_fit(key, rule->gears, n_paths) || !isfinite(key->line) ||
        (key->line != 0.0) != (key->symbol == GM_LINE_JUMP))
        return false;
    for (int d = 0; d < 2; d++) {
        bool named = key->direction[d] == GM_FORWARD || key->direction[d] == GM_BACKWARD;
        if (d < rule->n_directions ? !named : key->direction[d] != GM_MAP_ANY)
            return false;
    }
    bool two_paths = key->symbol == GM_BOTH_LOADED || key->symbol == GM_COUPLING;
    return n_paths > 1 || !two_paths;
}

static bool increasing(const double *x, int n)
{
    for (int i = 0; i < n; i++)
        if (!isfinite(x[i]) || (i > 0 && !(x[i] > x[i - 1])))
            return false;
    return true;
}

int gm_map_format(const gm_map *map)
{
    return map->n_oil > 0 ? GM_MAP_FORMAT : GM_MAP_FORMAT_ONE_OIL;
}

bool gm_map_oil_fits(int n, const double *temperature)
{
    return increasing(temperature, n) && temperature[0] > 0.0;
}

bool gm_map_axes_fit(gm_symbol symbol, int n_axes, const int *n, const double *const *x)
{
    const gm_symbol_rule *rule = gm_symbol_rule_of(symbol);
    long long size = 1;
    if (!rule || n_axes != rule->n_axes)
        return false;
    for (int a = 0; a < n_axes; a++) {
        if (n[a] < 1 || n[a] > GM_MAP_MAX_NODES || !increasing(x[a], n[a]))
            return false;
        if (!rule->axis[a].is_signed && x[a][0] < 0.0)
            return false;
        size *= n[a];
        if (size > GM_MAP_MAX_VALUES)
            return false;
    }
    return true;
}
