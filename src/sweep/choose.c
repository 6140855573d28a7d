/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/choose.h"

#include "base/alloc.h"
#include "map/gm_map.h"

#include <math.h>
#include <string.h>

#define BEYOND 3.0  /* tolerances, from which longer intervals are not tried */
#define LOOSER 1.25 /* steps of the tolerance until n_max nodes are enough */

typedef struct work {
    const gm_curves *c;
    double *cost;     /* [n] of the best chain to here: intervals, then errors */
    int *from;        /* [n] where its last interval begins */
    double *node, *f; /* of the chosen nodes */
    char *best;       /* [n] */
} work;

static int is_fixed(const gm_curves *c, int i)
{
    return i == 0 || i == c->n - 1 || c->fixed[i];
}

/* Largest error of the straight lines from sample i to j; stops beyond `enough`. */
static double line_error(const gm_curves *c, int i, int j, double enough)
{
    double largest = 0.0, length = c->x[j] - c->x[i];
    for (int m = i + 1; m < j && largest <= enough; m++) {
        double part = (c->x[m] - c->x[i]) / length;
        for (int k = 0; k < c->n_curves; k++) {
            const double *f = c->value + (long)k * c->n;
            largest = fmax(largest, fabs(f[i] + part * (f[j] - f[i]) - f[m]));
        }
    }
    return largest;
}

/* The shortest chain whose intervals have errors of at most `limit`. */
static int chain(work *w, double limit, char *chosen)
{
    const gm_curves *c = w->c;
    int n_chosen = 1;
    for (int i = 0; i < c->n; i++)
        w->cost[i] = i == 0 ? 0.0 : HUGE_VAL;
    for (int i = 0; i + 1 < c->n; i++)
        for (int j = i + 1; j < c->n; j++) {
            double e = line_error(c, i, j, BEYOND * limit);
            /* errors count less than one interval, even all together */
            double cost = w->cost[i] + 1.0 + 1e-4 * e / limit;
            if (e <= limit && cost < w->cost[j]) {
                w->cost[j] = cost;
                w->from[j] = i;
            }
            if (e > BEYOND * limit || is_fixed(c, j))
                break;
        }
    memset(chosen, 0, (size_t)c->n);
    chosen[0] = 1;
    for (int i = c->n - 1; i > 0; i = w->from[i], n_chosen++)
        chosen[i] = 1;
    return n_chosen;
}

/* The curve of n nodes at x, as a table of one axis or a line of one of several. */
static double read_curve(const work *w, int n, double x)
{
    static const double nowhere[1] = {0.0};
    gm_cell1 cell_1 = {0};
    gm_cell2 cell_2 = {0};
    gm_table1 t1 = {{n, w->node}, w->f, w->c->monotone};
    gm_table2 t2 = {{1, nowhere}, {n, w->node}, w->f, w->c->monotone};
    return w->c->alone ? gm_table1_at(&t1, 1, &cell_1, x).value
                       : gm_table2_at(&t2, 1, &cell_2, 0.0, x).value;
}

/* Largest error of the interpolation over the chosen nodes, and the sample with it. */
static double largest_error(const work *w, const char *chosen, int *worst)
{
    const gm_curves *c = w->c;
    double largest = 0.0;
    *worst = -1;
    for (int k = 0; k < c->n_curves; k++) {
        const double *f = c->value + (long)k * c->n;
        int n = 0;
        for (int i = 0; i < c->n; i++)
            if (chosen[i]) {
                w->node[n] = c->x[i];
                w->f[n++] = f[i];
            }
        for (int i = 0; i < c->n; i++) {
            double e = chosen[i] ? 0.0 : fabs(read_curve(w, n, c->x[i]) - f[i]);
            if (e > largest) {
                largest = e;
                *worst = i;
            }
        }
    }
    return largest;
}

static double add_nodes(const work *w, int n_max, char *chosen, int *n_chosen)
{
    int worst;
    double e = largest_error(w, chosen, &worst);
    while (e > 1.0 && *n_chosen < n_max) {
        chosen[worst] = 1;
        ++*n_chosen;
        e = largest_error(w, chosen, &worst);
    }
    return e;
}

/* For cubics a chain that is too loose for lines may do; the one that ends with the
   fewest nodes is taken. */
static void choose(work *w, int n_max, char *chosen, int *n_chosen, double *largest)
{
    const double looser[] = {1.0, 2.0, 4.0, 8.0};
    int starts = w->c->monotone ? 4 : 1;
    *n_chosen = w->c->n + 1;
    for (int i = 0; i < starts; i++) {
        int n = chain(w, looser[i], w->best);
        double e = add_nodes(w, n_max, w->best, &n);
        if (e > 1.0 || n >= *n_chosen)
            continue;
        *n_chosen = n;
        *largest = e;
        memcpy(chosen, w->best, (size_t)w->c->n);
    }
    for (double limit = LOOSER; *n_chosen > n_max; limit *= LOOSER) {
        int worst, n = chain(w, limit, chosen), fixed = 0;
        for (int i = 0; i < w->c->n; i++)
            fixed += is_fixed(w->c, i);
        *largest = largest_error(w, chosen, &worst);
        *n_chosen = n;
        if (n == fixed)
            break;
    }
}

gm_status gm_choose_nodes(const gm_curves *curves, int n_max, char *chosen, int *n_chosen,
                          double *largest, gm_error *error)
{
    size_t n = (size_t)curves->n;
    double *numbers = gm_calloc(3 * n, sizeof *numbers);
    int *from = gm_calloc(n, sizeof *from);
    char *best = gm_calloc(n, 1);
    gm_status status = GM_OK;
    if (numbers && from && best) {
        work w = {curves, numbers, from, numbers + n, numbers + 2 * n, best};
        choose(&w, n_max, chosen, n_chosen, largest);
    } else {
        status =
            gm_fail(error, GM_ERR_MEMORY, "no memory to choose the nodes of a table");
    }
    gm_free(numbers);
    gm_free(from);
    gm_free(best);
    return status;
}
