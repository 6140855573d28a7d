/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/gm_oil.h"

#include "base/alloc.h"
#include "solve/gm_steady_solver.h"
#include "sweep/oil_profile.h"

#include <string.h>

enum { MOST_PROFILES = 4 * GM_MAP_MAX_OIL };

#define SHORTEST 1.0 /* K: an interval that is not halved any more */

typedef struct choice {
    const gm_oil_source *source;
    double speed_max, torque_max, share, torque;
    int n_profiles;
    gm_oil_profile *profiles; /* [MOST_PROFILES], those measured so far */
    gm_error *error;
} choice;

static gm_status solve(void *user, const gm_steady_point *point, gm_steady_result *result,
                       gm_error *error)
{
    gm_steady_solver_restart(user);
    return gm_steady_solve(user, point, result, error);
}

static gm_status measure(const choice *c, double temperature, gm_oil_profile *profile)
{
    gm_oil_asker asker = {
        .solve = solve, .speed_max = c->speed_max, .torque_max = c->torque_max};
    gm_steady_solver *solver = NULL;
    gm_status status =
        c->source->at(c->source->self, temperature, &asker.plant, c->error);
    if (status == GM_OK)
        status = gm_steady_solver_create(asker.plant, &solver, c->error);
    asker.user = solver;
    if (status == GM_OK)
        status = gm_oil_profile_measure(&asker, profile, c->error);
    gm_steady_solver_destroy(solver);
    profile->temperature = temperature;
    return status;
}

/* The profile at a temperature: a known one, or measured now. */
static gm_status find(choice *c, double temperature, const gm_oil_profile **profile)
{
    for (int i = 0; i < c->n_profiles; i++)
        if (c->profiles[i].temperature == temperature) {
            *profile = &c->profiles[i];
            return GM_OK;
        }
    if (c->n_profiles == MOST_PROFILES)
        return gm_fail(c->error, GM_ERR_ARGUMENT, "too many oil temperatures");
    gm_oil_profile *made = &c->profiles[c->n_profiles];
    gm_status status = measure(c, temperature, made);
    c->n_profiles += status == GM_OK;
    *profile = made;
    return status;
}

/* Largest error between two temperatures, in tolerances. */
static gm_status error_between(choice *c, double low, double high, double *error)
{
    const gm_oil_profile *at[5];
    gm_status status = GM_OK;
    for (int i = 0; i < 5 && status == GM_OK; i++)
        status = find(c, i == 4 ? high : low + 0.25 * i * (high - low), &at[i]);
    if (status != GM_OK)
        return status;
    double bend = gm_oil_bend_between(at[0], at[2], at[4]);
    *error = 0.0;
    for (int i = 1; i < 4; i++) {
        double off = gm_oil_error(at[0], at[4], bend, at[i], c->share, c->torque);
        *error = off > *error ? off : *error;
    }
    return GM_OK;
}

/* The interval that is worst and may be halved; -1: all are inside. */
static gm_status worst_interval(choice *c, int n, const double *at, int *worst)
{
    double largest = 1.0;
    gm_status status = GM_OK;
    *worst = -1;
    for (int k = 0; k + 1 < n && status == GM_OK; k++) {
        double error = 0.0;
        status = error_between(c, at[k], at[k + 1], &error);
        if (error > largest && at[k + 1] - at[k] > 2.0 * SHORTEST) {
            largest = error;
            *worst = k;
        }
    }
    return status;
}

gm_status gm_oil_choose(const gm_oil_source *source, double speed_max, double torque_max,
                        double share, double torque, int *n, double *at, gm_error *error)
{
    choice c = {source, speed_max, torque_max, GM_OIL_PART * share, GM_OIL_PART * torque,
                0,      NULL,      error};
    int worst = 0, found = *n;
    c.profiles = gm_calloc(MOST_PROFILES, sizeof *c.profiles);
    gm_status status = GM_OK;
    if (!c.profiles)
        return gm_fail(error, GM_ERR_MEMORY, "no memory to choose oil temperatures");
    while (status == GM_OK && worst >= 0 && found < GM_MAP_MAX_OIL) {
        status = worst_interval(&c, found, at, &worst);
        if (status != GM_OK || worst < 0)
            break;
        memmove(&at[worst + 2], &at[worst + 1], (size_t)(found - worst - 1) * sizeof *at);
        at[worst + 1] = 0.5 * (at[worst] + at[worst + 2]);
        found++;
    }
    gm_free(c.profiles);
    *n = found;
    return status;
}
