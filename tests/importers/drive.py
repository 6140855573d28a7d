# SPDX-License-Identifier: BSD-2-Clause
"""Drives for an FMU, the same for all importers: rows of inputs, found once by steering
the FMU itself: random gears and target speeds, a controller at every flange.
The inputs of row k hold from k H to (k + 1) H. They are rounded to 1/1024 N.m, so that an
importer that interpolates between rows gets exactly what the file says where these are one
step apart; H is a binary fraction of a second, so that every importer's clock is exact."""

import random
from types import SimpleNamespace

from fmpy.fmi2 import FMU2Slave

W_OUTPUT = 22.0  # rad/s, of the output: every gear stays within the map


class Fine:
    """A row per communication step, which is a whole number of nanoseconds. Gains in
    N.m.s/rad: with the smallest inertias of the examples (0.04 kg.m2 at the output, 0.0013
    at an input) below the limit of explicit control, 2 J / H."""
    H, ROWS = 1.0 / 512, 4096
    NANOSECONDS = 1953125  # H
    OUTPUT_GAIN, PATH_GAIN = 4.0, 0.1
    HOLD = 128  # rows from one command to the next
    TORQUE = 60.0  # N.m, of engaged paths


class Coarse:
    """For Model Exchange, where every row is an event. Less torque, which is without its
    counterpart for a row when a gear has changed."""
    H, ROWS = 1.0 / 64, 384
    OUTPUT_GAIN, PATH_GAIN = 0.8, 0.02
    HOLD = 24
    TORQUE = 12.0


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

    def free(self):
        self.fmu.terminate()
        self.fmu.freeInstance()


def command(draw, gearset, plan, kind):
    """The next command: one path gets a gear (or neutral), all get targets."""
    path = draw.choice(list(gearset))
    plan.gear[path] = draw.choice([0, *gearset[path]])
    plan.w = draw.uniform(-W_OUTPUT, W_OUTPUT)
    for p in gearset:
        plan.tau[p] = draw.uniform(-kind.TORQUE, kind.TORQUE)
        plan.w_free[p] = draw.uniform(-200.0, 200.0)


def torques(host, gearset, plan, kind):
    """Engaged paths work against each other and the output, free ones reach their speed."""
    row, at_output = {}, 0.0
    for p, gears in gearset.items():
        state = host.fmu.getInteger([host.variables[f"{p}.state"].valueReference])[0]
        tau = plan.tau[p] if state == 2 else kind.PATH_GAIN * (
            plan.w_free[p] - host.get(f"{p}.w"))
        row[f"{p}.tau"] = rounded(max(-60.0, min(60.0, tau)))
        if state == 2:
            at_output += gears[plan.gear[p]] * row[f"{p}.tau"]
    tau = kind.OUTPUT_GAIN * (plan.w - host.get("output.w")) - 0.97 * at_output
    row["output.tau"] = rounded(max(-1500.0, min(1500.0, tau)))
    return row


def started(description, folder, start):
    host = Steered(description, folder)
    host.fmu.setupExperiment(startTime=0.0)
    host.set(start)
    host.fmu.enterInitializationMode()
    host.fmu.exitInitializationMode()
    return host


def first_plan(gearset):
    return SimpleNamespace(w=0.0, gear=dict.fromkeys(gearset, 0),
                           tau=dict.fromkeys(gearset, 0.0), w_free=dict.fromkeys(gearset, 0.0))


def steer(kind, description, folder, gearset, start):
    """gearset: {path: {gear: ratio}}. Rows k = 0 .. ROWS; the first two are of zeros, in
    neutral: importers differ in which inputs they give before the first step."""
    draw, rows = random.Random(7), []
    host, plan = started(description, folder, start), first_plan(gearset)
    for k in range(kind.ROWS + 1):
        row = torques(host, gearset, plan, kind)
        row = {n: v if k > 1 else 0.0 for n, v in row.items()}
        if k % kind.HOLD == 2:
            command(draw, gearset, plan, kind)
        row.update({f"{p}.gear": g for p, g in plan.gear.items()})
        rows.append(row)
        host.set(row)
        host.fmu.doStep(k * kind.H, kind.H)
    host.free()
    return rows


def replay(kind, description, folder, rows, start, names, substeps):
    """Co-Simulation of the rows in smaller steps: {name: values at the rows}."""
    host = started(description, folder, start)
    record = {name: [host.get(name)] for name in names}
    h = kind.H / substeps
    for k in range(kind.ROWS):
        host.set(rows[k])
        for i in range(substeps):
            host.fmu.doStep((k * substeps + i) * h, h)
        for name, values in record.items():
            values.append(host.get(name))
    host.free()
    return record
