/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A shaft as stations and pieces. A piece of length L twists by T L / (G J_p) under the
 * torque T, J_p = pi/32 (d^4 - d_i^4) (Saint-Venant, circular cross-sections; that gears
 * stiffen the shaft under their width is left out). The inertia of each length is lumped
 * in halves to the stations at its ends.
 */
#include "model/torsion.h"

#include "base/alloc.h"
#include "model/inertia.h"
#include "model/power.h"

#include <math.h>
#include <stdlib.h>

static const double same_station = 1e-3; /* m */

static double overlap(const gm_segment *s, double x_0, double x_1)
{
    return fmax(fmin(s->to, x_1) - fmax(s->from, x_0), 0.0);
}

double gm_shaft_stiffness(const gm_shaft *shaft, double x_0, double x_1)
{
    double flexibility = 0.0;
    for (int i = 0; i < shaft->n_segments; i++) {
        const gm_segment *s = &shaft->segments[i];
        double J_p = GM_PI / 32.0 * (pow(s->diameter, 4.0) - pow(s->bore, 4.0));
        flexibility += overlap(s, x_0, x_1) / (GM_STEEL_SHEAR_MODULUS * J_p);
    }
    return 1.0 / flexibility;
}

double gm_flange_position(const gm_shaft *shaft)
{
    if (!isnan(shaft->flange))
        return shaft->flange;
    double low = shaft->n_segments > 0 ? shaft->segments[0].from : 0.0;
    for (int i = 1; i < shaft->n_segments; i++)
        low = fmin(low, shaft->segments[i].from);
    return low;
}

static int has_flange(const gm_description *d, int s)
{
    int found = d->output == s;
    for (int p = 0; p < d->n_paths; p++)
        found |= d->paths[p].shaft == s;
    return found;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Positions of all that sits on the shaft; each place once, at its first. */
static int collect(const gm_description *d, int s, double *x)
{
    int n = 0, kept = 0;
    if (has_flange(d, s))
        x[n++] = gm_flange_position(&d->shafts[s]);
    for (int w = 0; w < d->n_wheels; w++)
        if (d->wheels[w].shaft == s)
            x[n++] = d->wheels[w].position;
    qsort(x, (size_t)n, sizeof *x, ascending);
    for (int i = 0; i < n; i++)
        if (kept == 0 || x[i] - x[kept - 1] >= same_station)
            x[kept++] = x[i];
    return kept;
}

/* Inertia of the shaft's cylinders between two places. */
static double inertia_between(const gm_shaft *shaft, double x_0, double x_1)
{
    double J = 0.0;
    for (int i = 0; i < shaft->n_segments; i++) {
        const gm_segment *s = &shaft->segments[i];
        J += gm_cylinder_inertia(GM_STEEL_DENSITY, overlap(s, x_0, x_1), s->diameter,
                                 s->bore);
    }
    return J;
}

static void lump(const gm_shaft *shaft, gm_stations *st)
{
    const double far = 1e3;
    double sum = 0.0;
    for (int i = 0; i < st->n; i++) {
        double before = i > 0 ? st->x[i - 1] : st->x[i] - far;
        double after = i < st->n - 1 ? st->x[i + 1] : st->x[i] + far;
        st->share[i] =
            (i > 0 ? 0.5 : 1.0) * inertia_between(shaft, before, st->x[i]) +
            (i < st->n - 1 ? 0.5 : 1.0) * inertia_between(shaft, st->x[i], after);
        sum += st->share[i];
    }
    for (int i = 0; i < st->n; i++)
        st->share[i] = sum > 0.0 ? st->share[i] / sum : 1.0 / st->n;
}

gm_status gm_stations_make(const gm_description *description, int s,
                           gm_stations *stations, gm_error *error)
{
    const gm_shaft *shaft = &description->shafts[s];
    size_t n_max = (size_t)description->n_wheels + 1;
    gm_stations st = {.x = gm_calloc(n_max, sizeof *st.x),
                      .share = gm_calloc(n_max, sizeof *st.share),
                      .stiffness = gm_calloc(n_max, sizeof *st.stiffness)};
    if (!st.x || !st.share || !st.stiffness) {
        gm_stations_clear(&st);
        return gm_fail(error, GM_ERR_MEMORY, "out of memory");
    }
    st.n = shaft->torsion == GM_TORSION_ELASTIC ? collect(description, s, st.x) : 1;
    if (st.n < 1)
        st.n = 1;
    for (int i = 0; i + 1 < st.n; i++)
        st.stiffness[i] = gm_shaft_stiffness(shaft, st.x[i], st.x[i + 1]);
    lump(shaft, &st);
    *stations = st;
    return GM_OK;
}

void gm_stations_clear(gm_stations *stations)
{
    gm_free(stations->x);
    gm_free(stations->share);
    gm_free(stations->stiffness);
    *stations = (gm_stations){0, NULL, NULL, NULL};
}

int gm_station_at(const gm_stations *stations, double x)
{
    int best = 0;
    for (int i = 1; i < stations->n; i++)
        if (fabs(stations->x[i] - x) < fabs(stations->x[best] - x))
            best = i;
    return best;
}
