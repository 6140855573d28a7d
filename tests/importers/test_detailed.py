# SPDX-License-Identifier: BSD-2-Clause
"""The detailed gearset as an FMU in validators and importers made by others."""

import csv
import os
import subprocess
import sys
from pathlib import Path

import fmpy
import numpy as np
import pytest
from conftest import GEARMAP, ROOT, complaints

BIN = Path(sys.executable).parent
SCHEMA = Path(fmpy.__file__).parent / "schema/fmi2/fmi2ModelDescription.xsd"


@pytest.fixture(scope="module", params=["at3_simpson", "at4_ravigneaux", "dct6_wet", "dct7",
                                        "ev1", "mt5"])
def detailed(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp(request.param)
    fmu = folder / f"{request.param}.fmu"
    subprocess.run([GEARMAP, "bake", "--detailed", ROOT / f"examples/{request.param}.yaml",
                    "-o", fmu], check=True, capture_output=True)
    fmpy.extract(str(fmu), unzipdir=str(folder / "unpacked"))
    return fmu


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def test_validators(detailed):
    unpacked = detailed.parent / "unpacked"
    code, said = run(BIN / "fmpy", "validate", detailed)
    assert (code, said.strip()) == (0, "No problems found.")
    file = unpacked / "modelDescription.xml"
    code, said = run("xmllint", "--noout", "--schema", SCHEMA, file)
    assert (code, said.strip()) == (0, f"{file} validates")
    code, said = run("xmllint", "--noout", "--html", unpacked / "documentation/index.html")
    assert (code, said.strip()) == (0, "")
    code, said = run(BIN / "fmutool", "-input", detailed, "-check")
    assert code == 0 and "No semantic error against the FMI-2 standard." in said, said
    assert not any(line.startswith(("WARN", "ERROR", "CRITICAL"))
                   for line in said.splitlines()), said


def test_fmi_sim(detailed, tmp_path):
    """Its Euler and fmpy's: the same numbers, at steps that follow the meshes."""
    inputs, outputs, h = tmp_path / "i.csv", tmp_path / "o.csv", 1 / 2**23
    inputs.write_text("time,output.tau\n0,5\n1,5\n")
    code, said = run(os.environ["GM_FMI_SIM"], "--model", detailed, "-i", inputs, "-o", outputs,
                     "model-exchange", "-s", "0", "-f", str(100 * h), "--output-interval",
                     str(h), "--init-values", "output.w_start=1")
    assert code == 0 and complaints(said) == [], said[-2000:]
    with open(outputs, newline="") as file:
        last = [row for row in csv.DictReader(file) if float(row["time"]) <= 100 * h][-1]
    mine = fmpy.simulate_fmu(
        str(detailed), fmi_type="ModelExchange", solver="Euler", step_size=h,
        output_interval=h, stop_time=100 * h, start_values={"output.w_start": 1.0},
        input=np.array([(0.0, 5.0), (1.0, 5.0)],
                       dtype=[("time", float), ("output.tau", float)]))
    for name in ("output.w", "output.phi", "work", "loss_energy", "kinetic_energy"):
        assert float(last[name]) == pytest.approx(mine[name][-1], rel=1e-9), name
