# SPDX-License-Identifier: BSD-2-Clause
"""What figures with lines for gears have in common: axes, the choice of a gear, words beside
the ends of lines."""
import plotly.graph_objects as go

from .figure import choice
from .spread import spread

SPEED, TORQUE = "speed of the input [rpm]", "torque at the input [N·m]"


def label(gear):
    return "R" if gear.number == -1 else str(gear.number)


def gear_choice(figure_id, gears):
    return choice(figure_id, "gear", "Gear", [(g.number, label(g)) for g in gears],
                  gears[0].number)


def end_texts(words, colours, x, heights, least, meta):
    """Words beside the end of each line."""
    return go.Scatter(
        x=[x] * len(words), y=spread(heights, least), mode="text", cliponaxis=False,
        text=["<b>%s</b>" % w for w in words], textposition="middle right",
        textfont=dict(color=colours), hoverinfo="skip", showlegend=False, meta=meta,
        visible=False)


def end_labels(gears, colours, x, heights, least, meta):
    """The number of each gear beside the end of its line."""
    return end_texts([label(g) for g in gears], [colours[g.number] for g in gears], x,
                     heights, least, meta)
