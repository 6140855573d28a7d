# SPDX-License-Identifier: BSD-2-Clause
"""gearmap rig: the first rig file gives the map of the one written by hand."""

import json
import os
import re
import sqlite3
import subprocess
import zipfile
from pathlib import Path

import foreign
import pytest

PROGRAM = os.environ["GEARMAP"]
COARSE = ["--speed-step", "2865rpm", "--torque-step", "200Nm"]


def gearmap(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True,
                          timeout=600)


def guessed(fmu, rig, *options):
    done = gearmap("rig", fmu, "-o", rig, *options)
    assert done.returncode == 0, done.stderr
    text = rig.read_text()
    count = re.search(r"(\d+) guessed(?:, (\d+) to be filled in)?", done.stdout)
    assert int(count[1]) == text.count("# guessed: ")
    assert int(count[2] or 0) == to_fill_in(text)
    return text


def to_fill_in(text):
    return re.sub("#.*", "", text).count("TODO")


def swept(rig, name):
    done = gearmap("sweep", rig, "-o", rig.parent / name, *COARSE)
    assert done.returncode == 0, done.stderr
    return rig.parent / name


def tables(path):
    """Values by what identifies a table, and the inertias."""
    connection = sqlite3.connect(path)
    found = {}
    for *key, value in connection.execute(
            "SELECT symbol, path, gear_0, gear_1, direction_0, direction_1, round(line_ratio, 3), value "
            "FROM map_table t JOIN value v ON v.map_table = t.id ORDER BY t.id, i, j"):
        found.setdefault(tuple(key), []).append(value)
    found["inertia"] = [row[0] for row in connection.execute("SELECT inertia FROM path")]
    found["ratio"] = [row[0] for row in connection.execute("SELECT ratio FROM gear")]
    return found


def assert_same(a, b):
    """Ratios that are not given are seen first, so measurements differ within what they
    are good for: 0.1 % of the largest. Torques count as steady at 5e-8 of 200 N.m."""
    assert a.keys() == b.keys()
    for key in a:
        largest = max(map(abs, a[key] + b[key])) or 1.0
        assert a[key] == pytest.approx(b[key], abs=max(1e-3 * largest, 1e-5)), key


def few(rig):
    """Two gears of each path are enough here; the laws' own tests take all."""
    text = re.sub(r"^ +(-1|3|4): \{.*\}\n", "", rig.read_text(), flags=re.MULTILINE)
    rig.write_text(text)
    return rig


def fill_in(text, gears):
    """What the user does with TODO."""
    answers = {"input_speed_max_rpm: TODO": "input_speed_max_rpm: 5730",
               "input_torque_max_Nm: TODO": "input_torque_max_Nm: 200"}
    for before, after in answers.items():
        text = text.replace(before, after)
    for path in gears:
        listed = ", ".join(f"{g}: {{ratio: {r}}}" for g, r in path.items() if g in (1, 2))
        text = text.replace("gears: TODO", f"gears: {{{listed}}}", 1)
    return text


@pytest.mark.parametrize("variant, version, mode, defines", [
    ("LAW_RIGID", 2, "cs", ()),
    ("LAW_RIGID", 3, "cs", ()),
    ("LAW_RIGID", 2, "me", ("LAW_ODD_UNITS",)),
    ("LAW_RIGID", 3, "me", ("LAW_ODD_UNITS",)),
    ("LAW_ELASTIC", 3, "me", ()),
    ("LAW_TWO_PATHS", 3, "me", ()),
    ("LAW_SPEED_INPUT", 2, "cs", ()),
    ("LAW_SPEED_OUTPUT", 2, "cs", ()),
    ("LAW_SPEED_BOTH", 2, "cs", ()),
])
def test_the_map_is_that_of_the_rig_file_by_hand(tmp_path, variant, version, mode, defines):
    fmu = foreign.make_fmu(tmp_path, variant, version, (mode,), defines)
    by_hand = swept(few(foreign.make_rig(tmp_path, variant, minus=bool(defines))),
                    "hand.map")
    rig = tmp_path / "guess.yaml"
    text = guessed(fmu, rig)
    assert (to_fill_in(text) > 0) == (version == 2 or not defines)
    rig.write_text(fill_in(text, foreign.GEARS.get(variant, foreign.ONE_PATH)))
    assert_same(tables(swept(few(rig), "guess.map")), tables(by_hand))


def test_each_todo_is_asked_for_by_name(tmp_path):
    rig = tmp_path / "guess.yaml"
    text = guessed(foreign.make_fmu(tmp_path), rig)
    for field, value in (("input_speed_max_rpm", "5730"), ("input_torque_max_Nm", "200"),
                         ("gears", "{1: {}}")):
        done = gearmap("sweep", rig, "-o", tmp_path / "m.map", *COARSE)
        assert done.returncode == 1 and done.stderr.count("\n") == 1
        assert field in done.stderr and "TODO" in done.stderr
        text = text.replace(f"{field}: TODO", f"{field}: {value}")
        rig.write_text(text)
    swept(rig, "m.map")


def test_limits_on_the_command_line_leave_nothing_to_fill_in(tmp_path):
    fmu = foreign.make_fmu(tmp_path, version=3)
    text = guessed(fmu, tmp_path / "rig.yaml", "--speed-max", "600rad/s", "--torque-max", "200Nm")
    assert to_fill_in(text) == 0
    swept(tmp_path / "rig.yaml", "m.map")


@pytest.mark.parametrize("name", ["ev1", "mt5"])
def test_the_detailed_component_needs_nothing(tmp_path, name):
    """One without neutral, one with a single path and reverse."""
    fmu = tmp_path / "detailed.fmu"
    source = foreign.ROOT / f"examples/{name}.yaml"
    done = gearmap("bake", "--detailed", source, "-o", fmu)
    assert done.returncode == 0, done.stderr
    text = guessed(fmu, tmp_path / "rig.yaml")
    assert to_fill_in(text) == 0 and "# guessed" not in text
    assert gearmap("rig", fmu).stdout.replace(str(fmu), fmu.name) == text
    ratios = {int(n): float(r) for n, r in re.findall(r"(-?\d+): \{ratio: (\S+)\}", text)}
    if name == "ev1":
        text = text.replace("limits:", "experiments: {dwell_s: 0.02}\nlimits:")
        (tmp_path / "rig.yaml").write_text(text)
        connection = sqlite3.connect(swept(tmp_path / "rig.yaml", "m.map"))
        for number, ratio in connection.execute("SELECT gear, ratio FROM v_gear"):
            assert ratio == pytest.approx(ratios[number], rel=1e-6)
    else:
        assert sorted(ratios) == [-1, 1, 2, 3, 4, 5]


def test_the_reduced_component_needs_nothing(tmp_path):
    fmu = tmp_path / "reduced.fmu"
    source = foreign.ROOT / "examples/ev1.yaml"
    done = gearmap("reduce", source, "-o", fmu, "--map", tmp_path / "first.map", "--points", 10,
                   *COARSE)
    assert done.returncode == 0, done.stderr
    text = guessed(fmu, tmp_path / "rig.yaml")
    assert to_fill_in(text) == 0 and "# guessed" not in text and "co_simulation" in text
    swept(tmp_path / "rig.yaml", "again.map")


DESCRIPTION = '''<?xml version="1.0"?><fmiModelDescription fmiVersion="2.0" modelName="box" guid="g">
<CoSimulation modelIdentifier="box"/><TypeDefinitions><SimpleType name="Lever"><Enumeration>
<Item name="N" value="0"/><Item name="low" value="1"/><Item name="high" value="2"/></Enumeration>
</SimpleType></TypeDefinitions><ModelVariables>%s</ModelVariables><ModelStructure/>
</fmiModelDescription>'''


def looked_at(folder, variables):
    """The rig file of an FMU with these variables: (name, causality, element)."""
    lines = "".join(f'<ScalarVariable name="{name}" valueReference="{i}" causality="{causality}">'
                    f'<{element}/></ScalarVariable>'
                    for i, (name, causality, element) in enumerate(variables))
    with zipfile.ZipFile(folder / "box.fmu", "w") as archive:
        archive.writestr("modelDescription.xml", DESCRIPTION % lines)
    return gearmap("rig", folder / "box.fmu")


def test_names_of_other_tools_are_understood(tmp_path):
    text = looked_at(tmp_path, [
        ("tauEngine", "input", "Real"), ("omegaEngine", "output", "Real"),
        ("n_wheel", "input", 'Real unit="rpm"'), ("M_wheel", "output", 'Real unit="kNm"'),
        ("angleWheel", "input", 'Real unit="deg"'),
        ("leverPosition", "input", 'Enumeration declaredType="Lever"'),
        ("T_oil", "parameter", 'Real unit="degC" start="60"'),
        ("ambient", "input", 'Real unit="K"')]).stdout
    path, output = text[text.index("paths:"):].split("output:\n")
    assert 'torque: {variable: "tauEngine", unit: N.m}  # guessed: ' in path
    assert 'speed: {variable: "omegaEngine", unit: rad/s}' in path
    assert 'gear: {variable: "leverPosition"}' in path
    assert "      1: {}\n      2: {}\n" in path and "0: {}" not in path
    assert "drive: speed" in output and 'angle: {variable: "angleWheel"}  # deg' in output
    assert 'torque: {variable: "M_wheel"}  # kNm' in output
    assert 'oil_temperature: {variable: "T_oil"}  # degC' in text
    assert text.endswith('# inputs that keep their start values:\n#   "ambient"\n')


def test_two_inputs_and_what_is_left_over(tmp_path):
    text = looked_at(tmp_path, [
        ("clutch_2.M", "input", 'Real unit="N.m"'), ("clutch_2.n", "output", 'Real unit="rpm"'),
        ("clutch_1.M", "input", 'Real unit="N.m"'), ("clutch_1.n", "output", 'Real unit="rpm"'),
        ("load", "input", 'Real unit="N.m"'), ("vehicle", "output", 'Real unit="rpm"'),
        ("energy", "output", 'Real unit="J"')]).stdout
    odd, even = text[text.index("  odd:"):].split("  even:\n")
    assert '"clutch_1.M"' in odd and '"clutch_2.M"' in even.split("output:")[0]
    output = even.split("output:\n")[1]
    assert "drive: torque  # guessed: " in output and '"vehicle"' in output
    # no variable for gears: one gear without neutral, whose inertia only the user knows
    assert odd.count("neutral: false  # guessed") == 1 and "inertia_kgm2: TODO" in odd


@pytest.mark.parametrize("variables", [
    [], [("a.tau", "input", "Real"), ("a.w", "output", "Real")],
    [(f"s{i}.{what}", way, "Real") for i in "abcd" for what, way in
     (("tau", "input"), ("w", "output"))]])
def test_what_is_no_gearset_is_refused(tmp_path, variables):
    done = looked_at(tmp_path, variables)
    assert done.returncode == 1 and done.stdout == ""
    assert done.stderr.count("\n") == 1 and "shafts were found" in done.stderr


def test_the_counts_are_there_for_machines(tmp_path):
    fmu = foreign.make_fmu(tmp_path)
    done = gearmap("rig", fmu, "-o", tmp_path / "rig.yaml", "--json")
    assert json.loads(done.stdout) == {"rig": str(tmp_path / "rig.yaml"), "guessed": 1,
                                       "missing": 3}
    assert gearmap("rig", fmu, "--json").returncode == 2


def test_a_failure_leaves_no_file(tmp_path):
    (tmp_path / "no.fmu").write_text("no archive")
    done = gearmap("rig", tmp_path / "no.fmu", "-o", tmp_path / "rig.yaml")
    assert done.returncode == 1 and "not a zip archive" in done.stderr
    assert [file.name for file in tmp_path.iterdir()] == ["no.fmu"]


def test_the_fmu_is_named_from_another_folder(tmp_path, monkeypatch):
    foreign.make_fmu(tmp_path, version=3)
    (tmp_path / "rigs").mkdir()
    monkeypatch.chdir(tmp_path)
    rig = Path("rigs/rig.yaml")
    guessed(Path("law.fmu"), rig, "--speed-max", "5730rpm", "--torque-max", "200Nm")
    swept(rig, "m.map")
