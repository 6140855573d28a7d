# SPDX-License-Identifier: BSD-2-Clause
"""FMUs of the example gearsets and the drive that all importers repeat. run.sh says in
the environment where the tools are: GEARMAP, GM_SOURCE_DIR, GM_FMI_SIM."""

import json
import os
import subprocess
from pathlib import Path
from types import SimpleNamespace

import fmpy
import numpy as np
import pytest

import drive

ROOT = Path(os.environ["GM_SOURCE_DIR"])
GEARMAP = os.environ["GEARMAP"]
START = {"output.w_start": 10.0, "loss_scale": 1.25}


def gears(example):
    text = subprocess.run([GEARMAP, "check", example, "--json"], check=True,
                          capture_output=True, text=True).stdout
    return {p["name"]: {g["number"]: g["ratio"] for g in p["gears"]}
            for p in json.loads(text)["paths"]}


@pytest.fixture(scope="session", params=["dct7", "mt5"])
def example(request, tmp_path_factory):
    """.fmu, .folder (unpacked), .description, .rows, .outputs"""
    folder = tmp_path_factory.mktemp(request.param)
    source, fmu = ROOT / f"examples/{request.param}.yaml", folder / f"{request.param}.fmu"
    subprocess.run([GEARMAP, "reduce", source, "-o", fmu], check=True, capture_output=True)
    unpacked = fmpy.extract(str(fmu), unzipdir=str(folder / "unpacked"))
    description = fmpy.read_model_description(str(fmu))
    outputs = [v.name for v in description.modelVariables if v.causality == "output"]
    rows = drive.steer(description, unpacked, gears(source), START)
    return SimpleNamespace(fmu=str(fmu), folder=Path(unpacked), description=description,
                           rows=rows, outputs=outputs)


@pytest.fixture(scope="session")
def reference(example):
    """The drive in fmpy: {output: value after each step}; what the FMU said is in "log"."""
    dtype = [("time", float)] + [(n, int if n.endswith(".gear") else float)
                                 for n in example.rows[0]]
    signals = np.array([(k * drive.H, *row.values()) for k, row in enumerate(example.rows)],
                       dtype=dtype)
    log = []
    result = fmpy.simulate_fmu(
        example.fmu, fmi_type="CoSimulation", stop_time=drive.STEPS * drive.H,
        step_size=drive.H, output_interval=drive.H, input=signals, start_values=START,
        output=example.outputs, initialize=True, logger=lambda *said: log.append(said[2:]))
    assert len(result) == drive.STEPS + 1
    return {"log": log, **{n: result[n][1:].astype(float) for n in example.outputs}}
