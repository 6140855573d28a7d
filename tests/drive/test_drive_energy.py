# SPDX-License-Identifier: BSD-2-Clause
"""A 60 s drive with shifts and a stop on a hill: energy from outside and from inside."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(os.environ["GM_SOURCE_DIR"])
sys.path.insert(0, str(ROOT / "bench"))
import drive_energy  # noqa: E402


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """The drive at 2 ms and at 1 ms, with the FMU and the map as the command makes them."""
    folder = tmp_path_factory.mktemp("drive")
    for arguments in (["sweep", ROOT / "examples" / "dct7.yaml", "-o", folder / "dct7.map"],
                      ["bake", folder / "dct7.map", "-o", folder / "dct7.fmu"]):
        subprocess.run([os.environ["GEARMAP"], *map(str, arguments)], check=True,
                       stdin=subprocess.DEVNULL, capture_output=True)
    return drive_energy.run(folder / "dct7.fmu", folder / "dct7.map", [2e-3, 1e-3])


def test_the_work_of_the_flanges_is_what_was_stored_and_lost(results):
    """Losses by a separate reading of the map. 0.1 % of the losses is the promise."""
    assert abs(drive_energy.difference(results[1])) < 1e-3


def test_the_difference_falls_with_the_step(results):
    """Second order in smooth motion, first order where friction changes sign: at least
    half at half the step, unless it is below what the recorded speeds resolve (1e-6)."""
    coarse, fine = (abs(drive_energy.difference(r)) for r in results)
    assert fine <= max(0.55 * coarse, 1e-6)


def test_the_components_own_account_closes(results):
    for result in results:
        assert result["own"] <= 1e-9 * result["own_work"]


def test_held_on_the_hill_nothing_creeps(results):
    """The twisted paths ease the output into rest without a swing back, so that it ends at
    the edge of what friction holds; there rounding is left, some 1e-18 rad/s."""
    for result in results:
        assert result["creep"] < 1e-15


def test_the_drive_went_as_meant(results):
    """Driving off again on the hill after the stop: otherwise the account proves little."""
    for result in results:
        assert result["speed"] > 3.0
