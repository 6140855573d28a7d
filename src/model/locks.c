/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Gears of a path and what they lock.
 */
#include "model/gm_description.h"

#include <math.h>
#include <stddef.h>

int gm_same_lock(const gm_lock *a, const gm_lock *b)
{
    return a->is_clutch == b->is_clutch && a->index == b->index;
}

int gm_same_locks(const gm_path_gear *a, const gm_path_gear *b)
{
    int found = 0;
    for (int i = 0; i < a->n_locks; i++)
        for (int k = 0; k < b->n_locks; k++)
            found += gm_same_lock(&a->locks[i], &b->locks[k]);
    return found == a->n_locks && a->n_locks == b->n_locks;
}

int gm_path_rest_gear(const gm_path_part *path)
{
    return path->has_neutral ? 0 : path->gears[0].number;
}

const gm_path_gear *gm_path_gear_of(const gm_path_part *path, int number)
{
    if (number == 0 && path->has_neutral)
        return &path->neutral;
    for (int i = 0; i < path->n_gears; i++)
        if (path->gears[i].number == number)
            return &path->gears[i];
    return NULL;
}

const char *gm_lock_name(const gm_description *d, const gm_lock *lock)
{
    return lock->is_clutch ? d->clutches[lock->index].id.name
                           : d->wheels[lock->index].id.name;
}

const gm_synchroniser *gm_synchroniser_of(const gm_description *d, int wheel)
{
    for (int i = 0; i < d->n_synchronisers; i++)
        for (int k = 0; k < d->synchronisers[i].n_wheels; k++)
            if (d->synchronisers[i].wheels[k] == wheel)
                return &d->synchronisers[i];
    return NULL;
}

double gm_lock_capacity(const gm_description *d, const gm_lock *lock)
{
    if (lock->is_clutch)
        return d->clutches[lock->index].torque_capacity;
    const gm_synchroniser *s = gm_synchroniser_of(d, lock->index);
    return s ? s->cone_torque : (double)INFINITY;
}
