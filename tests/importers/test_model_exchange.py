# SPDX-License-Identifier: BSD-2-Clause
"""Model Exchange in importers, against Co-Simulation of the same drive."""

import csv
import os
import subprocess
from types import SimpleNamespace

import fmpy
import numpy as np
import pytest
from conftest import START, complaints, signals_of

import drive

KIND = drive.Coarse
END = KIND.ROWS * KIND.H
RIGID = {**START, "fidelity": 1}  # explicit solvers cannot follow springs at these steps


@pytest.fixture(scope="module")
def driven(example):
    """.names, .times and .rows with each row's begin and end, .reference: Co-Simulation in
    small steps, at the rows"""
    rows = drive.steer(KIND, example.description, example.folder, example.gears, RIGID)
    names = ["output.w", "output.phi", "loss_energy", "work", "kinetic_energy",
             *(f"{p}.w" for p in example.gears)]
    reference = drive.replay(KIND, example.description, example.folder, rows, RIGID, names, 64)
    return SimpleNamespace(
        names=names, times=[(k + end) * KIND.H for k in range(KIND.ROWS) for end in (0, 1)],
        rows=[rows[k] for k in range(KIND.ROWS) for _ in range(2)],
        reference={n: np.array(v) for n, v in reference.items()})


def simulate(example, driven, **options):
    log = []
    result = fmpy.simulate_fmu(
        example.fmu, fmi_type="ModelExchange", stop_time=END, start_values=RIGID,
        input=signals_of(driven.times, driven.rows), output=driven.names,
        logger=lambda *said: log.append(said[2:]), **options)
    assert log == []
    return result


def at_rows(result, name):
    """Values at the rows. At an event there are two values of one time; the later counts."""
    at = np.searchsorted(result["time"], KIND.H * np.arange(KIND.ROWS + 1) + 1e-9) - 1
    return np.asarray(result[name])[at]


def worst(result, driven):
    """Largest difference of any variable, relative to its largest value."""
    return max(np.abs(at_rows(result, n) - driven.reference[n]).max() /
               np.abs(driven.reference[n]).max() for n in driven.names)


def test_cvode(example, driven):
    """Converges to the trajectory of Co-Simulation."""
    coarse, fine = (worst(simulate(example, driven, solver="CVode", output_interval=KIND.H,
                                   relative_tolerance=tolerance), driven)
                    for tolerance in (1e-4, 1e-6))
    assert fine < 1e-3 and fine < 0.1 * coarse


def test_euler(example, driven):
    """Converges too, with its first order."""
    coarse, fine = (worst(simulate(example, driven, solver="Euler", step_size=h,
                                   output_interval=h), driven)
                    for h in (KIND.H / 64, KIND.H / 256))
    assert fine < 1e-2 and fine < 0.5 * coarse


def test_fmi_sim(example, driven, tmp_path):
    """Its Euler takes the steps of fmpy's: the same numbers."""
    h = KIND.H / 64
    inputs, outputs = tmp_path / "inputs.csv", tmp_path / "outputs.csv"
    with open(inputs, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["time", *driven.rows[0]])
        writer.writerows([t, *row.values()] for t, row in zip(driven.times, driven.rows))
    start = [word for n, v in RIGID.items() for word in ("--init-values", f"{n}={v}")]
    done = subprocess.run(
        [os.environ["GM_FMI_SIM"], "--model", example.fmu, "-i", inputs, "-o", outputs,
         "model-exchange", "-s", "0", "-f", str(END), "--output-interval", str(h), *start],
        capture_output=True, text=True)
    said = done.stdout + done.stderr
    assert done.returncode == 0 and complaints(said) == [], said[-2000:]
    with open(outputs, newline="") as file:
        rows = list(csv.DictReader(file))
    result = {n: np.array([float(r[n]) for r in rows]) for n in ["time", *driven.names]}
    theirs = simulate(example, driven, solver="Euler", step_size=h, output_interval=h)
    for name in driven.names:
        limit = 1e-12 * np.abs(driven.reference[name]).max()
        assert np.abs(at_rows(result, name) - at_rows(theirs, name)).max() <= limit, name
