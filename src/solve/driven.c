/* SPDX-License-Identifier: BSD-2-Clause */
#include "solve/gm_driven.h"

#include "base/alloc.h"
#include "base/linear.h"
#include "solve/driven_jacobian.h"

#include <math.h>
#include <string.h>

/* ---- the torques that give the speeds ---- */

/* rates without the driven torques in dx and the columns of these torques; then the
 * torques themselves in input. */
static int solve_torques(gm_driven *d, const gm_drive_point *point, const double *x,
                         double *dx)
{
    double u[GM_MAX_FLANGES];
    int flag = d->is->rates(d->motion, &d->input, x, dx);
    for (int j = 0; j < d->n_driven && flag == 0; j++)
        flag = d->is->torque_column(d->motion, &d->input, x, d->driven[j], d->column[j]);
    if (flag)
        return flag;
    for (int i = 0; i < d->n_driven; i++) {
        int s = d->speed_state[i];
        u[i] = point->acceleration[d->driven[i]] - dx[s];
        for (int j = 0; j < d->n_driven; j++)
            d->lu[i * d->n_driven + j] = d->column[j][s];
    }
    if (!gm_lu_factor(d->n_driven, d->lu, d->pivot))
        return -1;
    gm_lu_solve(d->n_driven, d->lu, d->pivot, u);
    for (int j = 0; j < d->n_driven; j++)
        d->input.torque[d->driven[j]] = u[j];
    return 0;
}

static void forget(gm_driven *d)
{
    d->t_known = (double)NAN;
}

static void take_point(gm_driven *d, double t, gm_drive_point *point)
{
    d->drive.at(d->drive.user, t, point);
    for (int j = 0; j < d->n_driven; j++)
        point->input.torque[d->driven[j]] = 0.0;
    d->input = point->input;
}

/* Everything at (t, x): d->input with all torques, and the rates. */
static int evaluate(gm_driven *d, double t, const double *x, double *dx)
{
    gm_drive_point point = {0};
    forget(d);
    take_point(d, t, &point);
    if (d->n_driven == 0)
        return d->is->rates(d->motion, &d->input, x, dx);
    int flag = solve_torques(d, &point, x, dx);
    for (int j = 0; j < d->n_driven && flag == 0; j++) {
        double u = d->input.torque[d->driven[j]];
        for (int i = 0; i < d->n; i++)
            dx[i] += d->column[j][i] * u;
    }
    for (int j = 0; j < d->n_driven && flag == 0; j++)
        dx[d->speed_state[j]] = point.acceleration[d->driven[j]];
    return flag;
}

/* Input alone; without driven flanges the plant is not asked, nor is it asked twice. */
static int find_input(gm_driven *d, double t, const double *x)
{
    gm_drive_point point = {0};
    size_t size = (size_t)d->n * sizeof *x;
    if (d->n_driven == 0) {
        take_point(d, t, &point);
        return 0;
    }
    if (t == d->t_known && memcmp(x, d->x_known, size) == 0)
        return 0;
    take_point(d, t, &point);
    int flag = solve_torques(d, &point, x, d->dx);
    if (flag == 0) {
        d->t_known = t;
        memcpy(d->x_known, x, size);
    }
    return flag;
}

int gm_driven_input(gm_driven *d, double t, const double *x, gm_motion_input *input)
{
    int flag = find_input(d, t, x);
    if (flag == 0)
        *input = d->input;
    return flag;
}

/* ---- calls of the solver ---- */

static void set_speeds(gm_driven *d, double t, double *x)
{
    gm_drive_point point = {0};
    take_point(d, t, &point);
    for (int j = 0; j < d->n_driven; j++)
        x[d->speed_state[j]] = point.speed[d->driven[j]];
}

static gm_status check_independent(gm_driven *d, double t, const double *x,
                                   gm_error *error)
{
    int flag = find_input(d, t, x);
    if (flag < 0 && d->n_driven > 1)
        return gm_fail(error, GM_ERR_MODEL,
                       "the speeds of %d flanges are given, but they are not independent "
                       "of each other in this gear",
                       d->n_driven);
    if (flag)
        return gm_fail(error, GM_ERR_SOLVE, "the plant cannot be evaluated at t = %.9g s",
                       t);
    return GM_OK;
}

static gm_status start(void *user, double t, double *x, gm_error *error)
{
    gm_driven *d = user;
    int jump;
    gm_drive_point point = {0};
    double speed[GM_MAX_FLANGES];
    forget(d);
    (void)d->drive.enter(d->drive.user, t, &jump);
    d->drive.at(d->drive.user, t, &point);
    for (int f = 0; f < d->n_flanges; f++)
        speed[f] = d->drive.driven[f] ? point.speed[f] : d->start_speed[f];
    gm_status status = d->is->start(d->motion, &point.input, speed, x, error);
    if (status != GM_OK)
        return status;
    set_speeds(d, t, x);
    return check_independent(d, t, x, error);
}

static void tolerances(void *user, double relative, double *absolute)
{
    gm_driven *d = user;
    d->is->tolerances(d->motion, relative, absolute);
}

static int rates(void *user, double t, const double *x, double *dx)
{
    return evaluate(user, t, x, dx);
}

static int jacobian(void *user, double t, const double *x, double *value)
{
    gm_driven *d = user;
    if (!d->is->jacobian)
        return gm_driven_differences(d, evaluate, t, x, value);
    int flag = find_input(d, t, x);
    return flag ? flag : gm_driven_jacobian(d, x, value);
}

static int events(void *user, double t, const double *x, double *g)
{
    gm_driven *d = user;
    int flag = find_input(d, t, x);
    return flag ? flag : d->is->events(d->motion, &d->input, x, g);
}

static gm_status handle(void *user, double t, double *x, int *changed, gm_error *error)
{
    gm_driven *d = user;
    if (find_input(d, t, x))
        return gm_fail(error, GM_ERR_SOLVE, "the plant cannot be evaluated at t = %.9g s",
                       t);
    gm_status status = d->is->handle(d->motion, &d->input, t, x, changed, error);
    if (*changed)
        forget(d);
    return status;
}

static void powers(void *user, double t, const double *x, gm_transient_powers *powers)
{
    gm_driven *d = user;
    gm_motion_view view = {.loss_power = (double)NAN};
    if (find_input(d, t, x) == 0)
        d->is->view(d->motion, &d->input, x, &view);
    *powers = (gm_transient_powers){
        .loss = view.loss_power, .stored = view.stored_energy, .lost = view.jump_loss};
    double in = 0.0, out = 0.0;
    for (int f = 0; f < d->n_flanges; f++) {
        double power = d->input.torque[f] * view.speed[f];
        in += fmax(power, 0.0);
        out += fmax(-power, 0.0);
    }
    powers->in = in - out;
    powers->through = fmax(in, out);
}

/* Stored energy at the present x, for the work of an impulse. */
static double stored_energy(gm_driven *d, double t, const double *x)
{
    gm_transient_powers now;
    powers(d, t, x, &now);
    return now.stored;
}

/* Does a driven speed rise otherwise than before? Then rates jump. */
static int bends(const gm_driven *d, const gm_drive_point *before, double t)
{
    gm_drive_point now = {0};
    int bend = 0;
    d->drive.at(d->drive.user, t, &now);
    for (int j = 0; j < d->n_driven; j++)
        bend |= now.acceleration[d->driven[j]] != before->acceleration[d->driven[j]];
    return bend;
}

static gm_status enter(void *user, double t, double *x, gm_transient_piece *piece,
                       gm_error *error)
{
    gm_driven *d = user;
    int jump = 0, changed = 0;
    gm_drive_point before = {0};
    double stored = stored_energy(d, t, x);
    d->drive.at(d->drive.user, t, &before);
    piece->end = d->drive.enter(d->drive.user, t, &jump);
    forget(d);
    if (jump || bends(d, &before, t)) {
        set_speeds(d, t, x);
        piece->work = stored_energy(d, t, x) - stored;
        piece->restart = 1;
    }
    gm_status status = handle(d, t, x, &changed, error);
    piece->restart |= changed;
    return status;
}

static const char *state_name(void *user, int i)
{
    gm_driven *d = user;
    return d->is->state_name ? d->is->state_name(d->motion, i) : NULL;
}

/* ---- create ---- */

gm_transient_system gm_driven_system(gm_driven *d)
{
    return (gm_transient_system){.user = d,
                                 .n_states = d->n,
                                 .n_events = d->is->n_events(d->motion),
                                 .column_start = d->column_start,
                                 .row = d->row,
                                 .start = start,
                                 .tolerances = tolerances,
                                 .rates = rates,
                                 .jacobian = jacobian,
                                 .events = events,
                                 .enter = enter,
                                 .handle = handle,
                                 .powers = powers,
                                 .state_name = state_name};
}

void *gm_driven_motion(gm_driven *d)
{
    return d->motion;
}

static int make_room(gm_driven *d)
{
    size_t n = (size_t)d->n;
    d->dx = gm_calloc(n, sizeof *d->dx);
    d->x_known = gm_calloc(n, sizeof *d->x_known);
    int missing = !d->dx || !d->x_known;
    for (int j = 0; j < d->n_driven; j++) {
        d->column[j] = gm_calloc(n, sizeof *d->column[j]);
        missing |= !d->column[j];
    }
    return missing;
}

static void list_driven(gm_driven *d)
{
    for (int f = 0; f < d->n_flanges; f++)
        if (d->drive.driven[f]) {
            d->speed_state[d->n_driven] = d->is->speed_state(d->motion, f);
            d->driven[d->n_driven++] = f;
        }
}

/* A first start shows which states the torques of the driven flanges reach. */
static gm_status begin(gm_driven *d, const gm_dynamics *dynamics, double t,
                       gm_error *error)
{
    gm_status status = d->is->create(dynamics->plant, &d->motion, error);
    if (status != GM_OK)
        return status;
    d->n = d->is->n_states(d->motion);
    list_driven(d);
    if (make_room(d))
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    status = start(d, t, d->x_known, error);
    if (status == GM_OK && gm_driven_pattern(d))
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    return status;
}

gm_status gm_driven_create(const gm_dynamics *dynamics, const gm_drive *drive, double t,
                           const double *start_speed, gm_driven **driven, gm_error *error)
{
    gm_driven *d = gm_calloc(1, sizeof *d);
    if (!d)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    d->is = dynamics->is;
    d->drive = *drive;
    d->n_flanges = 1 + dynamics->n_paths;
    memcpy(d->start_speed, start_speed, (size_t)d->n_flanges * sizeof *start_speed);
    gm_status status = begin(d, dynamics, t, error);
    if (status != GM_OK) {
        gm_driven_destroy(d);
        return status;
    }
    *driven = d;
    return GM_OK;
}

void gm_driven_destroy(gm_driven *d)
{
    if (!d)
        return;
    if (d->motion)
        d->is->destroy(d->motion);
    for (int j = 0; j < GM_MAX_FLANGES; j++)
        gm_free(d->column[j]);
    gm_driven_pattern_free(d);
    gm_free(d->x_known);
    gm_free(d->dx);
    gm_free(d);
}
