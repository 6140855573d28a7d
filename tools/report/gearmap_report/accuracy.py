# SPDX-License-Identifier: BSD-2-Clause
"""How far the component is from the detailed model at steady points: numbers by kind of
point, and every compared point of the gears. From verification results when they are
given, else from what the map keeps of `gearmap reduce`."""
import numpy as np
import plotly.graph_objects as go

from .colours import HELD_OUT
from .figure import canvas, embed
from .words import gear_name, number, ordinal, paragraph, percent, plural, table, unit

KINDS = {  # name -> what is compared
    "single": "Lost torque, one input drives",
    "preselected": "Lost torque, the next gear waits on the other input",
    "both_loaded": "Lost torque, both inputs carry torque, as in a shift",
    "drag": "Drag on an input shaft in neutral",
    "reaction": "What that shaft adds to the drag at the output",
}


def from_result(steady):
    """{kind: (points, max, rms)} of verify's JSON, relative to the largest of each case."""
    found = {}
    groups = {"single": steady, **(steady.get("groups") or {})}
    for kind, group in groups.items():
        points = sum(case["points"] for case in group["cases"])
        found[kind] = (points, group["max_relative"], group["rms_relative"])
    return found


def from_map(errors):
    found = {}
    for kind, rows in errors.groupby("kind"):
        rows = rows[(rows["points"] > 0) & (rows["largest_Nm"] > 0)]
        if not len(rows):
            continue
        worst = (rows["max_Nm"] / rows["largest_Nm"]).max()
        squares = rows["points"] * (rows["rms_Nm"] / rows["largest_Nm"]) ** 2
        rms = np.sqrt(squares.sum() / rows["points"].sum())
        found[kind] = (int(rows["points"].sum()), float(worst), float(rms))
    return found


def numbers(data, results):
    if results.steady:
        return from_result(results.steady)
    return from_map(data.errors) if len(data.errors) else {}


def kinds_table(found):
    rows = [[words, percent(found[kind][2], 2), percent(found[kind][1], 2)]
            for kind, words in KINDS.items() if kind in found]
    counts = sorted({points for points, _, _ in found.values()})
    many = " to ".join(number(n, 6) for n in (counts[0], counts[-1])[:len(counts)])
    return table(["Compared", "Typical difference", "Largest difference"], rows,
                 "Each line: %s random points. Differences are shares of the largest value "
                 "of the same gear and direction. Typical: root mean square." % many)


def oil_table(steady):
    """Between the oil temperatures of the map, where it has several."""
    steps = (steady or {}).get("by_oil_temperature") or []
    rows = [["%s to %s" % (number(s["from_degC"]), unit(s["to_degC"], "°C")),
             percent(s["rms_relative"], 2), percent(s["max_relative"], 2)]
            for s in steps if s.get("points")]
    return table(["Oil", "Typical difference", "Largest difference"], rows,
                 "Lost torque, one input drives, by oil temperature. Differences are shares "
                 "of the largest loss there.") if rows else ""


def points_figure(data):
    """Every compared point: gear against error, spread a little sideways."""
    points = data.points[data.points["kind"] == "single"]
    plot = canvas(380, None, "difference [% of the largest loss]", showlegend=False)
    gears = data.all_gears()
    for place, (path, n) in enumerate(gears):
        column = "gear_0" if data.paths.index(path) == 0 else "gear_1"
        rows = points[(points["path"] == path) & (points[column] == n)]
        error = 100 * (rows["reduced_Nm"] - rows["detailed_Nm"]) / rows["largest_Nm"]
        torque = rows["torque_Nm"] / data.about["torque_max_Nm"]
        plot.add_trace(go.Scatter(
            x=place + 0.36 * torque, y=error, mode="markers",
            marker=dict(size=4, color=HELD_OUT, opacity=0.5),
            customdata=np.stack([rows["speed_rpm"], rows["torque_Nm"]], axis=1),
            hovertemplate=gear_name(n) + ", %{customdata[0]:.0f} rpm, %{customdata[1]:.1f} "
                          "N·m: %{y:.3f} %<extra></extra>"))
    plot.update_xaxes(tickvals=list(range(len(gears))), ticktext=[
        ordinal(n) for _, n in gears], title="gear")
    plot.add_hline(y=0, line_width=1, line_color="#8a8f98")
    return embed("errors", plot, "Each point is one steady operating point that was drawn "
                 "at random and is not in the tables. Within a gear: from the largest negative "
                 "torque on the left to the largest positive torque on the right.",
                 "Differences of the lost torque between component and detailed model at "
                 "random operating points, one column for each gear.")


def chapter(data, results):
    found = numbers(data, results)
    if not found:
        return ""
    single = found.get("single")
    words = ""
    if single:
        words = paragraph(
            "The component was asked at %s that are not in its tables." % plural(
                single[0], "random operating point"),
            "Its lost torque was typically <b>%s</b> and at most <b>%s</b> of the gear's "
            "largest loss away from the detailed model." % (percent(single[2], 2),
                                                            percent(single[1], 2)))
    figure = points_figure(data) if len(data.points) else ""
    return ('<section id="accuracy"><h2>How exact are the losses?</h2>%s%s%s%s</section>'
            % (words, figure, kinds_table(found), oil_table(results.steady)))
