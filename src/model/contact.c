/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Contact on both flanks. With the depth u = |x| - gap and s = sign x, spring force and
 * potential are
 *
 *   film:    u <= 0: 0;  0 < u < e: k u^2 / (2 e);  u >= e: k (u - e/2)
 *            U = k u^3 / (6 e), k (u (u - e) / 2 + e^2 / 6)
 *   dry:     k u for u > 0, U = k u^2 / 2
 *   linear:  k x
 *
 * and the damping force is, with d the damping in contact,
 *
 *   film:    d (f + (1 - f) S(1 + u/r)) v, r = min(e, gap),
 *            S(t) = 3 t^2 - 2 t^3, 0 below 0, 1 above 1
 *   dry:     of Modelica's ElastoBacklash (Modelica Standard Library 4): with
 *            c = k u and h = s d v, the force s max(0, c + min(c, h)): the damper never
 *            pulls and never pushes more than the spring
 *   linear:  d v
 *
 * The film is the oil between flanks. Squeezed, it resists approach and separation over
 * the whole gap, here by the share f of the damping in contact, and the more the thinner
 * it gets: over the last micrometres S raises the damping to its full value, so that it
 * is there before the spring is and lightly loaded flanks settle at once. The entry
 * depth e is of the order of the contact's own flattening. Film is once continuously
 * differentiable in x and linear in v, dry continuous. All are passive:
 * (F - dU/dx) v >= 0.
 */
#include "model/contact.h"

#include <math.h>

/* f + (1 - f) S(t) and its derivative by t. */
static double film_share(double f, double t, double *d_t)
{
    *d_t = 0.0;
    if (t <= 0.0)
        return f;
    if (t >= 1.0)
        return 1.0;
    *d_t = (1.0 - f) * 6.0 * t * (1.0 - t);
    return f + (1.0 - f) * t * t * (3.0 - 2.0 * t);
}

static gm_contact_force film(const gm_contact_law *law, double u, double s, double v)
{
    double e = law->entry, k = law->stiffness, d_share, spring = 0.0, slope = 0.0;
    double r = fmin(e, law->gap);
    double share = film_share(law->film, u < 0.0 ? 1.0 + u / r : 1.0, &d_share);
    if (u >= e) {
        slope = k;
        spring = k * (u - 0.5 * e);
    } else if (u > 0.0) {
        slope = k * u / e;
        spring = 0.5 * slope * u;
    }
    return (gm_contact_force){.value = s * spring + law->damping * share * v,
                              .d_x = slope +
                                     s * law->damping * (u < 0.0 ? d_share / r : 0.0) * v,
                              .d_v = law->damping * share,
                              .spring = s * spring};
}

static gm_contact_force dry(const gm_contact_law *law, double u, double s, double v)
{
    double c = law->stiffness * u, h = s * law->damping * v;
    if (u <= 0.0)
        return (gm_contact_force){0.0, 0.0, 0.0, 0.0};
    if (c + h <= 0.0)
        return (gm_contact_force){0.0, 0.0, 0.0, s * c};
    if (h >= c)
        return (gm_contact_force){2.0 * s * c, 2.0 * law->stiffness, 0.0, s * c};
    return (gm_contact_force){s * (c + h), law->stiffness, law->damping, s * c};
}

gm_contact_force gm_contact_force_at(const gm_contact_law *law, double x, double v)
{
    double s = x < 0.0 ? -1.0 : 1.0, u = fabs(x) - law->gap;
    switch (law->model) {
    case GM_CONTACT_FILM:
        return film(law, u, s, v);
    case GM_CONTACT_DRY:
        return dry(law, u, s, v);
    case GM_CONTACT_LINEAR:
        break;
    }
    return (gm_contact_force){law->stiffness * x + law->damping * v, law->stiffness,
                              law->damping, law->stiffness * x};
}

double gm_contact_energy(const gm_contact_law *law, double x)
{
    double u = fabs(x) - law->gap, k = law->stiffness, e = law->entry;
    if (law->model == GM_CONTACT_LINEAR)
        return 0.5 * k * x * x;
    if (u <= 0.0)
        return 0.0;
    if (law->model == GM_CONTACT_DRY)
        return 0.5 * k * u * u;
    return u < e ? k * u * u * u / (6.0 * e) : k * (0.5 * u * (u - e) + e * e / 6.0);
}
