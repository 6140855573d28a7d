# SPDX-License-Identifier: BSD-2-Clause
"""Chapter 4: where the component may be used, and what it does not show."""
from html import escape
from math import pi, sqrt

import numpy as np
import plotly.graph_objects as go

from .colours import HELD_OUT, RISING
from .figure import canvas, embed
from .words import number, paragraph, percent, table, unit

POINTS = 4000  # of a drive that are drawn


def moments(drive, data):
    """Of the detailed drive: {path: (speed, torque, outside the map?)}."""
    found = {}
    for path in drive.paths:
        speed = drive.run("detailed", path + ".speed_rpm")
        torque = drive.run("detailed", path + ".tau_Nm")
        found[path] = (speed, torque, (np.abs(speed) > data.about["speed_max_rpm"])
                       | (np.abs(torque) > data.about["torque_max_Nm"]))
    return found


def range_figure(drive, data, places):
    plot = canvas(420, "speed of the input [rpm]", "torque at the input [N·m]")
    speed, torque = data.about["speed_max_rpm"], data.about["torque_max_Nm"]
    plot.add_shape(type="rect", x0=0, x1=speed, y0=-torque, y1=torque, layer="below",
                   line=dict(color="#12947d", width=2), fillcolor="rgba(18,148,125,0.07)")
    plot.add_annotation(x=speed, y=torque, text="range of the map", showarrow=False,
                        xanchor="right", yanchor="top", font=dict(color="#12947d"))
    every = max(1, drive.n // POINTS)
    for (path, (x, y, out)), colour, mark in zip(places.items(), (RISING[1], RISING[4]),
                                                 ("circle", "diamond-open")):
        name = path if path == "input" else "input " + path
        plot.add_trace(marks(x[~out][::every], y[~out][::every], name, size=4, color=colour,
                             opacity=0.45, symbol=mark))
        if out.any():
            few = max(1, int(out.sum()) // POINTS)
            plot.add_trace(marks(x[out][::few], y[out][::few], name + ", outside", size=7,
                                 color=HELD_OUT, symbol="x"))
    x = np.concatenate([x for x, _, _ in places.values()])
    y = np.concatenate([y for _, y, _ in places.values()])
    high, far = max(speed, x.max()), max(torque, np.abs(y).max())
    plot.update_xaxes(range=[min(-0.03 * high, 1.05 * x.min()), 1.05 * high])
    plot.update_yaxes(range=[-1.1 * far, 1.1 * far])
    return embed("range", plot, "Each point is one moment of the drive; a red cross is one "
                 "outside the map." if any(o.any() for _, _, o in places.values()) else
                 "Each point is one moment of the drive.",
                 "Operating points of the drive and the range of the map over speed and "
                 "torque of the input.")


def marks(x, y, name, **looks):
    return go.Scatter(x=x, y=y, mode="markers", name=name, marker=looks,
                      hovertemplate="%{x:.0f} rpm, %{y:.1f} N·m<extra>" + name + "</extra>")


def left_words(drive, data):
    if drive is None:
        return ""
    places = moments(drive, data)
    share = float(np.any([out for _, _, out in places.values()], axis=0).mean())
    words = ("The drive (%s) never left the map: the input turned at up to %s and carried "
             "up to %s." if share == 0.0 else
             "The drive (%s) left the map: the input turned at up to %s and carried up to "
             "%s.") % (escape(drive.name), unit(largest(places, 0), "rpm"),
                       unit(largest(places, 1), "N·m"))
    if share:
        words += (" It was outside for %s of the time. There the component used the values "
                  "at the edge." % percent(share, 2))
    return ("<h3>Was the map left?</h3>" + paragraph(words)
            + range_figure(drive, data, places))


def largest(places, which):
    return max(float(np.abs(found[which]).max()) for found in places.values())


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
        ["Oil temperature", "%s to %s" % (number(min(data.slices)), unit(
            max(data.slices), "°C")) if data.slices
         else unit(about["oil_degC"], "°C") + " only"],
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
        "<b>Heat.</b> %s How the gearset warms up is not computed." % (
            "The oil temperature is an input of the component." if data.slices
            else "The oil has one temperature."),
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
