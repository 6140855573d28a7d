# SPDX-License-Identifier: BSD-2-Clause
"""gearmap bake --format c: the folder, what it refuses, and that it computes what the FMU
computes. Targets, sizes and instructions: tests/embedded."""

import os
import sys
from pathlib import Path

import fmpy
import pytest
from conftest import fails, gearmap, result_of, succeeds

ROOT = Path(os.environ["GM_SOURCE_DIR"])
sys.path.insert(0, str(ROOT / "tests" / "embedded"))
from folder import Folder, run  # noqa: E402


def bake(map_file, path, *options):
    succeeds("bake", "--format", "c", *options, map_file, "-o", path)
    return Folder(path)


def files_of(path):
    return {str(f.relative_to(path)): f.read_bytes() for f in path.rglob("*") if f.is_file()}


def test_bakes_the_same_bytes_twice(example_map, tmp_path):
    bake(example_map, tmp_path / "a", "--tables", "int16")
    bake(example_map, tmp_path / "b", "--tables", "int16")
    assert files_of(tmp_path / "a") == files_of(tmp_path / "b")


def test_holds_the_core_as_it_stands(example_map, tmp_path):
    folder = bake(example_map, tmp_path / "c")
    core = {f.name: f.read_bytes() for f in (ROOT / "src" / "core").iterdir()
            if f.suffix in (".c", ".h", ".def")}
    baked = {f.name: f.read_bytes() for f in (folder.path / "core").iterdir()}
    assert core.pop("gm_config.h") != baked.pop("gm_config.h")
    assert core == baked


def test_json_of_a_bake(example_map, tmp_path):
    r = result_of("bake", "--format", "c", example_map, "-o", tmp_path / "c")
    assert r["files"] == len(files_of(tmp_path / "c"))
    assert 0 < r["nodes"] < r["map_nodes"]
    assert r["table_bytes"] > 4 * r["nodes"]
    assert 0 < r["largest_error_relative"] < 0.0031


def test_readme_states_sizes_and_errors(example_map, tmp_path):
    r = result_of("bake", "--format", "c", "--step", "2ms", example_map, "-o",
                  tmp_path / "c")
    text = (tmp_path / "c" / "README.md").read_text()
    assert f"| tables, `gm_calibration` | {r['table_bytes']} |" in text
    assert "GM_STEP, is 2 ms" in text
    for name in ("load loss", "both paths loaded", "parasitic loss"):
        assert f"| {name} |" in text
    assert "#define GM_STEP 0.002" in (tmp_path / "c" / "gm_tables.h").read_text()


def test_a_folder_with_other_files_is_refused(example_map, tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.tex").write_text("all of it")
    assert "other files" in fails("bake", "--format", "c", example_map, "-o",
                                  tmp_path / "mine")
    assert [f.name for f in (tmp_path / "mine").iterdir()] == ["thesis.tex"]
    assert "folder" in fails("bake", "--format", "c", example_map, "-o",
                             tmp_path / "mine" / "thesis.tex")


def test_an_earlier_bake_is_replaced(example_map, tmp_path):
    bake(example_map, tmp_path / "c", "--real", "double")
    (tmp_path / "c" / "notes.txt").write_text("mine")
    bake(example_map, tmp_path / "c", "--real", "float")
    files = files_of(tmp_path / "c")
    assert files.pop("notes.txt") == b"mine"
    bake(example_map, tmp_path / "d", "--real", "float")
    assert files == files_of(tmp_path / "d")


@pytest.mark.parametrize("arguments,word", [
    (["--format", "c", "--real", "half"], "--real"),
    (["--format", "c", "--tables", "int8"], "--tables"),
    (["--real", "float"], "--format c"), (["--step", "1ms"], "--format c"),
    (["--format", "c", "--step", "0ms"], "--step"),
    (["--format", "c", "--thin", "2"], "--thin")])
def test_wrong_options(example_map, tmp_path, arguments, word):
    done = gearmap("bake", *arguments, example_map, "-o", tmp_path / "x")
    assert done.returncode == 2
    assert word in done.stderr
    assert not (tmp_path / "x").exists()


@pytest.mark.parametrize("real,tables", [("float", "int16"), ("double", "float")])
def test_example_runs(example_map, tmp_path, real, tables):
    folder = bake(example_map, tmp_path / "c", "--real", real, "--tables", tables)
    run("cc", "-std=c99", "-O1", *folder.include, folder.path / "main.c",
        *folder.sources(), "-o", tmp_path / "example")
    lines = run(tmp_path / "example").splitlines()
    assert len(lines) == 11
    speeds = [float(line.split()[1]) for line in lines[1:]]
    assert 0 < speeds[0] < speeds[4] and speeds[9] < speeds[4]


def test_monotone_tables_work_too(example_map, tmp_path):
    folder = bake(example_map, tmp_path / "c", "--interpolation", "monotone", "--tables",
                  "int16")
    folder.start({"output.w_start": 20.0}, gears=(3, 0))
    folder.set({"odd.tau": 50.0, "even.tau": 0.0, "output.tau": -330.0, "odd.gear": 3,
                "even.gear": 0})
    assert folder.step(1e-3, 500) == 0
    assert 0 < folder.get("loss_energy") < 0.2 * folder.get("work") + 1000


SCRIPT = [  # ms, odd.tau, even.tau, output.tau, gears: start, shift, stop, hold, reverse
    (300, 0.0, 0.0, 0.0, (1, 0)), (800, 60.0, 0.0, -300.0, (1, 2)),
    (400, 0.0, 80.0, -500.0, (0, 2)), (300, -5.0, 70.0, -500.0, (3, 2)),
    (900, -60.0, 0.0, -250.0, (3, 0)), (500, 0.0, 0.0, -0.3, (3, 0)),
    (300, 0.0, 0.0, 0.0, (0, -1)), (500, 0.0, 30.0, 100.0, (0, -1)),
    (100, 0.0, 0.0, 0.0, (9, 0))]


@pytest.mark.parametrize("fidelity", [1, 2])
def test_double_computes_the_bits_of_the_fmu(example_map, example_fmu, tmp_path, fidelity):
    """Speeds and twists in Co-Simulation, at standstill too. Work and losses are added up
    in two parts here and in one there: equal to rounding."""
    folder = bake(example_map, tmp_path / "c", "--real", "double", "--thin", "0")
    d = fmpy.read_model_description(str(example_fmu))
    vr = {v.name: v.valueReference for v in d.modelVariables}
    fmu = fmpy.fmi2.FMU2Slave(
        guid=d.guid, unzipDirectory=fmpy.extract(str(example_fmu), str(tmp_path / "u")),
        modelIdentifier=d.coSimulation.modelIdentifier, instanceName="f")
    fmu.instantiate()
    fmu.setupExperiment()
    fmu.setInteger([vr["fidelity"], vr["odd.gear"]], [fidelity, 1])
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    assert folder.start({}, fidelity, gears=(1, 0)) == 0
    step, stood = 0, 0
    for steps, odd, even, out, gears in SCRIPT:
        folder.set({"odd.tau": odd, "even.tau": even, "output.tau": out,
                    "odd.gear": gears[0], "even.gear": gears[1]})
        fmu.setReal([vr["odd.tau"], vr["even.tau"], vr["output.tau"]], [odd, even, out])
        fmu.setInteger([vr["odd.gear"], vr["even.gear"]], gears)
        for _ in range(steps):
            folder.step(1e-3, 1)
            fmu.doStep(step * 1e-3, 1e-3)
            step += 1
            names = ["output.w", "odd.w", "even.w", "odd.twist", "even.twist"]
            truth = fmu.getReal([vr[n] for n in names])
            assert [folder.get(n) for n in names] == truth, step
            stood += truth[0] == 0.0
    energies = fmu.getReal([vr["work"], vr["loss_energy"], vr["output.phi"]])
    fmu.terminate()
    fmu.freeInstance()
    assert stood > 100
    for name, truth in zip(("work", "loss_energy", "output.phi"), energies):
        assert folder.get(name) == pytest.approx(truth, rel=1e-12, abs=1e-9)


def test_abuse_is_harmless(example_map, tmp_path):
    """1e5 random steps, many with NaN, under the undefined-behaviour sanitizer."""
    folder = bake(example_map, tmp_path / "c")
    program = folder.build("host", "abuse", "-fsanitize=undefined,float-cast-overflow",
                           "-fno-sanitize-recover=all")
    assert run(program, 100000, 7).startswith("100000 steps")
