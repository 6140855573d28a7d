/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The lines of a refinement: sampling by halving, and the choice of the nodes.
 */
#include "sweep/refine_parts.h"

#include "base/alloc.h"
#include "sweep/choose.h"

#include <math.h>
#include <string.h>

/* An interval is halved once more while its middle is further than this from the straight
   line between its ends, in the axis's share of the tolerance: what then lies between
   samples is about a quarter of it. */
#define HALVE 0.5
/* So are the intervals beside a sample that is further than this from the line between
   its neighbours: a kink near it can hide in a middle that happens to lie on the line. */
#define BENT 1.5
/* Of the axis's share of the tolerance, for the choice; the rest is for what lies between
   samples and lines. */
#define CHOOSE 0.85

int gm_refine_line_count(const gm_refine *refine, int axis)
{
    int n = 1;
    for (int a = 0; a < refine->spec.n_axes; a++)
        n *= a == axis ? 1 : refine->spec.axis[a].n_cuts;
    return n;
}

void gm_refine_line(const gm_refine *refine, int axis, int number, double *x)
{
    for (int a = 0; a < refine->spec.n_axes; a++) {
        const gm_refine_axis *of = &refine->spec.axis[a];
        if (a == axis)
            continue;
        x[a] = of->cut[number % of->n_cuts];
        number /= of->n_cuts;
    }
}

/* All lines at one coordinate. */
static gm_status want_across(gm_refine *r, int axis, double at, gm_error *error)
{
    gm_status status = GM_OK;
    int n = gm_refine_line_count(r, axis);
    for (int line = 0; line < n && status == GM_OK; line++) {
        double x[GM_MAX_AXES] = {0.0};
        gm_refine_line(r, axis, line, x);
        x[axis] = at;
        status = gm_refine_want(r, x, error);
    }
    return status;
}

gm_status gm_refine_lines_begin(gm_refine *refine, gm_error *error)
{
    gm_status status = GM_OK;
    for (int a = 0; a < refine->spec.n_axes; a++) {
        const gm_nodes *start = &refine->spec.axis[a].start;
        gm_refine_samples *s = &refine->samples[a];
        s->n = start->n;
        for (int i = 0; i < start->n && status == GM_OK; i++) {
            s->x[i] = start->x[i];
            s->open[i] = i + 1 < start->n &&
                         start->x[i + 1] - start->x[i] > refine->spec.axis[a].shortest;
            status = want_across(refine, a, s->x[i], error);
        }
    }
    return status;
}

static double value_on(const gm_refine *r, int axis, int line, double at, int k)
{
    double x[GM_MAX_AXES] = {0.0};
    gm_refine_line(r, axis, line, x);
    x[axis] = at;
    return gm_refine_sample(r, x)[k];
}

static double middle(const gm_refine_samples *s, int i)
{
    return 0.5 * (s->x[i] + s->x[i + 1]);
}

/* How far the curves at x are from straight lines between a and b, on any line, in the
   axis's share of the tolerance. */
static double bend(const gm_refine *r, int axis, double a, double x, double b)
{
    int n = gm_refine_line_count(r, axis);
    double largest = 0.0, part = (x - a) / (b - a);
    for (int line = 0; line < n; line++)
        for (int k = 0; k < r->spec.n_values; k++) {
            double from = value_on(r, axis, line, a, k),
                   to = value_on(r, axis, line, b, k);
            double off = from + part * (to - from) - value_on(r, axis, line, x, k);
            largest = fmax(largest, fabs(off) / r->state.tolerance[k]);
        }
    return largest * r->spec.n_axes;
}

/* Put the middles of the halved intervals between the samples. */
static void halve(const gm_refine *r, int axis, gm_refine_samples *s)
{
    gm_refine_samples next = {.n = 0};
    double shortest = r->spec.axis[axis].shortest;
    for (int i = 0; i < s->n; i++) {
        next.open[next.n] = 0;
        next.x[next.n++] = s->x[i];
        if (!s->open[i])
            continue;
        double off = bend(r, axis, s->x[i], middle(s, i), s->x[i + 1]);
        char open = off > HALVE && s->x[i + 1] - s->x[i] > 2.0 * shortest;
        next.open[next.n - 1] = open;
        next.open[next.n] = open;
        next.x[next.n++] = middle(s, i);
    }
    *s = next;
}

/* When no middle is off any more: open the intervals beside samples that are. */
static void open_beside_bends(const gm_refine *r, int axis, gm_refine_samples *s)
{
    for (int i = 1; i + 1 < s->n; i++)
        if (bend(r, axis, s->x[i - 1], s->x[i], s->x[i + 1]) > BENT)
            for (int side = i - 1; side <= i; side++)
                s->open[side] = s->x[side + 1] - s->x[side] > r->spec.axis[axis].shortest;
}

static int open_intervals(const gm_refine_samples *s)
{
    int n = 0;
    for (int i = 0; i + 1 < s->n; i++)
        n += s->open[i];
    return s->n + n <= GM_REFINE_SAMPLES ? n : 0;
}

gm_status gm_refine_lines_advance(gm_refine *refine, gm_error *error)
{
    gm_status status = GM_OK;
    for (int a = 0; a < refine->spec.n_axes; a++) {
        gm_refine_samples *s = &refine->samples[a];
        if (s->halving)
            halve(refine, a, s);
        if (open_intervals(s) == 0)
            open_beside_bends(refine, a, s);
        s->halving = open_intervals(s) > 0;
        for (int i = 0; i + 1 < s->n && s->halving && status == GM_OK; i++)
            if (s->open[i])
                status = want_across(refine, a, middle(s, i), error);
    }
    return status;
}

/* ---- the choice ---- */

static char is_fixed(const gm_refine_axis *axis, double x)
{
    for (int i = 0; i < axis->n_fixed; i++)
        if (axis->fixed[i] == x)
            return 1;
    return 0;
}

/* The curves of all lines and quantities, in tolerances of the choice. */
static void fill_curves(const gm_refine *r, int axis, char *fixed, double *value)
{
    const gm_refine_samples *s = &r->samples[axis];
    int n_lines = gm_refine_line_count(r, axis);
    for (int i = 0; i < s->n; i++)
        fixed[i] = is_fixed(&r->spec.axis[axis], s->x[i]);
    for (int line = 0; line < n_lines; line++)
        for (int k = 0; k < r->spec.n_values; k++) {
            double unit = CHOOSE * r->state.tolerance[k] / r->spec.n_axes;
            for (int i = 0; i < s->n; i++)
                *value++ = value_on(r, axis, line, s->x[i], k) / unit;
        }
}

static gm_status choose(gm_refine *r, int axis, gm_error *error)
{
    const gm_refine_samples *s = &r->samples[axis];
    int n_curves = gm_refine_line_count(r, axis) * r->spec.n_values, n_chosen;
    double largest = 0.0;
    double *value = gm_calloc((size_t)s->n * (size_t)n_curves, sizeof *value);
    char *marks = gm_calloc(2 * (size_t)s->n, 1), *chosen = marks + s->n;
    gm_status status = GM_ERR_MEMORY;
    if (value && marks) {
        fill_curves(r, axis, marks, value);
        gm_curves curves = {
            s->n, s->x, n_curves, value, marks, r->spec.n_axes == 1, r->spec.monotone};
        status = gm_choose_nodes(&curves, r->spec.axis[axis].n_max, chosen, &n_chosen,
                                 &largest, error);
    } else {
        gm_fail(error, status, "no memory to refine the axes of a table");
    }
    gm_nodes *nodes = &r->nodes[axis];
    nodes->n = 0;
    for (int i = 0; i < s->n && status == GM_OK; i++)
        if (chosen[i])
            nodes->x[nodes->n++] = s->x[i];
    if (status == GM_OK && largest > 1.0 && r->spec.axis[axis].otherwise.n > 0)
        *nodes = r->spec.axis[axis].otherwise;
    gm_free(value);
    gm_free(marks);
    return status;
}

gm_status gm_refine_lines_choose(gm_refine *refine, gm_error *error)
{
    gm_status status = GM_OK;
    for (int a = 0; a < refine->spec.n_axes && status == GM_OK; a++)
        status = choose(refine, a, error);
    return status;
}
