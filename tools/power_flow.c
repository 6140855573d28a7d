/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Breadth-first search over parts: node i < n_shafts is a shaft, the others are gears. A
 * gear is connected with its shaft when it is fixed there or locked, a planet with its
 * carrier, every gear with its mates, and shafts by closed clutches. A shaft held by a
 * brake passes nothing on.
 */
#include "power_flow.h"

#include "base/alloc.h"

#include <string.h>

#define NOWHERE (-1)

typedef struct search {
    const gm_description *d;
    const gm_path_gear *locked[GM_MAX_INPUT_PATHS]; /* what is locked */
    const unsigned char *loaded;                    /* [n_meshes] */
    int *previous, *queue;                          /* [n] */
    int n, head, tail;
} search;

static int locks(const search *s, int is_clutch, int index)
{
    int found = 0;
    for (int p = 0; p < s->d->n_paths; p++)
        for (int i = 0; i < s->locked[p]->n_locks; i++)
            found |= s->locked[p]->locks[i].is_clutch == is_clutch &&
                     s->locked[p]->locks[i].index == index;
    return found;
}

static int is_held(const search *s, int shaft)
{
    for (int i = 0; i < s->d->n_clutches; i++)
        if (s->d->clutches[i].shaft == shaft && s->d->clutches[i].on == GM_HOUSING &&
            locks(s, 1, i))
            return 1;
    return 0;
}

static void visit(search *s, int node, int from)
{
    if (s->previous[node] != NOWHERE || (node < s->d->n_shafts && is_held(s, node)))
        return;
    s->previous[node] = from;
    s->queue[s->tail++] = node;
}

static int is_fixed(const search *s, int wheel)
{
    const gm_wheel *w = &s->d->wheels[wheel];
    return !w->idles || w->planets > 0 || locks(s, 0, wheel);
}

static void visit_clutches(search *s, int shaft)
{
    for (int i = 0; i < s->d->n_clutches; i++) {
        const gm_clutch *c = &s->d->clutches[i];
        if (c->on == GM_HOUSING || !locks(s, 1, i))
            continue;
        if (c->shaft == shaft)
            visit(s, c->on, shaft);
        if (c->on == shaft)
            visit(s, c->shaft, shaft);
    }
}

static void visit_neighbours(search *s, int node)
{
    const gm_description *d = s->d;
    int wheel = node - d->n_shafts;
    for (int w = 0; w < d->n_wheels && wheel < 0; w++)
        if (d->wheels[w].shaft == node && is_fixed(s, w))
            visit(s, d->n_shafts + w, node);
    if (wheel < 0) {
        visit_clutches(s, node);
        return;
    }
    if (is_fixed(s, wheel))
        visit(s, d->wheels[wheel].shaft, node);
    for (int m = 0; m < d->n_meshes; m++)
        for (int side = 0; side < 2; side++)
            if (s->loaded[m] && d->meshes[m].wheel[side] == wheel)
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
                             const unsigned char *loaded, gm_power_flow *flow,
                             gm_error *error)
{
    const gm_path_part *path = &description->paths[p];
    search s = {.d = description,
                .loaded = loaded,
                .n = description->n_shafts + description->n_wheels};
    for (int i = 0; i < description->n_paths; i++) {
        const gm_path_part *other = &description->paths[i];
        s.locked[i] = other->has_neutral ? &other->neutral : &other->gears[0];
    }
    s.locked[p] = &path->gears[g];
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
