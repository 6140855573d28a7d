/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Names of the paths, and whether parts are connected at all. A body is a shaft with its
 * fixed gears, or an idling gear. Meshes join bodies into groups (union-find); with its
 * locks, a gear of a path must join the path's shaft with the output.
 */
#include "base/alloc.h"
#include "model/check.h"

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

static void join(groups *g, int a, int b)
{
    g->parent[find(g, a)] = find(g, b);
}

int gm_check_body(const gm_description *d, int wheel)
{
    return d->wheels[wheel].idles ? d->n_shafts + wheel : d->wheels[wheel].shaft;
}

static gm_status groups_make(groups *g, gm_error *error)
{
    size_t n = (size_t)(g->d->n_shafts + g->d->n_wheels);
    g->parent = gm_calloc(n, sizeof *g->parent);
    return g->parent ? GM_OK : gm_fail(error, GM_ERR_MEMORY, "out of memory");
}

/* A planet passes torque on to its carrier as well. */
static void join_meshes(groups *g)
{
    const gm_description *d = g->d;
    for (int i = 0; i < d->n_shafts + d->n_wheels; i++)
        g->parent[i] = i;
    for (int i = 0; i < d->n_meshes; i++) {
        const int *w = d->meshes[i].wheel;
        join(g, gm_check_body(d, w[0]), gm_check_body(d, w[1]));
        for (int side = 0; side < 2; side++)
            if (d->wheels[w[side]].planets > 0)
                join(g, gm_check_body(d, w[side]), d->wheels[w[side]].shaft);
    }
}

/* A brake connects nothing. */
static void join_locks(groups *g, const gm_path_gear *gear)
{
    const gm_description *d = g->d;
    for (int i = 0; i < gear->n_locks; i++) {
        int index = gear->locks[i].index;
        if (!gear->locks[i].is_clutch)
            join(g, gm_check_body(d, index), d->wheels[index].shaft);
        else if (d->clutches[index].on != GM_HOUSING)
            join(g, d->clutches[index].shaft, d->clutches[index].on);
    }
}

/* One idling gear and no way: neither it nor its shaft is met from one of the ends. */
static gm_status no_chain_of_gear(const groups *g, const gm_path_part *path,
                                  const gm_path_gear *gear, const gm_label *id,
                                  gm_error *error)
{
    const gm_description *d = g->d;
    const gm_wheel *w = &d->wheels[gear->locks[0].index];
    int in = find(g, path->shaft);
    int body = gm_check_body(d, gear->locks[0].index);
    int no_input = find(g, body) != in && find(g, w->shaft) != in;
    return gm_part_fail(
        d, "path", id, error,
        "gear %d: no chain of meshes leads from shaft '%s' to the output "
        "'%s'; with gear '%s' locked to shaft '%s', neither of them meets "
        "the %s",
        gear->number, d->shafts[path->shaft].id.name, d->shafts[d->output].id.name,
        w->id.name, d->shafts[w->shaft].id.name, no_input ? "input" : "output");
}

static gm_status check_chain(groups *g, const gm_path_part *path,
                             const gm_path_gear *gear, gm_error *error)
{
    const gm_description *d = g->d;
    gm_label id = path->id;
    id.line = gear->line;
    join_meshes(g);
    join_locks(g, gear);
    if (find(g, path->shaft) == find(g, d->output))
        return GM_OK;
    if (gear->n_locks == 1 && !gear->locks[0].is_clutch) {
        join_meshes(g);
        return no_chain_of_gear(g, path, gear, &id, error);
    }
    return gm_part_fail(d, "path", &id, error,
                        "gear %d: no chain of meshes and locks leads from shaft '%s' to "
                        "the output '%s'",
                        gear->number, d->shafts[path->shaft].id.name,
                        d->shafts[d->output].id.name);
}

gm_status gm_check_chains(const gm_description *d, gm_error *error)
{
    groups g = {.d = d};
    gm_status status = groups_make(&g, error);
    for (int p = 0; p < d->n_paths; p++)
        for (int i = 0; i < d->paths[p].n_gears && status == GM_OK; i++)
            status = check_chain(&g, &d->paths[p], &d->paths[p].gears[i], error);
    gm_free(g.parent);
    return status;
}

gm_status gm_check_reached(const gm_description *d, int body, int *reached,
                           gm_error *error)
{
    groups g = {.d = d};
    gm_status status = groups_make(&g, error);
    if (status != GM_OK)
        return status;
    join_meshes(&g);
    for (int p = 0; p < d->n_paths; p++)
        join_locks(&g, &d->paths[p].neutral);
    *reached = find(&g, body) == find(&g, d->output);
    for (int p = 0; p < d->n_paths; p++)
        *reached |= find(&g, body) == find(&g, d->paths[p].shaft);
    gm_free(g.parent);
    return GM_OK;
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

gm_status gm_check_paths(const gm_description *d, gm_error *error)
{
    gm_status status = check_path_names(d, error);
    if (status == GM_OK)
        status = gm_check_locks(d, error);
    return status == GM_OK ? gm_check_motion(d, error) : status;
}
