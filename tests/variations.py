#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-2-Clause
"""Random valid variations of examples/dct7.yaml.

    python3 tests/variations.py OUTDIR N SEED

writes OUTDIR/variation_0000.yaml and so on. Every dimension and friction parameter is drawn
within +-20 %, every tooth count within +-2. What must agree follows from the draw:

- the module of a pair from the centre distance of its shafts (a_w is proportional to it);
  4th and 6th share a gear, so they fix the distance of output 2; the profile shift of the
  first reverse gear closes the pair that shares the drive gear of 2nd;
- the positions of the shafts by triangulation from the centre distances;
- bores of idling gears, needle bearings and the gap from the shaft diameters;
- the given ratios from the teeth.

Same N and SEED, same files. Standard library only.
"""
import math
import os
import random
import sys

from plain_yaml import block, dump, logical_lines

EXAMPLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "examples",
                       "dct7.yaml")
SPREAD = 0.2


class Redraw(Exception):
    """The draw cannot be closed to a valid gearset."""


# ------------------------------------------------------------------------------ gear geometry

def involute(angle):
    return math.tan(angle) - angle


def working_distance(z, m, helix_deg, x):
    """Centre distance at zero backlash (ISO 21771), pressure angle 20 degrees."""
    beta, alpha_n = math.radians(helix_deg), math.radians(20.0)
    alpha_t = math.atan(math.tan(alpha_n) / math.cos(beta))
    target = involute(alpha_t) + 2.0 * math.tan(alpha_n) * x / z
    if target <= 0.0:
        raise Redraw
    low, high = 1e-3, 1.3
    for _ in range(100):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if involute(middle) < target else (low, middle)
    return 0.5 * z * m / math.cos(beta) * math.cos(alpha_t) / math.cos(low)


def root_diameter(g):
    return (g["teeth"] / math.cos(math.radians(g["helix_deg"])) +
            2.0 * (g["profile_shift"] - 1.25)) * g["normal_module_mm"]


def tip_radius(g):
    return (0.5 * g["teeth"] / math.cos(math.radians(g["helix_deg"])) + 1.0 +
            g["profile_shift"]) * g["normal_module_mm"]


def intersection(p, r_p, q, r_q, side):
    """Point at r_p from p and r_q from q, to the left (+1) or right (-1) of p -> q."""
    d = math.dist(p, q)
    along = (r_p * r_p - r_q * r_q + d * d) / (2.0 * d)
    if abs(along) >= r_p:
        raise Redraw
    h = side * math.sqrt(r_p * r_p - along * along)
    u = ((q[0] - p[0]) / d, (q[1] - p[1]) / d)
    return p[0] + along * u[0] - h * u[1], p[1] + along * u[1] + h * u[0]


class Variation:
    def __init__(self, example, rng):
        self.rng = rng
        lines = logical_lines(example)
        self.data = block(lines, 0)
        assert not lines
        self.gears, self.shafts = self.data["gears"], self.data["shafts"]

    def vary(self, part, *keys, spread=SPREAD):
        for key in keys:
            part[key] = part[key] * self.rng.uniform(1.0 - spread, 1.0 + spread)

    # teeth, helices, modules and centre distances

    def pair(self, mesh):
        return [self.gears[name] for name in self.data["meshes"][mesh]["gears"]]

    def draw_helix(self, mesh):
        a, b = self.pair(mesh)
        helix = round(a["helix_deg"] * self.rng.uniform(1.0 - SPREAD, 1.0 + SPREAD), 6)
        a["helix_deg"], b["helix_deg"] = helix, -helix

    def distance(self, mesh):
        a, b = self.pair(mesh)
        return working_distance(a["teeth"] + b["teeth"], a["normal_module_mm"],
                                a["helix_deg"], a["profile_shift"] + b["profile_shift"])

    def close(self, mesh, distance):
        """Helix drawn, module from the centre distance."""
        a, b = self.pair(mesh)
        self.draw_helix(mesh)
        a["normal_module_mm"] = b["normal_module_mm"] = 1.0
        a["normal_module_mm"] = b["normal_module_mm"] = distance / self.distance(mesh)

    def teeth(self):
        for g in self.gears.values():
            g["teeth"] += self.rng.randint(-2, 2)
            g["profile_shift"] = round(self.rng.uniform(-0.1, 0.1), 4)
            g["roughness_um"] = 0.5
            self.vary(g, "width_mm", "roughness_um")

    def shift_reverse(self, distance):
        """2nd fixes module and helix of the first reverse pair: teeth and x close it."""
        a, b = self.pair("reverse_1")
        b["normal_module_mm"], b["helix_deg"] = a["normal_module_mm"], -a["helix_deg"]
        nominal = distance / a["normal_module_mm"] * 2.0 * math.cos(
            math.radians(a["helix_deg"])) - a["teeth"]
        b["teeth"] = min(max(round(nominal), 42), 46)
        low, high = -1.0, 1.0
        for _ in range(60):
            b["profile_shift"] = 0.5 * (low + high)
            if self.distance("reverse_1") < distance:
                low = b["profile_shift"]
            else:
                high = b["profile_shift"]
        b["profile_shift"] = round(b["profile_shift"], 8)
        if abs(b["profile_shift"]) > 0.8:
            raise Redraw

    def centre_distances(self):
        self.teeth()
        a_1 = 80.0 * self.rng.uniform(1.0 - SPREAD, 1.0 + SPREAD)
        self.close("fourth", a_1)
        four, six = self.pair("fourth"), self.pair("sixth")
        six[1]["normal_module_mm"] = four[0]["normal_module_mm"]
        six[1]["helix_deg"] = -four[0]["helix_deg"]
        a_2 = self.distance("sixth")
        for mesh in ("first", "second", "third"):
            self.close(mesh, a_1)
        for mesh in ("fifth", "seventh"):
            self.close(mesh, a_2)
        self.shift_reverse(a_2)
        self.draw_helix("final_drive_1")
        self.draw_helix("reverse_2")
        ring = self.gears["ring"]
        self.vary(ring, "normal_module_mm")
        for name in ("final_1", "final_2", "final_3"):
            self.gears[name]["normal_module_mm"] = ring["normal_module_mm"]
            self.gears[name]["helix_deg"] = -ring["helix_deg"]
        first, second = self.pair("reverse_2")
        self.vary(first, "normal_module_mm")
        second["normal_module_mm"] = first["normal_module_mm"]
        return a_1, a_2

    # positions

    def place(self, name, point):
        self.shafts[name]["y_mm"] = round(point[0], 6)
        self.shafts[name]["z_mm"] = round(point[1], 6)

    def triangulate(self, a_1, a_2, to_output):
        """Output 1 below and output 2 above the line from the input to the differential,
        output 3 beyond output 2."""
        angle = math.radians(-62.0)
        f = [self.distance("final_drive_%d" % i) for i in (1, 2, 3)]
        out = (to_output * math.cos(angle), to_output * math.sin(angle))
        one = intersection((0.0, 0.0), a_1, out, f[0], -1)
        two = intersection((0.0, 0.0), a_2, out, f[1], 1)
        three = max((intersection(two, self.distance("reverse_2"), out, f[2], s)
                     for s in (1, -1)), key=lambda p: math.hypot(*p))
        self.place("output_1", one)
        self.place("output_2", two)
        self.place("reverse_idler", two)
        self.place("output_3", three)
        self.place("differential", out)

    def clearance(self):
        """Smallest distance between tip circles in one plane that do not mesh."""
        mates = [set(m["gears"]) for m in self.data["meshes"].values()]
        names, smallest = list(self.gears), math.inf
        for i, p in enumerate(names):
            for q in names[:i]:
                a, b = self.gears[p], self.gears[q]
                sa, sb = self.shafts[a["shaft"]], self.shafts[b["shaft"]]
                d = math.hypot(sa["y_mm"] - sb["y_mm"], sa["z_mm"] - sb["z_mm"])
                apart = abs(a["position_mm"] - b["position_mm"])
                if d > 1.0 and {p, q} not in mates and \
                        apart < 0.5 * (a["width_mm"] + b["width_mm"]):
                    smallest = min(smallest, d - tip_radius(a) - tip_radius(b))
        return smallest

    def positions(self, a_1, a_2):
        best = None
        for to_output in (v * 0.01 * 150.0 for v in range(70, 131, 2)):
            try:
                self.triangulate(a_1, a_2, to_output)
            except Redraw:
                continue
            room = self.clearance()
            if best is None or room > best[0]:
                best = (room, to_output)
        if best is None or best[0] < 0.0:
            raise Redraw
        self.triangulate(a_1, a_2, best[1])
        ring = tip_radius(self.gears["ring"])
        self.data["oil"]["level_mm"] = round(
            self.shafts["differential"]["z_mm"] - ring +
            20.0 * self.rng.uniform(1.0 - SPREAD, 1.0 + SPREAD), 4)

    # shafts, bearings, the rest

    def stretch(self):
        """One factor for all positions along x; widths have their own."""
        factor = self.rng.uniform(1.0, 1.0 + SPREAD)
        for shaft in self.shafts.values():
            for s in shaft["segments"]:
                s["from_mm"] = round(s["from_mm"] * factor, 6)
                s["to_mm"] = round(s["to_mm"] * factor, 6)
        for part in list(self.gears.values()) + list(self.data["bearings"].values()):
            part["position_mm"] = round(part["position_mm"] * factor, 6)
        self.vary(self.data["gaps"]["input"], "length_mm", "clearance_mm")

    def diameters(self):
        """Concentric shafts keep their order: one factor for each nest."""
        for nest in (("input_odd", "input_even"), ("output_1",), ("output_3",),
                     ("output_2", "reverse_idler"), ("differential",)):
            factor = self.rng.uniform(1.0 - SPREAD, 1.0 + SPREAD)
            for name in nest:
                for s in self.shafts[name]["segments"]:
                    for key in ("diameter_mm", "bore_mm"):
                        if key in s:
                            s[key] = round(s[key] * factor, 6)
            if nest[0] == "input_odd":
                self.data["gaps"]["input"]["radius_mm"] *= factor
            if nest[0] == "differential":
                self.vary(self.shafts["differential"], "inertia_kgm2", "mass_kg")
                self.gears["ring"]["bore_mm"] *= factor
            for b in self.data["bearings"].values():
                if b["shaft"] == "reverse_idler" and "reverse_idler" in nest:
                    b["bore_mm"] *= factor
                    b["outer_mm"] *= factor

    def shaft_diameter(self, shaft, x):
        for s in self.shafts[shaft]["segments"]:
            if s["from_mm"] <= x <= s["to_mm"]:
                return s
        raise Redraw

    def needles(self):
        """An idling gear's bearing fits its shaft and stays inside the root circle."""
        for g in self.gears.values():
            at = self.shaft_diameter(g["shaft"], g["position_mm"])
            if "bearing" not in g:
                if root_diameter(g) <= at.get("bore_mm", 0.0) + 2.0:
                    raise Redraw
                continue
            b = g["bearing"]
            thickness = (b["outer_mm"] - b["bore_mm"]) * self.rng.uniform(0.8, 1.2)
            b["bore_mm"] = at["diameter_mm"]
            b["outer_mm"] = at["diameter_mm"] + thickness
            self.vary(b, "width_mm")
            if root_diameter(g) <= b["outer_mm"] + 2.0:
                raise Redraw

    # deep groove ball bearings of the example: d, D, B [mm], C0 [N] (SKF catalogue)
    CATALOGUE = {"6306": (30, 72, 19, 16000), "6008": (40, 68, 15, 11000),
                 "61908": (40, 62, 12, 10000), "6307": (35, 80, 21, 19000),
                 "6308": (40, 90, 23, 24000)}

    # other friction than the default, with numbers of small gearbox bearings
    FRICTIONS = ({"friction": "skf", "supply": "grease"},
                 {"friction": "coulomb", "torque_Nm": 0.02, "mu": 0.0015},
                 {"friction": "elastic", "torque_Nm": 0.05, "static_torque_Nm": 0.08,
                  "viscous_Nms_rad": 0.0002},
                 {"friction": "hydrodynamic", "mu": 0.001, "static_mu": 0.004,
                  "stribeck_rpm": 60.0, "viscous_Nms_rad": 0.0003})

    def bearings(self):
        for b in self.data["bearings"].values():
            b.setdefault("radial_stiffness_N_um", 300.0)
            b.setdefault("axial_stiffness_N_um", 100.0)
            self.vary(b, "radial_stiffness_N_um", "axial_stiffness_N_um")
            if "designation" in b:
                designation = b.pop("designation")
                b["series"] = designation[:-2]
                b["bore_mm"], b["outer_mm"], b["width_mm"], b["static_load_N"] = (
                    float(v) for v in self.CATALOGUE[designation])
            if "bore_mm" not in b:
                continue
            if b["shaft"] != "reverse_idler":
                factor = self.rng.uniform(1.0 - SPREAD, 1.0 + SPREAD)
                b["bore_mm"] *= factor
                b["outer_mm"] *= factor
            self.vary(b, "width_mm")
            if "static_load_N" in b:
                self.vary(b, "static_load_N")
            b.update(self.rng.choice([{}, {}, {"friction": "palmgren"},
                                      *self.FRICTIONS]))

    def thrust(self):
        """Now and then an output shaft on a pair of tapered roller bearings."""
        ends = [self.data["bearings"]["output_1_" + end] for end in ("front", "rear")]
        if self.rng.random() < 0.7:
            return
        for b, way in zip(ends, ("minus_x", "plus_x")):
            for key in ("static_load_N", "friction", "supply", "torque_Nm", "mu",
                        "static_torque_Nm", "static_mu", "stribeck_rpm",
                        "viscous_Nms_rad"):
                b.pop(key, None)
            b.update(type="tapered_roller", series="322", axial_factor=1.6,
                     locating=True, thrust=way)
        if self.rng.random() < 0.5:
            ends[1].update(preload_N=self.rng.uniform(100.0, 3000.0),
                           preload_change_N_K=self.rng.uniform(-20.0, 5.0))

    def cover(self):
        """Shafts reach as far as what sits on them."""
        for name, shaft in self.shafts.items():
            first, last = shaft["segments"][0], shaft["segments"][-1]
            parts = [g for g in self.gears.values() if g["shaft"] == name]
            parts += [b for b in self.data["bearings"].values()
                      if name in (b["shaft"], b.get("on"))]
            for p in parts:
                half = 0.5 * p.get("width_mm", 0.0) + 1.0
                first["from_mm"] = round(min(first["from_mm"], p["position_mm"] - half), 6)
                last["to_mm"] = round(max(last["to_mm"], p["position_mm"] + half), 6)

    def small_parts(self):
        data = self.data
        self.vary(data["limits"], "input_speed_max_rpm", "input_torque_max_Nm")
        self.vary(data["oil"], "viscosity_40_mm2_s", "viscosity_100_mm2_s",
                  "thermal_expansion_1_K", "temperature_degC", "mesh_lubricant_factor",
                  "bearing_mu_ehl", "volume_l")
        self.vary(data["oil"], "density_15_kg_m3", spread=0.05)
        for seal in data["seals"].values():
            self.vary(seal, "diameter_mm")
            seal["model"] = self.rng.choice(["iso14179_2", "iso14179_1_fpm",
                                             "iso14179_1_nbr", "linke"])
        for s in data["synchronisers"].values():
            self.vary(s, "cone_torque_Nm", "cone_radius_mm", "cone_width_mm",
                      "cone_clearance_mm")
        for gear in self.gears.values():
            gear["churning"] = self.rng.choice(["none", "changenet_velex", "iso14179_1",
                                                "iso14179_2"])
            gear["windage"] = self.rng.random() < 0.3
        data["jets"] = {"spray": {"gear": self.rng.choice(sorted(self.gears)),
                                  "flow_l_min": 2.5, "speed_m_s": 0.4}}
        for mesh in data["meshes"].values():
            mesh["loss"] = self.rng.choice([
                {"minimum_line_load_N_mm": 150.0},
                {"method": "iso14179_1", "minimum_line_load_N_mm": 50.0},
                {"model": "torque_dependent", "idle_torque_Nm": 0.05,
                 "torque_share": 0.006},
                {"model": "constant", "efficiency": 0.99}])
            self.vary(mesh["loss"], *[k for k in mesh["loss"]
                                      if k in ("minimum_line_load_N_mm",
                                               "idle_torque_Nm", "torque_share")])

    # ratios

    def speeds(self, lock):
        """Speed of every body per speed of the output; locked gear as part of its shaft."""
        def body(name):
            g = self.gears[name]
            return name if g.get("idles") and name != lock else "shaft " + g["shaft"]
        speed = {"shaft " + self.data["output"]: 1.0}
        for _ in self.data["meshes"]:
            for mesh in self.data["meshes"].values():
                a, b = mesh["gears"]
                ratio = -self.gears[b]["teeth"] / self.gears[a]["teeth"]
                if body(a) in speed:
                    speed.setdefault(body(b), speed[body(a)] / ratio)
                if body(b) in speed:
                    speed.setdefault(body(a), speed[body(b)] * ratio)
        return speed

    def ratios(self):
        for path in self.data["paths"].values():
            for gear in path["gears"].values():
                gear["ratio"] = self.speeds(gear["lock"])["shaft " + path["shaft"]]

    def make(self, number):
        self.stretch()
        self.diameters()
        a_1, a_2 = self.centre_distances()
        self.positions(a_1, a_2)
        self.needles()
        self.bearings()
        self.thrust()
        self.small_parts()
        self.cover()
        self.ratios()
        self.data["name"] = "variation_%04d" % number
        self.data["title"] = "Random variation %d of dct7" % number
        return dump(self.data)


def variation(example, number, seed):
    rng = random.Random("%d/%d" % (seed, number))
    for _ in range(1000):
        try:
            return Variation(example, rng).make(number)
        except Redraw:
            continue
    raise SystemExit("variation %d: no valid gearset in 1000 draws" % number)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    folder, n, seed = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    with open(EXAMPLE, encoding="utf-8") as f:
        example = f.read()
    os.makedirs(folder, exist_ok=True)
    for i in range(n):
        path = os.path.join(folder, "variation_%04d.yaml" % i)
        with open(path, "w", encoding="utf-8") as f:
            f.write(variation(example, i, seed))


if __name__ == "__main__":
    main()
