/* SPDX-License-Identifier: BSD-2-Clause */
#include "model/gm_motion_variables.h"

#include "base/alloc.h"
#include "base/sha256.h"
#include "model/motion.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum { NAME_SIZE = 2 * GM_NAME_SIZE + 64 };

int gm_motion_flange_of_state(const gm_motion *motion, int i)
{
    for (int f = 0; f <= motion->gearset->description->n_paths; f++)
        if (motion->flange[f] == i)
            return f;
    return -1;
}

/* ---- names ---- */

static int is_word(const char *text, size_t n)
{
    int word = n > 0 && !isdigit((unsigned char)text[0]);
    for (size_t i = 0; i < n; i++)
        word &= isalnum((unsigned char)text[i]) || text[i] == '_';
    return word;
}

static int is_number(const char *text, size_t n)
{
    return n > 0 && strspn(text, "0123456789") >= n;
}

/* A part of a name as the structured convention wants it: a word, an index, or quoted. */
static int put_part(char *to, size_t room, int first, const char *text, size_t n)
{
    const char *dot = first ? "" : ".";
    if (is_word(text, n))
        return snprintf(to, room, "%s%.*s", dot, (int)n, text);
    if (is_number(text, n) && !first)
        return snprintf(to, room, "[%.*s]", (int)n, text);
    return snprintf(to, room, "%s'%.*s'", dot, (int)n, text);
}

/* kind.NAME[.number].what: only NAME may hold anything, also dots. */
static void structured(const char *signal, char name[NAME_SIZE])
{
    const char *kind_end = strchr(signal, '.'), *what = strrchr(signal, '.');
    const char *part = kind_end + 1, *end = what;
    const char *number = what;
    while (number > part && number[-1] != '.')
        number--;
    if (number > part && is_number(number, (size_t)(what - number)))
        end = number - 1;
    size_t n = 0, size = NAME_SIZE;
    n += (size_t)put_part(name, size, 1, signal, (size_t)(kind_end - signal));
    n += (size_t)put_part(name + n, size - n, 0, part, (size_t)(end - part));
    if (end < what)
        n += (size_t)put_part(name + n, size - n, 0, number, (size_t)(what - number));
    (void)put_part(name + n, size - n, 0, what + 1, strlen(what + 1));
}

/* ---- the list ---- */

static int add(gm_motion_variables *list, gm_motion_variable variable, const char *name)
{
    variable.name = gm_strdup(name);
    if (variable.name)
        list->all[list->n++] = variable;
    return variable.name != NULL;
}

/* What a state is beside the signal it is named after. */
static void state_name(const gm_motion *m, int i, char name[NAME_SIZE])
{
    const char *what = i < m->n_nodes               ? "w"
                       : i < m->n_nodes + m->n_rows ? "deflection"
                                                    : "bristle";
    structured(gm_motion_state_name(m, i), name);
    char *dot = strrchr(name, '.');
    (void)snprintf(dot + 1, (size_t)(NAME_SIZE - (dot + 1 - name)), "%s", what);
}

static const char *state_unit(const gm_motion *m, int i)
{
    if (i < m->n_nodes)
        return "rad/s";
    return i < m->n_nodes + m->gearset->n_meshes ? "m" : "rad";
}

static const char *rate_unit(const char *unit)
{
    return strcmp(unit, "rad/s") == 0 ? "rad/s2"
           : strcmp(unit, "m") == 0   ? "m/s"
                                      : "rad/s";
}

static int add_states(const gm_motion *m, const double *nominal,
                      gm_motion_variables *list)
{
    char name[NAME_SIZE];
    int done = 1;
    for (int i = 0; i < m->n_states && done; i++) {
        if (gm_motion_flange_of_state(m, i) >= 0)
            continue;
        state_name(m, i, name);
        done = add(list,
                   (gm_motion_variable){.kind = GM_MOTION_STATE,
                                        .index = i,
                                        .unit = state_unit(m, i),
                                        .nominal = nominal[i],
                                        .shown = i < m->n_nodes + m->gearset->n_meshes},
                   name);
    }
    return done;
}

static int add_rates(gm_motion_variables *list)
{
    char name[NAME_SIZE + 8];
    int done = 1, n = list->n;
    for (int i = 0; i < n && done; i++) {
        (void)snprintf(name, sizeof name, "der(%s)", list->all[i].name);
        done = add(list,
                   (gm_motion_variable){.kind = GM_MOTION_RATE,
                                        .index = list->all[i].index,
                                        .unit = rate_unit(list->all[i].unit)},
                   name);
    }
    return done;
}

/* Nodes and deflections of meshes are states already. */
static int add_signals(const gm_motion *m, gm_motion_variables *list)
{
    char name[NAME_SIZE];
    int done = 1;
    for (int i = m->n_nodes; i < m->n_signals && done; i++) {
        if (i < m->n_nodes + 2 * m->gearset->n_meshes && (i - m->n_nodes) % 2 == 1)
            continue;
        structured(m->signals[i].name, name);
        done = add(list,
                   (gm_motion_variable){.kind = GM_MOTION_SIGNAL,
                                        .index = i,
                                        .unit = m->signals[i].unit,
                                        .shown = 1},
                   name);
    }
    return done;
}

gm_status gm_motion_variables_make(const gm_motion *motion, gm_motion_variables *list,
                                   gm_error *error)
{
    gm_motion_variables made = {0};
    double *nominal = gm_calloc((size_t)motion->n_states, sizeof *nominal);
    made.all =
        gm_calloc((size_t)(2 * motion->n_states + motion->n_signals), sizeof *made.all);
    int done = nominal && made.all;
    if (done) {
        gm_motion_tolerances(motion, 1.0, nominal);
        done = add_states(motion, nominal, &made) && add_rates(&made) &&
               add_signals(motion, &made);
    }
    gm_free(nominal);
    if (!done) {
        gm_motion_variables_clear(&made);
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    }
    *list = made;
    return GM_OK;
}

void gm_motion_variables_clear(gm_motion_variables *list)
{
    for (int i = 0; i < list->n; i++)
        gm_free(list->all[i].name);
    gm_free(list->all);
    *list = (gm_motion_variables){0};
}

gm_status gm_motion_guid(const gm_motion *motion, const gm_motion_variables *list,
                         char guid[GM_MOTION_GUID_SIZE], gm_error *error)
{
    char hash[GM_SHA256_TEXT];
    gm_sha256 *sum = gm_sha256_create();
    if (!sum)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    gm_sha256_text(sum, "detailed gearset " GM_VERSION);
    gm_sha256_text(sum, motion->gearset->description->sha256);
    for (int i = 0; i < list->n; i++)
        gm_sha256_text(sum, list->all[i].name);
    gm_sha256_finish(sum, hash);
    gm_sha256_destroy(sum);
    (void)snprintf(guid, GM_MOTION_GUID_SIZE, "{%.8s-%.4s-%.4s-%.4s-%.12s}", hash,
                   hash + 8, hash + 12, hash + 16, hash + 20);
    return GM_OK;
}

/* ---- what a motion remembers ---- */

int gm_motion_n_modes(const gm_motion *motion)
{
    return 2 * motion->n_locks + motion->gearset->description->n_paths + 1;
}

void gm_motion_get_modes(const gm_motion *motion, double *modes)
{
    for (int i = 0; i < motion->n_locks; i++) {
        *modes++ = motion->locks[i].mode;
        *modes++ = motion->locks[i].sense;
    }
    for (int p = 0; p < motion->gearset->description->n_paths; p++)
        *modes++ = motion->gear[p];
    *modes = motion->jump_loss;
}

static int are_modes(const gm_motion *m, const double *modes)
{
    const gm_description *d = m->gearset->description;
    const double *gear = modes + 2 * m->n_locks;
    int good = gear[d->n_paths] >= 0.0;
    for (int i = 0; i < m->n_locks; i++) {
        double mode = modes[2 * i], sense = modes[2 * i + 1];
        good &= mode == GM_LOCK_OPEN || mode == GM_LOCK_SYNCHRONISING ||
                mode == GM_LOCK_CLOSED;
        good &= sense == 1.0 || sense == -1.0;
    }
    for (int p = 0; p < d->n_paths; p++)
        good &= gear[p] > -1000.0 && gear[p] < 1000.0 &&
                gm_path_gear_of(&d->paths[p], (int)gear[p]) != NULL;
    return good;
}

int gm_motion_set_modes(gm_motion *motion, const double *modes)
{
    if (!are_modes(motion, modes))
        return 1;
    for (int i = 0; i < motion->n_locks; i++) {
        gm_motion_lock *lock = &motion->locks[i];
        lock->mode = (gm_lock_mode)*modes++;
        lock->sense = *modes++;
        motion->rows[lock->row].closed = lock->mode == GM_LOCK_CLOSED;
    }
    for (int p = 0; p < motion->gearset->description->n_paths; p++)
        motion->gear[p] = (int)*modes++;
    motion->jump_loss = *modes;
    motion->known = 0;
    return 0;
}

void gm_motion_scale_losses(gm_motion *motion, double factor)
{
    motion->known = motion->known && motion->loss_scale == factor;
    motion->loss_scale = factor;
}

void gm_motion_scale_cones(gm_motion *motion, int p, double factor)
{
    const gm_path_part *path = &motion->gearset->description->paths[p];
    for (int i = 0; i < motion->n_locks; i++)
        for (int g = 0; g < path->n_gears; g++)
            for (int k = 0; k < path->gears[g].n_locks; k++) {
                gm_motion_lock *lock = &motion->locks[i];
                if (gm_same_lock(&path->gears[g].locks[k], &lock->what))
                    lock->scale = factor;
            }
}
