# SPDX-License-Identifier: BSD-2-Clause
"""The gearset in a section along its shafts, to scale: x to the right, every part above
and below its axis. Parts through which a gear's power flows carry the gear's number in
data-on, and each gear has a line along its flow; the page's script shows one at a time.
"""
from math import isnan

from . import svg
from .spread import spread
from .unfold import unfold

MARGIN = 14.0  # mm around the drawing
WIDE, HIGH = 725.0, 540.0  # pixels that a screen has for it
NAME_ROOM, NAME_STEP, LETTER = 5.0, 14.0, 7.0  # pixels: beside, between, in names


def value(number, other):
    return other if number is None or isnan(number) else number


class Section:
    def __init__(self, gearset):
        self.facts, self.parts = gearset.facts, gearset.parts
        self.shaft = {s["name"]: s for s in self.parts["shafts"]}
        self.gear = {g["name"]: g for g in self.parts["gears"]}
        self.layout = unfold(self.parts, self.facts["paths"][0]["shaft"])
        self.uses = self.find_uses()
        self.back, self.front, self.words = [], [], []  # SVG, in this order

    def find_uses(self):
        """Name of a part -> numbers of the gears whose power flows through it."""
        uses = {}
        for path in self.facts["paths"]:
            for gear in path["gears"]:
                for name in gear["power_flow"] + gear["locks"]:
                    uses.setdefault(name, []).append(gear["number"])
        return uses

    def on(self, name):
        numbers = sorted(set(self.uses.get(name, [])))
        return " ".join(str(n) for n in numbers) or None

    def height(self, shaft):
        return -self.layout.axis_of[shaft].height  # SVG counts downwards

    def both(self, shaft, x0, x1, r0, r1, tip, name, **given):
        """A ring from r0 to r1 around an axis: cut above and below it."""
        y = self.height(shaft)
        pieces = svg.title(tip)
        if r0 <= 0.0:
            pieces += svg.rect(x0, x1, y - r1, y + r1)
        else:
            pieces += svg.rect(x0, x1, y - r1, y - r0) + svg.rect(x0, x1, y + r0, y + r1)
        return svg.tag("g", pieces, data_on=self.on(name), **given)

    # ---- parts ----

    def outer_radius(self, shaft, x):
        """Of a shaft at x; 0 beside it."""
        return max((s["diameter_mm"] / 2 for s in self.shaft[shaft]["segments"]
                    if s["from_mm"] <= x <= s["to_mm"]), default=0.0)

    def draw_shaft(self, shaft):
        for s in shaft["segments"]:
            bore = value(s["bore_mm"], 0.0)
            self.back.append(self.both(
                shaft["name"], s["from_mm"], s["to_mm"], bore / 2, s["diameter_mm"] / 2,
                "shaft " + spoken(shaft["name"]), shaft["name"], class_="shaft"))

    def gear_tip(self, gear):
        words = "gear %s: %d teeth, module %.4g mm, %s, %.4g mm wide" % (
            spoken(gear["name"]), gear["teeth"], gear["normal_module_mm"],
            "helix %.1f°" % gear["helix_deg"] if gear["helix_deg"] else "straight teeth",
            gear["width_mm"])
        if gear["planets"]:
            return words + "; %d planets" % gear["planets"]
        return words + ("; turns freely until it is locked" if gear["idles"] else "")

    def draw_gear(self, gear):
        x0 = gear["position_mm"] - gear["width_mm"] / 2
        x1 = x0 + gear["width_mm"]
        tip, root = gear["tip_radius_mm"], gear["root_radius_mm"]
        if gear["planets"]:
            self.draw_planets(gear, x0, x1)
            return
        if gear["internal"]:
            inner, outer, kind = tip, root + 2.5 * gear["normal_module_mm"], "gear ring"
        elif gear["idles"]:
            inner, outer, kind = gear["bearing_outer_mm"] / 2, tip, "gear idler"
            self.front.append(self.both(
                gear["shaft"], x0 + 2, x1 - 2, gear["bearing_bore_mm"] / 2, inner,
                "bearing of gear " + spoken(gear["name"]), gear["name"],
                class_="bearing"))
        else:
            inner = min(self.outer_radius(gear["shaft"], gear["position_mm"]), 0.9 * root)
            outer, kind = tip, "gear"
        self.front.append(self.both(gear["shaft"], x0, x1, inner, outer,
                                    self.gear_tip(gear), gear["name"], class_=kind))
        self.draw_teeth(gear, x0, x1)
        middle = outer + 5 if gear["internal"] else (inner + outer) / 2
        self.words.append(svg.text((x0 + x1) / 2, self.height(gear["shaft"]) - middle,
                                   str(gear["teeth"]), class_="teeth"))

    def draw_teeth(self, gear, x0, x1):
        """The reference circle, as a thin line."""
        y, r = self.height(gear["shaft"]), gear["reference_radius_mm"]
        for side in (-r, r):
            self.front.append(svg.line(x0, y + side, x1, y + side, class_="pitch"))

    def draw_planets(self, gear, x0, x1):
        y, pin = self.height(gear["shaft"]), gear["pin_radius_mm"]
        tip, bore = gear["tip_radius_mm"], gear["bearing_bore_mm"] / 2
        pieces = svg.title(self.gear_tip(gear))
        carrier = ""
        for side in (-1, 1):
            middle = y + side * pin
            pieces += svg.rect(x0, x1, middle - tip, middle - bore)
            pieces += svg.rect(x0, x1, middle + bore, middle + tip)
            carrier += svg.rect(x0 - 5, x1 + 5, middle - bore + 1, middle + bore - 1)
            carrier += self.carrier_arm(gear, x0 - 5, x1 + 5, y, side)
        name = gear["shaft"]
        self.back.append(svg.tag("g", svg.title("carrier " + spoken(name)) + carrier,
                                 class_="shaft pin", data_on=self.on(name)))
        self.front.append(svg.tag("g", pieces, class_="gear planet",
                                  data_on=self.on(gear["name"])))
        self.words.append(svg.text((x0 + x1) / 2, y - pin - (tip + bore) / 2,
                                   str(gear["teeth"]), class_="teeth"))

    def carrier_arm(self, gear, x0, x1, y, side):
        """From the pin to the nearest end of the carrier's shaft (schematic)."""
        ends = [(abs(x - near), near, x, s["diameter_mm"] / 2)
                for s in self.shaft[gear["shaft"]]["segments"]
                for x in (s["from_mm"], s["to_mm"]) for near in (x0, x1)]
        _, near, x, r = min(ends)
        pin = y + side * gear["pin_radius_mm"]
        width = 3.0 if near == x0 else -3.0
        arm = svg.rect(near, near + width, pin, y + side * r)
        if abs(x - near) > 3.0:
            arm += svg.rect(near, x, y + side * r, y + side * (r - 3.0))
        return arm

    def draw_bearing(self, bearing):
        shaft = bearing["shaft"]
        inner = value(bearing["bore_mm"], None) or 2 * self.outer_radius(
            shaft, bearing["position_mm"])
        outer = value(bearing["outer_mm"], inner + 12.0)
        width = value(bearing["width_mm"], 0.6 * (outer - inner))
        x0, y = bearing["position_mm"] - width / 2, self.height(shaft)
        label = bearing["type"] + (" " + bearing["designation"]
                                   if bearing["designation"] else "")
        words = "%s %s, on %s" % (label, spoken(bearing["name"]), spoken(bearing["on"]))
        pieces = svg.title(words)
        for side in (-1, 1):
            a, b = y + side * inner / 2, y + side * outer / 2
            pieces += svg.rect(x0, x0 + width, a, b)
            pieces += svg.line(x0, a, x0 + width, b) + svg.line(x0, b, x0 + width, a)
        self.front.append(svg.tag("g", pieces, class_="bearing"))

    def draw_synchroniser(self, sync):
        """The hub between its gears, or beside a single one."""
        gears = [self.gear[g] for g in sync["gears"]]
        ends = sorted((g["position_mm"] - g["width_mm"] / 2,
                       g["position_mm"] + g["width_mm"] / 2) for g in gears)
        x0, x1 = (ends[0][1], ends[1][0]) if len(ends) > 1 else (ends[0][1],
                                                                ends[0][1] + 18.0)
        room = 0.2 * (x1 - x0)
        r = self.outer_radius(sync["shaft"], (x0 + x1) / 2)
        self.front.append(self.both(
            sync["shaft"], x0 + room, x1 - room, r, 1.1 * sync["cone_radius_mm"],
            "synchroniser " + spoken(sync["name"]), sync["name"], class_="sync"))

    def draw_clutch(self, clutch, place):
        """Plates where its two shafts are near each other: the description gives clutches
        no place."""
        shaft, on = clutch["shaft"], clutch["on"]
        ends = self.extent(shaft)
        brake = on == "housing"
        x = sum(ends) / 2 if brake else meeting(ends, self.extent(on))
        own = self.outer_radius(shaft, min(max(x, ends[0]), ends[1]))
        r0 = max(value(clutch["inner_radius_mm"], own + 4), own + 1)
        r1 = max(value(clutch["outer_radius_mm"], r0 + 12), r0 + 8)
        if brake:
            r0 = self.reach(x) + 4
            r1 = r0 + 8
        x += 16 * place
        y, pieces = self.height(shaft), svg.title("%s %s: %s to %s" % (
            "brake" if brake else "clutch", spoken(clutch["name"]), spoken(shaft),
            spoken(on)))
        for side in (-1, 1):
            pieces += svg.rect(x - 6, x + 6, y + side * r0, y + side * r1)
            pieces += "".join(svg.line(x + step, y + side * r0, x + step, y + side * r1)
                              for step in (-4, 0, 4))
        self.front.append(svg.tag("g", pieces, class_="clutch",
                                  data_on=self.on(clutch["name"])))

    def extent(self, shaft):
        segments = self.shaft[shaft]["segments"]
        return segments[0]["from_mm"], segments[-1]["to_mm"]

    def reach(self, x):
        """Outermost radius of all that is drawn around x, on the only axis that brakes
        have."""
        found = [s["diameter_mm"] / 2 for shaft in self.shaft.values()
                 for s in shaft["segments"] if s["from_mm"] - 8 <= x <= s["to_mm"] + 8]
        found += [g["tip_radius_mm"] + (g.get("pin_radius_mm") or 0)
                  + (6 if g["internal"] else 0) for g in self.gear.values()
                  if abs(g["position_mm"] - x) < g["width_mm"] / 2 + 8]
        return max(found, default=20.0)

    def draw_link(self, mesh):
        """Gears in mesh that the plane tears apart."""
        a, b = (self.gear[g] for g in mesh["gears"])
        ya, yb = self.height(a["shaft"]), self.height(b["shaft"])
        sign = 1 if yb > ya else -1
        self.back.append(svg.tag("g", svg.title(
            "in mesh: %s and %s" % tuple(spoken(g) for g in mesh["gears"])) + svg.line(
            a["position_mm"], ya + sign * a["tip_radius_mm"],
            b["position_mm"], yb - sign * b["tip_radius_mm"]), class_="link"))

    # ---- power flow ----

    def flow_points(self, flow):
        """Along the shafts, then across where teeth meet. Parts beside the axis (planets,
        rings, hollow shafts) are followed above it."""
        x = self.flange(self.shaft[flow[0]])
        points = [(x, self.offset(flow[0], x))]
        for before, name in zip(flow, flow[1:]):
            if name in self.gear:
                gear = self.gear[name]
                points += (self.along(before, points[-1][0], gear["position_mm"])
                           if before in self.shaft
                           else [(gear["position_mm"], points[-1][1])])
                points.append((gear["position_mm"], self.gear_offset(gear)))
            else:
                x = points[-1][0]
                if before in self.shaft:  # through a clutch
                    at = meeting(self.extent(before), self.extent(name))
                    points += self.along(before, x, at)
                    x = at
                points.append((x, self.offset(name, x)))
        x = points[-1][0]
        end = max(self.extent(flow[-1]), key=lambda end: abs(end - x))
        return points + self.along(flow[-1], x, end)

    def along(self, name, x0, x1):
        """From x0 to x1 in a shaft."""
        sign = 1 if x1 >= x0 else -1
        steps = sorted((s["from_mm"] for s in self.shaft[name]["segments"]
                        if min(x0, x1) < s["from_mm"] < max(x0, x1)), key=lambda x: sign * x)
        found = [(x0, self.offset(name, x0 + sign * 0.01))]
        for x in steps:
            found += [(x, self.offset(name, x - sign * 0.01)),
                      (x, self.offset(name, x + sign * 0.01))]
        return found + [(x1, self.offset(name, x1 - sign * 0.01))]

    def flange(self, shaft):
        return value(shaft.get("flange_mm"), shaft["segments"][0]["from_mm"])

    def offset(self, shaft, x):
        """Height of the line through a shaft: its axis, or the wall of a hollow one."""
        y = self.height(shaft)
        if len(self.layout.axis_of[shaft].shafts) == 1:
            return y
        for s in self.shaft[shaft]["segments"]:
            if s["from_mm"] <= x <= s["to_mm"] and value(s["bore_mm"], 0.0) > 0.0:
                return y - (s["bore_mm"] + s["diameter_mm"]) / 4
        return y

    def gear_offset(self, gear):
        y = self.height(gear["shaft"])
        if gear["planets"]:
            return y - gear["pin_radius_mm"]
        concentric = any(g["planets"] and self.layout.axis_of[g["shaft"]]
                         is self.layout.axis_of[gear["shaft"]] for g in self.gear.values())
        return y - gear["reference_radius_mm"] if concentric else y

    def draw_flows(self):
        found = ""
        for path in self.facts["paths"]:
            for gear in path["gears"]:
                found += svg.polyline(self.flow_points(gear["power_flow"]), class_="flow",
                                      data_gear=gear["number"], marker_end="url(#arrow)")
        return found

    # ---- all of it ----

    def names(self, unit):
        """Names of the shafts at the left of the drawing, near the height of their axis.
        unit: mm of a pixel."""
        left = min(self.extent(s)[0] for s in self.shaft)
        wanted = sorted((-axis.height + 0.1 * i, name) for axis in self.layout.axes
                        for i, name in enumerate(axis.shafts))
        heights = spread([y for y, _ in wanted], NAME_STEP * unit)
        return "".join(svg.text(left - NAME_ROOM * unit, y + 4 * unit, spoken(name),
                                class_="name",
                                data_on=self.on(name))
                       for y, (_, name) in zip(heights, wanted))

    def axis_lines(self):
        x0 = min(self.extent(s)[0] for s in self.shaft)
        x1 = max(self.extent(s)[1] for s in self.shaft)
        return "".join(svg.line(x0, -a.height, x1 + 5, -a.height, class_="axis")
                       for a in self.layout.axes)

    def limits(self):
        x0 = min(self.extent(s)[0] for s in self.shaft)
        x1 = max(self.extent(s)[1] for s in self.shaft)
        low = min(-a.height - self.axis_reach(a) for a in self.layout.axes)
        high = max(-a.height + self.axis_reach(a) for a in self.layout.axes)
        return x0, x1, low, high

    def axis_reach(self, axis):
        found = [s["diameter_mm"] / 2 for n in axis.shafts
                 for s in self.shaft[n]["segments"]]
        found += [g["tip_radius_mm"] + (g.get("pin_radius_mm") or 0)
                  + (8 if g["internal"] else 0)
                  for g in self.gear.values() if g["shaft"] in axis.shafts]
        found += [b["outer_mm"] / 2 for b in self.parts["bearings"]
                  if b["shaft"] in axis.shafts and value(b["outer_mm"], 0)]
        if any(c["on"] == "housing" and c["shaft"] in axis.shafts
               for c in self.parts["clutches"]):
            found.append(max(found) + 16)
        found += [value(c["outer_radius_mm"], 0) for c in self.parts["clutches"]
                  if c["shaft"] in axis.shafts]
        return max(found)

    def draw(self):
        for shaft in sorted(self.parts["shafts"], key=lambda s: -s["segments"][0]["diameter_mm"]):
            self.draw_shaft(shaft)
        for mesh in self.parts["meshes"]:
            if mesh["name"] in self.layout.links:
                self.draw_link(mesh)
        for sync in self.parts["synchronisers"]:
            self.draw_synchroniser(sync)
        for gear in self.parts["gears"]:
            self.draw_gear(gear)
        for bearing in self.parts["bearings"]:
            self.draw_bearing(bearing)
        seen = {}
        for clutch in self.parts["clutches"]:
            key = tuple(sorted((clutch["shaft"], clutch["on"])))
            self.draw_clutch(clutch, seen.get(key, 0))
            seen[key] = seen.get(key, 0) + 1
        return "".join(self.back + self.front)


def meeting(a, b):
    """Where two ranges of x overlap, or the middle of the gap between them."""
    low, high = max(a[0], b[0]), min(a[1], b[1])
    return (low + high) / 2


def spoken(name):
    return name.replace("_", " ")


def scale_bar(x, y, unit):
    """100 mm, so that the scale can be read at any size."""
    end = 4 * unit
    return svg.tag("g", svg.line(x, y, x + 100, y) + svg.line(x, y - end, x, y + end)
                   + svg.line(x + 100, y - end, x + 100, y + end)
                   + svg.text(x + 50, y - end, "100 mm", class_="scale-name"),
                   class_="scale")


def draw_section(gearset, label):
    """SVG text of the drawing."""
    section = Section(gearset)
    body = section.draw()
    x0, x1, low, high = section.limits()
    names = LETTER * max(len(n) for n in section.shaft) + NAME_ROOM
    unit = max((x1 - x0 + 2 * MARGIN) / (WIDE - names), (high - low + 2 * MARGIN) / (HIGH - 30))
    box = (x0 - names * unit - MARGIN, low - MARGIN, x1 - x0 + names * unit + 2 * MARGIN,
           high - low + 2 * MARGIN + 30 * unit)
    arrow = svg.tag("marker", svg.tag("path", d="M0,0 L8,4 L0,8 Z", class_="arrow"),
                    id="arrow", viewBox="0 0 8 8", refX="6", refY="4", markerWidth="5",
                    markerHeight="5", orient="auto-start-reverse")
    content = (svg.tag("defs", arrow) + section.axis_lines() + body + section.draw_flows()
               + "".join(section.words) + section.names(unit)
               + scale_bar(x1 - 100, high + MARGIN + 20 * unit, unit))
    return svg.frame(content, box, unit, label, "section")
