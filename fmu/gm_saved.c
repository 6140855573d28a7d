/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Source of the hash: G. Fowler, L. C. Noll, K.-P. Vo, FNV-1a with 64 bits (RFC 9923);
 * over the state it takes words instead of octets, for speed. Each step is a bijection,
 * so damage within one word is always found.
 */
#include "gm_saved.h"

#include <stddef.h>
#include <string.h>

#define MAGIC 0x54534d47u /* "GMST" where the low byte comes first */
#define VERSION 2u
#define FNV_START 0xcbf29ce484222325u
#define FNV_PRIME 0x100000001b3u

static uint64_t hash_of_text(const char *text)
{
    uint64_t hash = FNV_START;
    for (; *text; text++)
        hash = (hash ^ (unsigned char)*text) * FNV_PRIME;
    return hash;
}

static uint64_t sum_of(const gm_saved *saved)
{
    const unsigned char *byte = (const unsigned char *)saved;
    uint64_t hash = FNV_START, word;
    for (size_t at = offsetof(gm_saved, value); at < sizeof *saved; at += sizeof word) {
        memcpy(&word, byte + at, sizeof word);
        hash = (hash ^ word) * FNV_PRIME;
    }
    return hash;
}

/* ---- from the run ---- */

static void save_values(const gm_component *c, gm_saved *s)
{
    for (int id = 0; id < GM_VARIABLES; id++)
        for (int p = 0; p < GM_MAX_PATHS; p++)
            s->value[id][p] = gm_variables[id].type == GM_TYPE_REAL
                                  ? c->value[id][p].real
                                  : (gm_real)c->value[id][p].integer;
    s->output_rate = c->output_rate;
    s->flags = c->flags;
    s->start_pending = c->start_pending;
    s->outputs_pending = c->outputs_pending;
}

static void save_motion(const gm_reduced_state *state, gm_saved *s)
{
    s->phi_o = state->phi_o;
    s->w_o = state->w_o;
    s->brake = state->brake;
    s->work = state->work;
    s->loss_energy = state->loss_energy;
}

static void save_modes(const gm_run *run, gm_saved *s)
{
    const gm_reduced_modes *m = &run->component.modes;
    for (int k = 0; k < GM_MODE_SHAFTS; k++)
        s->direction[k] = m->direction[k];
    for (int p = 0; p < GM_MAX_PATHS; p++)
        s->slip[p] = m->slip[p];
    s->outside = m->outside;
    s->exchange = run->component.exchange;
    s->update_due = run->update_due;
}

static void save_path(const gm_run *run, int p, gm_saved_path *s)
{
    const gm_path_state *path = &run->component.state.path[p];
    s->phi = path->phi;
    s->w = path->w;
    s->twist = path->twist;
    s->mode = path->mode;
    s->gear = path->gear;
    s->rate = run->component.path_rate[p];
    s->gear_reported = run->gear_reported[p];
    s->reported_gear = run->reported_gear[p];
}

static void save_clock(const gm_run *run, gm_saved *s)
{
    s->time = run->time;
    s->stop_time = run->stop_time;
    s->last_step = run->last_step;
    s->phase = (int32_t)run->phase;
    s->experiment_set = run->experiment_set;
    s->stop_defined = run->stop_defined;
}

void gm_saved_make(const char *guid, const gm_run *run, gm_saved *saved)
{
    memset(saved, 0, sizeof *saved);
    saved->magic = MAGIC;
    saved->version = VERSION;
    saved->guid = hash_of_text(guid);
    save_values(&run->component, saved);
    save_motion(&run->component.state, saved);
    for (int p = 0; p < GM_MAX_PATHS; p++)
        save_path(run, p, &saved->path[p]);
    save_clock(run, saved);
    save_modes(run, saved);
    saved->sum = sum_of(saved);
}

/* ---- to the run ---- */

gm_saved_verdict gm_saved_owner(const char *guid, const gm_saved *saved)
{
    if (saved->magic != MAGIC || saved->version != VERSION)
        return GM_SAVED_FOREIGN;
    return saved->guid == hash_of_text(guid) ? GM_SAVED_OK : GM_SAVED_OTHER_FMU;
}

gm_saved_verdict gm_saved_check(const char *guid, const gm_saved *saved)
{
    gm_saved_verdict verdict = gm_saved_owner(guid, saved);
    if (verdict)
        return verdict;
    return saved->sum == sum_of(saved) ? GM_SAVED_OK : GM_SAVED_DAMAGED;
}

gm_saved_verdict gm_saved_fits(const gm_saved *saved, const gm_run *run)
{
    return (saved->exchange != 0) == run->component.exchange ? GM_SAVED_OK
                                                             : GM_SAVED_OTHER_TYPE;
}

static void restore_values(const gm_saved *s, gm_component *c)
{
    for (int id = 0; id < GM_VARIABLES; id++)
        for (int p = 0; p < GM_MAX_PATHS; p++)
            if (gm_variables[id].type == GM_TYPE_REAL)
                c->value[id][p].real = s->value[id][p];
            else
                c->value[id][p].integer = (int)s->value[id][p];
    c->output_rate = s->output_rate;
    c->flags = s->flags;
    c->start_pending = s->start_pending != 0;
    c->outputs_pending = s->outputs_pending != 0;
}

static void restore_motion(const gm_saved *s, gm_reduced_state *state)
{
    state->phi_o = s->phi_o;
    state->w_o = s->w_o;
    state->brake = s->brake;
    state->work = s->work;
    state->loss_energy = s->loss_energy;
}

static void restore_modes(const gm_saved *s, gm_run *run)
{
    gm_reduced_modes *m = &run->component.modes;
    for (int k = 0; k < GM_MODE_SHAFTS; k++)
        m->direction[k] = s->direction[k];
    for (int p = 0; p < GM_MAX_PATHS; p++)
        m->slip[p] = s->slip[p];
    m->outside = s->outside;
    run->component.exchange = s->exchange != 0;
    run->update_due = s->update_due != 0;
}

static void restore_path(const gm_saved_path *s, int p, gm_run *run)
{
    gm_path_state *path = &run->component.state.path[p];
    path->phi = s->phi;
    path->w = s->w;
    path->twist = s->twist;
    path->mode = s->mode;
    path->gear = s->gear;
    run->component.path_rate[p] = s->rate;
    run->gear_reported[p] = s->gear_reported != 0;
    run->reported_gear[p] = s->reported_gear;
}

static void restore_clock(const gm_saved *s, gm_run *run)
{
    run->time = s->time;
    run->stop_time = s->stop_time;
    run->last_step = s->last_step;
    run->phase = (gm_phase)s->phase;
    run->experiment_set = s->experiment_set != 0;
    run->stop_defined = s->stop_defined != 0;
}

void gm_saved_restore(const gm_saved *saved, gm_run *run)
{
    bool map_left = run->map_left;
    memset(run, 0, sizeof *run);
    run->map_left = map_left;
    restore_values(saved, &run->component);
    restore_motion(saved, &run->component.state);
    for (int p = 0; p < GM_MAX_PATHS; p++)
        restore_path(&saved->path[p], p, run);
    restore_clock(saved, run);
    restore_modes(saved, run);
}
