/* SPDX-License-Identifier: BSD-2-Clause */
#include "bake/thin.h"

#include "bake/thin_grid.h"
#include "base/alloc.h"

#include <math.h>
#include <string.h>

struct gm_thin {
    gm_reduced_map map;
    gm_gear *gears[GM_MAX_PATHS];
    gm_drag_line *lines[GM_MAX_PATHS];
    gm_configuration *configurations;
    int n_grids, room;
    gm_grid *grids; /* owned with their arrays */
    double tolerance;
    gm_thin_stored *stored;
    bool failed; /* memory ran out */
};

/* ---- reference torques ---- */

static double largest(const double *value, int n)
{
    double most = 0.0;
    for (int i = 0; value && i < n; i++)
        most = fmax(most, fabs(value[i]));
    return most;
}

static double largest1(int slices, const gm_table1 *t)
{
    return largest(t->value, slices * t->x.n);
}

static double largest2(int slices, const gm_table2 *t)
{
    return largest(t->value, slices * t->x.n * t->y.n);
}

static double largest3(int slices, const gm_table3 *t)
{
    return largest(t->value, slices * t->x.n * t->y.n * t->z.n);
}

static double load_of(int slices, const gm_gear *gear)
{
    return fmax(largest2(slices, &gear->load_loss[0]),
                largest2(slices, &gear->load_loss[1]));
}

/* At the output, in a configuration and direction: P, the loads, X. */
static double output_loss(const gm_reduced_map *map, const gm_configuration *c, int dir)
{
    const int slices = gm_reduced_slices(map);
    double sum =
        largest1(slices, &c->parasitic[dir]) + largest3(slices, &c->both_loaded[dir]);
    for (int p = 0; p < map->n_paths; p++)
        if (c->gear[p] >= 0) {
            const gm_gear *gear = &map->path[p].gears[c->gear[p]];
            sum += fabs(gear->ratio) * load_of(slices, gear);
        }
    return sum;
}

/* Drag of a neutral path: smooth part and jumps. */
static double drag_of(int slices, const gm_path *path)
{
    double most = 0.0, jumps = 0.0;
    for (int i = 0; i < 4; i++)
        most = fmax(most, largest2(slices, &path->drag[i / 2][i % 2]));
    for (int l = 0; l < path->n_lines; l++)
        jumps += fmax(largest1(slices, &path->lines[l].jump[0]),
                      largest1(slices, &path->lines[l].jump[1]));
    return most + jumps / 2.0;
}

/* Largest parasitic loss while path p is in neutral: R stands beside it. */
static double beside_reaction(const gm_reduced_map *map, int p)
{
    const int slices = gm_reduced_slices(map);
    double most = 0.0;
    for (int i = 0; i < map->n_configurations; i++) {
        const gm_configuration *c = &map->configurations[i];
        if (c->gear[p] < 0)
            most = fmax(most, fmax(largest1(slices, &c->parasitic[0]),
                                   largest1(slices, &c->parasitic[1])));
    }
    for (int i = 0; i < 4; i++)
        most = fmax(most, largest2(slices, &map->path[p].reaction[i / 2][i % 2]));
    return most;
}

/* ---- tables ---- */

static gm_grid *new_grid(gm_thin *thin, int kind, double reference)
{
    if (thin->n_grids == thin->room) {
        int room = 2 * thin->room + 64;
        gm_grid *grids = gm_resize(thin->grids, (size_t)room, sizeof *grids);
        if (!grids) {
            thin->failed = true;
            return NULL;
        }
        thin->grids = grids;
        thin->room = room;
    }
    gm_grid *g = &thin->grids[thin->n_grids++];
    *g = (gm_grid){.kind = kind, .reference = reference};
    return g;
}

/* Thin one table: axes and value are replaced by those that stay. */
static void thin_table(gm_thin *thin, int kind, double reference, int n_axes,
                       gm_axis *const *axis, const double **value)
{
    if (thin->failed || !*value)
        return;
    const double limit = thin->tolerance > 0.0 ? thin->tolerance * reference : -1.0;
    gm_grid *g = new_grid(thin, kind, reference);
    if (!g)
        return;
    for (int a = 0; a < GM_GRID_AXES; a++) {
        g->n[a] = a < n_axes ? axis[a]->n : 1;
        g->x[a] = a < n_axes ? axis[a]->x : NULL;
    }
    g->slices = gm_reduced_slices(&thin->map);
    g->value = *value;
    if (!gm_grid_thin(g, limit, thin->stored)) {
        thin->failed = true;
        return;
    }
    for (int a = 0; a < n_axes; a++)
        *axis[a] = (gm_axis){g->n_kept[a], g->kept_x[a]};
    *value = g->kept_value;
}

static void thin1(gm_thin *thin, int kind, double reference, gm_table1 *t)
{
    gm_axis *const axis[] = {&t->x};
    if (!t->monotone)
        thin_table(thin, kind, reference, 1, axis, &t->value);
}

static void thin2(gm_thin *thin, int kind, double reference, gm_table2 *t)
{
    gm_axis *const axis[] = {&t->x, &t->y};
    if (!t->monotone)
        thin_table(thin, kind, reference, 2, axis, &t->value);
}

static void thin3(gm_thin *thin, int kind, double reference, gm_table3 *t)
{
    gm_axis *const axis[] = {&t->x, &t->y, &t->z};
    thin_table(thin, kind, reference, 3, axis, &t->value);
}

static void thin_gears(gm_thin *thin, const gm_path *from, gm_gear *gears)
{
    for (int g = 0; g < from->n_gears; g++)
        for (int d = 0; d < 2; d++) {
            const double reference =
                load_of(gm_reduced_slices(&thin->map), &from->gears[g]);
            thin2(thin, GM_LOAD_LOSS, reference, &gears[g].load_loss[d]);
            thin1(thin, GM_THIN_PIN, reference, &gears[g].pin[d]);
        }
}

static void thin_path(gm_thin *thin, const gm_reduced_map *map, int p)
{
    const gm_path *from = &map->path[p];
    gm_path *path = &thin->map.path[p];
    const double drag = drag_of(gm_reduced_slices(map), from),
                 beside = beside_reaction(map, p);
    thin_gears(thin, from, thin->gears[p]);
    for (int i = 0; i < 4; i++) {
        thin2(thin, GM_DRAG, drag, &path->drag[i / 2][i % 2]);
        thin2(thin, GM_REACTION, beside, &path->reaction[i / 2][i % 2]);
    }
    for (int l = 0; l < path->n_lines; l++)
        for (int d = 0; d < 2; d++)
            thin1(thin, GM_LINE_JUMP, drag, &thin->lines[p][l].jump[d]);
}

static void thin_configurations(gm_thin *thin, const gm_reduced_map *map)
{
    for (int i = 0; i < map->n_configurations; i++) {
        const gm_configuration *from = &map->configurations[i];
        gm_configuration *c = &thin->configurations[i];
        for (int d = 0; d < 2; d++) {
            thin1(thin, GM_PARASITIC,
                  largest1(gm_reduced_slices(map), &from->parasitic[d]),
                  &c->parasitic[d]);
            thin3(thin, GM_BOTH_LOADED, output_loss(map, from, d), &c->both_loaded[d]);
        }
    }
}

/* ---- the whole ---- */

static void *copy_of(gm_thin *thin, const void *from, int n, size_t size)
{
    void *copy = gm_calloc((size_t)n + 1, size); /* also of nothing */
    if (copy && n > 0)
        memcpy(copy, from, (size_t)n * size);
    thin->failed = thin->failed || !copy;
    return copy;
}

/* Structs of its own that still point to the map's arrays. */
static void copy_structs(gm_thin *thin, const gm_reduced_map *map)
{
    thin->map = *map;
    for (int p = 0; p < map->n_paths; p++) {
        const gm_path *path = &map->path[p];
        thin->gears[p] = copy_of(thin, path->gears, path->n_gears, sizeof(gm_gear));
        thin->lines[p] = copy_of(thin, path->lines, path->n_lines, sizeof(gm_drag_line));
        thin->map.path[p].gears = thin->gears[p];
        thin->map.path[p].lines = thin->lines[p];
    }
    thin->configurations = copy_of(thin, map->configurations, map->n_configurations,
                                   sizeof(gm_configuration));
    thin->map.configurations = thin->configurations;
}

gm_status gm_thin_create(const gm_reduced_map *map, double tolerance,
                         gm_thin_stored *stored, gm_thin **thin, gm_error *error)
{
    gm_thin *t = gm_calloc(1, sizeof *t);
    if (!t)
        return gm_fail(error, GM_ERR_MEMORY, "no memory to thin the map");
    t->tolerance = tolerance;
    t->stored = stored;
    copy_structs(t, map);
    for (int p = 0; !t->failed && p < map->n_paths; p++)
        thin_path(t, map, p);
    if (!t->failed)
        thin_configurations(t, map);
    thin1(t, GM_COUPLING, largest1(gm_reduced_slices(map), &map->coupling),
          &t->map.coupling);
    if (t->failed) {
        gm_thin_destroy(t);
        return gm_fail(error, GM_ERR_MEMORY, "no memory to thin the map");
    }
    *thin = t;
    return GM_OK;
}

void gm_thin_destroy(gm_thin *thin)
{
    if (!thin)
        return;
    for (int i = 0; i < thin->n_grids; i++)
        gm_grid_clear(&thin->grids[i]);
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        gm_free(thin->gears[p]);
        gm_free(thin->lines[p]);
    }
    gm_free(thin->configurations);
    gm_free(thin->grids);
    gm_free(thin);
}

const gm_reduced_map *gm_thin_map(const gm_thin *thin)
{
    return &thin->map;
}

void gm_thin_measure(const gm_thin *thin, gm_thin_loss loss[GM_THIN_KINDS])
{
    memset(loss, 0, GM_THIN_KINDS * sizeof *loss);
    for (int i = 0; i < thin->n_grids; i++) {
        const gm_grid *g = &thin->grids[i];
        gm_thin_loss *l = &loss[g->kind];
        double square = 0.0;
        const double most = gm_grid_error(g, &square);
        const double part = g->reference > 0.0 ? 1.0 / g->reference : 0.0;
        l->tables++;
        l->nodes += g->slices * gm_grid_size(g->n);
        l->kept += g->slices * gm_grid_size(g->n_kept);
        l->most = fmax(l->most, most);
        l->relative = fmax(l->relative, most * part);
        l->root_mean_sq += square * part * part;
    }
    for (int k = 0; k < GM_THIN_KINDS; k++)
        loss[k].root_mean_sq =
            loss[k].nodes ? sqrt(loss[k].root_mean_sq / (double)loss[k].nodes) : 0.0;
}
