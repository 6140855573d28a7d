# SPDX-License-Identifier: BSD-2-Clause
"""Chapter 4: where the component may be used, and what it does not show."""
from math import pi, sqrt

import numpy as np
import plotly.graph_objects as go

from .colours import RISING
from .figure import canvas, embed
from .words import number, paragraph, percent, table, unit

POINTS = 4000  # of a drive that are drawn


def left_map(drive, data):
    """Share of the detailed drive's time with a path beyond the largest speed or torque."""
    outside = np.zeros(drive.n, bool)
    for path in drive.paths:
        outside |= np.abs(drive.run("detailed", path + ".speed_rpm")) > data.about[
            "speed_max_rpm"]
        outside |= np.abs(drive.run("detailed", path + ".tau_Nm")) > data.about[
            "torque_max_Nm"]
    return float(outside.mean())


def range_figure(drive, data):
    plot = canvas(420, "speed of the input [rpm]", "torque at the input [N·m]")
    speed, torque = data.about["speed_max_rpm"], data.about["torque_max_Nm"]
    plot.add_shape(type="rect", x0=0, x1=speed, y0=-torque, y1=torque, layer="below",
                   line=dict(color="#12947d", width=2), fillcolor="rgba(18,148,125,0.07)")
    plot.add_annotation(x=speed, y=torque, text="range of the map", showarrow=False,
                        xanchor="right", yanchor="top", font=dict(color="#12947d"))
    every = max(1, drive.n // POINTS)
    for path, colour, mark in zip(drive.paths, (RISING[1], RISING[4]),
                                  ("circle", "diamond-open")):
        plot.add_trace(go.Scatter(
            x=drive.run("detailed", path + ".speed_rpm")[::every],
            y=drive.run("detailed", path + ".tau_Nm")[::every], mode="markers",
            name=path if path == "input" else "input " + path,
            marker=dict(size=4, color=colour, opacity=0.45, symbol=mark),
            hovertemplate="%{x:.0f} rpm, %{y:.1f} N·m<extra>" + path + "</extra>"))
    plot.update_xaxes(range=[-0.03 * speed, 1.05 * speed])
    plot.update_yaxes(range=[-1.1 * torque, 1.1 * torque])
    return embed("range", plot, "Each point is one moment of the drive.",
                 "Operating points of the drive and the range of the map over speed and "
                 "torque of the input.")


def left_words(drive, data):
    if drive is None:
        return ""
    share = left_map(drive, data)
    words = ("The drive never left the map." if share == 0.0 else
             "The drive was outside the map for %s of its time; there the value at the "
             "edge was used." % percent(share, 2))
    return ("<h3>Was the map left?</h3>" + paragraph(words) + range_figure(drive, data))


def frequencies(data):
    """Of each path on its spring, Hz: lowest and highest of all gears."""
    gears = data.gears[data.gears["stiffness_Nm_rad"] > 0]
    found = [sqrt(k / j) / (2 * pi) for k, j in zip(gears["stiffness_Nm_rad"],
                                                    gears["path_inertia_kgm2"])]
    return (min(found), max(found)) if found else None


def range_table(data):
    about = data.about
    rows = [["Speed of the input", "0 to %s, both directions" % unit(
        about["speed_max_rpm"], "rpm", 5)],
        ["Torque at the input", "−%s to +%s" % (
            number(about["torque_max_Nm"]), unit(about["torque_max_Nm"], "N·m"))],
        ["Oil temperature", unit(about["oil_degC"], "°C") + " only"],
        ["Situations", "every gear driving and driven; with the next gear engaged; both "
         "paths loaded; shafts in neutral" if len(data.paths) > 1
         else "every gear driving and driven; neutral" if len(data.drag)
         else "its gear, driving and driven"]]
    return table(["What", "Range"], rows, "Where the tables are valid. Beyond, the value at "
                 "the edge is used and the output out_of_map says so.", 9)


def missing_list(data):
    entries = [
        "<b>Single teeth and bearings.</b> Forces, wear and noise of single parts are in "
        "the detailed model only. The component knows what reaches the flanges.",
        "<b>Fast vibrations.</b> Rigid has none. Lash has one spring for each input%s; "
        "vibrations of shafts and gears between them are left out." % (
            ", with a natural frequency of %s to %s" % (
                number(frequencies(data)[0], 2), unit(frequencies(data)[1], "Hz", 2))
            if frequencies(data) else ""),
        "<b>Heat.</b> The oil has one temperature. How the gearset warms up is not "
        "computed.",
        "<b>Slow changes.</b> Losses follow speed and torque at once, as in steady "
        "running.",
        "<b>What is outside.</b> Clutches that start the car, engine, pumps and torque "
        "converter are not part of the gearset.",
    ]
    return "<ul>%s</ul>" % "".join("<li>%s</li>" % e for e in entries)


def chapter(data, drive):
    return ('<section id="valid"><h2>Where does it hold?</h2>' + range_table(data)
            + left_words(drive, data)
            + '</section><section id="missing"><h2>What does it not show?</h2>'
            + missing_list(data) + "</section>")
