/* SPDX-License-Identifier: BSD-2-Clause */
#include "motion_fixture.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void make(moving *m, gm_description *d)
{
    gm_error error = {GM_OK, ""};
    if (gm_gearset_create(d, d->oil.temperature, &m->gearset, &error) != GM_OK ||
        gm_motion_create(m->gearset, &m->motion, &error) != GM_OK)
        fail_msg("%s", error.message);
    m->n = gm_motion_n_states(m->motion);
    m->x = calloc((size_t)m->n, sizeof *m->x);
    assert_non_null(m->x);
}

static void read_changed(moving *m, const char *path, void (*change)(gm_description *d))
{
    gm_error error = {GM_OK, ""};
    memset(m, 0, sizeof *m);
    if (gm_description_read(path, &m->d, &error) != GM_OK)
        fail_msg("%s", error.message);
    change(m->d);
    make(m, m->d);
}

static void leave(gm_description *d)
{
    (void)d;
}

void moving_read(moving *m, const char *path)
{
    read_changed(m, path, leave);
}

static void twist(gm_description *d)
{
    for (int s = 0; s < d->n_shafts; s++)
        d->shafts[s].torsion = GM_TORSION_ELASTIC;
}

void moving_read_twisting(moving *m, const char *path)
{
    read_changed(m, path, twist);
}

static void make_elastic(gm_bearing_data *data)
{
    data->friction = GM_FRICTION_ELASTIC;
    data->torque = 0.02;
    data->static_torque = 0.03;
    data->mu = 2e-3;
    data->static_mu = 3e-3;
    data->viscous = 1e-4;
    data->stribeck = 0.05;
    data->stiffness = 200.0;
    data->damping = 1.0;
}

static void hold(gm_description *d)
{
    for (int b = 0; b < d->n_bearings; b++)
        if (d->bearings[b].data.friction != GM_FRICTION_NONE)
            make_elastic(&d->bearings[b].data);
    for (int w = 0; w < d->n_wheels; w++)
        if (d->wheels[w].idles)
            make_elastic(&d->wheels[w].bearing);
}

void moving_read_holding(moving *m, const char *path)
{
    read_changed(m, path, hold);
}

void moving_make(moving *m, gm_description *d)
{
    memset(m, 0, sizeof *m);
    make(m, d);
}

void moving_clear(moving *m)
{
    free(m->x);
    gm_motion_destroy(m->motion);
    gm_gearset_destroy(m->gearset);
    gm_description_destroy(m->d);
}

void moving_start(moving *m, const double *speed)
{
    gm_error error = {GM_OK, ""};
    if (gm_motion_start(m->motion, &m->input, speed, m->x, &error) != GM_OK)
        fail_msg("%s", error.message);
    m->t = m->work = m->lost = 0.0;
}

gm_motion_view moving_view(moving *m)
{
    gm_motion_view view;
    gm_motion_view_at(m->motion, &m->input, m->x, &view);
    return view;
}

/* Powers of flanges and losses at x, added with a weight. */
static void add_powers(moving *m, const double *x, double weight)
{
    gm_motion_view view;
    gm_motion_view_at(m->motion, &m->input, x, &view);
    for (int f = 0; f < GM_MAX_FLANGES; f++)
        m->work += weight * m->input.torque[f] * view.speed[f];
    m->lost += weight * view.loss_power;
}

static void stage(moving *m, const double *x, const double *k, double h, double *next)
{
    for (int i = 0; i < m->n; i++)
        next[i] = x[i] + h * k[i];
}

static void step(moving *m, double h, double *const k[5])
{
    static const double at[4] = {0.0, 0.5, 0.5, 1.0};
    static const double weight[4] = {1.0 / 6.0, 2.0 / 6.0, 2.0 / 6.0, 1.0 / 6.0};
    for (int s = 0; s < 4; s++) {
        stage(m, m->x, k[s > 0 ? s - 1 : 0], at[s] * h, k[4]);
        assert_int_equal(gm_motion_rates(m->motion, &m->input, k[4], k[s]), 0);
        add_powers(m, k[4], weight[s] * h);
    }
    for (int i = 0; i < m->n; i++)
        for (int s = 0; s < 4; s++)
            m->x[i] += h * weight[s] * k[s][i];
    m->t += h;
}

void moving_run(moving *m, double duration, double h)
{
    double *k[5];
    for (int i = 0; i < 5; i++) {
        k[i] = calloc((size_t)m->n, sizeof *k[i]);
        assert_non_null(k[i]);
    }
    for (long steps = (long)(duration / h + 0.5); steps > 0; steps--) {
        int changed = 0;
        step(m, h, k);
        assert_int_equal(gm_motion_handle(m->motion, &m->input, m->x, &changed, NULL),
                         GM_OK);
    }
    for (int i = 0; i < 5; i++)
        free(k[i]);
}

double moving_signal(moving *m, const char *name)
{
    int n = gm_motion_n_signals(m->motion);
    double *value = calloc((size_t)n, sizeof *value), found = 0.0;
    assert_non_null(value);
    gm_motion_observe(m->motion, &m->input, m->x, value);
    int i = 0;
    while (i < n && strcmp(gm_motion_signal_at(m->motion, i).name, name) != 0)
        i++;
    if (i == n)
        fail_msg("no signal %s", name);
    found = value[i];
    free(value);
    return found;
}
