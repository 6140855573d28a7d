# SPDX-License-Identifier: BSD-2-Clause
"""Losses at the oil temperatures of a map, where it has several."""
import numpy as np
import plotly.graph_objects as go

from .colours import of_levels
from .efficiency import GearLosses
from .figure import canvas, choice, embed
from .lines import SPEED, end_texts, gear_choice
from .words import easy, paragraph, unit


def temperatures(data):
    """{oil temperature [degC]: the map at it}"""
    if not data.slices:
        return {data.about["oil_degC"]: data}
    return {oil: data.at(oil) for oil in data.slices}


def usual(data):
    """The oil temperature of figures that have no choice of it."""
    return min(temperatures(data), key=lambda oil: abs(oil - data.about["oil_degC"]))


def temperature_words(data):
    if not data.slices:
        return paragraph("All losses are those at an oil temperature of %s. Colder oil is "
                         "thicker and drags more." % unit(data.about["oil_degC"], "°C"))
    oils = [unit(oil, "°C") for oil in data.slices]
    return paragraph("The map holds the losses at oil temperatures of %s and %s; between them "
                     "the component interpolates. Where nothing else is said, the oil has %s."
                     % (", ".join(oils[:-1]), oils[-1], unit(usual(data), "°C")))


LOADS = (("none", 0.0), ("some", 0.4))  # shares of the largest torque


def oil_figure(data, gears):
    """Lost torque over speed, a line for each oil temperature."""
    plot = canvas(420, SPEED, "lost torque at the input [N·m]", showlegend=False)
    maps, top = temperatures(data), data.about["speed_max_rpm"]
    speed = np.linspace(0.01, 1.0, 60) * top
    colours = dict(zip(maps, of_levels(len(maps))))
    for gear in gears:
        here = {oil: GearLosses(at, gear.path, gear.number) for oil, at in maps.items()}
        for key, share in LOADS:
            torque = [easy(share * data.about["torque_max_Nm"])]
            lines = {oil: np.array([g.lost_at(s, torque)[0] for s in speed])
                     for oil, g in here.items()}
            meta = {"gear": str(gear.number), "load": key}
            for oil, line in lines.items():
                plot.add_trace(go.Scatter(
                    x=speed, y=line, mode="lines", meta=meta, visible=False,
                    line=dict(color=colours[oil], width=2.2),
                    hovertemplate="%g °C: %%{y:.3g} N·m at %%{x:.0f} rpm<extra></extra>"
                                  % oil))
            highest = max(line.max() for line in lines.values())
            plot.add_trace(end_texts(
                ["%g °C" % oil for oil in lines], list(colours.values()), 1.006 * top,
                [line[-1] for line in lines.values()], highest / 20, meta))
    plot.update_xaxes(range=[0, 1.01 * top])
    plot.update_layout(margin_r=60)
    plot.update_yaxes(rangemode="tozero")
    load = unit(easy(LOADS[1][1] * data.about["torque_max_Nm"]), "N·m")
    choices = gear_choice("oil", gears) + choice(
        "oil", "load", "Torque at the input", [("none", "none"), ("some", load)], "none")
    return embed("oil", plot, "One line for each oil temperature of the map.",
                 "Lost torque of one gear over the speed of the input, one line for each "
                 "oil temperature.", choices)
