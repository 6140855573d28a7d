# SPDX-License-Identifier: BSD-2-Clause
"""Folders of plain C of the 7-speed example. run.sh says in the environment where the
command is (GEARMAP); GM_EMBEDDED_STEPS sets how long random tests run."""

import os
import sys
from pathlib import Path

import pytest

from folder import Folder, run, write_records

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tests" / "fmu"))
import ece15  # noqa: E402

GEARMAP = os.environ["GEARMAP"]
STEPS = int(os.environ.get("GM_EMBEDDED_STEPS", "100000"))
RATIOS = {1: 16.705882352941178, 2: 10.085227272727273, 3: 6.794921875}  # of the example


@pytest.fixture(scope="session")
def map_file(tmp_path_factory):
    path = tmp_path_factory.mktemp("map") / "dct7.map"
    run(GEARMAP, "sweep", ROOT / "examples" / "dct7.yaml", "-o", path)
    return path


@pytest.fixture(scope="session")
def bake(map_file, tmp_path_factory):
    """bake(real, tables): the folder, baked once."""
    done = {}

    def folder(real="float", tables="float"):
        if (real, tables) not in done:
            path = tmp_path_factory.mktemp("bake") / f"{real}_{tables}"
            run(GEARMAP, "bake", "--format", "c", "--real", real, "--tables", tables,
                map_file, "-o", path)
            done[real, tables] = Folder(path)
        return done[real, tables]
    return folder


@pytest.fixture(scope="session")
def records(bake, tmp_path_factory):
    """Recorded inputs of an ECE-15 run on a rig."""
    path = tmp_path_factory.mktemp("records") / "ece15.bin"
    rows = ece15.record(bake("double"), RATIOS)
    write_records(path, rows, round(ece15.HOLD / 1e-3))
    return path
