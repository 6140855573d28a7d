# SPDX-License-Identifier: BSD-2-Clause
"""Random inputs and NaN under the sanitizers: no undefined behaviour, a valid state."""

import pytest

from conftest import STEPS
from folder import run

SANITIZERS = ["-fsanitize=undefined,address,float-cast-overflow",
              "-fno-sanitize-recover=all", "-g"]


@pytest.mark.parametrize("real,tables", [("float", "float"), ("float", "int16"),
                                         ("double", "float")])
def test_abuse_is_harmless(bake, real, tables):
    program = bake(real, tables).build("host", "abuse", *SANITIZERS)
    said = run(program, STEPS, 1)
    steps, refused = int(said.split()[0]), int(said.split()[2])
    assert steps == STEPS
    assert refused > STEPS / 100  # or the abuse was none
