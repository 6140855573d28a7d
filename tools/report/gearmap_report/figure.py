# SPDX-License-Identifier: BSD-2-Clause
"""A figure of the page: a Plotly figure as data, its sentence, its text for those who do
not see it, and the choices that people have. What a choice shows carries the choice in
its meta: {"gear": "3"}; the page's script makes all else invisible.
"""
import json
from html import escape

import plotly.graph_objects as go


def canvas(height, x=None, y=None, **layout):
    """An empty figure with the page's looks; the script adds the colours of the theme."""
    figure = go.Figure()
    figure.update_layout(
        template="none", height=height, margin=dict(l=64, r=16, t=40, b=52),
        font=dict(family="inherit", size=13), hovermode="closest", separators=".\u202f",
        paper_bgcolor="rgba(0,0,0,0)", plot_bgcolor="rgba(0,0,0,0)", dragmode="zoom",
        legend=dict(orientation="h", x=0, xanchor="left", y=1.02, yanchor="bottom",
                    traceorder="normal"),
        **layout)
    axis = dict(zeroline=False, automargin=True, title_standoff=8, exponentformat="none")
    figure.update_xaxes(title=x, **axis)
    figure.update_yaxes(title=y, **axis)
    return figure


def choice(figure_id, key, words, options, chosen):
    """Radio buttons: options are (value, label). A single one is not shown."""
    buttons = "".join(
        '<label><input type="radio" name="%s-%s" value="%s"%s> %s</label>'
        % (figure_id, key, escape(str(value), quote=True),
           " checked" if value == chosen else "", escape(label))
        for value, label in options)
    return ('<fieldset class="choice" data-figure="%s" data-key="%s"%s><legend>%s</legend>'
            "%s</fieldset>" % (figure_id, key, " hidden" * (len(options) < 2),
                               escape(words), buttons))


def rounded(value):
    """Five significant digits are more than a screen shows."""
    if isinstance(value, float):
        return float("%.5g" % value) if value == value else None
    if isinstance(value, dict):
        return {k: rounded(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(v) for v in value]
    if hasattr(value, "tolist"):
        return rounded(value.tolist())
    return value


def embed(figure_id, plot, caption, alternative, choices="", kind="plot"):
    """HTML of the figure. kind "timeline": the script fills its lines from the series."""
    data = rounded(plot.to_dict())
    text = json.dumps(data, separators=(",", ":"), ensure_ascii=False)
    return (
        '<figure id="%s-figure">%s<div class="plot" id="%s" data-kind="%s" role="group" '
        'aria-label="%s" style="height:%dpx"></div><figcaption>%s</figcaption>'
        '<script type="application/json" id="%s-data">%s</script></figure>'
        % (figure_id, choices, figure_id, kind, escape(alternative, quote=True),
           plot.layout.height, caption, figure_id, text.replace("</", "<\\/")))
