# SPDX-License-Identifier: BSD-2-Clause
"""Chapter 2: how much power the gearset loses, from the tables of the map."""
import numpy as np
import pandas as pd
import plotly.graph_objects as go

from .colours import COMPARED, MUCH_KEPT, MUCH_LOST, NODE, TWO_SIDED, of_gears
from .efficiency import GearLosses, all_gears
from .figure import canvas, choice, embed
from .lines import SPEED, TORQUE, end_labels, gear_choice
from .oil import oil_figure, temperature_words, temperatures, usual
from .words import easy, gear_name, paragraph, percent, unit

QUANTITIES = (("lost", "lost torque", "N·m"), ("efficiency", "efficiency", "%"),
              ("power", "lost power", "W"))


# ---- one gear over speed and torque ----

def surface(gear, oil, quantity, words, unit_name):
    z = {"lost": gear.lost, "efficiency": 100 * gear.efficiency, "power": gear.power}
    values = z[quantity].T
    finite = values[np.isfinite(values)]
    if quantity == "efficiency":
        low, high = np.percentile(finite, [20, 100])
        low = min(np.floor(low), np.floor(high) - 2)
        contours = dict(start=float(low), end=float(np.ceil(high)),
                        size=0.5 if high - low < 6 else 1.0)
    else:
        step = nice_step(float(finite.max()), 12)
        contours = dict(start=step, end=float(finite.max()), size=step)
    return go.Contour(
        x=gear.speed, y=gear.torque, z=values, connectgaps=False,
        colorscale=list(MUCH_KEPT if quantity == "efficiency" else MUCH_LOST),
        contours=dict(showlabels=True, labelfont=dict(size=12, color=COMPARED), **contours),
        line=dict(width=0.7, color="rgba(27,39,51,0.45)"),
        colorbar=dict(title=dict(text="%s<br>[%s]" % (words, unit_name), side="top"),
                      thickness=12, len=0.95),
        hovertemplate="%%{x:.0f} rpm, %%{y:.1f} N·m<br>%s %%{z:.4g} %s<extra></extra>"
                      % (words, unit_name),
        meta={"gear": str(gear.number), "quantity": quantity, "oil": oil}, showlegend=False,
        visible=False)


def nice_step(largest, parts):
    rough = largest / parts
    power = 10.0 ** np.floor(np.log10(rough))
    return float(min((m * power for m in (1, 2, 5, 10)), key=lambda s: abs(s - rough)))


def nodes(gear):
    x, y = np.meshgrid(gear.speed, gear.torque)
    return go.Scatter(
        x=x.ravel(), y=y.ravel(), mode="markers", name="node of the table",
        marker=dict(size=3, color=NODE, line=dict(width=0)), hoverinfo="skip",
        meta={"gear": str(gear.number)}, visible=False)


def compared(data, gear):
    """Points at which the component was compared, turning as the tables shown."""
    points = data.points
    if not len(points):
        return points
    column = "gear_0" if data.paths.index(gear.path) == 0 else "gear_1"
    return points[(points["kind"] == "single") & (points["path"] == gear.path)
                  & (points[column] == gear.number) & (points["speed_rpm"] > 0)]


def worst_points(results, gear):
    """Where the differences of a result without its points are largest."""
    cases = (results.steady or {}).get("cases", [])
    return pd.DataFrame([
        {"speed_rpm": case["worst"]["speed_rpm"], "torque_Nm": case["worst"]["torque_Nm"],
         "error": 100 * case["max_relative"]} for case in cases
        if case.get("path") == gear.path and case.get("gear") == gear.number
        and case.get("direction") == "forward" and case.get("worst")])


def held_out_worst(results, gear):
    """The only point of the gear that is known."""
    points = worst_points(results, gear)
    if not len(points):
        return None
    return go.Scatter(
        x=points["speed_rpm"].tolist(), y=points["torque_Nm"].tolist(), mode="markers",
        customdata=points[["error"]], name="largest difference of all compared points",
        marker=dict(size=12, color=COMPARED, symbol="star", line=dict(width=1, color="white")),
        hovertemplate="%{x:.0f} rpm, %{y:.1f} N·m<br>largest difference %{customdata[0]:.3f} "
                      "% of the gear's largest loss<extra></extra>",
        meta={"gear": str(gear.number)}, visible=False)


def held_out(data, gear):
    points = compared(data, gear)
    if not len(points):
        return None
    error = 100 * (points["reduced_Nm"] - points["detailed_Nm"]) / points["largest_Nm"]
    return go.Scatter(
        x=points["speed_rpm"], y=points["torque_Nm"], mode="markers",
        name="compared point, larger: more error",
        customdata=np.stack([error, points["detailed_Nm"], points["reduced_Nm"]], axis=1),
        marker=dict(size=4 + 60 * np.minimum(error.abs(), 0.4), color=COMPARED,
                    opacity=0.8, line=dict(width=1, color="white")),
        hovertemplate="%{x:.0f} rpm, %{y:.1f} N·m<br>detailed %{customdata[1]:.4g} N·m, "
                      "component %{customdata[2]:.4g} N·m<br>error %{customdata[0]:.3f} % "
                      "of the gear's largest loss<extra></extra>",
        meta={"gear": str(gear.number)}, visible=False)


def map_figure(data, results, gears):
    plot = canvas(500, SPEED, TORQUE)
    speed, torque = data.about["speed_max_rpm"], data.about["torque_max_Nm"]
    plot.update_xaxes(range=[-0.01 * speed, 1.01 * speed])
    plot.update_yaxes(range=[-1.03 * torque, 1.03 * torque])
    slices = temperatures(data)
    for gear in gears:
        for oil, at in slices.items():
            here = GearLosses(at, gear.path, gear.number)
            for quantity in QUANTITIES:
                plot.add_trace(surface(here, "%g" % oil, *quantity))
        plot.add_trace(nodes(gear))
        points = held_out(data, gear) or held_out_worst(results, gear)
        if points is not None:
            plot.add_trace(points)
    choices = gear_choice("loss-map", gears) + choice(
        "loss-map", "quantity", "Show", [(q, w) for q, w, _ in QUANTITIES], "lost") + choice(
        "loss-map", "oil", "Oil", [("%g" % oil, unit(oil, "°C")) for oil in slices],
        "%g" % usual(data))
    on_top = (" Dark points were not used for the tables: there the component was compared "
              "with the detailed model; a larger point has a larger error."
              if len(data.points) else
              " The star is where the component differs most from the detailed model."
              if results.steady else "")
    return embed(
        "loss-map", plot,
        "Positive torque drives the car; negative torque: the car drives the engine. Small "
        "grey dots are the operating points of the tables." + on_top,
        "Map of the lost torque, efficiency or lost power of one gear over the speed and "
        "the torque of the input, with the nodes of the tables and the compared points.",
        choices)


# ---- all gears side by side ----

def speeds_to_compare(data):
    return [easy(share * data.about["speed_max_rpm"]) for share in (0.15, 0.35, 0.7)]


def comparison_figure(data, gears):
    plot = canvas(420, TORQUE, "efficiency [%]", showlegend=False)
    colours = of_gears([g.number for g in gears])
    top = data.about["torque_max_Nm"]
    torque = np.linspace(0.04, 1.0, 49) * top
    speeds = speeds_to_compare(data)
    eta = {s: [100 * g.efficiency_at(s, torque) for g in gears] for s in speeds}
    lowest = np.floor(min(line[6:].min() for lines in eta.values() for line in lines)) - 1
    for speed in speeds:
        meta = {"speed": "%g" % speed}
        for gear, line in zip(gears, eta[speed]):
            plot.add_trace(go.Scatter(
                x=torque, y=line, mode="lines", meta=meta, visible=False, line=dict(
                    color=colours[gear.number], width=2.4,
                    dash="dash" if gear.number < 0 else "solid"),
                hovertemplate="%s: %%{y:.2f} %% at %%{x:.0f} N·m<extra></extra>"
                              % gear_name(gear.number)))
        plot.add_trace(end_labels(gears, colours, 1.006 * top,
                                  [line[-1] for line in eta[speed]],
                                  (100 - lowest) / 20, meta))
    plot.update_yaxes(range=[lowest, 100])
    plot.update_xaxes(range=[0, 1.03 * top])
    choices = choice("gears", "speed", "Speed of the input",
                     [("%g" % s, unit(s, "rpm", 4)) for s in speeds], "%g" % speeds[1])
    return embed("gears", plot,
                 "One line for each gear, with its number at the right end; the other path "
                 "is in neutral. At low torque, drag without load takes a larger share."
                 if len(data.paths) > 1 else
                 "One line for each gear, with its number at the right end. At low torque, "
                 "drag without load takes a larger share.",
                 "Efficiency of every gear over the torque of the input, at one of three "
                 "speeds.", choices)


# ---- without load ----

OTHERS = (("neutral", "in neutral", 0), ("higher", "the next higher gear waits", 1),
          ("lower", "the next lower gear waits", -1))


def no_load_lines(data, gears, step):
    """[(gear, speed, torque)], with a gear that waits on the other path: the one by so
    many steps higher; 0: it is in neutral."""
    top = max(g.speed[-1] for g in gears)
    path_of = {g.number: g.path for g in gears}
    found = []
    for gear in gears:
        other = gear.number + step if step else 0
        if other and (gear.number < 0 or path_of.get(other, gear.path) == gear.path):
            continue
        speed, torque = gear.parasitic(data, other)
        inside = speed <= 1.001 * top
        if inside.any():
            found.append((gear, speed[inside], torque[inside]))
    return found


def no_load_figure(data, gears):
    plot = canvas(420, SPEED, "lost torque at the input [N·m]", showlegend=False)
    colours = of_gears([g.number for g in gears])
    top = max(g.speed[-1] for g in gears)
    lines = {key: no_load_lines(data, gears, step) for key, _, step in OTHERS}
    highest = max(torque.max() for some in lines.values() for _, _, torque in some)
    for key, some in lines.items():
        meta = {"other": key}
        for gear, speed, torque in some:
            plot.add_trace(go.Scatter(
                x=speed, y=torque, mode="lines+markers", marker=dict(size=4), meta=meta,
                visible=False, line=dict(color=colours[gear.number], width=2,
                                         dash="dash" if gear.number < 0 else "solid"),
                hovertemplate="%s: %%{y:.3g} N·m at %%{x:.0f} rpm<extra></extra>"
                              % gear_name(gear.number)))
        if some:
            plot.add_trace(end_labels([g for g, _, _ in some], colours, 1.006 * top,
                                      [t[-1] for _, _, t in some], highest / 20, meta))
    plot.update_xaxes(range=[0, top * 1.03])
    plot.update_yaxes(range=[0, 1.06 * highest])
    choices = choice("no-load", "other", "The other input is",
                     [(key, words) for key, words, _ in OTHERS if lines[key]], "neutral")
    return embed("no-load", plot,
                 "What it takes to turn the gearset alone, with no torque carried: bearings, "
                 "seals, oil. Dots are the nodes of the tables.",
                 "Torque that the gearset needs to turn without load, over the speed of "
                 "the input, one line for each gear.", choices)


# ---- free shafts ----

def drag_grid(rows):
    """Signed path speed over forward output speed."""
    rows = rows[rows["output_direction"] == "forward"].copy()
    backward = rows["path_direction"] == "backward"
    rows.loc[backward, "path_speed_rpm"] *= -1
    rows.loc[backward, "drag_torque_Nm"] *= -1
    rows = rows[~(backward & (rows["path_speed_rpm"] == 0))]
    return rows.pivot_table(index="path_speed_rpm", columns="output_speed_rpm",
                            values="drag_torque_Nm").sort_index()


def drag_traces(data, path):
    grid = drag_grid(data.drag[data.drag["path"] == path])
    reach = float(np.nanmax(np.abs(grid.to_numpy())))
    meta = {"path": path}
    found = [go.Heatmap(
        x=grid.columns, y=grid.index, z=grid.to_numpy(), zmid=0.0, zmin=-reach, zmax=reach,
        zsmooth=False, colorscale=TWO_SIDED, reversescale=True, meta=meta, visible=False,
        colorbar=dict(title=dict(text="drag<br>[N·m]", side="top"), thickness=12, len=0.95),
        hovertemplate="shaft %{y:.0f} rpm, output %{x:.0f} rpm<br>drag %{z:.3g} N·m"
                      "<extra></extra>")]
    speeds = grid.columns.to_numpy(float)
    low, high = float(grid.index.min()), float(grid.index.max())
    for number_of_gear in data.gears[data.gears["path"] == path]["gear"]:
        ratio = float(data.gear(path, number_of_gear)["ratio"])
        end = min(speeds[-1], (high if ratio > 0 else low) / ratio)
        found.append(go.Scatter(
            x=[0, end], y=[0, ratio * end], mode="lines+text", showlegend=False, meta=meta,
            text=["", "R" if number_of_gear == -1 else str(number_of_gear)],
            textposition="bottom left" if ratio > 0 else "top left",
            line=dict(width=1, dash="dot", color="#555"), visible=False,
            textfont=dict(color="#222"),
            hovertemplate="in step with %s<extra></extra>" % gear_name(int(number_of_gear))))
    return found


def drag_figure(data):
    paths = [p for p in data.paths if (data.drag["path"] == p).any()]
    plot = canvas(460, "speed of the output [rpm]", "speed of the free input shaft [rpm]")
    for path in paths:
        plot.add_traces(drag_traces(data, path))
    choices = choice("drag", "path", "Free shaft", [(p, p) for p in paths],
                     paths[0]) if len(paths) > 1 else ""
    if len(paths) == 1:
        for trace in plot.data:
            trace.update(meta=None, visible=True)
    return embed("drag", plot,
                 "Torque that holds back an input shaft in neutral (red; blue: it is "
                 "carried along). On the dotted lines the shaft turns in step with the gear "
                 "of that number; there the torque can jump.",
                 "Drag torque on an input shaft in neutral over its own speed and the "
                 "speed of the output.", choices)


# ---- all of it ----

def best_words(data, gears):
    best = max(((np.nanmax(g.efficiency[:, g.torque > 0]), g) for g in gears),
               key=lambda pair: pair[0])
    gear = best[1]
    where = np.unravel_index(np.nanargmax(np.where(gear.torque > 0, gear.efficiency, np.nan)),
                             gear.efficiency.shape)
    return paragraph("At its best it passes on %s of the power: in %s, at %s and %s." % (
        percent(best[0], 4), gear_name(gear.number), unit(gear.speed[where[0]], "rpm"),
        unit(gear.torque[where[1]], "N·m")))


def chapter(data, results, breakdown):
    """breakdown: HTML of the part by component."""
    gears = all_gears(data)
    text = ('<section id="one-gear"><h2>How much power does it lose?</h2>'
            + best_words(data, gears) + temperature_words(data)
            + "<h3>How much does one gear lose?</h3>" + map_figure(data, results, gears)
            + "</section>")
    if len(gears) > 1:
        text += ('<section id="compare"><h2>Which gear is the most efficient?</h2>'
                 + comparison_figure(data, gears) + "</section>")
    text += ('<section id="idle"><h2>What does it lose without load?</h2>'
             + no_load_figure(data, gears) + "</section>")
    if data.slices:
        text += ('<section id="temperature"><h2>How much does the oil temperature matter?'
                 "</h2>" + oil_figure(data, gears) + "</section>")
    if len(data.drag):
        text += ('<section id="free"><h2>How strongly are free shafts held back?</h2>'
                 + drag_figure(data) + "</section>")
    return text + breakdown
