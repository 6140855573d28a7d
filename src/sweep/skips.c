/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/skips.h"

#include <math.h>

/* Values at nodes of one axis, `stride` apart. */
typedef struct line {
    const double *x;
    double *value;
    long stride;
    int n;
} line;

static double at(const line *l, int i)
{
    return l->value[i * l->stride];
}

/* The next node with a number from i on, in steps of `by`; -1: there is none. */
static int next(const line *l, int i, int by)
{
    for (; i >= 0 && i < l->n; i += by)
        if (!isnan(at(l, i)))
            return i;
    return -1;
}

static double between(const line *l, int low, int high, int i)
{
    if (low < 0 || high < 0)
        return at(l, low < 0 ? high : low);
    double share = (l->x[i] - l->x[low]) / (l->x[high] - l->x[low]);
    return at(l, low) + share * (at(l, high) - at(l, low));
}

/* From the left, so that what was filled serves as the nearest on that side: on the
   straight line to the right it changes nothing. */
static int fill_line(const line *l)
{
    if (next(l, 0, 1) < 0)
        return 0;
    for (int i = 0; i < l->n; i++)
        if (isnan(at(l, i)))
            l->value[i * l->stride] = between(l, next(l, i, -1), next(l, i, 1), i);
    return 1;
}

/* All lines along an axis; how many stay open. */
static long fill_along(gm_map_table *t, int axis)
{
    long stride = 1, open = 0, all = gm_map_value_count(t);
    for (int a = axis + 1; a < GM_MAX_AXES; a++)
        stride *= t->n[a];
    for (long k = 0; k < all; k++) {
        if (k / stride % t->n[axis] != 0)
            continue;
        const line l = {t->x[axis], t->value + k, stride, t->n[axis]};
        open += !fill_line(&l);
    }
    return open;
}

static int is_open(const gm_map_table *t)
{
    for (long k = 0; k < gm_map_value_count(t); k++)
        if (isnan(t->value[k]))
            return 1;
    return 0;
}

gm_status gm_skips_fill(gm_map *map, gm_error *error)
{
    for (int i = 0; i < map->n_tables; i++) {
        gm_map_table *t = &map->tables[i];
        long open = is_open(t);
        for (int axis = t->n_axes - 1; axis >= 0 && open; axis--)
            open = fill_along(t, axis);
        if (open)
            return gm_fail(error, GM_ERR_TOOL,
                           "the model failed at every point of a table (%s)",
                           gm_symbol_name(t->key.symbol));
    }
    return GM_OK;
}
