# SPDX-License-Identifier: BSD-2-Clause
"""A drive for an FMU: one row of inputs per communication step, the same for all importers.

The rows are found once, by steering the FMU itself: random gears and target speeds, a
controller at every flange. They are rounded to 1/1024 N.m, so that an importer that
interpolates between rows (which are one step apart) gets exactly what the file says, and
the step is both a binary fraction of a second and a whole number of nanoseconds, so that
every importer's clock is exact."""

import random
from types import SimpleNamespace

from fmpy.fmi2 import FMU2Slave

H = 1.0 / 512
STEPS = 4096
NANOSECONDS = 1953125  # H
# With the smallest inertias of the examples (0.04 kg.m2 at the output, 0.0013 at an
# input) both stay below the limit of explicit control, 2 J / H.
OUTPUT_GAIN, PATH_GAIN = 4.0, 0.1  # N.m.s/rad
W_OUTPUT = 22.0  # rad/s, of the output: every gear stays within the map
HOLD = 128  # steps from one command to the next


def rounded(torque):
    return round(torque * 1024) / 1024


class Steered:
    """One instance; values by name."""

    def __init__(self, description, folder):
        self.variables = {v.name: v for v in description.modelVariables}
        self.fmu = FMU2Slave(guid=description.guid, unzipDirectory=str(folder),
                             modelIdentifier=description.coSimulation.modelIdentifier)
        self.fmu.instantiate()

    def get(self, name):
        return self.fmu.getReal([self.variables[name].valueReference])[0]

    def set(self, values):
        for name, value in values.items():
            v = self.variables[name]
            call = self.fmu.setReal if v.type == "Real" else self.fmu.setInteger
            call([v.valueReference], [value])


def command(draw, gearset, plan):
    """The next command: one path gets a gear (or neutral), all get targets."""
    path = draw.choice(list(gearset))
    plan.gear[path] = draw.choice([0, *gearset[path]])
    plan.w = draw.uniform(-W_OUTPUT, W_OUTPUT)
    for p in gearset:
        plan.tau[p] = draw.uniform(-60.0, 60.0)
        plan.w_free[p] = draw.uniform(-200.0, 200.0)


def torques(host, gearset, plan):
    """Engaged paths work against each other and the output, free ones reach their speed."""
    row, at_output = {}, 0.0
    for p, gears in gearset.items():
        state = host.fmu.getInteger([host.variables[f"{p}.state"].valueReference])[0]
        tau = plan.tau[p] if state == 2 else PATH_GAIN * (plan.w_free[p] - host.get(f"{p}.w"))
        row[f"{p}.tau"] = rounded(max(-60.0, min(60.0, tau)))
        if state == 2:
            at_output += gears[plan.gear[p]] * row[f"{p}.tau"]
    tau = OUTPUT_GAIN * (plan.w - host.get("output.w")) - 0.97 * at_output
    row["output.tau"] = rounded(max(-1500.0, min(1500.0, tau)))
    return row


def steer(description, folder, gearset, start):
    """gearset: {path: {gear: ratio}}. STEPS + 1 rows; the first two are of zeros, in
    neutral, since importers differ in which inputs they give before the first step."""
    draw, host, rows = random.Random(7), Steered(description, folder), []
    plan = SimpleNamespace(w=0.0, gear=dict.fromkeys(gearset, 0),
                           tau=dict.fromkeys(gearset, 0.0), w_free=dict.fromkeys(gearset, 0.0))
    host.fmu.setupExperiment(startTime=0.0)
    host.set(start)
    host.fmu.enterInitializationMode()
    host.fmu.exitInitializationMode()
    for k in range(STEPS + 1):
        row = torques(host, gearset, plan)
        row = {n: v if k > 1 else 0.0 for n, v in row.items()}
        if k % HOLD == 2:
            command(draw, gearset, plan)
        row.update({f"{p}.gear": g for p, g in plan.gear.items()})
        rows.append(row)
        host.set(row)
        host.fmu.doStep(k * H, H)
    host.fmu.terminate()
    host.fmu.freeInstance()
    return rows
