/* SPDX-License-Identifier: BSD-2-Clause
 *
 * Derivatives of the outputs along one direction: gm_reduced_gradient.h. d.. is the
 * change of .. At an instant (d->h = 0) each balance has one unknown:
 *
 *   [J_out + sum_R J_p r q_p] da = dtau_o + sum_R (q_p dg_p - r D_o dw_o)
 *       + sum_L r (dT_p - dD_p) - d(P + X) - sum_N dR        q = r (1 - D_tau) - X_tau
 *   J_p db = dg_p - dN - dT_p                   dg_0 = dtau_0 - dC, dg_1 = dtau_1 + dC
 *
 * over rigid (R), elastic (L) and free (N) paths, with D_o, D_tau, X_tau the tables'
 * gradients. All loss torques are proportional to loss_scale.
 */
#include "gm_reduced_gradient.h"
#include "reduced_parts.h"

/* Read with this factor on losses where the given one is zero: too small to be felt. */
#define TINY_SCALE GM_NUM(1e-30)

/* Loss torques; those of the same name in gm_terms. */
typedef struct losses {
    gm_real out, coupling;
    gm_real load[GM_MAX_PATHS], drag[GM_MAX_PATHS], reaction[GM_MAX_PATHS];
} losses;

/* A direction with all that follows from it. */
typedef struct change {
    gm_real m[GM_SHAFTS], g[GM_MAX_PATHS]; /* speeds; torques dg */
    gm_real spring[GM_MAX_PATHS];
    gm_real a[GM_SHAFTS], tau_m[GM_MAX_PATHS];
    gm_real tau[GM_SHAFTS]; /* at the flanges */
    losses terms;
} change;

static int is_rigid(const gm_drive *d, int p)
{
    return d->engaged[p] && !d->elastic[p];
}

/* ---- what follows from a direction ---- */

static void add_losses(gm_real factor, const gm_terms *from, losses *t)
{
    t->out += factor * from->out;
    t->coupling += factor * from->coupling;
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        t->load[p] += factor * from->path[p].load;
        t->drag[p] += factor * from->path[p].drag;
        t->reaction[p] += factor * from->path[p].reaction;
    }
}

/* The terms of *s at its point; what loss_scale and oil temperature alone change of them
 * in *t. */
static void terms_here(const gm_drive *d, gm_solution *s, const gm_reduced_change *by,
                       losses *t)
{
    gm_drive read = *d;
    read.scale = d->scale > TINY_SCALE ? d->scale : TINY_SCALE;
    gm_terms_at(&read, s, &s->point);
    add_losses(by->loss_scale / read.scale, &s->terms, t);
    gm_terms_at(d, s, &s->point);
    if (gm_has_oil_axis(d->map) && by->oil_temperature != 0) {
        gm_terms per_kelvin;
        gm_terms_by_oil(d, s, &per_kelvin);
        add_losses(by->oil_temperature, &per_kelvin, t);
    }
}

static void change_speeds(const gm_drive *d, const gm_solution *s, int still,
                          const gm_reduced_change *by, change *c)
{
    c->m[GM_OUT] = still ? 0 : by->w_o;
    for (int p = 0; p < d->n_paths; p++) {
        const gm_real own = s->held[p] ? 0 : by->w[p];
        c->m[p] = d->own[p] ? own : d->ratio[p] * c->m[GM_OUT];
    }
}

static gm_real change_of_slip(const gm_drive *d, const change *c, int p)
{
    return c->m[p] - d->ratio[p] * c->m[GM_OUT];
}

static gm_spring_gradient spring_here(const gm_drive *d, const gm_solution *s, int p)
{
    return gm_spring_gradient_at(d->gear[p], d->twist[p], gm_slip(d, &s->point, p));
}

/* Load losses, P and X with what the transmitted torque of path p adds. */
static void add_torque(const gm_solution *s, int p, gm_real d_tau, change *c)
{
    c->tau_m[p] = d_tau;
    c->terms.load[p] += s->terms.path[p].load_tau * d_tau;
    c->terms.out += s->terms.out_tau[p] * d_tau;
}

/* Flange torques that come in. */
static void start_torques(const gm_drive *d, const gm_reduced_change *by, change *c)
{
    c->tau[GM_OUT] = d->prescribed[GM_OUT] ? 0 : by->output_tau;
    for (int p = 0; p < d->n_paths; p++) {
        c->tau[p] = d->prescribed[p] ? 0 : by->path_tau[p];
    }
}

/* The torque that a prescribed flange takes: inertia a less what there is without it. */
static void tell_prescribed(const gm_drive *d, int k, gm_real torque, gm_real inertia,
                            const gm_reduced_change *by, change *c)
{
    if (d->prescribed[k]) {
        c->a[k] = by->a[k];
        c->tau[k] = inertia * by->a[k] - torque;
    }
}

static void change_path(const gm_drive *d, const gm_solution *s, int p,
                        const gm_reduced_change *by, change *c)
{
    const gm_path_terms *t = &s->terms.path[p];
    losses *to = &c->terms;
    const gm_real m_o = c->m[GM_OUT];
    c->g[p] = c->tau[p] + (p == 0 ? -c->terms.coupling : c->terms.coupling);
    to->load[p] += t->load_o * m_o;
    to->drag[p] += t->drag_n * c->m[p] + t->drag_o * m_o;
    to->reaction[p] += t->reaction_n * c->m[p] + t->reaction_o * m_o;
    if (d->elastic[p]) {
        const gm_spring_gradient spring = spring_here(d, s, p);
        c->spring[p] = spring.torque_twist * by->twist[p] +
                       spring.torque_slip * change_of_slip(d, c, p);
        add_torque(s, p, s->held[p] ? c->g[p] : c->spring[p] + to->drag[p], c);
    }
}

static void change_accelerations(const gm_drive *d, const gm_solution *s, int still,
                                 const gm_reduced_change *by, change *c)
{
    const gm_terms *t = &s->terms;
    gm_real inertia = d->inertia_own, sum = c->tau[GM_OUT] - c->terms.out;
    for (int p = 0; p < d->n_paths; p++) {
        const losses *to = &c->terms;
        const gm_real r = d->ratio[p];
        if (is_rigid(d, p)) {
            const gm_real q = r * (1 - t->path[p].load_tau) - t->out_tau[p];
            inertia += d->inertia[p] * r * q;
            sum += q * c->g[p] - r * to->load[p];
        } else {
            const gm_real torque = c->g[p] - to->drag[p] - c->spring[p];
            sum += d->elastic[p] ? r * (c->spring[p] - to->load[p]) : -to->reaction[p];
            c->a[p] = gm_moves(d, s, p) ? torque / d->inertia[p] : 0;
            tell_prescribed(d, p, torque, d->inertia[p], by, c);
        }
    }
    c->a[GM_OUT] = still || d->prescribed[GM_OUT] ? 0 : sum / inertia;
    tell_prescribed(d, GM_OUT, sum, inertia, by, c);
    for (int p = 0; p < d->n_paths; p++) {
        if (is_rigid(d, p)) {
            c->a[p] = d->ratio[p] * c->a[GM_OUT];
            add_torque(s, p, c->g[p] - d->inertia[p] * c->a[p], c);
        }
    }
}

/* All of it; the terms of *s are renewed at its point. still: the output stays at rest,
 * also where its terms are those of one that is about to break away. */
static change follow(const gm_drive *d, gm_solution *s, int still,
                     const gm_reduced_change *by)
{
    static const change none = {.m = {0}};
    change c = none;
    start_torques(d, by, &c);
    terms_here(d, s, by, &c.terms);
    change_speeds(d, s, still, by, &c);
    c.terms.coupling += s->terms.coupling_w * (c.m[0] - c.m[1]);
    c.terms.out += s->terms.out_o * c.m[GM_OUT];
    for (int p = 0; p < d->n_paths; p++) {
        change_path(d, s, p, by, &c);
    }
    change_accelerations(d, s, still, by, &c);
    return c;
}

/* ---- what is told of it ---- */

/* Product rule on gm_loss_power. */
static gm_real power_of_path(const gm_drive *d, const gm_solution *s, int p,
                             const gm_reduced_change *by, const change *c)
{
    const gm_path_terms *t = &s->terms.path[p];
    const losses *dt = &c->terms;
    const gm_real r = d->ratio[p], m = s->point.m[p], dm = c->m[p];
    const gm_real m_o = s->point.m[GM_OUT], dm_o = c->m[GM_OUT];
    const gm_real drag = dt->drag[p] * m + t->drag * dm;
    if (d->elastic[p]) {
        const gm_spring_gradient spring = spring_here(d, s, p);
        return r * (dt->load[p] * m_o + t->load * dm_o) + drag +
               spring.power_twist * by->twist[p] +
               spring.power_slip * change_of_slip(d, c, p);
    }
    if (d->engaged[p]) {
        return dt->load[p] * m + t->load * dm;
    }
    return drag + dt->reaction[p] * m_o + t->reaction * dm_o +
           d->cone[p] * change_of_slip(d, c, p);
}

static gm_real change_of_power(const gm_drive *d, const gm_solution *s,
                               const gm_reduced_change *by, const change *c)
{
    const gm_terms *t = &s->terms;
    const losses *dt = &c->terms;
    const gm_real *m = s->point.m, *dm = c->m;
    gm_real sum = dt->out * m[GM_OUT] + t->out * dm[GM_OUT] +
                  dt->coupling * (m[0] - m[1]) + t->coupling * (dm[0] - dm[1]);
    for (int p = 0; p < d->n_paths; p++) {
        sum += power_of_path(d, s, p, by, c);
    }
    return sum;
}

static losses values_of(const gm_terms *t)
{
    const losses values = {t->out,
                           t->coupling,
                           {t->path[0].load, t->path[1].load},
                           {t->path[0].drag, t->path[1].drag},
                           {t->path[0].reaction, t->path[1].reaction}};
    return values;
}

/* Loss torques on the output's balance. */
static gm_real sum_on_output(const gm_drive *d, const losses *t)
{
    gm_real sum = t->out;
    for (int p = 0; p < d->n_paths; p++) {
        sum += d->engaged[p] ? d->ratio[p] * t->load[p] : t->reaction[p];
    }
    return sum;
}

/* While friction holds the output, its loss torques are one share of what they are where
 * it breaks away: share = applied/limit. */
static void change_holding(const gm_drive *d, const gm_solution *s,
                           const gm_reduced_change *by, change *c)
{
    gm_solution loose = *s;
    gm_real share, d_applied = c->tau[GM_OUT];
    loose.sign[GM_OUT] = (gm_real)gm_holding(d, s, &loose.terms, &share);
    loose.held[GM_OUT] = 0;
    const losses t = values_of(&loose.terms);
    const change at = follow(d, &loose, 1, by);
    for (int p = 0; p < d->n_paths; p++) {
        const gm_real torque = d->elastic[p] ? at.spring[p] : at.g[p];
        d_applied += d->engaged[p] ? d->ratio[p] * torque : 0;
    }
    const gm_real limit = sum_on_output(d, &t);
    const gm_real d_share =
        limit != 0 ? (d_applied - share * sum_on_output(d, &at.terms)) / limit : 0;
    c->terms.out = share * at.terms.out + d_share * t.out;
    for (int p = 0; p < d->n_paths; p++) {
        c->terms.load[p] = share * at.terms.load[p] + d_share * t.load[p];
        c->terms.reaction[p] = share * at.terms.reaction[p] + d_share * t.reaction[p];
    }
}

/* What an elastic path loses at its flange, and what it stores. */
static void tell_elastic(const gm_drive *d, const gm_solution *s, int p, const change *c,
                         const gm_reduced_change *by, gm_reduced_outputs *o)
{
    const losses *t = &c->terms;
    const gm_real twist = d->twist[p];
    const gm_real e = gm_not_below_zero(gm_abs(twist) - d->gear[p]->lash / 2);
    o->twist_rate[p] = change_of_slip(d, c, p);
    o->path_loss_torque[p] =
        t->load[p] + (s->held[p] ? c->g[p] - c->spring[p] : t->drag[p]);
    o->elastic_energy += d->gear[p]->stiffness * (twist < 0 ? -e : e) * by->twist[p];
    o->kinetic_energy += d->inertia[p] * d->w[p] * c->m[p];
}

static void tell_path(const gm_drive *d, const gm_solution *s, int p, const change *c,
                      const gm_reduced_change *by, gm_reduced_outputs *o)
{
    const losses *t = &c->terms;
    const gm_real d_c = p == 0 ? c->terms.coupling : -c->terms.coupling;
    o->a[p] = c->a[p];
    o->tau[p] = c->tau[p];
    o->transmitted[p] = c->tau_m[p];
    if (d->elastic[p]) {
        tell_elastic(d, s, p, c, by, o);
    } else if (d->engaged[p]) {
        o->path_loss_torque[p] = t->load[p];
    } else {
        o->path_loss_torque[p] = s->held[p] ? c->tau[p] : t->drag[p] + d_c;
        o->output_loss_torque += t->reaction[p];
        o->kinetic_energy += d->inertia[p] * d->w[p] * c->m[p];
    }
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
    o.loss_power = change_of_power(&d, &s, by, &c);
    if (s.held[GM_OUT]) {
        change_holding(&d, &s, by, &c);
    }
    o.a_o = c.a[GM_OUT];
    o.tau[GM_OUT] = c.tau[GM_OUT];
    o.output_loss_torque = c.terms.out;
    o.kinetic_energy = d.inertia[GM_OUT] * d.w[GM_OUT] * c.m[GM_OUT];
    for (int p = 0; p < d.n_paths; p++) {
        tell_path(&d, &s, p, &c, by, &o);
    }
    if (!gm_outputs_are_finite(&o)) {
        return GM_FLAG_NOT_FINITE;
    }
    *derivative = o;
    return s.terms.outside ? GM_FLAG_OUT_OF_MAP : 0;
}
