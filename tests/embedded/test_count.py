# SPDX-License-Identifier: BSD-2-Clause
"""Instructions of one step on the Cortex-M4F: not more than the README states."""

import pytest

from conftest import STEPS
from folder import measured


@pytest.fixture(scope="module")
def counts(bake):
    """{(fidelity, situation): (steps, median, 99 %, largest)}"""
    text = bake("float", "float").execute("m4", "count", min(max(STEPS // 20, 1000), 10000))
    print(text)
    rows = [line.split() for line in text.splitlines()]
    return {(r[0], r[1]): tuple(int(x) for x in r[2:]) for r in rows if len(r) == 6
            and r[0] in ("rigid", "lash")}


@pytest.mark.parametrize("fidelity", ["rigid", "lash"])
def test_instructions(counts, fidelity):
    stated = measured()
    assert counts[fidelity, "drive"][1] <= stated[f"{fidelity}_median"]
    assert counts[fidelity, "drive"][3] <= stated[f"{fidelity}_drive"]
    worst = max(counts[fidelity, name][3] for name in ("drive", "random", "cold"))
    assert worst <= stated[f"{fidelity}_worst"]
