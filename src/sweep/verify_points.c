/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/verify_points.h"

#include "map/gm_map.h"

#include <math.h>

#define PI 3.14159265358979323846
#define LOWEST_SPEED (2.0 * PI / 60.0) /* 1 rpm, rad/s */
#define MAX_DRAWS 1000

uint64_t gm_random_next(uint64_t *state)
{
    uint64_t z = (*state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

double gm_random_between(uint64_t *state, double low, double high)
{
    double unit = (double)(gm_random_next(state) >> 11) * 0x1p-53;
    return low + (high - low) * unit;
}

static double random_sign(uint64_t *random)
{
    return gm_random_next(random) >> 63 ? 1.0 : -1.0;
}

/* The path whose speed is drawn while the gearset turns as a whole: the loaded one; the
   faster one when both are, since it reaches its largest speed first. */
static int leading_path(const gm_verify_draw *draw)
{
    if (draw->path >= 0)
        return draw->path;
    return fabs(draw->ratio[1]) > fabs(draw->ratio[0]);
}

static void draw_engaged(const gm_verify_draw *draw, const gm_plant *plant,
                         uint64_t *random, gm_steady_point *point)
{
    int lead = leading_path(draw);
    double largest = fabs(draw->ratio[lead]);
    for (int p = 0; p < plant->info.n_paths; p++) {
        int loaded = draw->path < 0 || p == draw->path;
        double torque_max = plant->info.torque_max;
        if (loaded)
            point->torque[1 + p] = gm_random_between(random, -torque_max, torque_max);
        largest = fmax(largest, fabs(draw->ratio[p]));
    }
    /* No shaft turns faster than the gearset is meant for, a preselected one neither. */
    double fastest = plant->info.speed_max * fabs(draw->ratio[lead]) / largest;
    double w = gm_random_between(random, LOWEST_SPEED, fastest);
    point->speed[0] = draw->direction * w / fabs(draw->ratio[lead]);
}

/* Reactions are compared with the path at rest, which may lie on a ramp as well. */
static int near_line(const gm_verify_draw *draw, double w_n, double w_o)
{
    for (int g = 0; g < draw->n_lines[draw->path]; g++) {
        double on = draw->line[draw->path][g] * w_o;
        if (fabs(w_n - on) < GM_LINE_WIDTH ||
            (draw->group == GM_VERIFY_REACTION && fabs(on) < GM_LINE_WIDTH))
            return 1;
    }
    return 0;
}

static void draw_free(const gm_verify_draw *draw, const gm_plant *plant, uint64_t *random,
                      gm_steady_point *point)
{
    double w_o = 0.0, w_n = 0.0;
    for (int i = 0; i < MAX_DRAWS && (i == 0 || near_line(draw, w_n, w_o)); i++) {
        w_o = draw->direction * gm_random_between(random, LOWEST_SPEED, draw->output_max);
        w_n = random_sign(random) *
              gm_random_between(random, LOWEST_SPEED, plant->info.speed_max);
    }
    point->speed[0] = w_o;
    point->speed[1 + draw->path] = w_n;
    point->direction[1 + draw->path] = w_n < 0 ? -1.0 : 1.0;
}

typedef struct both_answers {
    gm_steady_result detailed;
    gm_reduced_answer reduced;
    int failed; /* 1: a simulated model failed, no fault of the reduced one */
} both_answers;

static gm_status ask(gm_steady_solver *solver, const gm_reduced_probe *probe,
                     const gm_steady_point *point, both_answers *answers, gm_error *error)
{
    const gm_plant *plant = gm_steady_solver_plant(solver);
    const double oil = plant->info.oil_temperature;
    gm_status status = gm_steady_solve(solver, point, &answers->detailed, error);
    answers->failed =
        plant->is->measure && (status == GM_ERR_TOOL || status == GM_ERR_SOLVE);
    if (status != GM_OK)
        return status;
    return probe->at(probe->self, oil, point, answers->detailed.torque[0],
                     &answers->reduced, error);
}

static void compare_loss(const gm_verify_draw *draw, int n_paths, const both_answers *at,
                         gm_verify_sample *sample)
{
    const gm_steady_result *d = &at->detailed;
    int lead = leading_path(draw);
    double power = 0.0;
    for (int flange = 0; flange <= n_paths; flange++)
        power += d->torque[flange] * d->speed[flange];
    sample->speed = d->speed[1 + lead];
    sample->torque = d->torque[1 + lead];
    sample->detailed = power / fabs(sample->speed);
    sample->reduced = at->reduced.loss_power / fabs(sample->speed);
}

/* A difference of torques of this size, or 0 where it is no more than what the solver
   leaves: nothing may be between a path and the output. */
static double beyond_rounding(double difference, double size)
{
    return fabs(difference) > 1e-9 * fabs(size) ? difference : 0.0;
}

/* Against the same point with the path at rest. */
static gm_status compare_reaction(const gm_verify_draw *draw, gm_steady_solver *solver,
                                  const gm_reduced_probe *probe, gm_steady_point point,
                                  const both_answers *turning, gm_verify_sample *sample,
                                  gm_error *error)
{
    both_answers resting;
    point.speed[1 + draw->path] = 0.0;
    point.direction[1 + draw->path] = 0.0;
    gm_status status = ask(solver, probe, &point, &resting, error);
    sample->failed = resting.failed;
    if (status != GM_OK)
        return status;
    double torque = resting.detailed.torque[0];
    sample->detailed = beyond_rounding(turning->detailed.torque[0] - torque, torque);
    sample->reduced = beyond_rounding(
        turning->reduced.output_reaction - resting.reduced.output_reaction, torque);
    return GM_OK;
}

gm_status gm_verify_compare(const gm_verify_draw *draw, gm_steady_solver *solver,
                            const gm_plant *plant, const gm_reduced_probe *probe,
                            uint64_t *random, gm_verify_sample *sample, gm_error *error)
{
    gm_steady_point point = {{0}, {0.0}, {0.0}, {0.0}};
    both_answers at;
    int free_path = draw->group == GM_VERIFY_DRAG || draw->group == GM_VERIFY_REACTION;
    for (int p = 0; p < plant->info.n_paths; p++)
        point.gear[p] = draw->gear[p];
    point.direction[0] = draw->direction;
    if (free_path)
        draw_free(draw, plant, random, &point);
    else
        draw_engaged(draw, plant, random, &point);
    gm_steady_solver_restart(solver);
    gm_status status = ask(solver, probe, &point, &at, error);
    sample->failed = at.failed;
    if (status != GM_OK)
        return status;
    sample->output_speed = point.speed[0];
    sample->oil = plant->info.oil_temperature;
    if (!free_path) {
        compare_loss(draw, plant->info.n_paths, &at, sample);
        return GM_OK;
    }
    sample->speed = point.speed[1 + draw->path];
    sample->torque = at.detailed.torque[1 + draw->path];
    if (draw->group == GM_VERIFY_REACTION)
        return compare_reaction(draw, solver, probe, point, &at, sample, error);
    sample->detailed = sample->torque;
    sample->reduced = at.reduced.path_drag[draw->path];
    return GM_OK;
}
