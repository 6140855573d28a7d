# SPDX-License-Identifier: BSD-2-Clause
"""The gearset seen along its shafts, against x: y to the right, z upwards, to scale."""
from math import cos, isnan, radians, sin

from . import svg
from .section import Section, spoken

MARGIN = 10.0
WIDE, HIGH = 335.0, 450.0  # pixels that a screen has for it


def places(gear, shaft):
    """Centres of a gear: one, or one for each planet."""
    if not gear["planets"]:
        return [(shaft["y_mm"], shaft["z_mm"])]
    angles = [radians(gear["pin_angle_deg"] + 360.0 * i / gear["planets"])
              for i in range(gear["planets"])]
    return [(shaft["y_mm"] + gear["pin_radius_mm"] * cos(a),
             shaft["z_mm"] + gear["pin_radius_mm"] * sin(a)) for a in angles]


def draw_gear(section, gear):
    shaft = section.shaft[gear["shaft"]]
    kind = "gear ring" if gear["internal"] else "gear idler" if gear["idles"] else "gear"
    circles = "".join(svg.circle(y, -z, gear["reference_radius_mm"])
                      for y, z in places(gear, shaft))
    return svg.tag("g", svg.title(section.gear_tip(gear)) + circles, class_=kind,
                   data_on=section.on(gear["name"]))


def draw_shaft(section, shaft):
    r = min(s["diameter_mm"] for s in shaft["segments"]) / 2
    return svg.tag("g", svg.title("shaft " + spoken(shaft["name"]))
                   + svg.circle(shaft["y_mm"], -shaft["z_mm"], r), class_="shaft",
                   data_on=section.on(shaft["name"]))


def extent(section):
    """y from, y to, z from, z to of all circles."""
    found = []
    for gear in section.parts["gears"]:
        shaft = section.shaft[gear["shaft"]]
        r = max(gear["tip_radius_mm"], gear["root_radius_mm"])
        found += [(y - r, y + r, z - r, z + r) for y, z in places(gear, shaft)]
    return (min(f[0] for f in found), max(f[1] for f in found),
            min(f[2] for f in found), max(f[3] for f in found))


def oil_line(parts, y0, y1, z0):
    """The oil at rest."""
    level = parts.get("oil_level_mm")
    if level is None or isnan(level) or level < z0 - 30:
        return ""
    return svg.tag("g", svg.title("oil level at rest")
                   + svg.rect(y0 - 5, y1 + 5, -level, -min(z0, level) + 5)
                   + svg.text(y1 + 3, -level - 2, "oil at rest", class_="oil-name"),
                   class_="oil")


def draw_end_view(gearset, label):
    section = Section(gearset)
    y0, y1, z0, z1 = extent(section)
    gears = sorted(section.parts["gears"], key=lambda g: -g["reference_radius_mm"])
    content = oil_line(section.parts, y0, y1, z0)
    content += "".join(draw_gear(section, g) for g in gears)
    around = {g["shaft"] for g in gears if g["planets"]}  # there, shafts would hide suns
    hidden = {name for axis in section.layout.axes if around & set(axis.shafts)
              for name in axis.shafts}
    content += "".join(draw_shaft(section, s) for s in section.parts["shafts"]
                       if s["name"] not in hidden)
    box = (y0 - MARGIN, -z1 - MARGIN, y1 - y0 + 2 * MARGIN, z1 - z0 + 2 * MARGIN)
    return svg.frame(content, box, max(box[2] / WIDE, box[3] / HIGH), label, "end-view")
