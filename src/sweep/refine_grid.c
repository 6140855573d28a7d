/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The grid of a refinement and the points held out from it.
 */
#include "sweep/refine_parts.h"

#include "base/alloc.h"
#include "map/gm_map.h"
#include "sweep/verify_points.h"

#include <math.h>
#include <string.h>

#define HELD_OUT_LEAST 32 /* points of a round: a quarter of the cells within these */
#define HELD_OUT_MOST 256

static int size_of(const gm_refine *r)
{
    int n = 1;
    for (int a = 0; a < r->spec.n_axes; a++)
        n *= r->nodes[a].n;
    return n;
}

/* Coordinates of node number i of the grid, the last axis first. */
static void node(const gm_refine *r, int i, double x[GM_MAX_AXES])
{
    for (int a = r->spec.n_axes - 1; a >= 0; a--) {
        x[a] = r->nodes[a].x[i % r->nodes[a].n];
        i /= r->nodes[a].n;
    }
}

gm_status gm_refine_grid_fill(gm_refine *refine, gm_error *error)
{
    gm_status status = GM_OK;
    int n = size_of(refine);
    for (int i = 0; i < n && status == GM_OK; i++) {
        double x[GM_MAX_AXES] = {0.0};
        node(refine, i, x);
        status = gm_refine_want(refine, x, error);
    }
    return status;
}

static gm_axis axis_of(const gm_refine *r, int a)
{
    return (gm_axis){r->nodes[a].n, r->nodes[a].x};
}

/* A point in a random cell, or anywhere. False where it may not be held out. */
static int draw(gm_refine *r, int by_cell, double *x)
{
    int allowed = 1;
    for (int a = 0; a < r->spec.n_axes; a++) {
        const gm_nodes *nodes = &r->nodes[a];
        gm_axis axis = axis_of(r, a);
        uint64_t cell = gm_random_next(&r->random) % (uint64_t)(nodes->n - 1);
        double low = by_cell ? nodes->x[cell] : nodes->x[0];
        double high = by_cell ? nodes->x[cell + 1] : nodes->x[nodes->n - 1];
        x[a] = gm_random_between(&r->random, low, high);
        int at = gm_axis_find(&axis, x[a]);
        allowed = allowed && nodes->x[at + 1] - nodes->x[at] > r->spec.axis[a].blind;
    }
    return allowed;
}

/* Half of the points are anywhere in a random cell, half anywhere on the axes: small
   cells are where a quantity changes fast, but the large ones must be looked at too. */
gm_status gm_refine_grid_hold_out(gm_refine *refine, gm_error *error)
{
    gm_refine *r = refine;
    gm_status status = GM_OK;
    int n = size_of(r) / 4;
    n = n < HELD_OUT_LEAST ? HELD_OUT_LEAST : n > HELD_OUT_MOST ? HELD_OUT_MOST : n;
    r->first_check = gm_memo_count(r->memo);
    for (int i = 0; i < n && status == GM_OK; i++) {
        double x[GM_MAX_AXES] = {0.0};
        if (draw(r, i % 2, x))
            status = gm_refine_want(r, x, error);
    }
    return status;
}

/* ---- interpolation ---- */

static double *rest_of(const gm_refine *r, int k)
{
    return r->rest + k / 2 * GM_NODES_MAX;
}

static gm_status make_grid(gm_refine *r, gm_error *error)
{
    int n = size_of(r);
    for (int k = 0; k < r->spec.n_values; k++) {
        double *grid = gm_resize(r->grid[k], (size_t)n, sizeof *grid);
        if (!grid)
            return gm_fail(error, GM_ERR_MEMORY,
                           "no memory to refine the axes of a table");
        r->grid[k] = grid;
    }
    for (int i = 0; i < n; i++) {
        double x[GM_MAX_AXES] = {0.0};
        node(r, i, x);
        const double *value = gm_refine_sample(r, x);
        for (int k = 0; k < r->spec.n_values; k++)
            r->grid[k][i] = value[k];
        for (int k = 0; r->spec.is_sum && k < r->spec.n_values; k += 2)
            /* the same for all nodes of axis 1 */
            rest_of(r, k)[i / r->nodes[1].n] = value[k] - value[k + 1];
    }
    return GM_OK;
}

static double read_one(const gm_refine *r, const double *x, const double *value)
{
    gm_table1 t = {axis_of(r, 0), value, r->spec.monotone};
    gm_cell1 cell = {0};
    return gm_table1_at(&t, 1, &cell, x[0]).value;
}

/* As the reduced gearset will read the table; three axes are always linear. */
static double interpolate(const gm_refine *r, const double *x, int k)
{
    if (r->spec.is_sum && k % 2 == 0)
        return interpolate(r, x, k + 1) + read_one(r, x, rest_of(r, k));
    if (r->spec.n_axes == 1)
        return read_one(r, x, r->grid[k]);
    if (r->spec.n_axes == 2) {
        gm_table2 t = {axis_of(r, 0), axis_of(r, 1), r->grid[k], r->spec.monotone};
        gm_cell2 cell = {0};
        return gm_table2_at(&t, 1, &cell, x[0], x[1]).value;
    }
    gm_table3 t = {axis_of(r, 0), axis_of(r, 1), axis_of(r, 2), r->grid[k]};
    return gm_table3_at(&t, x[0], x[1], x[2]).value;
}

/* ---- what is outside ---- */

/* |f''| h^2 / 8 of quantity k at node i of an axis: `next` is the distance of neighbours
   on the axis in the grid, `at` the place of node 0. */
static double bend_at(const gm_refine *r, int k, int axis, long at, long next, int i,
                      double h)
{
    const gm_nodes *n = &r->nodes[axis];
    if (i < 1 || i + 1 >= n->n)
        return 0.0;
    const double *f = r->grid[k] + at + i * next;
    double below = n->x[i] - n->x[i - 1], above = n->x[i + 1] - n->x[i];
    double second =
        2.0 * ((f[next] - f[0]) / above - (f[0] - f[-next]) / below) / (below + above);
    return fabs(second) * h * h / 8.0 / r->state.tolerance[k];
}

static long stride(const gm_refine *r, int axis)
{
    long n = 1;
    for (int a = axis + 1; a < r->spec.n_axes; a++)
        n *= r->nodes[a].n;
    return n;
}

/* The axis along which the quantities bend most in the cell, -1 when none can be halved
   any more. */
static int worst_axis(const gm_refine *r, const int *cell)
{
    int worst = -1;
    double most = -1.0;
    long corner = 0;
    for (int a = 0; a < r->spec.n_axes; a++)
        corner += cell[a] * stride(r, a);
    for (int a = 0; a < r->spec.n_axes; a++) {
        const gm_nodes *n = &r->nodes[a];
        double h = n->x[cell[a] + 1] - n->x[cell[a]], bend = 0.0;
        long at = corner - cell[a] * stride(r, a);
        if (n->n >= r->spec.axis[a].n_max || h <= r->spec.axis[a].shortest)
            continue;
        for (int k = 0; k < r->spec.n_values; k++)
            for (int end = 0; end < 2; end++)
                bend = fmax(bend, bend_at(r, k, a, at, stride(r, a), cell[a] + end, h));
        if (bend > most) {
            most = bend;
            worst = a;
        }
    }
    return worst;
}

/* Largest error of the quantities at a point, in tolerances; the state keeps the
   worst. */
static double compare(gm_refine *r, const double *x, const double *value)
{
    double largest = 0.0;
    for (int k = 0; k < r->spec.n_values; k++) {
        double off = fabs(interpolate(r, x, k) - value[k]);
        double in_tolerances = off / r->state.tolerance[k];
        largest = fmax(largest, in_tolerances);
        if (in_tolerances <= r->state.error)
            continue;
        r->state.error = in_tolerances;
        r->state.relative = r->largest[k] > 0.0 ? off / r->largest[k] : 0.0;
        memcpy(r->state.worst, x, sizeof r->state.worst);
    }
    return largest;
}

/* The middles of intervals to be halved, of all axes. */
typedef struct halves {
    int n[GM_MAX_AXES];
    double x[GM_MAX_AXES][HELD_OUT_MOST];
} halves;

static void add_half(const gm_refine *r, const double *x, halves *h)
{
    int cell[GM_MAX_AXES] = {0};
    for (int a = 0; a < r->spec.n_axes; a++) {
        gm_axis axis = axis_of(r, a);
        cell[a] = gm_axis_find(&axis, x[a]);
    }
    int a = worst_axis(r, cell);
    if (a >= 0)
        h->x[a][h->n[a]++] = 0.5 * (r->nodes[a].x[cell[a]] + r->nodes[a].x[cell[a] + 1]);
}

gm_status gm_refine_grid_compare(gm_refine *refine, int *clean, gm_error *error)
{
    gm_refine *r = refine;
    gm_status status = make_grid(r, error);
    halves *h = gm_calloc(1, sizeof *h);
    if (!h)
        status = gm_fail(error, GM_ERR_MEMORY, "no memory to refine the axes of a table");
    r->state.error = r->state.relative = 0.0;
    for (long i = r->first_check; i < r->known && status == GM_OK; i++) {
        const double *x = gm_memo_key(r->memo, i);
        if (compare(r, x, gm_memo_value(r->memo, i)) > 1.0)
            add_half(r, x, h);
    }
    *clean = 1;
    for (int a = 0; a < r->spec.n_axes && status == GM_OK; a++) {
        int before = r->nodes[a].n;
        for (int i = 0; i < h->n[a]; i++)
            gm_nodes_add(h->x[a][i], r->spec.axis[a].n_max, &r->nodes[a]);
        *clean = *clean && r->nodes[a].n == before;
    }
    r->state.reached = r->state.error <= 1.0;
    gm_free(h);
    return status;
}
