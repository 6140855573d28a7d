/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A path in neutral that nothing drives: the speed at which the drags on it cancel. Drag
 * jumps where the shaft is at rest and where it turns with one of its gears, so the root
 * may be such a point, at which friction holds the shaft: the torque is negative just
 * below and positive just above. Otherwise it lies between two of them and is bracketed.
 */
#include "solve/gm_steady_solver.h"

#include <math.h>

#define MAX_BREAKS 32
#define MAX_BISECTIONS 200
#define SPEED_TOLERANCE 1e-12 /* of the largest speed around */

typedef struct search {
    gm_steady_solver *solver;
    gm_steady_point *point;
    gm_steady_result *result;
    int flange;
    gm_error *error;
} search;

/* Torque at the free flange at speed w, on the side `way` of it: only this flange moves
 * on, so that the limit on a line of synchronous speed is its own. */
static gm_status torque_at(search *s, double w, double way, double *torque)
{
    for (int i = 0; i < GM_MAX_FLANGES; i++)
        if (s->point->speed[i] != 0.0)
            s->point->direction[i] = 0.0;
    s->point->speed[s->flange] = w;
    s->point->direction[s->flange] = way;
    gm_status status = gm_steady_solve(s->solver, s->point, s->result, s->error);
    if (status == GM_OK)
        *torque = s->result->torque[s->flange];
    return status;
}

static int insert_sorted(int n, double *x, double value)
{
    for (int i = 0; i < n; i++)
        if (x[i] == value)
            return n;
    int i = n;
    for (; i > 0 && x[i - 1] > value; i--)
        x[i] = x[i - 1];
    x[i] = value;
    return n + 1;
}

/* Speeds at which a drag of path p jumps: rest, and in step with parts of the output. */
static int find_breaks(const gm_plant *plant, int p, double w_o, double *breaks)
{
    double ratio[MAX_BREAKS];
    int n = insert_sorted(0, breaks, 0.0);
    int lines = plant->is->drag_lines(plant->self, p, MAX_BREAKS, ratio);
    for (int i = 0; i < lines; i++)
        n = insert_sorted(n, breaks, ratio[i] * w_o);
    return n;
}

/* Root in [low, high], torque < 0 just above low and > 0 just below high. */
static gm_status bisect(search *s, double low, double high, double *w)
{
    double scale = fmax(fabs(low), fabs(high));
    for (int i = 0; i < MAX_BISECTIONS && high - low > SPEED_TOLERANCE * scale; i++) {
        double middle = 0.5 * (low + high), torque;
        gm_status status = torque_at(s, middle, 1.0, &torque);
        if (status != GM_OK)
            return status;
        if (torque > 0.0)
            high = middle;
        else
            low = middle;
    }
    *w = 0.5 * (low + high);
    return GM_OK;
}

/* Beyond the outermost break: go out by doubling until the torque changes sign. */
static gm_status beyond(search *s, double edge, double way, double *w)
{
    double step = fmax(1.0, 0.1 * fabs(edge));
    for (int i = 0; i < 40; i++, step *= 2.0) {
        double torque, far = edge + way * step;
        gm_status status = torque_at(s, far, way, &torque);
        if (status != GM_OK)
            return status;
        if (torque * way >= 0.0)
            return way > 0.0 ? bisect(s, edge, far, w) : bisect(s, far, edge, w);
    }
    return gm_fail(s->error, GM_ERR_SOLVE, "the free shaft finds no speed at rest");
}

static gm_status locate(search *s, int n, const double *breaks, gm_free_path *found)
{
    double lower_edge = 0.0;
    for (int i = 0; i < n; i++) {
        double below, above;
        gm_status status = torque_at(s, breaks[i], -1.0, &below);
        if (status == GM_OK)
            status = torque_at(s, breaks[i], 1.0, &above);
        if (status != GM_OK)
            return status;
        if (below > 0.0)
            return i == 0 ? beyond(s, breaks[0], -1.0, &found->speed)
                          : bisect(s, lower_edge, breaks[i], &found->speed);
        if (above >= 0.0) {
            *found = (gm_free_path){.speed = breaks[i], .sticks = 1};
            return GM_OK;
        }
        lower_edge = breaks[i];
    }
    return beyond(s, lower_edge, 1.0, &found->speed);
}

/* The state in which friction holds: between the two one-sided limits, where the torque
 * at the free flange is zero. */
static gm_status held_between(search *s, double w)
{
    double below, above;
    gm_status status = torque_at(s, w, -1.0, &below);
    gm_steady_result low = *s->result;
    if (status == GM_OK)
        status = torque_at(s, w, 1.0, &above);
    if (status != GM_OK)
        return status;
    double share = above > below ? -below / (above - below) : 0.0;
    for (int i = 0; i < GM_MAX_FLANGES; i++)
        s->result->torque[i] =
            low.torque[i] + share * (s->result->torque[i] - low.torque[i]);
    return GM_OK;
}

gm_status gm_steady_solve_free(gm_steady_solver *solver, int p, gm_steady_point *point,
                               gm_free_path *free_path, gm_steady_result *result,
                               gm_error *error)
{
    double breaks[MAX_BREAKS + 1], torque;
    gm_free_path found = {0.0, 0};
    search s = {solver, point, result, 1 + p, error};
    const gm_plant *plant = gm_steady_solver_plant(solver);
    gm_status status = torque_at(&s, 0.0, 1.0, &torque);
    if (status == GM_OK)
        status =
            locate(&s, find_breaks(plant, p, result->speed[0], breaks), breaks, &found);
    if (status == GM_OK)
        status = found.sticks ? held_between(&s, found.speed)
                              : torque_at(&s, found.speed, 1.0, &torque);
    if (status == GM_OK)
        *free_path = found;
    return status;
}
