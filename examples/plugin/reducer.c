/* SPDX-License-Identifier: BSD-2-Clause
 *
 * A compiled gearset model for Gearmap: a reducer of an electric drive with two speeds,
 * and the template for your own. It needs gm_plugin.h alone.
 *
 * The model is rigid: with a gear engaged the input turns r times as fast as the output,
 *
 *   (J_out + r^2 J_in) dw_o/dt = T_o + r tau_in - loss
 *
 * and in neutral both sides turn on their own. The loss is bearing drag at both sides
 * and a share of the power through the teeth. Where a real model would call its solver,
 * this one takes small Runge-Kutta steps.
 */
#include "gm_plugin.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { OUTPUT = 0, INPUT = 1, SIDES = 2 };

typedef struct reducer {
    double ratio[3];       /* by gear; 0: neutral */
    double inertia[SIDES]; /* kg.m2 */
    double drag[SIDES];    /* N.m at 80 degC */
    double viscous[SIDES]; /* N.m.s */
    double tooth_loss;     /* share of the power */
    double speed[SIDES];   /* the state, rad/s */
    int gear;
} reducer;

/* Coulomb friction with its jump rounded over +-0.02 rad/s. */
static double sign_of(double w)
{
    return tanh(w / 0.02);
}

static double bearing(const reducer *r, int side, double w, double temperature)
{
    double thin = exp(-0.015 * (temperature - 353.15));
    return r->drag[side] * sign_of(w) + thin * r->viscous[side] * w;
}

static void rates(const reducer *r, const gearmap_plugin_input *in, const double *w,
                  double *a)
{
    double ratio = r->ratio[r->gear];
    double oil = in->oil_temperature;
    double input = in->value[INPUT] - bearing(r, INPUT, w[INPUT], oil);
    double output = in->value[OUTPUT] - bearing(r, OUTPUT, w[OUTPUT], oil);
    if (ratio == 0.0) {
        a[INPUT] = input / r->inertia[INPUT];
        a[OUTPUT] = output / r->inertia[OUTPUT];
        return;
    }
    double inertia = r->inertia[OUTPUT] + ratio * ratio * r->inertia[INPUT];
    double tooth = r->tooth_loss * fabs(input) * sign_of(w[INPUT]);
    a[OUTPUT] = (output + ratio * (input - tooth)) / inertia;
    a[INPUT] = ratio * a[OUTPUT];
}

static void small_step(reducer *r, const gearmap_plugin_input *in, double h)
{
    double a[SIDES], middle[SIDES];
    rates(r, in, r->speed, a);
    for (int i = 0; i < SIDES; i++)
        middle[i] = r->speed[i] + 0.5 * h * a[i];
    rates(r, in, middle, a);
    for (int i = 0; i < SIDES; i++)
        r->speed[i] += h * a[i];
}

/* ---- the interface ---- */

static void *create(int n, const char *const *names, const double *values)
{
    reducer *r = calloc(1, sizeof *r);
    if (!r)
        return NULL;
    *r = (reducer){.ratio = {0.0, 12.5, 7.2},
                   .inertia = {0.15, 0.008},
                   .drag = {0.8, 0.05},
                   .viscous = {0.01, 0.0004},
                   .tooth_loss = 0.015};
    for (int i = 0; i < n; i++) {
        if (strcmp(names[i], "tooth_loss") != 0) {
            free(r);
            return NULL; /* a name that is not known */
        }
        r->tooth_loss = values[i];
    }
    return r;
}

static void destroy(void *instance)
{
    free(instance);
}

static void look(const reducer *r, gearmap_plugin_output *out)
{
    out->speed[OUTPUT] = r->speed[OUTPUT];
    out->speed[INPUT] = r->speed[INPUT];
}

static int start(void *instance, const gearmap_plugin_input *in,
                 gearmap_plugin_output *out)
{
    reducer *r = instance;
    if (in->gear[0] < 0 || in->gear[0] > 2)
        return 1;
    r->gear = in->gear[0];
    r->speed[INPUT] = r->speed[OUTPUT] = 0.0;
    look(r, out);
    return 0;
}

static int step_by(void *instance, const gearmap_plugin_input *in, double h,
                   gearmap_plugin_output *out)
{
    reducer *r = instance;
    int n = (int)ceil(h / 1e-4);
    for (int i = 0; i < n; i++)
        small_step(r, in, h / n);
    look(r, out);
    return 0;
}

static const char *message(const void *instance)
{
    return instance ? "there is no such gear" : "there is no such parameter";
}

const gearmap_plugin *gearmap_plugin_get(void)
{
    static const gearmap_plugin model = {.version = GEARMAP_PLUGIN_VERSION,
                                         .name = "reducer",
                                         .n_paths = 1,
                                         .create = create,
                                         .destroy = destroy,
                                         .start = start,
                                         .step_by = step_by,
                                         .message = message};
    return &model;
}
