# SPDX-License-Identifier: BSD-2-Clause
"""Torques and gears of an ECE-15 run on a rig: the urban cycle of UN ECE Regulation 83
(annex 4a, appendix 1: speeds and gears for manual transmissions) driven by a small car,
gear 1 and 3 on path odd, 2 on path even. The engine gives what the car needs, the brake
at the output follows the cycle's speed. All torques are held for HOLD seconds."""

HOLD = 0.2
DURATION = 195.0
SPEEDS = [  # s, km/h
    (0, 0), (11, 0), (15, 15), (23, 15), (25, 10), (28, 0), (49, 0), (54, 15), (56, 15),
    (61, 32), (85, 32), (93, 10), (96, 0), (117, 0), (122, 15), (124, 15), (133, 35),
    (135, 35), (143, 50), (155, 50), (163, 35), (176, 35), (178, 35), (185, 10), (188, 0),
    (195, 0)]
DRIVING = [  # from s: gear that carries the engine's torque, 0: clutches open
    (0, 0), (11, 1), (25, 0), (49, 1), (55, 2), (93, 0), (117, 1), (123, 2), (134, 3),
    (177, 2), (185, 0)]
SELECTED = [  # from s: gears of the two paths; the next one is selected before it drives
    (0, (0, 0)), (2, (0, -1)), (4, (0, 0)), (6, (1, 0)), (20, (1, 2)), (26, (1, 0)),
    (28, (0, 0)), (30, (0, -1)), (33, (0, 2)), (36, (0, 0)), (44, (1, 0)), (50, (1, 2)),
    (57, (0, 2)), (64, (3, 2)), (84, (1, 2)), (95, (1, 0)), (96, (0, 0)), (100, (0, -1)),
    (102, (0, 2)), (104, (0, 0)), (112, (1, 0)), (118, (1, 2)), (126, (3, 2)),
    (140, (3, 0)), (150, (3, 2)),
    (179, (0, 2)), (182, (1, 2)), (187, (1, 0)), (188, (0, 0)), (190, (0, -1)),
    (193, (0, 0))]

MASS, RADIUS, CD_A, ROLLING = 1416.0, 0.316, 0.608, 0.009  # kg, m, m2, 1: compact car
AIR, GRAVITY = 1.2, 9.81  # kg/m3, m/s2
PART = 1.0  # s, over which the clutches hand over


def shifts():
    """Number of changes of a gear command."""
    gears = [g for _, g in SELECTED]
    return sum(a[p] != b[p] for a, b in zip(gears, gears[1:]) for p in range(2))


def speed(t):
    """Of the output shaft [rad/s], and its slope."""
    t = min(max(t, 0.0), DURATION - 1e-9)
    for (t0, v0), (t1, v1) in zip(SPEEDS, SPEEDS[1:]):
        if t0 <= t < t1:
            slope = (v1 - v0) / (t1 - t0) / 3.6 / RADIUS
            return v0 / 3.6 / RADIUS + slope * (t - t0), slope
    raise AssertionError(t)


def at(table, t):
    return [x for start, x in table if start <= t + 1e-9][-1]


def shares(t):
    """Of the torque by gear: the old one hands over to the new one."""
    now, before = at(DRIVING, t), at(DRIVING, max(t - PART, 0.0))
    begin = max(start for start, _ in DRIVING if start <= t + 1e-9)
    x = min((t - begin) / PART, 1.0)
    if now == before or 0 in (now, before):
        return {now: x if before == 0 else 1.0}
    return {before: 1.0 - x, now: x}


def demand(t):
    """Torque on the wheels [N.m]."""
    w, slope = speed(t)
    v = w * RADIUS
    force = MASS * slope * RADIUS + (ROLLING * MASS * GRAVITY if w else 0.0) \
        + AIR * CD_A * v * v / 2
    return force * RADIUS


def command(t, ratios, w, inertia):
    """Inputs for the next HOLD seconds: w is the output's speed now."""
    total = demand(t + HOLD / 2)
    tau = {"odd.tau": 0.0, "even.tau": 0.0}
    for gear, share in shares(t).items():
        if gear:
            tau["even.tau" if gear == 2 else "odd.tau"] += share * total / ratios[gear]
    driven = sum(total * s for g, s in shares(t).items() if g)
    target = speed(t + HOLD)[0]
    tau["output.tau"] = -0.95 * driven + 0.5 * inertia * (target - w) / HOLD
    odd, even = at(SELECTED, t)
    return {**tau, "odd.gear": odd, "even.gear": even}


def record(host, ratios):
    """[(time, inputs)] of a run on the rig in Co-Simulation at 1 ms."""
    rows = []
    host.start({})
    for k in range(round(DURATION / HOLD)):
        inputs = command(k * HOLD, ratios, host.get("output.w"),
                         host.get("output.inertia"))
        host.set(inputs)
        rows.append((k * HOLD, inputs))
        host.step(1e-3, round(HOLD / 1e-3))
    return rows
