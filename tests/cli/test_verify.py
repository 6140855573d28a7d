# SPDX-License-Identifier: BSD-2-Clause
"""gearmap verify and reduce: the schema of the result, its reproducibility, failures."""

import json
import re
import subprocess
import zipfile
from pathlib import Path

import pytest
from conftest import COARSE, EXAMPLE, PROGRAM, fails, result_of, succeeds


@pytest.fixture(scope="module")
def verified(example_fmu):
    return result_of("verify", EXAMPLE, example_fmu, "--steady", "--points", "200",
                     "--seed", "7")


TWO_SPEED = Path(__file__).with_name("two_speed.yaml")


def check_case(case):
    assert set(case) >= {"path", "gear", "direction", "largest_loss_Nm", "max_Nm", "rms_Nm",
                         "max_relative", "rms_relative", "worst"}
    assert set(case["worst"]) == {"speed_rpm", "torque_Nm"}
    assert 0 <= case["rms_Nm"] <= case["max_Nm"] * (1 + 1e-12)
    if case["largest_loss_Nm"] > 0:
        assert case["max_relative"] == pytest.approx(case["max_Nm"] / case["largest_loss_Nm"])


def test_schema_of_the_result(verified):
    assert verified["points"] == 200 and verified["seed"] == 7
    assert verified["cases"]
    for case in verified["cases"]:
        check_case(case)
        assert isinstance(case["gear"], int) and case["path"] in ("odd", "even")
        assert case["direction"] in ("forward", "backward")
        assert case["largest_loss_Nm"] > 0
    assert verified["max_relative"] == max(c["max_relative"] for c in verified["cases"])
    assert set(verified["groups"]) and "cases" in next(iter(verified["groups"].values()))
    for group in verified["groups"].values():
        for case in group["cases"]:
            check_case(case)


def test_every_gear_is_visited_in_both_directions(verified):
    seen = {(c["gear"], c["direction"]) for c in verified["cases"]}
    assert seen == {(g, d) for g in (-1, 1, 2, 3, 4, 5, 6, 7) for d in ("forward", "backward")}


def test_a_coarse_component_is_near_the_detailed_model(verified):
    # on the coarse axes of this test (1500 rpm) the curved parasitic loss is met by
    # straight lines: several percent; a wrong sign or gear would give tens of percent
    assert 0 < verified["max_relative"] < 0.3
    assert verified["rms_relative"] < verified["max_relative"]


def test_the_same_seed_gives_the_same_result(verified, example_fmu):
    again = result_of("verify", EXAMPLE, example_fmu, "--steady", "--points", "200",
                      "--seed", "7")
    other = result_of("verify", EXAMPLE, example_fmu, "--steady", "--points", "200",
                      "--seed", "8")
    assert again["cases"] == verified["cases"]
    assert other["cases"] != verified["cases"]


def test_another_oil_is_refused(example_fmu):
    assert fails("verify", EXAMPLE, example_fmu, "--steady", "--points", "10",
                 "--oil-temperature", "20degC") == \
        f"{example_fmu}: was made for an oil temperature of 80 degC, not 20 degC"
    succeeds("verify", EXAMPLE, example_fmu, "--steady", "--points", "10",
             "--oil-temperature", "353.15K")


def test_the_component_knows_its_oil(tmp_path, verified):
    """A component for cold oil is as near to the model in cold oil, unasked."""
    cold = tmp_path / "cold.fmu"
    succeeds("reduce", EXAMPLE, "-o", cold, "--points", "10", "--oil-temperature", "20degC",
             *COARSE)
    r = result_of("verify", EXAMPLE, cold, "--steady", "--points", "200", "--seed", "7")
    assert r["same_description"] is True
    # the same coarse axes, a loss about twice as large and of the same shape: the model at
    # 80 degC would be half of the largest loss away
    assert r["rms_relative"] < 2 * verified["rms_relative"]


def test_a_changed_description_is_told(example_fmu, tmp_path, verified):
    assert verified["same_description"] is True
    changed = tmp_path / "changed.yaml"
    changed.write_text(EXAMPLE.read_text() + "# a comment\n")
    done = succeeds("verify", changed, example_fmu, "--steady", "--points", "10", "--json")
    assert json.loads(done.stdout)["same_description"] is False
    assert done.stderr == f"gearmap: note: {example_fmu} was made from another description " \
        f"than {changed}, or from another version of it\n"
    same = succeeds("verify", EXAMPLE, example_fmu, "--steady", "--points", "10")
    assert same.stderr == ""


def rewritten(fmu, path, change):
    """A copy of the component whose model description went through `change`."""
    with zipfile.ZipFile(fmu) as old, zipfile.ZipFile(path, "w") as new:
        for name in old.namelist():
            data = old.read(name)
            if name == "modelDescription.xml":
                text = change(data.decode())
                assert text != data.decode()
                data = text.encode()
            new.writestr(name, data)
    return path


def test_a_component_of_another_tool_is_compared(example_fmu, tmp_path):
    path = rewritten(example_fmu, tmp_path / "other.fmu",
                     lambda text: text.replace('<Tool name="gearmap">', '<Tool name="other">'))
    done = succeeds("verify", EXAMPLE, path, "--steady", "--points", "10", "--json")
    assert json.loads(done.stdout)["same_description"] is False
    assert done.stderr == f"gearmap: note: {path} does not say whether it was made from {EXAMPLE}\n"


@pytest.mark.parametrize("variable", ["odd.gear", "even.gear_refused", "odd.loss_torque"])
def test_a_component_without_a_variable(variable, example_fmu, tmp_path):
    path = rewritten(example_fmu, tmp_path / "less.fmu",
                     lambda text: text.replace(f'name="{variable}"', f'name="{variable}x"'))
    assert fails("verify", EXAMPLE, path, "--steady", "--points", "10") == \
        f"{path}: the FMU has no variable {variable}"


def test_a_component_without_a_gear(tmp_path):
    """Same paths and variables, but what is gear 2 here is gear 3 there."""
    text = TWO_SPEED.read_text()
    renamed = text.replace("2: {lock: driven_2}", "3: {lock: driven_2}")
    assert renamed != text
    description, fmu = tmp_path / "renamed.yaml", tmp_path / "renamed.fmu"
    description.write_text(renamed)
    succeeds("reduce", description, "-o", fmu, "--points", "10", *COARSE)
    assert fails("verify", TWO_SPEED, fmu, "--steady", "--points", "10") == \
        f"{fmu}: has no gear 2 on path input"


def test_text_shows_every_case(verified, example_fmu):
    text = succeeds("verify", EXAMPLE, example_fmu, "--steady", "--points", "200",
                    "--seed", "7").stdout
    for case in verified["cases"]:
        assert re.search(rf"^ +{case['path']} +{case['gear']} +{case['direction']} ", text, re.M)


def test_reduce_does_it_all(tmp_path):
    r = result_of("reduce", EXAMPLE, "-o", tmp_path / "a.fmu", "--points", "50", *COARSE)
    assert r["bake"]["fmu"] == str(tmp_path / "a.fmu")
    assert r["bake"]["size_bytes"] == (tmp_path / "a.fmu").stat().st_size
    assert r["sweep"]["map"] is None
    assert r["verify"]["points"] == 50
    stages = r["sweep"]["elapsed_s"] + r["bake"]["elapsed_s"] + r["verify"]["elapsed_s"]
    assert stages <= r["elapsed_s"] * (1 + 1e-9)
    assert [p.name for p in tmp_path.iterdir()] == ["a.fmu"]


def test_reduce_keeps_the_map_when_asked(tmp_path):
    r = result_of("reduce", EXAMPLE, "-o", tmp_path / "a.fmu", "--map", tmp_path / "a.map",
                  "--points", "50", *COARSE)
    succeeds("bake", tmp_path / "a.map", "-o", tmp_path / "b.fmu")
    assert (tmp_path / "a.fmu").read_bytes() == (tmp_path / "b.fmu").read_bytes()
    assert r["sweep"]["size_bytes"] == (tmp_path / "a.map").stat().st_size
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.fmu", "a.map", "b.fmu"]


def test_reduce_prints_a_summary(tmp_path):
    text = succeeds("reduce", EXAMPLE, "-o", tmp_path / "a.fmu", "--points", "50",
                    *COARSE).stdout
    for stage in ("sweep", "bake", "verify", "total"):
        assert re.search(rf"^{stage} +\d+\.\d\d s", text, re.M)


def test_reduce_without_a_compiler_leaves_nothing(tmp_path):
    assert "compiler" in fails("reduce", EXAMPLE, "-o", tmp_path / "a.fmu", *COARSE,
                               env={"PATH": str(tmp_path), "CC": ""})
    assert list(tmp_path.iterdir()) == []


def test_one_name_for_both_outputs_is_refused(tmp_path):
    name = tmp_path / "a"
    assert fails("reduce", EXAMPLE, "-o", name, "--map", name) == \
        f"{name}: cannot be both the map and the component"


@pytest.mark.parametrize("output, map_name", [
    ("a", "./a"), ("a", "../here/a"), ("./a", "a"), ("../link/a", "a")])
def test_one_place_by_two_names_is_refused(output, map_name, tmp_path):
    here = tmp_path / "here"
    here.mkdir()
    (tmp_path / "link").symlink_to(here)
    assert fails("reduce", EXAMPLE, "-o", output, "--map", map_name, cwd=here) == \
        f"{map_name}: cannot be both the map and the component"
    assert list(here.iterdir()) == []


def test_reductions_to_one_place_do_not_meet(tmp_path):
    """Each verifies what it made itself: a component of the one gearset would not pass
    for the other."""
    output = tmp_path / "a.fmu"
    # the small gearset is done first, while the other has its component half made
    both = [subprocess.Popen([PROGRAM, "reduce", file, "-o", output, "--points", "20", *COARSE],
                             stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            for file in (EXAMPLE, TWO_SPEED, EXAMPLE)]
    for run in both:
        _, words = run.communicate(timeout=300)
        assert run.returncode == 0, words
    assert [p.name for p in tmp_path.iterdir()] == ["a.fmu"]
    assert zipfile.ZipFile(output).testzip() is None


@pytest.mark.parametrize("output", [">/dev/full", ">&-"])
@pytest.mark.parametrize("command, file", [("sweep", "a.map"), ("reduce", "a.fmu")])
def test_a_result_that_cannot_be_printed_undoes_no_file(command, file, output, tmp_path):
    done = subprocess.run(
        ["sh", "-c", f'exec "$@" {output}', "sh", PROGRAM, command, EXAMPLE, "-o", file, *COARSE],
        cwd=tmp_path, stderr=subprocess.PIPE, text=True)
    assert done.returncode == 1
    assert done.stderr == "gearmap: the standard output could not be written\n"
    assert [p.name for p in tmp_path.iterdir()] == [file]
    if command == "sweep":
        succeeds("bake", tmp_path / file, "-o", tmp_path / "b.fmu")
    else:
        succeeds("verify", EXAMPLE, tmp_path / file, "--steady", "--points", "10")


def verify_fails(fmu, *words):
    sentence = fails("verify", EXAMPLE, fmu, "--steady", "--points", "10")
    for word in words:
        assert word in sentence


def test_a_missing_component(tmp_path):
    verify_fails(tmp_path / "none.fmu", "none.fmu")


def test_a_description_is_no_component():
    verify_fails(EXAMPLE, str(EXAMPLE))


def test_a_truncated_component(example_fmu, tmp_path):
    path = tmp_path / "short.fmu"
    path.write_bytes(example_fmu.read_bytes()[:20000])
    verify_fails(path, "short.fmu")


def test_an_archive_without_a_model_description(tmp_path):
    path = tmp_path / "empty.fmu"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("readme.txt", "nothing")
    verify_fails(path, "empty.fmu")


def test_a_component_without_a_binary(example_fmu, tmp_path):
    path = tmp_path / "sources.fmu"
    with zipfile.ZipFile(example_fmu) as old, zipfile.ZipFile(path, "w") as new:
        for name in old.namelist():
            if not name.startswith("binaries/"):
                new.writestr(name, old.read(name))
    verify_fails(path, "sources.fmu")
