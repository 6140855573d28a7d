/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/gm_rig_plant.h"

#include "base/alloc.h"
#include "plant/child.h"
#include "sweep/rig_identify.h"
#include "sweep/rig_point.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Time for identification, in limits of a point: some hundred holds and ramps. */
static const double identification_time = 20.0;

typedef struct rig_plant {
    gm_plant plant; /* first: points back here */
    const gm_rig *rig;
    gm_rig_settings settings;
    gm_rig_scales scales;
    gm_rig_identity identity;
    gm_rig_limits limits;
} rig_plant;

/* ---- in the process of the model ---- */

static gm_status begin_run(const void *context, void **state, gm_error *error)
{
    const rig_plant *p = context;
    gm_rig_run *run = NULL;
    gm_status status =
        gm_rig_run_create(p->rig, &p->scales, p->settings.dwell, &run, error);
    if (status == GM_OK)
        *state = run;
    return status;
}

static void end_run(void *state)
{
    gm_rig_run_destroy(state);
}

typedef struct identify_request {
    gm_rig_identification how;
} identify_request;

static gm_status serve_identity(void *state, const void *request, void *reply,
                                gm_error *error)
{
    const identify_request *asked = request;
    return gm_rig_identify(state, &asked->how, reply, error);
}

typedef struct point_request {
    int restart;
    gm_rig_limits limits;
    gm_rig_target target;
} point_request;

static gm_status serve_point(void *state, const void *request, void *reply,
                             gm_error *error)
{
    const point_request *asked = request;
    if (asked->restart)
        gm_rig_run_restart(state);
    return gm_rig_point_measure(state, &asked->limits, &asked->target, reply, error);
}

/* ---- identification ---- */

static gm_status identify(rig_plant *p, gm_error *error)
{
    const gm_child_work work = {.context = p,
                                .create = begin_run,
                                .destroy = end_run,
                                .serve = serve_identity,
                                .request_size = sizeof(identify_request),
                                .reply_size = sizeof p->identity};
    identify_request request = {{.info = &p->plant.info}};
    gm_child *child = NULL;
    request.how.ramp_time = p->settings.ramp_time;
    memcpy(request.how.given_inertia, p->settings.inertia, sizeof p->settings.inertia);
    gm_status status = gm_child_create(
        &work, identification_time * p->settings.time_limit, &child, error);
    if (status == GM_OK)
        status = gm_child_call(child, &request, &p->identity, error);
    gm_child_destroy(child);
    return status;
}

/* Ratios and inertias that are known need no measuring. */
static gm_status take_known(rig_plant *p, gm_error *error)
{
    const gm_plant_info *info = &p->plant.info;
    const gm_plant *known = p->settings.known;
    gm_kinematics k;
    for (int q = 0; q < info->n_paths; q++)
        for (int g = 0; g < info->path[q].n_gears; g++) {
            int gear[GM_MAX_INPUT_PATHS] = {0};
            for (int other = 0; other < info->n_paths; other++)
                if (info->path[other].always_engaged)
                    gear[other] = info->path[other].gears[0].number;
            gear[q] = info->path[q].gears[g].number;
            gm_status status = known->is->kinematics(known->self, gear, &k, error);
            if (status != GM_OK)
                return status;
            p->identity.ratio[q][g] = k.ratio[q];
            p->identity.total[q][g].value = k.inertia_total;
            p->identity.inertia[1 + q].value = k.inertia[q];
            p->identity.inertia[0].value = k.inertia_output;
        }
    return GM_OK;
}

static int ascending(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

/* Drag of a path in neutral jumps where it turns with one of its gears. */
static void set_lines(rig_plant *p)
{
    for (int q = 0; q < p->plant.info.n_paths; q++) {
        const gm_plant_path *path = &p->plant.info.path[q];
        p->limits.n_lines[q] = path->always_engaged ? 0 : path->n_gears;
        memcpy(p->limits.line[q], p->identity.ratio[q],
               sizeof(double) * (size_t)p->limits.n_lines[q]);
        qsort(p->limits.line[q], (size_t)p->limits.n_lines[q], sizeof(double), ascending);
    }
    p->limits.creep = p->settings.creep;
    p->limits.ramps = p->settings.losses_by_ramps;
    p->limits.ramp_time = p->settings.ramp_time;
}

/* ---- calls of the plant ---- */

static int index_of(const gm_plant_path *path, int number)
{
    for (int g = 0; g < path->n_gears; g++)
        if (path->gears[g].number == number)
            return g;
    return -1;
}

static gm_status kinematics(const void *self, const int *gear, gm_kinematics *k,
                            gm_error *error)
{
    const rig_plant *p = self;
    (void)error;
    memset(k, 0, sizeof *k);
    k->inertia_output = k->inertia_total = p->identity.inertia[0].value;
    for (int q = 0; q < p->plant.info.n_paths; q++) {
        int g = index_of(&p->plant.info.path[q], gear[q]);
        k->inertia[q] = p->identity.inertia[1 + q].value;
        if (g < 0)
            continue;
        double ratio = k->ratio[q] = p->identity.ratio[q][g];
        double alone = p->identity.inertia[0].value + ratio * ratio * k->inertia[q];
        double extra = p->identity.total[q][g].value - alone;
        k->inertia_total += ratio * ratio * k->inertia[q];
        if (fabs(extra) > 1e-12 * alone)
            k->inertia_total += extra;
    }
    return GM_OK;
}

static int no_kinks(const void *self, int p, int number, int n_max, double *at)
{
    (void)self;
    (void)p;
    (void)number;
    (void)n_max;
    (void)at;
    return 0;
}

static int drag_lines(const void *self, int q, int n_max, double *ratio)
{
    const rig_plant *p = self;
    int n = p->limits.n_lines[q] < n_max ? p->limits.n_lines[q] : n_max;
    memcpy(ratio, p->limits.line[q], sizeof(double) * (size_t)n);
    return n;
}

typedef struct point_work {
    const rig_plant *plant;
    gm_child *child;
    int restart;
} point_work;

static gm_status work_create(const void *self, void **made, gm_error *error)
{
    const gm_child_work work = {.context = self,
                                .create = begin_run,
                                .destroy = end_run,
                                .serve = serve_point,
                                .request_size = sizeof(point_request),
                                .reply_size = sizeof(gm_rig_found)};
    const rig_plant *p = self;
    point_work *w = gm_calloc(1, sizeof *w);
    if (!w)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    *w = (point_work){.plant = p, .restart = 1};
    gm_status status = gm_child_create(&work, p->settings.time_limit, &w->child, error);
    if (status != GM_OK) {
        gm_free(w);
        return status;
    }
    *made = w;
    return GM_OK;
}

static void work_destroy(void *work)
{
    point_work *w = work;
    gm_child_destroy(w->child);
    gm_free(w);
}

static void restart(void *work)
{
    ((point_work *)work)->restart = 1;
}

static void to_request(const point_work *w, const gm_steady_point *point,
                       point_request *request)
{
    memset(request, 0, sizeof *request);
    request->restart = w->restart;
    request->limits = w->plant->limits;
    request->target.point = *point;
    for (int q = 0; q < w->plant->plant.info.n_paths; q++) {
        int g = index_of(&w->plant->plant.info.path[q], point->gear[q]);
        request->target.ratio[q] = g < 0 ? 0.0 : w->plant->identity.ratio[q][g];
    }
}

static gm_status name_point(const gm_steady_point *p, gm_status status,
                            const gm_error *why, gm_error *error)
{
    return gm_fail(error, status,
                   "gears (%d, %d), output speed %g rad/s, input speeds (%g, %g) rad/s, "
                   "input torques (%g, %g) N.m: %s",
                   p->gear[0], p->gear[1], p->speed[0], p->speed[1], p->speed[2],
                   p->torque[1], p->torque[2], why->message);
}

/* A point that failed is tried once more, from rest. */
static gm_status measure(void *work, const gm_steady_point *point,
                         gm_steady_result *result, gm_error *error)
{
    point_work *w = work;
    point_request request;
    gm_rig_found found;
    gm_error why = {GM_OK, ""};
    to_request(w, point, &request);
    gm_status status = gm_child_call(w->child, &request, &found, &why);
    if (status == GM_ERR_TOOL || status == GM_ERR_SOLVE) {
        request.restart = 1;
        status = gm_child_call(w->child, &request, &found, &why);
    }
    w->restart = status != GM_OK;
    if (status != GM_OK)
        return name_point(point, status, &why, error);
    memset(result, 0, sizeof *result);
    for (int f = 0; f <= w->plant->plant.info.n_paths; f++) {
        int engaged = f > 0 && point->gear[f - 1] != 0;
        result->torque[f] = engaged ? point->torque[f] : found.torque[f];
        result->speed[f] =
            engaged ? request.target.ratio[f - 1] * point->speed[0] : point->speed[f];
        int stands = point->speed[f] == 0.0 && point->direction[f] == 0.0;
        result->uncertainty[f] = engaged || stands ? 0.0 : found.change[f];
    }
    return GM_OK;
}

static const gm_plant_class rig_class = {
    .kinematics = kinematics,
    .kink_speeds = no_kinks,
    .kink_torques = no_kinks,
    .drag_lines = drag_lines,
    .work_create = work_create,
    .work_destroy = work_destroy,
    .measure = measure,
    .restart = restart,
};

/* ---- life ---- */

static void fill_report(const rig_plant *p, gm_rig_report *report)
{
    double largest = 0.0;
    for (int f = 0; f <= p->plant.info.n_paths; f++)
        largest = fmax(largest,
                       p->identity.inertia[f].uncertainty / p->identity.inertia[f].value);
    *report = (gm_rig_report){.inertia_uncertainty = largest};
}

static gm_status check(const gm_rig *rig, const gm_plant_info *info,
                       const gm_rig_settings *settings, gm_error *error)
{
    for (int f = 0; f <= info->n_paths && settings->losses_by_ramps; f++)
        if (rig->drive[f] == GM_RIG_SPEED_IN)
            return gm_fail(
                error, GM_ERR_ARGUMENT,
                "losses cannot be measured by ramps: the model takes the speed "
                "of the %s and not its torque; losses settle can",
                f == 0 ? "output" : info->path[f - 1].name);
    for (int q = 0; q < info->n_paths; q++)
        if (info->path[q].n_gears > GM_RIG_MAX_GEARS)
            return gm_fail(error, GM_ERR_ARGUMENT,
                           "path '%s' has %d gears; at most %d are possible",
                           info->path[q].name, info->path[q].n_gears, GM_RIG_MAX_GEARS);
    return GM_OK;
}

gm_status gm_rig_plant_create(const gm_rig *rig, const gm_plant_info *info,
                              const gm_rig_settings *settings, gm_plant **plant,
                              gm_rig_report *report, gm_error *error)
{
    gm_status checked = check(rig, info, settings, error);
    if (checked != GM_OK)
        return checked;
    rig_plant *p = gm_calloc(1, sizeof *p);
    if (!p)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    p->plant = (gm_plant){.is = &rig_class, .self = p, .info = *info};
    p->rig = rig;
    p->settings = *settings;
    p->scales = (gm_rig_scales){.speed = info->speed_max, .torque = info->torque_max};
    gm_status status = settings->known ? take_known(p, error) : identify(p, error);
    if (status != GM_OK) {
        gm_free(p);
        return status;
    }
    set_lines(p);
    if (report)
        fill_report(p, report);
    *plant = &p->plant;
    return GM_OK;
}

void gm_rig_plant_destroy(gm_plant *plant)
{
    gm_free(plant); /* the first member of rig_plant */
}
