/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Synchronisers, paths, and which bodies the meshes connect. A body is a shaft with its
 * fixed gears, or an idling gear. Meshes join bodies into groups (union-find); a gear of
 * a path locks its wheel to its shaft and must join the group of the path's shaft with
 * the group of the output. No mesh may join two bodies that are in one group already:
 * such a loop is blocked or not determined.
 */
#include "base/alloc.h"
#include "model/check.h"

#include <math.h>
#include <string.h>

typedef struct groups {
    const gm_description *d;
    int *parent; /* [n_shafts + n_wheels] */
} groups;

static int find(const groups *g, int body)
{
    while (g->parent[body] != body)
        body = g->parent[body];
    return body;
}

static int wheel_body(const gm_description *d, int wheel)
{
    return d->wheels[wheel].idles ? d->n_shafts + wheel : d->wheels[wheel].shaft;
}

static gm_status join_meshes(groups *g, gm_error *error)
{
    const gm_description *d = g->d;
    for (int i = 0; i < d->n_shafts + d->n_wheels; i++)
        g->parent[i] = i;
    for (int i = 0; i < d->n_meshes; i++) {
        int a = find(g, wheel_body(d, d->meshes[i].wheel[0]));
        int b = find(g, wheel_body(d, d->meshes[i].wheel[1]));
        if (a == b)
            return gm_part_fail(
                d, "mesh", &d->meshes[i].id, error,
                "closes a loop: gears '%s' and '%s' are already connected "
                "through other meshes",
                d->wheels[d->meshes[i].wheel[0]].id.name,
                d->wheels[d->meshes[i].wheel[1]].id.name);
        g->parent[a] = b;
    }
    return GM_OK;
}

static int synchronisers_of(const gm_description *d, int wheel)
{
    int n = 0;
    for (int i = 0; i < d->n_synchronisers; i++)
        for (int k = 0; k < d->synchronisers[i].n_wheels; k++)
            n += d->synchronisers[i].wheels[k] == wheel;
    return n;
}

static gm_status check_synchroniser(const gm_description *d, const gm_synchroniser *s,
                                    gm_error *error)
{
    for (int k = 0; k < s->n_wheels; k++) {
        const gm_wheel *w = &d->wheels[s->wheels[k]];
        if (w->shaft != s->shaft)
            return gm_part_fail(d, "synchroniser", &s->id, error,
                                "gear '%s' must be on its shaft '%s', found on '%s'",
                                w->id.name, d->shafts[s->shaft].id.name,
                                d->shafts[w->shaft].id.name);
        if (!w->idles)
            return gm_part_fail(d, "synchroniser", &s->id, error,
                                "gear '%s' must idle on its shaft, found it fixed",
                                w->id.name);
        if (synchronisers_of(d, s->wheels[k]) > 1)
            return gm_part_fail(d, "synchroniser", &s->id, error,
                                "gear '%s' can have 1 synchroniser, found %d", w->id.name,
                                synchronisers_of(d, s->wheels[k]));
    }
    return GM_OK;
}

static gm_status path_gear_fail(const gm_description *d, const gm_path_part *path,
                                const gm_path_gear *gear, gm_error *error,
                                const char *sentence, const char *name, const char *more)
{
    gm_label id = path->id;
    id.line = gear->line;
    return gm_part_fail(d, "path", &id, error, "gear %d: %s '%s'%s", gear->number,
                        sentence, name, more);
}

static gm_status check_lock(const gm_description *d, const gm_path_part *path,
                            const gm_path_gear *gear, gm_error *error)
{
    const gm_wheel *w = &d->wheels[gear->wheel];
    if (gear->number == 0)
        return path_gear_fail(d, path, gear, error,
                              "0 is neutral, which locks nothing; found the lock",
                              w->id.name, "");
    if (gear->ratio == 0.0)
        return path_gear_fail(d, path, gear, error, "ratio must not be 0; found 0 for",
                              w->id.name, "");
    if (!w->idles)
        return path_gear_fail(d, path, gear, error,
                              "only an idling gear can be locked; found the fixed gear",
                              w->id.name, "");
    if (synchronisers_of(d, gear->wheel) == 0)
        return path_gear_fail(d, path, gear, error, "no synchroniser locks gear",
                              w->id.name, "; expected 1, found 0");
    return GM_OK;
}

/* The same gear under two numbers. */
static gm_status check_lock_once(const gm_description *d, const gm_path_part *path, int i,
                                 gm_error *error)
{
    const gm_path_gear *gear = &path->gears[i];
    gm_label id = path->id;
    id.line = gear->line;
    for (int k = 0; k < i; k++)
        if (path->gears[k].wheel == gear->wheel)
            return gm_part_fail(
                d, "path", &id, error,
                "gear %d: locks '%s', already locked by gear %d in line %d", gear->number,
                d->wheels[gear->wheel].id.name, path->gears[k].number,
                path->gears[k].line);
    return GM_OK;
}

static gm_status check_chain(const groups *g, const gm_path_part *path,
                             const gm_path_gear *gear, gm_error *error)
{
    const gm_description *d = g->d;
    const gm_wheel *w = &d->wheels[gear->wheel];
    int ends[2] = {find(g, wheel_body(d, gear->wheel)), find(g, w->shaft)};
    int in = find(g, path->shaft), out = find(g, d->output);
    if ((ends[0] == in && ends[1] == out) || (ends[0] == out && ends[1] == in))
        return GM_OK;
    gm_label id = path->id;
    id.line = gear->line;
    int no_input = ends[0] != in && ends[1] != in;
    return gm_part_fail(
        d, "path", &id, error,
        "gear %d: no chain of meshes leads from shaft '%s' to the output "
        "'%s'; with gear '%s' locked to shaft '%s', neither of them meets "
        "the %s",
        gear->number, d->shafts[path->shaft].id.name, d->shafts[d->output].id.name,
        w->id.name, d->shafts[w->shaft].id.name, no_input ? "input" : "output");
}

static gm_status check_path(const groups *g, const gm_path_part *path, gm_error *error)
{
    gm_status status = GM_OK;
    for (int i = 0; i < path->n_gears && status == GM_OK; i++) {
        const gm_path_gear *gear = &path->gears[i];
        if (i > 0 && gear[-1].number == gear->number)
            return path_gear_fail(
                g->d, path, gear, error,
                "a number stands for one gear; found it twice, here for",
                g->d->wheels[gear->wheel].id.name, "");
        status = check_lock(g->d, path, gear, error);
        if (status == GM_OK)
            status = check_lock_once(g->d, path, i, error);
        if (status == GM_OK)
            status = check_chain(g, path, gear, error);
    }
    return status;
}

static gm_status check_path_names(const gm_description *d, gm_error *error)
{
    static const char *const one[] = {"input"}, *const two[] = {"odd", "even"};
    const char *const *names = d->n_paths == 1 ? one : two;
    for (int i = 0; i < d->n_paths; i++)
        if (strcmp(d->paths[i].id.name, names[i]) != 0)
            return gm_part_fail(d, "path", &d->paths[i].id, error,
                                "%s; expected the name '%s'",
                                d->n_paths == 1 ? "a single path is called input"
                                                : "two paths are called odd and even",
                                names[i]);
    return GM_OK;
}

/* Flanges must be free to turn against each other while nothing is locked. */
static gm_status check_flanges(const groups *g, gm_error *error)
{
    const gm_description *d = g->d;
    for (int i = 0; i < d->n_paths; i++) {
        int group = find(g, d->paths[i].shaft);
        const char *other = NULL;
        if (group == find(g, d->output))
            other = "the output";
        for (int k = 0; k < i; k++)
            if (group == find(g, d->paths[k].shaft))
                other = "the other path";
        if (other)
            return gm_part_fail(d, "path", &d->paths[i].id, error,
                                "its shaft '%s' is connected with %s while nothing is "
                                "locked; neutral would not be neutral",
                                d->shafts[d->paths[i].shaft].id.name, other);
    }
    return GM_OK;
}

static int is_reached(const groups *g, int body)
{
    int group = find(g, body);
    int reached = group == find(g, g->d->output);
    for (int i = 0; i < g->d->n_paths; i++)
        reached |= group == find(g, g->d->paths[i].shaft);
    return reached;
}

static gm_status check_reached(const groups *g, gm_error *error)
{
    const gm_description *d = g->d;
    const char *rule =
        "no flange reaches it through meshes: its speed would not be known";
    for (int i = 0; i < d->n_shafts; i++)
        if (!is_reached(g, i))
            return gm_part_fail(d, "shaft", &d->shafts[i].id, error, "%s", rule);
    for (int i = 0; i < d->n_wheels; i++)
        if (!is_reached(g, wheel_body(d, i)))
            return gm_part_fail(d, "gear", &d->wheels[i].id, error, "%s", rule);
    return GM_OK;
}

static gm_status check_graph(groups *g, gm_error *error)
{
    const gm_description *d = g->d;
    gm_status status = join_meshes(g, error);
    if (status == GM_OK)
        status = check_flanges(g, error);
    for (int i = 0; i < d->n_paths && status == GM_OK; i++)
        status = check_path(g, &d->paths[i], error);
    if (status == GM_OK)
        status = check_reached(g, error);
    return status;
}

gm_status gm_check_paths(const gm_description *d, gm_error *error)
{
    gm_status status = check_path_names(d, error);
    for (int i = 0; i < d->n_synchronisers && status == GM_OK; i++)
        status = check_synchroniser(d, &d->synchronisers[i], error);
    if (status != GM_OK)
        return status;
    groups g = {.d = d};
    g.parent = gm_calloc((size_t)(d->n_shafts + d->n_wheels), sizeof *g.parent);
    if (!g.parent)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    status = check_graph(&g, error);
    gm_free(g.parent);
    return status;
}
