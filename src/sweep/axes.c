/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/axes.h"

#include <math.h>
#include <string.h>

void gm_nodes_power(int n, double max, double k, gm_nodes *nodes)
{
    nodes->n = n;
    for (int i = 0; i < n; i++)
        nodes->x[i] = max * pow((double)i / (n - 1), k);
    nodes->x[n - 1] = max;
}

void gm_nodes_growth(int n, double max, double share, gm_nodes *nodes)
{
    nodes->n = n;
    for (int i = 0; i < n; i++)
        nodes->x[i] = max * share * (pow(1.0 + 1.0 / share, (double)i / (n - 1)) - 1.0);
    nodes->x[n - 1] = max;
}

gm_status gm_nodes_uniform(double max, double step, const char *what, gm_nodes *nodes,
                           gm_error *error)
{
    /* A last step shorter than 1e-9 of a step is rounding, not a node. */
    double steps = ceil(max / step - 1e-9);
    if (!(steps < GM_NODES_MAX / 2 - 2))
        return gm_fail(error, GM_ERR_ARGUMENT,
                       "%s axis: steps of %g up to %g are %.0f nodes, more than %d", what,
                       step, max, steps + 1, GM_NODES_MAX / 2 - 2);
    nodes->n = (int)steps + 1;
    for (int i = 0; i < nodes->n; i++)
        nodes->x[i] = step * i;
    nodes->x[nodes->n - 1] = max;
    return GM_OK;
}

/* Index of the first node that is not below x. */
static int first_from(const gm_nodes *nodes, double x)
{
    int i = 0;
    while (i < nodes->n && nodes->x[i] < x)
        i++;
    return i;
}

/* Place of a new node x, 0: none, it is outside or on a node. */
static int place_for(const gm_nodes *nodes, double x)
{
    int i = first_from(nodes, x);
    if (i == 0 || i == nodes->n ||
        fmin(x - nodes->x[i - 1], nodes->x[i] - x) <= 1e-9 * fabs(x))
        return 0;
    return i;
}

void gm_nodes_add(double x, int n_max, gm_nodes *nodes)
{
    int i = place_for(nodes, x);
    if (i == 0 || nodes->n >= n_max || nodes->n >= GM_NODES_MAX)
        return;
    size_t tail = (size_t)(nodes->n - i);
    memmove(&nodes->x[i + 1], &nodes->x[i], tail * sizeof nodes->x[0]);
    nodes->x[i] = x;
    nodes->n++;
}

void gm_nodes_include(double x, int n_max, gm_nodes *nodes)
{
    int i = place_for(nodes, x);
    if (i == 0)
        return;
    if (nodes->n < n_max && nodes->n < GM_NODES_MAX) {
        gm_nodes_add(x, n_max, nodes);
        return;
    }
    if (nodes->n < 3)
        return;
    double below = x - nodes->x[i - 1], above = nodes->x[i] - x;
    int nearest = below < above ? i - 1 : i;
    if (nearest == 0)
        nearest = 1;
    if (nearest == nodes->n - 1)
        nearest = nodes->n - 2;
    nodes->x[nearest] = x;
}

void gm_nodes_extend(double end, int n, gm_nodes *nodes)
{
    double from = nodes->x[nodes->n - 1];
    for (int i = 1; i <= n; i++)
        nodes->x[nodes->n - 1 + i] = from * pow(end / from, (double)i / n);
    nodes->n += n;
    nodes->x[nodes->n - 1] = end;
}

void gm_nodes_scale(double factor, gm_nodes *nodes)
{
    for (int i = 0; i < nodes->n; i++)
        nodes->x[i] *= factor;
}

void gm_nodes_mirror(const gm_nodes *below, gm_nodes *nodes)
{
    gm_nodes both = {.n = below->n - 1 + nodes->n};
    for (int i = 1; i < below->n; i++)
        both.x[below->n - 1 - i] = -below->x[i];
    for (int i = 0; i < nodes->n; i++)
        both.x[below->n - 1 + i] = nodes->x[i];
    *nodes = both;
}
