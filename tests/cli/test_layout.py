# SPDX-License-Identifier: BSD-2-Clause
"""Every file in examples/ could be built: what turns on different axes and does not mesh is
apart. Parts are the cylinders of shafts, gears with their tip circles (addendum one
module) and bearings of known size."""

import math
import sys
from itertools import combinations

import pytest
from conftest import ROOT

sys.path.insert(0, str(ROOT / "tests"))
from plain_yaml import block, logical_lines  # noqa: E402

FILES = sorted((ROOT / "examples").glob("*.yaml"))
GAP_MM = 0.5  # assumption: less would not turn freely


def tip_radius(gear):
    pitch = gear["teeth"] * gear["normal_module_mm"] / math.cos(
        math.radians(gear.get("helix_deg", 0)))
    return pitch / 2 + gear["normal_module_mm"] * (1 + gear.get("profile_shift", 0))


def cylinders(gearset):
    """(name, shaft, from, to, radius) of all parts."""
    for name, shaft in gearset["shafts"].items():
        for s in shaft["segments"]:
            yield name, name, s["from_mm"], s["to_mm"], s["diameter_mm"] / 2
    for name, gear in gearset["gears"].items():
        half = gear["width_mm"] / 2
        yield (name, gear["shaft"], gear["position_mm"] - half, gear["position_mm"] + half,
               tip_radius(gear))
    for name, bearing in gearset["bearings"].items():
        if "outer_mm" in bearing and "width_mm" in bearing:
            half = bearing["width_mm"] / 2
            yield (name, bearing["shaft"], bearing["position_mm"] - half,
                   bearing["position_mm"] + half, bearing["outer_mm"] / 2)


def gap(gearset, a, b):
    """Radial distance of two cylinders that overlap along x, infinity if they do not."""
    if min(a[3], b[3]) <= max(a[2], b[2]):
        return math.inf
    p, q = gearset["shafts"][a[1]], gearset["shafts"][b[1]]
    distance = math.hypot(p["y_mm"] - q["y_mm"], p["z_mm"] - q["z_mm"])
    return math.inf if distance == 0 else distance - a[4] - b[4]


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_parts_on_different_axes_are_apart(file):
    gearset = block(logical_lines(file.read_text()), 0)
    mates = {frozenset(m["gears"]) for m in gearset["meshes"].values()}
    close = [(a[0], b[0], round(gap(gearset, a, b), 2))
             for a, b in combinations(cylinders(gearset), 2)
             if frozenset((a[0], b[0])) not in mates and gap(gearset, a, b) < GAP_MM]
    assert close == []
