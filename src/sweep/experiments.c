/* SPDX-License-Identifier: BSD-2-Clause */
#include "sweep/experiments.h"

#include <math.h>

/* How far from a line, relative to the speed there, a point is put that belongs to one
   side of it: above rounding, far below what friction notices. */
#define LINE_DISTANCE 1e-11

typedef struct row {
    const gm_sweep_plan *plan;
    const gm_job *job;
    const gm_map_table *table;
    gm_steady_solver *solver;
    gm_error *error;
    gm_steady_point point;
    gm_steady_result result;
} row;

static gm_status solve(row *r)
{
    return gm_steady_solve(r->solver, &r->point, &r->result, r->error);
}

static double sign_of(int direction)
{
    return direction == GM_BACKWARD ? -1.0 : 1.0;
}

static double sgn(double x)
{
    return (double)(x > 0) - (double)(x < 0);
}

static void set_flange(row *r, int flange, double speed, double direction)
{
    r->point.speed[flange] = speed;
    r->point.direction[flange] = direction;
}

static double coupling(const gm_sweep_plan *plan, double relative_speed)
{
    gm_cell1 cell = {0};
    if (!plan->coupling.value)
        return 0.0;
    return gm_table1_at(&plan->coupling, 1, &cell, relative_speed).value;
}

static double *row_values(const gm_map *map, int table, int index)
{
    const gm_map_table *t = &map->tables[table];
    return t->value + (long)index * gm_map_row_size(t);
}

static gm_status coupling_row(row *r)
{
    double delta = r->table->x[0][r->job->row], torque[2] = {0.0, 0.0};
    set_flange(r, 0, 0.0, 1.0);
    set_flange(r, 1, 0.0, 1.0);
    for (int side = 0; side < 2 && delta != 0.0; side++) {
        double speed = side ? delta : -delta;
        set_flange(r, 2, speed, sgn(speed));
        gm_status status = solve(r);
        if (status != GM_OK)
            return status;
        torque[side] = r->result.torque[1];
    }
    *row_values(r->plan->map, r->job->table, r->job->row) = 0.5 * (torque[0] - torque[1]);
    return GM_OK;
}

/* The output speed of a node of a line. Past the first node at which the line has left
   the range of the path the jump only has to continue: it stays. */
static double line_speed(const row *r, double ratio)
{
    double leaves = r->plan->map->speed_max / fabs(ratio);
    int node = 0;
    while (node < r->job->row && r->table->x[0][node] < leaves)
        node++;
    return r->table->x[0][node];
}

/* At the line the output's direction counts for nothing, unless it stands still: then the
   flanges start along the line. */
static gm_status line_row(row *r)
{
    const gm_map *map = r->plan->map;
    int p = r->table->key.path;
    double ratio = r->table->key.line;
    double sigma = sign_of(r->table->key.direction[0]);
    double w = sigma * line_speed(r, ratio);
    double drag[2];
    for (int side = 0; side < 2; side++) {
        double past = side ? 1.0 : -1.0;
        double along = w == 0.0 ? sigma : 0.0;
        set_flange(r, 0, w, along);
        set_flange(r, 1 + p, ratio * w + past * LINE_DISTANCE * fabs(ratio * w),
                   along * ratio + past * 1e-3 * fabs(ratio));
        gm_status status = solve(r);
        if (status != GM_OK)
            return status;
        drag[side] = r->result.torque[1 + p];
    }
    *row_values(map, r->job->table, r->job->row) = fmax(0.0, drag[1] - drag[0]);
    return GM_OK;
}

static gm_status reference_row(row *r)
{
    double sigma = sign_of(r->job->table);
    set_flange(r, 0, sigma * r->plan->reference_speed[r->job->row], sigma);
    gm_status status = solve(r);
    if (status == GM_OK)
        r->plan->reference[r->job->table][r->job->row] = r->result.torque[0];
    return status;
}

static void set_gears(row *r)
{
    for (int p = 0; p < r->plan->map->n_paths; p++)
        r->point.gear[p] = r->table->key.gear[p];
}

static gm_status parasitic_row(row *r)
{
    double sigma = sign_of(r->table->key.direction[0]);
    set_gears(r);
    set_flange(r, 0, sigma * r->table->x[0][r->job->row], sigma);
    gm_status status = solve(r);
    if (status == GM_OK)
        *row_values(r->plan->map, r->job->table, r->job->row) =
            sigma * r->result.torque[0];
    return status;
}

/* The path must turn as the kinematics say that gave its ratio. */
static gm_status check_speed(const row *r, int p, double w_p)
{
    double found = r->result.speed[1 + p];
    if (fabs(found - w_p) <= 1e-9 * r->plan->map->speed_max)
        return GM_OK;
    return gm_fail(r->error, GM_ERR_MODEL,
                   "path '%s', gear %d: at %g rad/s of the output the path turns at %g "
                   "rad/s, by its ratio it should at %g rad/s",
                   r->plan->map->paths[p].name, r->point.gear[p], r->point.speed[0],
                   found, w_p);
}

/* First T_o over the torques, then what of it belongs to zero torque becomes P and the
   rest D. */
static gm_status load_row(row *r)
{
    const gm_map_table *table = r->table;
    int p = table->key.path, n = table->n[1], zero = n / 2;
    double ratio = gm_sweep_ratio(r->plan->map, p, table->key.gear[p]);
    double sigma_p = sign_of(table->key.direction[0]), sigma = sgn(ratio) * sigma_p;
    double w_p = sigma_p * table->x[0][r->job->row];
    double from_neutral = coupling(r->plan, -w_p);
    double *value = row_values(r->plan->map, r->job->table, r->job->row);
    r->point.gear[p] = table->key.gear[p];
    set_flange(r, 0, w_p / ratio, sigma);
    for (int j = 0; j < n; j++) {
        r->point.torque[1 + p] = sigma_p * table->x[1][j] - from_neutral;
        gm_status status = solve(r);
        if (status == GM_OK)
            status = check_speed(r, p, w_p);
        if (status != GM_OK)
            return status;
        value[j] = sigma * (r->result.torque[0] + ratio * sigma_p * table->x[1][j]);
    }
    double parasitic = value[zero];
    for (int j = 0; j < n; j++)
        value[j] = (value[j] - parasitic) / fabs(ratio);
    if (r->job->companion >= 0)
        *row_values(r->plan->map, r->job->companion, r->job->row) = parasitic;
    return GM_OK;
}

/* The jumps' share of N (and by -ratio of R) at the present point. */
typedef struct steps {
    double drag, reaction;
} steps;

static steps steps_at(const row *r, int p, int output_direction, int output_node)
{
    const gm_sweep_plan *plan = r->plan;
    double sigma = sign_of(output_direction);
    int at_rest = r->point.speed[0] == 0.0 && r->point.speed[1 + p] == 0.0;
    const double *w = at_rest ? r->point.direction : r->point.speed;
    steps sum = {0.0, 0.0};
    for (int i = 0; i < plan->n_lines[p]; i++) {
        double ratio = plan->line[p][i];
        gm_table_key key = gm_sweep_line_key(p, ratio, output_direction);
        double half = 0.5 * gm_map_find(plan->map, &key)->value[output_node];
        double side = sgn(w[1 + p] - ratio * w[0]);
        sum.drag += half * side;
        sum.reaction -= ratio * half * (side - sgn(-ratio * sigma));
    }
    return sum;
}

/* A node that happens to lie on a line is taken just above it. */
static void leave_lines(row *r, int p)
{
    for (int i = 0; i < r->plan->n_lines[p]; i++) {
        double on = r->plan->line[p][i] * r->point.speed[0];
        double distance = LINE_DISTANCE * fabs(on);
        if (r->point.speed[1 + p] != 0.0 && fabs(r->point.speed[1 + p] - on) < distance)
            r->point.speed[1 + p] = on + distance;
    }
}

static gm_status drag_row(row *r)
{
    const gm_map_table *table = r->table;
    int p = table->key.path, direction = table->key.direction[1];
    double sigma_n = sign_of(table->key.direction[0]), sigma_o = sign_of(direction);
    double w_n = sigma_n * table->x[0][r->job->row];
    double *drag = row_values(r->plan->map, r->job->table, r->job->row);
    double *reaction = row_values(r->plan->map, r->job->companion, r->job->row);
    for (int j = 0; j < table->n[1]; j++) {
        set_flange(r, 0, sigma_o * table->x[1][j], sigma_o);
        set_flange(r, 1 + p, w_n, sigma_n);
        leave_lines(r, p);
        gm_status status = solve(r);
        if (status != GM_OK)
            return status;
        steps step = steps_at(r, p, direction, j);
        double total = r->result.torque[0] - r->plan->reference[direction][j];
        drag[j] = r->result.torque[1 + p] - coupling(r->plan, w_n) - step.drag;
        reaction[j] = w_n == 0.0 ? 0.0 : total - step.reaction;
    }
    return GM_OK;
}

/* |r_p| D_p as the reduced gearset will interpolate it, so that P + D + X is exact at the
   nodes of X. */
static double load_loss(const row *r, int p, double w_o, double torque)
{
    const gm_map *map = r->plan->map;
    double ratio = gm_sweep_ratio(map, p, r->table->key.gear[p]);
    int backward = ratio * sign_of(r->table->key.direction[0]) < 0;
    gm_table_key key = gm_sweep_load_key(p, r->table->key.gear[p], backward);
    const gm_map_table *d = gm_map_find(map, &key);
    gm_table2 view = {{d->n[0], d->x[0]}, {d->n[1], d->x[1]}, d->value, 0};
    gm_cell2 cell = {0};
    return fabs(ratio) * gm_table2_at(&view, 1, &cell, fabs(ratio) * w_o, torque).value;
}

static gm_status both_row(row *r)
{
    const gm_map_table *table = r->table;
    const gm_map *map = r->plan->map;
    double sigma = sign_of(table->key.direction[0]), w_o = table->x[0][r->job->row];
    double ratio[2], *value = row_values(map, r->job->table, r->job->row);
    for (int p = 0; p < 2; p++)
        ratio[p] = gm_sweep_ratio(map, p, table->key.gear[p]);
    set_gears(r);
    set_flange(r, 0, sigma * w_o, sigma);
    int n_0 = table->n[1], n_1 = table->n[2];
    for (int k = 0; k < n_0 * n_1; k++) {
        double torque[2] = {table->x[1][k / n_1], table->x[2][k % n_1]};
        double sum = 0.0;
        for (int p = 0; p < 2; p++) {
            r->point.torque[1 + p] = sgn(ratio[p]) * sigma * torque[p];
            sum += ratio[p] * r->point.torque[1 + p];
        }
        gm_status status = solve(r);
        if (status != GM_OK)
            return status;
        value[k] = sigma * (r->result.torque[0] + sum) - load_loss(r, 0, w_o, torque[0]) -
                   load_loss(r, 1, w_o, torque[1]);
    }
    double parasitic = value[(n_0 / 2) * n_1 + n_1 / 2];
    for (int k = 0; k < n_0 * n_1; k++)
        value[k] -= parasitic;
    return GM_OK;
}

gm_status gm_experiment_row(const gm_sweep_plan *plan, const gm_job *job,
                            gm_steady_solver *solver, gm_error *error)
{
    static gm_status (*const experiment[GM_JOB_KINDS])(row *) = {
        [GM_JOB_COUPLING] = coupling_row,   [GM_JOB_LINE] = line_row,
        [GM_JOB_REFERENCE] = reference_row, [GM_JOB_PARASITIC] = parasitic_row,
        [GM_JOB_LOAD] = load_row,           [GM_JOB_DRAG] = drag_row,
        [GM_JOB_BOTH] = both_row,
    };
    row r = {.plan = plan, .job = job, .solver = solver, .error = error};
    for (int p = 0; p < plan->map->n_paths; p++)
        r.point.gear[p] = gm_sweep_rest_gear(plan->plant, p);
    if (job->kind != GM_JOB_REFERENCE)
        r.table = &plan->map->tables[job->table];
    gm_steady_solver_restart(solver);
    return experiment[job->kind](&r);
}
