# SPDX-License-Identifier: BSD-2-Clause
"""FMUs of the example gearsets and the drive that all importers repeat. run.sh says in
the environment where the tools are: GEARMAP, GM_SOURCE_DIR, GM_FMI_SIM."""

import json
import os
import re
import subprocess
from pathlib import Path
from types import SimpleNamespace

import fmpy
import numpy as np
import pytest

import drive

ROOT = Path(os.environ["GM_SOURCE_DIR"])
GEARMAP = os.environ["GEARMAP"]
H, ROWS = drive.Fine.H, drive.Fine.ROWS
START = {"output.w_start": 10.0, "loss_scale": 1.25}

COMPLAINT = re.compile(r"warn|error|fail|invalid|panic", re.I)
# libcosim says so of every FMU that has enumerations
EXCUSED = re.compile(r"FMI 2\.0 Enumeration variable type not supported")


def complaints(said):
    return [line for line in said.splitlines()
            if COMPLAINT.search(line) and not EXCUSED.search(line)]


def gears(example):
    text = subprocess.run([GEARMAP, "check", example, "--json"], check=True,
                          capture_output=True, text=True).stdout
    return {p["name"]: {g["number"]: g["ratio"] for g in p["gears"]}
            for p in json.loads(text)["paths"]}


@pytest.fixture(scope="session", params=["dct7", "mt5"])
def example(request, tmp_path_factory):
    """.fmu, .map, .folder (unpacked), .description, .gears, .rows (drive.Fine), .outputs"""
    folder = tmp_path_factory.mktemp(request.param)
    source, fmu = ROOT / f"examples/{request.param}.yaml", folder / f"{request.param}.fmu"
    subprocess.run([GEARMAP, "reduce", source, "-o", fmu, "--map", folder / "example.map"], check=True,
                   capture_output=True)
    unpacked = fmpy.extract(str(fmu), unzipdir=str(folder / "unpacked"))
    description = fmpy.read_model_description(str(fmu))
    outputs = [v.name for v in description.modelVariables if v.causality == "output"]
    gearset = gears(source)
    rows = drive.steer(drive.Fine, description, unpacked, gearset, START)
    return SimpleNamespace(fmu=str(fmu), map=folder / "example.map", folder=Path(unpacked), description=description,
                           gears=gearset, rows=rows, outputs=outputs)


def signals_of(times, rows):
    """The rows as fmpy takes them."""
    dtype = [("time", float)] + [(n, int if n.endswith(".gear") else float) for n in rows[0]]
    return np.array([(t, *row.values()) for t, row in zip(times, rows)], dtype=dtype)


@pytest.fixture(scope="session")
def reference(example):
    """The drive in fmpy: {output: value after each step}; what the FMU said is in "log"."""
    log = []
    result = fmpy.simulate_fmu(
        example.fmu, fmi_type="CoSimulation", stop_time=ROWS * H, step_size=H, output_interval=H,
        input=signals_of(H * np.arange(ROWS + 1), example.rows), start_values=START,
        output=example.outputs, logger=lambda *said: log.append(said[2:]))
    assert len(result) == ROWS + 1
    return {"log": log, **{n: result[n][1:].astype(float) for n in example.outputs}}
