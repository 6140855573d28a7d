/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The map: tables of losses, inertias and ratios with axes, as the sweep collects them
 * and the generators use them. In memory here; its file is map_file.c (docs/map.md).
 */
#ifndef GM_MAP_H
#define GM_MAP_H

#include "base/gm_status.h"
#include "core/gm_reduced.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Version of the file's schema; maps without an oil axis are written in the older one. */
#define GM_MAP_FORMAT 4
#define GM_MAP_FORMAT_ONE_OIL 3
#define GM_MAP_TEXT 128
#define GM_MAP_ANY 99 /* in place of a gear or direction that does not apply */

/** Which quantity a table holds; see core/gm_reduced.h for the symbols. */
typedef enum gm_symbol {
    GM_PARASITIC,   /* P: gear[] = configuration, direction[0] of the output;
                          axes: output speed */
    GM_LOAD_LOSS,   /* D: path, gear[path], direction[0] of the path;
                          axes: path speed, torque in the direction of rotation */
    GM_BOTH_LOADED, /* X: gear[] = configuration, direction[0] of the output;
                          axes: output speed, torque of path 0, of path 1 */
    GM_DRAG,        /* N: path, direction[0] of the path, [1] of the output;
                          axes: path speed, output speed */
    GM_REACTION,    /* R: as N */
    GM_LINE_JUMP,   /* path, line, direction[0] of the output; axes: output speed */
    GM_COUPLING,    /* C: axes: relative speed, signed */
    GM_SYMBOLS      /* how many there are */
} gm_symbol;

/** Name in the file, such as "parasitic_loss". */
const char *gm_symbol_name(gm_symbol symbol);

/** Unused fields are GM_MAP_ANY. Gears are numbers (0 neutral). Directions are
 *  GM_FORWARD or GM_BACKWARD. */
typedef struct gm_table_key {
    gm_symbol symbol;
    int path;
    int gear[GM_MAX_PATHS];
    int direction[2];
    double line; /* ratio w_path / w_output of a drag line; 0: does not apply */
} gm_table_key;

/** A key of this symbol whose other fields are all GM_MAP_ANY: the start of any key. */
gm_table_key gm_table_key_of(gm_symbol symbol);

#define GM_MAX_AXES 3

/* Limits, far beyond any sweep, that keep a damaged file from asking for all memory. */
#define GM_MAP_MAX_GEARS 64
#define GM_MAP_MAX_TABLES 8192
#define GM_MAP_MAX_NODES 100000
#define GM_MAP_MAX_VALUES 10000000 /* of one table */
#define GM_MAP_MAX_OIL 32          /* oil temperatures */

typedef struct gm_map_table {
    gm_table_key key;
    int n_axes;
    int n[GM_MAX_AXES];     /* nodes; 1 where there is no such axis */
    double *x[GM_MAX_AXES]; /* SI, strictly increasing; NULL where there is no axis */
    int slices;             /* one, or one for each oil temperature of the map */
    double *value;          /* [slices][n0][n1][n2], SI */
} gm_map_table;

typedef struct gm_map_gear {
    int number;
    double ratio;       /* identified from the model, signed */
    double ratio_given; /* NAN: not given */
    double stiffness; /* between flange and output, at the path's flange, N.m/rad; 0: not
                           known, rigid */
    double damping;   /* N.m.s/rad, of what carries */
    double loose_damping; /* N.m.s/rad, of what idles along, at slow slip */
    double lash;          /* rad, from flank to flank */
    double film;          /* rad before contact in which the damping sets in */
    double inertia_extra; /* J_g: turns with the output in this gear beyond J_out and
                             r^2 J_p, kg.m2; 0 for layshafts */
} gm_map_gear;

/** A path without drag tables has no neutral: see gm_map_has_neutral. */
typedef struct gm_map_path {
    char name[16];
    double inertia;     /* J_p, kg.m2 */
    double sync_torque; /* N.m at the input flange, > 0; infinite: engages at once */
    int n_gears;
    gm_map_gear *gears; /* ascending by number */
} gm_map_path;

typedef struct gm_map {
    char name[GM_MAP_TEXT], title[GM_MAP_TEXT];
    char tool_version[32];
    char input_sha256[65];                         /* of the description */
    char options[GM_MAP_TEXT * 6];                 /* how it was swept, canonical text */
    char content_hash[65];                         /* filled when finished or read */
    double speed_max, torque_max, oil_temperature; /* rad/s, N.m, K */
    double inertia_output;
    /* The oil axis, which all tables share; n_oil 0: none. Temperatures [K] are strictly
       increasing. oil_bend[k] > -1: how losses go from one to the next (gm_oil_axis). */
    int n_oil;
    double oil[GM_MAP_MAX_OIL], oil_bend[GM_MAP_MAX_OIL];
    int n_paths;
    gm_map_path paths[GM_MAX_PATHS];
    int n_tables;
    gm_map_table *tables;
} gm_map;

/** New empty map; NULL when there is no memory. */
gm_map *gm_map_create(void);
void gm_map_destroy(gm_map *map);

/** Room for n_gears gears on path p; what the path held before is gone. Path 0 comes
 *  first. name: 1 to 15 characters. GM_ERR_ARGUMENT, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_map_set_path(gm_map *map, int p, const char *name, int n_gears,
                                       gm_error *error);

/** Give an empty map an oil axis of n >= 2 temperatures [K], with no bend; its tables
 *  will have a slice for each. GM_ERR_ARGUMENT: they are not above zero and strictly
 *  increasing, more than GM_MAP_MAX_OIL, or the map has tables already. */
GM_NODISCARD gm_status gm_map_set_oil(gm_map *map, int n, const double *temperature,
                                      gm_error *error);

/** Slices of each table: 1 without an oil axis. */
int gm_map_slices(const gm_map *map);

/** The slice whose temperature is nearest to the map's oil_temperature. */
int gm_map_usual_slice(const gm_map *map);

/** Add a table with copies of the axes; values are zero. *index receives its number.
 *  n[n_axes], x[n_axes][n[a]]: as the symbol demands, each strictly increasing, speeds
 *  not negative. The paths must have been set before. Adding moves the array map->tables.
 *  GM_ERR_ARGUMENT: key or axes do not fit, or the map has the key already.
 *  GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_map_add_table(gm_map *map, const gm_table_key *key, int n_axes,
                                        const int *n, const double *const *x, int *index,
                                        gm_error *error);

/** Give a table other axes, by the same rules; its values become zero. On failure it is
 *  as before. GM_ERR_ARGUMENT, GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_map_set_axes(gm_map *map, int index, const int *n,
                                       const double *const *x, gm_error *error);

/** The table of a key, or NULL. Valid until the next gm_map_add_table. */
const gm_map_table *gm_map_find(const gm_map *map, const gm_table_key *key);

/** Whether path p has a neutral. It has none where it has one gear and the map no drag
 *  table (N, R) of it: gearsets that are always in gear. */
int gm_map_has_neutral(const gm_map *map, int p);

/** Number of values of a table, of one of its slices, and of one of its rows (first axis
 *  fixed). */
int gm_map_value_count(const gm_map_table *table);
int gm_map_table_size(const gm_map_table *table);
int gm_map_row_size(const gm_map_table *table);

/** SHA-256 over what the map says: ratios, inertias, tables, input hash, options. The
 *  same for the same input and options, whatever the tool's version or file layout.
 *  text: 64 hexadecimal digits. GM_ERR_MEMORY. */
GM_NODISCARD gm_status gm_map_hash(const gm_map *map, char text[65], gm_error *error);

/** The map as the reduced gearset reads it. The view points into the map, which must
 *  outlive it. GM_ERR_FORMAT when a table is missing or has the wrong axes. */
typedef struct gm_map_view gm_map_view;
GM_NODISCARD gm_status gm_map_view_create(const gm_map *map, gm_map_view **view,
                                          gm_error *error);
/** Read the tables of one and two axes by monotone cubics instead of linearly; X, of
 *  three axes, stays linear. */
void gm_map_view_make_monotone(gm_map_view *view);
void gm_map_view_destroy(gm_map_view *view);
const gm_reduced_map *gm_map_view_reduced(const gm_map_view *view);

#ifdef __cplusplus
}
#endif
#endif
