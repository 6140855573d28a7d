# SPDX-License-Identifier: BSD-2-Clause
"""Energy lost while the torque reverses ten times a second, detailed and reduced."""

import os
import subprocess
from pathlib import Path

import pytest

EXAMPLE = Path(os.environ["GM_SOURCE_DIR"]) / "examples" / "dct7.yaml"
PROGRAM = Path(os.environ["GM_BINARY_DIR"]) / "tests" / "drive" / "oscillating_torque"


@pytest.fixture(scope="module")
def lost(tmp_path_factory):
    """Difference of the lost energy in % by name, with a map of the default axes."""
    fmu = tmp_path_factory.mktemp("torque") / "dct7.fmu"
    subprocess.run([os.environ["GEARMAP"], "reduce", EXAMPLE, "-o", fmu, "--points", "100"],
                   check=True, stdin=subprocess.DEVNULL, capture_output=True)
    lines = subprocess.run([PROGRAM, EXAMPLE, fmu], check=True, capture_output=True,
                           text=True).stdout.splitlines()
    return {name: (float(energy), float(difference))
            for name, energy, difference in (line.split() for line in lines)}


def test_losses_follow_a_torque_that_reverses(lost):
    assert set(lost) == {"detailed", "rigid", "lash"}
    assert lost["detailed"][0] > 100
    assert abs(lost["lash"][1]) < 1
    # without backlash nothing is lost where flanks meet: a twelfth of the whole here
    assert -12 < lost["rigid"][1] < 0
