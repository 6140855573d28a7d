/* SPDX-License-Identifier: BSD-2-Clause */
#include "vehicle/trip.h"

#include "base/alloc.h"
#include "vehicle/trip_jacobian.h"

#include <math.h>
#include <string.h>
#include <time.h>

/* Reading the clock takes as long as the rates of a reduced gearset: a sample is timed,
 * and what the clock itself takes is taken off. */
#define TIMED_EVERY 32
#define READINGS 8

static double seconds(void)
{
    struct timespec now;
    (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* The quickest of several readings: the others were disturbed. */
static double clock_cost(void)
{
    double cost = 1.0, before = seconds();
    for (int i = 0; i < READINGS; i++) {
        double now = seconds();
        cost = fmin(cost, now - before);
        before = now;
    }
    return cost;
}

double gm_trip_gearset_time(const gm_trip *trip)
{
    return trip->gearset_time;
}

/* ---- one instant ---- */

static void look(gm_trip *trip, double t, const double *x, gm_car_point *point)
{
    double speed[GM_MAX_FLANGES] = {0.0};
    if (t != trip->instant.t)
        gm_car_time_at(&trip->parts, t, &trip->instant);
    for (int f = 0; f <= trip->parts.gearset->n_paths; f++)
        speed[f] = x[trip->speed_state[f]];
    gm_car_at(&trip->parts, &trip->instant, x, speed, point);
    gm_car_torques(&trip->parts, point, trip->input.torque);
}

static int rates(void *user, double t, const double *x, double *dx)
{
    gm_trip *trip = user;
    gm_car_point point;
    look(trip, t, x, &point);
    gm_car_rates(&trip->parts, &point, x, dx);
    int timed = ++trip->evaluations % TIMED_EVERY == 0;
    double before = timed ? seconds() : 0.0;
    int flag = trip->is->rates(trip->motion, &trip->input, x + GM_CAR_STATES,
                               dx + GM_CAR_STATES);
    if (timed)
        trip->gearset_time +=
            TIMED_EVERY * fmax(0.0, seconds() - before - trip->clock_cost);
    return flag;
}

static int jacobian(void *user, double t, const double *x, double *value)
{
    gm_trip *trip = user;
    gm_car_point point;
    look(trip, t, x, &point);
    return gm_trip_jacobian(trip, &point, x, value);
}

static int events(void *user, double t, const double *x, double *g)
{
    gm_trip *trip = user;
    gm_car_point point;
    look(trip, t, x, &point);
    return trip->is->events(trip->motion, &trip->input, x + GM_CAR_STATES, g);
}

/* ---- start, pieces, modes ---- */

/* The car stands with its engine idling. */
static gm_status start(void *user, double t, double *x, gm_error *error)
{
    gm_trip *trip = user;
    const double rest[GM_MAX_FLANGES] = {0.0};
    memset(x, 0, GM_CAR_STATES * sizeof *x);
    x[GM_CAR_ENGINE_SPEED] = x[GM_CAR_DRUM_SPEED] = trip->parts.vehicle->idle_speed;
    memset(&trip->input, 0, sizeof trip->input);
    gm_gear_plan_gears(trip->parts.plan, t, trip->input.gear);
    return trip->is->start(trip->motion, &trip->input, rest, x + GM_CAR_STATES, error);
}

static void tolerances(void *user, double relative, double *absolute)
{
    gm_trip *trip = user;
    for (int i = 0; i < GM_CAR_STATES; i++)
        absolute[i] = relative * gm_car_typical[i];
    trip->is->tolerances(trip->motion, relative, absolute + GM_CAR_STATES);
}

static gm_status handle(void *user, double t, double *x, int *changed, gm_error *error)
{
    gm_trip *trip = user;
    gm_car_point point;
    look(trip, t, x, &point);
    return trip->is->handle(trip->motion, &trip->input, t, x + GM_CAR_STATES, changed,
                            error);
}

static gm_status enter(void *user, double t, double *x, gm_transient_piece *piece,
                       gm_error *error)
{
    gm_trip *trip = user;
    gm_gear_plan_gears(trip->parts.plan, t, trip->input.gear);
    piece->end =
        fmin(gm_gear_plan_next(trip->parts.plan, t), gm_cycle_next(trip->parts.cycle, t));
    piece->work = 0.0;
    gm_status status = handle(trip, t, x, &piece->restart, error);
    if (status == GM_OK && trip->is->next)
        piece->end = fmin(piece->end, trip->is->next(trip->motion, t));
    return status;
}

/* ---- accounts ---- */

static void powers(void *user, double t, const double *x, gm_transient_powers *powers)
{
    gm_trip *trip = user;
    gm_car_point point;
    gm_motion_view view;
    double dx[GM_CAR_STATES];
    look(trip, t, x, &point);
    gm_car_rates(&trip->parts, &point, x, dx);
    trip->is->view(trip->motion, &trip->input, x + GM_CAR_STATES, &view);
    powers->in = dx[GM_CAR_ENGINE_WORK];
    powers->through = fabs(dx[GM_CAR_ENGINE_WORK]);
    powers->loss = dx[GM_CAR_CLUTCH_LOSS] + dx[GM_CAR_DAMPER_LOSS] +
                   dx[GM_CAR_ROAD_LOSS] + dx[GM_CAR_BRAKE_LOSS] + view.loss_power;
    powers->stored = gm_car_stored(trip->parts.vehicle, x) + view.stored_energy;
    powers->lost = view.jump_loss;
}

void gm_trip_look(gm_trip *trip, double t, const double *x, gm_trip_view *view)
{
    gm_car_point point;
    gm_motion_view gearset;
    look(trip, t, x, &point);
    trip->is->view(trip->motion, &trip->input, x + GM_CAR_STATES, &gearset);
    *view = (gm_trip_view){
        .cycle_speed = trip->instant.v_ref,
        .speed = x[GM_CAR_SPEED],
        .distance = x[GM_CAR_DISTANCE],
        .height = x[GM_CAR_HEIGHT],
        .engine_speed = x[GM_CAR_ENGINE_SPEED],
        .engine_torque = x[GM_CAR_ENGINE_TORQUE],
        .demand = point.act.torque,
        .output_torque = point.shafts,
        .output_speed = point.speed[0],
        .brake = point.act.brake,
        .engine_work = x[GM_CAR_ENGINE_WORK],
        .clutch_loss = x[GM_CAR_CLUTCH_LOSS],
        .damper_loss = x[GM_CAR_DAMPER_LOSS],
        .road_loss = x[GM_CAR_ROAD_LOSS],
        .brake_loss = x[GM_CAR_BRAKE_LOSS],
        .gearset_work = x[GM_CAR_GEARSET_WORK],
        .gearset_stored = gearset.stored_energy,
    };
    for (int p = 0; p < trip->parts.gearset->n_paths; p++) {
        view->input_torque[p] = point.clutch[p];
        view->input_speed[p] = point.speed[1 + p];
        view->gear[p] = trip->input.gear[p];
        view->state[p] = gearset.state[p];
    }
}

static const char *state_name(void *user, int i)
{
    gm_trip *trip = user;
    if (i < GM_CAR_STATES)
        return gm_car_state_name(i);
    return trip->is->state_name ? trip->is->state_name(trip->motion, i - GM_CAR_STATES)
                                : NULL;
}

/* ---- create ---- */

void gm_trip_destroy(gm_trip *trip)
{
    if (!trip)
        return;
    if (trip->motion)
        trip->is->destroy(trip->motion);
    gm_trip_pattern_free(trip);
    gm_free(trip);
}

gm_status gm_trip_create(const gm_trip_parts *parts, gm_trip **trip, gm_error *error)
{
    gm_trip *made = gm_calloc(1, sizeof *made);
    if (!made)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    made->parts = *parts;
    made->is = parts->gearset->is;
    made->instant.t = (double)NAN;
    made->clock_cost = clock_cost();
    gm_status status = made->is->create(parts->gearset->plant, &made->motion, error);
    if (status == GM_OK) {
        made->n_gearset = made->is->n_states(made->motion);
        made->n = GM_CAR_STATES + made->n_gearset;
        for (int f = 0; f <= parts->gearset->n_paths; f++)
            made->speed_state[f] = GM_CAR_STATES + made->is->speed_state(made->motion, f);
        if (gm_trip_pattern(made))
            status = gm_fail(error, GM_ERR_MEMORY, "out of memory");
    }
    if (status != GM_OK) {
        gm_trip_destroy(made);
        return status;
    }
    *trip = made;
    return GM_OK;
}

gm_transient_system gm_trip_system(gm_trip *trip)
{
    return (gm_transient_system){.user = trip,
                                 .n_states = trip->n,
                                 .n_events = trip->is->n_events(trip->motion),
                                 .column_start = trip->column_start,
                                 .row = trip->row,
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
