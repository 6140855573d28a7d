/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The steady experiment. The plant's own passes (friction from the last forces, then
 * forces from the leaves to the root) bring the start near the solution and KINSOL
 * finishes; what the passes already solved, KINSOL only confirms. The two fail in
 * different places: passes diverge under strong coupling, where Newton does not care;
 * Newton's line search can stall between the two sides of a kink (a mesh without load),
 * where the passes contract as ever. So what KINSOL leaves unsolved goes to the passes
 * again.
 */
#include "solve/gm_steady_solver.h"

#include "base/alloc.h"
#include "solve/sun_newton.h"

#include <math.h>
#include <string.h>

/* Passes gain about two digits each on a layshaft gearset; two after the last solution of
 * a grid line leave KINSOL one or two quadratic iterations. What KINSOL leaves unsolved
 * gets 200 passes, in part steps of 1, 1/2, 1/4, 1/8: friction that rises steeply from
 * zero load makes full steps go to and fro. */
enum {
    PASSES_COLD = 6,
    PASSES_WARM = 2,
    PASSES_POLISH = 8,
    PASSES_LAST = 200,
    HALVINGS = 3
};

static const double relative_tolerance = 1e-12;

/* N.m: 1e-14 N.m is the rounding of the largest balances. */
static const double smallest_torque = 1e-2;

/* Residual over tolerance that still counts as solved, when neither Newton nor the passes
 * improve on it. */
static const double accepted = 10.0;

struct gm_steady_solver {
    const gm_plant *plant;
    void *work;
    gm_sun_newton *newton;
    int n;
    int gear[GM_MAX_INPUT_PATHS];
    int configured, warm;
    gm_steady_point point;
    double *x, *f, *kept;
};

/* ---- the plant as a nonlinear system ---- */

static int system_size(void *user)
{
    gm_steady_solver *s = user;
    return s->plant->is->size(s->work);
}

static int system_entries(void *user)
{
    gm_steady_solver *s = user;
    return s->plant->is->entries(s->work);
}

static void system_residual(void *user, const double *x, double *f)
{
    gm_steady_solver *s = user;
    s->plant->is->residual(s->work, x, f);
}

static void system_pattern(void *user, int *column_start, int *row)
{
    gm_steady_solver *s = user;
    s->plant->is->pattern(s->work, column_start, row);
}

static void system_jacobian(void *user, const double *x, double *value)
{
    gm_steady_solver *s = user;
    s->plant->is->jacobian(s->work, x, value);
}

/* ---- life ---- */

static gm_status make_newton(gm_steady_solver *s, gm_error *error)
{
    gm_sun_system system = {.n_max = s->n,
                            .user = s,
                            .size = system_size,
                            .entries = system_entries,
                            .residual = system_residual,
                            .pattern = system_pattern,
                            .jacobian = system_jacobian};
    gm_sun_newton_destroy(s->newton);
    s->newton = gm_sun_newton_create(&system);
    gm_free(s->x);
    gm_free(s->f);
    gm_free(s->kept);
    s->x = gm_calloc((size_t)s->n, sizeof *s->x);
    s->f = gm_calloc((size_t)s->n, sizeof *s->f);
    s->kept = gm_calloc((size_t)s->n, sizeof *s->kept);
    if (!s->newton || !s->x || !s->f || !s->kept)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    return GM_OK;
}

gm_status gm_steady_solver_create(const gm_plant *plant, gm_steady_solver **solver,
                                  gm_error *error)
{
    gm_steady_solver *s = gm_calloc(1, sizeof *s);
    if (!s)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    s->plant = plant;
    gm_status status = plant->is->work_create(plant->self, &s->work, error);
    if (status != GM_OK) {
        gm_free(s);
        return status;
    }
    *solver = s;
    return GM_OK;
}

void gm_steady_solver_destroy(gm_steady_solver *solver)
{
    if (!solver)
        return;
    gm_sun_newton_destroy(solver->newton);
    solver->plant->is->work_destroy(solver->work);
    gm_free(solver->x);
    gm_free(solver->f);
    gm_free(solver->kept);
    gm_free(solver);
}

const gm_plant *gm_steady_solver_plant(const gm_steady_solver *solver)
{
    return solver->plant;
}

void gm_steady_solver_restart(gm_steady_solver *solver)
{
    solver->warm = 0;
    if (solver->plant->is->restart)
        solver->plant->is->restart(solver->work);
}

void *gm_steady_solver_work(gm_steady_solver *solver, const double **x)
{
    *x = solver->x;
    return solver->work;
}

/* ---- one point ---- */

static int same_gears(const gm_steady_solver *s, const gm_steady_point *point)
{
    for (int p = 0; p < s->plant->info.n_paths; p++)
        if (s->gear[p] != point->gear[p])
            return 0;
    return s->configured;
}

static gm_status configure(gm_steady_solver *s, const gm_steady_point *point,
                           gm_error *error)
{
    if (same_gears(s, point))
        return GM_OK;
    int n = s->plant->is->size(s->work);
    s->configured = s->warm = 0;
    if (n != s->n || !s->newton) {
        s->n = n;
        gm_status status = make_newton(s, error);
        if (status != GM_OK) {
            s->n = 0;
            return status;
        }
    }
    if (gm_sun_newton_pattern_changed(s->newton))
        return gm_fail(error, GM_ERR_MEMORY, "out of memory for the solver: %s",
                       gm_sun_newton_message(s->newton));
    memcpy(s->gear, point->gear, sizeof s->gear);
    s->configured = 1;
    return GM_OK;
}

static double largest_torque(const gm_steady_solver *s)
{
    gm_steady_result result;
    double largest = smallest_torque;
    s->plant->is->result(s->work, s->x, &result);
    for (int flange = 0; flange <= s->plant->info.n_paths; flange++)
        largest = fmax(largest, fabs(result.torque[flange]));
    return largest;
}

static double residual_norm(gm_steady_solver *s)
{
    double norm = 0.0;
    s->plant->is->residual(s->work, s->x, s->f);
    for (int i = 0; i < s->n; i++)
        norm = isfinite(s->f[i]) ? fmax(norm, fabs(s->f[i])) : HUGE_VAL;
    return norm;
}

/* Passes of which only the given part is gone. True when the last full pass would have
 * changed nothing beyond the tolerance. */
static int run_passes(gm_steady_solver *s, int passes, double part)
{
    for (int i = 0; i < passes; i++) {
        memcpy(s->f, s->x, (size_t)s->n * sizeof *s->f);
        if (s->plant->is->pass(s->work, s->x) < relative_tolerance)
            return 1;
        for (int k = 0; k < s->n; k++)
            s->x[k] = s->f[k] + part * (s->x[k] - s->f[k]);
    }
    return 0;
}

static int is_solved(gm_steady_solver *s, double tolerance)
{
    return residual_norm(s) <= accepted * tolerance;
}

static void start_at_zero(gm_steady_solver *s)
{
    memset(s->x, 0, (size_t)s->n * sizeof *s->x);
}

/* A few passes where KINSOL stopped short, if they help. */
static void polish(gm_steady_solver *s, double tolerance)
{
    double before = residual_norm(s);
    if (before <= tolerance)
        return;
    memcpy(s->kept, s->x, (size_t)s->n * sizeof *s->x);
    (void)run_passes(s, PASSES_POLISH, 1.0);
    if (!(residual_norm(s) < before))
        memcpy(s->x, s->kept, (size_t)s->n * sizeof *s->x);
}

static int solve_from(gm_steady_solver *s, int passes)
{
    (void)run_passes(s, passes, 1.0);
    if (!(residual_norm(s) < HUGE_VAL)) {
        start_at_zero(s);
        (void)run_passes(s, 1, 1.0);
    }
    double tolerance = relative_tolerance * largest_torque(s);
    (void)gm_sun_newton_solve(s->newton, tolerance, s->x);
    polish(s, tolerance);
    return is_solved(s, tolerance);
}

/* The torque scale is that of the solution, so it is taken after the passes. */
static int solve_by_passes(gm_steady_solver *s)
{
    double part = 1.0;
    start_at_zero(s);
    for (int i = 0; i <= HALVINGS && !run_passes(s, PASSES_LAST, part); i++)
        part *= 0.5;
    return is_solved(s, relative_tolerance * largest_torque(s));
}

static gm_status no_convergence(const gm_steady_solver *s, gm_error *error)
{
    const gm_steady_point *p = &s->point;
    return gm_fail(error, GM_ERR_SOLVE,
                   "%s: no steady state found for gears (%d, %d), output speed %g rad/s, "
                   "input speeds (%g, %g) rad/s, input torques (%g, %g) N.m%s%s",
                   s->plant->info.name, p->gear[0], p->gear[1], p->speed[0], p->speed[1],
                   p->speed[2], p->torque[1], p->torque[2],
                   gm_sun_newton_message(s->newton)[0] ? "; " : "",
                   gm_sun_newton_message(s->newton));
}

gm_status gm_steady_solve(gm_steady_solver *solver, const gm_steady_point *point,
                          gm_steady_result *result, gm_error *error)
{
    gm_steady_solver *s = solver;
    s->point = *point;
    if (s->plant->is->measure)
        return s->plant->is->measure(s->work, point, result, error);
    gm_status status = s->plant->is->set_point(s->work, point, error);
    if (status == GM_OK)
        status = configure(s, point, error);
    if (status != GM_OK)
        return status;
    int solved = s->warm && solve_from(s, PASSES_WARM);
    if (!solved) {
        start_at_zero(s);
        solved = solve_from(s, PASSES_COLD) || solve_by_passes(s);
    }
    s->warm = solved;
    if (!solved)
        return no_convergence(s, error);
    memset(result, 0, sizeof *result);
    s->plant->is->result(s->work, s->x, result);
    return GM_OK;
}
