# SPDX-License-Identifier: BSD-2-Clause
"""What the command line tests share: the command, small maps made once, and the form
that every failure must have."""

import json
import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(os.environ["GM_SOURCE_DIR"])
PROGRAM = os.environ["GEARMAP"]
EXAMPLE = ROOT / "examples" / "dct7.yaml"
COARSE = ["--speed-step", "1500rpm", "--torque-step", "100Nm"]


def gearmap(*arguments, env=None, cwd=None):
    """Run the command; its output is captured, so that no progress bar is drawn."""
    return subprocess.run(
        [PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=300,
        stdin=subprocess.DEVNULL, env={**os.environ, **(env or {})}, cwd=cwd)


def succeeds(*arguments, **options):
    done = gearmap(*arguments, **options)
    assert done.returncode == 0, done.stderr
    return done


def result_of(*arguments, **options):
    """The command's JSON. NaN and infinity are no JSON and are refused."""
    def refuse(text):
        raise ValueError(f"{text} in JSON")
    return json.loads(succeeds(*arguments, "--json", **options).stdout, parse_constant=refuse)


def fails(*arguments, code=1, **options):
    """The sentence of a failure: one line, nothing on the standard output."""
    done = gearmap(*arguments, **options)
    assert done.returncode == code, done.stdout + done.stderr
    assert done.stdout == ""
    lines = done.stderr.splitlines()
    assert len(lines) == 1, done.stderr
    assert lines[0].startswith("gearmap: ")
    return lines[0].removeprefix("gearmap: ")


@pytest.fixture(scope="session")
def example_map(tmp_path_factory):
    """A coarse map of the example."""
    path = tmp_path_factory.mktemp("map") / "dct7.map"
    succeeds("sweep", EXAMPLE, "-o", path, *COARSE)
    return path


@pytest.fixture(scope="session")
def example_fmu(tmp_path_factory, example_map):
    path = tmp_path_factory.mktemp("fmu") / "dct7.fmu"
    succeeds("bake", example_map, "-o", path)
    return path
