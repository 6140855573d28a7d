/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/experiments.h"

#include <math.h>
#include <string.h>

/* How far from a line, relative to the speed there, a point is put that belongs to one
   side of it: above rounding, far below what friction notices. */
#define LINE_DISTANCE 1e-11

/* One place of a table: what is known there, and the point that is solved for it. */
typedef struct place {
    const gm_sweep_plan *plan;
    const gm_map_table *table;
    const double *x;
    gm_point_solver *solver;
    gm_error *error;
    int oil;         /* slice */
    double line_end; /* output speed at which a line has left the range of its path */
    gm_steady_point point;
    gm_steady_result result;
} place;

static gm_status solve(place *p)
{
    return gm_point_solve(p->solver, &p->point, &p->result, p->error);
}

static double sign_of(int direction)
{
    return direction == GM_BACKWARD ? -1.0 : 1.0;
}

static double sgn(double x)
{
    return (double)(x > 0) - (double)(x < 0);
}

static void set_flange(place *p, int flange, double speed, double direction)
{
    p->point.speed[flange] = speed;
    p->point.direction[flange] = direction;
}

static void set_gears(place *p)
{
    for (int q = 0; q < p->plan->map->n_paths; q++)
        p->point.gear[q] = p->table->key.gear[q];
}

/* ---- tables of earlier phases, as the reduced gearset will read them ---- */

static const double *slice_of(const place *p, const gm_map_table *t)
{
    return t->value + (long)p->oil * gm_map_table_size(t);
}

static double read1(const place *p, const gm_map_table *t, double x)
{
    gm_table1 view = {{t->n[0], t->x[0]}, slice_of(p, t), p->plan->monotone};
    gm_cell1 cell = {0};
    return gm_table1_at(&view, 1, &cell, x).value;
}

static double coupling(const place *p, double relative_speed)
{
    gm_table_key key = gm_table_key_of(GM_COUPLING);
    const gm_map_table *table = gm_map_find(p->plan->map, &key);
    return table ? read1(p, table, relative_speed) : 0.0;
}

/* |r_q| D_q, so that P + D + X is exact at the nodes of X. */
static double load_loss(const place *p, int q, double w_o, double torque)
{
    double ratio = gm_sweep_ratio(p->plan->map, q, p->table->key.gear[q]);
    int backward = ratio * sign_of(p->table->key.direction[0]) < 0;
    gm_table_key key = gm_sweep_load_key(q, p->table->key.gear[q], backward);
    const gm_map_table *d = gm_map_find(p->plan->map, &key);
    gm_table2 view = {
        {d->n[0], d->x[0]}, {d->n[1], d->x[1]}, slice_of(p, d), p->plan->monotone};
    gm_cell2 cell = {0};
    return fabs(ratio) * gm_table2_at(&view, 1, &cell, fabs(ratio) * w_o, torque).value;
}

/* ---- the experiments ---- */

static gm_status coupling_at(place *p, gm_sample *found)
{
    double delta = p->x[0], torque[2] = {0.0, 0.0};
    set_flange(p, 0, 0.0, 1.0);
    set_flange(p, 1, 0.0, 1.0);
    for (int side = 0; side < 2 && delta != 0.0; side++) {
        double speed = side ? delta : -delta;
        set_flange(p, 2, speed, sgn(speed));
        gm_status status = solve(p);
        if (status != GM_OK)
            return status;
        torque[side] = p->result.torque[1];
    }
    found->value[0] = 0.5 * (torque[0] - torque[1]);
    found->size[0] = fmax(fabs(torque[0]), fabs(torque[1]));
    return GM_OK;
}

/* At the line the output's direction counts for nothing, unless it stands still: then the
   flanges start along the line. Past the end of the line the jump only has to continue:
   it stays. */
static gm_status line_at(place *p, gm_sample *found)
{
    int path = p->table->key.path;
    double ratio = p->table->key.line;
    double sigma = sign_of(p->table->key.direction[0]);
    double w = sigma * fmin(p->x[0], p->line_end);
    double drag[2];
    for (int side = 0; side < 2; side++) {
        double past = side ? 1.0 : -1.0;
        double along = w == 0.0 ? sigma : 0.0;
        set_flange(p, 0, w, along);
        set_flange(p, 1 + path, ratio * w + past * LINE_DISTANCE * fabs(ratio * w),
                   along * ratio + past * 1e-3 * fabs(ratio));
        gm_status status = solve(p);
        if (status != GM_OK)
            return status;
        drag[side] = p->result.torque[1 + path];
    }
    double jump = drag[1] - drag[0];
    found->value[0] = jump < 0.0 ? 0.0 : jump;
    found->size[0] = fmax(fabs(drag[0]), fabs(drag[1]));
    return GM_OK;
}

static gm_status parasitic_at(place *p, gm_sample *found)
{
    double sigma = sign_of(p->table->key.direction[0]);
    set_gears(p);
    set_flange(p, 0, sigma * p->x[0], sigma);
    gm_status status = solve(p);
    if (status == GM_OK) {
        found->value[0] = sigma * p->result.torque[0];
        found->size[0] = fabs(found->value[0]);
    }
    return status;
}

/* The path must turn as the kinematics say that gave its ratio. */
static gm_status check_speed(const place *p, int path, double w_p)
{
    double found = p->result.speed[1 + path];
    if (isnan(found) || fabs(found - w_p) <= 1e-9 * p->plan->map->speed_max)
        return GM_OK; /* not a number: the point was skipped */
    return gm_fail(p->error, GM_ERR_MODEL,
                   "path '%s', gear %d: at %g rad/s of the output the path turns at %g "
                   "rad/s, by its ratio it should at %g rad/s",
                   p->plan->map->paths[path].name, p->point.gear[path], p->point.speed[0],
                   found, w_p);
}

/* P + |r_p| D_p at a torque of the path. */
static gm_status loss_at(place *p, double torque, double *loss)
{
    int path = p->table->key.path;
    double ratio = gm_sweep_ratio(p->plan->map, path, p->table->key.gear[path]);
    double sigma_p = sign_of(p->table->key.direction[0]), sigma = sgn(ratio) * sigma_p;
    double w_p = sigma_p * p->x[0];
    p->point.gear[path] = p->table->key.gear[path];
    p->point.torque[1 + path] = sigma_p * torque - coupling(p, -w_p);
    set_flange(p, 0, w_p / ratio, sigma);
    gm_status status = solve(p);
    if (status == GM_OK)
        status = check_speed(p, path, w_p);
    if (status == GM_OK)
        *loss = sigma * (p->result.torque[0] + ratio * sigma_p * torque);
    return status;
}

/* What of the loss belongs to zero torque is P, the rest D. */
static gm_status load_at(place *p, gm_sample *found)
{
    int path = p->table->key.path;
    double ratio = gm_sweep_ratio(p->plan->map, path, p->table->key.gear[path]);
    double loss = 0.0, parasitic = 0.0;
    gm_status status = loss_at(p, p->x[1], &loss);
    if (status == GM_OK)
        status = loss_at(p, 0.0, &parasitic);
    found->value[0] = loss / fabs(ratio);
    found->value[1] = (loss - parasitic) / fabs(ratio);
    found->size[0] = found->size[1] = fabs(found->value[0]);
    return status;
}

/* The jumps' share of N (and by -ratio of R) at the present point. */
typedef struct steps {
    double drag, reaction;
} steps;

static steps steps_at(const place *p, int path, int output_direction)
{
    const gm_sweep_plan *plan = p->plan;
    double sigma = sign_of(output_direction);
    int at_rest = p->point.speed[0] == 0.0 && p->point.speed[1 + path] == 0.0;
    const double *w = at_rest ? p->point.direction : p->point.speed;
    steps sum = {0.0, 0.0};
    for (int i = 0; i < plan->n_lines[path]; i++) {
        double ratio = plan->line[path][i];
        gm_table_key key = gm_sweep_line_key(path, ratio, output_direction);
        double half = 0.5 * read1(p, gm_map_find(plan->map, &key), p->x[1]);
        double side = sgn(w[1 + path] - ratio * w[0]);
        sum.drag += half * side;
        sum.reaction -= ratio * half * (side - sgn(-ratio * sigma));
    }
    return sum;
}

/* A point that happens to lie on a line is taken just above it. */
static void leave_lines(place *p, int path)
{
    for (int i = 0; i < p->plan->n_lines[path]; i++) {
        double on = p->plan->line[path][i] * p->point.speed[0];
        double distance = LINE_DISTANCE * fabs(on);
        if (p->point.speed[1 + path] != 0.0 &&
            fabs(p->point.speed[1 + path] - on) < distance)
            p->point.speed[1 + path] = on + distance;
    }
}

/* Torque of the output with the path at rest. */
static gm_status reference_at(place *p, int path, double *torque)
{
    double speed = p->point.speed[1 + path], direction = p->point.direction[1 + path];
    set_flange(p, 1 + path, 0.0, 0.0);
    gm_status status = solve(p);
    *torque = p->result.torque[0];
    set_flange(p, 1 + path, speed, direction);
    return status;
}

static gm_status drag_at(place *p, gm_sample *found)
{
    int path = p->table->key.path, direction = p->table->key.direction[1];
    double sigma_n = sign_of(p->table->key.direction[0]), sigma_o = sign_of(direction);
    double w_n = sigma_n * p->x[0], reference = 0.0;
    set_flange(p, 0, sigma_o * p->x[1], sigma_o);
    set_flange(p, 1 + path, w_n, sigma_n);
    leave_lines(p, path);
    gm_status status = reference_at(p, path, &reference);
    if (status == GM_OK)
        status = solve(p);
    if (status != GM_OK)
        return status;
    steps step = steps_at(p, path, direction);
    double total = p->result.torque[0] - reference;
    found->value[0] = p->result.torque[1 + path] - coupling(p, w_n) - step.drag;
    found->value[1] = w_n == 0.0 ? 0.0 : total - step.reaction;
    found->size[0] = fabs(p->result.torque[1 + path]);
    found->size[1] = fabs(total);
    return GM_OK;
}

/* sigma (T_o + sum r_q tau_q): the loss at the output with both paths under load. */
static gm_status both_loss(place *p, const double *torque, double *loss)
{
    double sigma = sign_of(p->table->key.direction[0]), sum = 0.0;
    for (int q = 0; q < 2; q++) {
        double ratio = gm_sweep_ratio(p->plan->map, q, p->table->key.gear[q]);
        p->point.torque[1 + q] = sgn(ratio) * sigma * torque[q];
        sum += ratio * p->point.torque[1 + q];
    }
    gm_status status = solve(p);
    *loss = sigma * (p->result.torque[0] + sum);
    return status;
}

static gm_status both_at(place *p, gm_sample *found)
{
    const double none[2] = {0.0, 0.0};
    double sigma = sign_of(p->table->key.direction[0]), w_o = p->x[0];
    double loss = 0.0, parasitic = 0.0;
    set_gears(p);
    set_flange(p, 0, sigma * w_o, sigma);
    gm_status status = both_loss(p, none, &parasitic);
    if (status == GM_OK)
        status = both_loss(p, &p->x[1], &loss);
    double both = loss - load_loss(p, 0, w_o, p->x[1]) - load_loss(p, 1, w_o, p->x[2]);
    found->value[0] = both - parasitic;
    found->size[0] = fabs(loss);
    return status;
}

/* ---- samples and rows ---- */

static place place_of(const gm_sweep_plan *plan, const gm_unit *unit,
                      gm_point_solver *solver, gm_error *error)
{
    place p = {.plan = plan,
               .table = &plan->map->tables[unit->table],
               .solver = solver,
               .error = error,
               .line_end = HUGE_VAL};
    if (unit->kind == GM_UNIT_LINE)
        p.line_end = plan->map->speed_max / fabs(p.table->key.line);
    return p;
}

static gm_status sample_at(place *p, const gm_unit *unit, gm_sample *sample)
{
    static gm_status (*const experiment[GM_UNIT_KINDS])(place *, gm_sample *) = {
        [GM_UNIT_COUPLING] = coupling_at,   [GM_UNIT_LINE] = line_at,
        [GM_UNIT_PARASITIC] = parasitic_at, [GM_UNIT_LOAD] = load_at,
        [GM_UNIT_DRAG] = drag_at,           [GM_UNIT_BOTH] = both_at,
    };
    p->point = (gm_steady_point){{0}, {0.0}, {0.0}, {0.0}};
    for (int q = 0; q < p->plan->map->n_paths; q++)
        p->point.gear[q] = gm_sweep_rest_gear(p->plan->plant, q);
    return experiment[unit->kind](p, sample);
}

gm_status gm_experiment_at(const gm_sweep_plan *plan, const gm_unit *unit,
                           const double *x, gm_point_solver *solver, gm_sample *sample,
                           gm_error *error)
{
    const int n = gm_unit_values(unit);
    place p = place_of(plan, unit, solver, error);
    gm_status status = GM_OK;
    p.x = x;
    for (p.oil = 0; p.oil < p.table->slices && status == GM_OK; p.oil++) {
        gm_sample found = {{0.0}, {0.0}};
        gm_point_solver_choose(solver, p.oil);
        status = sample_at(&p, unit, &found);
        memcpy(&sample->value[p.oil * n], found.value, (size_t)n * sizeof(double));
        memcpy(&sample->size[p.oil * n], found.size, (size_t)n * sizeof(double));
    }
    return status;
}

/* The jump of a line is measured up to the first node at which it has left the range. */
static void extend_line(place *p)
{
    int node = 0;
    while (node + 1 < p->table->n[0] && p->table->x[0][node] < p->line_end)
        node++;
    p->line_end = p->table->x[0][node];
}

/* Place of a node in the slice that is measured. */
static double *value_at(const place *p, int table, int row, int column)
{
    gm_map_table *t = &p->plan->map->tables[table];
    return &t->value[(long)p->oil * gm_map_table_size(t) + row * gm_map_row_size(t) +
                     column];
}

static void put(const place *p, const gm_unit *unit, int row, int column,
                const gm_sample *sample)
{
    const gm_table_key *key = &p->table->key;
    *value_at(p, unit->table, row, column) = sample->value[unit->kind == GM_UNIT_LOAD];
    if (unit->companion < 0)
        return;
    if (unit->kind == GM_UNIT_DRAG)
        *value_at(p, unit->companion, row, column) = sample->value[1];
    else if (p->x[1] == 0.0)
        *value_at(p, unit->companion, row, 0) =
            sample->value[0] *
            fabs(gm_sweep_ratio(p->plan->map, key->path, key->gear[key->path]));
}

static gm_status fill_row(place *p, const gm_unit *unit, int row)
{
    const gm_map_table *t = p->table;
    double x[GM_MAX_AXES] = {t->x[0][row], 0.0, 0.0};
    gm_status status = GM_OK;
    p->x = x;
    gm_point_solver_choose(p->solver, p->oil);
    for (int i = 0; i < gm_map_row_size(t) && status == GM_OK; i++) {
        gm_sample sample = {{0.0}, {0.0}};
        x[1] = t->n_axes > 1 ? t->x[1][i / t->n[2]] : 0.0;
        x[2] = t->n_axes > 2 ? t->x[2][i % t->n[2]] : 0.0;
        status = sample_at(p, unit, &sample);
        if (status == GM_OK)
            put(p, unit, row, i, &sample);
    }
    return status;
}

gm_status gm_experiment_row(const gm_sweep_plan *plan, const gm_unit *unit, int row,
                            gm_point_solver *solver, gm_error *error)
{
    place p = place_of(plan, unit, solver, error);
    gm_status status = GM_OK;
    if (unit->kind == GM_UNIT_LINE)
        extend_line(&p);
    for (p.oil = 0; p.oil < p.table->slices && status == GM_OK; p.oil++)
        status = fill_row(&p, unit, row);
    return status;
}
