/* SPDX-License-Identifier: BSD-2-Clause */
#include "hand_map.h"

#include <math.h>
#include <string.h>

double hand_random(unsigned *seed)
{
    *seed = *seed * 1664525u + 1013904223u; /* Numerical Recipes' LCG */
    return (*seed >> 8) / 16777216.0;
}

double hand_between(unsigned *seed, double low, double high)
{
    return low + (high - low) * hand_random(seed);
}

hand_spec hand_default(void)
{
    const hand_spec spec = {
        .n_paths = 2,
        .n_gears = {3, 2},
        .number = {{-1, 1, 3}, {2, 4, 0}},
        .ratio = {{-13.0, 15.0, 6.0}, {9.0, 4.5, 0}},
        .inertia = {0.012, 0.009},
        .inertia_output = 0.4,
        .sync_torque = {30.0, 25.0},
        .p0 = {5.0, 6.0},
        .p1 = 0.06,
        .d0 = {0.02, 0.022},
        .d1 = 1e-5,
        .overrun = 1.1,
        .x = 0.3,
        .n0 = {0.15, 0.17},
        .n1 = 4e-4,
        .k = 2e-5,
        .r_k = 8.0,
        .j0 = 0.05,
        .j1 = 1e-4,
        .c0 = 0.1,
        .c1 = 2e-4,
        .c_width = 20.0,
        .stiffness = {2e4, 3e4},
        .damping = {2.0, 3.0},
        .loose_damping = {4.0, 3.0},
        .lash = {5e-3, 4e-3},
        .film = 1e-4,
        .pin_part = 0.2,
        .speed_max = 100.0,
        .torque_max = 250.0,
        .roughness = 0,
    };
    return spec;
}

hand_spec hand_lossless(void)
{
    hand_spec spec = hand_default();
    spec.p0[0] = spec.p0[1] = spec.p1 = spec.d0[0] = spec.d0[1] = spec.d1 = spec.x = 0;
    spec.n0[0] = spec.n0[1] = spec.n1 = spec.k = spec.j0 = spec.j1 = spec.c0 = spec.c1 =
        0;
    return spec;
}

static void swap(double v[2])
{
    const double first = v[0];
    v[0] = v[1];
    v[1] = first;
}

hand_spec hand_mirrored(const hand_spec *spec)
{
    hand_spec mirrored = *spec;
    swap(mirrored.p0);
    swap(mirrored.d0);
    swap(mirrored.n0);
    return mirrored;
}

/* Parts that turn in some gears only, in every second gearset. */
static void random_extra(unsigned seed, hand_spec *s)
{
    const double most = hand_random(&seed) < 0.5 ? 0 : 0.45 * s->inertia_output;
    for (int p = 0; p < 2; p++) {
        for (int g = 0; g < HAND_GEARS; g++) {
            s->inertia_extra[p][g] = hand_between(&seed, -most, most);
        }
    }
}

hand_spec hand_random_spec(unsigned *seed)
{
    hand_spec s = hand_default();
    s.inertia[0] = hand_between(seed, 0.005, 0.2);
    s.inertia[1] = hand_between(seed, 0.005, 0.2);
    s.inertia_output = hand_between(seed, 0.05, 5.0);
    s.sync_torque[0] = hand_between(seed, 5, 80);
    s.p0[0] = hand_between(seed, 0, 20);
    s.p0[1] = hand_between(seed, 0, 20);
    s.p1 = hand_between(seed, 0, 0.2);
    s.d0[0] = hand_between(seed, 0.005, 0.08);
    s.d0[1] = hand_between(seed, 0.005, 0.08);
    s.overrun = hand_between(seed, 0.8, 1.3);
    s.n0[0] = hand_between(seed, 0, 0.5);
    s.n0[1] = hand_between(seed, 0, 0.5);
    s.k = hand_between(seed, 0, 1e-4);
    s.j0 = hand_between(seed, 0, 0.1);
    s.c0 = hand_between(seed, 0, 0.3);
    s.c_width = hand_between(seed, 0.5, 40);
    s.stiffness[0] = hand_between(seed, 3e3, 1e5);
    s.stiffness[1] = hand_between(seed, 3e3, 1e5);
    s.damping[0] = hand_between(seed, 0, 20);
    s.lash[0] = hand_between(seed, 0, 0.02);
    s.film = hand_between(seed, 1e-5, 2e-4);
    s.pin_part = hand_between(seed, 0, 0.25);
    random_extra(*seed, &s);
    s.roughness = 1 + (unsigned)(1e6 * hand_random(seed));
    return s;
}

static void set_axes(const hand_spec *s, hand_map *m)
{
    static const double part[HAND_W] = {0, 0.01, 0.06, 0.2, 0.5, 1};
    static const double torque[HAND_T] = {-1, -0.4, -0.1, -0.01, 0, 0.01, 0.1, 0.4, 1};
    for (int i = 0; i < HAND_W; i++) {
        m->w_o[i] = part[i] * s->speed_max;
        m->w_p[i] = 20 * m->w_o[i];
    }
    for (int i = 0; i < HAND_T; i++) {
        m->torque[i] = torque[i] * s->torque_max;
    }
    const double reach = 40 * s->speed_max;
    const double relative[HAND_C] = {-reach,     -s->c_width, 0,
                                     s->c_width, reach / 2,   reach};
    memcpy(m->relative, relative, sizeof relative);
    for (int i = 0; i < HAND_X; i++) {
        m->x_w[i] = i * s->speed_max / (HAND_X - 1);
        m->x_t[i] = (i - 1) * s->torque_max;
    }
}

/* The part of P that keeps the idlers of free path p passive. */
static double idlers(const hand_spec *s, int p, double w)
{
    double sum = s->r_k * s->r_k * s->k * w;
    for (int g = 0; g < s->n_gears[p]; g++) {
        sum += fabs(s->ratio[p][g]) * (s->j0 + s->j1 * w) / 2;
    }
    return sum;
}

static double rough(const hand_spec *s, unsigned *seed)
{
    return s->roughness == 0 ? 1 : hand_between(seed, 0.5, 1);
}

static void fill_configuration(const hand_spec *s, const int gear[2], unsigned *seed,
                               hand_map *m)
{
    int index = gear[0] + 1;
    if (s->n_paths == 2) {
        index = index * (s->n_gears[1] + 1) + gear[1] + 1;
    }
    gm_configuration *c = &m->configuration[index];
    for (int dir = 0; dir < 2; dir++) {
        for (int i = 0; i < HAND_W; i++) {
            const double w = m->w_o[i];
            double p = (s->p0[dir] + s->p1 * w) * rough(s, seed);
            for (int path = 0; path < s->n_paths; path++) {
                p += gear[path] < 0 ? idlers(s, path, w) : 0;
            }
            m->p[index][dir][i] = p;
        }
        c->parasitic[dir] = (gm_table1){{HAND_W, m->w_o}, m->p[index][dir], s->monotone};
        c->both_loaded[dir] = (gm_table3){{HAND_X, m->x_w},
                                          {HAND_X, m->x_t},
                                          {HAND_X, m->x_t},
                                          s->x != 0 ? m->both[0][0] : NULL};
    }
    c->gear[0] = gear[0];
    c->gear[1] = s->n_paths == 2 ? gear[1] : -1;
}

static void fill_gear(const hand_spec *s, int p, int g, unsigned *seed, hand_map *m)
{
    gm_gear *gear = &m->gear[p][g];
    gear->number = s->number[p][g];
    gear->ratio = s->ratio[p][g];
    gear->inertia_extra = s->inertia_extra[p][g];
    gear->stiffness = s->stiffness[p];
    gear->damping = s->damping[p];
    gear->loose_damping = s->loose_damping[p];
    gear->lash = s->lash[p];
    gear->film = s->film;
    for (int dir = 0; dir < 2; dir++) {
        for (int i = 0; i < HAND_W; i++) {
            const double factor =
                rough(s, seed); /* one per speed: dD/dtau stays below 1 */
            for (int j = 0; j < HAND_T; j++) {
                const double y = m->torque[j];
                m->d[p][g][dir][i][j] = factor * (s->d0[dir] + s->d1 * m->w_p[i]) *
                                        fabs(y) * (y < 0 ? s->overrun : 1);
            }
        }
        for (int i = 0; i < HAND_W; i++) {
            const double r = fabs(gear->ratio);
            m->pin[p][g][dir][i] =
                s->pin_part / r *
                (s->p0[gear->ratio < 0 ? 1 - dir : dir] + s->p1 * m->w_p[i] / r);
        }
        gear->pin[dir] = (gm_table1){{HAND_W, m->w_p}, m->pin[p][g][dir], s->monotone};
        gear->load_loss[dir] = (gm_table2){
            {HAND_W, m->w_p}, {HAND_T, m->torque}, m->d[p][g][dir][0], s->monotone};
    }
    m->line[p][g].ratio = gear->ratio;
    m->line[p][g].jump[0] = m->line[p][g].jump[1] =
        (gm_table1){{HAND_W, m->w_o}, m->jump, s->monotone};
}

static void fill_drag(const hand_spec *s, int p, int dn, int dw, hand_map *m)
{
    const double sn = dn == GM_FORWARD ? 1 : -1, so = dw == GM_FORWARD ? 1 : -1;
    for (int i = 0; i < HAND_W; i++) {
        for (int j = 0; j < HAND_W; j++) {
            const double w_n = sn * m->w_p[i], w_o = so * m->w_o[j];
            m->n[p][dn][dw][i][j] =
                sn * s->n0[dn] + s->n1 * w_n + s->k * (w_n - s->r_k * w_o);
            m->r[p][dn][dw][i][j] = -s->r_k * s->k * w_n;
        }
    }
    gm_path *path = &m->map.path[p];
    path->drag[dn][dw] =
        (gm_table2){{HAND_W, m->w_p}, {HAND_W, m->w_o}, m->n[p][dn][dw][0], s->monotone};
    path->reaction[dn][dw] =
        (gm_table2){{HAND_W, m->w_p}, {HAND_W, m->w_o}, m->r[p][dn][dw][0], s->monotone};
}

static void fill_path(const hand_spec *s, int p, unsigned *seed, hand_map *m)
{
    gm_path *path = &m->map.path[p];
    path->inertia = s->inertia[p];
    path->sync_torque = s->sync_torque[p];
    path->n_gears = s->n_gears[p];
    path->gears = m->gear[p];
    path->n_lines = s->n_gears[p];
    path->lines = m->line[p];
    for (int g = 0; g < s->n_gears[p]; g++) {
        fill_gear(s, p, g, seed, m);
    }
    for (int quadrant = 0; quadrant < 4; quadrant++) {
        fill_drag(s, p, quadrant / 2, quadrant % 2, m);
    }
}

static void fill_shared(const hand_spec *s, hand_map *m)
{
    for (int i = 0; i < HAND_W; i++) {
        m->jump[i] = s->j0 + s->j1 * m->w_o[i];
    }
    for (int i = 0; i < HAND_C; i++) {
        const double w = m->relative[i];
        m->c[i] = s->c0 * fmax(-1, fmin(1, w / s->c_width)) + s->c1 * w;
    }
    for (int i = 0; i < HAND_X * HAND_X * HAND_X; i++) {
        const double y0 = m->x_t[i / HAND_X % HAND_X], y1 = m->x_t[i % HAND_X];
        (&m->both[0][0][0])[i] = s->x * fabs(y0 * y1) / s->torque_max;
    }
}

void hand_build(const hand_spec *s, hand_map *m)
{
    unsigned seed = s->roughness;
    memset(m, 0, sizeof *m);
    set_axes(s, m);
    fill_shared(s, m);
    for (int p = 0; p < s->n_paths; p++) {
        fill_path(s, p, &seed, m);
    }
    const int n_1 = s->n_paths == 2 ? s->n_gears[1] : 0;
    for (int g0 = -1; g0 < s->n_gears[0]; g0++) {
        for (int g1 = -1; g1 < n_1; g1++) {
            const int gear[2] = {g0, g1};
            fill_configuration(s, gear, &seed, m);
        }
    }
    m->map.n_paths = s->n_paths;
    m->map.inertia_output = s->inertia_output;
    m->map.n_configurations = (s->n_gears[0] + 1) * (n_1 + 1);
    m->map.configurations = m->configuration;
    if (s->n_paths == 2) {
        m->map.coupling = (gm_table1){{HAND_C, m->relative}, m->c, s->monotone};
    }
}

gm_reduced_inputs hand_inputs(int gear_0, int gear_1)
{
    gm_reduced_inputs in = {0};
    in.gear[0] = gear_0;
    in.gear[1] = gear_1;
    in.oil_temperature = 353.15;
    return in;
}

gm_reduced_state hand_start(const hand_map *m, int gear_0, int gear_1, double w_o)
{
    const gm_reduced_inputs in = hand_inputs(gear_0, gear_1);
    const double rest[2] = {0, 0};
    gm_reduced_state s;
    gm_reduced_start(&m->map, &in, w_o, rest, &s);
    return s;
}

double hand_kinetic(const hand_map *m, const gm_reduced_state *s)
{
    double sum = m->map.inertia_output * s->w_o * s->w_o / 2;
    for (int p = 0; p < m->map.n_paths; p++) {
        sum += m->map.path[p].inertia * s->path[p].w * s->path[p].w / 2;
        if (s->path[p].mode == GM_PATH_ENGAGED) {
            sum += m->gear[p][s->path[p].gear].inertia_extra * s->w_o * s->w_o / 2;
        }
    }
    return sum;
}

double hand_energy(const hand_map *m, const gm_reduced_params *params,
                   const gm_reduced_state *s)
{
    double sum = hand_kinetic(m, s);
    for (int p = 0; p < m->map.n_paths; p++) {
        if (params->fidelity == GM_LASH && s->path[p].mode == GM_PATH_ENGAGED) {
            const gm_gear *gear = &m->gear[p][s->path[p].gear];
            const double e = fmax(0, fabs(s->path[p].twist) - gear->lash / 2);
            sum += gear->stiffness * e * e / 2;
        }
    }
    return sum;
}
