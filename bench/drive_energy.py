# SPDX-License-Identifier: BSD-2-Clause
"""Energy account of an FMU, kept from outside.

    python bench/drive_energy.py build/dct7.fmu build/dct7.map

Drives away through four gears, stops, is held on a hill and drives away again: 60 s at
several communication steps. The work of the flanges is summed as torque times angle; the
losses are read from the map's file with a separate interpolation at the recorded speeds
and torques; kinetic energy follows from the map's inertias. None of these comes from the
component. Their difference shows the error of the component's time stepping: it must
fall with the step. The component's own account must close to rounding at any step.
"""

import argparse
import math
import shutil
import sqlite3

import numpy
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

RPM = math.pi / 30
END = 60.0
MASS, WHEEL = 1416.0, 0.316            # kg, m
ROLLING, AIR = 0.009, 0.5 * 1.2 * 0.6078
STIFFNESS, DAMPING = 6000.0, 30.0      # driveshafts, N.m/rad, N.m.s/rad
ENGINE_INERTIA, IDLE = 0.18, 850 * RPM
CLUTCH_SLOPE = 2.0                     # N.m.s/rad; below 2 J/h at every step used here
GRAVITY, GRADE, HILL_AT = 9.81, 0.08, 36.0

# time in s -> value, linear in between
ENGINE = [(0.5, 5), (1.5, 60), (4, 60), (4.2, 20), (4.8, 70), (9, 70), (9.2, 20), (9.8, 80),
          (15, 80), (15.2, 20), (15.8, 70), (22, 70), (22.5, 0), (51, 0), (53, 60),
          (60, 60)]
CLUTCH = {"odd": [(0.5, 0), (2, 140), (4, 140), (4.6, 0), (9, 0), (9.6, 140), (15, 140),
                  (15.6, 0), (51, 0), (53, 180)],
          "even": [(4, 0), (4.6, 140), (9, 140), (9.6, 0), (15, 0), (15.6, 140),
                   (22.5, 140), (23.5, 0)]}
GEAR = {"odd": [(0, 1), (6, 3), (31, 1)], "even": [(0, 0), (2.5, 2), (11.5, 4), (33, 2)]}
BRAKE = [(24, 0), (26, 1100), (49.5, 1100), (52.5, 0)]  # N.m at the wheels


def linear(points, t):
    return float(numpy.interp(t, [p[0] for p in points], [p[1] for p in points]))


def latest(points, t):
    return [y for t0, y in points if t0 <= t][-1]


class Map:
    """The tables of a map file, interpolated linearly by this code alone."""

    def __init__(self, path):
        db = sqlite3.connect(f"file:{path}?mode=ro", uri=True)
        meta = dict(db.execute("SELECT key, value FROM meta"))
        self.inertia_output = meta["inertia_output"]
        self.names, self.inertia, self.sync_torque = [], [], []
        for name, inertia, torque in db.execute(
                "SELECT name, inertia, sync_torque FROM path ORDER BY path"):
            self.names.append(name)
            self.inertia.append(inertia)
            self.sync_torque.append(torque)
        self.ratio = {(p, g): r for p, g, r in db.execute("SELECT path, gear, ratio FROM gear")}
        self.lines = [[r for r, in db.execute(
            "SELECT DISTINCT line_ratio FROM map_table WHERE symbol = 'line_jump' AND "
            "path = ? ORDER BY line_ratio", (path,))] for path in range(len(self.names))]
        self.tables = {}
        for row in db.execute("SELECT id, symbol, path, gear_0, gear_1, direction_0, "
                              "direction_1, line_ratio, axis_0, axis_1, axis_2 FROM map_table"):
            axes = [numpy.array([x for x, in db.execute(
                "SELECT x FROM axis_value WHERE axis = ? ORDER BY i", (a,))])
                for a in row[8:] if a is not None]
            values = numpy.array([v for v, in db.execute(
                "SELECT value FROM value WHERE map_table = ? ORDER BY i, j, k", row[:1])])
            self.tables[row[1:8]] = (axes, values.reshape([len(a) for a in axes]))
        db.close()

    def at(self, symbol, *point, path=None, gears=(None, None), directions=(None, None),
           line=None):
        words = [None if d is None else "forward" if d > 0 else "backward"
                 for d in directions]
        axes, values = self.tables[(symbol, path, *gears, *words, line)]
        for axis, x in zip(axes, point):
            i = int(numpy.clip(numpy.searchsorted(axis, x, "right") - 1, 0, len(axis) - 2))
            share = min(max((x - axis[i]) / (axis[i + 1] - axis[i]), 0.0), 1.0)
            values = (1.0 - share) * values[i] + share * values[i + 1]
        return float(values)

    def line_jump(self, p, ratio, direction, w_o):
        return self.at("line_jump", abs(w_o), path=p, line=ratio, directions=(direction, None))


def sat(x):
    return min(max(x, -1.0), 1.0)  # over the documented 1 rad/s


def loss_power(m, w_o, w, a_o, tau, gear, mode):
    """Power lost at one instant, from the map; mode 0 neutral, 1 synchronising, 2 engaged."""
    sign = lambda x: -1.0 if x < 0 else 1.0
    s = sign(w_o)
    engaged = [gear[p] if mode[p] == 2 else 0 for p in range(2)]
    power = m.at("parasitic_loss", abs(w_o), gears=tuple(engaged),
                 directions=(s, None)) * abs(w_o)
    both = all(engaged)
    coupling = 0.0 if both else m.at("coupling", w[0] - w[1])
    power += coupling * (w[0] - w[1])
    transmitted = [0.0, 0.0]
    for p in range(2):
        if engaged[p]:
            r = m.ratio[p, engaged[p]]
            tau_m = tau[p] - (coupling if p == 0 else -coupling) - m.inertia[p] * r * a_o
            s_p = s * sign(r)
            transmitted[p] = tau_m * s_p
            gears = (engaged[p], None) if p == 0 else (None, engaged[p])
            power += abs(w[p]) * m.at("load_loss", abs(w[p]), tau_m * s_p, path=p,
                                      gears=gears, directions=(s_p, None))
            continue
        where = dict(path=p, directions=(sign(w[p]), s))
        power += w[p] * m.at("drag", abs(w[p]), abs(w_o), **where)
        power += w_o * m.at("reaction", abs(w[p]), abs(w_o), **where)
        for r in m.lines[p]:
            half = 0.5 * m.line_jump(p, r, s, w_o)
            step = sat(w[p] - r * w_o)
            power += half * (step * w[p] - r * (step + sat(r * w_o)) * w_o)
        if mode[p] == 1:
            power += m.sync_torque[p] * abs(w[p] - m.ratio[p, gear[p]] * w_o)
    if both:
        power += abs(w_o) * m.at("both_loaded", abs(w_o), *transmitted,
                                 gears=tuple(engaged), directions=(s, None))
    return power


def closing_loss(m, p, w_o, w, gear, before, after):
    """Energy of the slip that a synchroniser removes in the step in which it closes."""
    if after[p] != 2 or before[p] == 2:
        return 0.0
    r = m.ratio[p, gear[p]]
    q = 1 - p
    output = m.inertia_output
    if before[q] == 2:
        output += m.ratio[q, gear[q]]**2 * m.inertia[q]
    reduced = m.inertia[p] * output / (output + r * r * m.inertia[p])
    return 0.5 * reduced * (w[p] - r * w_o)**2


class Component:
    NAMES = ["odd.w", "even.w", "output.w", "odd.phi", "even.phi", "output.phi", "work",
             "loss_energy", "kinetic_energy", "elastic_energy"]

    def __init__(self, path):
        description = read_model_description(path)
        self.vr = {v.name: v.valueReference for v in description.modelVariables}
        self.folder = extract(path)
        self.fmu = FMU2Slave(guid=description.guid, unzipDirectory=self.folder,
                             modelIdentifier=description.coSimulation.modelIdentifier)
        self.fmu.instantiate()
        self.fmu.setupExperiment(startTime=0.0)
        self.real = [self.vr[n] for n in self.NAMES]
        self.torque = [self.vr[n] for n in ("odd.tau", "even.tau", "output.tau")]
        self.gear = [self.vr[n] for n in ("odd.gear", "even.gear")]
        self.state = [self.vr[n] for n in ("odd.state", "even.state")]

    def start(self, gears):
        self.fmu.setInteger(self.gear, gears)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def observe(self):
        return self.fmu.getReal(self.real), self.fmu.getInteger(self.state)

    def close(self):
        self.fmu.terminate()
        self.fmu.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)


def clutch(capacity, slip):
    return max(-capacity, min(capacity, CLUTCH_SLOPE * slip))


def vehicle_step(v, pull, t, h):
    """Speed after h; the brake holds the car when it can."""
    grade = GRADE if t > HILL_AT else 0.0
    force = pull / WHEEL - MASS * GRAVITY * grade - AIR * v * abs(v)
    brake = linear(BRAKE, t) / WHEEL + ROLLING * MASS * GRAVITY
    after = v + h * force / MASS
    slow = h * brake / MASS
    return 0.0 if abs(after) <= slow else after - math.copysign(slow, after)


def drive(component, m, h):
    """Run the scenario; returns the account as a dict of energies in J."""
    gears = [latest(GEAR[n], 0.0) for n in ("odd", "even")]
    component.start(gears)
    (w0, w1, wo, p0, p1, po, *_, kinetic_start, elastic_start), mode = component.observe()
    engine, twist, v = IDLE, 0.0, 0.0
    work = lost = 0.0
    account = creep = 0.0
    for i in range(round(END / h)):
        t = i * h
        now = [latest(GEAR[n], t) for n in ("odd", "even")]
        if now != gears:
            component.fmu.setInteger(component.gear, now)
            gears = now
        tau = [clutch(linear(CLUTCH["odd"], t), engine - w0),
               clutch(linear(CLUTCH["even"], t), engine - w1)]
        pull = STIFFNESS * twist + DAMPING * (wo - v / WHEEL)
        component.fmu.setReal(component.torque, [*tau, -pull])
        component.fmu.doStep(t, h)
        (n0, n1, no, q0, q1, qo, total, loss, kinetic, elastic), after = component.observe()
        work += tau[0] * (q0 - p0) + tau[1] * (q1 - p1) - pull * (qo - po)
        lost += h * loss_power(m, 0.5 * (wo + no), (0.5 * (w0 + n0), 0.5 * (w1 + n1)),
                               (no - wo) / h, tau, gears, after)
        lost += sum(closing_loss(m, p, wo, (w0, w1), gears, mode, after) for p in range(2))
        mode = after
        stored = kinetic - kinetic_start + elastic - elastic_start
        account = max(account, abs(total - loss - stored))
        if 42.0 < t < 49.0 and v == 0.0:
            creep = max(creep, abs(no))
        engine += h * (linear(ENGINE, t) + 2.0 * max(0.0, IDLE - engine) - sum(tau)) \
            / ENGINE_INERTIA
        w0, w1, wo, p0, p1, po = n0, n1, no, q0, q1, qo
        v = vehicle_step(v, pull, t, h)
        twist += h * (wo - v / WHEEL)
    kinetic = 0.5 * (m.inertia_output * wo**2 + m.inertia[0] * w0**2 + m.inertia[1] * w1**2)
    return {"work": work, "lost": lost, "kinetic": kinetic - kinetic_start, "own": account,
            "own_work": total, "own_lost": loss, "speed": v, "creep": creep}


def difference(result):
    """Work minus kinetic energy minus losses from the map, over the losses."""
    return (result["work"] - result["kinetic"] - result["lost"]) / result["lost"]


def run(fmu, map_file, steps):
    m = Map(map_file)
    results = []
    for h in steps:
        component = Component(fmu)
        results.append(drive(component, m, h))
        component.close()
    return results


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("fmu")
    parser.add_argument("map")
    parser.add_argument("--steps", type=float, nargs="+", default=[4e-3, 2e-3, 1e-3, 5e-4])
    arguments = parser.parse_args()
    print("  step     work       loss by map  difference/loss   own account/work  at rest")
    for h, r in zip(arguments.steps, run(arguments.fmu, arguments.map, arguments.steps)):
        print(f"{1e3 * h:5.2f} ms  {r['work']:9.2f} J  {r['lost']:9.3f} J  "
              f"{difference(r):13.3e}   {r['own'] / r['own_work']:13.3e}   "
              f"{r['creep']:.1e} rad/s")


if __name__ == "__main__":
    main()
