# SPDX-License-Identifier: BSD-2-Clause
"""Foreign FMUs and plug-ins whose losses are known in closed form, through the command."""

import ctypes
import json
import os
import shutil
import sqlite3
import subprocess
import zipfile
from pathlib import Path

import foreign
import pytest

PROGRAM = os.environ["GEARMAP"]
COARSE = ["--speed-step", "1433rpm", "--torque-step", "100Nm"]
VARIANTS = ["LAW_RIGID", "LAW_ELASTIC", "LAW_TWO_PATHS", "LAW_SPEED_INPUT",
            "LAW_SPEED_OUTPUT", "LAW_SPEED_BOTH"]


class Law:
    """The closed forms of law.c for one variant."""

    def __init__(self, folder, variant):
        self.library = ctypes.CDLL(str(self.build(folder)))
        self.variant = VARIANTS.index(variant)
        for name in ("of_parasitic", "of_load", "of_drag", "of_reaction", "of_inertia"):
            getattr(self.library, name).restype = ctypes.c_double

    @staticmethod
    def build(folder):
        code = folder / "closed.c"
        code.write_text('''#include "law.h"
double of_parasitic(int v, int g0, int g1, double t, double w)
{ law l = law_of(v); int g[2] = {g0, g1}; return law_parasitic(&l, g, t, w); }
double of_load(int v, int p, int g, double w, double t)
{ law l = law_of(v); return law_load(&l, p, g, w, t); }
double of_drag(int v, int p, double w, double s, double o)
{ law l = law_of(v); return law_drag(&l, p, w, s, o); }
double of_reaction(int v, int p, double w)
{ law l = law_of(v); return law_reaction(&l, p, w); }
double of_inertia(int v, int f)
{ law l = law_of(v); return f ? l.path[f - 1].inertia : l.inertia_output; }
''')
        subprocess.run([foreign.CC, "-std=c11", "-fPIC", "-shared", f"-I{foreign.ROOT}/tests/rig",
                        code, foreign.ROOT / "tests/rig/law.c", "-lm", "-o", folder / "closed.so"],
                       check=True)
        return folder / "closed.so"

    def __call__(self, name, *numbers):
        arguments = [ctypes.c_int(n) if isinstance(n, int) else ctypes.c_double(n)
                     for n in numbers]
        return getattr(self.library, f"of_{name}")(ctypes.c_int(self.variant), *arguments)


def axes(connection):
    found = {}
    for axis, i, x in connection.execute("SELECT axis, i, x FROM axis_value ORDER BY axis, i"):
        found.setdefault(axis, []).append(x)
    return found


def check_map(path, law, temperature=353.15):
    """Losses within 0.1 % of each table's largest, inertias 0.1 %, ratios 1e-6."""
    connection = sqlite3.connect(path)
    nodes = axes(connection)
    checked = 0
    for table, symbol, p, g0, g1, d0, d1, a0, a1 in connection.execute(
            "SELECT id, symbol, path, gear_0, gear_1, direction_0, direction_1, axis_0, axis_1 "
            "FROM map_table").fetchall():
        if symbol not in ("parasitic_loss", "load_loss", "drag", "reaction"):
            continue
        if symbol == "parasitic_loss" and g0 and g1:
            continue  # both engaged: see test_rig_law.c
        sign = -1.0 if d0 == "backward" else 1.0
        pairs = []
        for i, j, value in connection.execute(
                "SELECT i, j, value FROM value WHERE map_table = ?", (table,)):
            x = nodes[a0][i]
            y = nodes[a1][j] if a1 is not None else 0.0
            if symbol == "parasitic_loss":
                truth = law("parasitic", g0, g1 or 0, temperature, x)
            elif symbol == "load_loss":
                truth = law("load", p, g1 if p else g0, x, y)
            elif symbol == "drag":
                truth = law("drag", p, sign * x, sign, (-1.0 if d1 == "backward" else 1.0) * y)
            else:
                truth = law("reaction", p, sign * x)
            pairs.append((value, truth))
        largest = max(abs(truth) for _, truth in pairs)
        worst = max(abs(value - truth) for value, truth in pairs)
        assert worst <= 1e-3 * largest, (symbol, p, g0, g1, d0, d1, worst, largest)
        checked += len(pairs)
    assert checked > 500
    for p, inertia in connection.execute("SELECT path, inertia FROM path"):
        assert inertia == pytest.approx(law("inertia", 1 + p), rel=1e-3)
    output = connection.execute("SELECT value FROM meta WHERE key = 'inertia_output'").fetchone()
    assert float(output[0]) == pytest.approx(law("inertia", 0), rel=1e-3)
    for ratio, given in connection.execute("SELECT ratio, ratio_given FROM gear"):
        assert ratio == pytest.approx(given, rel=1e-6)


# A sanitizer would turn the crash of a model into a report of its own.
UNCAUGHT = {"ASAN_OPTIONS": "handle_segv=0:handle_abort=0:handle_sigfpe=0"}


def gearmap(*arguments, env=None):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True,
                          timeout=600, env={**os.environ, **(env or {})})


@pytest.mark.parametrize("variant, version, mode, defines", [
    ("LAW_RIGID", 2, "cs", ()),
    ("LAW_RIGID", 2, "me", ()),
    ("LAW_RIGID", 3, "cs", ()),
    ("LAW_RIGID", 3, "me", ()),
    ("LAW_RIGID", 2, "me", ("LAW_ODD_UNITS",)),
    ("LAW_ELASTIC", 3, "me", ()),
    ("LAW_TWO_PATHS", 3, "me", ()),
    ("LAW_SPEED_INPUT", 2, "cs", ()),
])
def test_losses_in_closed_form_are_found(tmp_path, variant, version, mode, defines):
    foreign.make_fmu(tmp_path, variant, version, (mode,), defines)
    rig = foreign.make_rig(tmp_path, variant, minus=bool(defines))
    temporary = tmp_path / "tmp"
    temporary.mkdir()
    done = gearmap("sweep", rig, "-o", tmp_path / "m.map", *COARSE,
                   env={"TMPDIR": str(temporary)})
    assert done.returncode == 0, done.stderr
    check_map(tmp_path / "m.map", Law(tmp_path, variant))
    assert list(temporary.iterdir()) == []


def test_temperature_reaches_the_model_in_its_unit(tmp_path):
    foreign.make_fmu(tmp_path, modes=("me",), defines=("LAW_ODD_UNITS",))
    rig = foreign.make_rig(tmp_path, minus=True)
    done = gearmap("sweep", rig, "-o", tmp_path / "m.map", *COARSE, "--oil-temperature",
                   "40degC")
    assert done.returncode == 0, done.stderr
    check_map(tmp_path / "m.map", Law(tmp_path, "LAW_RIGID"), 313.15)


def test_reduce_measures_the_component_against_the_foreign_model(tmp_path):
    foreign.make_fmu(tmp_path, modes=("me",))
    rig = foreign.make_rig(tmp_path)
    done = gearmap("reduce", rig, "-o", tmp_path / "law_reduced.fmu", "--points", 50, *COARSE)
    assert done.returncode == 0, done.stderr
    assert "one path engaged" in done.stdout


def test_the_plugin_example_builds_as_its_page_says_and_sweeps(tmp_path):
    folder = shutil.copytree(foreign.ROOT / "examples/plugin", tmp_path / "plugin")
    command = next(line.strip() for line in (folder / "README.md").read_text().splitlines()
                   if line.strip().startswith("cc "))
    command = command.replace("../../src/plant", str(foreign.ROOT / "src/plant"))
    subprocess.run([foreign.CC, *command.split()[1:]], cwd=folder, check=True)
    done = gearmap("sweep", folder / "reducer.yaml", "-o", tmp_path / "m.map")
    assert done.returncode == 0, done.stderr
    connection = sqlite3.connect(tmp_path / "m.map")
    for gear, ratio in ((1, 12.5), (2, 7.2)):
        found, speed, torque, loss = connection.execute(
            "SELECT g.ratio, speed_rpm, torque_Nm, loss_torque_Nm FROM v_load_loss l "
            "JOIN v_gear g ON g.gear = l.gear WHERE l.gear = ? AND path_direction = 'forward' "
            "ORDER BY torque_Nm DESC, speed_rpm DESC", (gear,)).fetchone()
        assert found == pytest.approx(ratio, rel=1e-6)
        # the teeth's share of what the input's bearings leave of the torque, less their share
        # without torque, which belongs to P
        drag = 0.05 + 0.0004 * speed * 3.141592653589793 / 30
        assert loss == pytest.approx(0.015 * (torque - drag) - 0.015 * drag, rel=1e-3)


@pytest.mark.parametrize("trouble, words", [
    (1, "the model crashed"), (2, "did not answer within"), (3, "is not a number"),
    (4, "answered Error"), (5, "answered Discard")])
def test_points_with_trouble_are_skipped_and_named(tmp_path, trouble, words):
    foreign.make_fmu(tmp_path, defines=(f"LAW_TROUBLE={trouble}",))
    rig = foreign.make_rig(tmp_path, extra="experiments: {time_limit_s: 2}\n")
    temporary = tmp_path / "tmp"
    temporary.mkdir()
    done = gearmap("sweep", rig, "-o", tmp_path / "m.map", *COARSE, "--json",
                   env={"TMPDIR": str(temporary), **UNCAUGHT})
    assert done.returncode == 3, done.stderr
    result = json.loads(done.stdout)
    # above 400 rad/s there are the nodes at 450 and 600, below zero those at -200 and -100:
    # in one gear, in both directions of rotation (driven there, driving backward)
    assert 4 <= len(result["skipped"]) <= 8
    for sentence in result["skipped"]:
        assert words in sentence and "gears (2, 0)" in sentence
        assert f"gearmap: warning: skipped: {sentence}\n" in done.stderr
    assert list(temporary.iterdir()) == []
    # at the output, whose largest loss is 60 N.m; standstill bends most
    assert 0 < result["uncertainty_Nm"] < 0.1


def test_points_with_trouble_are_left_out_of_a_verification(tmp_path):
    foreign.make_fmu(tmp_path, defines=("LAW_TROUBLE=3",))
    rig = foreign.make_rig(tmp_path)
    done = gearmap("reduce", rig, "-o", tmp_path / "small.fmu", *COARSE, "--points", 100, "--json")
    assert done.returncode == 3, done.stderr
    left_out = json.loads(done.stdout)["verify"]["skipped"]
    # gear 2 of 5 above two thirds of the speed, half of the torques
    assert 1 <= left_out <= 30
    assert f"failed at {left_out} points of the verification" in done.stderr
    done = gearmap("verify", rig, tmp_path / "small.fmu", "--steady", "--points", 100)
    assert done.returncode == 3 and f"failed at {left_out} points" in done.stderr


def test_points_with_trouble_are_counted_in_a_batch(tmp_path):
    foreign.make_fmu(tmp_path, defines=("LAW_TROUBLE=3",))
    foreign.make_rig(tmp_path)
    batch = ("batch", tmp_path, "-o", tmp_path / "out", *COARSE, "--points", 100, "--json")
    for state in ("done", "kept"):
        done = gearmap(*batch)
        assert done.returncode == 3, done.stderr
        variant, = json.loads(done.stdout)["variants"]
        assert variant["state"] == state and variant["skipped_points"] >= 4
    # other experiments: nothing of the earlier run is kept
    done = gearmap(*batch, "--dwell", "10ms")
    assert json.loads(done.stdout)["variants"][0]["state"] != "kept"


@pytest.mark.parametrize("change, words", [
    ({"token": "{other}"}, "cannot be instantiated: the GUID is"),
    ({"version": 3, "token": "{other}"}, "cannot be instantiated"),
])
def test_a_wrong_token_is_refused(tmp_path, change, words):
    foreign.make_fmu(tmp_path, **change)
    done = gearmap("sweep", foreign.make_rig(tmp_path), "-o", tmp_path / "m.map")
    assert done.returncode == 1 and words in done.stderr
    assert done.stderr.count("\n") == 1
    assert not (tmp_path / "m.map").exists()


BOMB = ('<?xml version="1.0"?><!DOCTYPE b [<!ENTITY a0 "ha">' + "".join(
    f'<!ENTITY a{i + 1} "{f"&a{i};" * 10}">' for i in range(12)) +
    ']><fmiModelDescription fmiVersion="2.0" modelName="&a12;" guid="&a12;"/>')


@pytest.mark.parametrize("entries, words", [
    ({"../outside.txt": "x"}, "would leave its folder"),
    ({"/tmp/gearmap_outside.txt": "x"}, "would leave its folder"),
    ({"modelDescription.xml": "<fmiModelDescription"}, "not well-formed"),
    ({"modelDescription.xml": BOMB}, "law.fmu:"),
    ({}, "modelDescription.xml is missing"),
    ({"modelDescription.xml": None}, "has no library for this platform"),
    ({"modelDescription.xml": None, "binaries/linux64/law.so": "no library"},
     "cannot be loaded"),
    ({"modelDescription.xml": b"\0" * (600 << 20)}, "more than 512 MB"),
])
def test_malformed_fmus_are_refused_and_nothing_stays(tmp_path, entries, words):
    inside = tmp_path / "tmp" / "deep"
    inside.mkdir(parents=True)
    good = foreign.description("LAW_RIGID", 2, ("cs",), False, foreign.TOKEN)
    with zipfile.ZipFile(tmp_path / "law.fmu", "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in entries.items():
            archive.writestr(name, good if content is None else content)
    rig = foreign.make_rig(tmp_path)
    before = sorted(tmp_path.rglob("*"))
    done = gearmap("sweep", rig, "-o", tmp_path / "m.map", env={"TMPDIR": str(inside)})
    assert done.returncode == 1 and words in done.stderr
    assert done.stderr.count("\n") == 1
    assert sorted(tmp_path.rglob("*")) == before
    assert not Path("/tmp/gearmap_outside.txt").exists()


@pytest.mark.parametrize("find, put, words", [
    ("limits:", "limit:", "rig.yaml:4: unknown key 'limit'; did you mean 'limits'?"),
    ("input.tau", "input.torque", "the FMU has no variable 'input.torque'"),
    ("{ratio: 14.0}", "{ratio: fourteen}", "rig.yaml:"),
    ("{ratio: 14.0}", "{ratio: 14.1}", "given ratio 14.1, the model makes 14"),
    ("output.w}", "output.w, unit: furlong}", "unit 'furlong'"),
    ("limits:", "parameters: {a: {variable: b.c, value: 1}}\nlimits:", "no variable 'b.c' to set"),
    ("model: law.fmu", "model: none.fmu", "none.fmu: cannot be opened"),
    ("input:\n", "entry:\n", "expected odd and even, or one named input"),
    ("speed: {variable: input.w}", "speed: {variable: input.tau}", "does not"),
])
def test_a_wrong_rig_file_is_told_with_its_place(tmp_path, find, put, words):
    foreign.make_fmu(tmp_path, modes=("me",))
    rig = foreign.make_rig(tmp_path)
    text = rig.read_text()
    assert find in text
    rig.write_text(text.replace(find, put, 1))
    done = gearmap("sweep", rig, "-o", tmp_path / "m.map", *COARSE)
    assert done.returncode == 1
    assert done.stderr.count("\n") == 1 and words in done.stderr


def test_other_commands_say_that_they_need_a_description(tmp_path):
    foreign.make_fmu(tmp_path)
    rig = foreign.make_rig(tmp_path)
    done = gearmap("check", rig)
    assert done.returncode == 1 and "is a rig file" in done.stderr
    assert "`creep_rad_s`" in gearmap("help", "rig-file").stdout
