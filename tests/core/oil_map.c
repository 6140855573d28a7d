/* SPDX-License-Identifier: BSD-2-Clause */
#include "oil_map.h"

#include <stddef.h>
#include <string.h>

const double oil_temperatures[OIL_SLICES] = {263.15, 303.15, 363.15};

hand_spec oil_scaled(const hand_spec *spec, double factor)
{
    hand_spec s = *spec;
    double *const laws[] = {&s.p0[0], &s.p0[1], &s.p1,    &s.d0[0], &s.d0[1],
                            &s.d1,    &s.x,     &s.n0[0], &s.n1,    &s.n0[1],
                            &s.k,     &s.j0,    &s.j1,    &s.c0,    &s.c1};
    for (size_t i = 0; i < sizeof laws / sizeof *laws; i++) {
        *laws[i] *= factor;
    }
    return s;
}

/* The values that *value points to in the frame, of all slices, one after the other. */
static void stack(oil_map *m, const double **value, int n)
{
    if (!*value) {
        return;
    }
    const ptrdiff_t at = *value - (const double *)(const void *)&m->frame;
    double *to = &m->stack[m->used];
    for (int k = 0; k < OIL_SLICES; k++) {
        const double *from = (const double *)(const void *)&m->slice[k] + at;
        memcpy(to + k * n, from, (size_t)n * sizeof *from);
    }
    m->used += OIL_SLICES * n;
    *value = to;
}

static void stack_1(oil_map *m, gm_table1 *t)
{
    stack(m, &t->value, t->x.n);
}

static void stack_2(oil_map *m, gm_table2 *t)
{
    stack(m, &t->value, t->x.n * t->y.n);
}

static void stack_path(oil_map *m, int p)
{
    gm_path *path = &m->frame.map.path[p];
    for (int d = 0; d < 2; d++) {
        for (int g = 0; g < path->n_gears; g++) {
            stack_2(m, &m->frame.gear[p][g].load_loss[d]);
            stack_1(m, &m->frame.gear[p][g].pin[d]);
            stack_1(m, &m->frame.line[p][g].jump[d]);
        }
        for (int o = 0; o < 2; o++) {
            stack_2(m, &path->drag[d][o]);
            stack_2(m, &path->reaction[d][o]);
        }
    }
}

void oil_build(const hand_spec *specs, const double *bend, oil_map *m)
{
    memset(m, 0, sizeof *m);
    hand_build(&specs[0], &m->frame);
    for (int k = 0; k < OIL_SLICES; k++) {
        hand_build(&specs[k], &m->slice[k]);
    }
    for (int p = 0; p < m->frame.map.n_paths; p++) {
        stack_path(m, p);
    }
    for (int c = 0; c < m->frame.map.n_configurations; c++) {
        for (int d = 0; d < 2; d++) {
            gm_configuration *at = &m->frame.configuration[c];
            stack_1(m, &at->parasitic[d]);
            stack(m, &at->both_loaded[d].value, HAND_X * HAND_X * HAND_X);
        }
    }
    stack_1(m, &m->frame.map.coupling);
    memcpy(m->bend, bend, sizeof m->bend);
    m->frame.map.oil = (gm_oil_axis){OIL_SLICES, oil_temperatures, m->bend};
}
