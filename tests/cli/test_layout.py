# SPDX-License-Identifier: BSD-2-Clause
"""Every file in examples/ could be built: what turns on different axes and does not mesh
is apart. Parts are the cylinders of shafts, gears with their tip circles (addendum one
module) and bearings of known size."""

import math
import sys
from collections import namedtuple
from itertools import combinations

import pytest
from conftest import ROOT

sys.path.insert(0, str(ROOT / "tests"))
from plain_yaml import block, logical_lines  # noqa: E402

FILES = [f for f in sorted((ROOT / "examples").glob("*.yaml"))
         if not f.name.startswith("vehicle_")]
Cylinder = namedtuple("Cylinder", "name shaft axis start end radius bore")
GAP_MM = 0.5  # assumption: less would not turn freely


def tip_radius(gear):
    pitch = gear["teeth"] * gear["normal_module_mm"] / math.cos(
        math.radians(gear.get("helix_deg", 0)))
    return pitch / 2 + gear["normal_module_mm"] * (1 + gear.get("profile_shift", 0))


def axes(gearset, gear):
    """Where a gear turns: on the axis of its shaft, or planets around it."""
    shaft = gearset["shafts"][gear["shaft"]]
    n, r = gear.get("planets", 1), gear.get("pin_radius_mm", 0)
    for k in range(n):
        angle = math.radians(gear.get("pin_angle_deg", 0) + 360 * k / n)
        yield shaft["y_mm"] + r * math.cos(angle), shaft["z_mm"] + r * math.sin(angle)


def cylinders(gearset):
    """All parts but gears with internal teeth."""
    for name, shaft in gearset["shafts"].items():
        for s in shaft["segments"]:
            yield Cylinder(name, name, (shaft["y_mm"], shaft["z_mm"]), s["from_mm"],
                           s["to_mm"], s["diameter_mm"] / 2, s.get("bore_mm", 0) / 2)
    for name, gear in gearset["gears"].items():
        half = gear["width_mm"] / 2
        for axis in axes(gearset, gear):
            if not gear.get("internal"):
                yield Cylinder(name, gear["shaft"], axis, gear["position_mm"] - half,
                               gear["position_mm"] + half, tip_radius(gear), 0)
    for name, bearing in gearset["bearings"].items():
        if "outer_mm" in bearing and "width_mm" in bearing:
            half, shaft = bearing["width_mm"] / 2, gearset["shafts"][bearing["shaft"]]
            yield Cylinder(name, bearing["shaft"], (shaft["y_mm"], shaft["z_mm"]),
                           bearing["position_mm"] - half, bearing["position_mm"] + half,
                           bearing["outer_mm"] / 2, 0)


def gap(a, b):
    """Distance of two cylinders that overlap along x, beside or inside each other; else
    infinity, as for parts of one shaft and parts around one axis."""
    distance = math.dist(a.axis, b.axis)
    if min(a.end, b.end) <= max(a.start, b.start) or a.shaft == b.shaft and \
            a.shaft in (a.name, b.name) or distance == 0:
        return math.inf
    return max(distance - a.radius - b.radius, a.bore - distance - b.radius,
               b.bore - distance - a.radius)


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_parts_on_different_axes_are_apart(file):
    gearset = block(logical_lines(file.read_text()), 0)
    mates = {frozenset(m["gears"]) for m in gearset["meshes"].values()}
    close = [(a.name, b.name, round(gap(a, b), 2))
             for a, b in combinations(cylinders(gearset), 2)
             if frozenset((a.name, b.name)) not in mates and gap(a, b) < GAP_MM]
    assert close == []
