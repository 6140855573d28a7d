# SPDX-License-Identifier: BSD-2-Clause
"""Experiments by choice. The same gearset as built-in model, as its own detailed FMU and as
a compiled model gives the same map within the uncertainty that each map states."""

import json
import os
import re
import sqlite3
import subprocess

import foreign
import pytest

PROGRAM = os.environ["GEARMAP"]
EV1 = foreign.ROOT / "examples/ev1.yaml"
COARSE = ["--speed-step", "7000rpm", "--torque-step", "582Nm"]


def gearmap(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True,
                          timeout=600, env={**os.environ, "GEARSET": str(EV1)})


def sweep(source, path, *options):
    """By one thread: models are simulated in processes of their own, and with
    AddressSanitizer a process that begins while another thread allocates may wait for ever."""
    done = gearmap("sweep", source, "-o", path, *COARSE, "--threads", 1, "--json", *options)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


class Map:
    def __init__(self, path):
        connection = sqlite3.connect(path)
        self.meta = dict(connection.execute("SELECT key, value FROM meta"))
        self.values = {tuple(key): value for *key, value in connection.execute(
            "SELECT symbol, path, gear_0, direction_0, direction_1, round(line_ratio, 3), i, j, k, "
            "value FROM map_table t JOIN value v ON v.map_table = t.id")}
        self.inertia = self.meta["inertia_output"]
        self.ratio = [row[0] for row in connection.execute("SELECT ratio FROM gear")]

    def agrees_with(self, other):
        """Torques at the output and at the path: the uncertainty is that of the larger
        ones. D is a difference of two measured torques, and so counts them twice."""
        allowed = 2.0 * (self.meta["loss_uncertainty"] + other.meta["loss_uncertainty"])
        assert self.values.keys() == other.values.keys()
        for key, value in self.values.items():
            assert value == pytest.approx(other.values[key], abs=allowed), key
        relative = self.meta["inertia_uncertainty"] + other.meta["inertia_uncertainty"]
        assert self.inertia == pytest.approx(other.inertia, rel=relative)
        assert self.ratio == pytest.approx(other.ratio, rel=1e-6)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("experiments")


@pytest.fixture(scope="module")
def solved(folder):
    sweep(EV1, folder / "solved.map")
    return Map(folder / "solved.map")


@pytest.fixture(scope="module")
def settled(folder):
    sweep(EV1, folder / "settled.map", "--losses", "settle", "--inertia", "ramps")
    return Map(folder / "settled.map")


def test_what_is_solved_has_no_uncertainty(solved):
    assert solved.meta["losses_by"] == "steady" and solved.meta["inertia_by"] == "mass-matrix"
    assert solved.meta["loss_uncertainty"] == solved.meta["inertia_uncertainty"] == 0.0


def test_the_built_in_model_settles_to_what_is_solved(solved, settled):
    assert settled.meta["losses_by"] == "settle" and settled.meta["inertia_by"] == "ramps"
    # of a largest loss of 18 N.m, and of the inertia: an estimate that says something
    assert 0.0 < settled.meta["loss_uncertainty"] < 0.05
    assert 0.0 < settled.meta["inertia_uncertainty"] < 2e-3
    settled.agrees_with(solved)


def test_ramps_agree_with_what_is_solved(folder, solved):
    told = sweep(EV1, folder / "ramps.map", "--losses", "ramp", "--ramp-time", "0.5s")
    ramps = Map(folder / "ramps.map")
    assert told["losses"] == "ramp" and told["inertia"] == "mass-matrix"
    assert told["uncertainty_Nm"] == ramps.meta["loss_uncertainty"] > 0.0
    ramps.agrees_with(solved)


def test_slower_ramps_are_more_certain(folder):
    fast = sweep(EV1, folder / "r.map", "--losses", "ramp", "--ramp-time", "0.05s")
    slow = sweep(EV1, folder / "r.map", "--losses", "ramp", "--ramp-time", "0.4s")
    assert slow["uncertainty_Nm"] < 0.5 * fast["uncertainty_Nm"]
    assert slow["content_hash"] != fast["content_hash"]


def test_losses_and_inertias_are_chosen_apart(folder, solved):
    told = sweep(EV1, folder / "i.map", "--inertia", "ramps")
    mixed = Map(folder / "i.map")
    assert told["losses"] == "steady" and told["uncertainty_Nm"] == 0.0
    assert mixed.values == solved.values
    assert 0.0 < told["inertia_uncertainty"] and mixed.inertia != solved.inertia
    assert mixed.inertia == pytest.approx(solved.inertia, rel=told["inertia_uncertainty"])


def test_its_own_detailed_fmu_gives_the_same_map(folder, solved):
    fmu = folder / "ev1.fmu"
    assert gearmap("bake", "--detailed", EV1, "-o", fmu).returncode == 0
    assert gearmap("rig", fmu, "-o", folder / "fmu.yaml").returncode == 0
    sweep(folder / "fmu.yaml", folder / "fmu.map")
    Map(folder / "fmu.map").agrees_with(solved)


def test_the_compiled_model_gives_the_same_map(folder, solved, settled):
    inertia = sqlite3.connect(folder / "solved.map").execute("SELECT inertia FROM path").fetchone()
    rig = folder / "plugin.yaml"
    rig.write_text(f"""format: 1
name: ev1
model: {os.environ["GM_BUILTIN_PLUGIN"]}
limits: {{input_speed_max_rpm: 14000, input_torque_max_Nm: 582}}
oil_temperature_degC: 80
paths: {{input: {{neutral: false, inertia_kgm2: {inertia[0]!r}, gears: {{1: {{}}}}}}}}
""")
    sweep(rig, folder / "plugin.map")
    plugin = Map(folder / "plugin.map")
    plugin.agrees_with(solved)
    plugin.agrees_with(settled)


def test_the_text_says_how_sure_it_is(folder):
    done = gearmap("sweep", EV1, "-o", folder / "t.map", *COARSE, "--losses", "settle",
                   "--dwell", "0.02s")
    assert re.search(r"losses by settle, within \S+ N·m; inertia by mass-matrix\n", done.stdout)
    assert " by " not in gearmap("sweep", EV1, "-o", folder / "t.map", *COARSE).stdout


def test_a_component_can_be_made_from_measured_losses(folder):
    done = gearmap("reduce", EV1, "-o", folder / "r.fmu", "--map", folder / "r2.map", *COARSE,
                   "--losses", "settle", "--points", 20, "--json")
    assert done.returncode == 0, done.stderr
    result = json.loads(done.stdout)
    assert result["sweep"]["losses"] == "settle"
    assert Map(folder / "r2.map").meta["losses_by"] == "settle"


@pytest.mark.parametrize("options, words", [
    (["--losses", "steady"], "can only be simulated"),
    (["--inertia", "mass-matrix"], "has no mass matrix"),
    (["--losses", "soon"], "no experiment 'soon' for losses (steady, ramp, settle)"),
    (["--inertia", "scales"], "no experiment 'scales' for inertias (mass-matrix, ramps)"),
    (["--losses", "ramp"], "takes the speed of the output"),
])
def test_what_a_plant_cannot_do_is_refused_with_a_reason(tmp_path, options, words):
    foreign.make_fmu(tmp_path, "LAW_SPEED_OUTPUT")
    rig = foreign.make_rig(tmp_path, "LAW_SPEED_OUTPUT")
    done = gearmap("sweep", rig, "-o", tmp_path / "m.map", *options)
    assert done.returncode == 1 and done.stderr.count("\n") == 1 and words in done.stderr
    assert not (tmp_path / "m.map").exists()


@pytest.mark.parametrize("options, words", [
    (["--dwell", "1s"], "a dwell has no effect"),
    (["--ramp-time", "1s"], "a ramp time has no effect"),
    (["--ramp-time", "1s", "--losses", "settle"], "a ramp time has no effect"),
])
def test_what_would_have_no_effect_is_refused(tmp_path, options, words):
    done = gearmap("sweep", EV1, "-o", tmp_path / "m.map", *options)
    assert done.returncode == 1 and words in done.stderr


def test_the_rig_file_can_choose_ramps(tmp_path):
    foreign.make_fmu(tmp_path)
    rig = foreign.make_rig(tmp_path, extra="experiments: {losses: ramp}\n")
    text = re.sub(r"^ +(-1|[234]): \{.*\}\n", "", rig.read_text(), flags=re.MULTILINE)
    rig.write_text(text)
    coarse = ["--speed-step", "5730rpm", "--torque-step", "200Nm", "--json"]
    by_file = json.loads(gearmap("sweep", rig, "-o", tmp_path / "a.map", *coarse).stdout)
    chosen = json.loads(gearmap("sweep", rig, "-o", tmp_path / "b.map", *coarse, "--losses",
                                "settle").stdout)
    assert (by_file["losses"], chosen["losses"]) == ("ramp", "settle")
    assert by_file["uncertainty_Nm"] > chosen["uncertainty_Nm"] > 0.0
