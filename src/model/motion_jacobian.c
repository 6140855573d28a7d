/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Exact derivative of the right side. One walk over the elements names every entry that
 * can be non-zero; run once without values it gives the pattern, which therefore holds in
 * every mode.
 *
 * A force F_e(x_e, g_e . w) that does c to the torque of node i enters
 *
 *   column x_e:                 c dF/dx / J_i
 *   column w_k, k in row e:     c dF/dv g_k / J_i
 */
#include "model/motion.h"

#include "base/alloc.h"

#include <string.h>

/* Where entries go: values of a known pattern, or marks of a new one. */
typedef struct sink {
    const gm_motion *motion;
    double *value;
    unsigned char *mark; /* [n_states][n_states], NULL once the pattern is known */
} sink;

static void put(const sink *to, int i, int j, double v)
{
    const gm_motion *m = to->motion;
    int place = i * m->n_states + j;
    if (to->mark)
        to->mark[place] = 1;
    else
        to->value[m->pattern.at[place]] += v;
}

/* d(rate of state i)/d(force of row e) = a. */
static void put_row(const sink *to, int i, int e, double a)
{
    const gm_motion *m = to->motion;
    const gm_row *row = &m->rows[e].row;
    put(to, i, m->n_nodes + e, a * m->contact[e].d_x);
    for (int k = 0; k < row->n; k++)
        put(to, i, row->body[k], a * m->contact[e].d_v * row->g[k]);
}

/* d(torque of node)/d(force of row e) = c. */
static void put_force(const sink *to, int node, int e, double c)
{
    if (node >= 0)
        put_row(to, node, e, c / to->motion->inertia[node]);
}

/* d(torque of node)/d(speed of other) = c. */
static void put_speed(const sink *to, int node, int other, double c)
{
    if (node >= 0 && other >= 0)
        put(to, node, other, c / to->motion->inertia[node]);
}

static void walk_rows(const sink *to)
{
    const gm_motion *m = to->motion;
    for (int e = 0; e < m->n_rows; e++) {
        const gm_row *row = &m->rows[e].row;
        for (int k = 0; k < row->n; k++) {
            put_force(to, row->body[k], e, -row->g[k]);
            put(to, m->n_nodes + e, row->body[k], m->rows[e].closed ? row->g[k] : 0.0);
        }
    }
}

static void walk_meshes(const sink *to)
{
    const gm_motion *m = to->motion;
    for (int i = 0; i < m->gearset->n_meshes; i++) {
        const gm_row *roll = &m->roll[i];
        const gm_motion_friction *f = &m->mesh_friction[i];
        for (int k = 0; k < roll->n; k++) {
            put_force(to, roll->body[k], i, -roll->g[k] * f->d_force);
            for (int j = 0; j < roll->n; j++)
                put_speed(to, roll->body[k], roll->body[j],
                          -roll->g[k] * roll->g[j] * f->d_speed);
        }
    }
}

static void walk_slope(const sink *to, const gm_motion_pair *pair, double d_speed)
{
    put_speed(to, pair->node, pair->node, -d_speed);
    put_speed(to, pair->node, pair->on, d_speed);
    put_speed(to, pair->on, pair->node, d_speed);
    put_speed(to, pair->on, pair->on, -d_speed);
}

/* Through the loads: of the row forces, and of planets on their pins. */
static void walk_loads(const sink *to, int i, const double *w)
{
    const gm_motion *m = to->motion;
    const gm_bearing_element *e = &m->gearset->bearings[i];
    const gm_motion_bearing *b = &m->bearing[i];
    int node = b->pair.node, on = b->pair.on;
    gm_bearing_load load = gm_bearing_load_at(e, gm_motion_speed_on(&b->pair, w),
                                              m->force, m->d_radial, m->d_axial);
    for (int k = 0; k < e->load.n; k++) {
        double c = b->d_radial * m->d_radial[k] + b->d_axial * m->d_axial[k];
        put_force(to, node, e->load.mesh[k], -c);
        put_force(to, on, e->load.mesh[k], c);
        if (b->state >= 0)
            put_row(to, b->state, e->load.mesh[k],
                    b->bristle.rate_radial * m->d_radial[k] +
                        b->bristle.rate_axial * m->d_axial[k]);
    }
    put_speed(to, node, on, -b->d_radial * load.d_radial_on);
    put_speed(to, on, on, b->d_radial * load.d_radial_on);
    if (b->state >= 0 && on >= 0)
        put(to, b->state, on, b->bristle.rate_radial * load.d_radial_on);
}

/* The bristle of an elastic bearing. */
static void walk_bristle(const sink *to, int i)
{
    const gm_motion *m = to->motion;
    const gm_motion_bearing *b = &m->bearing[i];
    int node = b->pair.node, on = b->pair.on;
    double c = m->loss_scale * m->gearset->bearings[i].count * b->bristle.torque_state;
    put(to, b->state, b->state, b->bristle.rate_state);
    put(to, b->state, node, b->bristle.rate_speed);
    put(to, node, b->state, -c / m->inertia[node]);
    if (on < 0)
        return;
    put(to, b->state, on, -b->bristle.rate_speed);
    put(to, on, b->state, c / m->inertia[on]);
}

static void walk(const sink *to, const double *w)
{
    const gm_motion *m = to->motion;
    for (int i = 0; i < m->n_states; i++)
        put(to, i, i, 0.0);
    walk_rows(to);
    walk_meshes(to);
    for (int i = 0; i < m->gearset->n_bearings; i++) {
        walk_slope(to, &m->bearing[i].pair, m->bearing_friction[i].d_speed);
        walk_loads(to, i, w);
        if (m->bearing[i].state >= 0)
            walk_bristle(to, i);
    }
    for (int i = 0; i < m->gearset->n_drags; i++)
        walk_slope(to, &m->drag[i], m->drag_friction[i].d_speed);
}

/* ---- pattern ---- */

static int number_entries(gm_motion_pattern_data *pattern, const unsigned char *mark)
{
    int n = pattern->n, count = 0;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++)
            pattern->at[i * n + j] = mark[i * n + j] ? count++ : -1;
    return count;
}

static void list_entries(gm_motion_pattern_data *pattern)
{
    int n = pattern->n, count = 0;
    for (int j = 0; j < n; j++) {
        pattern->column_start[j] = count;
        for (int i = 0; i < n; i++)
            if (pattern->at[i * n + j] >= 0)
                pattern->row[count++] = i;
    }
    pattern->column_start[n] = count;
}

gm_status gm_motion_make_pattern(gm_motion *motion, gm_error *error)
{
    gm_motion_pattern_data *p = &motion->pattern;
    size_t n = (size_t)motion->n_states;
    unsigned char *mark = gm_calloc(n * n, 1);
    p->n = motion->n_states;
    p->at = gm_calloc(n * n, sizeof *p->at);
    p->column_start = gm_calloc(n + 1, sizeof *p->column_start);
    if (mark && p->at && p->column_start) {
        walk(&(sink){.motion = motion, .mark = mark}, motion->torque);
        p->n_entries = number_entries(p, mark);
        p->row = gm_calloc((size_t)p->n_entries, sizeof *p->row);
    }
    gm_free(mark);
    if (!p->row)
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    list_entries(p);
    return GM_OK;
}

int gm_motion_entries(const gm_motion *motion)
{
    return motion->pattern.n_entries;
}

void gm_motion_pattern(const gm_motion *motion, int *column_start, int *row)
{
    const gm_motion_pattern_data *p = &motion->pattern;
    memcpy(column_start, p->column_start, ((size_t)p->n + 1) * sizeof *column_start);
    memcpy(row, p->row, (size_t)p->n_entries * sizeof *row);
}

/* ---- values ---- */

int gm_motion_jacobian(gm_motion *motion, const gm_motion_input *input, const double *x,
                       double *value)
{
    (void)input; /* flange torques are added: no entry depends on them */
    gm_motion_evaluate(motion, x);
    memset(value, 0, (size_t)motion->pattern.n_entries * sizeof *value);
    walk(&(sink){.motion = motion, .value = value}, x);
    return 0;
}

int gm_motion_torque_column(gm_motion *motion, const gm_motion_input *input,
                            const double *x, int flange, double *column)
{
    (void)input;
    (void)x;
    int node = motion->flange[flange];
    memset(column, 0, (size_t)motion->n_states * sizeof *column);
    column[node] = 1.0 / motion->inertia[node];
    return 0;
}
