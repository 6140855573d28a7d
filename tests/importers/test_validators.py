# SPDX-License-Identifier: BSD-2-Clause
"""What validators say of the FMU: nothing."""

import os
import shutil
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import fmpy
import numpy as np
import pytest

BIN = Path(sys.executable).parent
SCHEMA = Path(fmpy.__file__).parent / "schema/fmi2/fmi2ModelDescription.xsd"


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def test_fmpy_validate(example):
    code, said = run(BIN / "fmpy", "validate", example.fmu)
    assert (code, said.strip()) == (0, "No problems found.")


def test_schema(example):
    file = example.folder / "modelDescription.xml"
    code, said = run("xmllint", "--noout", "--schema", SCHEMA, file)
    assert (code, said.strip()) == (0, f"{file} validates")


def test_page_is_well_formed(example):
    code, said = run("xmllint", "--noout", "--html",
                     example.folder / "documentation/index.html")
    assert (code, said.strip()) == (0, "")


def test_fmutool_check(example):
    code, said = run(BIN / "fmutool", "-input", example.fmu, "-check")
    assert code == 0, said
    assert "This FMU seems to be compliant with FMI-2.0." in said
    assert "No semantic error against the FMI-2 standard." in said
    assert not any(line.startswith(("WARN", "ERROR", "CRITICAL")) for line in
                   said.splitlines()), said


def test_speeds_in(example, tmp_path):
    """The FMU with motion in at its first path and at the output."""
    fmu = tmp_path / "speed_in.fmu"
    flanges = f"{next(iter(example.gears))},output"
    subprocess.run([os.environ["GEARMAP"], "bake", example.map, "--speed-in", flanges, "-o", fmu],
                   check=True, capture_output=True)
    unpacked = Path(fmpy.extract(str(fmu), unzipdir=str(tmp_path / "unpacked")))
    variant = SimpleNamespace(fmu=str(fmu), folder=unpacked)
    test_fmpy_validate(variant)
    test_schema(variant)
    test_page_is_well_formed(variant)
    test_fmutool_check(variant)


def result(fmu):
    return fmpy.simulate_fmu(
        str(fmu), fmi_type="CoSimulation", stop_time=2.0, step_size=1 / 512,
        output_interval=1 / 512, start_values={"output.w_start": 20.0, "output.tau": 3.0})


def test_fmpy_compile_from_the_sources_alone(example, tmp_path):
    """Built by fmpy's own build (Release, C11, position independent), the same numbers."""
    bare, fmu = tmp_path / "bare", tmp_path / "bare.fmu"
    shutil.copytree(example.folder, bare)
    shutil.rmtree(bare / "binaries")
    shutil.make_archive(str(fmu), "zip", bare)
    os.rename(f"{fmu}.zip", fmu)
    with pytest.raises(Exception):
        result(fmu)
    code, said = run(BIN / "fmpy", "compile", "--all-warnings", "--warning-as-error", fmu)
    assert code == 0, said
    again, shipped = result(fmu), result(example.fmu)
    for name in shipped.dtype.names:
        assert np.array_equal(again[name], shipped[name]), name
