/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Does every configuration move as it should? Meshes and locks are linear equations
 * between the speeds of the bodies, with tooth numbers as coefficients:
 *
 *   z_a (w_a - w_c) + z_b (w_b - w_c) = 0        z < 0: internal teeth, c: carrier
 *   w_wheel - w_shaft = 0, w_shaft - w_on = 0 or w_shaft = 0      locks
 *
 * Reduced to row echelon form one by one, an equation that follows from those before it
 * closes a loop or blocks; a body whose speed is not among what the flanges determine is
 * left free.
 */
#include "base/alloc.h"
#include "model/check.h"

#include <math.h>
#include <string.h>

#define DEPENDENT 1e-9 /* of coefficients that are at most 1 */

typedef struct motion {
    const gm_description *d;
    int n;        /* columns: shafts, wheels (used where a wheel is a body) */
    int n_rows;   /* reduced rows so far */
    int *pivot;   /* [n] column of each row */
    double *rows; /* [n][n] */
    double *next; /* [n] */
} motion;

static gm_status motion_make(motion *m, const gm_description *d, gm_error *error)
{
    size_t n = (size_t)(d->n_shafts + d->n_wheels);
    *m = (motion){.d = d, .n = (int)n};
    m->pivot = gm_calloc(n, sizeof *m->pivot);
    m->rows = gm_calloc(n * n, sizeof *m->rows);
    m->next = gm_calloc(n, sizeof *m->next);
    return m->pivot && m->rows && m->next
               ? GM_OK
               : gm_fail(error, GM_ERR_MEMORY, "out of memory");
}

static void motion_clear(motion *m)
{
    gm_free(m->pivot);
    gm_free(m->rows);
    gm_free(m->next);
}

/* The same equations as *from. */
static void motion_copy(motion *m, const motion *from)
{
    size_t n = (size_t)m->n;
    m->n_rows = from->n_rows;
    memcpy(m->pivot, from->pivot, n * sizeof *m->pivot);
    memcpy(m->rows, from->rows, (size_t)m->n_rows * n * sizeof *m->rows);
}

static void take_off(int n, double *row, const double *other, double factor)
{
    for (int i = 0; i < n && factor != 0.0; i++)
        row[i] -= factor * other[i];
}

/* Add the equation in m->next; 0: it follows from those before it. */
static int add_next(motion *m)
{
    double *row = m->next;
    int n = m->n, best = 0;
    for (int r = 0; r < m->n_rows; r++)
        take_off(n, row, m->rows + r * n, row[m->pivot[r]]);
    for (int i = 1; i < n; i++)
        best = fabs(row[i]) > fabs(row[best]) ? i : best;
    if (fabs(row[best]) <= DEPENDENT || m->n_rows == n)
        return 0;
    double scale = 1.0 / row[best];
    for (int i = 0; i < n; i++)
        row[i] = fabs(row[i]) > DEPENDENT ? scale * row[i] : 0.0;
    for (int r = 0; r < m->n_rows; r++)
        take_off(n, m->rows + r * n, row, m->rows[r * n + best]);
    memcpy(m->rows + m->n_rows * n, row, (size_t)n * sizeof *row);
    m->pivot[m->n_rows++] = best;
    return 1;
}

static int add_body(motion *m, int body)
{
    memset(m->next, 0, (size_t)m->n * sizeof *m->next);
    m->next[body] = 1.0;
    return add_next(m);
}

static int add_equal(motion *m, int a, int b)
{
    memset(m->next, 0, (size_t)m->n * sizeof *m->next);
    m->next[a] += 1.0;
    m->next[b] -= 1.0;
    return add_next(m);
}

static int add_mesh(motion *m, const gm_mesh *mesh)
{
    const gm_description *d = m->d;
    const gm_wheel *w[2] = {&d->wheels[mesh->wheel[0]], &d->wheels[mesh->wheel[1]]};
    double largest = fmax(w[0]->teeth, w[1]->teeth);
    const gm_wheel *planet = w[0]->planets > 0 ? w[0] : w[1];
    memset(m->next, 0, (size_t)m->n * sizeof *m->next);
    for (int side = 0; side < 2; side++) {
        double z = (w[side]->internal ? -1.0 : 1.0) * w[side]->teeth / largest;
        m->next[gm_check_body(d, mesh->wheel[side])] += z;
        if (planet->planets > 0)
            m->next[planet->shaft] -= z;
    }
    return add_next(m);
}

static int add_lock(motion *m, const gm_lock *lock)
{
    const gm_description *d = m->d;
    if (!lock->is_clutch)
        return add_equal(m, gm_check_body(d, lock->index), d->wheels[lock->index].shaft);
    const gm_clutch *c = &d->clutches[lock->index];
    return c->on == GM_HOUSING ? add_body(m, c->shaft) : add_equal(m, c->shaft, c->on);
}

static gm_status add_meshes(motion *m, gm_error *error)
{
    const gm_description *d = m->d;
    for (int i = 0; i < d->n_meshes; i++)
        if (!add_mesh(m, &d->meshes[i]))
            return gm_part_fail(
                d, "mesh", &d->meshes[i].id, error,
                "closes a loop: gears '%s' and '%s' are already connected "
                "through other meshes",
                d->wheels[d->meshes[i].wheel[0]].id.name,
                d->wheels[d->meshes[i].wheel[1]].id.name);
    return GM_OK;
}

/* ---- locks ---- */

static gm_status gear_fail(const gm_description *d, int p, const gm_path_gear *gear,
                           gm_error *error, const char *sentence, const char *name,
                           const char *more)
{
    gm_label id = d->paths[p].id;
    id.line = gear->line;
    return gm_part_fail(d, "path", &id, error, "gear %d: %s '%s'%s", gear->number,
                        sentence, name, more);
}

static int locks_it(const gm_path_gear *gear, const gm_lock *lock)
{
    int found = 0;
    for (int i = 0; i < gear->n_locks; i++)
        found |= gm_same_lock(&gear->locks[i], lock);
    return found;
}

/* What gear of path p locks, unless the other path does so already. */
static gm_status add_locks(motion *m, int p, const gm_path_gear *gear,
                           const gm_path_gear *other, gm_error *error)
{
    for (int i = 0; i < gear->n_locks; i++)
        if (!(other && locks_it(other, &gear->locks[i])) && !add_lock(m, &gear->locks[i]))
            return gear_fail(m->d, p, gear, error, "locking",
                             gm_lock_name(m->d, &gear->locks[i]),
                             " blocks: what else is locked and meshes already holds its "
                             "parts against each other");
    return GM_OK;
}

static const gm_path_gear *rest_of(const gm_path_part *path)
{
    return path->has_neutral ? &path->neutral : &path->gears[0];
}

/* ---- neutral ---- */

static gm_status connected(const gm_description *d, int p, const char *other,
                           gm_error *error)
{
    int locked = 0;
    for (int i = 0; i < d->n_paths; i++)
        locked += d->paths[i].neutral.n_locks;
    return gm_part_fail(d, "path", &d->paths[p].id, error,
                        "its shaft '%s' is connected with %s %s; neutral would not be "
                        "neutral",
                        d->shafts[d->paths[p].shaft].id.name, other,
                        locked > 0 ? "by what is locked in neutral"
                                   : "while nothing is locked");
}

/* Flanges must be free to turn against each other while all paths rest. */
static gm_status check_rest(motion *m, const motion *meshes, gm_error *error)
{
    const gm_description *d = m->d;
    motion_copy(m, meshes);
    for (int p = 0; p < d->n_paths; p++) {
        gm_status status = add_locks(m, p, rest_of(&d->paths[p]),
                                     p > 0 ? rest_of(&d->paths[0]) : NULL, error);
        if (status != GM_OK)
            return status;
    }
    if (!add_body(m, d->output))
        return gm_part_fail(d, "path", &d->paths[0].id, error,
                            "what is locked in neutral holds the output '%s'",
                            d->shafts[d->output].id.name);
    for (int p = 0, other = 0; p < d->n_paths; p++) {
        if (!d->paths[p].has_neutral)
            continue;
        if (!add_body(m, d->paths[p].shaft))
            return connected(d, p, other > 0 ? "the other path" : "the output", error);
        other++;
    }
    return GM_OK;
}

/* Whether the equations leave no other speed than 0 for a body. */
static int is_determined(const motion *m, int body)
{
    for (int r = 0; r < m->n_rows; r++) {
        if (m->pivot[r] != body)
            continue;
        int others = 0;
        for (int i = 0; i < m->n; i++)
            others += i != body && fabs(m->rows[r * m->n + i]) > DEPENDENT;
        return others == 0;
    }
    return 0;
}

/* First body that is left free; -1: none. */
static int free_body(const motion *m)
{
    const gm_description *d = m->d;
    for (int i = 0; i < d->n_shafts; i++)
        if (!is_determined(m, i))
            return i;
    for (int w = 0; w < d->n_wheels; w++)
        if (d->wheels[w].idles && !is_determined(m, d->n_shafts + w))
            return d->n_shafts + w;
    return -1;
}

static gm_status check_rest_complete(const motion *m, gm_error *error)
{
    const gm_description *d = m->d;
    int body = free_body(m), reached = 0;
    if (body < 0)
        return GM_OK;
    int shaft = body < d->n_shafts;
    const gm_label *id = shaft ? &d->shafts[body].id : &d->wheels[body - d->n_shafts].id;
    gm_status status = gm_check_reached(d, body, &reached, error);
    if (status != GM_OK)
        return status;
    return gm_part_fail(d, shaft ? "shaft" : "gear", id, error,
                        reached ? "in neutral its speed follows from no flange; a path "
                                  "must lock one more part in neutral (gear 0)"
                                : "no flange reaches it through meshes: its speed would "
                                  "not be known");
}

/* ---- gears ---- */

static gm_status check_free(const motion *m, int p, const gm_path_gear *gear,
                            gm_error *error)
{
    const gm_description *d = m->d;
    int body = free_body(m);
    if (body < 0)
        return GM_OK;
    return gear_fail(d, p, gear, error, "nothing determines the speed of",
                     body < d->n_shafts ? d->shafts[body].id.name
                                        : d->wheels[body - d->n_shafts].id.name,
                     "; one more part must be locked");
}

/* Path p in `gear`, the other one, if there is one, in `other`. */
static gm_status check_gear(motion *m, const motion *meshes, int p,
                            const gm_path_gear *gear, const gm_path_gear *other,
                            gm_error *error)
{
    const gm_description *d = m->d;
    gm_status status = GM_OK;
    motion_copy(m, meshes);
    if (other)
        status = add_locks(m, 1 - p, other, NULL, error);
    if (status == GM_OK)
        status = add_locks(m, p, gear, other, error);
    if (status != GM_OK)
        return status;
    if (!add_body(m, d->output))
        return gear_fail(d, p, gear, error, "holds the output",
                         d->shafts[d->output].id.name, "");
    if (other && other == &d->paths[1 - p].neutral && !add_body(m, d->paths[1 - p].shaft))
        return gear_fail(d, p, gear, error, "leaves no neutral to path",
                         d->paths[1 - p].id.name, "");
    return check_free(m, p, gear, error);
}

static gm_status check_gears(motion *m, const motion *meshes, gm_error *error)
{
    const gm_description *d = m->d;
    gm_status status = GM_OK;
    for (int p = 0; p < d->n_paths; p++)
        for (int i = 0; i < d->paths[p].n_gears && status == GM_OK; i++)
            status = check_gear(m, meshes, p, &d->paths[p].gears[i],
                                d->n_paths > 1 ? rest_of(&d->paths[1 - p]) : NULL, error);
    for (int i = 0; d->n_paths > 1 && i < d->paths[0].n_gears; i++)
        for (int k = 0; k < d->paths[1].n_gears && status == GM_OK; k++)
            status = check_gear(m, meshes, 1, &d->paths[1].gears[k],
                                &d->paths[0].gears[i], error);
    return status;
}

gm_status gm_check_motion(const gm_description *d, gm_error *error)
{
    motion meshes, m = {.d = NULL};
    gm_status status = motion_make(&meshes, d, error);
    if (status == GM_OK)
        status = motion_make(&m, d, error);
    if (status == GM_OK)
        status = add_meshes(&meshes, error);
    if (status == GM_OK)
        status = check_rest(&m, &meshes, error);
    if (status == GM_OK)
        status = gm_check_chains(d, error);
    if (status == GM_OK)
        status = check_rest_complete(&m, error);
    if (status == GM_OK)
        status = check_gears(&m, &meshes, error);
    motion_clear(&meshes);
    motion_clear(&m);
    return status;
}
