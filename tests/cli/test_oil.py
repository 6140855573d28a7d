# SPDX-License-Identifier: BSD-2-Clause
"""--oil-temperature with several values: the oil axis from the sweep to the component."""

import sqlite3
import xml.etree.ElementTree as ElementTree
import zipfile

import fmpy
import numpy as np
import pytest
from conftest import COARSE, ROOT, fails, result_of, succeeds
from fmpy.fmi2 import FMU2Slave

GEARSET = ROOT / "examples" / "ev1.yaml"  # another gearset than the tests of the sweep use
AXIS = "-10degC,30degC,90degC"
KELVIN = 273.15


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("oil")


@pytest.fixture(scope="module")
def reduced(folder):
    fmu, kept = folder / "oil.fmu", folder / "oil.map"
    result = result_of("reduce", GEARSET, "-o", fmu, "--map", kept, "--oil-temperature", AXIS,
                       *COARSE)
    return fmu, kept, result


@pytest.mark.parametrize("value, words", [
    ("20degC,10degC", "needs values that increase; '10degC' does not"),
    ("20degC,20degC", "needs values that increase"),
    ("20degF,30degC", "needs a number in degC"),
    ("20degC,", "needs a number in degC"),
    ("-60degC,20degC", "is not between -50degC and 200degC"),
    (",".join(str(t) for t in range(17)), "takes 16 values, not more"),
    ("warm,hot", "needs a number in degC"),
])
def test_wrong_values_are_refused(tmp_path, value, words):
    sentence = fails("sweep", GEARSET, "-o", tmp_path / "m.map", "--oil-temperature", value, code=2)
    assert words in sentence
    assert not list(tmp_path.iterdir())


def test_one_temperature_makes_no_axis(tmp_path):
    one = result_of("sweep", GEARSET, "-o", tmp_path / "one.map", "--oil-temperature", "80degC",
                    *COARSE)
    plain = result_of("sweep", GEARSET, "-o", tmp_path / "plain.map", *COARSE)
    assert one["content_hash"] == plain["content_hash"]  # the description's own


def test_verification_holds_out_temperatures(reduced):
    _, _, result = reduced
    verify = result["verify"]
    between = verify["by_oil_temperature"]
    assert [(round(b["from_degC"]), round(b["to_degC"])) for b in between] == [(-10, 30), (30, 90)]
    assert sum(b["points"] for b in between) == verify["points"]
    assert all(0 < b["rms_relative"] <= b["max_relative"] for b in between)
    assert all(-10 < c["worst"]["oil_degC"] < 90 for c in verify["cases"])


def test_a_component_is_verified_on_its_axis_only(reduced):
    fmu, _, _ = reduced
    at_node = result_of("verify", GEARSET, fmu, "--steady", "--points", 300,
                        "--oil-temperature", "30degC")
    assert "by_oil_temperature" not in at_node
    sentence = fails("verify", GEARSET, fmu, "--steady", "--oil-temperature", "95degC")
    assert "was made for oil temperatures from -10 to 90 degC, not 95 degC" in sentence
    sentence = fails("verify", GEARSET, fmu, "--cycle", "ece15", "--oil-temperature", "30degC")
    assert "drives are compared at the oil temperature that it starts with" in sentence


def test_what_follows_the_temperature_says_so(reduced):
    fmu, _, _ = reduced
    with zipfile.ZipFile(fmu) as archive:
        root = ElementTree.fromstring(archive.read("modelDescription.xml"))
    names = [v.get("name") for v in root.find("ModelVariables")]
    oil = str(names.index("oil_temperature") + 1)
    follows = {names[int(u.get("index")) - 1] for u in root.find("ModelStructure/Outputs")
               if oil in u.get("dependencies").split()}
    assert {"output.a", "input.a", "loss_power", "output.loss_torque", "out_of_map"} <= follows
    assert not {"output.w", "input.w", "kinetic_energy"} & follows


def test_views_show_every_temperature(reduced):
    _, kept, _ = reduced
    connection = sqlite3.connect(kept)
    rows = connection.execute("SELECT round(oil_degC), count(*), max(loss_torque_Nm) "
                              "FROM v_parasitic_loss GROUP BY 1 ORDER BY 1").fetchall()
    assert [r[0] for r in rows] == [-10, 30, 90]
    assert len({r[1] for r in rows}) == 1
    assert len({r[2] for r in rows}) == 3


class Component:
    """Co-Simulation with steps of 1 ms."""

    def __init__(self, fmu, folder):
        unpacked = fmpy.extract(str(fmu), unzipdir=str(folder))
        self.description = fmpy.read_model_description(unpacked)
        self.reference = {v.name: v.valueReference for v in self.description.modelVariables}
        self.types = {v.name: v.type for v in self.description.modelVariables}
        self.fmu = FMU2Slave(
            guid=self.description.guid, unzipDirectory=unpacked,
            modelIdentifier=self.description.coSimulation.modelIdentifier)
        self.fmu.instantiate()

    def start(self, **values):
        self.fmu.setupExperiment()
        self.fmu.enterInitializationMode()
        for name, value in values.items():
            self.put(name.replace("__", "."), value)
        self.fmu.exitInitializationMode()

    def put(self, name, value):
        self.fmu.setReal([self.reference[name]], [value])

    def get(self, name):
        get = self.fmu.getBoolean if self.types[name] == "Boolean" else self.fmu.getReal
        return get([self.reference[name]])[0]

    def step(self, k):
        self.fmu.doStep(currentCommunicationPoint=k * 1e-3, communicationStepSize=1e-3)


def drive(component, temperature, steps=400):
    """Speeds and losses while the torque swings; temperature(k) in K."""
    component.start(output__w_start=20.0, oil_temperature=temperature(0))
    rows = []
    for k in range(steps):
        component.put("oil_temperature", temperature(k))
        component.put("input.tau", 60.0 * np.sin(k / 40.0))
        component.put("output.tau", -100.0)
        component.step(k)
        rows.append([component.get(n) for n in ("output.w", "loss_power", "work", "loss_energy",
                                                "kinetic_energy", "elastic_energy")])
    return np.array(rows)


def test_at_a_slice_the_component_is_that_of_one_temperature(reduced, folder):
    fmu, _, _ = reduced
    alone = folder / "alone.fmu"
    succeeds("reduce", GEARSET, "-o", alone, "--oil-temperature", "30degC", *COARSE)
    both = [drive(Component(f, folder / f.stem), lambda k: 30.0 + KELVIN)
            for f in (fmu, alone)]
    assert np.array_equal(both[0], both[1])


def test_the_account_closes_while_the_oil_warms_up(reduced, folder):
    fmu, _, _ = reduced
    component = Component(fmu, folder / "warms")
    rows = drive(component, lambda k: KELVIN - 10.0 + 0.25 * k)  # to 90 degC
    work, loss, energy = rows[:, 2], rows[:, 3], rows[:, 4] + rows[:, 5]
    start = energy[0] - (work[0] - loss[0])
    assert np.abs(work - loss - (energy - start)).max() <= 1e-9 * np.abs(work).max()
    assert np.all(np.diff(loss) >= 0)
    cold = drive(Component(fmu, folder / "cold"), lambda k: KELVIN - 10.0)
    assert abs(loss[-1] - cold[-1, 3]) > 0.01 * loss[-1]


def test_beyond_the_axis_it_clamps_and_says_so(reduced, folder):
    fmu, _, _ = reduced
    component = Component(fmu, folder / "beyond")
    losses = {}
    component.start(output__w_start=20.0, oil_temperature=30.0 + KELVIN)
    for k, degrees in enumerate([90.0, 91.0, 150.0, -10.0, -11.0]):
        component.put("oil_temperature", degrees + KELVIN)
        losses[degrees] = component.get("loss_power")
        assert component.get("out_of_map") == (degrees not in (90.0, -10.0))
    assert losses[91.0] == losses[150.0] == losses[90.0] < losses[-10.0] == losses[-11.0]


def test_a_tolerance_adds_temperatures(tmp_path):
    small = ROOT / "tests" / "cli" / "two_speed.yaml"
    results = [result_of("sweep", small, "-o", tmp_path / f"{k}.map", "--tolerance", tolerance,
                         "--oil-temperature", "0degC,80degC") for k, tolerance in
               enumerate(["20%", "2%"])]
    few, many = [r["oil_temperatures_degC"] for r in results]
    assert 2 <= len(few) < len(many)
    for axis in (few, many):
        assert axis[0] == pytest.approx(0) and axis[-1] == pytest.approx(80)
        assert all(a < b for a, b in zip(axis, axis[1:]))
    between = results[1]["verify"]["by_oil_temperature"]
    assert len(between) == len(many) - 1
    assert results[1]["verify"]["max_relative"] <= 0.02


def test_a_foreign_model_without_a_temperature_is_refused(tmp_path):
    small = ROOT / "tests" / "cli" / "two_speed.yaml"
    model, rig = tmp_path / "model.fmu", tmp_path / "rig.yaml"
    succeeds("bake", "--detailed", small, "-o", model)
    succeeds("rig", model, "-o", rig)
    lines = [x for x in rig.read_text().splitlines() if not x.startswith("oil_temperature:")]
    rig.write_text("\n".join(lines) + "\n")
    sentence = fails("sweep", rig, "-o", tmp_path / "m.map", "--oil-temperature", "20,80")
    assert "names no variable that takes the oil temperature" in sentence
    assert {p.name for p in tmp_path.iterdir()} == {"model.fmu", "rig.yaml"}
