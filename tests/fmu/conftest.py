# SPDX-License-Identifier: BSD-2-Clause
"""FMUs baked from the example maps (tests/bake/example_map.c), and a thin host for them."""

import os
import subprocess
from contextlib import contextmanager
from pathlib import Path

import fmpy
import pytest
from fmpy.fmi2 import FMU2Slave

BINARY = Path(os.environ["GM_BINARY_DIR"])


def bake(folder, paths, **environment):
    file = folder / f"paths{paths}.fmu"
    done = subprocess.run(
        [BINARY / "tests/bake/bake_example", BINARY / "share/gearmap", str(paths), file],
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


class Host:
    """One instance; values by name."""

    def __init__(self, baked):
        self.baked = baked
        self.fmu = FMU2Slave(
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


@pytest.fixture(scope="session")
def host():
    """host(baked) as a context manager: freed whatever happens."""
    @contextmanager
    def make(baked):
        instance = Host(baked)
        try:
            yield instance
        finally:
            instance.fmu.freeInstance()
    return make
