# SPDX-License-Identifier: BSD-2-Clause
"""FMUs baked from the example maps (tests/bake/example_map.c), and a thin host for them."""

import ctypes
import os
import subprocess
from contextlib import contextmanager
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi2 import FMU2Model, FMU2Slave

BINARY = Path(os.environ["GM_BINARY_DIR"])


def bake(folder, paths, speed_in=None, **environment):
    file = folder / f"paths{paths}.fmu"
    more = [speed_in] if speed_in else []
    done = subprocess.run(
        [BINARY / "tests/bake/bake_example", BINARY / "share/gearmap", str(paths), file, *more],
        capture_output=True, text=True, env={**os.environ, **environment})
    assert done.returncode == 0, done.stderr
    return file


class Baked:
    """An FMU file, unpacked, with its description."""

    def __init__(self, file, folder):
        self.file = file
        self.folder = Path(fmpy.extract(str(file), unzipdir=str(folder)))
        self.description = fmpy.read_model_description(str(self.folder))
        self.variables = {v.name: v for v in self.description.modelVariables}
        self.binary = self.folder / "binaries" / "linux64" / (
            self.description.coSimulation.modelIdentifier + ".so")


@pytest.fixture(scope="session")
def two(tmp_path_factory):
    folder = tmp_path_factory.mktemp("two")
    return Baked(bake(folder, 2), folder / "unpacked")


@pytest.fixture(scope="session")
def one(tmp_path_factory):
    folder = tmp_path_factory.mktemp("one")
    return Baked(bake(folder, 1), folder / "unpacked")


@pytest.fixture(scope="session")
def output_in(tmp_path_factory):
    """Two paths; motion comes in at the output."""
    folder = tmp_path_factory.mktemp("output_in")
    return Baked(bake(folder, 2, "output"), folder / "unpacked")


@pytest.fixture(scope="session")
def odd_in(tmp_path_factory):
    """Two paths; motion comes in at one of them and at the output."""
    folder = tmp_path_factory.mktemp("odd_in")
    return Baked(bake(folder, 2, "odd,output"), folder / "unpacked")


class Host:
    """One instance; values by name."""

    kind = FMU2Slave

    def __init__(self, baked):
        self.baked = baked
        self.fmu = self.kind(
            guid=baked.description.guid, unzipDirectory=str(baked.folder),
            modelIdentifier=baked.description.coSimulation.modelIdentifier)
        self.fmu.instantiate()
        self.time = 0.0

    def initialise(self, values=()):
        self.fmu.setupExperiment(startTime=0.0)
        self.fmu.enterInitializationMode()
        self.set(values)

    def start(self, values=()):
        self.initialise(values)
        self.fmu.exitInitializationMode()

    def set(self, values):
        for name, value in dict(values).items():
            v = self.baked.variables[name]
            call = self.fmu.setReal if v.type == "Real" else self.fmu.setInteger
            call([v.valueReference], [value])

    def get(self, name):
        v = self.baked.variables[name]
        call = {"Real": self.fmu.getReal, "Boolean": self.fmu.getBoolean}.get(
            v.type, self.fmu.getInteger)
        return call([v.valueReference])[0]

    def step(self, h, n=1):
        for _ in range(n):
            self.fmu.doStep(self.time, h)
            self.time += h


class ExchangeHost(Host):
    """The same for Model Exchange."""

    kind = FMU2Model

    def start(self, values=()):
        super().start(values)
        self.update()

    def update(self):
        """From event mode to continuous-time mode; whether states changed."""
        needed, terminate, nominals, states, time_event, _ = self.fmu.newDiscreteStates()
        assert not (needed or terminate or nominals or time_event)
        self.fmu.enterContinuousTimeMode()
        return states

    def event(self, values=()):
        self.fmu.enterEventMode()
        self.set(values)
        return self.update()

    def _array(self, n, call):
        x = np.zeros(n)
        call(x.ctypes.data_as(ctypes.POINTER(ctypes.c_double)), n)
        return x

    def states(self):
        return self._array(self.baked.description.numberOfContinuousStates,
                           self.fmu.getContinuousStates)

    def rates(self):
        return self._array(self.baked.description.numberOfContinuousStates,
                           self.fmu.getDerivatives)

    def indicators(self):
        return self._array(self.baked.description.numberOfEventIndicators,
                           self.fmu.getEventIndicators)

    def set_states(self, x):
        x = np.array(x, dtype=float)
        self.fmu.setContinuousStates(x.ctypes.data_as(ctypes.POINTER(ctypes.c_double)), x.size)


@pytest.fixture(scope="session")
def host():
    """host(baked) as a context manager: freed whatever happens."""
    @contextmanager
    def make(baked, exchange=False):
        instance = (ExchangeHost if exchange else Host)(baked)
        try:
            yield instance
        finally:
            instance.fmu.freeInstance()
    return make
