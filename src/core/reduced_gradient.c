/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Derivatives of the outputs along one direction: gm_reduced_gradient.h. d.. is the
 * change of .. At an instant (d->h = 0) each balance has one unknown:
 *
 *   [J_out + sum_E J_p r q_p] da = dtau_o + sum_E (q_p dg_p - r D_o dw_o) - d(P + X)
 *                                  - sum_N dR               q = r (1 - D_tau) - X_tau
 *   J_n db = dg_n - dN                          dg_0 = dtau_0 - dC, dg_1 = dtau_1 + dC
 *
 * with D_o, D_tau, X_tau the tables' gradients. To loss_scale all loss torques are
 * proportional.
 */
#include "gm_reduced_gradient.h"
#include "reduced_parts.h"

/* A direction with all that follows from it. */
typedef struct change {
    gm_real m[GM_SHAFTS], g[GM_MAX_PATHS]; /* speeds; torques dg */
    gm_real a[GM_SHAFTS], tau_m[GM_MAX_PATHS];
    gm_terms terms; /* of the values in it; the gradients are unused */
} change;

/* ---- what follows from a direction ---- */

static gm_terms terms_of(const gm_drive *d, const gm_solution *s)
{
    gm_solution copy = *s;
    gm_point at = s->point;
    gm_terms_at(d, &copy, &at);
    return copy.terms;
}

/* Terms at the solution; *unit: what they are there for a loss_scale of 1. */
static void terms_here(const gm_drive *d, gm_solution *s, gm_terms *unit)
{
    gm_drive of_one = *d;
    gm_terms_at(d, s, &s->point);
    of_one.scale = 1;
    const gm_real coupling = terms_of(&of_one, s).coupling;
    of_one.coupled = 0; /* the transmitted torques stay what they are */
    of_one.tau[0] -= s->terms.coupling;
    of_one.tau[1] += s->terms.coupling;
    *unit = terms_of(&of_one, s);
    unit->coupling = coupling;
}

static void change_speeds(const gm_drive *d, const gm_solution *s, int still,
                          const gm_reduced_change *by, change *c)
{
    c->m[GM_OUT] = still ? 0 : by->w_o;
    for (int p = 0; p < d->n_paths; p++) {
        const gm_real own = s->held[p] ? 0 : by->w[p];
        c->m[p] = d->engaged[p] ? d->ratio[p] * c->m[GM_OUT] : own;
    }
}

/* Drags and reactions of free paths and the coupling: what follows from speeds alone. */
static void change_drags(const gm_drive *d, const gm_solution *s, const gm_terms *unit,
                         const gm_reduced_change *by, change *c)
{
    const gm_terms *t = &s->terms;
    const gm_real m_o = c->m[GM_OUT], scale = by->loss_scale;
    const gm_real d_c = t->coupling_w * (c->m[0] - c->m[1]) + scale * unit->coupling;
    c->terms.coupling = d_c;
    for (int p = 0; p < d->n_paths; p++) {
        const gm_path_terms *path = &t->path[p], *one = &unit->path[p];
        gm_path_terms *to = &c->terms.path[p];
        c->g[p] = by->path_tau[p] + (p == 0 ? -d_c : d_c);
        to->drag = path->drag_n * c->m[p] + path->drag_o * m_o + scale * one->drag;
        to->reaction =
            path->reaction_n * c->m[p] + path->reaction_o * m_o + scale * one->reaction;
    }
}

/* Changes of the load losses, of P and of X without what the transmitted torques add. */
static void change_by_speed(const gm_drive *d, const gm_solution *s, const gm_terms *unit,
                            const gm_reduced_change *by, change *c)
{
    const gm_real m_o = c->m[GM_OUT];
    c->terms.out = s->terms.out_o * m_o + by->loss_scale * unit->out;
    for (int p = 0; p < d->n_paths; p++) {
        c->terms.path[p].load =
            s->terms.path[p].load_o * m_o + by->loss_scale * unit->path[p].load;
    }
}

static void change_accelerations(const gm_drive *d, const gm_solution *s, int still,
                                 gm_real tau_o, change *c)
{
    const gm_terms *t = &s->terms;
    gm_real inertia = d->map->inertia_output, sum = tau_o - c->terms.out;
    for (int p = 0; p < d->n_paths; p++) {
        const gm_path_terms *path = &c->terms.path[p];
        const gm_real r = d->ratio[p];
        if (d->engaged[p]) {
            const gm_real q = r * (1 - t->path[p].load_tau) - t->out_tau[p];
            inertia += d->inertia[p] * r * q;
            sum += q * c->g[p] - r * path->load;
        } else {
            sum -= path->reaction;
            c->a[p] = s->held[p] ? 0 : (c->g[p] - path->drag) / d->inertia[p];
        }
    }
    c->a[GM_OUT] = still ? 0 : sum / inertia;
}

/* What the transmitted torques add. */
static void change_by_torque(const gm_drive *d, const gm_solution *s, change *c)
{
    for (int p = 0; p < d->n_paths; p++) {
        if (d->engaged[p]) {
            c->a[p] = d->ratio[p] * c->a[GM_OUT];
            c->tau_m[p] = c->g[p] - d->inertia[p] * c->a[p];
            c->terms.path[p].load += s->terms.path[p].load_tau * c->tau_m[p];
            c->terms.out += s->terms.out_tau[p] * c->tau_m[p];
        }
    }
}

/* All of it; the terms of *s are renewed at its point. still: the output stays at rest,
 * also where its terms are those of one that is about to break away. */
static change follow(const gm_drive *d, gm_solution *s, int still,
                     const gm_reduced_change *by)
{
    static const change none = {{0}, {0}, {0}, {0}, {.out = 0}};
    change c = none;
    gm_terms unit;
    terms_here(d, s, &unit);
    change_speeds(d, s, still, by, &c);
    change_drags(d, s, &unit, by, &c);
    change_by_speed(d, s, &unit, by, &c);
    change_accelerations(d, s, still, by->output_tau, &c);
    change_by_torque(d, s, &c);
    return c;
}

/* ---- what is told of it ---- */

/* Product rule on gm_loss_power. */
static gm_real change_of_power(const gm_drive *d, const gm_solution *s, const change *c)
{
    const gm_terms *t = &s->terms, *dt = &c->terms;
    const gm_real *m = s->point.m, *dm = c->m;
    const gm_real m_o = m[GM_OUT], dm_o = dm[GM_OUT];
    gm_real sum = dt->out * m_o + t->out * dm_o + dt->coupling * (m[0] - m[1]) +
                  t->coupling * (dm[0] - dm[1]);
    for (int p = 0; p < d->n_paths; p++) {
        const gm_path_terms *a = &t->path[p], *da = &dt->path[p];
        if (d->engaged[p]) {
            sum += da->load * m[p] + a->load * dm[p];
        } else {
            sum += da->drag * m[p] + a->drag * dm[p] + da->reaction * m_o +
                   a->reaction * dm_o + d->cone[p] * (dm[p] - d->ratio[p] * dm_o);
        }
    }
    return sum;
}

/* Loss torques on the output's balance. */
static gm_real sum_on_output(const gm_drive *d, const gm_terms *t)
{
    gm_real sum = t->out;
    for (int p = 0; p < d->n_paths; p++) {
        sum += d->engaged[p] ? d->ratio[p] * t->path[p].load : t->path[p].reaction;
    }
    return sum;
}

/* While friction holds the output, its loss torques are one share of what they are where
 * it breaks away: share = applied/limit. */
static void change_holding(const gm_drive *d, const gm_solution *s,
                           const gm_reduced_change *by, change *c)
{
    gm_terms t;
    gm_real share, d_applied = by->output_tau;
    gm_solution loose = *s;
    loose.sign[GM_OUT] = gm_holding(d, s, &t, &share);
    loose.held[GM_OUT] = 0;
    const change at = follow(d, &loose, 1, by);
    for (int p = 0; p < d->n_paths; p++) {
        d_applied += d->engaged[p] ? d->ratio[p] * at.g[p] : 0;
    }
    const gm_real limit = sum_on_output(d, &t);
    const gm_real d_share =
        limit != 0 ? (d_applied - share * sum_on_output(d, &at.terms)) / limit : 0;
    c->terms.out = share * at.terms.out + d_share * t.out;
    for (int p = 0; p < d->n_paths; p++) {
        const gm_path_terms *path = &at.terms.path[p];
        c->terms.path[p].load = share * path->load + d_share * t.path[p].load;
        c->terms.path[p].reaction = share * path->reaction + d_share * t.path[p].reaction;
    }
}

static void tell_path(const gm_drive *d, const gm_solution *s, int p, const change *c,
                      const gm_reduced_change *by, gm_reduced_outputs *o)
{
    const gm_path_terms *t = &c->terms.path[p];
    const gm_real d_c = p == 0 ? c->terms.coupling : -c->terms.coupling;
    o->a[p] = c->a[p];
    if (d->engaged[p]) {
        o->transmitted[p] = c->tau_m[p];
        o->path_loss_torque[p] = t->load;
        return;
    }
    o->path_loss_torque[p] = s->held[p] ? by->path_tau[p] : t->drag + d_c;
    o->output_loss_torque += t->reaction;
    o->kinetic_energy += d->inertia[p] * d->w[p] * c->m[p];
}

int gm_reduced_derivative(const gm_reduced_map *map, const gm_reduced_params *params,
                          const gm_reduced_inputs *inputs, const gm_reduced_modes *modes,
                          gm_reduced_state *state, const gm_reduced_change *by,
                          gm_reduced_outputs *derivative)
{
    static const gm_reduced_outputs zero = {0};
    gm_drive d;
    gm_solution s;
    gm_reduced_outputs o = zero;
    if (!gm_inputs_are_finite(map, inputs)) {
        return GM_FLAG_NOT_FINITE;
    }
    gm_solve_at(map, params, inputs, modes, state, &d, &s);
    change c = follow(&d, &s, s.held[GM_OUT], by);
    o.loss_power = change_of_power(&d, &s, &c);
    if (s.held[GM_OUT]) {
        change_holding(&d, &s, by, &c);
    }
    o.a_o = c.a[GM_OUT];
    o.output_loss_torque = c.terms.out;
    o.kinetic_energy = d.inertia[GM_OUT] * d.w[GM_OUT] * c.m[GM_OUT];
    for (int p = 0; p < d.n_paths; p++) {
        tell_path(&d, &s, p, &c, by, &o);
    }
    if (!gm_is_finite(o.a_o + o.a[0] + o.a[1] + o.loss_power + o.kinetic_energy +
                      o.output_loss_torque)) {
        return GM_FLAG_NOT_FINITE;
    }
    *derivative = o;
    return s.terms.outside ? GM_FLAG_OUT_OF_MAP : 0;
}
