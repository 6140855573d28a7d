# SPDX-License-Identifier: BSD-2-Clause
"""Simulates the reduced gearset in a small car: driving away and two shifts.

    python examples/simulate.py build/dct7.fmu build/dct7.csv

The FMU is the gearset between two clutches and the half shafts. Around it, in this file:
an engine with idle control, two dry clutches (torque by slip, limited by their capacity),
elastic half shafts, and a car with rolling and air resistance. All are coupled at the
communication step by torques into and speeds out of the FMU.
"""

import argparse
import csv
import math
import shutil
import time

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

STEP = 0.25e-3      # s; a clutch at a co-simulated flange needs h < 2 J / SLOPE
END = 12.0          # s
RPM = math.pi / 30  # rad/s

# a compact car
MASS, WHEEL = 1400.0, 0.31             # kg, rolling radius in m
ROLLING, AIR = 0.011, 0.5 * 1.2 * 0.7  # resistance: factor of weight, N/(m/s)^2
SHAFT_STIFFNESS, SHAFT_DAMPING = 8000.0, 60.0  # both half shafts, N.m/rad, N.m.s/rad
ENGINE_INERTIA, IDLE, IDLE_GAIN = 0.15, 900 * RPM, 2.0  # kg.m2, rad/s, N.m.s/rad
SLOPE = 12.0        # N.m per rad/s of clutch slip near closing

# time in s -> value, linear between the points, constant outside
ENGINE = [(0.4, 0.0), (1.4, 90.0), (4.0, 120.0), (4.2, 60.0), (4.7, 60.0), (5.0, 120.0),
          (7.6, 120.0), (7.8, 60.0), (8.3, 60.0), (8.6, 120.0)]
CLUTCH = {"odd": [(0.5, 0.0), (2.0, 130.0), (4.2, 160.0), (4.6, 0.0), (7.8, 0.0), (8.2, 160.0)],
          "even": [(4.2, 0.0), (4.6, 160.0), (7.8, 160.0), (8.2, 0.0)]}
# time in s -> gear, from then on: the next gear is engaged before its clutch closes
GEARS = {"odd": [(0.0, 1), (5.5, 3)], "even": [(0.0, 0), (2.5, 2), (9.5, 4)]}


def linear(points, t):
    if t <= points[0][0]:
        return points[0][1]
    for (t0, y0), (t1, y1) in zip(points, points[1:]):
        if t < t1:
            return y0 + (y1 - y0) * (t - t0) / (t1 - t0)
    return points[-1][1]


def latest(points, t):
    return [y for t0, y in points if t0 <= t][-1]


class Gearset:
    """The FMU, by variable names."""

    def __init__(self, path):
        description = read_model_description(path)
        self.references = {v.name: v.valueReference for v in description.modelVariables}
        self.folder = extract(path)
        self.fmu = FMU2Slave(guid=description.guid, unzipDirectory=self.folder,
                             modelIdentifier=description.coSimulation.modelIdentifier)
        self.fmu.instantiate()
        self.fmu.setupExperiment(startTime=0.0)

    def start(self, gears):
        for path, gear in gears.items():
            self.set_gear(path, gear)
        self.fmu.enterInitializationMode()
        self.fmu.exitInitializationMode()

    def set_gear(self, path, gear):
        self.fmu.setInteger([self.references[f"{path}.gear"]], [gear])

    def setter(self, *names):
        references = [self.references[name] for name in names]
        return lambda *values: self.fmu.setReal(references, values)

    def getter(self, *names):
        references = [self.references[name] for name in names]
        return lambda: self.fmu.getReal(references)

    def close(self):
        self.fmu.terminate()
        self.fmu.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)


def clutch_torque(capacity, slip):
    return max(-capacity, min(capacity, SLOPE * slip))


def resistance(v):
    return ROLLING * MASS * 9.81 * math.tanh(v / 0.1) + AIR * v * abs(v)


def simulate(gearset, writer):
    """Step through the scenario; returns totals for the summary."""
    set_torques = gearset.setter("odd.tau", "even.tau", "output.tau")
    observe = gearset.getter("odd.w", "even.w", "output.w", "loss_power", "work",
                             "loss_energy", "kinetic_energy", "elastic_energy")
    gears = {path: latest(points, 0.0) for path, points in GEARS.items()}
    gearset.start(gears)
    engine, twist, v, distance, energy_in, worst = IDLE, 0.0, 0.0, 0.0, 0.0, 0.0
    odd, even, output, *_, kinetic_at_start, elastic_at_start = observe()
    for i in range(round(END / STEP)):
        t = i * STEP
        for path, points in GEARS.items():
            if latest(points, t) != gears[path]:
                gears[path] = latest(points, t)
                gearset.set_gear(path, gears[path])
        tau_odd = clutch_torque(linear(CLUTCH["odd"], t), engine - odd)
        tau_even = clutch_torque(linear(CLUTCH["even"], t), engine - even)
        shaft = SHAFT_STIFFNESS * twist + SHAFT_DAMPING * (output - v / WHEEL)
        set_torques(tau_odd, tau_even, -shaft)
        gearset.fmu.doStep(t, STEP)

        tau_engine = linear(ENGINE, t) + IDLE_GAIN * max(0.0, IDLE - engine)
        engine += STEP * (tau_engine - tau_odd - tau_even) / ENGINE_INERTIA
        v += STEP * (shaft / WHEEL - resistance(v)) / MASS
        odd, even, output, loss, work, lost, kinetic, elastic = observe()
        twist += STEP * (output - v / WHEEL)
        distance += STEP * v
        energy_in += STEP * (tau_odd * odd + tau_even * even)
        stored = kinetic - kinetic_at_start + elastic - elastic_at_start
        worst = max(worst, abs(work - lost - stored))
        if i % 40 == 39:
            writer.writerow([f"{x:.6g}" for x in (
                t + STEP, 3.6 * v, engine / RPM, odd / RPM, even / RPM, output / RPM,
                gears["odd"], gears["even"], tau_odd, tau_even, shaft, loss, work, lost)])
    return {"speed": 3.6 * v, "distance": distance, "in": energy_in, "lost": lost,
            "account": worst}


HEAD = ["time [s]", "car speed [km/h]", "engine speed [rpm]", "odd speed [rpm]",
        "even speed [rpm]", "output speed [rpm]", "odd gear", "even gear",
        "odd torque [N.m]", "even torque [N.m]", "half shaft torque [N.m]", "loss power [W]",
        "work [J]", "loss energy [J]"]


def main():
    parser = argparse.ArgumentParser(description="Simulate the reduced gearset in a car.")
    parser.add_argument("fmu")
    parser.add_argument("csv", help="where to write the signals")
    arguments = parser.parse_args()
    gearset = Gearset(arguments.fmu)
    begin = time.perf_counter()
    with open(arguments.csv, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(HEAD)
        totals = simulate(gearset, writer)
    elapsed = time.perf_counter() - begin
    gearset.close()
    print(f"simulate{elapsed:8.2f} s  {END:.0f} s of driving in steps of {1e3 * STEP:g} ms")
    print(f"    the car reaches {totals['speed']:.1f} km/h after {totals['distance']:.1f} m "
          "in gears 1, 2, 3")
    print(f"    into the gearset {1e-3 * totals['in']:.2f} kJ, lost in it "
          f"{1e-3 * totals['lost']:.2f} kJ ({100 * totals['lost'] / totals['in']:.2f} %); "
          f"its energy account closes to {totals['account']:.1e} J")


if __name__ == "__main__":
    main()
