/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/thin_grid.h"

#include "base/alloc.h"

#include <math.h>
#include <string.h>

/* For each node of an axis the kept nodes around it and the share of the upper one. */
typedef struct place {
    int low, high; /* node numbers */
    double share;
} place;

/* What thinning of one table works on. */
typedef struct thinning {
    const gm_grid *grid;
    bool *keep[GM_GRID_AXES];   /* [n] */
    place *place[GM_GRID_AXES]; /* [n] */
} thinning;

static void find_places(const gm_grid *g, int a, const bool *keep, place *places)
{
    int low = 0;
    for (int i = 0; i < g->n[a]; i++) {
        low = keep[i] ? i : low;
        int high = i;
        while (!keep[high])
            high++;
        places[i] = (place){low, high, 0.0};
        if (high > low)
            places[i].share =
                (g->x[a][i] - g->x[a][low]) / (g->x[a][high] - g->x[a][low]);
    }
}

/* s: slice */
static double node(const gm_grid *g, int s, int i, int j, int k)
{
    return g->value[((s * g->n[0] + i) * g->n[1] + j) * g->n[2] + k];
}

static double mix(double low, double high, double share)
{
    return low + (high - low) * share;
}

static double along_z(const gm_grid *g, int s, int i, int j, const place *z)
{
    const double low = node(g, s, i, j, z->low);
    return z->high == z->low ? low : mix(low, node(g, s, i, j, z->high), z->share);
}

static double along_y(const gm_grid *g, int s, int i, const place *y, const place *z)
{
    const double low = along_z(g, s, i, y->low, z);
    return y->high == y->low ? low : mix(low, along_z(g, s, i, y->high, z), y->share);
}

/* What the kept nodes give at a place. */
static double kept_at(const gm_grid *g, int s, const place *x, const place *y,
                      const place *z)
{
    const double low = along_y(g, s, x->low, y, z);
    return x->high == x->low ? low : mix(low, along_y(g, s, x->high, y, z), x->share);
}

/* Largest error in the nodes from[] to to[] (excluded) of a slice. */
static double error_within(const thinning *t, int s, const int from[GM_GRID_AXES],
                           const int to[GM_GRID_AXES])
{
    const gm_grid *g = t->grid;
    double most = 0.0;
    for (int i = from[0]; i < to[0]; i++)
        for (int j = from[1]; j < to[1]; j++)
            for (int k = from[2]; k < to[2]; k++)
                most = fmax(most, fabs(kept_at(g, s, &t->place[0][i], &t->place[1][j],
                                               &t->place[2][k]) -
                                       node(g, s, i, j, k)));
    return most;
}

/* Error around node i of axis a once it has gone; nothing else changes. */
static double error_without(thinning *t, int a, int i)
{
    int from[GM_GRID_AXES] = {0, 0, 0}, to[GM_GRID_AXES], low = i - 1, high = i + 1;
    memcpy(to, t->grid->n, sizeof to);
    while (!t->keep[a][low])
        low--;
    while (!t->keep[a][high])
        high++;
    from[a] = low + 1;
    to[a] = high;
    t->keep[a][i] = false;
    find_places(t->grid, a, t->keep[a], t->place[a]);
    double error = 0.0;
    for (int s = 0; s < t->grid->slices; s++)
        error = fmax(error, error_within(t, s, from, to));
    t->keep[a][i] = true;
    find_places(t->grid, a, t->keep[a], t->place[a]);
    return error;
}

static int count(const bool *keep, int n)
{
    int sum = 0;
    for (int i = 0; i < n; i++)
        sum += keep[i];
    return sum;
}

/* Take the node that costs least error for each value saved; false: none may go. */
static bool take_one(thinning *t, double limit)
{
    int axis = -1, taken = 0;
    double least = 0.0;
    for (int a = 0; a < GM_GRID_AXES; a++) {
        const int kept = count(t->keep[a], t->grid->n[a]);
        for (int i = 1; i < t->grid->n[a] - 1; i++) {
            if (!t->keep[a][i])
                continue;
            const double error = error_without(t, a, i);
            if (error <= limit && (axis < 0 || error * kept < least)) {
                axis = a;
                taken = i;
                least = error * kept;
            }
        }
    }
    if (axis < 0)
        return false;
    t->keep[axis][taken] = false;
    find_places(t->grid, axis, t->keep[axis], t->place[axis]);
    return true;
}

static void copy_axis(gm_grid *g, int a, const bool *keep)
{
    int n = 0;
    for (int i = 0; i < g->n[a]; i++)
        if (keep[i] && g->kept_x[a])
            g->kept_x[a][n++] = g->x[a][i];
}

static void copy_values(gm_grid *g, bool *const keep[GM_GRID_AXES])
{
    int n = 0;
    for (int m = 0; m < g->slices * gm_grid_size(g->n); m++)
        if (keep[0][m / (g->n[1] * g->n[2]) % g->n[0]] &&
            keep[1][m / g->n[2] % g->n[1]] && keep[2][m % g->n[2]])
            g->kept_value[n++] = g->value[m];
}

static bool copy_kept(gm_grid *g, const thinning *t)
{
    for (int a = 0; a < GM_GRID_AXES; a++) {
        g->n_kept[a] = count(t->keep[a], g->n[a]);
        if (!g->x[a])
            continue;
        g->kept_x[a] = gm_calloc((size_t)g->n_kept[a], sizeof *g->kept_x[a]);
        if (!g->kept_x[a])
            return false;
        copy_axis(g, a, t->keep[a]);
    }
    g->kept_value =
        gm_calloc((size_t)(g->slices * gm_grid_size(g->n_kept)), sizeof *g->kept_value);
    if (!g->kept_value)
        return false;
    copy_values(g, t->keep);
    return true;
}

static bool prepare(const gm_grid *g, thinning *t)
{
    *t = (thinning){.grid = g};
    for (int a = 0; a < GM_GRID_AXES; a++) {
        t->keep[a] = gm_calloc((size_t)g->n[a], sizeof *t->keep[a]);
        t->place[a] = gm_calloc((size_t)g->n[a], sizeof *t->place[a]);
        if (!t->keep[a] || !t->place[a])
            return false;
        for (int i = 0; i < g->n[a]; i++)
            t->keep[a][i] = true;
        find_places(g, a, t->keep[a], t->place[a]);
    }
    return true;
}

static double largest(const gm_grid *g)
{
    double most = 0.0;
    for (int i = 0; i < g->slices * gm_grid_size(g->n_kept); i++)
        most = fmax(most, fabs(g->kept_value[i]));
    return most;
}

static void store(gm_grid *g, gm_thin_stored *stored)
{
    const double most = largest(g);
    for (int i = 0; i < g->slices * gm_grid_size(g->n_kept); i++)
        g->kept_value[i] = stored(g->kept_value[i], most);
}

bool gm_grid_thin(gm_grid *grid, double limit, gm_thin_stored *stored)
{
    thinning t;
    bool done = prepare(grid, &t);
    while (done && limit >= 0.0 && take_one(&t, limit)) {
    }
    done = done && copy_kept(grid, &t);
    if (done && stored)
        store(grid, stored);
    for (int a = 0; a < GM_GRID_AXES; a++) {
        gm_free(t.keep[a]);
        gm_free(t.place[a]);
    }
    return done;
}

void gm_grid_clear(gm_grid *grid)
{
    for (int a = 0; a < GM_GRID_AXES; a++)
        gm_free(grid->kept_x[a]);
    gm_free(grid->kept_value);
    *grid = (gm_grid){0};
}

/* ---- what is lost ---- */

/* Cell of the kept axis that x lies in. */
static place place_of(const gm_grid *g, int a, double x)
{
    const double *kept = g->kept_x[a];
    int i = 0;
    if (g->n_kept[a] < 2)
        return (place){0, 0, 0.0};
    while (i < g->n_kept[a] - 2 && x >= kept[i + 1])
        i++;
    return (place){i, i + 1, (x - kept[i]) / (kept[i + 1] - kept[i])};
}

double gm_grid_error(const gm_grid *grid, double *square)
{
    gm_grid kept = {.slices = grid->slices,
                    .n = {grid->n_kept[0], grid->n_kept[1], grid->n_kept[2]},
                    .value = grid->kept_value};
    double most = 0.0;
    place at[GM_GRID_AXES];
    for (int n = 0; n < grid->slices * gm_grid_size(grid->n); n++) {
        const int slice = n / gm_grid_size(grid->n);
        const int index[] = {n / (grid->n[1] * grid->n[2]) % grid->n[0],
                             n / grid->n[2] % grid->n[1], n % grid->n[2]};
        for (int a = 0; a < GM_GRID_AXES; a++)
            at[a] =
                grid->x[a] ? place_of(grid, a, grid->x[a][index[a]]) : (place){0, 0, 0.0};
        const double error =
            fabs(kept_at(&kept, slice, &at[0], &at[1], &at[2]) - grid->value[n]);
        most = fmax(most, error);
        *square += error * error;
    }
    return most;
}
