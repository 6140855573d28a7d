# SPDX-License-Identifier: BSD-2-Clause
"""Detailed FMUs of the examples, baked once, and a thin host for them."""

import ctypes
import json
import os
import subprocess
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace

import fmpy
import numpy as np
import pytest
from fmpy.fmi2 import FMU2Model

ROOT = Path(os.environ["GM_SOURCE_DIR"])
GEARMAP = os.environ["GEARMAP"]
EXAMPLES = ["at3_simpson", "at4_ravigneaux", "dct6_wet", "dct7", "ev1", "mt5"]


def gearmap(*arguments):
    return subprocess.run([GEARMAP, *map(str, arguments)], capture_output=True, text=True)


def succeeds(*arguments):
    done = gearmap(*arguments)
    assert done.returncode == 0, done.stderr
    return done.stdout


def gears_of(source):
    """{path: {gear: ratio}}"""
    paths = json.loads(succeeds("check", source, "--json"))["paths"]
    return {p["name"]: {g["number"]: g["ratio"] for g in p["gears"]} for p in paths}


def unpack(fmu, folder):
    folder = Path(fmpy.extract(str(fmu), unzipdir=str(folder)))
    description = fmpy.read_model_description(str(folder))
    return SimpleNamespace(file=str(fmu), folder=folder, description=description,
                           variables={v.name: v for v in description.modelVariables})


@pytest.fixture(scope="session")
def bake(tmp_path_factory):
    """bake(name): .file, .folder, .description, .variables, .source, .gears"""
    made = {}

    def get(name):
        if name not in made:
            folder = tmp_path_factory.mktemp(name)
            source, fmu = ROOT / f"examples/{name}.yaml", folder / f"{name}.fmu"
            succeeds("bake", "--detailed", source, "-o", fmu)
            made[name] = unpack(fmu, folder / "unpacked")
            made[name].source, made[name].gears = source, gears_of(source)
        return made[name]
    return get


@pytest.fixture(scope="session")
def reduced(tmp_path_factory):
    """reduced(name): the reduced FMU of the example, coarse."""
    made = {}

    def get(name):
        if name not in made:
            folder = tmp_path_factory.mktemp(f"{name}_reduced")
            fmu = folder / f"{name}.fmu"
            succeeds("reduce", ROOT / f"examples/{name}.yaml", "-o", fmu, "--points", "20")
            made[name] = unpack(fmu, folder / "unpacked")
        return made[name]
    return get


class Host:
    """One instance in Model Exchange; values by name."""

    def __init__(self, fmu):
        self.of, self.said = fmu, []
        self.fmu = FMU2Model(guid=fmu.description.guid, unzipDirectory=str(fmu.folder),
                             modelIdentifier=fmu.description.modelExchange.modelIdentifier)
        self.n = fmu.description.numberOfContinuousStates

    def open(self):
        callbacks = fmpy.fmi2.fmi2CallbackFunctions()
        self.log = fmpy.fmi2.fmi2CallbackLoggerTYPE(
            lambda environment, name, status, category, message: self.said.append(
                (status, message.decode())))
        callbacks.logger = self.log
        self.fmu.instantiate(callbacks=callbacks)
        return self

    def start(self, values=()):
        self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.set(values)
        self.fmu.exitInitializationMode()
        self.update()

    def update(self):
        needed, terminate, nominals, states, timed, _ = self.fmu.newDiscreteStates()
        assert not (needed or terminate or nominals or timed)
        self.fmu.enterContinuousTimeMode()
        return states

    def event(self, values=()):
        self.fmu.enterEventMode()
        self.set(values)
        return self.update()

    def set(self, values):
        for name, value in dict(values).items():
            v = self.of.variables[name]
            call = self.fmu.setReal if v.type == "Real" else self.fmu.setInteger
            call([v.valueReference], [value])

    def get(self, name):
        v = self.of.variables[name]
        call = {"Real": self.fmu.getReal, "Boolean": self.fmu.getBoolean}.get(
            v.type, self.fmu.getInteger)
        return call([v.valueReference])[0]

    def _array(self, n, call):
        x = np.zeros(n)
        call(x.ctypes.data_as(ctypes.POINTER(ctypes.c_double)), n)
        return x

    def states(self):
        return self._array(self.n, self.fmu.getContinuousStates)

    def rates(self):
        return self._array(self.n, self.fmu.getDerivatives)

    def nominals(self):
        return self._array(self.n, self.fmu.getNominalsOfContinuousStates)

    def indicators(self):
        return self._array(self.of.description.numberOfEventIndicators,
                           self.fmu.getEventIndicators)

    def set_states(self, x):
        x = np.array(x, dtype=float)
        self.fmu.setContinuousStates(x.ctypes.data_as(ctypes.POINTER(ctypes.c_double)), x.size)

    def euler(self, h, n=1):
        for _ in range(n):
            self.set_states(self.states() + h * self.rates())


@pytest.fixture
def host():
    """host(fmu) as a context manager: freed whatever happens."""
    @contextmanager
    def make(fmu):
        instance = Host(fmu).open()
        try:
            yield instance
        finally:
            instance.fmu.freeInstance()
    return make
