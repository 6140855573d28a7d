/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Modes of the locks: open, synchronising, closed. A command opens and begins, equal
 * speeds close.
 */
#include "model/motion.h"

#include "base/alloc.h"
#include "core/gm_reduced.h"
#include "model/gm_motion_variables.h"

#include <math.h>
#include <string.h>

/* A lock whose speeds differ by less closes: the solver stops where they are equal, give
 * or take its error. */
static const double same_speed = 1e-6; /* rad/s */

static gm_status check_gears(const gm_motion *m, const gm_motion_input *input,
                             gm_error *error)
{
    const gm_description *d = m->gearset->description;
    for (int p = 0; p < d->n_paths; p++)
        if (!gm_path_gear_of(&d->paths[p], input->gear[p]))
            return gm_fail(error, GM_ERR_ARGUMENT, "%s: path '%s' has no gear %d",
                           d->file, d->paths[p].id.name, input->gear[p]);
    return GM_OK;
}

/* Does a gear of path p need the lock? */
static int needs(const gm_motion *m, int lock, int p, int number)
{
    const gm_path_gear *g = gm_path_gear_of(&m->gearset->description->paths[p], number);
    const gm_lock *what = &m->locks[lock].what;
    for (int i = 0; g && i < g->n_locks; i++)
        if (gm_same_lock(&g->locks[i], what))
            return 1;
    return 0;
}

static int wanted(const gm_motion *m, int lock, const int *gear)
{
    int any = 0;
    for (int p = 0; p < m->gearset->description->n_paths; p++)
        any |= needs(m, lock, p, gear[p]);
    return any;
}

static void set_mode(gm_motion *m, gm_motion_lock *lock, gm_lock_mode mode)
{
    lock->mode = mode;
    m->rows[lock->row].closed = mode == GM_LOCK_CLOSED;
    m->known = 0;
}

/* The energy of the dogs is lost when they are pulled apart. */
static void open_lock(gm_motion *m, gm_motion_lock *lock, double *x)
{
    double *deflection = &x[m->n_nodes + lock->row];
    if (lock->mode == GM_LOCK_CLOSED)
        m->jump_loss += gm_contact_energy(&m->rows[lock->row].law, *deflection);
    *deflection = 0.0;
    set_mode(m, lock, GM_LOCK_OPEN);
}

static int obey(gm_motion *m, const int *gear, double *x)
{
    int changed = 0;
    for (int i = 0; i < m->n_locks; i++) {
        gm_motion_lock *lock = &m->locks[i];
        int needed = wanted(m, i, gear);
        if (needed && lock->mode == GM_LOCK_OPEN) {
            lock->sense = gm_row_speed(&m->rows[lock->row].row, x) < 0.0 ? -1.0 : 1.0;
            set_mode(m, lock, GM_LOCK_SYNCHRONISING);
            changed = 1;
        } else if (!needed && lock->mode != GM_LOCK_OPEN) {
            open_lock(m, lock, x);
            changed = 1;
        }
    }
    memcpy(m->gear, gear, sizeof m->gear);
    return changed;
}

/* Dogs meet in the middle of their play: x is zero. */
static int close_locks(gm_motion *m, const double *x)
{
    int changed = 0;
    for (int i = 0; i < m->n_locks; i++) {
        gm_motion_lock *lock = &m->locks[i];
        if (lock->mode != GM_LOCK_SYNCHRONISING ||
            (lock->scale * lock->capacity < GM_MOTION_AT_ONCE &&
             lock->sense * gm_row_speed(&m->rows[lock->row].row, x) > same_speed))
            continue;
        set_mode(m, lock, GM_LOCK_CLOSED);
        changed = 1;
    }
    return changed;
}

gm_status gm_motion_handle(gm_motion *motion, const gm_motion_input *input, double *x,
                           int *changed, gm_error *error)
{
    int n_paths = motion->gearset->description->n_paths, shifted = 0;
    for (int p = 0; p < n_paths; p++)
        shifted |= input->gear[p] != motion->gear[p];
    if (shifted) {
        gm_status status = check_gears(motion, input, error);
        if (status != GM_OK)
            return status;
        shifted = obey(motion, input->gear, x);
    }
    *changed = close_locks(motion, x) || shifted;
    return GM_OK;
}

int gm_motion_n_events(const gm_motion *motion)
{
    return motion->n_locks;
}

int gm_motion_events(gm_motion *motion, const gm_motion_input *input, const double *x,
                     double *g)
{
    (void)input;
    for (int i = 0; i < motion->n_locks; i++) {
        const gm_motion_lock *lock = &motion->locks[i];
        g[i] = lock->mode == GM_LOCK_SYNCHRONISING
                   ? lock->sense * gm_row_speed(&motion->rows[lock->row].row, x)
                   : 1.0;
    }
    return 0;
}

int gm_motion_path_mode(const gm_motion *motion, int p)
{
    int closed = 1;
    if (motion->gear[p] == 0)
        return GM_PATH_NEUTRAL;
    for (int i = 0; i < motion->n_locks; i++)
        if (needs(motion, i, p, motion->gear[p]))
            closed &= motion->locks[i].mode == GM_LOCK_CLOSED;
    return closed ? GM_PATH_ENGAGED : GM_PATH_SYNCHRONISING;
}

/* ---- start ---- */

static gm_status start_speeds(const gm_motion *m, const int *gear, const double *speed,
                              double *w, gm_error *error)
{
    gm_configuration_rows rows;
    gm_status status = gm_configuration_rows_make(m->gearset, gear, &rows, error);
    if (status != GM_OK)
        return status;
    for (int i = 0; i < m->n_nodes; i++) {
        const double *s = rows.speed_of + m->nodes.body[i] * rows.n_independent;
        w[i] = 0.0;
        for (int k = 0; k < rows.n_independent; k++)
            w[i] += s[k] * speed[rows.flange[k]];
    }
    gm_configuration_rows_clear(&rows);
    return GM_OK;
}

gm_status gm_motion_start(gm_motion *motion, const gm_motion_input *input,
                          const double *speed, double *x, gm_error *error)
{
    gm_status status = check_gears(motion, input, error);
    if (status == GM_OK)
        status = start_speeds(motion, input->gear, speed, x, error);
    if (status != GM_OK)
        return status;
    for (int i = motion->n_nodes; i < motion->n_states; i++)
        x[i] = 0.0;
    for (int i = 0; i < motion->n_locks; i++)
        set_mode(motion, &motion->locks[i],
                 wanted(motion, i, input->gear) ? GM_LOCK_CLOSED : GM_LOCK_OPEN);
    memcpy(motion->gear, input->gear, sizeof motion->gear);
    motion->jump_loss = 0.0;
    return GM_OK;
}
