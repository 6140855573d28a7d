/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A map as C text: its arrays, each written once however many tables share it, and the
 * structs of core/gm_reduced.h that point to them. Two styles: arrays of their own, or
 * members of one constant struct, so that they lie one after the other in memory.
 */
#ifndef TABLE_TEXT_H
#define TABLE_TEXT_H

#include "bake/buffer.h"
#include "map/gm_map.h"

typedef struct gm_table_style {
    bool is_float;     /* numbers of type float */
    bool is_int16;     /* nodes are int16_t times a scale */
    const char *block; /* name of the struct that holds the arrays; NULL: none does */
} gm_table_style;

/* An array that is in the text. */
typedef struct gm_table_array {
    const double *data;
    int rows, n;  /* rows x n numbers */
    bool is_node; /* values of a table, not an axis */
    double scale; /* of one unit, for int16; else 1 */
    char name[64];
    char comment[200]; /* what it holds, with unit */
    char axes[240];    /* names of the axes, with spaces between; "" for an axis */
} gm_table_array;

typedef struct gm_table_text {
    const gm_map *map;
    const gm_reduced_map *reduced;
    gm_table_style style;
    gm_buffer *text;    /* receives structs, and arrays unless there is a block */
    gm_buffer *members; /* of a block: its declaration's lines */
    int n_arrays, room;
    gm_table_array *arrays; /* owned */
} gm_table_text;

/** Write all arrays. Failed allocations are remembered in text. */
void gm_table_text_arrays(gm_table_text *w);

/** Write all structs; the last is `keyword` const gm_reduced_map gm_tables_map. */
void gm_table_text_structs(const gm_table_text *w, const char *keyword);

/** Name of the array that holds these numbers, as an expression. */
const char *gm_table_text_name(const gm_table_text *w, const double *data, int n,
                               bool is_node, char name[96]);

/** The array itself. NULL only after a failed allocation. */
const gm_table_array *gm_table_text_find(const gm_table_text *w, const double *data,
                                         int n, bool is_node);

/** Append a number of the style's type. */
void gm_table_text_number(const gm_table_style *style, gm_buffer *buffer, double value);

void gm_table_text_clear(gm_table_text *w);

#endif
