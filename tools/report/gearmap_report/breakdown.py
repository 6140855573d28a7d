# SPDX-License-Identifier: BSD-2-Clause
"""Where the power is lost, component by component: at chosen points, and over a drive.

The detailed model is solved at each point (`gearmap check --points`). Over a drive the
points are those of the detailed drive, ten for each second, as if each were steady.
"""
from html import escape

import numpy as np
import pandas as pd
import plotly.graph_objects as go

from .colours import COMPONENTS
from .drive import ENGAGED
from .figure import canvas, choice, embed
from .words import easy, ordinal, paragraph, percent, unit

SPEEDS = (0.15, 0.35, 0.7)  # of the largest
TORQUES = (("0.1", 0.1), ("0.4", 0.4), ("1", 1.0), ("-0.2", -0.2))
STEP = 0.1  # s
SLOWEST = 10.0  # rpm: slower, the input stands


def column(kind):
    return kind.replace(" ", "_") + "_W"


def bars(rows, names, meta, visible):
    """Stacked bars: rows[kind] for each of names. Components without loss are left out."""
    found = []
    for kind, (colour, pattern) in COMPONENTS.items():
        values = rows[column(kind)].to_numpy(float)
        if values.max() <= 0.001 * rows["loss_W"].max():
            continue
        found.append(go.Bar(
            y=names, x=values, name=kind, orientation="h", meta=meta, visible=visible,
            marker=dict(color=colour, line=dict(width=0),
                        pattern=dict(shape=pattern, fillmode="overlay",
                                     fgcolor="rgba(255,255,255,0.6)", size=7,
                                     solidity=0.2)),
            hovertemplate="%{y}: " + kind + " %{x:.4g}<extra></extra>"))
    return found


def end_words(ends, names, words, meta=None, visible=True):
    """Beside the end of each bar."""
    return go.Scatter(
        x=ends, y=names, mode="text", meta=meta, visible=visible, showlegend=False,
        textposition="middle right", hoverinfo="skip", cliponaxis=False,
        text=[" " + w for w in words])


def bar_canvas(count, room, title):
    """For stacked bars with words beside their ends."""
    plot = canvas(150 + room * count, title, None, barmode="stack")
    plot.update_layout(margin=dict(l=64, r=96, t=70, b=52))
    return plot


def points_table(data):
    rows = []
    for share in SPEEDS:
        speed = easy(share * data.about["speed_max_rpm"])
        for key, torque in TORQUES:
            rows += [(n, speed, round(torque * data.about["torque_max_Nm"], 1), key)
                     for _, n in data.all_gears()]
    return pd.DataFrame(rows, columns=["gear", "speed_rpm", "torque_Nm", "key"])


def points_figure(data, gearset):
    table = points_table(data)
    table = pd.concat([gearset.losses(table.drop(columns="key")), table["key"]], axis=1)
    plot = bar_canvas(len(data.gears), 34, "lost power [W]")
    speeds = sorted(table["speed_rpm"].unique())
    for speed in speeds:
        for key, _ in TORQUES:
            rows = table[(table["speed_rpm"] == speed) & (table["key"] == key)][::-1]
            names = [ordinal(n) for n in rows["gear"]]
            meta = {"speed": "%g" % speed, "torque": key}
            plot.add_traces(bars(rows, names, meta, False))
            plot.add_trace(end_words(rows["loss_W"], names, [
                "%.0f W" % w if pd.isna(e) else "%.0f W, %.1f %%" % (w, 100 * e)
                for w, e in zip(rows["loss_W"], rows["efficiency"])], meta, False))
    torque = {k: unit(t * data.about["torque_max_Nm"], "N·m") for k, t in TORQUES}
    choices = choice("components", "speed", "Speed of the input",
                     [("%g" % s, unit(s, "rpm", 4)) for s in speeds],
                     "%g" % speeds[1]) + choice(
        "components", "torque", "Torque", [(k, torque[k]) for k, _ in TORQUES], "0.4")
    other = (" The other input shaft is in neutral and turns freely."
             if len(data.paths) > 1 else "")
    return embed("components", plot,
                 "At the end of each bar: all the power lost, and the efficiency." + other
                 + " Computed with the detailed model.",
                 "Power lost in each gear by component: meshes, bearings, seals, oil and "
                 "others, at a chosen speed and torque of the input.", choices)


# ---- over a drive ----

def operating_points(drive):
    """One row for each STEP of the detailed drive with a gear engaged: gear, speed, torque
    (means of the step), preselected."""
    every = max(1, round(STEP / drive.step))
    count = drive.n // every

    def means(values):
        return values[:count * every].reshape(count, every).mean(axis=1)

    def ends(values):
        return values[:count * every].reshape(count, every)[:, every // 2]

    speed, torque, engaged, gear = [], [], [], []
    for path in drive.paths:
        speed.append(means(drive.run("detailed", path + ".speed_rpm")))
        torque.append(means(drive.run("detailed", path + ".tau_Nm")))
        gear.append(ends(drive.run("detailed", path + ".gear")).astype(int))
        engaged.append((ends(drive.run("detailed", path + ".state")) == ENGAGED)
                       & (np.abs(speed[-1]) > SLOWEST) & (gear[-1] != 0))
    speed, torque, engaged, gear = map(np.array, (speed, torque, engaged, gear))
    loaded = np.argmax(np.where(engaged, np.abs(torque), -1.0), axis=0)
    at = (loaded, np.arange(count))
    waits = np.zeros(count, int)
    if len(drive.paths) > 1:
        other = (1 - loaded, np.arange(count))
        waits = np.where(engaged[other], gear[other], 0)
    table = pd.DataFrame({"gear": gear[at], "speed_rpm": speed[at], "torque_Nm": torque[at],
                          "preselected": waits})
    return table[engaged[at]].reset_index(drop=True)


def drive_section(drive, gearset):
    table = operating_points(drive)
    if not len(table):
        return ""
    losses = gearset.losses(table)
    energy = losses.groupby("gear").sum(numeric_only=True) * STEP / 1e3
    energy = energy.loc[sorted(energy.index, key=lambda n: (n < 0, abs(n)), reverse=True)]
    names = [ordinal(int(n)) for n in energy.index]
    total = float(energy["loss_W"].sum())
    plot = bar_canvas(len(energy), 38, "lost energy [kJ]")
    plot.add_traces(bars(energy, names, None, True))
    plot.add_trace(end_words(energy["loss_W"], names, [
        "%s, %s" % (unit(e, "kJ"), percent(e / total, 2)) for e in energy["loss_W"]]))
    measured = float(drive.lost("detailed")[-1]) / 1e3
    shares = {k: float(energy[column(k)].sum()) / total for k in COMPONENTS}
    first, second = sorted(shares, key=shares.get, reverse=True)[:2]
    words = paragraph("Most of it goes into %s (%s) and %s (%s)." % (
        first, percent(shares[first], 2), second, percent(shares[second], 2)))
    return ('<section id="drive-parts"><h2>Which parts lose the energy of a drive?</h2>'
            + words + embed(
                "drive-components", plot,
                "Drive: %s. Computed with the detailed model at the speeds and torques of "
                "the drive, as if each moment were steady: %s in all. The drive itself "
                "lost %s." % (escape(drive.name), unit(total, "kJ"), unit(measured, "kJ")),
                "Energy lost over the drive by gear and component.") + "</section>")


def chapter(data, gearset, drive):
    if gearset is None:
        return ""
    return ('<section id="parts"><h2>Which parts lose the power?</h2>'
            + points_figure(data, gearset) + "</section>"
            + (drive_section(drive, gearset) if drive else ""))
