/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Breadth-first search over parts: node i < n_shafts is a shaft, the others are gears. A
 * gear is connected with its shaft when it is fixed there or locked, and with its mates.
 */
#include "power_flow.h"

#include "base/alloc.h"

#include <string.h>

#define NOWHERE (-1)

typedef struct search {
    const gm_description *d;
    int locked;            /* gear that is locked to its shaft */
    int *previous, *queue; /* [n] */
    int n, head, tail;
} search;

static void visit(search *s, int node, int from)
{
    if (s->previous[node] != NOWHERE)
        return;
    s->previous[node] = from;
    s->queue[s->tail++] = node;
}

static int is_fixed(const search *s, int wheel)
{
    return !s->d->wheels[wheel].idles || wheel == s->locked;
}

static void visit_neighbours(search *s, int node)
{
    const gm_description *d = s->d;
    int wheel = node - d->n_shafts;
    for (int w = 0; w < d->n_wheels && wheel < 0; w++)
        if (d->wheels[w].shaft == node && is_fixed(s, w))
            visit(s, d->n_shafts + w, node);
    if (wheel < 0)
        return;
    if (is_fixed(s, wheel))
        visit(s, d->wheels[wheel].shaft, node);
    for (int m = 0; m < d->n_meshes; m++)
        for (int side = 0; side < 2; side++)
            if (d->meshes[m].wheel[side] == wheel)
                visit(s, d->n_shafts + d->meshes[m].wheel[1 - side], node);
}

/* Follow the search back from the output; the start is its own predecessor. */
static gm_status collect(const search *s, int target, gm_power_flow *flow,
                         gm_error *error)
{
    int n = 1;
    for (int node = target; s->previous[node] != node; node = s->previous[node])
        n++;
    const char **parts = gm_calloc((size_t)n, sizeof *parts);
    if (!parts)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    int node = target;
    for (int i = n - 1; i >= 0; i--, node = s->previous[node])
        parts[i] = node < s->d->n_shafts ? s->d->shafts[node].id.name
                                         : s->d->wheels[node - s->d->n_shafts].id.name;
    flow->n = n;
    flow->parts = parts;
    return GM_OK;
}

gm_status gm_power_flow_find(const gm_description *description, int p, int g,
                             gm_power_flow *flow, gm_error *error)
{
    const gm_path_part *path = &description->paths[p];
    search s = {.d = description,
                .locked = path->gears[g].wheel,
                .n = description->n_shafts + description->n_wheels};
    gm_status status = GM_OK;
    memset(flow, 0, sizeof *flow);
    s.previous = gm_calloc((size_t)s.n, sizeof *s.previous);
    s.queue = gm_calloc((size_t)s.n, sizeof *s.queue);
    if (!s.previous || !s.queue) {
        status = gm_fail(error, GM_ERR_MEMORY, "out of memory");
        goto done;
    }
    for (int i = 0; i < s.n; i++)
        s.previous[i] = NOWHERE;
    visit(&s, path->shaft, path->shaft);
    while (s.head < s.tail)
        visit_neighbours(&s, s.queue[s.head++]);
    if (s.previous[description->output] != NOWHERE)
        status = collect(&s, description->output, flow, error);
done:
    gm_free(s.previous);
    gm_free(s.queue);
    return status;
}

void gm_power_flow_clear(gm_power_flow *flow)
{
    gm_free(flow->parts);
    memset(flow, 0, sizeof *flow);
}
