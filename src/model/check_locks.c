/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Synchronisers and clutches, and what the gears of a path say that they lock. Whether
 * the gearset then moves as it should is looked at in check_motion.c.
 */
#include "model/check.h"

#include <math.h>
#include <string.h>

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
        if (!w->idles || w->planets > 0)
            return gm_part_fail(d, "synchroniser", &s->id, error,
                                "gear '%s' must idle on its shaft, found it %s",
                                w->id.name, w->planets > 0 ? "a planet" : "fixed");
        if (synchronisers_of(d, s->wheels[k]) > 1)
            return gm_part_fail(d, "synchroniser", &s->id, error,
                                "gear '%s' can have 1 synchroniser, found %d", w->id.name,
                                synchronisers_of(d, s->wheels[k]));
    }
    return GM_OK;
}

static gm_status check_surfaces(const gm_description *d, const gm_clutch *c,
                                gm_error *error)
{
    int given = !isnan(c->inner_radius) + !isnan(c->outer_radius) + !isnan(c->clearance);
    if (c->surfaces == 0 && (given > 0 || !isnan(c->feed)))
        return gm_part_fail(d, "clutch", &c->id, error,
                            "radii, clearance and oil feed have an effect only with "
                            "friction_surfaces, found 0 of them");
    if (c->surfaces > 0 && given < 3)
        return gm_part_fail(d, "clutch", &c->id, error,
                            "friction surfaces need inner_radius_mm, outer_radius_mm and "
                            "clearance_mm");
    if (c->surfaces > 0 && !(c->inner_radius < c->outer_radius))
        return gm_part_fail(d, "clutch", &c->id, error,
                            "inner_radius_mm must be less than outer_radius_mm; found "
                            "%.6g and %.6g",
                            1e3 * c->inner_radius, 1e3 * c->outer_radius);
    return GM_OK;
}

static gm_status check_clutch(const gm_description *d, const gm_clutch *c,
                              gm_error *error)
{
    for (int w = 0; w < d->n_wheels; w++)
        if (strcmp(d->wheels[w].id.name, c->id.name) == 0)
            return gm_part_fail(d, "clutch", &c->id, error,
                                "a gear in line %d has its name; what a path locks must "
                                "be clear",
                                d->wheels[w].id.line);
    gm_status status = gm_check_on(d, "clutch", &c->id, c->shaft, c->on, error);
    return status == GM_OK ? check_surfaces(d, c, error) : status;
}

static const char *first_lock(const gm_description *d, const gm_path_gear *gear)
{
    return gear->n_locks > 0 ? gm_lock_name(d, &gear->locks[0]) : "no lock";
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

/* Entry i of a list, beside those before it. */
static gm_status check_entry(const gm_description *d, const gm_path_part *path,
                             const gm_path_gear *gear, int i, gm_error *error)
{
    const gm_lock *lock = &gear->locks[i];
    const char *name = gm_lock_name(d, lock);
    if (!lock->is_clutch && !d->wheels[lock->index].idles)
        return path_gear_fail(d, path, gear, error,
                              "only an idling gear can be locked; found the fixed gear",
                              name, "");
    if (!lock->is_clutch && synchronisers_of(d, lock->index) == 0)
        return path_gear_fail(d, path, gear, error, "no synchroniser locks gear", name,
                              "; expected 1, found 0");
    for (int k = 0; k < i; k++) {
        if (gm_same_lock(lock, &gear->locks[k]))
            return path_gear_fail(d, path, gear, error, "locks twice", name, "");
        if (!lock->is_clutch && !gear->locks[k].is_clutch &&
            gm_synchroniser_of(d, lock->index) ==
                gm_synchroniser_of(d, gear->locks[k].index))
            return path_gear_fail(d, path, gear, error,
                                  "one synchroniser locks one gear at a time; found a "
                                  "second one,",
                                  name, "");
    }
    return GM_OK;
}

static gm_status check_locks(const gm_description *d, const gm_path_part *path,
                             const gm_path_gear *gear, gm_error *error)
{
    if (gear->number == 0 && !isnan(gear->ratio))
        return path_gear_fail(d, path, gear, error, "neutral has no ratio; found one for",
                              first_lock(d, gear), "");
    if (gear->ratio == 0.0 && gear->number != 0)
        return path_gear_fail(d, path, gear, error, "ratio must not be 0; found 0 for",
                              first_lock(d, gear), "");
    gm_status status = GM_OK;
    for (int i = 0; i < gear->n_locks && status == GM_OK; i++)
        status = check_entry(d, path, gear, i, error);
    return status;
}

/* The same gear under two numbers. */
static gm_status check_different(const gm_description *d, const gm_path_part *path, int i,
                                 gm_error *error)
{
    const gm_path_gear *gear = &path->gears[i];
    gm_label id = path->id;
    id.line = gear->line;
    for (int k = 0; k < i; k++)
        if (gm_same_locks(&path->gears[k], gear))
            return gm_part_fail(
                d, "path", &id, error,
                "gear %d: locks '%s', already locked by gear %d in line %d", gear->number,
                first_lock(d, gear), path->gears[k].number, path->gears[k].line);
    if (path->has_neutral && gm_same_locks(&path->neutral, gear))
        return gm_part_fail(d, "path", &id, error,
                            "gear %d: locks what is locked in neutral, found %s%s%s; "
                            "only a path with one gear can do without neutral",
                            gear->number, gear->n_locks > 0 ? "'" : "",
                            gear->n_locks > 0 ? first_lock(d, gear) : "nothing",
                            gear->n_locks > 0 ? "'" : "");
    return GM_OK;
}

static gm_status check_path(const gm_description *d, const gm_path_part *path,
                            gm_error *error)
{
    gm_status status = check_locks(d, path, &path->neutral, error);
    if (status == GM_OK && path->n_gears == 0)
        return gm_part_fail(d, "path", &path->id, error,
                            "needs at least 1 gear besides neutral, found 0");
    for (int i = 0; i < path->n_gears && status == GM_OK; i++) {
        const gm_path_gear *gear = &path->gears[i];
        int twice = gear->number == 0 || (i > 0 && gear[-1].number == gear->number);
        if (twice)
            return path_gear_fail(
                d, path, gear, error,
                "a number stands for one gear; found it twice, here for",
                first_lock(d, gear), "");
        status = check_locks(d, path, gear, error);
        if (status == GM_OK)
            status = check_different(d, path, i, error);
    }
    return status;
}

/* Commands and results name a gear by its number alone. */
static gm_status check_numbers(const gm_description *d, gm_error *error)
{
    const gm_path_part *odd = &d->paths[0], *even = &d->paths[1];
    for (int i = 0; d->n_paths > 1 && i < even->n_gears; i++)
        for (int k = 0; k < odd->n_gears; k++) {
            gm_label id = even->id;
            id.line = even->gears[i].line;
            if (odd->gears[k].number == even->gears[i].number)
                return gm_part_fail(
                    d, "path", &id, error,
                    "gear %d: a number stands for one gear; path '%s' has "
                    "it in line %d",
                    even->gears[i].number, odd->id.name, odd->gears[k].line);
        }
    return GM_OK;
}

gm_status gm_check_locks(const gm_description *d, gm_error *error)
{
    gm_status status = GM_OK;
    for (int i = 0; i < d->n_synchronisers && status == GM_OK; i++)
        status = check_synchroniser(d, &d->synchronisers[i], error);
    for (int i = 0; i < d->n_clutches && status == GM_OK; i++)
        status = check_clutch(d, &d->clutches[i], error);
    for (int p = 0; p < d->n_paths && status == GM_OK; p++)
        status = check_path(d, &d->paths[p], error);
    return status == GM_OK ? check_numbers(d, error) : status;
}
