# SPDX-License-Identifier: BSD-2-Clause
"""Shafts of a gearset unfolded into one plane, as in a section drawing.

Shafts on one axis stay together. The axis of the input comes first; every further axis
stands at its true distance from an axis that its gears mesh with, above or below. Where a
third axis closes a triangle (a differential with several pinions), only one of its
distances can be true: the other meshes are links. An axis that would lie on top of what
is drawn already is moved out, and all its meshes are links.
"""
from dataclasses import dataclass, field
from math import hypot

SAME_AXIS = 0.05  # mm: shafts of one axis may differ by 0.02
GAP = 8.0  # mm between what is drawn and an axis that had to move


@dataclass
class Axis:
    y: float
    z: float
    shafts: list = field(default_factory=list)  # names
    height: float = None  # in the drawing, upwards, mm


@dataclass
class Layout:
    axes: list
    axis_of: dict  # name of shaft -> Axis
    links: list  # names of meshes that the plane tears apart


def group(shafts):
    axes, axis_of = [], {}
    for shaft in shafts:
        for axis in axes:
            if hypot(axis.y - shaft["y_mm"], axis.z - shaft["z_mm"]) < SAME_AXIS:
                break
        else:
            axis = Axis(shaft["y_mm"], shaft["z_mm"])
            axes.append(axis)
        axis.shafts.append(shaft["name"])
        axis_of[shaft["name"]] = axis
    return axes, axis_of


def boxes(axis, parts):
    """What an axis covers: (x from, x to, radius) of its gears and shafts."""
    found = []
    for gear in parts["gears"]:
        if gear["shaft"] in axis.shafts:
            reach = max(gear["tip_radius_mm"], gear["root_radius_mm"])
            reach += gear.get("pin_radius_mm") or 0.0
            half = gear["width_mm"] / 2
            found.append((gear["position_mm"] - half, gear["position_mm"] + half, reach))
    for shaft in parts["shafts"]:
        if shaft["name"] in axis.shafts:
            found += [(s["from_mm"], s["to_mm"], s["diameter_mm"] / 2)
                      for s in shaft["segments"]]
    return found


def collide(a, height_a, b, height_b, slack):
    """Do two sets of boxes overlap by more than slack (teeth in mesh do a little)?"""
    return any(x0 < x3 and x2 < x1 and abs(height_a - height_b) < r + q - slack
               for x0, x1, r in a for x2, x3, q in b)


def is_free(axis, height, placed, parts):
    mine = boxes(axis, parts)
    slack = 3.0 * max((g["normal_module_mm"] for g in parts["gears"]), default=1.0)
    return not any(collide(mine, height, boxes(other, parts), other.height, slack)
                   for other in placed)


def move_out(axis, placed, parts, sign):
    """The nearest height beyond all that is drawn on this side."""
    reach = max(r for _, _, r in boxes(axis, parts))
    edge = max(sign * other.height + max(r for _, _, r in boxes(other, parts))
               for other in placed)
    return sign * (edge + reach + GAP)


def neighbours(axis, axes, parts, axis_of):
    """Axes in mesh with this one, in the order of the meshes."""
    shaft_of = {g["name"]: g["shaft"] for g in parts["gears"]}
    found = []
    for mesh in parts["meshes"]:
        ends = [axis_of[shaft_of[g]] for g in mesh["gears"]]
        for here, there in (ends, ends[::-1]):
            if here is axis and there is not axis and there not in found:
                found.append(there)
    return found


def place(axis, parent, placed, parts):
    """Below the input first, else on the side where the parent is."""
    distance = hypot(axis.y - parent.y, axis.z - parent.z)
    below = sum(1 for other in placed if other.height < 0)
    above = sum(1 for other in placed if other.height > 0)
    side = -1.0 if below <= above else 1.0
    if parent.height:
        side = 1.0 if parent.height > 0 else -1.0
    for sign in (side, -side):
        if is_free(axis, parent.height + sign * distance, placed, parts):
            return parent.height + sign * distance
    return move_out(axis, placed, parts, side)


def torn(layout, parts):
    """Meshes whose gears do not stand at their true distance."""
    shaft_of = {g["name"]: g["shaft"] for g in parts["gears"]}
    links = []
    for mesh in parts["meshes"]:
        a, b = (layout.axis_of[shaft_of[g]] for g in mesh["gears"])
        true = hypot(a.y - b.y, a.z - b.z)
        if a is not b and abs(abs(a.height - b.height) - true) > 0.5:
            links.append(mesh["name"])
    return links


def unfold(parts, input_shaft):
    axes, axis_of = group(parts["shafts"])
    root = axis_of[input_shaft]
    root.height = 0.0
    placed, queue = [root], [root]
    while queue:
        parent = queue.pop(0)
        for axis in neighbours(parent, axes, parts, axis_of):
            if axis.height is None:
                axis.height = place(axis, parent, placed, parts)
                placed.append(axis)
                queue.append(axis)
    for axis in axes:  # in mesh with nothing: only coupled by clutches
        if axis.height is None:
            axis.height = move_out(axis, placed, parts, -1.0)
            placed.append(axis)
    layout = Layout(axes, axis_of, [])
    layout.links = torn(layout, parts)
    return layout
