/* SPDX-License-Identifier: BSD-2-Clause */
#include "vehicle/gear_plan.h"

#include "base/alloc.h"

#include <math.h>

/* Engine speeds at which a cycle without gears is shifted [rad/s], and how long a gear
 * lasts at least [s]. Between them lies more than the largest step of ratios here. */
#define SHIFT_UP 210.0
#define SHIFT_DOWN 115.0
#define LOWEST_AFTER_SHIFT 120.0
#define GEAR_LASTS 3.0
#define LOOK_EVERY 0.5
#define STANDS 0.5 /* m/s */

/* ---- the gear that drives, over time ---- */

typedef struct wish_list {
    int n;
    gm_cycle_gear *wish; /* gear: index into the transmission's gears */
} wish_list;

static int most_wishes(const gm_cycle *c)
{
    return c->n_gears + (int)(gm_cycle_duration(c) / LOOK_EVERY) + 2;
}

static void add_wish(wish_list *list, double time, int gear)
{
    if (list->n == 0 || list->wish[list->n - 1].gear != gear)
        list->wish[list->n++] = (gm_cycle_gear){time, gear};
}

static int index_of(const gm_transmission *t, int number)
{
    int best = 0;
    for (int i = 0; i < t->n_gears; i++)
        if (t->gear[i].number <= number)
            best = i;
    return best;
}

static void wishes_of_cycle(const gm_cycle *c, const gm_transmission *t, wish_list *list)
{
    for (int i = 0; i < c->n_gears; i++)
        add_wish(list, c->gears[i].time, index_of(t, c->gears[i].gear));
}

/* The next gear at this speed of the car: one up, one down, or first when it stands. */
static int next_gear(const gm_transmission *t, double w_output, int now)
{
    double w = w_output * t->gear[now].ratio;
    if (now + 1 < t->n_gears && w > SHIFT_UP &&
        w_output * t->gear[now + 1].ratio > LOWEST_AFTER_SHIFT)
        return now + 1;
    if (now > 0 && w < SHIFT_DOWN)
        return now - 1;
    return now;
}

static void wishes_of_trace(const gm_cycle *c, const gm_vehicle *v,
                            const gm_transmission *t, wish_list *list)
{
    int now = 0;
    double since = 0.0;
    add_wish(list, 0.0, 0);
    for (double time = 0.0; time < gm_cycle_duration(c); time += LOOK_EVERY) {
        double acceleration, speed = gm_cycle_speed(c, time, &acceleration);
        int next = speed < STANDS ? 0 : next_gear(t, speed / v->wheel_radius, now);
        if (next == now || (time - since < GEAR_LASTS && next != 0))
            continue;
        add_wish(list, time, next);
        now = next;
        since = time;
    }
}

/* ---- commands and ramps ---- */

void gm_gear_plan_destroy(gm_gear_plan *plan)
{
    if (!plan)
        return;
    gm_free(plan->commands);
    for (int p = 0; p < GM_MAX_INPUT_PATHS; p++)
        gm_free(plan->ramps[p]);
    gm_free(plan->ratios);
    gm_free(plan->shifts);
    gm_free(plan);
}

static int allocate(gm_gear_plan *plan, int n_wishes)
{
    size_t n = (size_t)n_wishes + GM_MAX_INPUT_PATHS;
    plan->commands = gm_calloc(n, sizeof *plan->commands);
    plan->ratios = gm_calloc(n, sizeof *plan->ratios);
    plan->shifts = gm_calloc(n, sizeof *plan->shifts);
    int ok = plan->commands && plan->ratios && plan->shifts;
    for (int p = 0; p < GM_MAX_INPUT_PATHS; p++) {
        plan->ramps[p] = gm_calloc(2 * n, sizeof *plan->ramps[p]);
        ok = ok && plan->ramps[p];
    }
    return ok;
}

static void command(gm_gear_plan *plan, double time, int path, int gear)
{
    plan->commands[plan->n_commands++] = (gm_gear_command){time, path, gear};
}

static void share(gm_gear_plan *plan, int path, double start, double length, double to)
{
    plan->ramps[path][plan->n_ramps[path]++] =
        (gm_ramp){start, start + length, 1.0 - to, to};
}

static void ratio(gm_gear_plan *plan, double start, double length, double from, double to)
{
    plan->ratios[plan->n_ratios++] = (gm_ramp){start, start + length, from, to};
}

/* From one path to the other. Returns the end. */
static double hand_over(gm_gear_plan *plan, const gm_vehicle *v, const gm_plan_gear *from,
                        const gm_plan_gear *to, double start, double earliest)
{
    command(plan, fmax(earliest, start - v->preselect_time), to->path, to->number);
    share(plan, from->path, start, v->shift_time, 0.0);
    share(plan, to->path, start, v->shift_time, 1.0);
    ratio(plan, start, v->shift_time, from->ratio, to->ratio);
    return start + v->shift_time;
}

/* Within one path. Returns the end. */
static double interrupt(gm_gear_plan *plan, const gm_vehicle *v, const gm_plan_gear *from,
                        const gm_plan_gear *to, double start)
{
    double t = v->interrupt_time;
    share(plan, from->path, start, t, 0.0);
    command(plan, start + t, to->path, to->number);
    ratio(plan, start + t, t, from->ratio, to->ratio);
    share(plan, to->path, start + 2.0 * t, t, 1.0);
    return start + 3.0 * t;
}

/* Wishes that come while a shift is under way wait for its end. */
static void make_plan(gm_gear_plan *plan, const gm_vehicle *v, const gm_transmission *t,
                      const wish_list *list)
{
    const gm_plan_gear *now = &t->gear[list->wish[0].gear];
    double free_from = 0.0;
    for (int p = 0; p < t->n_paths; p++)
        command(plan, 0.0, p, p == now->path ? now->number : 0);
    plan->first_share[now->path] = 1.0;
    plan->first_ratio = now->ratio;
    plan->first_gear = now->number;
    for (int i = 1; i < list->n; i++) {
        const gm_plan_gear *next = &t->gear[list->wish[i].gear];
        double start = fmax(free_from, list->wish[i].time);
        if (next == now)
            continue;
        free_from = next->path != now->path
                        ? hand_over(plan, v, now, next, start, free_from)
                        : interrupt(plan, v, now, next, start);
        plan->shifts[plan->n_shifts++] =
            (gm_plan_shift){start, free_from, now->number, next->number, next->path};
        now = next;
    }
}

gm_status gm_gear_plan_create(const gm_cycle *cycle, const gm_vehicle *vehicle,
                              const gm_transmission *transmission, gm_gear_plan **plan,
                              gm_error *error)
{
    if (transmission->n_gears < 1)
        return gm_fail(error, GM_ERR_ARGUMENT, "the gearset has no forward gear");
    wish_list list = {.n = 0};
    list.wish = gm_calloc((size_t)most_wishes(cycle), sizeof *list.wish);
    gm_gear_plan *made = gm_calloc(1, sizeof *made);
    gm_status status = GM_OK;
    if (list.wish && cycle->n_gears > 0)
        wishes_of_cycle(cycle, transmission, &list);
    else if (list.wish)
        wishes_of_trace(cycle, vehicle, transmission, &list);
    if (list.wish && made && allocate(made, list.n)) {
        make_plan(made, vehicle, transmission, &list);
        *plan = made;
    } else {
        gm_gear_plan_destroy(made);
        status = gm_fail(error, GM_ERR_MEMORY, "out of memory");
    }
    gm_free(list.wish);
    return status;
}

/* ---- reading it ---- */

void gm_gear_plan_gears(const gm_gear_plan *plan, double t, int gear[GM_MAX_INPUT_PATHS])
{
    for (int p = 0; p < GM_MAX_INPUT_PATHS; p++)
        gear[p] = 0;
    for (int i = 0; i < plan->n_commands && plan->commands[i].time <= t; i++)
        gear[plan->commands[i].path] = plan->commands[i].gear;
}

/* 3 s^2 - 2 s^3 between the ends of the last ramp that began. */
static double ramp_value(int n, const gm_ramp *ramps, double first, double t)
{
    int low = -1, high = n;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (ramps[middle].from_time <= t)
            low = middle;
        else
            high = middle;
    }
    if (low < 0)
        return first;
    const gm_ramp *r = &ramps[low];
    double s = fmin(1.0, (t - r->from_time) / (r->to_time - r->from_time));
    return r->from + (r->to - r->from) * s * s * (3.0 - 2.0 * s);
}

double gm_gear_plan_share(const gm_gear_plan *plan, int p, double t)
{
    return ramp_value(plan->n_ramps[p], plan->ramps[p], plan->first_share[p], t);
}

double gm_gear_plan_ratio(const gm_gear_plan *plan, double t)
{
    return ramp_value(plan->n_ratios, plan->ratios, plan->first_ratio, t);
}

int gm_gear_plan_driving(const gm_gear_plan *plan, double t)
{
    int gear = plan->first_gear;
    for (int i = 0; i < plan->n_shifts; i++)
        if (t >= 0.5 * (plan->shifts[i].start + plan->shifts[i].end))
            gear = plan->shifts[i].to;
    return gear;
}

static double earlier(double t, double candidate, double best)
{
    return candidate > t && candidate < best ? candidate : best;
}

double gm_gear_plan_next(const gm_gear_plan *plan, double t)
{
    double best = (double)INFINITY;
    for (int i = 0; i < plan->n_commands; i++)
        best = earlier(t, plan->commands[i].time, best);
    for (int p = 0; p < GM_MAX_INPUT_PATHS; p++)
        for (int i = 0; i < plan->n_ramps[p]; i++)
            best = earlier(t, plan->ramps[p][i].to_time,
                           earlier(t, plan->ramps[p][i].from_time, best));
    return best;
}
