/* SPDX-License-Identifier: BSD-2-Clause
 *
 * The spring with backlash between an engaged path and the output, fidelity lash. Twist
 * theta, slip s = dtheta/dt, compression e = max(0, |theta| - lash/2) of the flank that
 * carries, u = |theta| - lash/2:
 *
 *   T = sgn(theta) k e + q(u) s [d + d_l (1 + y) / (1 + y + y^2)],    y = |s| / v
 *
 * with q = 1 in contact, 0.05 in the middle of the gap. In between, over the depth `film`
 * before contact, q rises as 3t^2 - 2t^3: the oil film between the flanks is squeezed. So
 * contact enters without a jump of damping, and a path that carries nothing comes to rest
 * on its flank instead of bouncing on it. The meshes of the detailed gearset have the
 * same law.
 *
 * d_l is what idling gears take that hang in the oil of their backlash (model/loose.h),
 * most of all where there are any. They take part in small vibrations and are shaken off
 * by large ones: beyond v = 1 rad/s their share goes over to a constant torque d_l v. q
 * and that share are read where a sub-step begins, so the damper is linear over it.
 *
 * Over a sub-step of h from theta to theta + h s, F is the mean over the way, [U(theta +
 * h s) - U(theta)] / (h s) with U = k e^2/2: what the spring takes is exactly what it
 * stores, also when contact closes or opens on the way or the whole lash is crossed.
 * (Energy-momentum method: O. Gonzalez, J. Nonlinear Sci. 6 (1996) 449-467.) In sub-
 * steps that are too long for the vibration the part late of F is taken at their end, as
 * mean speeds are; what that costs is the vibration's energy: late (k e+ h s - U+ + U)
 * >= 0.
 */
#include "reduced_parts.h"

/* One flank over the way: compressions at its two ends, the way into the contact. */
typedef struct flank {
    gm_real e, e_end, way;
} flank;

static flank flank_of(gm_real half_lash, gm_real twist, gm_real way)
{
    const flank f = {gm_not_below_zero(twist - half_lash),
                     gm_not_below_zero(twist + way - half_lash), way};
    return f;
}

/* Mean of k e over the way, and its derivative to the way. */
static gm_real mean_force(const flank *f, gm_real k, gm_real *slope)
{
    gm_real force;
    if (f->e > 0 && f->e_end > 0) {
        *slope = k / 2;
        return k / 2 * (f->e + f->e_end);
    }
    if (f->e_end > 0) {
        force = k / 2 * f->e_end * (f->e_end / f->way);
        *slope = (k * f->e_end - force) / f->way;
        return force;
    }
    force = -k / 2 * f->e * (f->e / f->way);
    *slope = -force / f->way;
    return force;
}

/* Share of the contact's damping that is left in the middle of the gap. */
#define FILM_IN_GAP GM_NUM(0.05)

/* q(u) and its derivative. */
static gm_real film_share(const gm_gear *gear, gm_real u, gm_real *slope)
{
    *slope = 0;
    if (u >= 0) {
        return 1;
    }
    if (u <= -gear->film) {
        return FILM_IN_GAP;
    }
    const gm_real t = 1 + u / gear->film;
    *slope = (1 - FILM_IN_GAP) * 6 * t * (1 - t) / gear->film;
    return FILM_IN_GAP + (1 - FILM_IN_GAP) * t * t * (3 - 2 * t);
}

#define LOOSE_SPEED GM_NUM(1.0) /* rad/s, v */

/* (1 + y) / (1 + y + y^2) at y = |s| / v, and the derivative of its product with s. */
static gm_real loose_share(gm_real slip, gm_real *slope)
{
    const gm_real y = gm_abs(slip) / LOOSE_SPEED, whole = 1 + y + y * y;
    *slope = (1 + 2 * y) / (whole * whole);
    return (1 + y) / whole;
}

gm_real gm_spring_damping(const gm_gear *gear, gm_real twist, gm_real slip)
{
    gm_real unused;
    const gm_real q = film_share(gear, gm_abs(twist) - gear->lash / 2, &unused);
    return q * (gear->damping + gear->loose_damping * loose_share(slip, &unused));
}

/* Add the spring of the flank that is loaded where sign * twist > 0. */
static void add_flank(const gm_gear *gear, const gm_stride *stride, const flank *f,
                      gm_real sign, gm_spring *t)
{
    const gm_real k = gear->stiffness, late = stride->late;
    gm_real slope, force = mean_force(f, k, &slope);
    force += late * (k * f->e_end - force);
    slope += late * ((f->e_end > 0 ? k : 0) - slope);
    t->slope += slope * stride->h;
    t->torque += sign * force;
    if (late > 0) {
        const gm_real stored = k / 2 * (f->e_end - f->e) * (f->e_end + f->e);
        t->power += late * (k * f->e_end * f->way - stored) / stride->h;
    }
}

gm_spring gm_spring_at(const gm_gear *gear, gm_real twist, const gm_stride *stride)
{
    const gm_real half = gear->lash / 2, way = stride->h * stride->slip;
    const flank up = flank_of(half, twist, way), down = flank_of(half, -twist, -way);
    const gm_real d = stride->damping, slip = stride->slip;
    gm_spring t = {d * slip, d, d * slip * slip};
    if (up.e > 0 || up.e_end > 0) {
        add_flank(gear, stride, &up, 1, &t);
    }
    if (down.e > 0 || down.e_end > 0) {
        add_flank(gear, stride, &down, -1, &t);
    }
    return t;
}

gm_spring_gradient gm_spring_gradient_at(const gm_gear *gear, gm_real twist, gm_real slip)
{
    const gm_real side = twist < 0 ? -1 : 1, u = side * twist - gear->lash / 2;
    gm_real rise, slope;
    const gm_real share = loose_share(slip, &slope);
    const gm_real q = film_share(gear, u, &rise);
    const gm_real d = gear->damping + gear->loose_damping * share;
    const gm_real d_slip = gear->damping + gear->loose_damping * slope;
    gm_spring_gradient g;
    rise *= side * d;
    g.torque_twist = rise * slip + (u > 0 ? gear->stiffness : 0);
    g.torque_slip = q * d_slip;
    g.power_twist = rise * slip * slip;
    g.power_slip = q * slip * (d + d_slip);
    return g;
}

gm_real gm_spring_rest_torque(const gm_gear *gear, gm_real twist)
{
    const gm_real e = gm_not_below_zero(gm_abs(twist) - gear->lash / 2);
    return twist < 0 ? -gear->stiffness * e : gear->stiffness * e;
}

gm_real gm_spring_energy(const gm_gear *gear, gm_real twist)
{
    const gm_real e = gm_not_below_zero(gm_abs(twist) - gear->lash / 2);
    return gear->stiffness / 2 * e * e;
}

/* ---- springs and slips together ----
 *
 * Looked for are torques T_u with T_u = T(free - y (T_u - reference)). T is monotone and
 * y positive (semi)definite but for the small effect of losses, so this is the minimum
 * of a convex function of the slips. Newton's method with a search along the line finds
 * it: the directional derivative psi = sum delta (T - T_u), delta the change of the
 * slips, must not have become large on the other side. Within one straight piece of T
 * the first Newton step is the solution. */

enum { GM_MEETINGS = 4, GM_LINE_TRIALS = 2 };

#define CLOSE GM_BY_TYPE(1e-11, 4e-6)    /* relative, of a spring's torque */
#define CLOSE_NM GM_BY_TYPE(1e-10, 1e-4) /* N.m */

typedef struct meeting {
    gm_real slip[GM_MAX_PATHS], used[GM_MAX_PATHS]; /* slips, the torques behind them */
    gm_spring spring[GM_MAX_PATHS];                 /* at these slips */
} meeting;

static void read_springs(const gm_drive *d, meeting *m)
{
    static const gm_spring none = {0, 0, 0};
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        const gm_stride stride = {d->h, m->slip[p], d->late, d->damping[p]};
        m->spring[p] =
            d->elastic[p] ? gm_spring_at(d->gear[p], d->twist[p], &stride) : none;
    }
}

static int is_met(const meeting *m)
{
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        if (gm_abs(m->spring[p].torque - m->used[p]) >
            CLOSE * gm_abs(m->used[p]) + CLOSE_NM) {
            return 0;
        }
    }
    return 1;
}

/* (1 + T' y) x = right, with the slopes of the springs in *m */
static void solve_pair(const gm_yield *yield, const meeting *m,
                       const gm_real right[GM_MAX_PATHS], gm_real x[GM_MAX_PATHS])
{
    const gm_real *y_0 = yield->y[0], *y_1 = yield->y[1];
    const gm_real g_0 = m->spring[0].slope, g_1 = m->spring[1].slope;
    const gm_real k_00 = 1 + g_0 * y_0[0], k_01 = g_0 * y_0[1];
    const gm_real k_10 = g_1 * y_1[0], k_11 = 1 + g_1 * y_1[1];
    const gm_real f = k_10 / k_00;
    x[1] = (right[1] - f * right[0]) / (k_11 - f * k_01);
    x[0] = (right[0] - k_01 * x[1]) / k_00;
}

static void yield_to(const gm_yield *yield, const gm_real torque[GM_MAX_PATHS],
                     gm_real slip[GM_MAX_PATHS])
{
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        slip[p] = -yield->y[p][0] * torque[0] - yield->y[p][1] * torque[1];
    }
}

/* *to: the part t of the way from *from. Returns psi there. */
static gm_real go(const gm_drive *d, const meeting *from,
                  const gm_real slip[GM_MAX_PATHS], const gm_real torque[GM_MAX_PATHS],
                  gm_real t, meeting *to)
{
    gm_real psi = 0;
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        to->slip[p] = from->slip[p] + t * slip[p];
        to->used[p] = from->used[p] + t * torque[p];
    }
    read_springs(d, to);
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        psi += slip[p] * (to->spring[p].torque - to->used[p]);
    }
    return psi;
}

/* One Newton step, shortened while it goes too far (regula falsi, Illinois). */
static void newton_step(const gm_drive *d, const gm_yield *yield, meeting *m)
{
    const meeting from = *m;
    gm_real error[GM_MAX_PATHS], torque[GM_MAX_PATHS], slip[GM_MAX_PATHS];
    gm_real low = 0, high = 1, psi_low = 0;
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        error[p] = from.spring[p].torque - from.used[p];
    }
    solve_pair(yield, &from, error, torque);
    yield_to(yield, torque, slip);
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        psi_low += slip[p] * error[p];
    }
    const gm_real close = -psi_low / 4;
    gm_real psi_high = go(d, &from, slip, torque, 1, m), psi = psi_high;
    for (int i = 0; i < GM_LINE_TRIALS && (psi > close || psi < -close); i++) {
        if (psi_high <= 0) {
            return; /* not far enough, but on the way */
        }
        const gm_real t = low + (high - low) * (psi_low / (psi_low - psi_high));
        psi = go(d, &from, slip, torque, t, m);
        if (psi > 0) {
            high = t;
            psi_high = psi;
            psi_low /= 2;
        } else {
            low = t;
            psi_low = psi;
            psi_high /= 2;
        }
    }
}

void gm_springs_meet(const gm_drive *d, const gm_yield *yield, gm_solution *s)
{
    gm_real *torque = s->point.spring, error[GM_MAX_PATHS], more[GM_MAX_PATHS],
            moved[GM_MAX_PATHS];
    meeting m = {
        {s->slip[0], s->slip[1]}, {torque[0], torque[1]}, {s->spring[0], s->spring[1]}};
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        error[p] = m.spring[p].torque - torque[p] +
                   m.spring[p].slope * (yield->free[p] - m.slip[p]);
    }
    solve_pair(yield, &m, error, more);
    yield_to(yield, more, moved);
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        m.slip[p] = yield->free[p] + moved[p];
        m.used[p] = torque[p] + more[p];
    }
    read_springs(d, &m);
    for (int i = 0; i < GM_MEETINGS && !is_met(&m); i++) {
        newton_step(d, yield, &m);
    }
    for (int p = 0; p < GM_MAX_PATHS; p++) {
        s->slip[p] = m.slip[p];
        s->spring[p] = m.spring[p];
        s->spring[p].power += (m.used[p] - m.spring[p].torque) * m.slip[p];
        torque[p] = m.used[p];
    }
}
