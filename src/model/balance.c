/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The steady balance of torques at one operating point:
 *
 *   r(x) = A x + t_friction(x) + t_drag + t_given = 0
 *
 * x holds the row forces (meshes, then locks) and the unknown flange torques, A the rows
 * (configuration.c). Speeds are known, so drags that depend on speed alone are constant
 * and bearing laws are prepared once per speed. Friction acts against the relative speed;
 * where that is zero, against the speed that the point's direction would give: the
 * one-sided limit, exact at standstill. Where that is zero too (a locked gear), there is
 * no friction.
 */
#include "model/gearset.h"

#include "base/alloc.h"
#include "model/power.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A relative speed below this share of the speeds it is the difference of is zero: it is
 * rounding of the kinematics (a point exactly on a line of synchronous speed). */
#define SAME_SPEED 1e-12

typedef struct contact_state {
    double sign;  /* of the relative speed or of its limit; 0: no relative motion */
    double speed; /* magnitude: rad/s, pitch-line m/s for meshes */
} contact_state;

struct gm_balance {
    const gm_gearset *gearset;
    int configured;
    gm_steady_point point;
    gm_configuration_rows rows;
    int n_entries;
    unsigned char *pattern; /* [n][n]: 1 where the Jacobian may be non-zero */
    double *speed, *limit;  /* [n] body speeds, and speeds of the point's direction */
    contact_state *mesh;    /* [n_meshes] */
    contact_state *bearing; /* [n_bearings] */
    gm_bearing_speed *bearing_speed;
    contact_state *drag;        /* [n_drags] */
    double *drag_torque;        /* [n_drags] magnitudes */
    double *constant;           /* [n] drags and given flange torques on the bodies */
    double *torque;             /* [n] scratch */
    double *jacobian;           /* [n][n] scratch */
    double *d_radial, *d_axial; /* [n_meshes] scratch */
};

/* ---- workspace ---- */

void gm_balance_destroy(gm_balance *balance)
{
    if (!balance)
        return;
    gm_configuration_rows_clear(&balance->rows);
    gm_free(balance->pattern);
    gm_free(balance->speed);
    gm_free(balance->limit);
    gm_free(balance->mesh);
    gm_free(balance->bearing);
    gm_free(balance->bearing_speed);
    gm_free(balance->drag);
    gm_free(balance->drag_torque);
    gm_free(balance->constant);
    gm_free(balance->torque);
    gm_free(balance->jacobian);
    gm_free(balance->d_radial);
    gm_free(balance->d_axial);
    gm_free(balance);
}

static int allocate(gm_balance *b, const gm_gearset *g)
{
    size_t n = (size_t)g->n_bodies;
    size_t n_m = (size_t)g->n_meshes, n_b = (size_t)g->n_bearings,
           n_d = (size_t)g->n_drags;
    b->pattern = gm_calloc(n * n, 1);
    b->speed = gm_calloc(n, sizeof *b->speed);
    b->limit = gm_calloc(n, sizeof *b->limit);
    b->mesh = gm_calloc(n_m, sizeof *b->mesh);
    b->bearing = gm_calloc(n_b, sizeof *b->bearing);
    b->bearing_speed = gm_calloc(n_b, sizeof *b->bearing_speed);
    b->drag = gm_calloc(n_d, sizeof *b->drag);
    b->drag_torque = gm_calloc(n_d, sizeof *b->drag_torque);
    b->constant = gm_calloc(n, sizeof *b->constant);
    b->torque = gm_calloc(n, sizeof *b->torque);
    b->jacobian = gm_calloc(n * n, sizeof *b->jacobian);
    b->d_radial = gm_calloc(n_m, sizeof *b->d_radial);
    b->d_axial = gm_calloc(n_m, sizeof *b->d_axial);
    return b->pattern && b->speed && b->limit && b->mesh && b->bearing &&
           b->bearing_speed && b->drag && b->drag_torque && b->constant && b->torque &&
           b->jacobian && b->d_radial && b->d_axial;
}

gm_status gm_balance_create(const gm_gearset *gearset, gm_balance **balance,
                            gm_error *error)
{
    gm_balance *b = gm_calloc(1, sizeof *b);
    if (!b || !allocate(b, gearset)) {
        gm_balance_destroy(b);
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    }
    b->gearset = gearset;
    for (int i = 0; i < gearset->n_bearings; i++)
        b->bearing_speed[i] = gm_bearing_at_speed(&gearset->bearings[i].law, 0.0);
    *balance = b;
    return GM_OK;
}

/* ---- configuration ---- */

static void mark(gm_balance *b, int body, int column)
{
    if (body >= 0)
        b->pattern[body * b->rows.n_bodies + column] = 1;
}

static void make_pattern(gm_balance *b)
{
    const gm_gearset *g = b->gearset;
    int n = b->rows.n_bodies;
    for (int i = 0; i < n * n; i++)
        b->pattern[i] = b->rows.balance[i] != 0.0;
    for (int i = 0; i < g->n_bearings; i++)
        for (int k = 0; k < g->bearings[i].load.n; k++) {
            mark(b, g->bearings[i].body, g->bearings[i].load.mesh[k]);
            mark(b, g->bearings[i].on, g->bearings[i].load.mesh[k]);
        }
    b->n_entries = 0;
    for (int i = 0; i < n * n; i++)
        b->n_entries += b->pattern[i];
}

static int same_gears(const gm_balance *b, const int *gear)
{
    for (int p = 0; p < b->gearset->description->n_paths; p++)
        if (b->point.gear[p] != gear[p])
            return 0;
    return b->configured;
}

static gm_status configure(gm_balance *b, const int *gear, gm_error *error)
{
    if (same_gears(b, gear))
        return GM_OK;
    b->configured = 0;
    gm_configuration_rows_clear(&b->rows);
    gm_status status = gm_configuration_rows_make(b->gearset, gear, &b->rows, error);
    if (status != GM_OK)
        return status;
    make_pattern(b);
    b->configured = 1;
    return GM_OK;
}

/* ---- speeds ---- */

static void body_speeds(gm_balance *b)
{
    const gm_configuration_rows *rows = &b->rows;
    for (int i = 0; i < rows->n_bodies; i++) {
        const double *s = rows->speed_of + i * rows->n_independent;
        b->speed[i] = b->limit[i] = 0.0;
        for (int k = 0; k < rows->n_independent; k++) {
            b->speed[i] += s[k] * b->point.speed[rows->flange[k]];
            b->limit[i] += s[k] * b->point.direction[rows->flange[k]];
        }
    }
}

static double difference(const double *w, int body, int on)
{
    double other = on == GM_HOUSING ? 0.0 : w[on];
    double v = w[body] - other;
    return fabs(v) <= SAME_SPEED * (fabs(w[body]) + fabs(other)) ? 0.0 : v;
}

static contact_state slide(const gm_balance *b, int body, int on)
{
    double v = difference(b->speed, body, on);
    double way = v != 0.0 ? v : difference(b->limit, body, on);
    return (contact_state){.sign = (double)((way > 0.0) - (way < 0.0)), .speed = fabs(v)};
}

static contact_state mesh_slide(const gm_balance *b, const gm_mesh_element *mesh)
{
    contact_state s = slide(b, mesh->row.body[0], mesh->carrier);
    s.sign *= mesh->row.g[0] < 0.0 ? -1.0 : 1.0;
    s.speed *= fabs(mesh->row.g[0]) / mesh->cos_alpha_wt;
    return s;
}

static void apply(double *torque, int body, int on, double t)
{
    torque[body] -= t;
    if (on != GM_HOUSING)
        torque[on] += t;
}

static void slide_all(gm_balance *b)
{
    const gm_gearset *g = b->gearset;
    for (int i = 0; i < g->n_meshes; i++)
        b->mesh[i] = mesh_slide(b, &g->meshes[i]);
    for (int i = 0; i < g->n_bearings; i++) {
        b->bearing[i] = slide(b, g->bearings[i].body, g->bearings[i].on);
        if (b->bearing[i].speed != b->bearing_speed[i].w)
            b->bearing_speed[i] =
                gm_bearing_at_speed(&g->bearings[i].law, b->bearing[i].speed);
    }
    for (int i = 0; i < g->n_drags; i++) {
        contact_state s = slide(b, g->drags[i].body, g->drags[i].on);
        if (s.speed != b->drag[i].speed || b->drag_torque[i] == 0.0)
            b->drag_torque[i] = gm_drag_torque(g, &g->drags[i], s.speed).value;
        b->drag[i] = s;
    }
}

static void constant_torques(gm_balance *b)
{
    const gm_gearset *g = b->gearset;
    memset(b->constant, 0, (size_t)b->rows.n_bodies * sizeof *b->constant);
    for (int i = 0; i < g->n_drags; i++)
        apply(b->constant, g->drags[i].body, g->drags[i].on,
              b->drag[i].sign * b->drag_torque[i]);
    for (int p = 0; p < g->description->n_paths; p++)
        if (b->point.gear[p] != 0)
            b->constant[gm_flange_body(g, 1 + p)] += b->point.torque[1 + p];
}

gm_status gm_balance_set_point(gm_balance *balance, const gm_steady_point *point,
                               gm_error *error)
{
    gm_status status = configure(balance, point->gear, error);
    if (status != GM_OK)
        return status;
    balance->point = *point;
    body_speeds(balance);
    slide_all(balance);
    constant_torques(balance);
    return GM_OK;
}

int gm_balance_size(const gm_balance *balance)
{
    return balance->rows.n_bodies;
}

int gm_balance_entries(const gm_balance *balance)
{
    return balance->n_entries;
}

/* ---- friction ---- */

static double mesh_friction(const gm_balance *b, int m, double F, double *d_force)
{
    gm_mesh_friction f = gm_mesh_friction_at(&b->gearset->meshes[m], F, b->mesh[m].speed);
    if (d_force)
        *d_force = f.d_force;
    return f.value;
}

static gm_bearing_load bearing_load(gm_balance *b, const gm_bearing_element *e,
                                    const double *x, int derivatives)
{
    double w_on = e->on == GM_HOUSING ? 0.0 : b->speed[e->on];
    return gm_bearing_load_at(e, w_on, x, derivatives ? b->d_radial : NULL,
                              derivatives ? b->d_axial : NULL);
}

static gm_bearing_torque bearing_torque(gm_balance *b, int i, const double *x,
                                        int derivatives)
{
    const gm_bearing_element *e = &b->gearset->bearings[i];
    gm_bearing_load load = bearing_load(b, e, x, derivatives);
    return gm_bearing_friction(&e->law, &b->bearing_speed[i], load.radial, load.axial);
}

/* Torques of load-dependent friction on the bodies, added to torque[n]. */
static void add_friction(gm_balance *b, const double *x, double *torque)
{
    const gm_gearset *g = b->gearset;
    for (int m = 0; m < g->n_meshes; m++) {
        const gm_row *roll = &g->meshes[m].roll;
        double f = b->mesh[m].sign * mesh_friction(b, m, x[m], NULL);
        for (int k = 0; k < roll->n; k++)
            torque[roll->body[k]] -= roll->g[k] * f;
    }
    for (int i = 0; i < g->n_bearings; i++) {
        const gm_bearing_element *e = &g->bearings[i];
        if (b->bearing[i].sign != 0.0)
            apply(torque, e->body, e->on,
                  e->count * b->bearing[i].sign * bearing_torque(b, i, x, 0).value);
    }
}

void gm_balance_residual(gm_balance *balance, const double *x, double *f)
{
    int n = balance->rows.n_bodies;
    const double *A = balance->rows.balance;
    memcpy(f, balance->constant, (size_t)n * sizeof *f);
    add_friction(balance, x, f);
    for (int i = 0; i < n; i++)
        for (int k = 0; k < n; k++)
            f[i] += A[i * n + k] * x[k];
}

/* Largest change relative to the largest unknown, row forces and torques apart. */
static double relative_change(int n, int n_rows, const double *x, const double *next)
{
    double change[2] = {0.0, 0.0}, size[2] = {1e-12, 1e-12};
    for (int i = 0; i < n; i++) {
        int kind = i >= n_rows;
        change[kind] = fmax(change[kind], fabs(next[i] - x[i]));
        size[kind] = fmax(size[kind], fabs(next[i]));
    }
    return fmax(change[0] / size[0], change[1] / size[1]);
}

double gm_balance_pass(gm_balance *balance, double *x)
{
    int n = balance->rows.n_bodies;
    double *t = balance->torque, *next = balance->jacobian;
    memcpy(t, balance->constant, (size_t)n * sizeof *t);
    add_friction(balance, x, t);
    for (int i = 0; i < n; i++) {
        next[i] = 0.0;
        for (int k = 0; k < n; k++)
            next[i] -= balance->rows.inverse[i * n + k] * t[k];
    }
    double change = relative_change(n, balance->rows.n_rows, x, next);
    memcpy(x, next, (size_t)n * sizeof *x);
    return change;
}

/* ---- Jacobian ---- */

static void add_entry(gm_balance *b, int body, int column, double value)
{
    if (body >= 0)
        b->jacobian[body * b->rows.n_bodies + column] += value;
}

static void fill_jacobian(gm_balance *b, const double *x)
{
    const gm_gearset *g = b->gearset;
    int n = b->rows.n_bodies;
    memcpy(b->jacobian, b->rows.balance, (size_t)n * (size_t)n * sizeof *b->jacobian);
    for (int m = 0; m < g->n_meshes; m++) {
        const gm_row *roll = &g->meshes[m].roll;
        double d;
        (void)mesh_friction(b, m, x[m], &d);
        for (int k = 0; k < roll->n; k++)
            add_entry(b, roll->body[k], m, -b->mesh[m].sign * roll->g[k] * d);
    }
    for (int i = 0; i < g->n_bearings; i++) {
        const gm_bearing_element *e = &g->bearings[i];
        if (b->bearing[i].sign == 0.0)
            continue;
        gm_bearing_torque M = bearing_torque(b, i, x, 1);
        for (int k = 0; k < e->load.n; k++) {
            double d = e->count * b->bearing[i].sign *
                       (M.d_radial * b->d_radial[k] + M.d_axial * b->d_axial[k]);
            add_entry(b, e->body, e->load.mesh[k], -d);
            add_entry(b, e->on, e->load.mesh[k], d);
        }
    }
}

void gm_balance_pattern(const gm_balance *balance, int *column_start, int *row)
{
    int n = balance->rows.n_bodies, entry = 0;
    for (int column = 0; column < n; column++) {
        column_start[column] = entry;
        for (int i = 0; i < n; i++)
            if (balance->pattern[i * n + column])
                row[entry++] = i;
    }
    column_start[n] = entry;
}

void gm_balance_jacobian(gm_balance *balance, const double *x, double *value)
{
    int n = balance->rows.n_bodies, entry = 0;
    fill_jacobian(balance, x);
    for (int column = 0; column < n; column++)
        for (int i = 0; i < n; i++)
            if (balance->pattern[i * n + column])
                value[entry++] = balance->jacobian[i * n + column];
}

/* ---- results ---- */

void gm_balance_result(const gm_balance *balance, const double *x,
                       gm_steady_result *result)
{
    const gm_gearset *g = balance->gearset;
    const gm_configuration_rows *rows = &balance->rows;
    memset(result, 0, sizeof *result);
    for (int flange = 0; flange <= g->description->n_paths; flange++) {
        result->speed[flange] = balance->speed[gm_flange_body(g, flange)];
        result->torque[flange] = balance->point.torque[flange];
    }
    for (int i = 0; i < rows->n_independent; i++)
        result->torque[rows->flange[i]] = x[rows->n_rows + i];
}

/* p_bt = pi d_b / z [m] */
static double base_pitch(const gm_pair *pair)
{
    return GM_PI * pair->d_b[0] / abs(pair->z[0]);
}

static void mesh_losses(gm_balance *b, const double *x, gm_element_loss *losses)
{
    const gm_gearset *g = b->gearset;
    for (int m = 0; m < g->n_meshes; m++) {
        double along = b->mesh[m].speed * g->meshes[m].cos_alpha_wt;
        losses[m] = (gm_element_loss){.kind = GM_LOSS_MESH,
                                      .name = g->description->meshes[m].id.name,
                                      .power = mesh_friction(b, m, x[m], NULL) * along,
                                      .speed = b->mesh[m].speed,
                                      .frequency = along / base_pitch(&g->meshes[m].pair),
                                      .radial = fabs(x[m]) / g->meshes[m].contacts};
    }
}

void gm_balance_losses(gm_balance *balance, const double *x, gm_element_loss *losses)
{
    const gm_gearset *g = balance->gearset;
    mesh_losses(balance, x, losses);
    losses += g->n_meshes;
    for (int i = 0; i < g->n_bearings; i++) {
        const gm_bearing_element *e = &g->bearings[i];
        double w = balance->bearing[i].speed;
        gm_bearing_load load = bearing_load(balance, e, x, 0);
        losses[i] = (gm_element_loss){.kind = e->kind,
                                      .name = e->name,
                                      .speed = w,
                                      .radial = load.radial,
                                      .axial = load.axial};
        losses[i].power = e->count * w * bearing_torque(balance, i, x, 0).value;
    }
    losses += g->n_bearings;
    for (int i = 0; i < g->n_drags; i++)
        losses[i] =
            (gm_element_loss){.kind = g->drags[i].kind,
                              .name = g->drags[i].name,
                              .power = balance->drag[i].speed * balance->drag_torque[i],
                              .speed = balance->drag[i].speed};
}
