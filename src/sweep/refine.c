/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/refine.h"

#include "base/alloc.h"
#include "sweep/refine_parts.h"

#include <math.h>
#include <string.h>

#define MAX_ROUNDS 40 /* of points held out */

static gm_status no_memory(gm_error *error)
{
    return gm_fail(error, GM_ERR_MEMORY, "no memory to refine the axes of a table");
}

/* A key of the memo: axes that there are not, and -0.0, count as 0. */
static void key_of(const gm_refine *r, const double *x, double key[GM_MAX_AXES])
{
    for (int a = 0; a < GM_MAX_AXES; a++)
        key[a] = a < r->spec.n_axes ? x[a] + 0.0 : 0.0;
}

gm_status gm_refine_want(gm_refine *refine, const double *x, gm_error *error)
{
    double key[GM_MAX_AXES];
    key_of(refine, x, key);
    if (gm_memo_find(refine->memo, key) || gm_memo_add(refine->memo, key))
        return GM_OK;
    return no_memory(error);
}

const double *gm_refine_sample(const gm_refine *refine, const double *x)
{
    double key[GM_MAX_AXES];
    key_of(refine, x, key);
    return gm_memo_find(refine->memo, key);
}

gm_status gm_refine_create(const gm_refine_spec *spec, gm_refine **refine,
                           gm_error *error)
{
    gm_refine *made = gm_calloc(1, sizeof *made);
    if (!made)
        return no_memory(error);
    made->spec = *spec;
    made->random = spec->seed;
    made->memo = gm_memo_create(GM_MAX_AXES * sizeof(double),
                                2 * (size_t)spec->n_values * sizeof(double));
    if (spec->is_sum)
        made->rest = gm_calloc((size_t)spec->n_values / 2 * GM_NODES_MAX, sizeof(double));
    int complete = made->memo && (made->rest || !spec->is_sum);
    gm_status status = complete ? gm_refine_lines_begin(made, error) : no_memory(error);
    if (status == GM_OK)
        *refine = made;
    else
        gm_refine_destroy(made);
    return status;
}

void gm_refine_destroy(gm_refine *refine)
{
    if (!refine)
        return;
    gm_memo_destroy(refine->memo);
    gm_free(refine->rest);
    for (int k = 0; k < GM_REFINE_VALUES; k++)
        gm_free(refine->grid[k]);
    gm_free(refine);
}

int gm_refine_wanted(const gm_refine *refine)
{
    return (int)(gm_memo_count(refine->memo) - refine->known);
}

const double *gm_refine_point(const gm_refine *refine, int i)
{
    return gm_memo_key(refine->memo, refine->known + i);
}

void gm_refine_tell(gm_refine *refine, int i, const gm_sample *sample)
{
    double *to = gm_memo_value(refine->memo, refine->known + i);
    size_t n = (size_t)refine->spec.n_values;
    memcpy(to, sample->value, n * sizeof *to);
    memcpy(to + n, sample->size, n * sizeof *to);
}

/* Sizes grow with what is found, and the tolerances with them. */
static void take_in(gm_refine *r)
{
    const gm_refine_spec *spec = &r->spec;
    for (; r->known < gm_memo_count(r->memo); r->known++) {
        const double *size =
            (const double *)gm_memo_value(r->memo, r->known) + spec->n_values;
        for (int k = 0; k < spec->n_values; k++)
            r->largest[k] = fmax(r->largest[k], size[k]);
    }
    for (int k = 0; k < spec->n_values; k++)
        r->state.tolerance[k] =
            fmax(spec->noise[k], fmax(spec->absolute[k], spec->share * r->largest[k]));
}

static gm_status advance_lines(gm_refine *r, gm_error *error)
{
    gm_status status = gm_refine_lines_advance(r, error);
    if (status != GM_OK || gm_refine_wanted(r) > 0)
        return status;
    r->stage = GM_REFINE_FILL;
    status = gm_refine_lines_choose(r, error);
    return status == GM_OK ? gm_refine_grid_fill(r, error) : status;
}

static gm_status advance_check(gm_refine *r, gm_error *error)
{
    int clean = 1;
    gm_status status = gm_refine_grid_compare(r, &clean, error);
    r->stage = clean || ++r->rounds >= MAX_ROUNDS ? GM_REFINE_DONE : GM_REFINE_FILL;
    return status == GM_OK && r->stage == GM_REFINE_FILL ? gm_refine_grid_fill(r, error)
                                                         : status;
}

static gm_status advance_fill(gm_refine *r, gm_error *error)
{
    r->stage = GM_REFINE_CHECK;
    return gm_refine_grid_hold_out(r, error);
}

gm_status gm_refine_advance(gm_refine *refine, gm_error *error)
{
    gm_status status = GM_OK;
    take_in(refine);
    do { /* a stage may find that it knows all it wants */
        if (refine->stage == GM_REFINE_LINES)
            status = advance_lines(refine, error);
        else if (refine->stage == GM_REFINE_FILL)
            status = advance_fill(refine, error);
        else if (refine->stage == GM_REFINE_CHECK)
            status = advance_check(refine, error);
    } while (status == GM_OK && refine->stage != GM_REFINE_DONE &&
             gm_refine_wanted(refine) == 0);
    return status;
}

const gm_nodes *gm_refine_nodes(const gm_refine *refine, int axis)
{
    return &refine->nodes[axis];
}

gm_refine_state gm_refine_state_of(const gm_refine *refine)
{
    return refine->state;
}
