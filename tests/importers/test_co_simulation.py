# SPDX-License-Identifier: BSD-2-Clause
"""The same drive in different importers gives the same numbers, and none of them has
anything to complain about."""

import csv
import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import H, ROWS, START, complaints

import drive

HERE = Path(__file__).parent
# relative to the largest value of the variable, or to 1
TOLERANCE = 1e-12


def assert_same(result, reference, outputs):
    for name in outputs:
        mine, theirs = reference[name], np.asarray(result[name], dtype=float)
        assert mine.shape == theirs.shape, name
        limit = TOLERANCE * max(1.0, np.abs(mine).max())
        assert np.abs(mine - theirs).max() <= limit, name


def test_the_drive_is_worth_repeating(example, reference):
    """All gears, three states, both directions; within the map throughout."""
    for path in {n.split(".")[0] for n in example.rows[0]} - {"output"}:
        declared = next(v for v in example.description.modelVariables
                        if v.name == f"{path}.gear").declaredType
        assert {r[f"{path}.gear"] for r in example.rows} & {int(declared.min), 0,
                                                            int(declared.max)}
        assert set(reference[f"{path}.state"]) == {0, 1, 2}
        assert reference[f"{path}.w"].min() < -50 and reference[f"{path}.w"].max() > 50
    assert not reference["out_of_map"].any()
    assert reference["log"] == []


def run_host(script, example, outputs, folder):
    """In a process of its own: such an importer may take down the one it runs in, also
    while it leaves; so what counts is the complete result, not the exit code."""
    job, result = folder / "job.json", folder / "result.json"
    job.write_text(json.dumps({
        "fmu": example.fmu, "step": drive.Fine.NANOSECONDS, "start": START,
        "rows": example.rows[:ROWS], "outputs": outputs}))
    done = subprocess.run([sys.executable, HERE / script, job, result], capture_output=True,
                          text=True, timeout=300, cwd=folder)
    said = done.stdout + done.stderr
    assert result.exists(), said
    assert complaints(said) == []
    return json.loads(result.read_text())


@pytest.mark.parametrize("script", ["host_cosim.py", "host_ecos.py"])
def test_other_co_simulators(script, example, reference, tmp_path):
    """Neither of the two knows enumerations."""
    enumerations = {v.name for v in example.description.modelVariables
                    if v.type == "Enumeration"}
    names = [n for n in example.outputs if n not in enumerations]
    assert_same(run_host(script, example, names, tmp_path), reference, names)


def write_inputs(rows, file):
    """fmi-sim reads what is discrete at the time t from the last row before t, so these
    stand one row earlier."""
    names = list(rows[0])
    with open(file, "w", newline="") as out:
        writer = csv.writer(out)
        writer.writerow(["time", *names])
        for k, row in enumerate(rows):
            after = rows[min(k + 1, len(rows) - 1)]
            writer.writerow([k * H] + [(after if n.endswith(".gear") else row)[n]
                                             for n in names])


def test_fmi_sim(example, reference, tmp_path):
    inputs, outputs = tmp_path / "inputs.csv", tmp_path / "outputs.csv"
    write_inputs(example.rows, inputs)
    start = [word for n, v in START.items() for word in ("--init-values", f"{n}={v}")]
    done = subprocess.run(
        [os.environ["GM_FMI_SIM"], "--model", example.fmu, "-i", inputs, "-o", outputs,
         "-v", "co-simulation", "-s", "0", "-f", str(ROWS * H),
         "--output-interval", str(H), *start], capture_output=True, text=True)
    said = done.stdout + done.stderr
    assert done.returncode == 0 and complaints(said) == [], said
    with open(outputs, newline="") as file:
        rows = list(csv.DictReader(file))
    number = {"true": 1.0, "false": 0.0}
    result = {n: [number[r[n]] if r[n] in number else float(r[n]) for r in rows][1:]
              for n in example.outputs}
    assert_same(result, reference, example.outputs)
