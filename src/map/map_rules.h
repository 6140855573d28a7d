/* SPDX-License-Identifier: BSD-2-Clause
 *
 * What each symbol of the map demands of its key and axes, in one list; the checks, the
 * file and the messages all read it.
 */
#ifndef MAP_RULES_H
#define MAP_RULES_H

#include "map/gm_map.h"

#include <stdbool.h>

/** Which gears a key names. */
typedef enum gm_key_gears { GM_GEARS_NONE, GM_GEARS_OF_PATH, GM_GEARS_ALL } gm_key_gears;

typedef struct gm_axis_rule {
    const char *quantity; /* as stored in the file */
    const char *unit;
    bool is_signed; /* else no node may be negative */
} gm_axis_rule;

typedef struct gm_symbol_rule {
    const char *name;  /* in the file: parasitic_loss */
    const char *words; /* in messages: parasitic loss */
    bool path;         /* the key names a path */
    gm_key_gears gears;
    int n_directions;
    int n_axes;
    gm_axis_rule axis[GM_MAX_AXES];
} gm_symbol_rule;

/** Rule of a symbol; NULL for a number that is none. */
const gm_symbol_rule *gm_symbol_rule_of(gm_symbol symbol);

/** Symbol of a name in the file; GM_SYMBOLS when there is none. */
gm_symbol gm_symbol_named(const char *name);

#define GM_KEY_TEXT 160

/** The key in words, such as "load loss (path odd, gear 3, backward)". */
void gm_map_key_text(const gm_map *map, const gm_table_key *key, char text[GM_KEY_TEXT]);

/** -1, 0, 1: order of keys by symbol name, path, gears, directions. */
int gm_map_key_compare(const gm_table_key *a, const gm_table_key *b);

/** True when the key names exactly what its symbol demands. n_paths: of the map. */
bool gm_map_key_fits(const gm_table_key *key, int n_paths);

/** True when the axes have the count, signs, order and finite nodes the symbol demands.
 */
bool gm_map_axes_fit(gm_symbol symbol, int n_axes, const int *n, const double *const *x);

/** True when oil temperatures [K] are numbers that increase from above zero. */
bool gm_map_oil_fits(int n, const double *temperature);

/** Version of the schema that a map is written in. */
int gm_map_format(const gm_map *map);

/** Names, numbers of gears, keys and axes: what must hold before a sweep begins. */
GM_NODISCARD gm_status gm_map_check_frame(const gm_map *map, gm_error *error);

/** The frame, and all that a finished map must also have: ratios, inertias, finite
 *  values. GM_ERR_FORMAT with a sentence that names what is wrong. */
GM_NODISCARD gm_status gm_map_check(const gm_map *map, gm_error *error);

#endif
