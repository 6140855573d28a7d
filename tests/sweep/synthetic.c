/* SPDX-License-Identifier: BSD-2-Clause */
#include "synthetic.h"

#include "base/alloc.h"

#include <math.h>
#include <time.h>

static const int numbers[2][3] = {{-1, 1, 3}, {2, 4, 6}};
static const double ratios[2][3] = {{-12.0, 14.0, 5.5}, {9.0, 4.0, 2.5}};

static double sgn(double x)
{
    return (double)(x > 0) - (double)(x < 0);
}

static int index_of(int p, int number)
{
    for (int g = 0; g < 3; g++)
        if (numbers[p][g] == number)
            return g;
    return -1;
}

double synthetic_ratio(int p, int number)
{
    int g = index_of(p, number);
    return g < 0 ? 0.0 : ratios[p][g];
}

double synthetic_inertia(int flange)
{
    static const double inertia[] = {0.25, 0.012, 0.010};
    return inertia[flange];
}

/* ---- closed forms: no two gears, directions or paths have the same ---- */

double synthetic_parasitic(const int *gear, int backward, double w)
{
    double kind = 1.0 + 0.1 * (index_of(0, gear[0]) + 1) +
                  0.03 * (index_of(1, gear[1]) + 1) + 0.2 * backward;
    return kind * (1.5 + 0.2 * sqrt(w) + 0.01 * w);
}

double synthetic_load(const synthetic *s, int p, int number, int backward, double w,
                      double torque)
{
    double share = 0.010 + 0.002 * index_of(p, number) + 0.001 * p + 0.0005 * backward;
    double law = 1.0 + 0.3 / (1.0 + 0.02 * w);
    double side = torque < 0 ? 0.8 : 1.0;
    return s->load_factor * share * law * side * fabs(torque);
}

double synthetic_both(const int *gear, int backward, double w, const double *torque)
{
    double kind = 1.0 + 0.2 * index_of(0, gear[0]) - 0.3 * index_of(1, gear[1]);
    return 1e-3 * kind * (1.0 + 0.1 * backward) * (1.0 + 0.01 * w) * torque[0] *
           torque[1];
}

double synthetic_coupling(double relative_speed)
{
    return 0.0004 * relative_speed; /* linear: P and D see it interpolated */
}

/* Its gears' and one more: an intermediate gear that turns on an output shaft. */
double synthetic_line(int p, int i)
{
    return i < 3 ? ratios[p][i] : p == 0 ? 3.1 : -2.7;
}

double synthetic_jump(int p, int i, int backward, double w)
{
    return (0.05 + 0.01 * i + 0.02 * p + 0.005 * backward) * (1.0 + 0.02 * w);
}

double synthetic_drag(int p, double w_n, double sign, double w_o)
{
    return sign * (0.2 + 0.1 * p) + 0.002 * w_n + 1e-5 * w_n * fabs(w_o) + 3e-4 * w_o;
}

double synthetic_reaction(int p, double w_n, double w_o)
{
    return -(0.003 + 0.001 * p) * w_n * (1.0 + 0.01 * fabs(w_o));
}

/* ---- the balance ---- */

typedef struct work {
    const synthetic *s;
    gm_steady_point point;
    gm_steady_result exact;
    int n, flange[GM_MAX_FLANGES]; /* unknown torques */
} work;

static int engaged(const work *w, int p)
{
    return w->point.gear[p] != GM_NEUTRAL;
}

/* Sign of flange p's speed against r times the output's, or of its limit. */
static double side_of(const work *w, int p, double ratio)
{
    const gm_steady_point *at = &w->point;
    double relative = at->speed[1 + p] - ratio * at->speed[0];
    double scale = fabs(at->speed[1 + p]) + fabs(ratio * at->speed[0]);
    if (fabs(relative) > 1e-13 * scale)
        return sgn(relative);
    return sgn(at->direction[1 + p] - ratio * at->direction[0]);
}

static double output_sign(const work *w)
{
    double speed = w->point.speed[0];
    return speed != 0.0 ? sgn(speed) : sgn(w->point.direction[0]);
}

/* Torques of path p in neutral: of its flange, and what the output feels. */
static void neutral_path(const work *w, int p, double *drag, double *reaction)
{
    double w_n = w->point.speed[1 + p], w_o = w->point.speed[0];
    int backward = output_sign(w) < 0;
    *drag = synthetic_drag(p, w_n, side_of(w, p, 0.0), w_o);
    *reaction = synthetic_reaction(p, w_n, w_o);
    for (int i = 0; i < SYNTHETIC_LINES; i++) {
        double ratio = synthetic_line(p, i);
        double half = 0.5 * synthetic_jump(p, i, backward, fabs(w_o));
        double side = side_of(w, p, ratio);
        *drag += half * side;
        *reaction -= ratio * half * (side - sgn(-ratio * output_sign(w)));
    }
}

static void speeds(work *w)
{
    for (int p = 0; p < w->s->plant.info.n_paths; p++)
        w->exact.speed[1 + p] =
            engaged(w, p) ? synthetic_ratio(p, w->point.gear[p]) * w->point.speed[0]
                          : w->point.speed[1 + p];
    w->exact.speed[0] = w->point.speed[0];
}

/* T_o and the torques of neutral paths, from the balance of core/gm_reduced.h. */
static void balance(work *w)
{
    const synthetic *s = w->s;
    int n_paths = s->plant.info.n_paths;
    double sigma = output_sign(w), w_o = w->point.speed[0], torque[2] = {0.0, 0.0};
    double loss = synthetic_parasitic(w->point.gear, sigma < 0, fabs(w_o)), sum = 0.0;
    for (int p = 0; p < n_paths; p++) {
        double ratio = synthetic_ratio(p, w->point.gear[p]);
        double relative = w->exact.speed[2 - p] - w->exact.speed[1 + p];
        double c =
            n_paths == 2 && s->plant.info.coupled ? synthetic_coupling(relative) : 0.0;
        if (!engaged(w, p)) {
            double reaction;
            neutral_path(w, p, &w->exact.torque[1 + p], &reaction);
            w->exact.torque[1 + p] -= c;
            sum += reaction;
            continue;
        }
        double sigma_p = sgn(ratio) * sigma;
        double from_neutral = n_paths == 2 && !engaged(w, 1 - p) ? c : 0.0;
        double transmitted = w->point.torque[1 + p] + from_neutral;
        torque[p] = sigma_p * transmitted;
        sum -= ratio * transmitted;
        loss += fabs(ratio) * synthetic_load(s, p, w->point.gear[p], sigma_p < 0,
                                             fabs(ratio * w_o), torque[p]);
        w->exact.torque[1 + p] = w->point.torque[1 + p];
    }
    if (n_paths == 2 && engaged(w, 0) && engaged(w, 1))
        loss += synthetic_both(w->point.gear, sigma < 0, fabs(w_o), torque);
    w->exact.torque[0] = sum + sigma * loss;
}

/* ---- as a nonlinear system with its solution at the balance ---- */

static gm_status work_create(const void *self, void **made, gm_error *error)
{
    work *w = gm_calloc(1, sizeof *w);
    if (!w)
        return gm_fail(error, GM_ERR_MEMORY, "no memory");
    w->s = self;
    *made = w;
    return GM_OK;
}

static void work_destroy(void *w)
{
    gm_free(w);
}

static gm_status set_point(void *self, const gm_steady_point *point, gm_error *error)
{
    work *w = self;
    (void)error;
    if (w->s->pause > 0)
        nanosleep(&(struct timespec){0, w->s->pause}, NULL);
    w->point = *point;
    w->n = 0;
    w->flange[w->n++] = 0;
    for (int p = 0; p < w->s->plant.info.n_paths; p++)
        if (!engaged(w, p))
            w->flange[w->n++] = 1 + p;
    speeds(w);
    balance(w);
    return GM_OK;
}

static int size(const void *self)
{
    return ((const work *)self)->n;
}

static double distance(const work *w, const double *x, int i)
{
    return x[i] - w->exact.torque[w->flange[i]];
}

static double pass(void *self, double *x)
{
    work *w = self;
    double change = 0.0, largest = 1e-30;
    for (int i = 0; i < w->n; i++) {
        double step = -0.9 * distance(w, x, i);
        x[i] += step;
        change = fmax(change, fabs(step));
        largest = fmax(largest, fabs(x[i]));
    }
    return change / largest;
}

static void residual(void *self, const double *x, double *f)
{
    work *w = self;
    double d = distance(w, x, 0);
    f[0] = d * (1.0 + 1e-4 * d * d);
    for (int i = 1; i < w->n; i++)
        f[i] = distance(w, x, i) + 0.05 * d;
    if (fabs(w->point.speed[0]) > w->s->unsolvable_above)
        f[0] = 1.0 + d * d;
}

static int entries(const void *self)
{
    return 2 * ((const work *)self)->n - 1;
}

static void pattern(const void *self, int *column_start, int *row)
{
    const work *w = self;
    column_start[0] = 0;
    for (int i = 0; i < w->n; i++)
        row[i] = i;
    for (int i = 1; i <= w->n; i++) {
        column_start[i] = w->n + i - 1;
        if (i < w->n)
            row[w->n + i - 1] = i;
    }
}

static void jacobian(void *self, const double *x, double *value)
{
    work *w = self;
    double d = distance(w, x, 0);
    value[0] = 1.0 + 3e-4 * d * d;
    for (int i = 1; i < w->n; i++) {
        value[i] = 0.05;
        value[w->n + i - 1] = 1.0;
    }
}

static void result(const void *self, const double *x, gm_steady_result *found)
{
    const work *w = self;
    *found = w->exact;
    for (int p = 0; p < w->s->plant.info.n_paths; p++)
        if (engaged(w, p))
            found->speed[1 + p] *= w->s->slip;
    for (int i = 0; i < w->n; i++)
        found->torque[w->flange[i]] = x[i];
}

gm_compliance synthetic_compliance(int p, int number)
{
    return (gm_compliance){1e4 + 1e3 * number, 1.0 + p, 2.0 + p, 1e-3 * (5 + number),
                           1e-4};
}

static gm_status kinematics(const void *self, const int *gear, gm_kinematics *k,
                            gm_error *error)
{
    const synthetic *s = self;
    (void)error;
    *k = (gm_kinematics){.inertia_output = synthetic_inertia(0),
                         .inertia_total = synthetic_inertia(0)};
    for (int p = 0; p < s->plant.info.n_paths; p++) {
        k->ratio[p] = synthetic_ratio(p, gear[p]);
        k->inertia[p] = synthetic_inertia(1 + p);
        k->inertia_total += k->ratio[p] * k->ratio[p] * k->inertia[p];
    }
    return GM_OK;
}

static gm_status compliance(const void *self, int p, int number, gm_compliance *c,
                            gm_error *error)
{
    (void)self;
    (void)error;
    *c = synthetic_compliance(p, number);
    return GM_OK;
}

static int kink_torques(const void *self, int p, int number, int n_max, double *torque)
{
    (void)self;
    if (n_max < 1)
        return 0;
    torque[0] = 7.0 + p + 0.5 * number;
    return 1;
}

static int drag_lines(const void *self, int p, int n_max, double *ratio)
{
    (void)self;
    int n = n_max < SYNTHETIC_LINES ? n_max : SYNTHETIC_LINES;
    for (int i = 0; i < n; i++)
        ratio[i] = synthetic_line(p, i);
    return n;
}

static int kink_speeds(const void *self, int p, int number, int n_max, double *speed)
{
    (void)self;
    if (n_max < 1)
        return 0;
    speed[0] = 20.0 + 10.0 * p + number;
    return 1;
}

static const gm_plant_class synthetic_class = {
    .kinematics = kinematics,
    .compliance = compliance,
    .kink_speeds = kink_speeds,
    .kink_torques = kink_torques,
    .drag_lines = drag_lines,
    .work_create = work_create,
    .work_destroy = work_destroy,
    .set_point = set_point,
    .size = size,
    .entries = entries,
    .pass = pass,
    .residual = residual,
    .pattern = pattern,
    .jacobian = jacobian,
    .result = result,
};

void synthetic_init(synthetic *s, int n_paths)
{
    static const char *const names[2][2] = {{"input", ""}, {"odd", "even"}};
    *s = (synthetic){.load_factor = 1.0, .slip = 1.0, .unsolvable_above = HUGE_VAL};
    s->plant = (gm_plant){.is = &synthetic_class,
                          .self = s,
                          .info = {.name = "synthetic",
                                   .title = "closed forms",
                                   .source_sha256 = "0123456789abcdef0123456789abcdef"
                                                    "0123456789abcdef0123456789abcdef",
                                   .n_paths = n_paths,
                                   .speed_max = SYNTHETIC_SPEED_MAX,
                                   .torque_max = SYNTHETIC_TORQUE_MAX,
                                   .oil_temperature = 353.15,
                                   .coupled = n_paths == 2}};
    for (int p = 0; p < n_paths; p++) {
        for (int g = 0; g < 3; g++)
            s->gears[p][g] = (gm_plant_gear){numbers[p][g], ratios[p][g]};
        s->plant.info.path[p] = (gm_plant_path){.name = names[n_paths - 1][p],
                                                .n_gears = 3,
                                                .gears = s->gears[p],
                                                .sync_torque = 30.0};
    }
}
