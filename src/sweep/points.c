/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/points.h"

#include "base/alloc.h"
#include "sweep/memo.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define BLOCK 32           /* points that go to the journal at once */
#define BLOCK_AGE 20e-3    /* s, of the oldest of them */
#define WATCH_INTERVAL 0.1 /* s */

/* A key or record has no padding but what memset has made zero. */
typedef struct place_key {
    gm_steady_point point;
    double oil; /* temperature, K */
} place_key;

typedef struct record {
    place_key key;
    gm_steady_result result;
} record;

struct gm_points {
    pthread_mutex_t memo_lock, journal_lock, watch_lock;
    gm_memo *memo;
    gm_journal *journal; /* NULL: in memory only */
    long resumed;
    gm_points_watch watch;
    void *user;
    double watched; /* s, when last */
    bool may_skip;
    int n_skipped;
    gm_skipped_point *skipped;
};

struct gm_point_solver {
    gm_points *points;
    int n_plants, plant; /* how many, and the present one */
    const gm_plant *const *plants;
    gm_steady_solver **solvers; /* [n_plants], each made when it is wanted */
    int n;                      /* waiting for the journal */
    double since;
    record block[BLOCK];
};

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* The point as a key: flanges and fields that do not matter may hold -0.0. */
static place_key key_of(const gm_steady_point *point, double oil)
{
    place_key k;
    memset(&k, 0, sizeof k);
    memcpy(k.point.gear, point->gear, sizeof k.point.gear);
    for (int f = 0; f < GM_MAX_FLANGES; f++) {
        k.point.speed[f] = point->speed[f] + 0.0;
        k.point.direction[f] = point->direction[f] + 0.0;
        k.point.torque[f] = point->torque[f] + 0.0;
    }
    k.oil = oil;
    return k;
}

/* ---- the points ---- */

static gm_points *create(void)
{
    gm_points *made = gm_calloc(1, sizeof *made);
    if (!made)
        return NULL;
    (void)pthread_mutex_init(&made->memo_lock, NULL);
    (void)pthread_mutex_init(&made->journal_lock, NULL);
    (void)pthread_mutex_init(&made->watch_lock, NULL);
    made->memo = gm_memo_create(sizeof(place_key), sizeof(gm_steady_result));
    if (made->memo)
        return made;
    gm_points_close(made, true);
    return NULL;
}

static gm_status no_memory(gm_error *error)
{
    return gm_fail(error, GM_ERR_MEMORY, "no memory for the points of the sweep");
}

static gm_status take_up(gm_points *p, gm_error *error)
{
    long n;
    const record *records = gm_journal_records(p->journal, &n);
    for (long i = 0; i < n; i++) {
        if (gm_memo_find(p->memo, &records[i].key))
            continue; /* two threads may solve the same point at once */
        gm_steady_result *result = gm_memo_add(p->memo, &records[i].key);
        if (!result)
            return no_memory(error);
        *result = records[i].result;
    }
    p->resumed = gm_memo_count(p->memo);
    return GM_OK;
}

gm_status gm_points_open(const char *path, const gm_map *map, gm_points **points,
                         gm_error *error)
{
    gm_points *made = create();
    gm_status status = made ? GM_OK : no_memory(error);
    if (status == GM_OK && path)
        status = gm_journal_open(path, map, sizeof(record), &made->journal, error);
    if (status == GM_OK && path)
        status = take_up(made, error);
    if (status == GM_OK)
        *points = made;
    else
        gm_points_close(made, true);
    return status;
}

gm_status gm_points_finish(gm_points *points, gm_map *map, gm_error *error)
{
    if (!points->journal)
        return gm_map_hash(map, map->content_hash, error);
    gm_journal *journal = points->journal;
    points->journal = NULL;
    return gm_journal_finish(journal, map, error);
}

void gm_points_close(gm_points *points, bool keep)
{
    if (!points)
        return;
    gm_journal_close(points->journal, keep);
    gm_memo_destroy(points->memo);
    (void)pthread_mutex_destroy(&points->memo_lock);
    (void)pthread_mutex_destroy(&points->journal_lock);
    (void)pthread_mutex_destroy(&points->watch_lock);
    gm_free(points->skipped);
    gm_free(points);
}

void gm_points_allow_skips(gm_points *points)
{
    points->may_skip = true;
}

static int by_words(const void *a, const void *b)
{
    return strcmp(((const gm_skipped_point *)a)->words,
                  ((const gm_skipped_point *)b)->words);
}

int gm_points_skipped(const gm_points *points, const gm_skipped_point **skipped)
{
    if (points->n_skipped > 1)
        qsort(points->skipped, (size_t)points->n_skipped, sizeof *points->skipped,
              by_words);
    *skipped = points->skipped;
    return points->n_skipped;
}

double gm_points_uncertainty(const gm_points *points)
{
    double largest = 0.0;
    for (long i = 0; i < gm_memo_count(points->memo); i++) {
        const gm_steady_result *result = gm_memo_value(points->memo, i);
        for (int f = 0; f < GM_MAX_FLANGES; f++)
            largest = fmax(largest, result->uncertainty[f]);
    }
    return largest;
}

void gm_points_set_watch(gm_points *points, gm_points_watch watch, void *user)
{
    points->watch = watch;
    points->user = user;
    points->watched = now();
}

long gm_points_count(gm_points *points)
{
    (void)pthread_mutex_lock(&points->memo_lock);
    long n = gm_memo_count(points->memo);
    (void)pthread_mutex_unlock(&points->memo_lock);
    return n;
}

long gm_points_resumed(const gm_points *points)
{
    return points->resumed;
}

static int find(gm_points *points, const place_key *key, gm_steady_result *result)
{
    (void)pthread_mutex_lock(&points->memo_lock);
    const gm_steady_result *found = gm_memo_find(points->memo, key);
    if (found)
        *result = *found;
    (void)pthread_mutex_unlock(&points->memo_lock);
    return found != NULL;
}

static gm_status add(gm_points *points, const record *solved, gm_error *error)
{
    (void)pthread_mutex_lock(&points->memo_lock);
    gm_steady_result *result = gm_memo_find(points->memo, &solved->key);
    if (!result)
        result = gm_memo_add(points->memo, &solved->key);
    if (result)
        *result = solved->result;
    (void)pthread_mutex_unlock(&points->memo_lock);
    return result ? GM_OK : no_memory(error);
}

/* ---- a thread's solver ---- */

gm_status gm_point_solver_create(gm_points *points, int n, const gm_plant *const *plants,
                                 gm_point_solver **solver, gm_error *error)
{
    gm_point_solver *made = gm_calloc(1, sizeof *made);
    if (made)
        made->solvers = gm_calloc((size_t)n, sizeof *made->solvers);
    if (!made || !made->solvers) {
        gm_free(made);
        return no_memory(error);
    }
    made->points = points;
    made->n_plants = n;
    made->plants = plants;
    *solver = made;
    return GM_OK;
}

void gm_point_solver_choose(gm_point_solver *solver, int i)
{
    solver->plant = i;
}

void gm_point_solver_destroy(gm_point_solver *solver)
{
    if (!solver)
        return;
    for (int i = 0; i < solver->n_plants; i++)
        gm_steady_solver_destroy(solver->solvers[i]);
    gm_free(solver->solvers);
    gm_free(solver);
}

gm_status gm_point_solver_flush(gm_point_solver *solver, gm_error *error)
{
    gm_points *points = solver->points;
    int n = solver->n;
    solver->n = 0;
    if (n == 0 || !points->journal)
        return GM_OK;
    (void)pthread_mutex_lock(&points->journal_lock);
    gm_status status = gm_journal_put(points->journal, solver->block, n, error);
    (void)pthread_mutex_unlock(&points->journal_lock);
    return status;
}

static gm_status look(gm_points *points, double t, gm_error *error)
{
    gm_status status = GM_OK;
    if (!points->watch)
        return GM_OK;
    (void)pthread_mutex_lock(&points->watch_lock);
    if (t - points->watched >= WATCH_INTERVAL) {
        points->watched = t;
        status = points->watch(points->user, error);
    }
    (void)pthread_mutex_unlock(&points->watch_lock);
    return status;
}

static gm_status journal(gm_point_solver *s, const record *solved, double t,
                         gm_error *error)
{
    if (!s->points->journal)
        return GM_OK;
    if (s->n == 0)
        s->since = t;
    s->block[s->n++] = *solved;
    return s->n == BLOCK || t - s->since >= BLOCK_AGE ? gm_point_solver_flush(s, error)
                                                      : GM_OK;
}

/* Keep the reason; the point counts as known, without numbers. */
static gm_status skip(gm_points *p, record *failed, const gm_error *why, gm_error *error)
{
    gm_status status = GM_OK;
    for (int f = 0; f < GM_MAX_FLANGES; f++)
        failed->result.torque[f] = failed->result.speed[f] = (double)NAN;
    (void)pthread_mutex_lock(&p->memo_lock);
    size_t n = (size_t)p->n_skipped;
    gm_skipped_point *grown = gm_resize(p->skipped, n + 1, sizeof *grown);
    if (grown) {
        p->skipped = grown;
        (void)snprintf(grown[n].words, sizeof grown[n].words, "%s", why->message);
        p->n_skipped++;
    } else {
        status = no_memory(error);
    }
    (void)pthread_mutex_unlock(&p->memo_lock);
    return status == GM_OK ? add(p, failed, error) : status;
}

static gm_status present_solver(gm_point_solver *s, gm_steady_solver **solver,
                                gm_error *error)
{
    gm_steady_solver **present = &s->solvers[s->plant];
    gm_status status = GM_OK;
    if (!*present)
        status = gm_steady_solver_create(s->plants[s->plant], present, error);
    *solver = *present;
    return status;
}

gm_status gm_point_solve(gm_point_solver *solver, const gm_steady_point *point,
                         gm_steady_result *result, gm_error *error)
{
    record solved;
    gm_steady_solver *steady;
    memset(&solved, 0, sizeof solved);
    solved.key = key_of(point, solver->plants[solver->plant]->info.oil_temperature);
    if (find(solver->points, &solved.key, result))
        return GM_OK;
    gm_status status = present_solver(solver, &steady, error);
    if (status != GM_OK)
        return status;
    gm_steady_solver_restart(steady);
    gm_error why = {GM_OK, ""};
    status = gm_steady_solve(steady, &solved.key.point, result, &why);
    if (solver->points->may_skip && (status == GM_ERR_TOOL || status == GM_ERR_SOLVE)) {
        status = skip(solver->points, &solved, &why, error);
        *result = solved.result;
        return status;
    }
    if (status != GM_OK)
        return gm_fail(error, status, "%s", why.message);
    solved.result = *result;
    double t = now();
    status = add(solver->points, &solved, error);
    if (status == GM_OK)
        status = journal(solver, &solved, t, error);
    return status == GM_OK ? look(solver->points, t, error) : status;
}
